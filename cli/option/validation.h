/* Options that were said, and say nothing about what is asked for, are wrong usage. */
#ifndef OPTION_VALIDATION_H
#define OPTION_VALIDATION_H

#include "option/settings.h"

/* An option that does not fit, and whether it was said. */
typedef struct unfit_option {
  const char *name;
  bool said;
} unfit_option;

/* Complains of the first of `count` options that was said: "--NAME: WHY". Returns an exit
 * code. */
int refuse_unfit(const char *command, const unfit_option *option, size_t count,
                 const char *why, ...) __attribute__((format(printf, 4, 5)));

/* Refuses what a picture of a field in so many dimensions can not show; `name` is what
 * the user calls the field. */
int refuse_other_dimension(const char *command, const picture_settings *settings,
                           int dimension, const char *name);

#endif
