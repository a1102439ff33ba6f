#include "alternatives.h"

#include <string.h>

#include "report/reading.h"

int complain_of_field(const fg_context *failed, fg_status status, fg_input *input,
                      const reading_settings *settings)
{
  reading_facts facts = {.times = 0};
  /* an argument's fault is one of the values where a field could not be made of them */
  const bool of_data = status == FG_STATUS_FILE_FORMAT ||
                       (status == FG_STATUS_ARGUMENT &&
                        strncmp(fg_context_message(failed), "field: ", 7) == 0);
  const int code = complain_of(failed, status, settings->input);
  if (!input || !of_data || *fg_context_hint(failed) || settings->map.has_region)
    return code;
  reading_find(&facts, input);
  const int other = settings->time == 0 ? 1 : 0;
  if (facts.times > 1)
    advise("Choose another with --time%s, as --time %d; flowgrain info lists them.",
           facts.levels > 1 ? " or --level" : "", other);
  else if (facts.levels > 1)
    advise("Choose another with --level; flowgrain info lists them.");
  return code;
}
