/* Icons in 3D as VTK XML polydata. */
#ifndef FG__VTP_WRITE_H
#define FG__VTP_WRITE_H

#include "base/context.h"
#include "flowgrain/solid.h"

/* What a cell is: its array `part`. */
typedef enum fg__vtp_part {
  FG__VTP_CENTER = 0,
  FG__VTP_SPINE,
  FG__VTP_STREAMLINE,
  FG__VTP_ARROW,
  FG__VTP_CLUSTER
} fg__vtp_part;

/* fg_solid_write of a .vtp. field: may be NULL. surface: of all clusters, or NULL. */
fg_status fg__vtp_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_icons *icons, const fg_surface *surface);

#endif
