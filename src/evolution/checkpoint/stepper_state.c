#include "evolution/checkpoint/stepper_state.h"

#include <stddef.h>
#include <string.h>

#define VALUE(name, kind)                                                                \
  {                                                                                      \
    "stepper." #name, FG__VALUE_##kind, offsetof(fg__stepper, name)                      \
  }

/* What is not here follows from field and options: sums over the domain, the mean that is
 * held, the bounds of steps. */
const fg__named_value fg__stepper_values[] = {
    VALUE(accepted, INT64),    VALUE(rejected, INT64), VALUE(cycles_spent, INT64),
    VALUE(quiet_steps, INT64), VALUE(history, FLAG),   VALUE(time, REAL),
    VALUE(tau, REAL),          VALUE(last_tau, REAL),  VALUE(tau_limit, REAL),
    VALUE(energy, REAL),       VALUE(mass, REAL),      VALUE(increment, REAL),
    VALUE(persistence, REAL),
};
const size_t fg__stepper_value_count =
    sizeof fg__stepper_values / sizeof fg__stepper_values[0];

static fg__state_array array_of(const fg__multigrid *multigrid, const char *name,
                                int grid, float *values)
{
  fg__state_array array = {.name = name, .grid = grid, .values = values};
  if (multigrid->spread_count > 0) {
    array.spread = &multigrid->spread[grid];
    array.level = &array.spread->block;
    array.block = *fg__own_block(&array.spread->partition);
    memcpy(array.whole.nodes, array.spread->partition.nodes, sizeof array.whole.nodes);
  } else {
    array.level = &multigrid->level[grid];
    memcpy(array.whole.nodes, array.level->layout.nodes, sizeof array.whole.nodes);
    array.block = array.whole;
  }
  return array;
}

/* With history, a step starts from the change since the previous density, and the
 * last potential (prepare_implicit in stepper.c). */
void fg__stepper_arrays(fg__stepper *stepper, fg__state_array out[FG__STATE_ARRAYS])
{
  const fg__multigrid *m = &stepper->multigrid;
  out[0] = array_of(m, "current", 0, stepper->current);
  out[1] = array_of(m, "previous", 0, stepper->previous);
  out[2] = array_of(m, "potential", 0, fg__multigrid_w(m));
}

void fg__state_export(const fg__state_array *array, float *plain)
{
  fg__level_export(array->level, array->values, plain);
}

void fg__state_import(const fg__state_array *array, const float *plain)
{
  fg__level_import(array->level, array->values, plain);
}

void fg__state_fill_ghosts(const fg__state_array *array)
{
  float *values = array->values;
  if (array->spread)
    fg__spread_exchange(array->spread, 1, &values, FG__ALL_COLOURS);
  else
    fg__fill_ghosts(array->level, values);
}
