/* Levels as an axis in space: finds the third component, and whether the three form a
 * volume. */
#include "interpret/interpret.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool same_units(const fg__variable *a, const fg__variable *b)
{
  char of_a[FG__TEXT_BYTES], of_b[FG__TEXT_BYTES];
  fg__units_of(a, of_a, sizeof of_a);
  fg__units_of(b, of_b, sizeof of_b);
  return strcmp(of_a, of_b) == 0;
}

/* Maps and atmospheric layers are not read as a volume: they are a hundred times as wide
 * as high. Their files are read level by level. */
static bool is_map(const fg__dataset *data, const fg__grid *grid, const fg__variable *u)
{
  char name[FG__TEXT_BYTES] = "";
  const fg__variable *x = fg__grid_axis_coordinate(data, grid, u, FG__ROLE_X);
  if (x)
    fg__attribute_text(x, "standard_name", name, sizeof name);
  return strncmp(name, "projection_", 11) == 0;
}

static bool counts_down(const fg__variable *z)
{
  char text[FG__TEXT_BYTES];
  return z && fg__attribute_text(z, "positive", text, sizeof text) &&
         strcmp(text, "down") == 0;
}

static void check_components(fg__grid *grid, const fg__dataset *data,
                             const fg__pair *pair)
{
  const fg__variable *u = pair->component[0], *w = pair->component[2];
  fg__check_variable(grid, w);
  if (!grid->unusable[0])
    fg__check_shapes(grid, data, u, w);
  if (!same_units(u, w))
    fg__set_unusable(grid->unusable, "'%.60s' and '%.60s' differ in units", u->plain_name,
                     w->plain_name);
}

static void check_space(fg__grid *grid, const fg__dataset *data, const fg__pair *pair)
{
  const fg__variable *u = pair->component[0];
  const fg__grid_axis *x = &grid->axis[0], *z = &grid->axis[2];
  if (grid->scale == FG_SCALE_GEO)
    fg__set_unusable(grid->unusable,
                     "longitude, latitude and height together cannot be handled "
                     "yet");
  else if (grid->scale == FG_SCALE_MAP && strcmp(x->units, z->units) != 0)
    fg__set_unusable(grid->unusable, "'%.60s' is in %.40s, '%.60s' in %.40s: no space",
                     x->name, x->units, z->name, z->units[0] ? z->units : "no units");
  else if (grid->scale != FG_SCALE_PLAIN &&
           counts_down(fg__grid_axis_coordinate(data, grid, u, 2)))
    fg__set_unusable(grid->unusable, "'%.60s' counts downwards", z->name);
  if (grid->unusable[0])
    snprintf(grid->hint, sizeof grid->hint,
             "--scale plain takes the velocity as if it were along the axes, in their "
             "units; --vars U,V reads the plane of one level");
}

/* Whether a third component that the options do not name may be used without doubt. */
static bool is_beyond_doubt(const fg__grid *grid, const fg__dataset *data,
                            const fg__variable *u)
{
  return strcmp(grid->axis[0].units, grid->axis[2].units) == 0 &&
         !is_map(data, grid, u) &&
         !counts_down(fg__grid_axis_coordinate(data, grid, u, 2));
}

static fg_status find_levels(fg__grid *grid, const fg__dataset *data,
                             const fg__variable *u)
{
  fg__grid_axis *z = &grid->axis[2];
  if (grid->level < 0 || grid->levels < 2) {
    fg__set_unusable(grid->unusable, "'%.120s' has only two dimensions in space",
                     u->name);
    return FG_STATUS_OK;
  }
  z->dimension = u->dimension[grid->level];
  z->position = grid->level;
  z->size = grid->levels;
  if (z->size > SIZE_MAX / sizeof(float) / grid->samples)
    fg__set_unusable(grid->unusable, "%zu levels of %zu samples are too many", z->size,
                     grid->samples);
  if (grid->unusable[0])
    return FG_STATUS_OK;
  grid->samples *= z->size;
  fg__check_storage(grid, data, u);
  return grid->level_variable ? fg__grid_axis_read(grid, data, 2, grid->level_variable)
                              : fg__grid_axis_count(grid, data, 2);
}

fg_status fg__volume_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair)
{
  const fg__variable *u = pair->component[0];
  const size_t plane = grid->samples;
  check_components(grid, data, pair);
  fg_status status = grid->unusable[0] ? FG_STATUS_OK : find_levels(grid, data, u);
  if (status != FG_STATUS_OK)
    return status;
  if (!grid->unusable[0])
    check_space(grid, data, pair);
  if (!grid->unusable[0] && (pair->volume || is_beyond_doubt(grid, data, u))) {
    grid->dimension = 3;
  } else if (!pair->volume) {
    free(grid->axis[2].coordinate);
    grid->axis[2] = (fg__grid_axis){0};
    grid->samples = plane;
    grid->unusable[0] = grid->hint[0] = '\0';
  }
  return FG_STATUS_OK;
}
