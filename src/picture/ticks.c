#include "picture/ticks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/plain_text.h"
#include "picture/units.h"
#include "terms/measure.h"

#define MINUS "\xE2\x88\x92"
#define DEGREE "\xC2\xB0"
#define TIMES "\xC3\x97"

/* Share of a step by which a tick may lie outside the axis: sums of decimal fractions in
 * double miss their end by about 1e-10 of a step even for offsets of 1e6 steps. */
static const double step_slack = 1e-6;

/* More digits than this in a tick label are read one by one, not at a glance. */
enum { LABEL_DIGITS = 6, MOST_DECIMALS = 12 };

/* Decimals that write a multiple of `step` exactly. */
static int decimals_of(double step)
{
  double scaled = step;
  for (int decimals = 0; decimals < MOST_DECIMALS; ++decimals) {
    if (fabs(scaled - round(scaled)) < step_slack * scaled)
      return decimals;
    scaled *= 10.0;
  }
  return MOST_DECIMALS;
}

static void write_number(char out[FG__TICK_BYTES], double value, int decimals)
{
  char digits[FG__TICK_BYTES];
  snprintf(digits, sizeof digits, "%.*f", decimals, fabs(value));
  bool zero = strspn(digits, "0.,") == strlen(digits);
  snprintf(out, FG__TICK_BYTES, "%s%.32s", value < 0.0 && !zero ? MINUS : "", digits);
}

static void write_longitude(char out[FG__TICK_BYTES], double value, int decimals)
{
  double east = value - 360.0 * round(value / 360.0);
  double size = fabs(east);
  bool plain = size < 1e-9 || size > 180.0 - 1e-9;
  snprintf(out, FG__TICK_BYTES, "%.*f" DEGREE "%s", decimals, size,
           plain        ? ""
           : east > 0.0 ? "E"
                        : "W");
}

static void write_latitude(char out[FG__TICK_BYTES], double value, int decimals)
{
  double size = fabs(value);
  snprintf(out, FG__TICK_BYTES, "%.*f" DEGREE "%s", decimals, size,
           size < 1e-9   ? ""
           : value > 0.0 ? "N"
                         : "S");
}

static const struct length_choice {
  double metres;
  const char *symbol;
} length_choices[] = {
    {1e3, "km"}, {1.0, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "\xC2\xB5m"}};

/* The unit for a length: km from 10 km on; below a metre the unit that gives numbers
 * from 1 up; a unit chosen by the file stays unless its numbers grow unhandy. */
static double suit_length(double metres, double extent, const char **symbol)
{
  double largest = extent * metres;
  size_t count = sizeof length_choices / sizeof *length_choices;
  for (size_t k = 0; k < count; ++k)
    if (length_choices[k].metres == metres) /* the file's own unit: exact by table */
      *symbol = length_choices[k].symbol;
  if (extent >= 0.5 && extent < 1e4)
    return 1.0;
  for (size_t k = 0; k < count; ++k) {
    double least = k == 0 ? 1e4 : 0.5 * length_choices[k].metres;
    if (k == 2 || (largest < least && k + 1 < count))
      continue; /* centimetres only where the file has them */
    *symbol = length_choices[k].symbol;
    return metres / length_choices[k].metres;
  }
  return 1.0;
}

/* A power of ten taken out of numbers that are all very large or very small. */
static int common_exponent(double largest)
{
  if (!(largest > 0.0) || (largest < 1e5 && largest >= 1e-2))
    return 0;
  return (int)floor(log10(largest) + step_slack);
}

/* A name, an offset and a unit of UNITS_BYTES each always fit. */
static void append(char out[FG__AXIS_BYTES], const char *text)
{
  size_t used = strlen(out);
  size_t length = strlen(text);
  if (used + length < FG__AXIS_BYTES)
    memcpy(out + used, text, length + 1);
}

void fg__axis_of_numbers(fg__tick_axis *out, double low, double high, double extent,
                         const char *name, const char *units)
{
  const fg__measure measure = fg__measure_of(units);
  *out = (fg__tick_axis){measure.logarithmic ? FG__TICKS_LOGARITHM : FG__TICKS_NUMBER,
                         low,
                         high,
                         measure.factor,
                         0.0,
                         "",
                         ""};
  char symbol[FG__UNITS_BYTES];
  fg__units_write(symbol, measure.units);
  double metres = measure.logarithmic ? 0.0 : fg__units_metres(measure.units);
  if (metres > 0.0) {
    const char *suited = symbol;
    out->factor *= suit_length(metres, extent * fabs(out->factor), &suited);
    char kept[FG__UNITS_BYTES];
    snprintf(kept, sizeof kept, "%s", suited);
    memcpy(symbol, kept, sizeof kept);
  }
  const double size = measure.logarithmic ? 0.0 : fabs(out->factor);
  double range = fmax(high - low, extent) * size;
  double largest = fmax(fabs(low), fabs(high)) * size;
  char shown_name[FG__UNITS_BYTES + 40];
  char clean_name[FG__UNITS_BYTES];
  fg__text_clean(clean_name, sizeof clean_name, name ? name : "");
  snprintf(shown_name, sizeof shown_name, "%s", clean_name);
  if (largest > range * pow(10.0, LABEL_DIGITS - 2)) {
    double grain = pow(10.0, ceil(log10(range))) / size;
    out->offset = floor(low / grain) * grain;
    snprintf(shown_name, sizeof shown_name, "%s %s %.12g", clean_name,
             out->offset * out->factor < 0.0 ? "+" : MINUS, fabs(out->offset * size));
    largest = fmax(fabs(low - out->offset), fabs(high - out->offset)) * size;
  }
  int exponent = common_exponent(fmax(largest, extent * size));
  char power[48] = "";
  if (exponent != 0) {
    out->factor *= pow(10.0, -exponent);
    snprintf(power, sizeof power, "10" FG__TEXT_RAISE "%s%d" FG__TEXT_LOWER "%s",
             exponent < 0 ? MINUS : "", abs(exponent), symbol[0] ? " " : "");
  }
  snprintf(out->units, sizeof out->units, "%s%s%s", exponent ? TIMES : "", power, symbol);
  const char *shown_units =
      exponent && symbol[0] ? out->units + strlen(TIMES) : out->units;
  append(out->label, shown_name);
  if (shown_name[0] && out->units[0])
    append(out->label, " (");
  append(out->label, shown_units);
  if (shown_name[0] && out->units[0])
    append(out->label, ")");
}

void fg__axis_of_degrees(fg__tick_axis *out, double low, double high,
                         fg__tick_style style)
{
  *out = (fg__tick_axis){style, low, high, 1.0, 0.0, "", DEGREE};
}

/* 1, 2, 5 times a power of ten, the smallest at least `least`. */
static double decimal_step(double least)
{
  double power = pow(10.0, floor(log10(least)));
  static const double digits[] = {1.0, 2.0, 5.0, 10.0};
  for (int k = 0; k < 4; ++k)
    if (digits[k] * power >= least * (1.0 - step_slack))
      return digits[k] * power;
  return 10.0 * power;
}

/* Which numbers of a decade have ticks, and the least interval of their logarithms; after
 * them only whole powers of ten, each second, ... */
static const struct {
  double interval, number[10];
} decades[] = {{0.04575, {1, 2, 3, 4, 5, 6, 7, 8, 9}},
               {0.12493, {1, 1.5, 2, 3, 5, 7}},
               {0.30103, {1, 2, 5}}};
enum { DECADES = sizeof decades / sizeof *decades };

static double logarithmic_step(double least)
{
  for (int k = 0; k < DECADES; ++k)
    if (decades[k].interval >= least * (1.0 - step_slack))
      return decades[k].interval;
  return fmax(ceil(least - step_slack), 1.0);
}

static void fill_logarithmic(fg__ticks *out, const fg__tick_axis *axis)
{
  const double step = out->step * fabs(axis->factor);
  const double low = fmin(axis->low * axis->factor, axis->high * axis->factor);
  const double high = fmax(axis->low * axis->factor, axis->high * axis->factor);
  const double every = fmax(1.0, round(step));
  static const double powers[10] = {1};
  const double *number = powers;
  for (int k = 0; k < DECADES; ++k)
    if (fabs(decades[k].interval - step) < 1e-4)
      number = decades[k].number;
  for (double decade = floor(low / every) * every; decade <= high; decade += every)
    for (int k = 0; number[k] > 0.0; ++k) {
      const double at = decade + log10(number[k]);
      if (at < low - step_slack || at > high + step_slack)
        continue;
      if (out->count == FG__TICK_LIMIT) {
        out->count = 0;
        return;
      }
      /* coordinates ascend where logarithms descend */
      int n = out->count++;
      for (; n > 0 && axis->factor < 0.0; --n) {
        out->position[n] = out->position[n - 1];
        memcpy(out->text[n], out->text[n - 1], sizeof out->text[n]);
      }
      const double value = number[k] * pow(10.0, decade);
      out->position[n] = fmin(fmax(at / axis->factor, axis->low), axis->high);
      write_number(out->text[n], value, decimals_of(value));
    }
}

double fg__ticks_step(const fg__tick_axis *axis, double least)
{
  const double size = fabs(axis->factor);
  if (axis->style == FG__TICKS_NUMBER)
    return decimal_step(least * size) / size;
  if (axis->style == FG__TICKS_LOGARITHM)
    return logarithmic_step(least * size) / size;
  static const double degrees[] = {10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 180.0};
  if (least <= 5.0 * (1.0 + step_slack))
    return decimal_step(least);
  for (size_t k = 0; k < sizeof degrees / sizeof *degrees; ++k)
    if (degrees[k] >= least * (1.0 - step_slack))
      return degrees[k];
  return 360.0 * ceil(least / 360.0);
}

double fg__ticks_step_below(const fg__tick_axis *axis, double step)
{
  /* Neighbours are at most a factor 2.5 apart, of logarithms 3.4, and at least 4/3. */
  for (double share = 0.8; share > 0.28; share -= 0.05) {
    double below = fg__ticks_step(axis, share * step);
    if (below < step * (1.0 - step_slack))
      return below;
  }
  return 0.4 * step;
}

void fg__ticks_fill(fg__ticks *out, const fg__tick_axis *axis, double step)
{
  out->count = 0;
  out->step = step;
  if (axis->style == FG__TICKS_LOGARITHM) {
    fill_logarithmic(out, axis);
    return;
  }
  double low = (axis->low - axis->offset) / step;
  double high = (axis->high - axis->offset) / step;
  double first = ceil(low - step_slack);
  double last = floor(high + step_slack);
  if (!(last - first < FG__TICK_LIMIT))
    return;
  int decimals = decimals_of(step * fabs(axis->factor));
  for (double k = first; k <= last; k += 1.0) {
    int n = out->count++;
    double value = k * step * axis->factor;
    out->position[n] = fmin(fmax(axis->offset + k * step, axis->low), axis->high);
    if (axis->style == FG__TICKS_LONGITUDE)
      write_longitude(out->text[n], value, decimals);
    else if (axis->style == FG__TICKS_LATITUDE)
      write_latitude(out->text[n], value, decimals);
    else
      write_number(out->text[n], value, decimals);
  }
}

void fg__axis_write_length(char out[FG__AXIS_BYTES], const fg__tick_axis *axis,
                           double length)
{
  char number[FG__TICK_BYTES];
  double value = length * axis->factor;
  write_number(number, value, decimals_of(value));
  bool space = axis->units[0] && strcmp(axis->units, DEGREE) != 0;
  snprintf(out, FG__AXIS_BYTES, "%s%s%.150s", number, space ? " " : "", axis->units);
}
