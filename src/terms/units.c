#include "terms/units.h"

#include "base/angle.h"
#include "terms/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct unit_row {
  fg__quantity quantity;
  double factor;
  const char *label;
  const char *words; /* in small letters, singular */
} unit_row;

#define LENGTH FG__QUANTITY_LENGTH
#define TIME FG__QUANTITY_TIME
#define SPEED FG__QUANTITY_SPEED
#define PRESSURE FG__QUANTITY_PRESSURE
#define EAST FG__QUANTITY_DEGREES_EAST
#define NORTH FG__QUANTITY_DEGREES_NORTH

static const unit_row UNITS[] = {
    {LENGTH, 1.0, "m", "m|meter|metre"},
    {LENGTH, 1e3, "km", "km|kilometer|kilometre"},
    {LENGTH, 0.1, "dm", "dm|decimeter|decimetre"},
    {LENGTH, 0.01, "cm", "cm|centimeter|centimetre"},
    {LENGTH, 1e-3, "mm", "mm|millimeter|millimetre"},
    {LENGTH, 1e-6, "µm", "um|micrometer|micrometre|micron"},
    {LENGTH, 0.3048, "ft", "ft|foot|feet"},
    {LENGTH, 1609.344, "mi", "mi|mile"},
    {LENGTH, 1852.0, "nmi", "nmi|nautical_mile|nautical mile"},
    {TIME, 1.0, "s", "s|sec|second"},
    {TIME, 1e-3, "ms", "ms|msec|millisec|millisecond"},
    {TIME, 1e-6, "µs", "us|usec|microsec|microsecond"},
    {TIME, 1e-9, "ns", "ns|nsec|nanosec|nanosecond"},
    {TIME, 60.0, "min", "min|minute"},
    {TIME, 3600.0, "h", "h|hr|hour"},
    {TIME, 86400.0, "d", "d|day"},
    {FG__QUANTITY_DEGREES, FG__RADIANS, "°", "deg|degree|degt|arc_degree"},
    {FG__QUANTITY_RADIANS, 1.0, "rad", "rad|radian"},
    {SPEED, 1852.0 / 3600.0, "kn", "kn|kt|knot"},
    {SPEED, 1609.344 / 3600.0, "mph", "mph"},
    {SPEED, 1.0 / 3.6, "km/h", "kmh|kph|kmph"},
    {SPEED, 1.0, "m/s", "mps"},
    {PRESSURE, 1.0, "Pa", "pa|pascal"},
    {PRESSURE, 100.0, "hPa", "hpa|hectopascal|mb|mbar|millibar"},
    {PRESSURE, 1e3, "kPa", "kpa|kilopascal"},
    {PRESSURE, 1e4, "dbar", "dbar|decibar"},
    {PRESSURE, 1e5, "bar", "bar"},
    {EAST, FG__RADIANS, "°E",
     "degree_east|degrees_east|degrees east|degrees-east|degreeseast|"
     "degree_e|degrees_e|degreee|degreese|deg e|deg_e|dege"},
    {EAST, -FG__RADIANS, "°W",
     "degree_west|degrees_west|degrees west|degrees-west|degreeswest|"
     "degree_w|degrees_w|degreew|degreesw|deg w|deg_w|degw"},
    {NORTH, FG__RADIANS, "°N",
     "degree_north|degrees_north|degrees north|degrees-north|degreesnorth|"
     "degree_n|degrees_n|degreen|degreesn|deg n|deg_n|degn"},
    {NORTH, -FG__RADIANS, "°S",
     "degree_south|degrees_south|degrees south|degrees-south|degreessouth|"
     "degree_s|degrees_s|deg s|deg_s"},
};

/* The unit of a word, singular or plural; NULL: unknown. */
static const unit_row *find_unit(const char *word)
{
  const size_t length = strlen(word);
  const bool plural = length > 2 && fg__small(word[length - 1]) == 's';
  for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; ++i)
    if (fg__is_one_of(UNITS[i].words, word, length) ||
        (plural && fg__is_one_of(UNITS[i].words, word, length - 1)))
      return &UNITS[i];
  return NULL;
}

/* Copies units in small letters, with ASCII substitutes for other characters. */
static void simplify(const char *units, char out[FG__UNIT_BYTES])
{
  static const struct {
    const char *sign;
    const char *plain;
  } signs[] = {{"°", "deg"}, {"µ", "u"}, {"μ", "u"}, {"·", "."}, {"⁻", "-"}, {"¹", "1"}};
  enum { SIGNS = sizeof signs / sizeof *signs, LONGEST = 3 };
  size_t n = 0;
  while (*units && n + LONGEST < FG__UNIT_BYTES) {
    size_t s = 0;
    while (s < SIGNS && strncmp(units, signs[s].sign, strlen(signs[s].sign)) != 0)
      ++s;
    if (s < SIGNS) {
      memcpy(out + n, signs[s].plain, strlen(signs[s].plain));
      n += strlen(signs[s].plain);
      units += strlen(signs[s].sign);
    } else {
      out[n++] = fg__small(*units++);
    }
  }
  out[n] = '\0';
}

/* Splits "centimeter/s", "m s-1", "m.s^-1", "m per second" into numerator and
 * denominator; false unless each is one word. */
static bool split_quotient(const char *c, char above[FG__UNIT_BYTES],
                           char below[FG__UNIT_BYTES])
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
    while (fg__is_letter(*c) || *c == '_')
      ++c;
    const size_t length = (size_t)(c - word);
    if (length == 0)
      return false;
    if (fg__is_word(word, length, "per")) {
      sign = -1;
      continue;
    }
    const char *number = c + strspn(c, "*^({");
    long power = 1;
    if (fg__is_digit(*number) || *number == '-') {
      char *end;
      power = strtol(number, &end, 10);
      c = end > number ? end : number + 1;
    }
    char *part = power == sign ? above : power == -sign ? below : NULL;
    if (!part || part[0] || length >= FG__UNIT_BYTES)
      return false;
    memcpy(part, word, length);
    part[length] = '\0';
    sign = 1;
  }
  return above[0] && below[0];
}

static void read_quotient(fg__unit *out, const char *plain)
{
  char above[FG__UNIT_BYTES], below[FG__UNIT_BYTES];
  if (!split_quotient(plain, above, below))
    return;
  const unit_row *way = find_unit(above), *time = find_unit(below);
  if (!way || !time || time->quantity != TIME)
    return;
  switch (way->quantity) {
  case FG__QUANTITY_DEGREES:
  case FG__QUANTITY_RADIANS:
    out->quantity = FG__QUANTITY_ANGULAR_SPEED;
    break;
  case LENGTH:
    out->quantity = SPEED;
    break;
  case PRESSURE:
    out->quantity = FG__QUANTITY_PRESSURE_TENDENCY;
    break;
  default:
    return;
  }
  out->factor = way->factor / time->factor;
  snprintf(out->label, sizeof out->label, "%s/%s", way->label, time->label);
}

void fg__unit_read(fg__unit *out, const char *text)
{
  char plain[FG__UNIT_BYTES];
  *out = (fg__unit){.quantity = FG__QUANTITY_UNKNOWN};
  snprintf(out->label, sizeof out->label, "%s", text);
  simplify(text, plain);
  if (strstr(plain, " since ") ||
      fg__is_one_of(FG__ABSOLUTE_DATES "|" FG__ABSOLUTE_MONTHS, text, strlen(text))) {
    out->quantity = FG__QUANTITY_DATE;
    return;
  }
  const unit_row *found = find_unit(plain);
  if (!found) {
    read_quotient(out, plain);
    return;
  }
  out->quantity = found->quantity;
  out->factor = found->factor;
  if (found->quantity != TIME && found->quantity != FG__QUANTITY_RADIANS)
    snprintf(out->label, sizeof out->label, "%s", found->label);
}

fg__quantity fg__units_read(const char *text, char *label, size_t size)
{
  fg__unit unit;
  fg__unit_read(&unit, text);
  snprintf(label, size, "%s", unit.label);
  return unit.quantity;
}

bool fg__units_seconds(const char *text, double *out)
{
  fg__unit unit;
  fg__unit_read(&unit, text);
  *out = unit.quantity == TIME ? unit.factor : 0.0;
  return *out > 0.0;
}

static bool is_angle(const fg__unit *unit)
{
  return unit->quantity == FG__QUANTITY_DEGREES || unit->quantity == FG__QUANTITY_RADIANS;
}

double fg__unit_factor(const char *from, const char *to)
{
  fg__unit one, other;
  if (!from[0] || fg__is_same(from, to))
    return 1.0;
  fg__unit_read(&one, from);
  fg__unit_read(&other, to);
  const bool angles = is_angle(&one) && is_angle(&other);
  return (one.quantity == other.quantity || angles) && other.factor != 0.0
             ? one.factor / other.factor
             : 0.0;
}

bool fg__is_unit_in_name(const char *word)
{
  fg__unit unit;
  fg__unit_read(&unit, word);
  return unit.quantity == LENGTH || unit.quantity == FG__QUANTITY_DEGREES ||
         unit.quantity == SPEED || strchr(word, '/') != NULL ||
         fg__is_one_of("px|pix|pixel|pixels", word, strlen(word));
}

const char *fg__units_of_name(const char *name)
{
  static const char *const rows[][2] = {
      {"kn", "sknt"},
      {"degrees_west", "lon_w|long_w|longitude_w|longitude_west|west_longitude"},
      {"degrees_south", "lat_s|latitude_s|latitude_south|south_latitude"},
  };
  char plain[FG__UNIT_BYTES];
  fg__plain_name(plain, sizeof plain, name);
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
    if (fg__is_one_of(rows[i][1], plain, strlen(plain)))
      return rows[i][0];
  const char *last = strrchr(plain, '_');
  const unit_row *unit = last ? find_unit(last + 1) : NULL;
  return unit && unit->quantity == SPEED ? unit->label : "";
}

bool fg__fill_radians(const double longitude[2], const double latitude[2])
{
  const double turn = 360.0 * FG__RADIANS, rounding = 0.01,
               west = longitude[0] < -rounding ? -0.5 * turn : 0.0;
  return longitude[1] - longitude[0] > 0.9 * turn && longitude[0] >= west - rounding &&
         longitude[1] <= west + turn + rounding &&
         latitude[1] - latitude[0] > 0.4 * turn &&
         fmax(-latitude[0], latitude[1]) <= 0.25 * turn + rounding;
}

fg_status fg__check_degrees(fg_context *context, const char *path,
                            const double *longitude, const double *latitude, size_t count)
{
  double range[2][2] = {{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}};
  for (size_t n = 0; n < count; ++n)
    for (int k = 0; k < 2 && isfinite(longitude[n]) && isfinite(latitude[n]); ++k) {
      const double at = k == 0 ? longitude[n] : latitude[n];
      range[k][0] = fmin(range[k][0], at);
      range[k][1] = fmax(range[k][1], at);
    }
  if (!fg__fill_radians(range[0], range[1]))
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_ARGUMENT,
           "%s: longitudes %g to %g and latitudes %g to %g are radians, not degrees",
           path, range[0][0], range[0][1], range[1][0], range[1][1]);
  fg__hint(context, "correct their units in the file");
  return FG_STATUS_ARGUMENT;
}
