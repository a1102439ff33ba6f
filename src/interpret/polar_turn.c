#include "interpret/polar.h"

#include "base/angle.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const double MOST_RADIANS = 720.0 * FG__RADIANS;

void fg__polar_turn(double vector[2], const fg__polar *polar)
{
  const double speed = vector[0], angle = vector[1] * polar->unit;
  const bool known = speed >= 0.0 && fabs(angle) <= MOST_RADIANS;
  vector[0] = known ? polar->sense * speed * sin(angle) : (double)NAN;
  vector[1] = known ? polar->sense * speed * cos(angle) : (double)NAN;
}

void fg__polar_turn_all(float *const vector[2], size_t count, const fg__polar *polar)
{
  for (size_t n = 0; n < count && polar->sense != 0; ++n) {
    double one[2] = {(double)vector[0][n], (double)vector[1][n]};
    fg__polar_turn(one, polar);
    vector[0][n] = (float)one[0];
    vector[1][n] = (float)one[1];
  }
}

void fg__polar_words(char *out, size_t size, const fg__polar *polar, const char *rule)
{
  snprintf(out, size, "of a speed and its direction %s, in %s clockwise from north: %s",
           polar->sense < 0 ? "from where it comes" : "to where it goes",
           polar->unit == 1.0 ? "radians" : "degrees", rule);
}

static bool contains(const char *text, const char *word)
{
  for (; *text; ++text)
    if (strncasecmp(text, word, strlen(word)) == 0)
      return true;
  return false;
}

/* Whether "to" is one of a name's words, as in wind_to_direction. */
static bool has_to(const char *name)
{
  for (const char *at = name; *at; ++at)
    if (strncasecmp(at, "to", 2) == 0 && !isalpha((unsigned char)at[2]) &&
        (at == name || !isalpha((unsigned char)at[-1])))
      return true;
  return false;
}

int fg__polar_sense(const char *name, const char *more)
{
  if (contains(name, "from") || contains(more, "from"))
    return -1;
  if (has_to(name) || contains(name, "toward") || contains(more, "toward"))
    return 1;
  /* dd is synoptic tables' wind, drct METAR archives' */
  return contains(name, "wind") || contains(more, "wind") ||
                 tolower((unsigned char)name[0]) == 'w' || contains(name, "drct") ||
                 strcasecmp(name, "dd") == 0
             ? -1
             : 1;
}

double fg__polar_unit(const char *units)
{
  static const char *const words[] = {"degrees", "degree", "deg", "°"};
  static const char *const after[] = {"t", "true", "from", "clockwise"};
  if (strcasecmp(units, "rad") == 0 || strcasecmp(units, "radian") == 0 ||
      strcasecmp(units, "radians") == 0)
    return 1.0;
  const char *rest = NULL;
  for (size_t i = 0; i < sizeof words / sizeof *words && !rest; ++i)
    if (strncasecmp(units, words[i], strlen(words[i])) == 0)
      rest = units + strlen(words[i]);
  if (!rest)
    return 0.0;
  rest += strspn(rest, " _.");
  const size_t length = strcspn(rest, " _");
  bool known = length == 0;
  for (size_t i = 0; i < sizeof after / sizeof *after; ++i)
    known =
        known || (strlen(after[i]) == length && strncasecmp(rest, after[i], length) == 0);
  return known ? FG__RADIANS : 0.0;
}
