/* Critical points of the field at the scale of icons. */
#ifndef DRAWN_FEATURES_H
#define DRAWN_FEATURES_H

#include "option/settings.h"

/* Finds them and stores them with the icons, where the settings say --features. */
fg_status features_add(fg_context *context, const fg_field *field, fg_icons *icons,
                       const picture_settings *settings, int threads);

#endif
