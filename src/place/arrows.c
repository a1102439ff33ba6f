/* From a field to its arrows in one call. */
#include "base/context.h"
#include "flowgrain/placement.h"

enum { COUNT = 40 };

fg_status fg_arrows_create(fg_icons **out, fg_context *context, const fg_field *field,
                           const fg_arrows_options *options)
{
  const fg_arrows_options chosen = options ? *options : (fg_arrows_options){0};
  const fg_placement_options how = {
      .lengths = chosen.lengths, .effort = chosen.effort, .threads = chosen.threads};
  fg_placement *placement = NULL;
  if (!out)
    return fg__fail(context, FG_STATUS_ARGUMENT, "arrows: no place for the result given");
  *out = NULL;
  fg_status status = fg_placement_create(&placement, context, field, &how);
  if (status == FG_STATUS_OK)
    status =
        fg_placement_place(placement, chosen.count != 0 ? chosen.count : COUNT, NULL);
  if (status == FG_STATUS_OK)
    status = fg_placement_icons(out, placement);
  fg_placement_destroy(placement);
  return status;
}
