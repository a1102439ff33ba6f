/* The projection of a grid's axes, or its rotated pole: CF's grid mapping as a PROJ
 * string (CF conventions, appendix F), checked against the file's longitudes and
 * latitudes where it has them. */
#include "base/angle.h"
#include "base/decimal.h"
#include "base/memory.h"
#include "interpret/interpret.h"
#include "interpret/projector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Number of positions compared along each axis. */
enum { COMPARED = 24 };

/* Fractions of a cell: a smaller offset of the axes is rounding; deviations beyond the
 * second mean another projection. */
static const double SMALLEST_SHIFT = 1e-3;
static const double LARGEST_RESIDUAL = 0.5;

typedef struct cf_mapping {
  const char *name, *projection;
  const char *parallel; /* PROJ name of the standard parallel; with two: lat_1, lat_2 */
} cf_mapping;

static const cf_mapping *mapping_of(const char *name)
{
  static const cf_mapping known[] = {
      {"lambert_conformal_conic", "lcc", "lat_1"},
      {"polar_stereographic", "stere", "lat_ts"},
      {"stereographic", "stere", "lat_ts"},
      {"lambert_azimuthal_equal_area", "laea", NULL},
      {"azimuthal_equidistant", "aeqd", NULL},
      {"albers_conical_equal_area", "aea", "lat_1"},
      {"lambert_cylindrical_equal_area", "cea", "lat_ts"},
      {"mercator", "merc", "lat_ts"},
      {"transverse_mercator", "tmerc", NULL},
      {"orthographic", "ortho", NULL},
      {"sinusoidal", "sinu", NULL},
      {"rotated_latitude_longitude", "ob_tran +o_proj=longlat", NULL},
  };
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n)
    if (strcmp(known[n].name, name) == 0)
      return &known[n];
  return NULL;
}

/* A PROJ string under construction; text beyond its capacity is dropped. */
typedef struct proj_text {
  char *out;
  size_t size, used;
} proj_text;

static void add_words(proj_text *text, const char *key, const char *value)
{
  const int written =
      snprintf(text->out + text->used, text->size - text->used, "%s+%s%s%s",
               text->used ? " " : "", key, *value ? "=" : "", value);
  if (written > 0 && (size_t)written < text->size - text->used)
    text->used += (size_t)written;
  else
    text->out[text->used] = '\0';
}

static void add_number(proj_text *text, const char *key, double value)
{
  char number[FG__NUMBER_BYTES];
  fg__number_write(number, value);
  add_words(text, key, number);
}

static bool number_of(const fg__variable *v, const char *attribute, double *out)
{
  return fg__attribute_numbers(v, attribute, out, 1) == 1 && isfinite(*out);
}

static void add_earth(proj_text *text, const fg__variable *v)
{
  char name[FG__TEXT_BYTES];
  double a, other;
  if (number_of(v, "earth_radius", &a)) {
    add_number(text, "R", a);
  } else if (number_of(v, "semi_major_axis", &a)) {
    if (number_of(v, "inverse_flattening", &other) && other != 0.0) {
      add_number(text, "a", a);
      add_number(text, "rf", other);
    } else if (number_of(v, "semi_minor_axis", &other) && other != a) {
      add_number(text, "a", a);
      add_number(text, "b", other);
    } else {
      add_number(text, "R", a);
    }
  } else {
    fg__attribute_text(v, "reference_ellipsoid_name", name, sizeof name);
    add_words(text, "ellps", strstr(name, "GRS") ? "GRS80" : "WGS84");
  }
}

static void add_parameters(proj_text *text, const fg__variable *v,
                           const cf_mapping *mapping)
{
  static const char *const known[][2] = {
      {"latitude_of_projection_origin", "lat_0"},
      {"longitude_of_projection_origin", "lon_0"},
      {"longitude_of_central_meridian", "lon_0"},
      {"straight_vertical_longitude_from_pole", "lon_0"},
      {"scale_factor_at_projection_origin", "k_0"},
      {"scale_factor_at_central_meridian", "k_0"},
      {"grid_north_pole_latitude", "o_lat_p"},
      {"north_pole_grid_longitude", "o_lon_p"},
  };
  double value, parallel[2];
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n)
    if (number_of(v, known[n][0], &value))
      add_number(text, known[n][1], value);
  if (number_of(v, "grid_north_pole_longitude", &value))
    add_number(text, "lon_0", remainder(value + 180.0, 360.0));
  const int parallels = fg__attribute_numbers(v, "standard_parallel", parallel, 2);
  if (mapping->parallel && parallels > 0)
    add_number(text, mapping->parallel, parallel[0]);
  if (mapping->parallel && parallels > 1 && strcmp(mapping->parallel, "lat_1") == 0)
    add_number(text, "lat_2", parallel[1]);
}

/* Metres in the axis's unit; 1 where it is unknown. */
static double metres_of(const fg__grid_axis *axis)
{
  return strcmp(axis->units, "km") == 0 ? 1000.0 : 1.0;
}

/* Writes the PROJ string. shift: added to false easting and northing, in the axes'
 * units. */
static bool compose(fg__grid *grid, const fg__variable *v, const double shift[2])
{
  char name[FG__TEXT_BYTES];
  proj_text text = {grid->projection, sizeof grid->projection, 0};
  fg__attribute_text(v, "grid_mapping_name", name, sizeof name);
  const cf_mapping *mapping = mapping_of(name);
  grid->projection[0] = '\0';
  if (!mapping)
    return false;
  const bool angular = strncmp(mapping->projection, "ob_tran", 7) == 0;
  static const char *const offset[2][2] = {{"false_easting", "x_0"},
                                           {"false_northing", "y_0"}};
  add_words(&text, "proj", mapping->projection);
  add_parameters(&text, v, mapping);
  for (int k = 0; k < 2 && !angular; ++k) {
    double value = 0.0;
    number_of(v, offset[k][0], &value);
    value += shift[k];
    if (value != 0.0)
      add_number(&text, offset[k][1], value * metres_of(&grid->axis[k]));
  }
  add_earth(&text, v);
  if (!angular)
    add_words(&text, "units", metres_of(&grid->axis[0]) == 1.0 ? "m" : "km");
  return text.used > 0;
}

/* The file's longitudes and latitudes at some points, projected to the plane, minus the
 * axes' coordinates there: the mean difference, and the largest deviation from it in
 * cells. */
typedef struct agreement {
  double shift[2], residual;
  size_t count;
} agreement;

static void compare(agreement *out, const fg__projector *by, const fg__map *map,
                    const fg__grid *grid, const double *longitude, const double *latitude)
{
  double off[COMPARED * COMPARED + 2 * COMPARED + 1][2];
  const size_t columns = grid->axis[0].size, rows = grid->axis[1].size;
  *out = (agreement){{0.0, 0.0}, 0.0, 0};
  for (size_t j = 0; j < rows; j += rows / COMPARED + 1)
    for (size_t i = 0; i < columns; i += columns / COMPARED + 1) {
      double at[2];
      by->forward(map, 1, &longitude[j * columns + i], &latitude[j * columns + i], &at[0],
                  &at[1]);
      if (!isfinite(at[0]) || !isfinite(at[1]) || out->count >= sizeof off / sizeof *off)
        continue;
      off[out->count][0] = grid->axis[0].coordinate[i] - at[0];
      off[out->count][1] = grid->axis[1].coordinate[j] - at[1];
      for (int k = 0; k < 2; ++k)
        out->shift[k] += off[out->count][k];
      ++out->count;
    }
  for (int k = 0; k < 2 && out->count > 0; ++k) {
    const fg__grid_axis *axis = &grid->axis[k];
    const double cell = (axis->coordinate[axis->size - 1] - axis->coordinate[0]) /
                        (double)(axis->size - 1);
    out->shift[k] /= (double)out->count;
    for (size_t n = 0; n < out->count; ++n)
      out->residual = fmax(out->residual, fabs(off[n][k] - out->shift[k]) / cell);
    if (fabs(out->shift[k]) < SMALLEST_SHIFT * cell)
      out->shift[k] = 0.0;
  }
}

static fg_status read_positions(double *position[2], const fg__dataset *data,
                                const fg__grid *grid, const fg__variable *u)
{
  for (int k = 0; k < 2; ++k) {
    const fg__variable *v = fg__plane_coordinate(grid, data, u, (fg__role)k);
    if (!v || !fg__lies_on(data, v, grid, u))
      return FG_STATUS_OK;
    position[k] = fg__allocate(grid->samples, sizeof *position[k]);
    if (!position[k])
      return fg__fail_memory(data->context, "a coordinate",
                             grid->samples * sizeof *position[k]);
    const fg_status status = fg__read_doubles(position[k], data, v, grid, u, 0, 0);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

/* Compares; shifts or rejects the projection. */
static fg_status check(fg__grid *grid, const fg__dataset *data, const fg__variable *u,
                       const fg__variable *described)
{
  double *position[2] = {NULL, NULL};
  const fg__projector *by = data->projector;
  fg__map *map = NULL;
  agreement got = {{0.0, 0.0}, 0.0, 0};
  fg_status status = read_positions(position, data, grid, u);
  if (status == FG_STATUS_OK && position[0] && position[1] &&
      by->create(&map, NULL, grid->projection) == FG_STATUS_OK)
    compare(&got, by, map, grid, position[0], position[1]);
  const bool angular = strstr(grid->projection, "ob_tran") != NULL;
  if (got.count > 0 && (got.residual > LARGEST_RESIDUAL ||
                        (angular && (got.shift[0] != 0.0 || got.shift[1] != 0.0)))) {
    grid->off_axes = true;
    fg__set_unusable(grid->unusable,
                     "the longitudes and latitudes of its points are not those of "
                     "its projection");
    fg__doubt(grid->doubts,
              "points lie up to %.3g cells from where the projection of '%.60s' has "
              "them: their longitudes and latitudes are taken",
              got.residual, described->plain_name);
  } else if (got.shift[0] != 0.0 || got.shift[1] != 0.0) {
    compose(grid, described, got.shift);
  }
  by->destroy(map);
  free(position[0]);
  free(position[1]);
  return status;
}

const fg__variable *fg__grid_mapping_of(const fg__dataset *data,
                                        const fg__variable *variable)
{
  char name[FG__TEXT_BYTES];
  fg__attribute_text(variable, "grid_mapping", name, sizeof name);
  name[strcspn(name, ": ")] = '\0';
  return name[0] ? fg__dataset_find(data, name) : NULL;
}

fg_status fg__projection_find(fg__grid *grid, const fg__dataset *data,
                              const fg__variable *u)
{
  static const double none[2] = {0.0, 0.0};
  const fg__variable *described = fg__grid_mapping_of(data, u);
  const fg__projector *by = data->projector;
  fg__map *map = NULL;
  grid->projection[0] = '\0';
  if (!by || !described || !compose(grid, described, none))
    return FG_STATUS_OK;
  const fg_status status = by->create(&map, NULL, grid->projection);
  by->destroy(map);
  if (status != FG_STATUS_OK) {
    grid->projection[0] = '\0';
    return status == FG_STATUS_MEMORY ? fg__fail_memory(data->context, "a map", 0)
                                      : FG_STATUS_OK;
  }
  return check(grid, data, u, described);
}
