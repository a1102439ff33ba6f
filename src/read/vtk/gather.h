/* Samples of a grid that lie in pieces all over a file, or those of some rows of it. */
#ifndef FG__VTK_GATHER_H
#define FG__VTK_GATHER_H

#include "read/vtk/vtk.h"

/* The rows that are read, which may be more than those wanted: a point takes its value
 * from the cells on both sides. */
typedef struct fg__vtk_view {
  const fg__vtk *vtk;
  fg__vtk_place place;
  int extent[6];
  fg__vtk_grid grid; /* of that extent */
  size_t skipped;    /* rows of points before the wanted ones */
} fg__vtk_view;

fg__vtk_view fg__vtk_view_of(const fg__vtk *vtk, const fg__vtk_grid *grid,
                             fg__vtk_place place);

/* Where sample n of the view is in the whole. */
size_t fg__vtk_place_in_whole(const fg__vtk_view *v, size_t n);

/* What a number of the file stands for. */
typedef float fg__vtk_meaning(double number);

/* Which array, and which of its components, goes where; a sample of `out` is a point or a
 * cell of the whole image, x fastest. */
typedef struct fg__vtk_gathering {
  const char *name;
  fg__vtk_place place;
  int components; /* how many are wanted */
  int component[3];
  float *out[3];
  fg__vtk_meaning *means;
  float absent; /* of a grid among several that has no such array */
} fg__vtk_gathering;

/* Every piece must be there with all its bytes, and no byte may serve two pieces: then
 * the whole is no larger than the file can fill. */
fg_status fg__vtk_gather_check(const fg__vtk *vtk, const fg__vtk_gathering *wanted);

/* Takes all samples of a file of cells, piece after piece. FILE_FORMAT, MEMORY. */
fg_status fg__vtk_gather_pieces(const fg__vtk *vtk, const fg__vtk_gathering *wanted);

/* Fills the view from the pieces; each sample must be in one. FILE_FORMAT, MEMORY. */
fg_status fg__vtk_gather(const fg__vtk_view *v, const fg__vtk_gathering *wanted);

#endif
