/* Pictures of icons in 3D. */
#ifndef FG__SOLID_PICTURE_H
#define FG__SOLID_PICTURE_H

#include "base/context.h"

/* fg_solid_write of a .png. */
fg_status fg__solid_picture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_icons *icons,
                                  const fg_solid_options *options);

#endif
