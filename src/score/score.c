/* The scores of icons as a picture of a field. */
#include "base/context.h"

fg_status fg_icons_score(fg_score *out, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_score_options *options)
{
  (void)options;
  if (!out || !field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: no field or no icons");
  *out = (fg_score){0};
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "score: not there yet");
}
