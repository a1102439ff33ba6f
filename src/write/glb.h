/* Icons in 3D as glTF 2.0, binary. */
#ifndef FG__GLB_WRITE_H
#define FG__GLB_WRITE_H

#include "base/context.h"

/* fg_solid_write of a .glb. field: may be NULL. */
fg_status fg__glb_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_icons *icons, const fg_solid_options *options);

#endif
