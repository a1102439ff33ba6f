/* Units in files ("m s**-1", "centimeter/s", "degrees_north") and on axis labels ("m/s",
 * "cm/s", "°N"). */
#include "interpret/interpret.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef enum unit_kind {
  LENGTH,
  TIME,
  DEGREE,
  RADIAN,
  SPEED,
  PRESSURE,
  EAST,
  NORTH
} unit_kind;

typedef struct unit {
  unit_kind kind;
  double seconds; /* of a unit of time */
  const char *label;
  const char *words; /* separated by |, lower case, singular */
} unit;

static const unit UNITS[] = {
    {LENGTH, 0.0, "m", "m|meter|metre"},
    {LENGTH, 0.0, "km", "km|kilometer|kilometre"},
    {LENGTH, 0.0, "dm", "dm|decimeter|decimetre"},
    {LENGTH, 0.0, "cm", "cm|centimeter|centimetre"},
    {LENGTH, 0.0, "mm", "mm|millimeter|millimetre"},
    {LENGTH, 0.0, "µm", "um|micrometer|micrometre|micron"},
    {LENGTH, 0.0, "ft", "ft|foot|feet"},
    {LENGTH, 0.0, "mi", "mi|mile"},
    {LENGTH, 0.0, "nmi", "nmi|nautical_mile|nautical mile"},
    {TIME, 1.0, "s", "s|sec|second"},
    {TIME, 1e-3, "ms", "ms|msec|millisec|millisecond"},
    {TIME, 60.0, "min", "min|minute"},
    {TIME, 3600.0, "h", "h|hr|hour"},
    {TIME, 86400.0, "d", "d|day"},
    {DEGREE, 0.0, "°", "deg|degree|arc_degree"},
    {RADIAN, 0.0, "rad", "rad|radian"},
    {SPEED, 0.0, "kn", "kn|kt|knot"},
    {PRESSURE, 0.0, "Pa", "pa|pascal"},
    {PRESSURE, 0.0, "hPa", "hpa|hectopascal|mb|mbar|millibar"},
    {PRESSURE, 0.0, "kPa", "kpa|kilopascal"},
    {PRESSURE, 0.0, "dbar", "dbar|decibar"},
    {PRESSURE, 0.0, "bar", "bar"},
    {EAST, 0.0, "°E",
     "degree_east|degrees_east|degrees east|degrees-east|degreeseast|"
     "degree_e|degrees_e|degreee|degreese"},
    {NORTH, 0.0, "°N",
     "degree_north|degrees_north|degrees north|degrees-north|degreesnorth|"
     "degree_n|degrees_n|degreen|degreesn"},
};

static bool is_one_of(const char *words, const char *word, size_t length)
{
  for (size_t n; *words; words += n + (words[n] == '|')) {
    n = strcspn(words, "|");
    if (n == length && memcmp(words, word, n) == 0)
      return true;
  }
  return false;
}

/* The unit of a word, singular or plural; NULL: unknown. */
static const unit *find_unit(const char *word)
{
  const size_t length = strlen(word);
  const bool plural = length > 2 && word[length - 1] == 's';
  for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; ++i)
    if (is_one_of(UNITS[i].words, word, length) ||
        (plural && is_one_of(UNITS[i].words, word, length - 1)))
      return &UNITS[i];
  return NULL;
}

/* Copies units in lower case, with ASCII substitutes for other characters. */
static void simplify(const char *units, char out[FG__TEXT_BYTES])
{
  static const struct {
    const char *sign;
    const char *plain;
  } signs[] = {{"°", "deg"}, {"µ", "u"}, {"μ", "u"}, {"·", "."}, {"⁻", "-"}, {"¹", "1"}};
  enum { SIGNS = sizeof signs / sizeof *signs, LONGEST = 3 };
  size_t n = 0;
  while (*units && n + LONGEST < FG__TEXT_BYTES) {
    size_t s = 0;
    while (s < SIGNS && strncmp(units, signs[s].sign, strlen(signs[s].sign)) != 0)
      ++s;
    if (s < SIGNS) {
      memcpy(out + n, signs[s].plain, strlen(signs[s].plain));
      n += strlen(signs[s].plain);
      units += strlen(signs[s].sign);
    } else {
      out[n++] = (char)tolower((unsigned char)*units++);
    }
  }
  out[n] = '\0';
}

/* Splits "centimeter/s", "m s-1", "m.s^-1", "m per second" into numerator and
 * denominator; false unless each is one word. */
static bool split_quotient(const char *c, char above[FG__TEXT_BYTES],
                           char below[FG__TEXT_BYTES])
{
  int sign = 1; /* of the next word's exponent */
  above[0] = below[0] = '\0';
  while (*(c += strspn(c, " .*(){}"))) {
    if (*c == '/') {
      sign = -1;
      ++c;
      continue;
    }
    const char *word = c;
    while (isalpha((unsigned char)*c) || *c == '_')
      ++c;
    const size_t length = (size_t)(c - word);
    if (length == 0)
      return false;
    if (length == 3 && memcmp(word, "per", 3) == 0) {
      sign = -1;
      continue;
    }
    const char *number = c + strspn(c, "*^({");
    long power = 1;
    if (isdigit((unsigned char)*number) || *number == '-') {
      char *end;
      power = strtol(number, &end, 10);
      c = end > number ? end : number + 1;
    }
    char *part = power == sign ? above : power == -sign ? below : NULL;
    if (!part || part[0] || length >= FG__TEXT_BYTES)
      return false;
    memcpy(part, word, length);
    part[length] = '\0';
    sign = 1;
  }
  return above[0] && below[0];
}

static fg__quantity find_quotient(const char *plain, char *label, size_t size)
{
  char above[FG__TEXT_BYTES];
  char below[FG__TEXT_BYTES];
  if (!split_quotient(plain, above, below))
    return FG__QUANTITY_UNKNOWN;
  const unit *way = find_unit(above);
  const unit *time = find_unit(below);
  if (!way || !time || time->kind != TIME)
    return FG__QUANTITY_UNKNOWN;
  const bool angle = way->kind == DEGREE || way->kind == RADIAN;
  if (!angle && way->kind != LENGTH)
    return FG__QUANTITY_UNKNOWN;
  snprintf(label, size, "%s/%s", way->label, time->label);
  return angle ? FG__QUANTITY_ANGULAR_SPEED : FG__QUANTITY_SPEED;
}

bool fg__units_seconds(const char *units, double *out)
{
  char plain[FG__TEXT_BYTES];
  simplify(units, plain);
  const unit *found = find_unit(plain);
  *out = found ? found->seconds : 0.0;
  return *out > 0.0;
}

fg__quantity fg__units_read(const char *units, char *label, size_t size)
{
  static const fg__quantity quantity[] = {
      [LENGTH] = FG__QUANTITY_LENGTH,     [TIME] = FG__QUANTITY_UNKNOWN,
      [DEGREE] = FG__QUANTITY_DEGREES,    [RADIAN] = FG__QUANTITY_UNKNOWN,
      [SPEED] = FG__QUANTITY_SPEED,       [PRESSURE] = FG__QUANTITY_PRESSURE,
      [EAST] = FG__QUANTITY_DEGREES_EAST, [NORTH] = FG__QUANTITY_DEGREES_NORTH,
  };
  char plain[FG__TEXT_BYTES];
  simplify(units, plain);
  snprintf(label, size, "%s", units);
  if (strstr(plain, " since ") || strcasecmp(units, FG__ABSOLUTE_DATES) == 0)
    return FG__QUANTITY_DATE;
  const unit *found = find_unit(plain);
  if (!found)
    return find_quotient(plain, label, size);
  if (quantity[found->kind] != FG__QUANTITY_UNKNOWN)
    snprintf(label, size, "%s", found->label);
  return quantity[found->kind];
}
