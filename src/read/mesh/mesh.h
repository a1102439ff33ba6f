/* NetCDF files with curvilinear grids, whose components may be staggered (Arakawa's C
 * grid). find.c finds them, frame.c the directions of components, and read.c makes points
 * and cells on the sphere. */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "read/netcdf/netcdf.h"
#include "sphere/sphere.h"

/* A variable's samples in the plane and their positions; x is the first index i of a
 * model's grid, y the second, j. */
typedef struct fg__nc_part {
  const fg__nc_variable *variable;             /* NULL: there is none */
  fg__nc_grid grid;                            /* with its dimensions only */
  const fg__nc_variable *longitude, *latitude; /* both 2D or both 1D; NULL: unknown */
} fg__nc_part;

typedef enum fg__nc_turn {
  FG__NC_TURN_NONE = 0, /* components along east and north */
  FG__NC_TURN_GEOMETRY, /* along the grid; its direction follows from positions */
  FG__NC_TURN_ANGLE,    /* along the grid; a variable is the angle of i from east */
  FG__NC_TURN_COSINES   /* two variables are the cosine and sine of that angle */
} fg__nc_turn;

struct fg__nc_mesh {
  fg__nc_part centre;  /* its variable is the longitude of the centres; NULL: centres are
                          mid-points of a component's samples */
  fg__nc_part part[2]; /* the components */
  size_t size[2];      /* centres along i and j */
  int shift[2];        /* component k along its own direction: sample 0 lies on centre 0,
                          half a cell before (-1) or after it (1) */
  bool apart;          /* components lie elsewhere than on the faces of one grid */
  fg__nc_turn turn;
  fg__polar polar; /* components are a speed and a direction */
  const fg__nc_variable *angle[2];
  const fg__nc_variable *mask; /* of the centres: 0 is land; NULL: none */
  char rule[2 * FG__NC_TEXT];  /* which rule chose the frame */
  char plane[FG__NC_TEXT];     /* PROJ string of a plane in which the centres are evenly
                                  spaced; "": unknown */
};

/* find.c. Finds positions of a pair's points where the grid is off_axes. Sets `mesh` and
 * clears `unusable`, or sets it to why the mesh cannot be read. MEMORY, FILE_ACCESS. */
fg_status fg__nc_mesh_find(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_pair *pair, const fg_read_options *options);
void fg__nc_mesh_destroy(fg__nc_mesh *mesh);

/* Sets the dimensions of both components, not their positions; false where they are not
 * of one grid. */
bool fg__nc_mesh_parts(fg__nc_mesh *mesh, const fg__nc_file *file,
                       const fg__nc_pair *pair);

/* faces.c. For components on the faces of rectilinear cells: sets the axes to those of
 * the centres, and `faces`. Otherwise changes nothing. MEMORY, FILE_ACCESS. */
fg_status fg__nc_faces_find(fg__nc_grid *grid, const fg__nc_file *file,
                            const fg__nc_pair *pair);

/* frame.c. Determines by the first rule that applies whether components are along east
 * and north or along the grid, and sets `rule`. False when none applies. */
bool fg__nc_frame_find(fg__nc_mesh *mesh, const fg__nc_file *file,
                       const fg__nc_pair *pair, fg_frame wanted);

/* Whether a component's names say that it is along east or north. */
bool fg__nc_says_east(const fg__nc_variable *u);

/* positions.c. Longitudes and latitudes of a part's samples, in degrees. To be freed,
 * also after a failure. */
typedef struct fg__nc_positions {
  double *longitude, *latitude;
} fg__nc_positions;

fg_status fg__nc_positions_read(fg__nc_positions *out, const fg__nc_file *file,
                                const fg__nc_part *part, size_t time);
void fg__nc_positions_clear(fg__nc_positions *positions);

/* Positions of the centres: from the file, or mid-points of a component's samples. */
fg_status fg__nc_centres_read(fg__nc_positions *out, const fg__nc_file *file,
                              const fg__nc_mesh *mesh, size_t time);

/* Sets shift where sizes do not determine it: from positions, else from attributes and
 * names. *found is false where nothing determines it. */
fg_status fg__nc_shift_find(bool *found, fg__nc_mesh *mesh, const fg__nc_file *file);

/* Sets shift[k] from the number of faces, else from attributes and names; false where
 * they do not determine it. */
bool fg__nc_shift_by_size(fg__nc_mesh *mesh, const fg__nc_file *file, int k);

/* The unit vector of position n; out[0] is NaN where the position is missing. */
void fg__nc_unit_vector(double out[3], const fg__nc_positions *positions, size_t n);

/* read.c. The points and cells of a pair at one time and level; mask may be NULL. */
fg_status fg__nc_mesh_read(fg__sphere_cells *out, fg__nc_mesh *mesh,
                           const fg__nc_file *file, size_t time, size_t level,
                           const char *mask);

/* sphere.c. Reads the pair of a grid with a mesh as a field on the sphere. */
fg_status fg__nc_sphere_read(fg__sphere **out, const fg__nc_file *file,
                             const fg__nc_pair *pair, const fg__nc_grid *grid,
                             const fg_read_options *options);

/* Sets size, bounds, cells, missing share and frame of a vector; `frame` is the
 * grid's. */
fg_status fg__nc_mesh_describe(fg_inventory_vector *vector, const fg__nc_file *file,
                               const fg__nc_pair *pair, const fg__nc_grid *grid);

/* model_plane.c. Sets `plane` from the attributes that WRF writes, where they agree with
 * the centres' positions. */
void fg__nc_model_plane(fg__nc_mesh *mesh, const fg__nc_file *file,
                        const fg__nc_variable *u, const fg__sphere_cells *cells);

/* The same for a grid on axes of longitude and latitude; NULL: none. */
const char *fg__nc_axes_plane(char out[FG__NC_TEXT], const fg__nc_file *file,
                              const fg__nc_variable *u, const fg__nc_grid *grid);

/* cells.c. Makes the cells between columns * rows points. They close around the globe,
 * and across the fold of a tripolar grid's last row, where points there are neighbours.
 * *columns is reduced by the last ones that repeat the first; points keep their
 * indices. */
fg_status fg__nc_cells_make(int **corner, size_t *count, const fg__nc_file *file,
                            const fg__nc_positions *at, const size_t size[2],
                            size_t repeated, bool closed);

/* How many of the last columns repeat the first ones, and whether rows close. */
void fg__nc_closure(size_t *repeated, bool *closed, const fg__nc_positions *at,
                    const size_t size[2]);

#endif
