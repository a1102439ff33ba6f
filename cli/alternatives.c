#include "alternatives.h"

#include <string.h>

#include "inputs.h"

void count_alternatives(int *times, int *levels, fg_input *input)
{
  fg_context *context;
  const fg_inventory *inventory = NULL;
  if (fg_context_create(&context))
    return;
  inputs_give(context);
  fg_input_inventory(&inventory, context, input);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  if (vector) {
    *times = vector->times;
    *levels = vector->levels;
  }
  fg_context_destroy(context);
}

int complain_of_field(const fg_context *failed, fg_status status, fg_input *input,
                      const reading_settings *settings)
{
  int times = 0, levels = 0;
  /* an argument's fault is one of the values where a field could not be made of them */
  const bool of_data = status == FG_STATUS_FILE_FORMAT ||
                       (status == FG_STATUS_ARGUMENT &&
                        strncmp(fg_context_message(failed), "field: ", 7) == 0);
  const int code = complain_of(failed, status, settings->input);
  if (!input || !of_data || *fg_context_hint(failed) || settings->map.has_region)
    return code;
  count_alternatives(&times, &levels, input);
  const int other = settings->time == 0 ? 1 : 0;
  if (times > 1)
    advise("Choose another with --time%s, as --time %d; flowgrain info lists them.",
           levels > 1 ? " or --level" : "", other);
  else if (levels > 1)
    advise("Choose another with --level; flowgrain info lists them.");
  return code;
}
