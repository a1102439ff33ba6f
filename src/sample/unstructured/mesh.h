/* Vectors of unstructured meshes: `topology` reads a mesh, `cells` makes the cells
 * between the vectors, `read` a field of them. */
#ifndef FG__UNSTRUCTURED_MESH_H
#define FG__UNSTRUCTURED_MESH_H

#include "interpret/unstructured/unstructured.h"
#include "sample/points/points.h"
#include "sample/rows.h"
#include "sphere/sphere.h"

/* A mesh in memory; node[first[f]] to node[first[f + 1] - 1] are the corners of face f,
 * none twice. Positions are degrees or the plane's. */
typedef struct fg__mesh_topology {
  size_t nodes, count;
  double *at[2];     /* [nodes] */
  double *centre[2]; /* [count]; NULL: in the middle of the corners */
  int *first;        /* [count + 1] */
  int *node;
} fg__mesh_topology;

/* topology.c. To be cleared even after a failure. FILE_FORMAT (a corner that is no node,
 * wrong sizes), FILE_ACCESS, UNSUPPORTED (memory), MEMORY. */
fg_status fg__mesh_topology_read(fg__mesh_topology *out, const fg__dataset *data,
                                 const fg__unstructured *mesh);
void fg__mesh_topology_clear(fg__mesh_topology *faces);

/* read.c. The mask of that name, or (NULL) the one that the file has for its mesh: *out
 * is NULL without. *grid gets its place on the mesh. ARGUMENT. */
fg_status fg__mesh_mask_find(const fg__variable **out, fg__grid *grid,
                             const fg__dataset *data, const fg__pair *pair,
                             const fg__unstructured *mesh, const char *name);

/* nodes.c. Corners of cells, in degrees, given one after the other, become nodes: those
 * at one place are one. */
typedef struct fg__node_table {
  size_t nodes, capacity, slots;
  double *at[2];
  long long (*key)[3];
  int *slot;
} fg__node_table;

/* The node at a place; -1: no memory, or more than INT_MAX. */
int fg__node_table_at(fg__node_table *table, double longitude, double latitude);
void fg__node_table_clear(fg__node_table *table);

/* healpix.c. A pixel: x and y count from the lowest corner of its base pixel. */
typedef struct fg__healpix_pixel {
  int base;
  long x, y;
} fg__healpix_pixel;

/* Longitude and latitude at (x, y), each from 0 to sides, of a base pixel; the pixel of a
 * number below 12 * sides * sides (Gorski et al. 2005). */
void fg__healpix_place(double at[2], long sides, int base, double x, double y);
fg__healpix_pixel fg__healpix_find(long sides, long long number, bool nested);

/* The faces of all pixels, or of those that mesh->pixel lists. */
fg_status fg__healpix_faces(fg__mesh_topology *out, const fg__dataset *data,
                            const fg__unstructured *mesh);

/* Gives poles, the last nodes, the mean vector of the nodes round them. */
void fg__fill_poles(const fg__mesh_topology *faces, size_t poles,
                    float *const velocity[2]);

/* cells.c. Points with vectors and cells between them. Those of nodes lie in the faces,
 * those of faces between their centres, and at the rim of the mesh, and of faces without
 * a value, at its nodes, which have the mean of the faces round them. `on_sphere`:
 * positions are degrees, vectors east and north. velocity[k] is taken over. MEMORY. */
fg_status fg__cells_of_nodes(fg__sphere_cells *out, fg_context *context,
                             fg__mesh_topology *faces, float *velocity[2]);
fg_status fg__cells_of_faces(fg__sphere_cells *out, fg_context *context,
                             fg__mesh_topology *faces, float *velocity[2],
                             bool on_sphere);

/* A vector that is read. */
typedef struct fg__mesh_request {
  const fg__dataset *data;
  const fg__pair *pair;
  const fg__grid *grid;
  const fg_read_options *options;
  bool counts_only; /* how much is missing, even all */
  fg__vector_words words;
  fg_field_arrays texts;
  fg__field_region region; /* that samples are wanted of */
} fg__mesh_request;

/* points.c. The same of points without a mesh: *missing of them have no value. As a field
 * on the sphere, where *sphere stays NULL for a grid's; or as any field, with the texts
 * of its axes. */
fg_status fg__points_sphere(fg__sphere **sphere, fg__scatter_between *between,
                            size_t *missing, const fg__mesh_request *r);
fg_status fg__points_field(fg_field **out, fg__scatter_between *between, size_t *missing,
                           const fg__mesh_request *r, const fg_field_arrays *texts,
                           fg__slab_index slab);

/* read.c. The field that options choose: on the sphere, where *sphere may stay NULL, or
 * through its raster. */
fg_status fg__unstructured_sphere(fg__sphere **sphere, const fg__dataset *data,
                                  const fg__pair *pair, const fg__grid *grid,
                                  const fg_read_options *options);
fg_status fg__unstructured_field(fg_field **out, const fg__dataset *data,
                                 const fg__pair *pair, const fg__grid *grid,
                                 const fg_read_options *options, fg__slab_index slab);

/* Fills in size, bounds, cells, missing share and frame of a vector; `frame` is the
 * grid's. */
fg_status fg__unstructured_describe(fg_inventory_vector *vector, const fg__dataset *data,
                                    const fg__pair *pair, const fg__grid *grid);

#endif
