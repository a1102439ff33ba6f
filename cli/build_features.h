/* What the library in use can do, and what follows from that. */
#ifndef BUILD_FEATURES_H
#define BUILD_FEATURES_H

#include "option/settings.h"

/* Prints the version, the features that are there and those that are not. */
void print_version(void);

/* Complains of `what` where a feature is lacking; an exit code. */
int require_feature(const char *what, fg_feature feature);

/* The formats of pictures (bits, FORMAT_SVG, ...) that each scale gets: the `requested`
 * ones, or the defaults; none where pictures cannot be drawn. */
unsigned formats_to_draw(unsigned requested, bool solid);

/* Complains where pictures are requested that cannot be drawn; an exit code. */
int refuse_undrawable(unsigned requested, bool background, bool solid);

#endif
