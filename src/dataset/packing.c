#include <float.h>
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "dataset/dataset.h"
#include "terms/text.h"
#include "terms/units.h"

static double round_to_type(double value, fg__type type)
{
  return type == FG__TYPE_FLOAT32 && fabs(value) <= (double)FLT_MAX ? (double)(float)value
                                                                    : value;
}

/* Whether an attribute of packed numbers has the type of unpacked ones. */
static bool is_of_unpacked(const fg__variable *v, const char *name)
{
  const fg__attribute *a = fg__attribute_find(v, name);
  return a && a->count > 0 && a->is_floating && !fg__is_floating(v);
}

/* CF, section 2.5.1: missing_value is packed; some write it in unpacked units. */
static void find_fills(fg__packing *p, const fg__variable *v, bool packed)
{
  p->fills = fg__attribute_numbers(v, "_FillValue", p->fill, 1);
  if (p->fills == 0 && !isnan(v->fill))
    p->fill[p->fills++] = v->fill;
  p->fills += fg__attribute_numbers(v, "missing_value", p->fill + p->fills,
                                    FG__MOST_FILLS - p->fills);
  if (packed && is_of_unpacked(v, "missing_value"))
    p->unpacked.count =
        fg__attribute_numbers(v, "missing_value", p->unpacked.number, FG__MOST_FILLS);
  for (int i = 0; i < p->fills; ++i)
    p->fill[i] = round_to_type(p->fill[i], v->type);
}

static void find_range(fg__packing *p, const fg__variable *v, bool packed)
{
  double range[2];
  p->least = -HUGE_VAL;
  p->largest = HUGE_VAL;
  if (fg__attribute_numbers(v, "valid_range", range, 2) == 2) {
    p->least = range[0];
    p->largest = range[1];
  } else {
    fg__attribute_numbers(v, "valid_min", &p->least, 1);
    fg__attribute_numbers(v, "valid_max", &p->largest, 1);
  }
  /* NUG, appendix A: a range of the unpacked type is of the unpacked values */
  p->range_unpacked =
      packed && (is_of_unpacked(v, "valid_range") || is_of_unpacked(v, "valid_max") ||
                 is_of_unpacked(v, "valid_min"));
  if (!p->range_unpacked) {
    p->least = round_to_type(p->least, v->type);
    p->largest = round_to_type(p->largest, v->type);
  }
  if (!(p->least <= p->largest)) { /* an empty range is a mistake and ignored */
    p->least = -HUGE_VAL;
    p->largest = HUGE_VAL;
  }
}

static void find_unsigned(fg__packing *p, const fg__variable *v)
{
  char text[FG__TEXT_BYTES];
  if (!fg__attribute_text(v, "_Unsigned", text, sizeof text) ||
      !fg__is_same(text, "true"))
    return;
  p->wrap = v->type == FG__TYPE_INT8    ? 256.0
            : v->type == FG__TYPE_INT16 ? 65536.0
            : v->type == FG__TYPE_INT32 ? 4294967296.0
                                        : 0.0;
  for (int i = 0; i < p->fills; ++i)
    if (p->fill[i] < 0.0)
      p->fill[i] += p->wrap;
  if (p->wrap > 0.0 && !p->range_unpacked) {
    p->least += p->least < 0.0 ? p->wrap : 0.0;
    p->largest += p->largest < 0.0 ? p->wrap : 0.0;
  }
}

bool fg__is_given_missing(const fg__missing_numbers *given, double value)
{
  for (int n = 0; n < given->count; ++n)
    if ((float)value >= (float)given->number[n] &&
        (float)value <= (float)given->number[n])
      return true;
  return false;
}

double fg__degrees_per_unit(const fg__variable *v)
{
  const fg__attribute *units = fg__attribute_find(v, "units");
  fg__unit unit;
  if (!units || !units->text)
    return 1.0;
  fg__unit_read(&unit, units->text);
  if (unit.quantity == FG__QUANTITY_RADIANS)
    return v->geographic != FG__NO_ROLE ? 1.0 / FG__RADIANS : 1.0;
  return unit.factor < 0.0 ? -1.0 : 1.0;
}

/* Longitudes and latitudes in radians, or that count to the west or south, are read as if
 * they were packed. */
static void turn_degrees(fg__packing *p, double degrees)
{
  const double range[2] = {degrees * p->least, degrees * p->largest};
  p->scale *= degrees;
  p->offset *= degrees;
  if (p->range_unpacked) {
    p->least = degrees < 0.0 ? range[1] : range[0];
    p->largest = degrees < 0.0 ? range[0] : range[1];
  }
}

fg__packing fg__packing_of(const fg__variable *variable)
{
  fg__packing p = {.scale = 1.0, .offset = 0.0, .given = &variable->owner->missing};
  const int scaled = fg__attribute_numbers(variable, "scale_factor", &p.scale, 1);
  const int moved = fg__attribute_numbers(variable, "add_offset", &p.offset, 1);
  find_fills(&p, variable, scaled + moved > 0);
  find_range(&p, variable, scaled + moved > 0);
  find_unsigned(&p, variable);
  turn_degrees(&p, fg__degrees_per_unit(variable));
  return p;
}

double fg__unpack(const fg__packing *packing, double stored, fg__missing_counts *missing)
{
  if (isnan(stored)) {
    ++missing->not_a_number;
    return stored;
  }
  if (stored < 0.0)
    stored += packing->wrap;
  for (int i = 0; i < packing->fills; ++i)
    if (stored == packing->fill[i]) {
      ++missing->fill;
      return (double)NAN;
    }
  const double value = stored * packing->scale + packing->offset;
  if (fg__is_given_missing(packing->given, value) ||
      fg__is_given_missing(&packing->unpacked, value)) {
    ++missing->fill;
    return (double)NAN;
  }
  const double ranged = packing->range_unpacked ? value : stored;
  if (ranged < packing->least || ranged > packing->largest) {
    ++missing->range;
    return (double)NAN;
  }
  return value;
}
