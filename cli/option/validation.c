#include "option/validation.h"

#include <stdarg.h>
#include <stdio.h>

enum { WHY_BYTES = 1024 };

int refuse_given(const char *command, const given_option *option, size_t count,
                 const char *why, ...)
{
  size_t k = 0;
  while (k < count && !option[k].given)
    ++k;
  if (k == count)
    return EXIT_DONE;
  char text[WHY_BYTES];
  va_list arguments;
  va_start(arguments, why);
  vsnprintf(text, sizeof text, why, arguments);
  va_end(arguments);
  complain("--%s: %s", option[k].name, text);
  advise("Try 'flowgrain %s --help'.", command);
  return EXIT_USAGE;
}

int refuse_other_dimension(const char *command, const picture_settings *settings,
                           int dimension, const char *name)
{
  const given_option flat[] = {
      {"tint", settings->tint},
      {"background", settings->background != 0},
      {"skeletons", settings->skeletons},
      {"centers", settings->centers},
      {"features", settings->features},
      {"no-arrows", settings->no_arrows},
      {"mask-color", settings->mask_color != NULL},
      {"tint-color", settings->tint_color != NULL},
      {"background-fade", settings->background_fade > 0.0},
      {"no-coast", settings->no_coast},
      {"land", settings->land != NULL},
      {"borders", settings->borders},
  };
  const given_option solid[] = {
      {"view", settings->view_count > 0},
      {"surfaces", settings->surfaces},
  };
  if (dimension == 3)
    return refuse_given(command, flat, sizeof flat / sizeof flat[0],
                        "only in 2D, and %s is in 3D", name);
  return refuse_given(command, solid, sizeof solid / sizeof solid[0],
                      "only in 3D, and %s is in 2D", name);
}
