/* Features of the library in this build, and checks that depend on them. */
#ifndef BUILD_FEATURES_H
#define BUILD_FEATURES_H

#include "option/settings.h"

/* Prints the version, the features of this build and those that it lacks. */
void print_version(void);

/* Prints an error that names `what` where a feature is lacking; returns an exit code. */
int require_feature(const char *what, fg_feature feature);

/* The picture formats (bits, FORMAT_SVG, ...) for each scale: the `requested` ones, or
 * the defaults; none where this build cannot draw. */
unsigned formats_to_draw(unsigned requested, bool solid);

/* Prints an error where requested pictures cannot be drawn; returns an exit code. */
int refuse_undrawable(unsigned requested, bool background, bool solid);

#endif
