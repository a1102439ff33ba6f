/* The points and cells of curvilinear grids, on the sphere. */
#ifndef FG__CURVILINEAR_POINTS_H
#define FG__CURVILINEAR_POINTS_H

#include "interpret/curvilinear/curvilinear.h"
#include "sample/globe.h"

/* read.c. The points and cells of a pair at one time and level; mask may be NULL. */
fg_status fg__curvilinear_read(fg__sphere_cells *out, fg__curvilinear *mesh,
                               const fg__dataset *data, size_t time, size_t level,
                               const char *mask);

/* sphere.c. Reads the pair of a grid with a mesh as a field on the sphere. */
fg_status fg__sphere_read(fg__sphere **out, const fg__dataset *data, const fg__pair *pair,
                          fg__grid *grid, const fg_read_options *options);

/* Sets size, bounds, cells, missing share and frame of a vector; `frame` is the
 * grid's. */
fg_status fg__curvilinear_describe(fg_inventory_vector *vector, const fg__dataset *data,
                                   const fg__pair *pair, fg__grid *grid);

/* cells.c. Makes the cells between columns * rows points. They close around the globe,
 * and across the fold of a tripolar grid's last row, where points there are neighbours.
 * *columns is reduced by the last ones that repeat the first; points keep their
 * indices. Cells over gaps (gaps.h) are left out; *left_out counts them. */
fg_status fg__cells_make(int **corner, size_t *count, size_t *left_out,
                         const fg__dataset *data, const fg__positions *at,
                         const size_t size[2], size_t repeated, bool closed);

/* How many of the last columns repeat the first ones, and whether rows close. */
void fg__rows_closure(size_t *repeated, bool *closed, const fg__positions *at,
                      const size_t size[2]);

#endif
