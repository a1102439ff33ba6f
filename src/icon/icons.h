/* The list of icons, as the modules that fill it see it. */
#ifndef FG__ICONS_H
#define FG__ICONS_H

#include "base/context.h"

/* Makes an empty list. MEMORY. */
fg_status fg__icons_create_empty(fg_icons **out, fg_context *context);

/* Adds a copy of an icon, its points included. MEMORY. */
fg_status fg__icons_add(fg_icons *icons, fg_context *context, const fg_icon *icon);

/* Copies a list, but for its score and critical points. MEMORY. */
fg_status fg__icons_copy(fg_icons **out, fg_context *context, const fg_icons *icons);

/* Of icons in degrees. */
#define FG__DEGREES "+proj=longlat"

/* Says which plane the icons are of: a PROJ string or NULL. MEMORY. */
fg_status fg__icons_set_projection(fg_icons *icons, fg_context *context,
                                   const char *projection);

/* The plane of a field, as icons have it; NULL: none. */
const char *fg__icons_plane_of(const fg_field *field);

/* Says how many clusters there were, and how many of them gave no icon. */
void fg__icons_set_clusters(fg_icons *icons, int clusters, int dropped);

/* An icon to be changed in all but its lines. */
fg_icon *fg__icons_change(fg_icons *icons, int index);

/* The id that the next new icon of a chain of scales gets; 0 for icons not placed. */
void fg__icons_set_next_id(fg_icons *icons, int next_id);
int fg__icons_next_id(const fg_icons *icons);

#endif
