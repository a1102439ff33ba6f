#include "evolution/checkpoint/stepper_state.h"

#include <stddef.h>
#include <string.h>

#include "solver/passes.h"

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
    VALUE(persistence, REAL),  VALUE(chemical, REAL),
};
const size_t fg__stepper_value_count =
    sizeof fg__stepper_values / sizeof fg__stepper_values[0];

static fg__state_array array_of(const fg__multigrid *multigrid, const char *name,
                                float *values)
{
  const fg__partition *partition = &multigrid->partition;
  fg__state_array array = {.name = name,
                           .block = *fg__own_block(partition),
                           .level = fg__multigrid_finest(multigrid),
                           .multigrid = multigrid,
                           .values = values};
  memcpy(array.whole.nodes, partition->nodes, sizeof array.whole.nodes);
  return array;
}

/* With history, a step starts from the change since the previous density, and the
 * last potential (prepare_implicit in stepper.c). */
void fg__stepper_arrays(fg__stepper *stepper, fg__state_array out[FG__STATE_ARRAYS])
{
  const fg__multigrid *m = &stepper->multigrid;
  out[0] = array_of(m, "current", stepper->current);
  out[1] = array_of(m, "previous", stepper->previous);
  out[2] = array_of(m, "potential", fg__multigrid_w(m));
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
  fg__pass_fill_ghosts(array->multigrid, array->values);
}
