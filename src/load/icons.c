/* Icons of a file of GeoJSON. */
#include "icon/icons.h"
#include "read/geojson.h"

static fg_status fill(fg_icons *icons, fg_context *context, const fg__icon_list *list)
{
  for (size_t n = 0; n < list->count; ++n) {
    fg_status status = fg__icons_add(icons, context, &list->icon[n]);
    if (status != FG_STATUS_OK)
      return status;
  }
  fg__icons_set_clusters(icons, list->clusters, list->dropped);
  fg__icons_set_next_id(icons, list->next_id);
  if (list->projection) {
    fg_status status = fg__icons_set_projection(icons, context, list->projection);
    if (status != FG_STATUS_OK)
      return status;
  }
  if (list->scored)
    fg_icons_keep_score(icons, &list->score);
  return FG_STATUS_OK;
}

fg_status fg_icons_read(fg_icons **out, fg_context *context, const char *path)
{
  if (!out || !path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no file to read icons from");
  *out = NULL;
  fg__source source;
  fg__icon_list list = {0};
  fg_icons *icons = NULL;
  fg_status status = fg__source_open(&source, context, path);
  if (status == FG_STATUS_OK)
    status = fg__icon_list_read(&list, context, &source);
  status = fg__source_close(&source, context, status);
  if (status == FG_STATUS_OK)
    status = fg__icons_create_empty(&icons, context);
  if (status == FG_STATUS_OK)
    status = fill(icons, context, &list);
  fg__icon_list_clear(&list);
  if (status == FG_STATUS_OK)
    *out = icons;
  else
    fg_icons_destroy(icons);
  return status;
}
