#include "interpret/selection/axis_units.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

/* A unit: the quantity it measures, and its size in the base unit of that quantity. */
typedef struct known_unit {
  const char *name;
  int measure;
  double factor;
} known_unit;

/* The unit of a name, perhaps in the plural; NULL where it is not known. */
static const known_unit *find_unit(const char *name)
{
  static const known_unit known[] = {
      {"Pa", 1, 1.0},         {"hPa", 1, 100.0},   {"mb", 1, 100.0},   {"mbar", 1, 100.0},
      {"millibar", 1, 100.0}, {"kPa", 1, 1000.0},  {"dbar", 1, 1e4},   {"bar", 1, 1e5},
      {"m", 2, 1.0},          {"meter", 2, 1.0},   {"metre", 2, 1.0},  {"km", 2, 1000.0},
      {"dm", 2, 0.1},         {"cm", 2, 0.01},     {"mm", 2, 0.001},   {"ft", 2, 0.3048},
      {"s", 3, 1.0},          {"sec", 3, 1.0},     {"second", 3, 1.0}, {"ms", 3, 0.001},
      {"min", 3, 60.0},       {"minute", 3, 60.0}, {"h", 3, 3600.0},   {"hr", 3, 3600.0},
      {"hour", 3, 3600.0},    {"d", 3, 86400.0},   {"day", 3, 86400.0}};
  for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
    const size_t length = strlen(known[k].name);
    if (strncasecmp(known[k].name, name, length) != 0)
      continue;
    if (!name[length] || (length > 2 && strcasecmp(name + length, "s") == 0))
      return &known[k];
  }
  return NULL;
}

double fg__unit_factor(const char *from, const char *to)
{
  if (!from[0] || strcasecmp(from, to) == 0)
    return 1.0;
  const known_unit *one = find_unit(from), *other = find_unit(to);
  return one && other && one->measure == other->measure ? one->factor / other->factor
                                                        : 0.0;
}
