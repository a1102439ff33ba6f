/* Unstructured meshes: UGRID, ICON, FVCOM, ADCIRC, MPAS, HEALPix, cells with bounds, and
 * bare points. Which variables say where a pair's vectors lie is found by `find`
 * (docs/method/model-grids.md). */
#ifndef FG__UNSTRUCTURED_H
#define FG__UNSTRUCTURED_H

#include "interpret/interpret.h"

typedef enum fg__mesh_location {
  FG__MESH_ON_POINTS = 0, /* no mesh is known: triangles between them are made */
  FG__MESH_ON_NODES,
  FG__MESH_ON_FACES
} fg__mesh_location;

/* Times or levels of a table's rows: a column. */
typedef struct fg__row_axis {
  const fg__variable *variable; /* NULL: there is none */
  size_t count;
  double *value;  /* [count], ascending: those that tell rows apart; NULL: all count */
  double ends[2]; /* of all rows */
} fg__row_axis;

struct fg__unstructured {
  fg__mesh_location location;
  int dimension; /* of the vectors, of the file's */
  int rank;      /* of arrays of places; the last is `dimension` */
  int before[2]; /* the others, where rank is 2 or 3 */
  bool is_tiled; /* these are of tiles, in any place among a variable's dimensions */
  fg__row_axis rows_time, rows_level;
  const fg__variable *connectivity; /* nodes of faces, 2 dimensions; NULL: none */
  int faces_along;                  /* which of its dimensions is the faces' */
  int start;                        /* its number of the first node, if it says none */
  const fg__variable *corner_count; /* nodes of each face; NULL: up to a fill value */
  const fg__variable *node[3];      /* positions x, y of nodes, or x, y(, z) of points */
  const fg__variable *centre[2];    /* of faces; NULL: in the middle of their nodes */
  const fg__variable *bounds[2];    /* [faces][corners], instead of nodes */
  const fg__variable *wet, *pixel;  /* NULL: none */
  bool wet_is_zero;                 /* the mask is 1 on land */
  const fg__variable *turn[2];      /* cosine and sine of the angle from east to x of
                                       vectors along the mesh's rows; NULL: east */
  size_t poles;                     /* how many nodes, the last, are poles without a value
                                       that faces go round */
  long sides;                       /* HEALPix: N_side; 0: it is none */
  bool nested;                      /* its order */
  bool in_plane;                    /* positions are no longitudes and latitudes */
  bool in_radians;                  /* where units do not say */
  fg__grid of_v;                    /* the second component's own dimensions */
  char rule[2 * FG__TEXT_BYTES];    /* what the mesh is and how it was found */
  char axis_name[3][FG__TEXT_BYTES]; /* of the field that it becomes */
};

/* find.c. Finds the mesh that a pair lies on; then grid->unstructured is set, and the
 * grid has one axis, the vectors', besides time and level. What it can not be read for is
 * said in unusable. MEMORY, FILE_ACCESS. */
fg_status fg__unstructured_find(fg__grid *grid, const fg__dataset *data,
                                const fg__pair *pair, const fg_read_options *options);
void fg__unstructured_destroy(fg__unstructured *mesh);

/* Makes a variable's dimension that is, or is as long as, that of the mesh the grid's
 * axis, and that of its trajectories the other. False where there is none, or one that is
 * neither these nor time nor level. */
bool fg__unstructured_axis(fg__grid *grid, const fg__dataset *data, const fg__variable *v,
                           const fg__unstructured *mesh);

/* Whether a variable's only dimension is one of an unstructured mesh, perhaps one that
 * lacks something. */
bool fg__unstructured_line(const fg__dataset *data, const fg__variable *v);

/* Whether north is known: places are longitudes and latitudes, be they read as a plane's.
 */
bool fg__points_north(const fg__unstructured *mesh);

/* tiles.c. Makes a pair on tiles unusable unless it points east and north. */
void fg__check_tiles(fg__grid *grid, const fg__pair *pair, fg_frame wanted);

/* Whether a variable's dimension number k is one of those along which places lie. */
bool fg__along_places(const fg__dataset *data, const fg__unstructured *mesh,
                      const fg__variable *v, int k);

/* Whether a variable has one number for each place. */
bool fg__lies_at_places(const fg__unstructured *mesh, const fg__variable *v);

/* How many coordinates of the places are used: three with as many components. */
int fg__places_dimension(const fg__unstructured *mesh, const fg__pair *pair);

/* rows.c. Finds out which columns have times and levels that tell rows of a table apart:
 * more than a tenth of them lie where others do, or each time has 8 rows or more that are
 * scattered like all of them. MEMORY, FILE_FORMAT. */
fg_status fg__rows_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                        const fg_read_options *options);

/* Numbers of a column, dates as seconds from 1970 on; NaN: none. */
fg_status fg__row_values(double *out, const fg__dataset *data, const fg__variable *v,
                         size_t count);

/* Sets valid[count] to 0 of rows that a column marks as no measurement. */
fg_status fg__rows_hide(unsigned char *valid, const fg__dataset *data,
                        const fg__unstructured *mesh, size_t count);

/* Which file a mesh is of: 0 or 1. */
int fg__unstructured_file(const fg__unstructured *mesh);

/* Whether a variable's mesh is of the other file. */
bool fg__unstructured_elsewhere(const fg__dataset *data, const fg__variable *v);

/* The steps of that: whether variable u lies on such a mesh, along its dimension number
 * k. ugrid.c: the attributes of the UGRID conventions, 1.0. models.c: names of MPAS,
 * FVCOM, ADCIRC, ICON. coordinates.c: longitude and latitude along one dimension, with
 * bounds or without, or along trajectories; HEALPix. tiles.c: on tiles. places.c: x, y(,
 * z) or those that are named, along one dimension, or in arrays without names. Writes
 * what is lacking into `lacks`, which then is why the pair can not be read. */
typedef struct fg__mesh_search {
  const fg__dataset *data;
  const fg__variable *u;
  const fg__pair *pair; /* whose places may be named; NULL: not known */
  int k;
  char lacks[2 * FG__TEXT_BYTES];
  bool elsewhere; /* what is lacking may be in another file */
} fg__mesh_search;

/* Whether a variable lies along the last `rank` dimensions of the vectors up to that
 * which is looked at; and whether a dimension is that. */
bool fg__search_lies(const fg__mesh_search *search, const fg__variable *v, int rank);
bool fg__search_along(const fg__mesh_search *search, int dimension);

bool fg__find_ugrid(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_model(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_healpix(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_coordinates(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_tiles(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_trajectories(fg__unstructured *out, fg__mesh_search *search);
bool fg__find_places(fg__unstructured *out, fg__mesh_search *search);

/* Whether two dimensions are one: of two files those of one length. */
bool fg__same_dimension(const fg__dataset *data, int a, int b);

/* Two variables named in a text, "lon lat", each with one dimension, in the order x, y.
 */
bool fg__named_positions(const fg__variable *out[2], const fg__dataset *data,
                         const char *names);

/* Degrees in a unit of positions as they are stored. */
double fg__degrees_in(const fg__unstructured *mesh, const fg__variable *v);

/* Positions of two or three coordinates, in degrees or the plane's units. */
fg_status fg__positions_of(double *out[], const fg__dataset *data,
                           const fg__unstructured *mesh, const fg__variable *const at[],
                           size_t count, int coordinates);

#endif
