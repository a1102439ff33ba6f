/* The texture behind the icons. */
#ifndef RUN_BACKGROUND_H
#define RUN_BACKGROUND_H

#include "option/settings.h"

/* Refuses what the command line's --background can not be drawn with. Returns an exit
 * code. */
int background_check(const picture_settings *settings, int ranks);

/* Whether it shows the clusters. */
bool background_needs_density(const picture_settings *settings);

/* Makes the background that the settings choose, none included, with so many pixels.
 * *texture: the last picture's, kept when it fits, or NULL at first; the caller ends it.
 */
fg_status background_make(fg_texture **texture, fg_context *context,
                          const picture_settings *settings, int threads,
                          const int size[2], const fg_field *field,
                          const fg_density *density);

/* Gives a picture's options the background that the settings choose, at the pixels of
 * its frame. *texture: the last picture's, kept when it fits, or NULL at first; the
 * caller ends it. density: the clusters of this picture, or NULL. */
fg_status background_choose(fg_picture_options *options, fg_texture **texture,
                            fg_context *context, const picture_settings *settings,
                            int threads, const fg_field *field, const fg_density *density,
                            const fg_icons *icons);

#endif
