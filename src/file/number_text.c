#include "file/number_text.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

bool fg__number_locale_begin(fg__number_locale *locale)
{
  locale->plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!locale->plain)
    return false;
  locale->before = uselocale(locale->plain);
  return true;
}

void fg__number_locale_end(fg__number_locale *locale)
{
  uselocale(locale->before);
  freelocale(locale->plain);
}

static const char *skip_space(const char *text)
{
  while (*text == ' ' || *text == '\t' || *text == '\n' || *text == '\r')
    ++text;
  return text;
}

bool fg__number_read_list(double *out, size_t count, const char *text)
{
  fg__number_locale locale;
  if (!text || !fg__number_locale_begin(&locale))
    return false;
  bool good = true;
  for (size_t i = 0; good && i < count; ++i) {
    char *end = NULL;
    out[i] = strtod(text, &end);
    good = end != text && isfinite(out[i]);
    text = end;
  }
  fg__number_locale_end(&locale);
  return good && *skip_space(text) == '\0';
}

bool fg__number_read_integers(int *out, size_t count, const char *text)
{
  if (!text)
    return false;
  for (size_t i = 0; i < count; ++i) {
    char *end = NULL;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (end == text || errno != 0 || value < INT_MIN || value > INT_MAX)
      return false;
    out[i] = (int)value;
    text = end;
  }
  return *skip_space(text) == '\0';
}
