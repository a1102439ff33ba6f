/* In builds that draw nothing. */
#include "base/feature.h"
#include "flowgrain/flowgrain.h"

fg_status fg_picture_frame(int size[2], fg_context *context, const fg_field *field,
                           const fg_icons *icons, const fg_picture_options *options)
{
  (void)options;
  if (!size || !field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "picture: a NULL argument");
  return fg__fail_absent(context, "picture", FG_FEATURE_PICTURES);
}

fg_status fg_picture_write(fg_context *context, const char *path, const fg_field *field,
                           const fg_density *density, const fg_icons *icons,
                           const fg_picture_options *options)
{
  (void)density;
  (void)options;
  if (!path || !field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "picture: a NULL argument");
  return fg__fail_absent(context, path, FG_FEATURE_PICTURES);
}

fg_status fg_panels_write(fg_context *context, const char *path, const fg_panel *panels,
                          int count, const fg_picture_options *options)
{
  (void)options;
  if (!path || !panels || count < 1)
    return fg__fail(context, FG_STATUS_ARGUMENT, "panels: a NULL argument");
  return fg__fail_absent(context, path, FG_FEATURE_PICTURES);
}

fg_status fg_panels_frame(int size[2], fg_context *context, const fg_panel *panels,
                          int count, const fg_picture_options *options)
{
  (void)options;
  if (!size || !panels || count < 1)
    return fg__fail(context, FG_STATUS_ARGUMENT, "panels: a NULL argument");
  return fg__fail_absent(context, "panels", FG_FEATURE_PICTURES);
}

fg_status fg_texture_write(fg_context *context, const char *path, const fg_field *field,
                           const fg_texture *texture, const fg_texture_style *style)
{
  (void)style;
  if (!path || !field || !texture)
    return fg__fail(context, FG_STATUS_ARGUMENT, "texture: a NULL argument");
  return fg__fail_absent(context, path, FG_FEATURE_PICTURES);
}

fg_status fg_painting_write(fg_context *context, const char *path, const fg_image *image,
                            const fg_strokes *strokes, const fg_painting_options *options)
{
  (void)options;
  if (!path || !image || !strokes)
    return fg__fail(context, FG_STATUS_ARGUMENT, "painting: a NULL argument");
  return fg__fail_absent(context, path, FG_FEATURE_PICTURES);
}
