/* What the next steps depend on, beyond what the creation of a stepper from the same
 * field and options gives: everything that a checkpoint has to hold of it. */
#ifndef FG__STEPPER_STATE_H
#define FG__STEPPER_STATE_H

#include "evolve/named_values.h"
#include "evolve/stepper.h"

/* Numbers of an fg__stepper. */
extern const fg__named_value fg__stepper_values[];
extern const size_t fg__stepper_value_count;

/* An array in the layout of a level. */
typedef struct fg__state_array {
  const char *name;
  int grid; /* the level's number, 0 the finest */
  const fg__level *level;
  float *values;
} fg__state_array;

enum { FG__STATE_ARRAYS = 3 };

/* Lists the arrays; they are the stepper's own, for reading or for filling (with
 * ghosts). */
void fg__stepper_arrays(fg__stepper *stepper, fg__state_array out[FG__STATE_ARRAYS]);

#endif
