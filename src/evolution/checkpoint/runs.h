/* What a record and a box have in common, as runs of values that follow each other both
 * in the record and in the box's own array: rows, or more where both are as wide. */
#ifndef FG__CHECKPOINT_RUNS_H
#define FG__CHECKPOINT_RUNS_H

#include <stdint.h>

#include "grid/box.h"

typedef struct fg__runs {
  fg__box part;     /* what they have in common */
  size_t length;    /* values of a run */
  int rows, planes; /* runs: rows along y in each of `planes` along z */
} fg__runs;

/* There may be none: rows is 0. */
fg__runs fg__runs_of(const fg__box *record, const fg__box *box);

/* Where a run begins among the values of the record, or the box, x fastest. */
uint64_t fg__run_at(const fg__runs *runs, const fg__box *of, int row, int plane);

#endif
