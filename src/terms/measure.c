#include "terms/measure.h"

#include "base/decimal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

fg__measure fg__measure_of(const char *units)
{
  static const char logarithm[] = "lg(re 1 ";
  const char *rest;
  fg__measure out = {.factor = fg__number_read(units, &rest)};
  if (rest == units || *rest != ' ' || !isfinite(out.factor) || out.factor == 0.0) {
    out.factor = 1.0;
    snprintf(out.units, sizeof out.units, "%s", units);
    return out;
  }
  ++rest;
  out.logarithmic = strncmp(rest, logarithm, sizeof logarithm - 1) == 0;
  rest += out.logarithmic ? sizeof logarithm - 1 : 0;
  const int length = (int)strlen(rest) - (out.logarithmic && strchr(rest, ')'));
  snprintf(out.units, sizeof out.units, "%.*s", length, rest);
  return out;
}

double fg__measure_value(const fg__measure *measure, double coordinate)
{
  const double value = measure->factor * coordinate;
  return measure->logarithmic ? pow(10.0, value) : value;
}

double fg__measure_coordinate(const fg__measure *measure, double value)
{
  return (measure->logarithmic ? log10(value) : value) / measure->factor;
}
