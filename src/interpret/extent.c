/* Where the file says that its coordinates lie, a second time: in the attributes
 * geospatial_lat_min, ... (Attribute Convention for Data Discovery) and in the bounds of
 * cells (CF conventions, section 7.1). */
#include "base/angle.h"
#include "base/decimal.h"
#include "base/memory.h"
#include "interpret/curvilinear/curvilinear.h"
#include "terms/units.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Attributes are rounded. */
static const double ROUNDING = 0.01;

typedef struct extent {
  double low, width; /* in degrees; longitudes go round */
  double stated[2];  /* in the file's units */
  bool is_longitude;
} extent;

static bool read_number(double *out, const fg__variable *file, const char *name)
{
  char text[FG__TEXT_BYTES] = "";
  const char *end = text;
  if (fg__attribute_numbers(file, name, out, 1) == 1)
    return true;
  *out = fg__attribute_text(file, name, text, sizeof text) ? fg__number_read(text, &end)
                                                           : 0.0;
  return text[0] && end != text && !*end;
}

/* Reads an extent; false where there is none, or it is none of the globe. */
static bool read_extent(extent *out, const fg__variable *of, bool is_longitude)
{
  static const char *const names[2][3] = {
      {"geospatial_lat_min", "geospatial_lat_max", "geospatial_lat_units"},
      {"geospatial_lon_min", "geospatial_lon_max", "geospatial_lon_units"}};
  const fg__variable *file = fg__file_of(of);
  const char *const *name = names[is_longitude];
  const double most = is_longitude ? 540.0 : 90.0;
  char units[FG__TEXT_BYTES];
  fg__unit unit;
  if (!read_number(&out->stated[0], file, name[0]) ||
      !read_number(&out->stated[1], file, name[1]))
    return false;
  fg__attribute_text(file, name[2], units, sizeof units);
  fg__unit_read(&unit, units);
  const double degree = unit.quantity == FG__QUANTITY_RADIANS ? 1.0 / FG__RADIANS : 1.0;
  const double a = degree * out->stated[0], b = degree * out->stated[1];
  if (!(fmax(fabs(a), fabs(b)) <= most + ROUNDING) || !(a < b || a > b))
    return false;
  out->low = is_longitude ? a : fmin(a, b);
  out->width =
      is_longitude && b < a ? b - a + 360.0 * ceil((a - b) / 360.0) : fabs(b - a);
  out->is_longitude = is_longitude;
  return true;
}

static bool is_outside(const extent *e, double value, double margin)
{
  if (!e->is_longitude)
    return value < e->low - margin || value > e->low + e->width + margin;
  const double turned = value - e->low - 360.0 * floor((value - e->low) / 360.0);
  return turned > e->width + margin && turned < 360.0 - margin;
}

/* Refuses coordinates of which most lie outside what the file states, doubts them where
 * some do; they are the centres of cells, `cells` along one side. */
static void check_stated(fg__grid *grid, const fg__variable *of, const double *value,
                         size_t count, size_t cells, bool is_longitude)
{
  extent e;
  size_t all = 0, outside = 0;
  double least = HUGE_VAL, largest = -HUGE_VAL;
  if (!read_extent(&e, of, is_longitude))
    return;
  for (size_t n = 0; n < count; ++n)
    if (isfinite(value[n])) {
      least = fmin(least, value[n]);
      largest = fmax(largest, value[n]);
      ++all;
    }
  const double margin = (largest - least) / (double)(cells - 1) + ROUNDING;
  for (size_t n = 0; n < count; ++n)
    outside += isfinite(value[n]) && is_outside(&e, value[n], margin);
  const char *const name = is_longitude ? "longitude" : "latitude";
  const char *const short_name = is_longitude ? "lon" : "lat";
  if (2 * outside > all) {
    fg__set_unusable(grid->unusable,
                     "%ss are %g to %g by coordinates, and %g to %g by geospatial_%s_min "
                     "and geospatial_%s_max",
                     name, least, largest, e.stated[0], e.stated[1], short_name,
                     short_name);
    snprintf(grid->hint, sizeof grid->hint, "--scale geo takes the coordinates");
  } else if (outside > 0) {
    fg__doubt(grid->doubts,
              "%zu of %zu %ss lie outside %g to %g, which geospatial_%s_min and "
              "geospatial_%s_max state",
              outside, all, name, e.stated[0], e.stated[1], short_name, short_name);
  }
}

/* The bounds of a coordinate's cells: two along its dimension; NULL: none. */
static const fg__variable *bounds_of(const fg__dataset *data, const fg__variable *v)
{
  char name[FG__TEXT_BYTES];
  if (v->rank != 1 || !fg__attribute_text(v, "bounds", name, sizeof name))
    return NULL;
  const fg__variable *bounds = fg__dataset_find(data, name);
  return bounds && bounds->rank == 2 && fg__is_number(bounds) &&
                 bounds->dimension[0] == v->dimension[0] &&
                 data->dimensions[bounds->dimension[1]].length == 2
             ? bounds
             : NULL;
}

/* Refuses a coordinate of which most values lie more than a cell outside the bounds of
 * their cells. */
static fg_status check_bounds(fg__grid *grid, const fg__dataset *data,
                              const fg__variable *v, int k)
{
  const fg__variable *bounds = bounds_of(data, v);
  if (!bounds)
    return FG_STATUS_OK;
  const fg__grid_axis *axis = &grid->axis[k];
  const size_t start[2] = {axis->first, 0}, count[2] = {axis->size, 2}, n = axis->size;
  double *edge = fg__allocate(n, 2 * sizeof *edge);
  if (!edge)
    return fg__fail_memory(data->context, "bounds", 2 * n * sizeof *edge);
  const fg_status status = fg__variable_fetch(bounds, start, count, edge);
  const fg__packing p = fg__packing_of(bounds);
  const bool scaled =
      fg__attribute_find(bounds, "units") && bounds->geographic != FG__NO_ROLE;
  const double unit = scaled ? 1.0 : fg__degrees_per_unit(v);
  size_t outside = 0;
  for (size_t i = 0; i < n && status == FG_STATUS_OK; ++i) {
    const double a = unit * (edge[2 * i] * p.scale + p.offset),
                 b = unit * (edge[2 * i + 1] * p.scale + p.offset),
                 half = 0.5 * fabs(b - a),
                 off = axis->coordinate[axis->reversed ? n - 1 - i : i] - 0.5 * (a + b);
    outside += half > 0.0 && fabs(k == 0 ? remainder(off, 360.0) : off) > 3.0 * half;
  }
  if (2 * outside > n) {
    fg__set_unusable(
        grid->unusable,
        "'%.60s' lies outside the cells of '%.60s', its bounds, at %zu of %zu "
        "samples",
        v->plain_name, bounds->plain_name, outside, n);
    snprintf(grid->hint, sizeof grid->hint, "--scale geo takes the coordinates");
  }
  free(edge);
  return status;
}

void fg__tell_time_bounds(fg__grid *grid, const fg__dataset *data)
{
  const fg__variable *times = grid->time_variable;
  const fg__variable *bounds = times && fg__is_number(times) ? bounds_of(data, times) : 0;
  double time, bound[2];
  char date[3][FG__UNIT_BYTES], units[FG__TEXT_BYTES];
  fg__unit unit;
  const size_t first[2] = {0, 0};
  if (!bounds || fg__variable_fetch_one(times, first, &time) ||
      fg__variable_fetch(bounds, first, (size_t[]){1, 2}, bound)) {
    fg_context_clear(data->context);
    return;
  }
  fg__attribute_text(times, "units", units, sizeof units);
  units[strcspn(units, " ")] = '\0'; /* "days" of "days since 1850-01-01" */
  fg__unit_read(&unit, units);
  const bool at_end = time == bound[1] && bound[1] > bound[0] &&
                      (bound[1] - bound[0]) * unit.factor >= 86400.0;
  const bool outside =
      (time < bound[0] && time < bound[1]) || (time > bound[0] && time > bound[1]);
  if ((at_end || outside) && fg__write_date(date[0], FG__UNIT_BYTES, times, time) &&
      fg__write_date(date[1], FG__UNIT_BYTES, times, bound[0]) &&
      fg__write_date(date[2], FG__UNIT_BYTES, times, bound[1]))
    fg__doubt(grid->doubts, "times %s their bounds: %s that of %s to %s",
              outside ? "lie outside" : "are the ends of", date[0], date[1], date[2]);
}

fg_status fg__check_extents(fg__grid *grid, const fg__dataset *data, const fg__pair *pair)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    const fg__grid_axis *axis = &grid->axis[k];
    const fg__variable *of = pair->component[grid->faces.used && k == 0 ? 1 : 0],
                       *v = fg__grid_axis_coordinate(data, grid, of, k);
    check_stated(grid, v ? v : of, axis->coordinate, axis->size, axis->size, k == 0);
    if (v)
      status = check_bounds(grid, data, v, k);
  }
  return status;
}

fg_status fg__check_mesh_extents(fg__grid *grid, const fg__dataset *data)
{
  const fg__curvilinear *mesh = grid->mesh;
  const size_t count = mesh->size[0] * mesh->size[1];
  const fg__curvilinear_part *at = mesh->centre.variable ? &mesh->centre : &mesh->part[0];
  fg__positions positions = {0};
  extent ignored;
  if (!read_extent(&ignored, at->longitude, true) &&
      !read_extent(&ignored, at->latitude, false))
    return FG_STATUS_OK;
  const fg_status status = fg__centres_read(&positions, data, mesh, 0);
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k)
    check_stated(grid, k == 0 ? at->longitude : at->latitude,
                 k == 0 ? positions.longitude : positions.latitude, count,
                 mesh->size[mesh->size[1] < mesh->size[0]], k == 0);
  fg__positions_clear(&positions);
  return status;
}
