/* Rasters of ever larger cells on which unknown values are the mean of their neighbours.
 */
#ifndef FG__SCORE_LEVEL_H
#define FG__SCORE_LEVEL_H

#include <stddef.h>

#include "base/context.h"

enum { FG__OUTSIDE = 0, FG__UNKNOWN = 1, FG__FIXED = 2 };

/* A raster with a layer of outside cells around, in 2D none across z. Vectors have a
 * number a cell. */
typedef struct fg__score_level {
  int dimension, size[3];
  int margin; /* along z */
  ptrdiff_t step[3];
  size_t cells;
  size_t begin, end; /* the cells that may be unknown */
  size_t unknown;
  unsigned char *kind;
  double *value[3];      /* of vectors; 0 outside */
  unsigned char *degree; /* neighbours in the domain, of an unknown cell; else 0 */
  double *share; /* of unknown cells: 1 / weights of the coarse cells in the domain */
  double *work;  /* of the V-cycle */
  double *right, *correction; /* of the V-cycle, but on the finest raster */
  double *line, *coarse_line; /* a row, with room around */
} fg__score_level;

static inline size_t fg__score_level_place(const fg__score_level *level, int i, int j,
                                           int k)
{
  return (size_t)((k + level->margin) * level->step[2] + (j + 1) * level->step[1] +
                  (i + 1));
}

/* All cells are outside. Ends with fg__score_level_clear, also after a failure. MEMORY.
 */
fg_status fg__score_level_create(fg__score_level *out, fg_context *context, int dimension,
                                 const int size[3]);
void fg__score_level_clear(fg__score_level *level);

/* Makes the sum of tangents in a cell a unit vector, which fixes the cell; tangents that
 * cancel each other tell nothing. */
void fg__score_level_fix(fg__score_level *level, size_t place);

/* Sets degree and unknown, once the kinds of cells are known. */
void fg__score_level_finish(fg__score_level *level);

/* Two cells a side become one, fixed when one of its cells is; sets the fine one's share,
 * too. MEMORY. */
fg_status fg__score_level_coarsen(fg__score_level *coarse, fg_context *context,
                                  fg__score_level *fine);

/* Adds to unknown cells what the nearest coarse cells have, 3 : 1 along each axis. */
void fg__score_level_interpolate(const fg__score_level *fine, double *to,
                                 const fg__score_level *coarse, const double *from);

/* The transpose of that, to unknown coarse cells. */
void fg__score_level_restrict(const fg__score_level *coarse, double *to,
                              const fg__score_level *fine, const double *from);

/* out = sum over neighbours of (x - theirs) of unknown cells, 0 elsewhere. */
void fg__score_level_apply(const fg__score_level *level, double *out, const double *x);

#endif
