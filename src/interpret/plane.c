/* Longitude and latitude in two-dimensional arrays: a rectilinear grid when each varies
 * along one dimension only, else a curvilinear one. */
#include "base/memory.h"
#include "interpret/interpret.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Deviations from a rectilinear grid by less than this fraction of a cell are rounding:
 * those of float are 1.5e-5 degrees. */
static const double STRAIGHT_TOLERANCE = 0.01;

/* Positions nearer than this part of a cell coincide; those of a cell's centre, faces and
 * corners are less than one cell apart. */
static const double SAME_PLACE = 0.1, SAME_CELL = 1.0;

typedef struct plane {
  const fg__variable *variable;
  double *value; /* the file's order: [first dimension][second dimension] */
} plane;

bool fg__is_listed(const char *names, const char *name)
{
  const size_t length = strlen(name);
  for (const char *c = names; length > 0 && (c = strstr(c, name)); c += length)
    if ((c == names || c[-1] == ' ') && (c[length] == '\0' || c[length] == ' '))
      return true;
  return false;
}

static const int *last_dimensions(const fg__variable *v)
{
  return v->dimension + v->rank - 2;
}

bool fg__alike_dimension(const fg__dataset *data, int a, int b)
{
  const fg__dimension *of = data->dimensions;
  return a == b || (of[a].file != of[b].file && of[a].length == of[b].length &&
                    strcmp(of[a].name, of[b].name) == 0);
}

bool fg__named_alike(const char *of_u, const char *of_v)
{
  for (; *of_u && *of_v; ++of_u, ++of_v)
    if (*of_u != *of_v && !(*of_u == 'u' && *of_v == 'v'))
      return false;
  return *of_u == *of_v;
}

/* Time may be the first dimension: WRF repeats the coordinates for every time. */
static bool lies_in_plane(const fg__dataset *data, const fg__variable *v, int x, int y)
{
  if (v->rank < 2 || v->rank > 3 || !fg__is_number(v))
    return false;
  const int *last = last_dimensions(v);
  return (fg__alike_dimension(data, last[0], x) &&
          fg__alike_dimension(data, last[1], y)) ||
         (fg__alike_dimension(data, last[0], y) && fg__alike_dimension(data, last[1], x));
}

const fg__variable *fg__plane_coordinate(const fg__grid *grid, const fg__dataset *data,
                                         const fg__variable *variable, fg__role role)
{
  char listed[FG__TEXT_BYTES];
  fg__attribute_text(variable, "coordinates", listed, sizeof listed);
  const int x = grid->axis[0].dimension;
  const int y = grid->axis[1].dimension;
  const fg__variable *found = NULL;
  int best = -1;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!lies_in_plane(data, v, x, y) || v->geographic != role)
      continue;
    const int rank =
        2 * (v->file == variable->file) + fg__is_listed(listed, v->plain_name);
    if (rank > best) {
      best = rank;
      found = v;
    }
  }
  return found;
}

bool fg__names_plane(const fg__grid *grid, const fg__dataset *data,
                     const fg__variable *variable)
{
  char listed[FG__TEXT_BYTES];
  fg__attribute_text(variable, "coordinates", listed, sizeof listed);
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y; ++role) {
    const fg__variable *v = fg__plane_coordinate(grid, data, variable, (fg__role)role);
    if (!v || !fg__is_listed(listed, v->plain_name))
      return false;
  }
  return true;
}

static fg_status read_plane(plane *out, const fg__dataset *data)
{
  const fg__variable *v = out->variable;
  size_t start[FG__RANK] = {0};
  size_t count[FG__RANK];
  size_t samples = 1;
  for (int k = 0; k < v->rank; ++k) {
    count[k] = k < v->rank - 2 ? 1 : data->dimensions[v->dimension[k]].length;
    samples *= count[k];
  }
  fg_status status = fg__check_memory(data->context, data->file[0].path, (double)samples,
                                      sizeof *out->value);
  if (status != FG_STATUS_OK)
    return status;
  out->value = fg__allocate(samples, sizeof *out->value);
  if (!out->value)
    return fg__fail_memory(data->context, "a coordinate", samples * sizeof *out->value);
  return fg__variable_fetch(v, start, count, out->value);
}

/* The only dimension (0 or 1) along which the array varies, or -1. Longitudes are
 * compared modulo 360. */
static int direction_of(const plane *p, size_t n0, size_t n1, bool longitude)
{
  for (int along = 0; along < 2; ++along) {
    const size_t n = along == 0 ? n0 : n1;
    const size_t across = along == 0 ? n1 : n0;
    const size_t step = along == 0 ? n1 : 1;
    const size_t step_across = along == 0 ? 1 : n1;
    double spacing = 0.0;
    for (size_t i = 1; i < n; ++i) {
      double d = p->value[i * step] - p->value[(i - 1) * step];
      d = longitude ? remainder(d, 360.0) : d;
      spacing += fabs(d) / (double)(n - 1);
    }
    bool constant = spacing > 0.0;
    for (size_t i = 0; i < n && constant; ++i)
      for (size_t j = 1; j < across && constant; ++j) {
        double d = p->value[i * step + j * step_across] - p->value[i * step];
        d = longitude ? remainder(d, 360.0) : d;
        constant = fabs(d) <= STRAIGHT_TOLERANCE * spacing;
      }
    if (constant)
      return along;
  }
  return -1;
}

/* The mean difference of neighbours along the first row or the first column, whichever is
 * larger. */
static double step_of(const plane *p, size_t n0, size_t n1, bool longitude)
{
  double mean[2] = {0.0, 0.0};
  for (int along = 0; along < 2; ++along) {
    const size_t n = along == 0 ? n0 : n1, step = along == 0 ? n1 : 1;
    for (size_t i = 1; i < n; ++i) {
      const double d = p->value[i * step] - p->value[(i - 1) * step];
      mean[along] += fabs(longitude ? remainder(d, 360.0) : d) / (double)(n - 1);
    }
  }
  return fmax(mean[0], mean[1]);
}

/* Whether most values of two coordinates differ by more than so many cells; turned: the
 * second has its dimensions in the other order. Values that are no numbers do not
 * count. */
static bool most_differ(const plane of[2], size_t n0, size_t n1, bool turned,
                        bool longitude, double cells)
{
  const double limit = cells * step_of(&of[0], n0, n1, longitude);
  size_t differ = 0, equal = 0;
  for (size_t i = 0; i < n0; ++i)
    for (size_t j = 0; j < n1; ++j) {
      double d = of[0].value[i * n1 + j] - of[1].value[turned ? j * n0 + i : i * n1 + j];
      d = fabs(longitude ? remainder(d, 360.0) : d);
      differ += d > limit;
      equal += d <= limit;
    }
  return differ > equal;
}

/* Whether longitudes or latitudes are all alike, as idealised runs have them. */
static bool are_alike(const plane *p, size_t count)
{
  size_t n = 1;
  while (n < count && p->value[n] == p->value[0])
    ++n;
  return n == count;
}

static fg_status compare_planes(bool *apart, const fg__dataset *data, plane of[2],
                                bool turned, bool longitude)
{
  const int *dimension = last_dimensions(of[0].variable);
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k)
    status = read_plane(&of[k], data);
  if (status == FG_STATUS_OK)
    *apart =
        most_differ(of, data->dimensions[dimension[0]].length,
                    data->dimensions[dimension[1]].length, turned, longitude, SAME_PLACE);
  free(of[0].value);
  free(of[1].value);
  return status;
}

fg_status fg__plane_compare(bool *apart, const fg__grid *grid, const fg__dataset *data,
                            const fg__variable *u, const fg__variable *v)
{
  fg_status status = FG_STATUS_OK;
  fg__grid of_v = {.dimension = 2}; /* in its own file its dimensions are others */
  for (int k = 0; k < 2; ++k)
    for (int p = 0; p < u->rank; ++p)
      if (u->dimension[p] == grid->axis[k].dimension)
        of_v.axis[k].dimension = v->dimension[p];
  *apart = false;
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y && !*apart && status == FG_STATUS_OK;
       ++role) {
    plane of[2] = {{fg__plane_coordinate(grid, data, u, (fg__role)role), NULL},
                   {fg__plane_coordinate(&of_v, data, v, (fg__role)role), NULL}};
    if (!of[0].variable || !of[1].variable || of[0].variable == of[1].variable)
      continue;
    const int x = grid->axis[0].dimension, x_of_v = of_v.axis[0].dimension;
    const bool turned =
        fg__alike_dimension(data, last_dimensions(of[0].variable)[0], x) !=
        fg__alike_dimension(data, last_dimensions(of[1].variable)[0], x_of_v);
    status = compare_planes(apart, data, of, turned, role == FG__ROLE_X);
  }
  return status;
}

/* Whether another variable is of positions on the dimensions of those that are taken, and
 * `coordinates` names both or neither. */
static bool is_alike(const fg__variable *other, const fg__variable *taken,
                     const char *listed)
{
  if (other == taken || other->file != taken->file || other->rank != taken->rank ||
      other->geographic != taken->geographic || !fg__is_array(other) ||
      fg__is_listed(listed, other->plain_name) !=
          fg__is_listed(listed, taken->plain_name))
    return false;
  int k = 0;
  while (k < taken->rank && other->dimension[k] == taken->dimension[k])
    ++k;
  return k == taken->rank;
}

static fg_status compare_places(bool *apart, const fg__dataset *data, plane of[2])
{
  const fg__variable *v = of[0].variable;
  const int *last = v->dimension + v->rank;
  const size_t n0 = v->rank > 1 ? data->dimensions[last[-2]].length : 1,
               n1 = data->dimensions[last[-1]].length;
  fg_status status = read_plane(&of[0], data);
  if (status == FG_STATUS_OK)
    status = read_plane(&of[1], data);
  if (status == FG_STATUS_OK)
    *apart = most_differ(of, n0, n1, false, v->geographic == FG__ROLE_X, SAME_CELL);
  free(of[0].value);
  free(of[1].value);
  return status;
}

static void refuse_places(fg__grid *grid, const fg__variable *variable,
                          const fg__variable *taken, const fg__variable *other)
{
  fg__set_unusable(grid->unusable,
                   "'%.60s' and '%.60s' are more than a cell apart, and nothing says "
                   "at which '%.60s' lies",
                   taken->plain_name, other->plain_name, variable->plain_name);
  snprintf(grid->hint, sizeof grid->hint,
           "An attribute that names longitudes and latitudes decides: ncatted -a "
           "coordinates,%.60s,o,c,'LON LAT' FILE",
           variable->plain_name);
}

fg_status fg__check_other_places(fg__grid *grid, const fg__dataset *data,
                                 const fg__variable *variable,
                                 const fg__variable *const taken[2])
{
  char listed[FG__TEXT_BYTES];
  fg__attribute_text(variable, "coordinates", listed, sizeof listed);
  for (int k = 0; k < 2; ++k)
    for (size_t i = 0; i < data->variable_count; ++i) {
      plane of[2] = {{taken[k], NULL}, {&data->variables[i], NULL}};
      bool apart = false;
      if (taken[k]->geographic == FG__NO_ROLE ||
          !is_alike(of[1].variable, taken[k], listed))
        continue;
      const fg_status status = compare_places(&apart, data, of);
      if (status != FG_STATUS_OK)
        return status;
      if (apart)
        refuse_places(grid, variable, taken[k], of[1].variable);
      else if (k == 0 && taken[k]->rank > 1)
        fg__doubt(grid->doubts, "'%.60s' is taken to lie at '%.60s', not at '%.60s'",
                  variable->plain_name, taken[k]->plain_name, of[1].variable->plain_name);
    }
  return FG_STATUS_OK;
}

/* Whether most values of a coordinate along a dimension of a plane are others than the
 * plane's; `along` is which of its dimensions. */
static bool most_contradict(const plane *p, const double *axis, size_t n0, size_t n1,
                            int along, bool longitude)
{
  const double limit = 0.5 * step_of(p, n0, n1, longitude);
  size_t differ = 0;
  for (size_t i = 0; i < n0; ++i)
    for (size_t j = 0; j < n1; ++j) {
      const double d = p->value[i * n1 + j] - axis[along == 0 ? i : j];
      differ += fabs(longitude ? remainder(d, 360.0) : d) > limit;
    }
  return 2 * differ > n0 * n1;
}

fg_status fg__plane_contradicts(bool *out, const fg__grid *grid, const fg__dataset *data,
                                const fg__variable *variable,
                                const fg__variable *const coordinate[2])
{
  fg_status status = FG_STATUS_OK;
  *out = false;
  for (int k = 0; k < 2 && status == FG_STATUS_OK && !*out; ++k) {
    plane p = {fg__plane_coordinate(grid, data, variable, (fg__role)k), NULL};
    if (!p.variable || coordinate[k]->rank != 1)
      return FG_STATUS_OK;
    const int *dimension = last_dimensions(p.variable);
    const size_t size[2] = {data->dimensions[dimension[0]].length,
                            data->dimensions[dimension[1]].length};
    const int along =
        fg__alike_dimension(data, dimension[0], grid->axis[k].dimension) ? 0 : 1;
    const size_t start = 0;
    double *axis = fg__allocate(size[along], sizeof *axis);
    status = axis ? read_plane(&p, data)
                  : fg__fail_memory(data->context, "an axis", size[along] * sizeof *axis);
    if (status == FG_STATUS_OK)
      status = fg__variable_fetch(coordinate[k], &start, &size[along], axis);
    if (status == FG_STATUS_OK)
      *out = most_contradict(&p, axis, size[0], size[1], along, k == 0);
    free(axis);
    free(p.value);
  }
  return status;
}

fg_status fg__plane_find(fg__grid *grid, const fg__dataset *data,
                         const fg__variable *variable, bool *found)
{
  *found = false;
  plane longitude = {fg__plane_coordinate(grid, data, variable, FG__ROLE_X), NULL};
  plane latitude = {fg__plane_coordinate(grid, data, variable, FG__ROLE_Y), NULL};
  if (!longitude.variable || !latitude.variable || grid->scale == FG_SCALE_PLAIN)
    return FG_STATUS_OK;
  const int *dimension = last_dimensions(longitude.variable);
  const int *other = last_dimensions(latitude.variable);
  const size_t n0 = data->dimensions[dimension[0]].length;
  const size_t n1 = data->dimensions[dimension[1]].length;
  fg_status status = read_plane(&longitude, data);
  if (status == FG_STATUS_OK)
    status = read_plane(&latitude, data);
  if (status != FG_STATUS_OK)
    goto cleanup;
  const bool has_axes = grid->axis[0].coordinate != NULL;
  if (has_axes && (are_alike(&longitude, n0 * n1) || are_alike(&latitude, n0 * n1)))
    goto cleanup;
  const bool same_order = other[0] == dimension[0];
  const int x = direction_of(&longitude, n0, n1, true);
  const int y = same_order ? direction_of(&latitude, n0, n1, false)
                           : direction_of(&latitude, n1, n0, false);
  const int y_dimension = y < 0 ? -1 : other[y];
  if (x < 0 || y < 0 || dimension[x] == y_dimension) {
    grid->off_axes = true;
    fg__set_unusable(
        grid->unusable,
        "a curvilinear grid: '%s' and '%s' vary along both of its dimensions",
        longitude.variable->name, latitude.variable->name);
    snprintf(grid->hint, sizeof grid->hint,
             "--scale plain reads it on its index grid, columns and rows as the axes");
    goto cleanup;
  }
  if (!fg__alike_dimension(data, grid->axis[0].dimension, dimension[x])) {
    const fg__grid_axis swapped = grid->axis[0];
    grid->axis[0] = grid->axis[1];
    grid->axis[1] = swapped;
  }
  *found = true;
  status = fg__grid_axis_read(grid, data, 0, longitude.variable);
  if (status == FG_STATUS_OK)
    status = fg__grid_axis_read(grid, data, 1, latitude.variable);
  if (status == FG_STATUS_OK)
    status = fg__check_other_places(
        grid, data, variable,
        (const fg__variable *[]){longitude.variable, latitude.variable});

cleanup:
  free(longitude.value);
  free(latitude.value);
  return status;
}
