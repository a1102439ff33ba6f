/* Icons in 3D as VTK XML polydata. */
#ifndef FG__VTP_WRITE_H
#define FG__VTP_WRITE_H

#include "base/context.h"

/* What a cell is: its array `part`. */
typedef enum fg__vtp_part {
  FG__VTP_CENTER = 0,
  FG__VTP_SPINE,
  FG__VTP_STREAMLINE,
  FG__VTP_ARROW
} fg__vtp_part;

/* fg_solid_write of a .vtp. */
fg_status fg__vtp_write(fg_context *context, const char *path, const fg_icons *icons);

#endif
