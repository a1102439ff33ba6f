/* The samples of a field on axes. */
#ifndef FG__VELOCITY_H
#define FG__VELOCITY_H

#include "interpret/interpret.h"
#include "sample/rows.h"

/* The samples of some rows of a field. */
typedef struct fg__velocity_samples {
  float *velocity[3];
  fg__missing_counts missing[3]; /* in these rows */
  unsigned char *valid;          /* NULL: all */
} fg__velocity_samples;

/* Reads a pair's rows at one time and, in 2D, one level; mask may be NULL. *out has to be
 * cleared, also after a failure. FILE_ACCESS, ARGUMENT (mask), MEMORY. */
fg_status fg__velocity_samples_read(fg__velocity_samples *out, const fg__dataset *data,
                                    const fg__pair *pair, const fg__grid *grid,
                                    const fg__rows *rows, size_t time, size_t level,
                                    const char *mask);

/* The share of samples that lack a component, at the first time and level that have
 * both. Statuses of fg__velocity_samples_read. */
fg_status fg__velocity_missing(double *share, const fg__dataset *data,
                               const fg__pair *pair, const fg__grid *grid);

void fg__velocity_samples_clear(fg__velocity_samples *samples);

/* Rotates the components of some rows to the directions of the projection's plane. */
fg_status fg__projection_turn(float *const velocity[2], const fg__dataset *data,
                              const fg__grid *grid, const fg__rows *rows);

#endif
