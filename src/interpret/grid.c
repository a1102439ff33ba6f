/* The grid of a pair: dimensions, coordinates, units and scale. */
#include "base/memory.h"
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/space/space.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/frame.h"
#include "terms/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 2^31 samples take 24 gigabytes while a field is made; more is taken as damage. */
static const size_t MOST_SAMPLES = (size_t)1 << 31;

static bool is_usable(const fg__grid *grid)
{
  return grid->unusable[0] == '\0';
}

static void set_index_axis(const fg__dataset *data, const fg__variable *v, fg__role role,
                           int position, size_t *count, const fg__variable **coordinate,
                           char *name)
{
  *count = 1;
  if (position < 0) {
    *coordinate = fg__single_coordinate(data, v, role);
    return;
  }
  const fg__dimension *d = &data->dimensions[v->dimension[position]];
  *count = d->length;
  *coordinate = fg__coordinate(data, v, position);
  snprintf(name, FG__DIMENSION_BYTES, "%s", d->name);
}

static bool has_dates(const fg__variable *v)
{
  return fg__units_of(v, NULL, 0) == FG__QUANTITY_DATE;
}

/* Where a coordinate of time has durations only (the steps of a forecast, cfgrib), the
 * first variable along its dimension that has dates, such as valid_time. */
static const fg__variable *dates_beside(const fg__dataset *data,
                                        const fg__variable *coordinate)
{
  if (has_dates(coordinate))
    return coordinate;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->rank == 1 && v->dimension[0] == coordinate->dimension[0] && fg__is_array(v) &&
        has_dates(v))
      return v;
  }
  return coordinate;
}

void fg__set_index_axes(fg__grid *grid, const fg__dataset *data, const fg__variable *v)
{
  set_index_axis(data, v, FG__ROLE_TIME, grid->time, &grid->times, &grid->time_variable,
                 grid->time_name);
  set_index_axis(data, v, FG__ROLE_LEVEL, grid->level, &grid->levels,
                 &grid->level_variable, grid->level_name);
  if (grid->time < 0)
    return;
  if (grid->time_variable)
    grid->time_variable = dates_beside(data, grid->time_variable);
  const fg__variable *texts = fg__date_texts(data, v->dimension[grid->time]);
  /* FVCOM's days in single precision are minutes off */
  if (texts && (!grid->time_variable || grid->time_variable->type == FG__TYPE_FLOAT32))
    grid->time_variable = texts;
}

static fg_status find_dimensions(fg__grid *grid, const fg__dataset *data,
                                 const fg__variable *v)
{
  int position[FG__ROLES];
  const int extra = fg__roles_find(position, data, v);
  if (extra >= 0 && !data->takes_all_samples) {
    const fg__dimension *d = &data->dimensions[v->dimension[extra]];
    fg__set_unusable(grid->unusable,
                     "dimension '%.120s' of %zu samples is neither time nor level",
                     d->name, d->length);
    return fg__offer_samples(grid->hint, sizeof grid->hint, data, v->dimension[extra]);
  }
  if (position[FG__ROLE_X] < 0 || position[FG__ROLE_Y] < 0) {
    fg__set_unusable(grid->unusable,
                     "'%.120s' has only one dimension in space: a profile "
                     "or an unstructured mesh",
                     v->name);
    return FG_STATUS_OK;
  }
  for (int k = 0; k < 2; ++k) {
    const int dimension = v->dimension[position[k]];
    const fg__dimension *d = &data->dimensions[dimension];
    grid->axis[k].dimension = dimension;
    grid->axis[k].size = d->length;
    if (d->length < 2)
      fg__set_unusable(grid->unusable, "its %c axis '%.120s' has only %zu sample",
                       "xy"[k], d -> name, d -> length);
  }
  grid->samples = grid->axis[0].size * grid->axis[1].size;
  if (grid->samples > MOST_SAMPLES)
    fg__set_unusable(grid->unusable,
                     "%zu x %zu samples are more than the %zu that are handled",
                     grid->axis[0].size, grid->axis[1].size, MOST_SAMPLES);
  fg__check_storage(grid, data, v);
  grid->time = position[FG__ROLE_TIME];
  grid->level = position[FG__ROLE_LEVEL];
  fg__set_index_axes(grid, data, v);
  return FG_STATUS_OK;
}

const fg__variable *fg__grid_axis_coordinate(const fg__dataset *data,
                                             const fg__grid *grid, const fg__variable *v,
                                             int k)
{
  for (int p = 0; p < v->rank; ++p)
    if (v->dimension[p] == grid->axis[k].dimension)
      return fg__coordinate(data, v, p);
  return NULL;
}

/* Components along the grid are along axes only where its columns run east. */
static void refuse_turned(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                          fg_frame frame, int columns, bool *found)
{
  const bool turned = grid->axis[0].dimension != columns || grid->axis[0].reversed;
  if (!*found || !turned || !fg__is_along_grid(grid, data, pair, frame))
    return;
  *found = false;
  grid->off_axes = true;
  fg__set_unusable(grid->unusable,
                   "'%.60s' is along a grid whose columns do not run east",
                   pair->component[0]->plain_name);
}

/* Two-dimensional longitudes and latitudes as axes, where both components have the same;
 * where each has its own the grid is off_axes, as curvilinear ones are. */
static fg_status read_plane(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                            fg_frame frame, bool *found)
{
  const int columns = grid->axis[0].dimension;
  const fg__variable *u = pair->component[0], *v = pair->component[1];
  bool apart = false;
  if (grid->scale == FG_SCALE_AUTO || grid->scale == FG_SCALE_GEO) {
    const fg_status status = fg__plane_compare(&apart, grid, data, u, v);
    if (status != FG_STATUS_OK)
      return status;
  }
  if (!apart) {
    const fg_status status = fg__plane_find(grid, data, u, found);
    refuse_turned(grid, data, pair, frame, columns, found);
    return status;
  }
  grid->off_axes = true;
  fg__set_unusable(grid->unusable,
                   "'%.60s' and '%.60s' have longitudes and latitudes of their own: a "
                   "staggered grid",
                   u->plain_name, v->plain_name);
  return FG_STATUS_OK;
}

static bool is_called_geographic(const fg__variable *v)
{
  char text[FG__TEXT_BYTES];
  return fg__attribute_text(v, "standard_name", text, sizeof text) ||
         fg__starts_with(v->plain_name, "lon") || fg__starts_with(v->plain_name, "lat");
}

/* Degrees that count samples on both axes (grid_xt and grid_yt of FV3) are no places,
 * unless the coordinates are called longitude and latitude. */
static void check_counting(fg__grid *grid, const fg__variable *const coordinate[2])
{
  const fg__grid_axis *x = &grid->axis[0], *y = &grid->axis[1];
  if (!coordinate[0] || !coordinate[1] || x->quantity != FG__QUANTITY_DEGREES_EAST ||
      y->quantity != FG__QUANTITY_DEGREES_NORTH || !fg__counts_samples(x) ||
      !fg__counts_samples(y) || x->coordinate[0] != y->coordinate[0])
    return;
  if (is_called_geographic(coordinate[0]) && is_called_geographic(coordinate[1])) {
    fg__doubt(grid->doubts,
              "'%.60s' and '%.60s' count from %g in steps of 1 degree, as "
              "sample numbers do",
              coordinate[0]->plain_name, coordinate[1]->plain_name, x->coordinate[0]);
    return;
  }
  fg__set_unusable(grid->unusable,
                   "'%.60s' and '%.60s' are in degrees, but count samples: "
                   "%g to %g and %g to %g",
                   coordinate[0]->plain_name, coordinate[1]->plain_name, x->coordinate[0],
                   x->coordinate[x->size - 1], y->coordinate[0],
                   y->coordinate[y->size - 1]);
  snprintf(
      grid->hint, sizeof grid->hint,
      "--mesh-from names a file with the positions; --scale geo takes them for degrees, "
      "--scale plain for sample numbers");
}

static fg_status read_axes(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                           fg_frame frame)
{
  const fg__variable *v = pair->component[0];
  const fg__variable *coordinate[2];
  const bool is_free = grid->scale == FG_SCALE_AUTO;
  bool both = true;
  for (int k = 0; k < 2; ++k) {
    coordinate[k] = fg__grid_axis_coordinate(data, grid, v, k);
    both = both && coordinate[k] && !fg__may_be_index(coordinate[k]);
  }
  /* longitudes and latitudes along the axes may be nominal (MOM) */
  const bool geographic = both && coordinate[0]->geographic == FG__ROLE_X &&
                          coordinate[1]->geographic == FG__ROLE_Y;
  bool nominal = geographic && fg__names_plane(grid, data, v);
  if (geographic && !nominal && is_free) {
    const fg_status status = fg__plane_contradicts(&nominal, grid, data, v, coordinate);
    if (status != FG_STATUS_OK)
      return status;
    if (nominal)
      fg__doubt(grid->doubts,
                "'%.60s' and '%.60s' are not where the longitudes and "
                "latitudes in two dimensions are, which are taken",
                coordinate[0]->plain_name, coordinate[1]->plain_name);
  }
  if (!both || nominal) {
    bool found = false;
    fg_status status = read_plane(grid, data, pair, frame, &found);
    if (status != FG_STATUS_OK || found || !is_usable(grid))
      return status;
  }
  for (int k = 0; k < 2; ++k) {
    fg_status status = coordinate[k] ? fg__grid_axis_read(grid, data, k, coordinate[k])
                                     : fg__grid_axis_count(grid, data, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  if (is_free && is_usable(grid))
    check_counting(grid, coordinate);
  return geographic ? fg__check_other_places(grid, data, v, coordinate) : FG_STATUS_OK;
}

static void set_positions(fg__grid *grid, const fg__variable *v)
{
  for (int k = 0; k < 2; ++k)
    for (int p = 0; p < v->rank; ++p)
      if (v->dimension[p] == grid->axis[k].dimension)
        grid->axis[k].position = p;
}

static void check_units(fg__grid *grid, const fg__pair *pair, fg__quantity *quantity)
{
  char of_u[FG__TEXT_BYTES];
  char of_v[FG__TEXT_BYTES];
  *quantity = fg__units_of(pair->component[0], of_u, sizeof of_u);
  const fg__quantity other = fg__units_of(pair->component[1], of_v, sizeof of_v);
  fg__check_packing(grid, pair);
  if (pair->polar.sense != 0)
    return;
  if (of_u[0] && of_v[0] && strcmp(of_u, of_v) != 0)
    fg__set_unusable(grid->unusable, "'%.60s' is in %.40s, '%.60s' in %.40s",
                     pair->component[0]->plain_name, of_u, pair->component[1]->plain_name,
                     of_v);
  if (*quantity == FG__QUANTITY_UNKNOWN)
    *quantity = other;
}

static fg_scale natural_scale(const fg__grid *grid, fg__quantity velocity)
{
  const fg__quantity x = grid->axis[0].quantity;
  const fg__quantity y = grid->axis[1].quantity;
  /* any vector along east and north lies on the sphere; an angular speed counts
   * degrees */
  if (x == FG__QUANTITY_DEGREES_EAST && y == FG__QUANTITY_DEGREES_NORTH &&
      velocity != FG__QUANTITY_ANGULAR_SPEED)
    return FG_SCALE_GEO;
  if (x == FG__QUANTITY_LENGTH && y == FG__QUANTITY_LENGTH)
    return FG_SCALE_MAP;
  return FG_SCALE_PLAIN;
}

static bool is_rotated(const fg__grid *grid)
{
  return strcmp(grid->axis[0].name, "grid longitude") == 0 &&
         strcmp(grid->axis[1].name, "grid latitude") == 0;
}

/* Components along east and north are not components along the axes of a projection or of
 * a rotated pole, except in cylindrical projections such as Mercator's. Without the
 * projection they cannot be rotated; of a speed and a direction fg__check_polar says
 * so. */
static void check_directions(fg__grid *grid, const fg__dataset *data,
                             const fg__pair *pair, fg_frame frame)
{
  const fg__variable *u = pair->component[0];
  static const char *const upright[] = {"mercator", "latitude_longitude",
                                        "lambert_cylindrical_equal_area"};
  char mapping[FG__TEXT_BYTES];
  const fg__term term = fg__term_of(u);
  const bool east = pair->polar.sense != 0 || fg__says_east(&term);
  if (frame == FG_FRAME_GRID || (frame == FG_FRAME_AUTO && !east))
    return;
  if (grid->projection[0]) {
    grid->points_east = true;
    fg__check_frame(grid, pair, frame);
    return;
  }
  const fg__variable *described = fg__grid_mapping_of(data, u);
  if (!described ||
      !fg__attribute_text(described, "grid_mapping_name", mapping, sizeof mapping))
    snprintf(mapping, sizeof mapping, "%s",
             is_rotated(grid) && pair->polar.sense == 0 ? "rotated" : upright[0]);
  for (size_t i = 0; i < sizeof upright / sizeof *upright; ++i)
    if (strcmp(mapping, upright[i]) == 0)
      return;
  fg__set_unusable(grid->unusable,
                   "'%.60s' points east, but the axes of its %.60s grid do not",
                   u->plain_name, mapping);
  snprintf(grid->hint, sizeof grid->hint,
           "--scale map or plain takes the components as if they were along the axes");
}

/* In a plane of unknown projection points are placed by longitude and latitude, where the
 * file has them. */
static fg_status prefer_positions(fg__grid *grid, const fg__dataset *data,
                                  const fg__pair *pair, fg_frame frame)
{
  const fg_scale of_plane = grid->scale;
  bool found = false;
  grid->scale = FG_SCALE_AUTO;
  const fg_status status = read_plane(grid, data, pair, frame, &found);
  grid->scale = found ? FG_SCALE_GEO : of_plane;
  set_positions(grid, pair->component[0]);
  return status;
}

static fg_status settle_scale(fg__grid *grid, const fg__dataset *data,
                              const fg__pair *pair, fg__quantity velocity,
                              const fg_read_options *options)
{
  const fg__grid_axis *x = &grid->axis[0];
  const fg__grid_axis *y = &grid->axis[1];
  const fg_scale wanted = options->scale;
  fg_status status = FG_STATUS_OK;
  grid->scale = wanted == FG_SCALE_AUTO ? natural_scale(grid, velocity) : wanted;
  if (grid->scale == FG_SCALE_MAP || (wanted == FG_SCALE_AUTO && is_rotated(grid)))
    status = fg__projection_find(grid, data, pair->component[0]);
  if (grid->projection[0])
    grid->scale = FG_SCALE_MAP;
  else if (wanted == FG_SCALE_AUTO && grid->scale != FG_SCALE_GEO && is_usable(grid) &&
           !grid->faces.used)
    status = prefer_positions(grid, data, pair, options->frame);
  if ((wanted == FG_SCALE_AUTO || wanted == FG_SCALE_GEO || pair->polar.sense != 0) &&
      is_usable(grid))
    check_directions(grid, data, pair, options->frame);
  for (int k = 0; k < 2 && grid->scale == FG_SCALE_GEO; ++k)
    fg__call_geographic(&grid->axis[k], k);
  if (grid->scale == FG_SCALE_GEO &&
      (x->quantity == FG__QUANTITY_LENGTH || y->quantity == FG__QUANTITY_LENGTH))
    fg__set_unusable(grid->unusable,
                     "scale geo needs axes in degrees; '%.60s' is in %.40s", x->name,
                     x->units);
  if (grid->scale == FG_SCALE_GEO && is_usable(grid))
    fg__check_axes_in_degrees(grid);
  if (grid->scale == FG_SCALE_GEO && wanted == FG_SCALE_AUTO && is_usable(grid) &&
      status == FG_STATUS_OK)
    status = fg__check_extents(grid, data, pair);
  if (grid->scale == FG_SCALE_MAP && strcmp(x->units, y->units) != 0)
    fg__set_unusable(grid->unusable, "'%.60s' is in %.40s, '%.60s' in %.40s: no plane",
                     x->name, x->units, y->name, y->units);
  return status;
}

/* Reads the axes: their coordinates, units and scale. */
static fg_status find_on_axes(fg__grid *grid, const fg__dataset *data,
                              const fg__pair *pair, const fg_read_options *options)
{
  const fg__variable *u = pair->component[0];
  fg__check_shapes(grid, data, u, pair->component[1]);
  if (!is_usable(grid))
    return FG_STATUS_OK;
  fg_status status = read_axes(grid, data, pair, options->frame);
  if (status != FG_STATUS_OK || !is_usable(grid))
    return status;
  set_positions(grid, u);
  grid->samples = grid->axis[0].size * grid->axis[1].size;
  fg__check_nameless(grid, data, u);
  fg__quantity velocity;
  check_units(grid, pair, &velocity);
  if (is_usable(grid))
    status = settle_scale(grid, data, pair, velocity, options);
  if (status != FG_STATUS_OK || !is_usable(grid))
    return status;
  if (pair->component[2])
    status = fg__volume_find(grid, data, pair);
  if (grid->dimension == 2)
    fg__nameless_time(grid, data, u);
  grid->off_axes = false; /* the third component alone may be staggered */
  return status;
}

/* The same for the centres of cells in a plane, where components are on the faces. */
static fg_status find_on_faces(fg__grid *grid, const fg__dataset *data,
                               const fg__pair *pair, const fg_read_options *options)
{
  fg_status status = fg__staggered_find(grid, data, pair);
  if (status != FG_STATUS_OK || !grid->faces.used || !is_usable(grid))
    return status;
  fg__quantity velocity;
  check_units(grid, pair, &velocity);
  return is_usable(grid) ? settle_scale(grid, data, pair, velocity, options) : status;
}

static fg_status find_grid(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                           const fg_read_options *options)
{
  *grid = (fg__grid){.dimension = 2,
                     .time = -1,
                     .level = -1,
                     .times = 1,
                     .levels = 1,
                     .scale = options->scale};
  fg_status status = fg__unstructured_find(grid, data, pair, options);
  if (status != FG_STATUS_OK)
    return status;
  if (!grid->unstructured)
    for (int k = 0; k < 2; ++k)
      fg__check_variable(grid, pair->component[k]);
  for (int k = 0; k < 2 && is_usable(grid); ++k)
    fg__check_dimensions(grid, data, pair->component[k]);
  int position[FG__ROLES];
  const int along = is_usable(grid) && !grid->unstructured
                        ? fg__section_along(position, data, pair->component[0])
                        : -1;
  if (along >= 0)
    return fg__section_find(grid, data, pair, options, along, position);
  if (options->scale == FG_SCALE_LOG)
    fg__set_unusable(grid->unusable, "--scale log is for vertical sections");
  if (is_usable(grid) && !grid->unstructured)
    status = find_dimensions(grid, data, pair->component[0]);
  fg__quantity velocity;
  if (status == FG_STATUS_OK && is_usable(grid) && grid->unstructured)
    check_units(grid, pair, &velocity);
  if (status != FG_STATUS_OK || !is_usable(grid) || grid->unstructured)
    return status;
  status = find_on_axes(grid, data, pair, options);
  if (status == FG_STATUS_OK && grid->off_axes)
    status = fg__curvilinear_find(grid, data, pair, options);
  if (status == FG_STATUS_OK && grid->off_axes && !grid->mesh &&
      options->scale != FG_SCALE_GEO)
    status = find_on_faces(grid, data, pair, options);
  if (status == FG_STATUS_OK && grid->mesh && is_usable(grid)) {
    check_units(grid, pair, &velocity);
    if (options->scale == FG_SCALE_AUTO)
      status = fg__check_mesh_extents(grid, data);
  }
  fg__tell_unused_places(grid, data, pair, options);
  return status;
}

fg_status fg__grid_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                        const fg_read_options *options)
{
  if (data->space.is_there)
    return fg__space_find(grid, data, pair, options);
  fg_status status = find_grid(grid, data, pair, options);
  if (status == FG_STATUS_OK && is_usable(grid))
    fg__check_polar(grid, pair, options);
  if (status == FG_STATUS_OK && is_usable(grid) && !options->vars)
    status = fg__check_names(grid, data, pair);
  if (status == FG_STATUS_OK && is_usable(grid))
    fg__tell_time_bounds(grid, data);
  return status;
}

void fg__grid_clear(fg__grid *grid)
{
  for (int k = 0; k < 3; ++k) {
    free(grid->axis[k].coordinate);
    grid->axis[k].coordinate = NULL;
  }
  free(grid->rate);
  grid->rate = NULL;
  fg__curvilinear_destroy(grid->mesh);
  grid->mesh = NULL;
  fg__unstructured_destroy(grid->unstructured);
  grid->unstructured = NULL;
}
