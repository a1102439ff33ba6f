/* Options without effect on what a command does are wrong usage. */
#ifndef OPTION_VALIDATION_H
#define OPTION_VALIDATION_H

#include "option/settings.h"

/* An option that does not fit, and whether it was given. */
typedef struct given_option {
  const char *name;
  bool given;
} given_option;

/* Complains of the first of `count` options that was given: "--NAME: WHY". Returns an
 * exit code. */
int refuse_given(const char *command, const given_option *option, size_t count,
                 const char *why, ...) __attribute__((format(printf, 4, 5)));

/* Refuses what a picture of a field in so many dimensions can not show; `name` is what
 * the user calls the field. */
int refuse_other_dimension(const char *command, const picture_settings *settings,
                           int dimension, const char *name);

#endif
