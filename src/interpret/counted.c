/* Axes that count samples, where a file tells of places. */
#include "interpret/interpret.h"
#include "terms/coordinates.h"

#include <stdio.h>

/* The first variable of a place's name that is none of the vector's, nor a coordinate of
 * its axes; NULL: there is none. */
static const fg__variable *find_place(const fg__dataset *data, const fg__grid *grid,
                                      const fg__pair *pair, int role)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    int fits;
    const fg__term term = fg__term_of(v);
    const bool is_place = (int)v->geographic == role ||
                          (int)fg__role_of_attributes(&term, "", false) == role ||
                          (int)fg__place_of_name(&fits, v->plain_name) == role;
    const bool along = v == fg__grid_axis_coordinate(data, grid, pair->component[0], 0) ||
                       v == fg__grid_axis_coordinate(data, grid, pair->component[0], 1);
    if (is_place && !along && v->rank > 0 && fg__is_number(v) &&
        v != pair->component[0] && v != pair->component[1])
      return v;
  }
  return NULL;
}

/* Whether the file says no more of an axis than how many samples it has. */
static bool is_counted(const fg__grid *grid, const fg__dataset *data,
                       const fg__pair *pair, int k)
{
  const fg__variable *of = pair->component[grid->faces.used && k == 0 ? 1 : 0],
                     *along = fg__grid_axis_coordinate(data, grid, of, k);
  return (!along || fg__may_be_index(along)) && grid->axis[k].coordinate &&
         fg__counts_samples(&grid->axis[k]);
}

static bool is_called_geographic(const fg__grid_axis *axis, int k)
{
  const fg__term term = {.name = axis->name};
  return (int)fg__geographic_role(&term) == k;
}

/* An attribute of a variable, its group or its file that states the distance of samples;
 * NULL: none does. */
static const char *find_spacing(const fg__variable *v)
{
  static const char *const names[] = {"gridSpacing", "spacing", "dx", "DX", "delta_x"};
  const fg__variable *const of[] = {v, fg__group_of(v), fg__file_of(v)};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    for (size_t k = 0; k < sizeof of / sizeof *of; ++k)
      if (of[k] && fg__attribute_find(of[k], names[i]))
        return names[i];
  return NULL;
}

void fg__tell_unused_places(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                            const fg_read_options *options)
{
  if (grid->scale != FG_SCALE_PLAIN || options->scale != FG_SCALE_AUTO ||
      grid->unusable[0] || grid->mesh)
    return;
  const bool counted[2] = {is_counted(grid, data, pair, 0),
                           is_counted(grid, data, pair, 1)};
  const fg__grid_axis *axis = grid->axis, *other = &axis[counted[0]];
  if (counted[0] != counted[1] && (other->quantity == FG__QUANTITY_DEGREES_EAST ||
                                   other->quantity == FG__QUANTITY_DEGREES_NORTH)) {
    fg__set_unusable(grid->unusable, "'%.60s' counts samples, beside '%.60s' in degrees",
                     axis[!counted[0]].name, other->name);
    snprintf(grid->hint, sizeof grid->hint, "--scale plain takes their numbers");
  }
  if (!counted[0] || !counted[1])
    return;
  const char *spacing;
  const fg__variable *x = find_place(data, grid, pair, FG__ROLE_X),
                     *y = find_place(data, grid, pair, FG__ROLE_Y);
  if (x && y)
    fg__doubt(grid->doubts,
              "axes count the samples of '%.60s': '%.60s' and '%.60s' do not lie there",
              pair->component[0]->plain_name, x->plain_name, y->plain_name);
  else if ((x && x->geographic != FG__NO_ROLE) || (y && y->geographic != FG__NO_ROLE))
    fg__doubt(grid->doubts,
              "axes count the samples of '%.60s': '%.60s' does not lie there",
              pair->component[0]->plain_name, (x ? x : y)->plain_name);
  else if (grid->faces.used)
    fg__doubt(grid->doubts,
              "axes count cells: '%.60s' and '%.60s' lie on faces without positions",
              pair->component[0]->plain_name, pair->component[1]->plain_name);
  else if ((spacing = find_spacing(pair->component[0])))
    fg__doubt(grid->doubts,
              "axes count the samples of '%.60s': the attribute '%s' is not applied",
              pair->component[0]->plain_name, spacing);
  else if (is_called_geographic(&axis[0], 0) || is_called_geographic(&axis[1], 1))
    fg__doubt(grid->doubts, "'%.60s' and '%.60s' count samples: they have no coordinates",
              axis[0].name, axis[1].name);
}
