/* NetCDF files whose points lie on no two axes: curvilinear grids, whose components may
 * be staggered (Arakawa's C grid). They are found by `find`, the frame of the components
 * by `frame`, and become points and cells on the sphere by `read`. */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "read/netcdf/netcdf.h"
#include "sphere/sphere.h"

/* Samples of a variable in the plane, and where they lie; x is the first index i of a
 * model's grid, y the second, j. */
typedef struct fg__nc_part {
  const fg__nc_variable *variable;             /* NULL: there is none */
  fg__nc_grid grid;                            /* its dimensions alone */
  const fg__nc_variable *longitude, *latitude; /* both of 2 dimensions, or both of one;
                                                  NULL: not known */
} fg__nc_part;

typedef enum fg__nc_turn {
  FG__NC_TURN_NONE = 0, /* components along east and north */
  FG__NC_TURN_GEOMETRY, /* along the grid, whose positions tell its direction */
  FG__NC_TURN_ANGLE,    /* along the grid; a variable has the angle of i from east */
  FG__NC_TURN_COSINES   /* two have its cosine and sine */
} fg__nc_turn;

struct fg__nc_mesh {
  fg__nc_part centre;  /* its variable is the longitude of the centres, or NULL: they lie
                          half way between the samples of a component */
  fg__nc_part part[2]; /* the components */
  size_t size[2];      /* centres along i and j */
  int shift[2];        /* component k along its own direction: sample 0 lies on centre 0,
                          half a cell before (-1) or after it (1) */
  fg__nc_turn turn;
  const fg__nc_variable *angle[2];
  const fg__nc_variable *mask; /* of the centres: 0 is land; NULL: none */
  char rule[2 * FG__NC_TEXT];  /* why this frame */
  char plane[FG__NC_TEXT];     /* PROJ string of a plane in which the centres are an even
                                  grid; "": none known */
};

/* find.c. Finds how a pair's points lie, where the grid has no axes: then mesh is set,
 * and what the grid was unusable for is gone. Why the mesh cannot be read, if so, is in
 * `unusable`. MEMORY, FILE_ACCESS. */
fg_status fg__nc_mesh_find(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_pair *pair, const fg_read_options *options);
void fg__nc_mesh_destroy(fg__nc_mesh *mesh);

/* Finds the samples of both components, without their places: false where they are not
 * those of one grid. */
bool fg__nc_mesh_parts(fg__nc_mesh *mesh, const fg__nc_file *file,
                       const fg__nc_pair *pair);

/* faces.c. For components on the faces of cells along axes: the axes become those of the
 * centres, and `faces` has the sides of the components. Else nothing is changed. MEMORY,
 * FILE_ACCESS. */
fg_status fg__nc_faces_find(fg__nc_grid *grid, const fg__nc_file *file,
                            const fg__nc_pair *pair);

/* frame.c. Whether components are along east and north or along the grid, by the first
 * rule that applies; `rule` says which. False when none does. */
bool fg__nc_frame_find(fg__nc_mesh *mesh, const fg__nc_file *file,
                       const fg__nc_pair *pair, fg_frame wanted);

/* positions.c. Longitudes and latitudes of a part's samples, in degrees; to be freed even
 * after a failure. */
typedef struct fg__nc_positions {
  double *longitude, *latitude;
} fg__nc_positions;

fg_status fg__nc_positions_read(fg__nc_positions *out, const fg__nc_file *file,
                                const fg__nc_part *part, size_t time);
void fg__nc_positions_clear(fg__nc_positions *positions);

/* Positions of the centres: their own, or between those of the components. */
fg_status fg__nc_centres_read(fg__nc_positions *out, const fg__nc_file *file,
                              const fg__nc_mesh *mesh, size_t time);

/* Sets shift where it does not follow from sizes: from positions, then from attributes
 * and names.
 * False where none does. */
fg_status fg__nc_shift_find(bool *found, fg__nc_mesh *mesh, const fg__nc_file *file);

/* Sets shift[k] by the number of faces, else by attributes and names; false where it
 * follows from none. */
bool fg__nc_shift_by_size(fg__nc_mesh *mesh, const fg__nc_file *file, int k);

/* The unit vector of position n; the first number is NaN where there is none. */
void fg__nc_unit_vector(double out[3], const fg__nc_positions *positions, size_t n);

/* read.c. The points and cells of a pair at one time and level; mask may be NULL. */
fg_status fg__nc_mesh_read(fg__sphere_cells *out, fg__nc_mesh *mesh,
                           const fg__nc_file *file, size_t time, size_t level,
                           const char *mask);

/* sphere.c. The field on the sphere that options choose of a pair whose grid has a mesh.
 */
fg_status fg__nc_sphere_read(fg__sphere **out, const fg__nc_file *file,
                             const fg__nc_pair *pair, const fg__nc_grid *grid,
                             const fg_read_options *options);

/* Fills in size, bounds, cells, missing share and frame of a vector; `frame` is the
 * grid's. */
fg_status fg__nc_mesh_describe(fg_inventory_vector *vector, const fg__nc_file *file,
                               const fg__nc_pair *pair, const fg__nc_grid *grid);

/* model_plane.c. Sets `plane` by the attributes that WRF writes, where they fit the
 * centres' positions. */
void fg__nc_model_plane(fg__nc_mesh *mesh, const fg__nc_file *file,
                        const fg__nc_variable *u, const fg__sphere_cells *cells);

/* The same of a grid on axes of longitude and latitude; NULL: none. */
const char *fg__nc_axes_plane(char out[FG__NC_TEXT], const fg__nc_file *file,
                              const fg__nc_variable *u, const fg__nc_grid *grid);

/* cells.c. Cells between columns * rows points, which close round the world, or across
 * the fold of a tripolar grid's last row, where those are neighbours. *columns becomes
 * less where the last ones repeat the first; points keep their places. */
fg_status fg__nc_cells_make(int **corner, size_t *count, const fg__nc_file *file,
                            const fg__nc_positions *at, const size_t size[2],
                            size_t repeated, bool closed);

/* How many of the last columns repeat the first ones, and whether the row closes. */
void fg__nc_closure(size_t *repeated, bool *closed, const fg__nc_positions *at,
                    const size_t size[2]);

#endif
