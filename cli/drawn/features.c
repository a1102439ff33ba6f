#include "drawn/features.h"

fg_status features_add(fg_context *context, const fg_field *field, fg_icons *icons,
                       const picture_settings *settings, int threads)
{
  fg_critical_points *points = NULL;
  const fg_critical_options options = {.count = fg_icons_count(icons),
                                       .threads = threads};
  if (!settings->features || options.count == 0)
    return FG_STATUS_OK;
  fg_status status = fg_critical_points_find(&points, context, field, &options);
  if (!status)
    fg_icons_keep_critical(icons, points);
  return status;
}
