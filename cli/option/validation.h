/* Refuses options that have no effect. */
#ifndef OPTION_VALIDATION_H
#define OPTION_VALIDATION_H

#include "option/settings.h"

/* An option that does not apply, and whether it was given. */
typedef struct given_option {
  const char *name;
  bool given;
} given_option;

/* Prints "--NAME: WHY" for the first of `count` options that was given. Returns an exit
 * code. */
int refuse_given(const char *command, const given_option *option, size_t count,
                 const char *why, ...) __attribute__((format(printf, 4, 5)));

/* Refuses options of pictures that do not apply to a field of this dimension; `name` is
 * the user's name of the field. Returns an exit code. */
int refuse_other_dimension(const char *command, const picture_settings *settings,
                           int dimension, const char *name);

#endif
