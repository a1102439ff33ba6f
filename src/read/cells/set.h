/* Linear cells with samples at their corners, and the raster along the axes that these
 * are interpolated onto. The method, the equations and the choice of the raster:
 * docs/design/resampling.md. */
#ifndef FG__CELL_SET_H
#define FG__CELL_SET_H

#include "base/context.h"

enum { FG__CELL_CORNERS = 8 };

/* Corners are numbered as VTK numbers them (VTK File Formats, Kitware, figure 2). */
typedef enum fg__cell_shape {
  FG__CELL_TRIANGLE,
  FG__CELL_QUAD,
  FG__CELL_TETRAHEDRON,
  FG__CELL_PYRAMID,
  FG__CELL_WEDGE,
  FG__CELL_HEXAHEDRON,
  FG__CELL_SHAPES
} fg__cell_shape;

/* Where a sample of the raster lies: in which cell and where in it; outside all cells:
 * cell < 0. */
typedef struct fg__cell_place {
  int cell;
  float at[3];
} fg__cell_place;

/* Cells of fewer dimensions than the largest are left out: edges, faces of volumes. */
typedef struct fg__cell_set {
  fg_context *context;
  const char *path;
  size_t points;
  double *position; /* [3 * points], x y z of a point together */
  size_t count, capacity, corners_capacity;
  unsigned char *shape; /* [count], fg__cell_shape */
  int *number;          /* [count], which of the file's cells it is */
  size_t *first;        /* [count], its first corner's place in `corner` */
  int *corner;          /* points */
  size_t corners;
  size_t numbers; /* cells of the file, those left out included */
  /* of the raster: */
  int dimension;
  int flat; /* in 2D the axis that it has one sample along; else -1 */
  int size[3];
  double origin[3], spacing[3];
  fg__cell_place *place; /* [size[0] * size[1] * size[2]] */
} fg__cell_set;

void fg__cell_set_clear(fg__cell_set *set);

int fg__cell_dimension(fg__cell_shape shape);
int fg__cell_corners(fg__cell_shape shape);

/* Points of one piece of a file: `count` from `first` on. */
typedef struct fg__cell_points {
  size_t first, count;
} fg__cell_points;

/* Adds a cell, number `number` of the file's; its corners count from the piece's first
 * point on. UNSUPPORTED (more than INT_MAX corners), FILE_FORMAT (a corner that is no
 * point), MEMORY. */
fg_status fg__cell_set_add(fg__cell_set *set, fg__cell_shape shape, const double *corner,
                           const fg__cell_points *points, int number);

/* Leaves out cells of fewer dimensions than the largest, chooses the raster and finds
 * each of its samples. UNSUPPORTED (no cell with an area or a volume, a surface that lies
 * in no plane of two axes), FILE_FORMAT (coordinates that are no numbers, cells that lie
 * over each other many times), MEMORY. */
fg_status fg__cell_set_locate(fg__cell_set *set);

/* The steps of that, apart for their tests' sake: the raster alone; then its samples. */
fg_status fg__cell_set_choose_raster(fg__cell_set *set);
fg_status fg__cell_set_find_places(fg__cell_set *set);

/* A point's value is the mean of the cells round it (VTK's CellDataToPointData); a NaN in
 * one of them makes it one. of_cell[numbers], of_point[points]. MEMORY. */
fg_status fg__cell_set_to_points(float *of_point, const fg__cell_set *set,
                                 const float *of_cell);

/* Samples [first, first + count) of the raster, interpolated between points; NaN outside
 * all cells, and in those with a corner that is NaN. */
void fg__cell_set_sample(float *out, const fg__cell_set *set, const float *of_point,
                         size_t first, size_t count);

/* Weights of the corners at a place in the reference cell, whose coordinates go from 0 to
 * 1, and their derivatives (may be NULL). */
void fg__cell_weights(fg__cell_shape shape, const double at[3],
                      double weight[FG__CELL_CORNERS], double slope[FG__CELL_CORNERS][3]);

/* How far outside the reference cell a place is; 0 or less inside. */
double fg__cell_excess(fg__cell_shape shape, const double at[3]);

/* Finds the place of a point in a cell by Newton's method, starting from *at: whether it
 * was found, inside or not. corner and point have as many coordinates as the cell has
 * dimensions; `width` is the cell's largest. */
bool fg__cell_invert(double at[3], fg__cell_shape shape,
                     double corner[FG__CELL_CORNERS][3], const double point[3],
                     double width);

#endif
