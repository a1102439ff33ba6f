/* Coordinates along one axis: read, unwrapped, sorted to ascend, with a period of 360
 * degrees where longitudes go round the globe. */
#include "base/memory.h"
#include "field/refused.h"
#include "interpret/interpret.h"
#include "terms/coordinates.h"
#include "terms/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longitudes go round the globe when the gap to 360 degrees is one cell, within a quarter
 * of a cell: uneven spacing needs that much, and regional grids have larger gaps. */
static const double CLOSING_TOLERANCE = 0.25;

/* A column repeats the first when it lies within a hundredth of a cell of it; rounding to
 * float is smaller than that on grids down to 0.003 degrees. */
static const double REPEATED_TOLERANCE = 0.01;

/* Reads along the axis's dimension, at index 0 of all others. */
static fg_status read_coordinates(const fg__grid_axis *axis, const fg__dataset *data,
                                  const fg__variable *coordinate)
{
  double *out = axis->coordinate;
  size_t start[FG__RANK] = {0};
  size_t size[FG__RANK];
  for (int k = 0; k < coordinate->rank; ++k) {
    const bool along =
        fg__alike_dimension(data, coordinate->dimension[k], axis->dimension);
    start[k] = along ? axis->first : 0;
    size[k] = along ? axis->size : 1;
  }
  const fg_status status = fg__variable_fetch(coordinate, start, size, out);
  if (status != FG_STATUS_OK)
    return status;
  const fg__packing p = fg__packing_of(coordinate);
  for (size_t i = 0; i < axis->size; ++i)
    out[i] = out[i] * p.scale + p.offset;
  return FG_STATUS_OK;
}

fg__quantity fg__units_of(const fg__variable *v, char *label, size_t size)
{
  char text[FG__TEXT_BYTES], unused[FG__TEXT_BYTES];
  fg__attribute_text(v, "units", text, sizeof text);
  return fg__units_read(text, label ? label : unused, label ? size : sizeof unused);
}

/* Adds multiples of 360 degrees where longitudes jump from 180 to -180 or from 360 to
 * 0. */
static void unwrap(double *x, size_t count)
{
  double turn = 0.0;
  for (size_t i = 1; i < count; ++i) {
    const double step = x[i] + turn - x[i - 1];
    if (fabs(step) > 180.0 && fabs(step) < 720.0)
      turn -= 360.0 * round(step / 360.0);
    x[i] += turn;
  }
}

void fg__grid_axis_flip(fg__grid_axis *axis)
{
  double *x = axis->coordinate;
  for (size_t i = 0, k = axis->size - 1; i < k; ++i, --k) {
    const double swapped = x[i];
    x[i] = x[k];
    x[k] = swapped;
  }
  axis->reversed = !axis->reversed;
}

static bool check_coordinates(fg__grid *grid, const double *x, size_t count,
                              const char *name)
{
  for (size_t i = 0; i < count; ++i)
    if (!isfinite(x[i]) || fabs(x[i]) > fg__largest_number ||
        fg__is_apart_coordinate(x, count, i)) {
      fg__set_unusable(grid->unusable,
                       "coordinate %zu of '%s' is %g, not a usable number", i, name,
                       x[i]);
      return false;
    }
  return true;
}

static bool check_order(fg__grid *grid, const double *x, size_t count, bool reversed,
                        const char *name)
{
  for (size_t i = 1; i < count; ++i)
    if (!(x[i] > x[i - 1])) {
      const size_t before = reversed ? count - 1 - i : i - 1;
      fg__set_unusable(
          grid->unusable,
          "axis '%s' is not strictly monotonic: %g and %g at samples %zu and "
          "%zu",
          name, reversed ? x[i] : x[i - 1], reversed ? x[i - 1] : x[i], before,
          before + 1);
      return false;
    }
  return true;
}

/* Drops columns that repeat others at 360 degrees, and sets the period where the
 * remaining ones go round the globe. */
static void close_circle(fg__grid_axis *axis)
{
  const double *x = axis->coordinate;
  size_t n = axis->size;
  const double spacing = (x[n - 1] - x[0]) / (double)(n - 1);
  const double circle = 360.0 - REPEATED_TOLERANCE * spacing;
  while (n > 2 && x[n - 1] - x[0] >= circle)
    --n;
  const double cell = (x[n - 1] - x[0]) / (double)(n - 1);
  const double gap = 360.0 - (x[n - 1] - x[0]);
  if (fabs(gap - cell) > CLOSING_TOLERANCE * cell)
    return;
  axis->period = 360.0;
  if (axis->reversed)
    axis->first += axis->size - n;
  axis->size = n;
}

static void describe_axis(fg__grid_axis *axis, const fg__variable *coordinate, int k)
{
  char text[FG__TEXT_BYTES];
  axis->quantity = fg__units_of(coordinate, axis->units, sizeof axis->units);
  fg__attribute_text(coordinate, "standard_name", text, sizeof text);
  snprintf(axis->name, sizeof axis->name, "%s", coordinate->plain_name);
  const fg__role geographic = coordinate->geographic;
  if (strncmp(text, "grid_l", 6) == 0) {
    /* rotated pole: degrees, neither east nor north */
    axis->quantity = FG__QUANTITY_DEGREES;
    snprintf(axis->units, sizeof axis->units, "°");
    snprintf(axis->name, sizeof axis->name, "grid %s", text + 5);
  } else if ((int)geographic == k && k == FG__ROLE_X) {
    axis->quantity = FG__QUANTITY_DEGREES_EAST;
    snprintf(axis->units, sizeof axis->units, "°E");
    snprintf(axis->name, sizeof axis->name, "longitude");
  } else if ((int)geographic == k) {
    axis->quantity = FG__QUANTITY_DEGREES_NORTH;
    snprintf(axis->units, sizeof axis->units, "°N");
    snprintf(axis->name, sizeof axis->name, "latitude");
  } else if (strncmp(text, "projection_", 11) == 0) {
    snprintf(axis->name, sizeof axis->name, "%s", k == FG__ROLE_X ? "x" : "y");
  }
}

/* Refuses an axis of which the units, the standard name or else the name, and the
 * attribute `axis` do not all say that it is a longitude, or a latitude. */
static void check_direction(fg__grid *grid, const fg__variable *coordinate)
{
  static const char *const called[] = {"a longitude", "a latitude"};
  static const char *const attribute[] = {"standard_name", "units", "axis"};
  enum { NAME, UNITS, AXIS, STATEMENTS };
  char text[STATEMENTS][FG__TEXT_BYTES];
  for (int n = 0; n < STATEMENTS; ++n)
    fg__attribute_text(coordinate, attribute[n], text[n], sizeof text[n]);
  fg__unit unit;
  fg__unit_read(&unit, text[UNITS]);
  const fg__term name = {.name = text[NAME][0] ? text[NAME] : coordinate->plain_name};
  const fg__role says[STATEMENTS] = {
      fg__geographic_role(&name),
      unit.quantity == FG__QUANTITY_DEGREES_EAST    ? FG__ROLE_X
      : unit.quantity == FG__QUANTITY_DEGREES_NORTH ? FG__ROLE_Y
                                                    : FG__NO_ROLE,
      coordinate->geographic == FG__NO_ROLE ? FG__NO_ROLE
      : fg__is_same(text[AXIS], "x")        ? FG__ROLE_X
      : fg__is_same(text[AXIS], "y")        ? FG__ROLE_Y
                                            : FG__NO_ROLE};
  const char *const by[] = {text[NAME][0] ? "standard name" : "name", "units", "axis"};
  for (int n = 1; n < STATEMENTS; ++n)
    for (int m = 0; m < n; ++m)
      if (says[n] != FG__NO_ROLE && says[m] != FG__NO_ROLE && says[n] != says[m]) {
        fg__set_unusable(grid->unusable,
                         "'%.60s' is %s by its %s, and %s by its %s %.40s",
                         coordinate->plain_name, called[says[m] == FG__ROLE_Y], by[m],
                         called[says[n] == FG__ROLE_Y], by[n], text[n]);
        snprintf(grid->hint, sizeof grid->hint, "correct one of them in the file");
      }
}

static bool is_longitude(const fg__grid_axis *axis)
{
  return axis->quantity == FG__QUANTITY_DEGREES_EAST ||
         strcmp(axis->name, "grid longitude") == 0;
}

fg_status fg__grid_axis_read(fg__grid *grid, const fg__dataset *data, int k,
                             const fg__variable *coordinate)
{
  fg__grid_axis *axis = &grid->axis[k];
  axis->read_from = coordinate;
  describe_axis(axis, coordinate, k);
  check_direction(grid, coordinate);
  free(axis->coordinate);
  axis->coordinate = fg__allocate(axis->size, sizeof *axis->coordinate);
  if (!axis->coordinate)
    return fg__fail_memory(data->context, "an axis",
                           axis->size * sizeof *axis->coordinate);
  fg_status status = read_coordinates(axis, data, coordinate);
  if (status != FG_STATUS_OK ||
      !check_coordinates(grid, axis->coordinate, axis->size, coordinate->name))
    return status;
  if (is_longitude(axis))
    unwrap(axis->coordinate, axis->size);
  axis->reversed = false;
  if (axis->coordinate[axis->size - 1] < axis->coordinate[0])
    fg__grid_axis_flip(axis);
  if (check_order(grid, axis->coordinate, axis->size, axis->reversed, coordinate->name) &&
      is_longitude(axis))
    close_circle(axis);
  return FG_STATUS_OK;
}

fg_status fg__grid_axis_count(fg__grid *grid, const fg__dataset *data, int k)
{
  fg__grid_axis *axis = &grid->axis[k];
  axis->read_from = NULL;
  free(axis->coordinate);
  axis->coordinate = fg__allocate(axis->size, sizeof *axis->coordinate);
  if (!axis->coordinate)
    return fg__fail_memory(data->context, "an axis",
                           axis->size * sizeof *axis->coordinate);
  for (size_t i = 0; i < axis->size; ++i)
    axis->coordinate[i] = (double)i;
  axis->quantity = FG__QUANTITY_UNKNOWN;
  axis->units[0] = '\0';
  const fg__dimension *d = &data->dimensions[axis->dimension];
  snprintf(axis->name, sizeof axis->name, "%.*s", FG__TEXT_BYTES - 1,
           d->is_nameless ? (const char *const[]){"x", "y", "z"}[k] : d->name);
  return FG_STATUS_OK;
}

bool fg__counts_samples(const fg__grid_axis *axis)
{
  if (axis->period > 0.0 || (axis->coordinate[0] != 0.0 && axis->coordinate[0] != 1.0))
    return false;
  for (size_t i = 1; i < axis->size; ++i)
    if (axis->coordinate[i] != axis->coordinate[0] + (double)i)
      return false;
  return true;
}

void fg__call_geographic(fg__grid_axis *axis, int k)
{
  if (axis->quantity != FG__QUANTITY_UNKNOWN || axis->units[0])
    return;
  snprintf(axis->name, sizeof axis->name, "%s", k == 0 ? "longitude" : "latitude");
  snprintf(axis->units, sizeof axis->units, "%s", k == 0 ? "°E" : "°N");
}

void fg__check_axes_in_degrees(fg__grid *grid)
{
  const double *lon = grid->axis[0].coordinate, *lat = grid->axis[1].coordinate;
  if (!lon || !lat || grid->axis[1].quantity != FG__QUANTITY_DEGREES_NORTH)
    return;
  const double x[2] = {lon[0], lon[grid->axis[0].size - 1]},
               y[2] = {lat[0], lat[grid->axis[1].size - 1]};
  if (fg__fill_radians(x, y))
    fg__set_unusable(
        grid->unusable,
        "longitudes %g to %g and latitudes %g to %g are radians, not degrees", x[0], x[1],
        y[0], y[1]);
  if (fmax(-y[0], y[1]) > 91.0)
    fg__set_unusable(grid->unusable, "latitudes %g to %g lie beyond the poles", y[0],
                     y[1]);
}
