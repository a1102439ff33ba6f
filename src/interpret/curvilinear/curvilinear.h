/* Curvilinear grids, whose components may be staggered (Arakawa's C grid): find.c finds
 * them, frame.c the directions of components. */
#ifndef FG__CURVILINEAR_H
#define FG__CURVILINEAR_H

#include "interpret/interpret.h"
#include "sphere/sphere.h"

/* A variable's samples in the plane and their positions; x is the first index i of a
 * model's grid, y the second, j. */
typedef struct fg__curvilinear_part {
  const fg__variable *variable;             /* NULL: there is none */
  fg__grid grid;                            /* with its dimensions only */
  const fg__variable *longitude, *latitude; /* both 2D or both 1D; NULL: unknown */
} fg__curvilinear_part;

typedef enum fg__frame_turn {
  FG__TURN_NONE = 0, /* components along east and north */
  FG__TURN_GEOMETRY, /* along the grid; its direction follows from positions */
  FG__TURN_ANGLE,    /* along the grid; a variable is the angle of i from east */
  FG__TURN_COSINES   /* two variables are the cosine and sine of that angle */
} fg__frame_turn;

struct fg__curvilinear {
  fg__curvilinear_part centre;  /* its variable is the longitude of the centres; NULL:
                          centres are  mid-points of a component's samples */
  fg__curvilinear_part part[2]; /* the components */
  fg__curvilinear_part at;      /* whose dimensions the centres have */
  size_t size[2];               /* centres along i and j */
  size_t left_out; /* cells between them that lie over gaps, once it is read */
  int shift[2];    /* component k along its own direction: sample 0 lies on centre 0,
                      half a cell before (-1) or after it (1) */
  bool apart;      /* components lie elsewhere than on the faces of one grid */
  fg__frame_turn turn;
  fg__polar polar; /* components are a speed and a direction */
  const fg__variable *angle[2];
  const fg__variable *mask;      /* of the centres: 0 is land; NULL: none */
  char rule[2 * FG__TEXT_BYTES]; /* which rule chose the frame */
  char plane[FG__TEXT_BYTES];    /* PROJ string of a plane in which the centres are evenly
                                 spaced; "": unknown */
};

/* find.c. Finds positions of a pair's points where the grid is off_axes. Sets `mesh` and
 * clears `unusable`, or sets it to why the mesh cannot be read. MEMORY, FILE_ACCESS. */
fg_status fg__curvilinear_find(fg__grid *grid, const fg__dataset *data,
                               const fg__pair *pair, const fg_read_options *options);
void fg__curvilinear_destroy(fg__curvilinear *mesh);

/* Sets the dimensions of both components, not their positions; false where they are not
 * of one grid. */
bool fg__curvilinear_parts(fg__curvilinear *mesh, const fg__dataset *data,
                           const fg__pair *pair);

/* faces.c. For components on the faces of rectilinear cells: sets the axes to those of
 * the centres, and `faces`. Otherwise changes nothing. MEMORY, FILE_ACCESS. */
fg_status fg__staggered_find(fg__grid *grid, const fg__dataset *data,
                             const fg__pair *pair);

/* frame.c. Determines by the first rule that applies whether components are along east
 * and north or along the grid, and sets `rule`. False when none applies. */
bool fg__frame_find(fg__curvilinear *mesh, const fg__dataset *data, const fg__pair *pair,
                    fg_frame wanted);

/* Makes a pair unusable whose standard and long names name different frames. */
void fg__check_frame(fg__grid *grid, const fg__pair *pair, fg_frame wanted);

/* Whether components are known to be along the grid: as asked, by their standard names,
 * or because the file has the grid's angle. */
bool fg__is_along_grid(const fg__grid *grid, const fg__dataset *data,
                       const fg__pair *pair, fg_frame wanted);

/* positions.c. Longitudes and latitudes of a part's samples, in degrees. To be freed,
 * also after a failure. */
typedef struct fg__positions {
  double *longitude, *latitude;
} fg__positions;

fg_status fg__positions_read(fg__positions *out, const fg__dataset *data,
                             const fg__curvilinear_part *part, size_t time);
void fg__positions_clear(fg__positions *positions);

/* Positions of the centres: from the file, or mid-points of a component's samples. */
fg_status fg__centres_read(fg__positions *out, const fg__dataset *data,
                           const fg__curvilinear *mesh, size_t time);

/* Sets shift where sizes do not determine it: from positions, else from attributes and
 * names. *found is false where nothing determines it. */
fg_status fg__shift_find(bool *found, fg__curvilinear *mesh, const fg__dataset *data);

/* Sets shift[k] from the number of faces, else from attributes and names; false where
 * they do not determine it. */
bool fg__shift_by_size(fg__curvilinear *mesh, const fg__dataset *data, int k);

/* The unit vector of position n; out[0] is NaN where the position is missing. */
void fg__unit_vector(double out[3], const fg__positions *positions, size_t n);

/* model_plane.c. Sets `plane` from the attributes that WRF writes, where they agree with
 * the centres' positions. */
void fg__model_plane(fg__curvilinear *mesh, const fg__variable *u,
                     const fg__sphere_cells *cells);

/* The same for a grid on axes of longitude and latitude; NULL: none. */
const char *fg__axes_plane(char out[FG__TEXT_BYTES], const fg__variable *u,
                           const fg__grid *grid);

#endif
