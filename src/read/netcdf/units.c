/* Units as files write them ("m s**-1", "centimeter/s", "degrees_north") and as an axis
 * label has them ("m/s", "cm/s", "°N"). */
#include "read/netcdf/netcdf.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

typedef struct unit_word {
  const char *word;
  const char *label;
} unit_word;

static const unit_word LENGTHS[] = {
    {"m", "m"},
    {"meter", "m"},
    {"metre", "m"},
    {"meters", "m"},
    {"metres", "m"},
    {"cm", "cm"},
    {"centimeter", "cm"},
    {"centimetre", "cm"},
    {"centimeters", "cm"},
    {"centimetres", "cm"},
    {"mm", "mm"},
    {"millimeter", "mm"},
    {"millimetre", "mm"},
    {"millimeters", "mm"},
    {"millimetres", "mm"},
    {"um", "µm"},
    {"km", "km"},
    {"kilometer", "km"},
    {"kilometre", "km"},
    {"kilometers", "km"},
    {"kilometres", "km"},
    {"ft", "ft"},
    {"feet", "ft"},
    {"foot", "ft"},
    {"mile", "mi"},
    {"miles", "mi"},
};

static const unit_word TIMES[] = {
    {"s", "s"},       {"sec", "s"},   {"secs", "s"},     {"second", "s"},
    {"seconds", "s"}, {"min", "min"}, {"minute", "min"}, {"minutes", "min"},
    {"h", "h"},       {"hr", "h"},    {"hour", "h"},     {"hours", "h"},
    {"d", "d"},       {"day", "d"},   {"days", "d"},
};

static const unit_word ANGLES[] = {
    {"degree", "°"}, {"degrees", "°"},  {"deg", "°"},
    {"rad", "rad"},  {"radian", "rad"}, {"radians", "rad"},
};

static const unit_word KNOTS[] = {
    {"knot", "kn"}, {"knots", "kn"}, {"kt", "kn"}, {"kts", "kn"}, {"kn", "kn"},
};

static const unit_word PRESSURES[] = {
    {"pa", "Pa"},     {"pascal", "Pa"},     {"pascals", "Pa"}, {"hpa", "hPa"},
    {"kpa", "kPa"},   {"mb", "hPa"},        {"mbar", "hPa"},   {"millibar", "hPa"},
    {"dbar", "dbar"}, {"millibars", "hPa"}, {"bar", "bar"},    {"mbars", "hPa"},
};

static const unit_word EAST[] = {
    {"degrees_east", ""}, {"degree_east", ""}, {"degreese", ""},    {"degreee", ""},
    {"degrees_e", ""},    {"degree_e", ""},    {"degreeseast", ""}, {"degrees east", ""},
};

static const unit_word NORTH[] = {
    {"degrees_north", ""}, {"degree_north", ""},  {"degreesn", ""},
    {"degreen", ""},       {"degrees_n", ""},     {"degree_n", ""},
    {"degreesnorth", ""},  {"degrees north", ""},
};

#define FIND(table, word) find(table, sizeof(table) / sizeof *(table), word)

static const char *find(const unit_word *table, size_t count, const char *word)
{
  for (size_t i = 0; i < count; ++i)
    if (strcmp(table[i].word, word) == 0)
      return table[i].label;
  return NULL;
}

/* Splits "centimeter/s", "m s-1", "m.s^-1", "m per second" into what is above and what is
 * below the line; false when it is not one word over one word. */
static bool split_quotient(const char *units, char above[FG__NC_TEXT],
                           char below[FG__NC_TEXT])
{
  char words[3][FG__NC_TEXT] = {"", "", ""};
  int count = 0;
  bool divided = false;
  const char *c = units;
  while (*c) {
    size_t length = 0;
    while (isalpha((unsigned char)c[length]) || c[length] == '_')
      ++length;
    if (length > 0) {
      if (length == 3 && memcmp(c, "per", 3) == 0) {
        divided = true;
      } else {
        if (count == 2 || length >= FG__NC_TEXT)
          return false;
        memcpy(words[count], c, length);
        words[count++][length] = '\0';
      }
      c += length;
    } else if (*c == '/') {
      divided = true;
      ++c;
    } else if (count == 2 && !divided && (strncmp(c, "-1", 2) == 0)) {
      divided = true;
      c += 2;
    } else if (strchr(" .*^()", *c)) {
      ++c;
    } else {
      return false;
    }
  }
  memcpy(above, words[0], FG__NC_TEXT);
  memcpy(below, words[1], FG__NC_TEXT);
  return count == 2 && divided;
}

static fg__nc_quantity find_quotient(const char *lower, char *label, size_t size)
{
  char above[FG__NC_TEXT];
  char below[FG__NC_TEXT];
  if (!split_quotient(lower, above, below))
    return FG__NC_UNKNOWN;
  const char *time = FIND(TIMES, below);
  const char *length = FIND(LENGTHS, above);
  const char *angle = FIND(ANGLES, above);
  if (!time || (!length && !angle))
    return FG__NC_UNKNOWN;
  snprintf(label, size, "%s/%s", length ? length : angle, time);
  return length ? FG__NC_SPEED : FG__NC_ANGULAR_SPEED;
}

static bool is_date(const char *lower)
{
  return strstr(lower, " since ") != NULL;
}

fg__nc_quantity fg__nc_units(const char *units, char *label, size_t size)
{
  char lower[FG__NC_TEXT];
  size_t n = 0;
  for (; n < sizeof lower - 1 && units[n]; ++n)
    lower[n] = (char)tolower((unsigned char)units[n]);
  lower[n] = '\0';
  snprintf(label, size, "%s", units);
  const char *word;
  if (FIND(EAST, lower)) {
    snprintf(label, size, "°E");
    return FG__NC_DEGREES_EAST;
  }
  if (FIND(NORTH, lower)) {
    snprintf(label, size, "°N");
    return FG__NC_DEGREES_NORTH;
  }
  if (is_date(lower))
    return FG__NC_DATE;
  if ((word = FIND(LENGTHS, lower))) {
    snprintf(label, size, "%s", word);
    return FG__NC_LENGTH;
  }
  if ((word = FIND(KNOTS, lower))) {
    snprintf(label, size, "%s", word);
    return FG__NC_SPEED;
  }
  if ((word = FIND(PRESSURES, lower))) {
    snprintf(label, size, "%s", word);
    return FG__NC_PRESSURE;
  }
  if ((word = FIND(ANGLES, lower)) && strcmp(word, "rad") != 0) {
    snprintf(label, size, "%s", word);
    return FG__NC_DEGREES;
  }
  return find_quotient(lower, label, size);
}
