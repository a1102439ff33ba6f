/* NetCDF files of unstructured meshes: UGRID, ICON, FVCOM, ADCIRC, MPAS, HEALPix, cells
 * with bounds, and bare points. Which variables say where a pair's vectors lie is found
 * by `find`; `topology` reads a mesh, `cells` makes the cells between the vectors, `read`
 * a field of them (docs/method/model-grids.md). */
#ifndef FG__UNSTRUCTURED_H
#define FG__UNSTRUCTURED_H

#include "read/netcdf/netcdf.h"
#include "sphere/sphere.h"

typedef enum fg__nc_location {
  FG__NC_ON_POINTS = 0, /* no mesh is known: triangles between them are made */
  FG__NC_ON_NODES,
  FG__NC_ON_FACES
} fg__nc_location;

struct fg__nc_unstructured {
  fg__nc_location location;
  int dimension;                       /* of the vectors, of the file's */
  bool of_trajectories;                /* in arrays [trajectories][places] */
  int beside;                          /* the trajectories' dimension, where there is */
  const fg__nc_variable *connectivity; /* nodes of faces, 2 dimensions; NULL: none */
  int faces_along;                     /* which of its dimensions is the faces' */
  int start;                           /* its number of the first node, if it says none */
  const fg__nc_variable *corner_count; /* nodes of each face; NULL: up to a fill value */
  const fg__nc_variable *node[2];      /* positions x, y of nodes, or of points */
  const fg__nc_variable *centre[2];    /* of faces; NULL: in the middle of their nodes */
  const fg__nc_variable *bounds[2];    /* [faces][corners], instead of nodes */
  const fg__nc_variable *wet, *pixel;  /* NULL: none */
  bool wet_is_zero;                    /* the mask is 1 on land */
  long sides;                          /* HEALPix: N_side; 0: it is none */
  bool nested;                         /* its order */
  bool in_plane;                       /* positions are no longitudes and latitudes */
  bool in_radians;                     /* where units do not say */
  fg__nc_grid of_v;                    /* the second component's own dimensions */
  char rule[2 * FG__NC_TEXT];          /* what the mesh is and how it was found */
};

/* find.c. Finds the mesh that a pair lies on; then grid->unstructured is set, and the
 * grid has one axis, the vectors', besides time and level. What it can not be read for is
 * said in unusable. MEMORY, FILE_ACCESS. */
fg_status fg__nc_unstructured_find(fg__nc_grid *grid, const fg__nc_file *file,
                                   const fg__nc_pair *pair,
                                   const fg_read_options *options);
void fg__nc_unstructured_destroy(fg__nc_unstructured *mesh);

/* Makes a variable's dimension that is, or is as long as, that of the mesh the grid's
 * axis, and that of its trajectories the other. False where there is none, or one that is
 * neither these nor time nor level. */
bool fg__nc_unstructured_axis(fg__nc_grid *grid, const fg__nc_file *file,
                              const fg__nc_variable *v, const fg__nc_unstructured *mesh);

/* Whether a variable's only dimension is one of an unstructured mesh, perhaps one that
 * lacks something. */
bool fg__nc_unstructured_line(const fg__nc_file *file, const fg__nc_variable *v);

/* Which file a mesh is of: 0 or 1. */
int fg__nc_unstructured_file(const fg__nc_unstructured *mesh);

/* Whether a variable's mesh is of the other file. */
bool fg__nc_unstructured_elsewhere(const fg__nc_file *file, const fg__nc_variable *v);

/* The steps of that: whether variable u lies on such a mesh, along its dimension number
 * k. ugrid.c: the attributes of the UGRID conventions, 1.0. models.c: names of MPAS,
 * FVCOM, ADCIRC, ICON. coordinates.c: longitude and latitude along one dimension, with
 * bounds or without, or along trajectories; HEALPix. Writes what is lacking into `lacks`,
 * which then is why the pair can not be read. */
typedef struct fg__nc_search {
  const fg__nc_file *file;
  const fg__nc_variable *u;
  int k;
  char lacks[2 * FG__NC_TEXT];
  bool elsewhere; /* what is lacking may be in another file */
} fg__nc_search;

bool fg__nc_find_ugrid(fg__nc_unstructured *out, fg__nc_search *search);
bool fg__nc_find_model(fg__nc_unstructured *out, fg__nc_search *search);
bool fg__nc_find_healpix(fg__nc_unstructured *out, fg__nc_search *search);
bool fg__nc_find_coordinates(fg__nc_unstructured *out, fg__nc_search *search);
bool fg__nc_find_trajectories(fg__nc_unstructured *out, fg__nc_search *search);

/* Longitude (X), latitude (Y) or neither, in degrees or radians. */
fg__nc_role fg__nc_angle_role(const fg__nc_variable *v);

/* Whether two dimensions are one: of two files those of one length. */
bool fg__nc_same_dimension(const fg__nc_file *file, int a, int b);

/* Two variables named in a text, "lon lat", each with one dimension, in the order x, y.
 */
bool fg__nc_named_positions(const fg__nc_variable *out[2], const fg__nc_file *file,
                            const char *names);

/* A mesh in memory; node[first[f]] to node[first[f + 1] - 1] are the corners of face f,
 * none twice. Positions are degrees or the plane's. */
typedef struct fg__nc_topology {
  size_t nodes, count;
  double *at[2];     /* [nodes] */
  double *centre[2]; /* [count]; NULL: in the middle of the corners */
  int *first;        /* [count + 1] */
  int *node;
} fg__nc_topology;

/* topology.c. To be cleared even after a failure. FILE_FORMAT (a corner that is no node,
 * wrong sizes), FILE_ACCESS, UNSUPPORTED (memory), MEMORY. */
fg_status fg__nc_topology_read(fg__nc_topology *out, const fg__nc_file *file,
                               const fg__nc_unstructured *mesh);
void fg__nc_topology_clear(fg__nc_topology *faces);

/* Positions of one dimension, in degrees or the plane's units. */
fg_status fg__nc_positions_of(double *out[2], const fg__nc_file *file,
                              const fg__nc_unstructured *mesh,
                              const fg__nc_variable *const at[2], size_t count);

/* nodes.c. Corners of cells, in degrees, given one after the other, become nodes: those
 * at one place are one. */
typedef struct fg__nc_node_table {
  size_t nodes, capacity, slots;
  double *at[2];
  long long (*key)[3];
  int *slot;
} fg__nc_node_table;

/* The node at a place; -1: no memory, or more than INT_MAX. */
int fg__nc_node_at(fg__nc_node_table *table, double longitude, double latitude);
void fg__nc_node_table_clear(fg__nc_node_table *table);

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
fg_status fg__nc_healpix_faces(fg__nc_topology *out, const fg__nc_file *file,
                               const fg__nc_unstructured *mesh);

/* cells.c. Points with vectors and cells between them. Those of nodes lie in the faces,
 * those of faces between their centres, and at the rim of the mesh, and of faces without
 * a value, at its nodes, which have the mean of the faces round them. `on_sphere`:
 * positions are degrees, vectors east and north. velocity[k] is taken over. MEMORY. */
fg_status fg__nc_cells_of_nodes(fg__sphere_cells *out, fg_context *context,
                                fg__nc_topology *faces, float *velocity[2]);
fg_status fg__nc_cells_of_faces(fg__sphere_cells *out, fg_context *context,
                                fg__nc_topology *faces, float *velocity[2],
                                bool on_sphere);

/* read.c. The field that options choose: on the sphere, where *sphere may stay NULL, or
 * through its raster. */
fg_status fg__nc_unstructured_sphere(fg__sphere **sphere, const fg__nc_file *file,
                                     const fg__nc_pair *pair, const fg__nc_grid *grid,
                                     const fg_read_options *options);
fg_status fg__nc_unstructured_field(fg_field **out, const fg__nc_file *file,
                                    const fg__nc_pair *pair, const fg__nc_grid *grid,
                                    const fg_read_options *options, fg__slab_index slab);

/* Fills in size, bounds, cells, missing share and frame of a vector; `frame` is the
 * grid's. */
fg_status fg__nc_unstructured_describe(fg_inventory_vector *vector,
                                       const fg__nc_file *file, const fg__nc_pair *pair,
                                       const fg__nc_grid *grid);

#endif
