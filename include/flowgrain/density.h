/* A snapshot of the evolution. */
#ifndef FLOWGRAIN_DENSITY_H
#define FLOWGRAIN_DENSITY_H

#include "flowgrain/evolution.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The density at the nodes of a uniform grid over the field's box. A snapshot: later
 * steps do not change it. */
typedef struct fg_density fg_density;

typedef struct fg_density_arrays {
  int dimension;     /* 2 or 3; without a third axis nodes[2] reads 1 */
  int nodes[3];      /* along a periodic axis the repeated last node is left out */
  double origin[3];  /* node (0, 0, 0), input coordinates */
  double spacing[3]; /* input coordinates */
  bool periodic[3];
  const float *u; /* a value a node, x fastest; u > 0 inside a cluster; NULL: it
                     is distributed */
  const unsigned char *active; /* a byte a cell, 0 = masked; nodes[k] - 1 cells along an
                                  axis, nodes[k] when periodic; NULL: all active */
  double debris_area; /* components of less area (volume) than this are not clusters, in
                         input coordinates squared (cubed) */
  double time, energy, area_fraction; /* as in fg_step */
  int clusters;                       /* that `u` has, as in fg_step */
} fg_density_arrays;

/* Takes a snapshot. Where several ranks evolve, each gets its block: `u` and `active` of
 * its contents are NULL. This call, and those that take a distributed density, are
 * collective. MEMORY, ARGUMENT (a block too large for labels of type int), MPI. */
FG_API fg_status fg_density_create(fg_density **out, const fg_evolution *evolution);

/* Whether a density is distributed among several ranks. */
FG_API bool fg_density_is_distributed(const fg_density *density);

/* Gathers a distributed density on rank 0; on other ranks *out becomes NULL.
 * Collective. MEMORY, ARGUMENT (it is not distributed). */
FG_API fg_status fg_density_gather(fg_density **out, fg_context *context,
                                   const fg_density *density);

/* Copies arrays into a new density and finds its clusters, for a density that is not of
 * an fg_evolution. `time` and the members after it are kept as given. ARGUMENT (sizes,
 * spacing), MEMORY. */
FG_API fg_status fg_density_create_from_arrays(fg_density **out, fg_context *context,
                                               const fg_density_arrays *arrays);
FG_API void fg_density_destroy(fg_density *density);

/* The density's arrays, borrowed. */
FG_API const fg_density_arrays *fg_density_contents(const fg_density *density);

/* The number of each node's cluster, from 1; 0 outside, -1 in components too small to be
 * clusters. Borrowed; NULL: the density is distributed. */
FG_API const int *fg_density_labels(const fg_density *density);

/* Writes u, the number of each node's cluster (0 outside, -1 in components too small to
 * be clusters) and the mask as .vti. Of a distributed density rank 0 writes what the
 * others send it, packed and part by part; `path` is not read elsewhere, and the call is
 * collective. FILE_ACCESS, UNSUPPORTED (another name's end, too many nodes), ARGUMENT,
 * MEMORY. */
FG_API fg_status fg_density_write(fg_context *context, const char *path,
                                  const fg_density *density);

/* Reads a file of fg_density_write. `field`, on which the density evolved, tells which
 * axes are periodic. Energy and area are not known. FILE_ACCESS, FILE_FORMAT (also a
 * density of another kind of field), MEMORY. */
FG_API fg_status fg_density_read(fg_density **out, fg_context *context, const char *path,
                                 const fg_field *field);

#ifdef __cplusplus
}
#endif

#endif
