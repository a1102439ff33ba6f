/* Vertical sections: planes along levels and one direction of the ground, of a component
 * along it and one along the vertical. */
#include "base/angle.h"
#include "base/decimal.h"
#include "base/memory.h"
#include "interpret/interpret.h"
#include "terms/frame.h"
#include "terms/measure.h"
#include "terms/names.h"
#include "terms/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double EARTH_RADIUS = 6371000.0; /* metres */

/* A section is drawn in its true proportions where neither side is longer than
 * TRUE_ASPECT times the other, else ASPECT times as wide as high. */
static const double TRUE_ASPECT = 4.0, ASPECT = 2.0;

int fg__section_along(int position[FG__ROLES], const fg__dataset *data,
                      const fg__variable *v)
{
  if (!fg__is_array(v) || v->rank > FG__RANK || fg__roles_find(position, data, v) >= 0)
    return -1;
  int along = -1, sides = 0;
  for (int k = FG__ROLE_X; k <= FG__ROLE_Y; ++k)
    if (position[k] >= 0 && data->dimensions[v->dimension[position[k]]].length > 1) {
      along = k;
      ++sides;
    }
  const int level = position[FG__ROLE_LEVEL];
  return sides == 1 && level >= 0 && data->dimensions[v->dimension[level]].length > 1 &&
                 (int)fg__claimed_role(data, v, position[along]) == along
             ? along
             : -1;
}

static void read_unit(fg__unit *unit, const fg__variable *v)
{
  char text[FG__TEXT_BYTES] = "";
  if (v)
    fg__attribute_text(v, "units", text, sizeof text);
  fg__unit_read(unit, text);
}

static bool is_tendency(const fg__variable *w)
{
  fg__unit unit;
  read_unit(&unit, w);
  return unit.quantity == FG__QUANTITY_PRESSURE_TENDENCY;
}

/* Whether a component is along the vertical, in the unit that goes with the levels. */
static bool is_upward(const fg__variable *v, const fg__variable *levels)
{
  const fg__term term = fg__term_of(v);
  fg__unit of_levels;
  read_unit(&of_levels, levels);
  return fg__is_vertical(&term) &&
         (of_levels.quantity == FG__QUANTITY_PRESSURE) == is_tendency(v);
}

/* The only such component on the dimensions of another; NULL: none, or several. */
static const fg__variable *find_upward(const fg__dataset *data, const fg__variable *u,
                                       int level)
{
  const fg__variable *levels = fg__coordinate(data, u, level), *found = NULL;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v == u || v->rank != u->rank || v->element || !is_upward(v, levels) ||
        memcmp(v->dimension, u->dimension, (size_t)u->rank * sizeof *u->dimension) != 0)
      continue;
    if (found)
      return NULL;
    found = v;
  }
  return found;
}

void fg__section_settle(fg__pair *pair, const fg__dataset *data)
{
  int position[FG__ROLES];
  const fg__variable *const *c = pair->component;
  const int along = pair->polar.sense != 0 || c[0]->element || data->space.is_there
                        ? -1
                        : fg__section_along(position, data, c[0]);
  const fg__variable *up =
      along < 0 ? NULL : find_upward(data, c[along], position[FG__ROLE_LEVEL]);
  if (!up || up == c[1])
    return;
  pair->component[0] = c[along];
  pair->component[1] = up;
  pair->component[2] = NULL;
}

/* The longitude or latitude that a section lies at: of the only one value that the file
 * has. */
static bool find_place(double *out, const fg__dataset *data, fg__role role)
{
  static const size_t first[FG__RANK] = {0};
  int found = 0;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    bool single = v->geographic == role && fg__is_number(v) && v->rank <= FG__RANK;
    for (int k = 0; k < v->rank && single; ++k)
      single = data->dimensions[v->dimension[k]].length == 1;
    found +=
        single && fg__variable_fetch_one(v, first, out) == FG_STATUS_OK && isfinite(*out);
  }
  return found == 1;
}

/* Metres of a horizontal coordinate's unit; 0: it has none of a length. */
static double metres_along(fg__grid *grid, const fg__dataset *data,
                           const fg__variable *coordinate, const fg__variable *u)
{
  const double degree = EARTH_RADIUS * FG__RADIANS;
  const fg__term of_u = fg__term_of(u);
  fg__unit unit;
  double latitude;
  read_unit(&unit, coordinate);
  if (coordinate->geographic == FG__ROLE_Y)
    return degree;
  if (coordinate->geographic != FG__ROLE_X && fg__says_east(&of_u))
    fg__doubt(grid->doubts, "'%.60s' points east, and is taken to be along '%.60s'",
              u->plain_name, coordinate->plain_name);
  if (coordinate->geographic != FG__ROLE_X)
    return unit.quantity == FG__QUANTITY_LENGTH ? unit.factor : 0.0;
  if (find_place(&latitude, data, FG__ROLE_Y) && fabs(latitude) < 90.0) {
    snprintf(grid->section, sizeof grid->section, "at %.4g°%s", fabs(latitude),
             latitude < 0.0 ? "S" : "N");
    return degree * cos(latitude * FG__RADIANS);
  }
  fg__doubt(grid->doubts,
            "the latitude of the section along '%.60s' is not known: distances are those "
            "at the equator",
            coordinate->plain_name);
  return degree;
}

/* 1: levels count upwards, -1: downwards; by `positive`, else by their names, or by the
 * ground below which all are. */
static int direction_of(fg__grid *grid, const fg__variable *levels)
{
  const fg__grid_axis *z = &grid->axis[1];
  char positive[FG__TEXT_BYTES], name[2 * FG__TEXT_BYTES];
  if (z->quantity == FG__QUANTITY_PRESSURE)
    return -1;
  fg__attribute_text(levels, "positive", positive, sizeof positive);
  fg__attribute_text(levels, "standard_name", name, FG__TEXT_BYTES);
  snprintf(name + strlen(name), FG__TEXT_BYTES, " %s", levels->plain_name);
  const bool depth = fg__contains_any(name, "depth"),
             below = z->coordinate[z->size - 1] <= 0.0;
  if (strcmp(positive, "down") == 0 && below && z->coordinate[0] < 0.0)
    fg__set_unusable(grid->unusable,
                     "'%.60s' counts downwards by its attribute positive, and is %g to "
                     "%g, above the ground",
                     levels->plain_name, z->coordinate[0], z->coordinate[z->size - 1]);
  if (positive[0])
    return strcmp(positive, "down") == 0 ? -1 : 1;
  if (!depth && !below && !fg__contains_any(name, "height|altitude"))
    fg__doubt(grid->doubts, "'%.60s' has no attribute positive: it is taken for a height",
              levels->plain_name);
  return depth && !below ? -1 : 1;
}

/* What one unit of the vertical component is, in units of the horizontal one, on a plane
 * whose axes are metres; of a tendency of pressure with the levels' unit for the metre.
 * 0: they do not go together. */
static double component_ratio(fg__grid *grid, const fg__pair *pair)
{
  const fg__grid_axis *z = &grid->axis[1];
  fg__unit u, w, levels;
  read_unit(&u, pair->component[0]);
  read_unit(&w, pair->component[1]);
  fg__unit_read(&levels, z->units);
  const bool speeds =
      u.quantity == FG__QUANTITY_SPEED && w.quantity == FG__QUANTITY_SPEED;
  if (z->quantity == FG__QUANTITY_LENGTH && (speeds || strcmp(u.label, w.label) == 0))
    return speeds ? w.factor / u.factor : 1.0;
  if (z->quantity == FG__QUANTITY_PRESSURE && u.quantity == FG__QUANTITY_SPEED &&
      w.quantity == FG__QUANTITY_PRESSURE_TENDENCY)
    return w.factor / levels.factor / u.factor;
  fg__set_unusable(grid->unusable,
                   "'%.60s' in %.40s and '%.60s' in %.40s are no vector over '%.60s' in "
                   "%.40s",
                   pair->component[0]->plain_name, u.label[0] ? u.label : "no unit",
                   pair->component[1]->plain_name, w.label[0] ? w.label : "no unit",
                   z->name, z->units[0] ? z->units : "no unit");
  snprintf(grid->hint, sizeof grid->hint,
           "heights go with a velocity upwards, pressures with their tendency (omega, "
           "Pa/s); --scale plain takes the components as if they were along the axes, in "
           "their units");
  return 0.0;
}

/* Refuses a component that is not along its axis, unless `plain`. */
static void check_components(fg__grid *grid, const fg__dataset *data,
                             const fg__pair *pair, int along, int level)
{
  static const char *const called[] = {"east", "north"}, *const usual[] = {"U", "V"};
  const fg__variable *u = pair->component[0], *w = pair->component[1];
  const fg__term of_u = fg__term_of(u), of_w = fg__term_of(w);
  int points =
      fg__component_in_words(of_u.standard_name ? of_u.standard_name : of_u.name);
  if (points < 0 && !of_u.standard_name && !fg__component_of_name(&points, of_u.name))
    points = -1;
  if (pair->component[2])
    fg__set_unusable(grid->unusable, "a vertical section has two components");
  else if (pair->polar.sense != 0)
    fg__set_unusable(grid->unusable, "a speed and a direction lie across a section");
  else if (points >= 0 && points != along)
    fg__set_unusable(grid->unusable,
                     "'%.60s' points %s, across the vertical section along '%.60s'",
                     u->plain_name, called[points], grid->axis[0].name);
  else if (!fg__is_vertical(&of_w))
    fg__set_unusable(grid->unusable,
                     "a vertical section along '%.60s', and nothing says that '%.60s' is "
                     "along the vertical",
                     grid->axis[0].name, w->plain_name);
  else if (!is_tendency(w) && of_w.long_name && fg__counts_downward(of_w.long_name) > 0)
    fg__set_unusable(grid->unusable, "'%.60s' counts downwards by its long name '%.80s'",
                     w->plain_name, of_w.long_name);
  else
    return;
  const fg__variable *up = find_upward(data, u, level);
  snprintf(grid->hint, sizeof grid->hint,
           "--vars %.60s,%.60s; --scale plain takes any two components as if they were "
           "along the axes",
           points >= 0 && points != along ? usual[along] : u->name, up ? up->name : "W");
}

/* Replaces the levels by coordinates that grow upwards, on the scale of the other axis,
 * and sets the rates. proportion: how many units of the levels are as long as one of the
 * other axis; infinite: none are. ratio: what the component's unit is, in units of the
 * other component, on a plane whose unit is that of the levels. */
static fg_status lay_out(fg__grid *grid, const fg__dataset *data, int direction,
                         double proportion, double ratio, bool logarithmic)
{
  fg__grid_axis *x = &grid->axis[0], *z = &grid->axis[1];
  const size_t n = z->size;
  double *at = z->coordinate;
  char factor[FG__NUMBER_BYTES], label[FG__TEXT_BYTES];
  const double width =
      x->period > 0.0 ? x->period : x->coordinate[x->size - 1] - x->coordinate[0];
  double height = at[n - 1] - at[0];
  if (logarithmic)
    height = log10(at[n - 1] / at[0]);
  const double aspect = width * proportion / height;
  const bool is_true = !logarithmic && aspect < TRUE_ASPECT && aspect > 1.0 / TRUE_ASPECT;
  fg__number_round(factor, direction * (is_true ? proportion : height * ASPECT / width),
                   is_true ? 17 : 2);
  const char *end;
  const double step = fg__number_read(factor, &end);
  fg__number_write(factor, step);
  grid->rate = fg__allocate(n, sizeof *grid->rate);
  if (!grid->rate)
    return fg__fail_memory(data->context, "an axis", n * sizeof *grid->rate);
  if (direction < 0)
    fg__grid_axis_flip(z);
  for (size_t i = 0; i < n; ++i) {
    grid->rate[i] = ratio / step / (logarithmic ? at[i] * log(10.0) : 1.0);
    at[i] = (logarithmic ? log10(at[i]) : at[i]) / step;
  }
  snprintf(label, sizeof label, "%s", z->units);
  if (logarithmic)
    snprintf(z->units, sizeof z->units, "%s lg(re 1 %.100s)", factor, label);
  else if (step != 1.0)
    snprintf(z->units, sizeof z->units, "%s %.100s", factor, label[0] ? label : "1");
  return FG_STATUS_OK;
}

/* Says how the vertical component is drawn. */
static void tell_ratio(fg__grid *grid, const fg__pair *pair, bool logarithmic)
{
  fg__unit u, w;
  read_unit(&u, pair->component[0]);
  read_unit(&w, pair->component[1]);
  double rate = fabs(grid->rate[0]);
  if (u.quantity == w.quantity && w.factor > 0.0)
    rate *= u.factor / w.factor;
  char *out = grid->section + strlen(grid->section);
  const size_t size = sizeof grid->section - strlen(grid->section);
  const char *const before = grid->section[0] ? "; " : "";
  if (logarithmic)
    snprintf(out, size, "%svertical component in the axes' ratio", before);
  else if (is_tendency(pair->component[1]))
    snprintf(out, size, "%svertical: 1 %.40s drawn as %.2g %.40s", before, w.label, rate,
             u.label);
  else if (fabs(rate - 1.0) > 1e-6)
    snprintf(out, size, "%svertical component × %.*f", before, rate < 100.0, rate);
}

static fg_status read_axes(fg__grid *grid, const fg__dataset *data, const fg__variable *u,
                           const int position[2])
{
  fg_status status = FG_STATUS_OK;
  grid->samples = 1;
  for (int k = 0; k < 2 && status == FG_STATUS_OK && !grid->unusable[0]; ++k) {
    fg__grid_axis *axis = &grid->axis[k];
    const fg__variable *coordinate = fg__coordinate(data, u, position[k]);
    axis->dimension = u->dimension[position[k]];
    axis->position = position[k];
    axis->size = data->dimensions[axis->dimension].length;
    grid->samples *= axis->size;
    if (coordinate)
      status = fg__grid_axis_read(grid, data, k, coordinate);
    else
      fg__set_unusable(grid->unusable,
                       "a vertical section without a coordinate along '%.100s'",
                       data->dimensions[axis->dimension].name);
    if (coordinate && coordinate->geographic == FG__ROLE_Y)
      snprintf(axis->name, sizeof axis->name, "latitude");
  }
  return status;
}

fg_status fg__section_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                           const fg_read_options *options, int along,
                           const int position[FG__ROLES])
{
  const fg__variable *u = pair->component[0];
  const bool plain = options->scale == FG_SCALE_PLAIN,
             logarithmic = options->scale == FG_SCALE_LOG;
  const int level = position[FG__ROLE_LEVEL];
  grid->scale = FG_SCALE_PLAIN;
  grid->time = position[FG__ROLE_TIME];
  fg__check_storage(grid, data, u);
  fg__check_shapes(grid, data, u, pair->component[1]);
  if (options->scale == FG_SCALE_GEO || options->scale == FG_SCALE_MAP)
    fg__set_unusable(grid->unusable, "a vertical section is no map");
  fg__set_index_axes(grid, data, u);
  fg_status status = read_axes(grid, data, u, (int[2]){position[along], level});
  if (status != FG_STATUS_OK || grid->unusable[0])
    return status;
  const fg__variable *x = fg__coordinate(data, u, position[along]);
  const int direction = direction_of(grid, fg__coordinate(data, u, level));
  double ratio = 1.0, across = 1.0;
  fg__unit unit;
  fg__unit_read(&unit, grid->axis[1].units);
  if (!plain)
    check_components(grid, data, pair, along, level);
  if (!plain && !grid->unusable[0])
    ratio = component_ratio(grid, pair);
  if (!plain && !grid->unusable[0])
    across = metres_along(grid, data, x, u);
  if (across == 0.0)
    fg__set_unusable(grid->unusable, "'%.60s' has no unit of a length or of degrees",
                     grid->axis[0].name);
  if (logarithmic && !(grid->axis[1].coordinate[0] > 0.0))
    fg__set_unusable(grid->unusable, "--scale log, and '%.60s' begins at %g",
                     grid->axis[1].name, grid->axis[1].coordinate[0]);
  if (grid->unusable[0])
    return status;
  const bool lengths = !plain && grid->axis[1].quantity == FG__QUANTITY_LENGTH;
  const double metre = lengths ? unit.factor : 1.0;
  /* of pressures no proportion is the true one */
  const double proportion = plain || lengths ? across / metre : HUGE_VAL;
  const bool against = !plain && lengths && direction < 0;
  status = lay_out(grid, data, direction, proportion,
                   ratio * across / metre * (against ? -1.0 : 1.0), logarithmic);
  if (status == FG_STATUS_OK && !plain)
    tell_ratio(grid, pair, logarithmic);
  return status;
}
