/* In builds without the page for browsers. */
#include "base/feature.h"
#include "flowgrain/flowgrain.h"

fg_status fg_view_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_view_options *options)
{
  (void)options;
  if (!path || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "page: a NULL argument");
  return fg__fail_absent(context, path, FG_FEATURE_VIEWER);
}
