/* The texture behind the icons. */
#ifndef BACKGROUND_H
#define BACKGROUND_H

#include "program.h"

/* Refuses what the command line's --background can not be drawn with. Returns an exit
 * code. */
int background_check(const cli_settings *settings, int ranks);

/* Whether it shows the clusters. */
bool background_needs_density(const cli_settings *settings);

/* Gives a picture's options the background that the settings ask for, at the pixels of
 * its frame. *texture: the last picture's, kept when it fits, or NULL at first; the
 * caller ends it. density: the clusters of this picture, or NULL. */
fg_status background_choose(fg_picture_options *options, fg_texture **texture,
                            fg_context *context, const cli_settings *settings,
                            const fg_field *field, const fg_density *density,
                            const fg_icons *icons);

#endif
