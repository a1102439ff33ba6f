/* Files of icons in 3D, by the end of their names. */
#include "picture/render/solid_picture.h"
#include "write/glb.h"
#include "write/vtp.h"

#include <string.h>

static bool ends_with(const char *path, const char *end)
{
  size_t length = strlen(path), wanted = strlen(end);
  return length > wanted && strcmp(path + length - wanted, end) == 0;
}

fg_status fg_solid_write(fg_context *context, const char *path, const fg_field *field,
                         const fg_icons *icons, const fg_solid_options *options)
{
  static const fg_solid_options defaults = {0};
  if (!path || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "solids: %s to write",
                    path ? "none" : "no file name");
  options = options ? options : &defaults;
  if (ends_with(path, ".vtp"))
    return fg__vtp_write(context, path, field, icons, options->surface);
  if (ends_with(path, ".glb"))
    return fg__glb_write(context, path, field, icons, options);
  if (!field)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: solids without a field are written as .vtp or .glb", path);
  return fg__solid_picture_write(context, path, field, icons, options);
}
