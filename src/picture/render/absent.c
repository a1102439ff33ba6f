/* In builds that draw nothing in 3D. */
#include "base/feature.h"
#include "picture/render/solid_picture.h"

fg_status fg__solid_picture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_icons *icons,
                                  const fg_solid_options *options)
{
  (void)field;
  (void)icons;
  (void)options;
  return fg__fail_absent(context, path, FG_FEATURE_RENDER);
}
