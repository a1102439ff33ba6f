/* What the next steps depend on, beyond what the creation of a stepper from the same
 * field and options gives: everything that a checkpoint has to hold of it. */
#ifndef FG__STEPPER_STATE_H
#define FG__STEPPER_STATE_H

#include "evolution/checkpoint/named_values.h"
#include "evolution/stepper.h"

/* Numbers of an fg__stepper. */
extern const fg__named_value fg__stepper_values[];
extern const size_t fg__stepper_value_count;

/* An array of a level, of which this rank has a block. */
typedef struct fg__state_array {
  const char *name;
  int grid;               /* the level's number, 0 the finest */
  fg__box whole;          /* all nodes of the level */
  fg__box block;          /* those of this rank */
  const fg__level *level; /* of them */
  const fg__multigrid *multigrid;
  float *values;
} fg__state_array;

enum { FG__STATE_ARRAYS = 3 };

/* Lists the arrays; they are the stepper's own, for reading or for filling. */
void fg__stepper_arrays(fg__stepper *stepper, fg__state_array out[FG__STATE_ARRAYS]);

/* Between the block and its values alone, x fastest. */
void fg__state_export(const fg__state_array *array, float *plain);
void fg__state_import(const fg__state_array *array, const float *plain);

/* Fills the ghosts of the block. Collective. */
void fg__state_fill_ghosts(const fg__state_array *array);

#endif
