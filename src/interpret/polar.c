/* Lengths and directions in place of components: which the options name, and on which
 * grids they can be read. */
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/unstructured/unstructured.h"

#include <stdio.h>
#include <string.h>

/* The direction that has this speed; NULL: none. */
static const fg__variable *direction_of(const fg__dataset *data,
                                        const fg__variable *speed)
{
  fg__polar ignored;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const fg__term terms[2] = {fg__term_of(speed), fg__term_of(v)};
    if (v != speed && v->rank == speed->rank && fg__speed_of(&ignored, terms, 2, 1) == 0)
      return v;
  }
  return NULL;
}

/* Refuses a speed that has a direction beside another variable, which is none. */
static fg_status check_half(const fg__dataset *data, const fg__variable *speed,
                            const fg__variable *other)
{
  const fg__variable *direction = direction_of(data, speed);
  if (!direction || direction_of(data, other) || fg__names_speed(other->plain_name))
    return FG_STATUS_OK;
  fg__fail(data->context, FG_STATUS_ARGUMENT,
           "%s: '%.120s' is a speed, and '%.120s' is no direction", speed->path,
           speed->name, other->name);
  fg__hint(data->context, "name a speed and its direction: --vars %s,%s", speed->name,
           direction->name);
  return FG_STATUS_ARGUMENT;
}

fg_status fg__settle_polar(fg__pair *pair, const fg__dataset *data)
{
  const fg__variable *const named[2] = {pair->component[0], pair->component[1]};
  const fg__term term[2] = {fg__term_of(named[0]), fg__term_of(named[1])};
  const int k = fg__direction_among(&pair->polar, &term[0], &term[1]);
  if (k < 0) {
    const fg_status status = check_half(data, named[0], named[1]);
    return status == FG_STATUS_OK ? check_half(data, named[1], named[0]) : status;
  }
  pair->component[0] = named[1 - k];
  pair->component[1] = named[k];
  return FG_STATUS_OK;
}

/* What the options name is taken by its name. */
static void check_sense(fg__grid *grid, const fg__pair *pair,
                        const fg_read_options *options)
{
  const fg__term term = fg__term_of(pair->component[1]);
  const char *opposite = options->vars ? NULL : fg__opposite_sense(&term);
  if (!opposite)
    return;
  fg__set_unusable(grid->unusable,
                   "'%.60s' is the direction %s by its name '%.80s', and the opposite by "
                   "'%.80s'",
                   term.name,
                   pair->polar.sense < 0 ? "from where it comes" : "to where it goes",
                   term.standard_name ? term.standard_name : term.name, opposite);
  snprintf(grid->hint, sizeof grid->hint,
           "--vars SPEED,DIRECTION takes the direction by its name");
}

void fg__check_polar(fg__grid *grid, const fg__pair *pair, const fg_read_options *options)
{
  const fg__variable *direction = pair->component[1];
  const fg__grid_axis *axis = grid->axis;
  if (pair->polar.sense == 0)
    return;
  if (pair->polar.unit == 0.0)
    fg__set_unusable(grid->unusable,
                     "the direction '%.120s' is not in degrees or radians",
                     direction->name);
  check_sense(grid, pair, options);
  if (grid->faces.used || (grid->mesh && (grid->mesh->shift[0] || grid->mesh->shift[1])))
    fg__set_unusable(grid->unusable, "speed and direction lie at different places");
  if (options->frame == FG_FRAME_GRID)
    fg__set_unusable(grid->unusable,
                     "'%.120s' is a direction from north, not from the grid's lines",
                     direction->name);
  const bool on_globe =
      grid->mesh || (grid->unstructured && fg__points_north(grid->unstructured)) ||
      grid->points_east || (grid->unstructured && pair->polar.from_east) ||
      (axis[0].quantity == FG__QUANTITY_DEGREES_EAST &&
       axis[1].quantity == FG__QUANTITY_DEGREES_NORTH) ||
      (grid->scale == FG_SCALE_GEO && strcmp(axis[0].name, "grid longitude") != 0);
  if (!on_globe && !grid->unusable[0]) {
    fg__set_unusable(grid->unusable,
                     "'%.120s' is a direction from north, and where north lies on its "
                     "grid is not known",
                     direction->name);
    snprintf(grid->hint, sizeof grid->hint,
             "speed and direction are read with longitude and latitude, or in a "
             "projection that the file describes");
  }
}

const char *fg__component_name(const fg__pair *pair, int k)
{
  const fg__variable *v = pair->component[k];
  return pair->polar.sense == 0 && !v->element ? fg__called(v) : NULL;
}

void fg__pair_polar_words(char *out, size_t size, const fg__pair *pair)
{
  char rule[FG__TEXT_BYTES];
  const fg__term direction = fg__term_of(pair->component[1]);
  fg__direction_rule(rule, sizeof rule, &direction);
  fg__polar_words(out, size, &pair->polar, rule);
}
