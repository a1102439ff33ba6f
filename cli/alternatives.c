#include "alternatives.h"

#include <string.h>

#include "inputs.h"

void count_alternatives(int *times, int *levels, const char *input,
                        const fg_read_options *options)
{
  fg_context *context;
  fg_inventory *inventory = NULL;
  if (fg_context_create(&context))
    return;
  inputs_give(context);
  if (!fg_inventory_read_chosen(&inventory, context, input, options) &&
      fg_inventory_vector_count(inventory) > 0) {
    const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
    *times = vector->times;
    *levels = vector->levels;
  }
  fg_inventory_destroy(inventory);
  fg_context_destroy(context);
}

void advise_alternatives(const fg_context *failed, fg_status status, const char *input,
                         const fg_read_options *options)
{
  int times = 0, levels = 0;
  /* an argument's fault is one of the values where a field could not be made of them */
  const bool of_data = status == FG_STATUS_FILE_FORMAT ||
                       (status == FG_STATUS_ARGUMENT &&
                        strncmp(fg_context_message(failed), "field: ", 7) == 0);
  if (!of_data || *fg_context_hint(failed))
    return;
  count_alternatives(&times, &levels, input, options);
  const int other = options->time == 0 ? 1 : 0;
  if (times > 1)
    advise("Choose another with --time%s, as --time %d; flowgrain info lists them.",
           levels > 1 ? " or --level" : "", other);
  else if (levels > 1)
    advise("Choose another with --level; flowgrain info lists them.");
}
