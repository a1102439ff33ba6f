/* Arrows too small to be seen beside the others. */
#ifndef FG__SPECKS_H
#define FG__SPECKS_H

#include "flowgrain/flowgrain.h"

/* Ends the icons of [count] (those without points are none) that are far shorter than the
 * median and stand for far less than the mean area. A small arrow of a large cluster
 * stays, and so does one far from all others: without it there would be a hole.
 * MEMORY. */
fg_status fg__icons_drop_specks(fg_icon *icon, fg_context *context, int count);

#endif
