/* Linear cells with samples at their corners, and the raster along the axes that these
 * are interpolated onto. The method, the equations and the choice of the raster:
 * docs/design/resampling.md. */
#ifndef FG__CELL_SET_H
#define FG__CELL_SET_H

#include "base/context.h"
#include "field/cell_types.h"
#include "field/plane.h"
#include "field/region.h"

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

/* A point that no file has: in the middle of a face or a body of a quadratic cell, where
 * the cell's own functions have so much of its corners and of the points between them; or
 * the mean of a polyhedron's points, all of them `betweens`. */
typedef struct fg__cell_middle {
  size_t first; /* of its parents: first corners, then points between two */
  int corners, betweens;
} fg__cell_middle;

/* Cells of fewer dimensions than the largest are left out: edges, faces of volumes. */
typedef struct fg__cell_set {
  fg_context *context;
  const char *path;
  size_t points;      /* once located with the middles, which follow the file's */
  size_t file_points; /* once located: those of the file */
  double *position;   /* [3 * points], x y z of a point together */
  fg__cell_middle *middle;
  size_t middles, middles_capacity;
  int *parent; /* of the middles: points */
  size_t parents, parents_capacity;
  size_t count, capacity, corners_capacity;
  unsigned char *shape; /* [count], fg__cell_shape */
  int *number;          /* [count], which of the file's cells it is */
  size_t *first;        /* [count], its first corner's place in `corner` */
  int *corner;          /* points; until located -1 - n: the n-th middle */
  size_t corners;
  size_t numbers; /* cells of the file, those left out included */
  bool tilted;    /* a plane that is along no two axes: positions are in the plane's own
                     coordinates, x and y, at z = 0 */
  fg__plane_basis basis;   /* of it */
  fg__field_region region; /* that the raster is wanted of, in the axes of the field */
  /* of the raster: */
  int dimension;
  int flat; /* in 2D the axis that it has one sample along; else -1 */
  int size[3];
  double origin[3], spacing[3];
  double tried;          /* samples in the boxes of all cells together */
  fg__cell_place *place; /* [size[0] * size[1] * size[2]] */
} fg__cell_set;

void fg__cell_set_clear(fg__cell_set *set);

/* Where a cell's corner is: x, y, z. */
const double *fg__cell_set_corner(const fg__cell_set *set, size_t cell, int corner);

int fg__cell_dimension(fg__cell_shape shape);
int fg__cell_corners(fg__cell_shape shape);

/* Adds a cell, number `number` of the file's, by its points. UNSUPPORTED (more than
 * INT_MAX corners), MEMORY. */
fg_status fg__cell_set_add_points(fg__cell_set *set, fg__cell_shape shape,
                                  const int *point, int number);

/* Adds a cell of a type of VTK's (vtkCellType.h) as fg__topology has it: linear cells as
 * they are, strips, prisms and convex polygons in parts, quadratic ones as linear cells
 * between all their points and middles, a polyhedron as tetrahedra between its faces and
 * the mean of its points, so that it should be convex; vertices and lines are left out.
 * UNSUPPORTED (other types, polygons that are not convex), FILE_FORMAT (another number of
 * points than the type has), else as above. */
fg_status fg__cell_set_add_as(fg__cell_set *set, int type, const int *corner,
                              size_t count, int number);

/* How many of the file's cells there are in it, whole or in parts. */
size_t fg__cell_set_count(const fg__cell_set *set);

/* Leaves out cells of fewer dimensions than the largest, turns a tilted plane into its
 * own, chooses the raster and finds each of its samples. UNSUPPORTED (no cell with an
 * area or a volume, a surface that is not plane), FILE_FORMAT (coordinates that are no
 * numbers, cells that lie over each other many times), MEMORY. */
fg_status fg__cell_set_locate(fg__cell_set *set);

/* The steps of that, apart for their tests' sake: the raster alone; then its samples. */
fg_status fg__cell_set_choose_raster(fg__cell_set *set);
fg_status fg__cell_set_find_places(fg__cell_set *set);

/* A point's value is the mean of the cells round it (VTK's CellDataToPointData); a NaN in
 * one of them makes it one. of_cell[numbers], of_point[points]. MEMORY. */
fg_status fg__cell_set_to_points(float *of_point, const fg__cell_set *set,
                                 const float *of_cell);

/* Of an array of all points whose first file_points are known, the middles. */
void fg__cell_set_fill_middles(float *of_point, const fg__cell_set *set);

/* Turns positions into those in the plane that the cells lie in. UNSUPPORTED (not plane).
 */
fg_status fg__cell_set_turn(fg__cell_set *set);

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
