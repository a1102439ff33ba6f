/* The icon of one cluster, in 2D or 3D. */
#ifndef FG__MAKE_H
#define FG__MAKE_H

#include "icon/choose.h"

/* Fits an arrow into the cluster of a window (docs/method/icons.md, solid.md), made
 * smaller until it lies inside: in 2D its outline, which is simple, in 3D every vertex of
 * its solid (fg_icon_solid). Fills in all of the icon but the area; points stays NULL
 * when no arrow fits. fg__icon_free ends its arrays. MEMORY. */
fg_status fg__icon_make(fg_icon *out, fg_context *context, fg__chooser *chooser,
                        const fg_field *field, const fg__window *window);
void fg__icon_free(fg_icon *icon);

#endif
