/* Interfacial energies of the caller's own: the cost of an interface by place and
 * direction. docs/method/energies.md says what each of ours is, and how to add one. */
#ifndef FLOWGRAIN_ENERGY_H
#define FLOWGRAIN_ENERGY_H

#include "flowgrain/evolution.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The place of a tensor: the centre of a cell of the finest mesh that lies within the
 * field's domain. */
typedef struct fg_energy_place {
  const fg_field *field; /* of one that ranks share the values within half a spacing of
                            the position are known; others are missing */
  double position[3];    /* input coordinates */
  double spacing[3];     /* of the mesh, likewise */
  double direction[3];   /* of the streamline here, as fg_field_tangent gives it */
  double anisotropy;     /* a of the options */
} fg_energy_place;

/* Writes the symmetric tensor A of a place, xx, xy, yy and in 3D also zz, xz, yz; called
 * by fg_evolution_create, and where the mesh is coarsened. A piece of interface of normal
 * n costs sqrt(n.A n), so clusters grow long along A's eigenvectors of large eigenvalues.
 * The eigenvalues must lie between a and 1. It is called by several threads at once, on
 * each rank for its own part of the domain and the cells round it, and for one cell more
 * than once; so its result must depend on the place and `data` alone. */
typedef void fg_energy_tensor(double tensor[6], const fg_energy_place *place,
                              const void *data);

/* An energy, for `law` in fg_evolution_options. fg_evolution_create copies it, but not
 * `data`, which must outlive the evolution. */
struct fg_energy_law {
  const char *name; /* for messages */
  fg_energy_tensor *tensor;
  const void *data;  /* handed to `tensor` */
  uint64_t identity; /* of `data`: ranks must agree on it, and a checkpoint goes on with
                        the same only; 0 where there is no data */
  bool axes; /* A is made of one unit vector e a cell, of either sign: a I + (1 - a) e e^T
                or I - (1 - a) e e^T. Then A is averaged over the width of an interface
                (docs/design/tensor.md), which rough data need. */
  double anisotropy; /* the least eigenvalue there is, in place of the option; 0: the
                        option's */
};

/* A symmetric tensor field from a file, as an energy: a VTK array of nine components or
 * six (.vti, .vtr, .vtk), or variables xx, xy, yy (in 3D also zz, xz, yz) of any format
 * that fields are read from. Its grid must hold the field's box; between samples it is
 * linear. All is divided by the greatest eigenvalue. FILE_ACCESS, FILE_FORMAT,
 * UNSUPPORTED, ARGUMENT (not symmetric, not positive definite, eigenvalues more than a
 * factor of 1000 apart, another place or dimension), MEMORY. */
typedef struct fg_tensors fg_tensors;
FG_API fg_status fg_tensors_read(fg_tensors **out, fg_context *context, const char *path,
                                 const fg_field *field);
FG_API void fg_tensors_destroy(fg_tensors *tensors);

/* Borrowed: it lives as long as the tensors. */
FG_API const fg_energy_law *fg_tensors_law(const fg_tensors *tensors);

#ifdef __cplusplus
}
#endif

#endif
