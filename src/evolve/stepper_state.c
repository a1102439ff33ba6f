#include "evolve/stepper_state.h"

#include <stddef.h>

#define VALUE(name, kind)                                                                \
  {                                                                                      \
    "stepper." #name, FG__VALUE_##kind, offsetof(fg__stepper, name)                      \
  }

/* What is not here follows from field and options: sums over the domain, the mean that is
 * held, the bounds of steps. */
const fg__named_value fg__stepper_values[] = {
    VALUE(accepted, LONG),    VALUE(rejected, LONG), VALUE(cycles_spent, LONG),
    VALUE(quiet_steps, LONG), VALUE(history, FLAG),  VALUE(time, REAL),
    VALUE(tau, REAL),         VALUE(last_tau, REAL), VALUE(tau_limit, REAL),
    VALUE(energy, REAL),      VALUE(mass, REAL),     VALUE(increment, REAL),
    VALUE(persistence, REAL),
};
const size_t fg__stepper_value_count =
    sizeof fg__stepper_values / sizeof fg__stepper_values[0];

/* With history, a step starts from the change since the previous density, and the
 * last potential (prepare_implicit in stepper.c). */
void fg__stepper_arrays(fg__stepper *stepper, fg__state_array out[FG__STATE_ARRAYS])
{
  const fg__level *level = stepper->multigrid.level;
  out[0] = (fg__state_array){"current", 0, level, stepper->current};
  out[1] = (fg__state_array){"previous", 0, level, stepper->previous};
  out[2] = (fg__state_array){"potential", 0, level, level->w};
}
