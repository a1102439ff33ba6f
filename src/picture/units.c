#include "picture/units.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/plain_text.h"

enum { NAME_BYTES = 32 };

typedef struct spelling {
  const char *name;
  const char *symbol;
} spelling;

/* Names that UDUNITS knows for the units of velocity and length (udunits2 database), and
 * the SI's symbols for them. */
static const spelling spellings[] = {
    {"meter", "m"},
    {"meters", "m"},
    {"metre", "m"},
    {"metres", "m"},
    {"kilometer", "km"},
    {"kilometers", "km"},
    {"kilometre", "km"},
    {"kilometres", "km"},
    {"centimeter", "cm"},
    {"centimeters", "cm"},
    {"millimeter", "mm"},
    {"millimeters", "mm"},
    {"micrometer", "\xC2\xB5m"},
    {"um", "\xC2\xB5m"},
    {"second", "s"},
    {"seconds", "s"},
    {"sec", "s"},
    {"secs", "s"},
    {"minute", "min"},
    {"minutes", "min"},
    {"hour", "h"},
    {"hours", "h"},
    {"hr", "h"},
    {"day", "d"},
    {"days", "d"},
    {"year", "a"},
    {"years", "a"},
    {"knot", "kn"},
    {"knots", "kn"},
    {"kt", "kn"},
    {"kts", "kn"},
    {"kilogram", "kg"},
    {"pascal", "Pa"},
    {"pascals", "Pa"},
    {"newton", "N"},
    {"degree", "\xC2\xB0"},
    {"degrees", "\xC2\xB0"},
};

typedef struct length_unit {
  const char *symbol;
  double metres;
} length_unit;

static const length_unit lengths[] = {
    {"m", 1.0}, {"km", 1e3}, {"cm", 1e-2}, {"mm", 1e-3}, {"\xC2\xB5m", 1e-6},
};

static const char *symbol_of(const char *name)
{
  for (size_t k = 0; k < sizeof spellings / sizeof *spellings; ++k) {
    const char *a = spellings[k].name;
    const char *b = name;
    while (*a && tolower((unsigned char)*b) == *a) {
      ++a;
      ++b;
    }
    if (!*a && !*b)
      return spellings[k].symbol;
  }
  return name;
}

/* A letter of a unit's name: ASCII letters, percent, underscore, all of UTF-8 but the
 * middle dot, which separates factors. */
static bool is_letter(const char *text)
{
  unsigned char c = (unsigned char)*text;
  if (c == 0xC2 && (unsigned char)text[1] == 0xB7)
    return false;
  return isalpha(c) || c >= 0x80 || c == '%' || c == '_';
}

static const char *read_name(const char *text, char name[NAME_BYTES])
{
  size_t length = 0;
  while (is_letter(text)) {
    if (length + 1 >= NAME_BYTES)
      return NULL;
    name[length++] = *text++;
  }
  name[length] = '\0';
  return length ? text : NULL;
}

/* An exponent: "-1", "^2", "**-1", "2", nothing. */
static const char *read_power(const char *text, int *power)
{
  const char *start = text;
  bool marked = false;
  if (*text == '^') {
    ++text;
    marked = true;
  } else if (text[0] == '*' && text[1] == '*') {
    text += 2;
    marked = true;
  }
  const char *digits = *text == '-' || *text == '+' ? text + 1 : text;
  *power = 1;
  if (!isdigit((unsigned char)*digits))
    return marked ? NULL : start;
  char *end;
  long value = strtol(text, &end, 10);
  if (value < -99 || value > 99 || value == 0)
    return NULL;
  *power = (int)value;
  return end;
}

/* Passes separators; says whether the next factor divides. */
static const char *pass_separators(const char *text, bool *divides)
{
  *divides = false;
  for (;;) {
    if (*text == '/') {
      *divides = true;
      ++text;
    } else if (*text == ' ' || *text == '.' || *text == '*') {
      ++text;
    } else if ((unsigned char)text[0] == 0xC2 && (unsigned char)text[1] == 0xB7) {
      text += 2;
    } else if (strncmp(text, "per ", 4) == 0) {
      *divides = true;
      text += 4;
    } else {
      return text;
    }
  }
}

static bool write_product(char out[FG__UNITS_BYTES], const char *text)
{
  size_t used = 0;
  out[0] = '\0';
  for (;;) {
    bool divides;
    text = pass_separators(text, &divides);
    if (!*text)
      return !divides;
    if (*text == '1' && !isdigit((unsigned char)text[1]) && used == 0) {
      ++text;
      continue;
    }
    char name[NAME_BYTES] = "";
    int power;
    text = read_name(text, name);
    if (text)
      text = read_power(text, &power);
    if (!text)
      return false;
    if (divides)
      power = -power;
    char factor[64];
    if (power == 1)
      snprintf(factor, sizeof factor, "%s", symbol_of(name));
    else
      snprintf(factor, sizeof factor, "%s" FG__TEXT_RAISE "%s%d" FG__TEXT_LOWER,
               symbol_of(name), power < 0 ? "\xE2\x88\x92" : "", abs(power));
    size_t needed = strlen(factor) + (used > 0);
    if (used + needed >= FG__UNITS_BYTES)
      return false;
    used += (size_t)snprintf(out + used, FG__UNITS_BYTES - used, "%s%s", used ? " " : "",
                             factor);
  }
}

void fg__units_write(char out[FG__UNITS_BYTES], const char *units)
{
  char plain[FG__UNITS_BYTES];
  fg__text_clean(plain, sizeof plain, units ? units : "");
  char *start = plain + strspn(plain, " ([");
  size_t length = strlen(start);
  while (length > 0 && strchr(" )]", start[length - 1]))
    start[--length] = '\0';
  if (!write_product(out, start))
    memmove(out, start, length + 1);
}

double fg__units_metres(const char *units)
{
  char symbol[FG__UNITS_BYTES];
  fg__units_write(symbol, units);
  for (size_t k = 0; k < sizeof lengths / sizeof *lengths; ++k)
    if (strcmp(symbol, lengths[k].symbol) == 0)
      return lengths[k].metres;
  return 0.0;
}
