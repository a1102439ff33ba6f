/* The texture in the background of icons. */
#ifndef DRAWN_BACKGROUND_H
#define DRAWN_BACKGROUND_H

#include "option/settings.h"

/* Refuses a --background that is not available. Returns an exit code. */
int background_check(const picture_settings *settings, int ranks);

/* Whether the background shows clusters. */
bool background_needs_density(const picture_settings *settings);

/* Makes the background of the settings (possibly none) with this number of pixels.
 * *texture: that of the last picture, reused if possible, or NULL at first; the caller
 * destroys it. */
fg_status background_make(fg_texture **texture, fg_context *context,
                          const picture_settings *settings, int threads,
                          const int size[2], const fg_field *field,
                          const fg_density *density);

/* Sets a picture's background to that of the settings, at the pixels of its frame.
 * *texture: that of the last picture, reused if possible, or NULL at first; the caller
 * destroys it. density: the clusters of this picture, or NULL. */
fg_status background_choose(fg_picture_options *options, fg_texture **texture,
                            fg_context *context, const picture_settings *settings,
                            int threads, const fg_field *field, const fg_density *density,
                            const fg_icons *icons);

/* The key of a background of speeds runs from 0 to its fastest, unless the user says
 * otherwise: forgets the range that the run has for its arrows. */
void background_range(fg_picture_options *options, const picture_settings *settings);

#endif
