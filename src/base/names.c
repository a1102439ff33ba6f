#include "base/names.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST_SHOWN = 12, MORE_BYTES = 32 /* of " and 5000 more" */ };

/* Appends a name where it fits whole. */
static bool show(fg__names *names, const char *between, const char *name)
{
  const size_t gap = names->shown > 0 ? strlen(between) : 0, length = strlen(name);
  if (names->used + gap + length + MORE_BYTES > sizeof names->text)
    return false;
  memcpy(names->text + names->used, between, gap);
  memcpy(names->text + names->used + gap, name, length + 1);
  names->used += gap + length;
  ++names->shown;
  return true;
}

void fg__names_add(fg__names *names, const char *between, const char *format, ...)
{
  char name[FG__NAMES_BYTES];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(name, sizeof name, format, arguments);
  va_end(arguments);
  const bool all_shown = names->shown == names->count++;
  if (!all_shown || names->shown == MOST_SHOWN || !show(names, between, name))
    snprintf(names->text + names->used, sizeof names->text - names->used, "%s%zu more",
             names->used > 0 ? " and " : "", names->count - names->shown);
}
