/* The default level of a vector, and coordinates that its components refer to but the
 * file does not have. */
#include "base/memory.h"
#include "interpret/curvilinear/curvilinear.h"
#include "terms/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Axes with more levels get no default level. */
enum { MOST_LEVELS = 100000 };

typedef enum direction { NEITHER = 0, UP = 1, DOWN = -1 } direction;

/* The direction of the attribute `positive`. */
static direction attribute_direction(const fg__variable *coordinate)
{
  char text[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "positive", text, sizeof text);
  return fg__is_same(text, "up") ? UP : fg__is_same(text, "down") ? DOWN : NEITHER;
}

/* Whether any value is. */
static bool is_above_0(const double *value, size_t count)
{
  for (size_t n = 0; n < count; ++n)
    if (value[n] > 0.0)
      return true;
  return false;
}

/* The direction of a coordinate in the ocean: by its standard name (CF conventions,
 * appendix D: sigma and s increase upwards); or, in units of length, depth that increases
 * downwards, or height with no value above 0. */
static direction direction_in_ocean(const fg__variable *coordinate, const double *value,
                                    size_t count)
{
  char name[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
  const direction positive = attribute_direction(coordinate);
  fg__attribute_text(coordinate, "standard_name", name, sizeof name);
  if (strstr(name, "ocean_s_") || strstr(name, "ocean_sigma"))
    return positive == NEITHER ? UP : positive;
  if (strcmp(name, "depth") == 0 ||
      (!name[0] && fg__starts_with(coordinate->plain_name, "depth")))
    return positive == NEITHER ? DOWN : positive;
  const fg__quantity quantity = fg__units_of(coordinate, label, sizeof label);
  if (quantity == FG__QUANTITY_PRESSURE && strcmp(label, "dbar") != 0)
    return NEITHER; /* air pressure increases downwards, too */
  if (name[0] || quantity != FG__QUANTITY_LENGTH || positive != UP)
    return name[0] || positive != DOWN ? NEITHER : DOWN;
  return is_above_0(value, count) ? NEITHER : UP;
}

static size_t find_surface(const fg__variable *coordinate, const double *value,
                           size_t count)
{
  direction to = direction_in_ocean(coordinate, value, count);
  if (to == DOWN && !is_above_0(value, count))
    to = UP; /* heights that are called depths (xmitgcm) */
  size_t best = 0;
  for (size_t n = 1; n < count && to != NEITHER; ++n)
    if (to == UP ? value[n] > value[best] : value[n] < value[best])
      best = n;
  return best;
}

/* Levels of ROMS and SCHISM run from the bottom up, and may lack a coordinate. */
static bool runs_upwards(const char *name)
{
  return strcmp(name, "s_rho") == 0 || strcmp(name, "sc_r") == 0 ||
         strcmp(name, "nSCHISM_vgrid_layers") == 0;
}

static fg_status find_level(int *out, const fg__dataset *data, const fg__grid *grid)
{
  const fg__variable *coordinate = grid->level_variable;
  *out = 0;
  if (grid->dimension != 2 || grid->level < 0 || grid->levels < 2 ||
      grid->levels > MOST_LEVELS)
    return FG_STATUS_OK;
  if (!coordinate || coordinate->rank != 1 || !fg__is_number(coordinate)) {
    *out = runs_upwards(grid->level_name) ? (int)grid->levels - 1 : 0;
    return FG_STATUS_OK;
  }
  double *value = fg__allocate(grid->levels, sizeof *value);
  if (!value)
    return fg__fail_memory(data->context, "levels", grid->levels * sizeof *value);
  const size_t start = 0;
  const fg_status status = fg__variable_fetch(coordinate, &start, &grid->levels, value);
  if (status == FG_STATUS_OK)
    *out = (int)find_surface(coordinate, value, grid->levels);
  free(value);
  return status;
}

static void add_name(char *out, size_t size, const char *name)
{
  const size_t used = strlen(out);
  if (used + strlen(name) + 3 <= size)
    snprintf(out + used, size - used, "%s%s", used ? ", " : "", name);
}

/* Lists the names in the attribute `coordinates` for which there is no variable. */
static void list_absent(char *out, size_t size, const fg__dataset *data,
                        const fg__variable *component)
{
  char names[FG__TEXT_BYTES], *rest = NULL;
  fg__attribute_text(component, "coordinates", names, sizeof names);
  for (char *name = strtok_r(names, " ", &rest); name; name = strtok_r(NULL, " ", &rest))
    if (!fg__dataset_find(data, name))
      add_name(out, size, name);
}

/* Whether the field is placed by longitudes along its x axis that say that they are
 * nominal (MOM6), which they are where the grid's lines bend. */
static bool is_placed_nominally(const fg__dataset *data, const fg__variable *u,
                                const fg__grid *grid)
{
  char text[FG__TEXT_BYTES];
  const fg__curvilinear *mesh = grid->mesh;
  if (grid->unstructured || grid->scale != FG_SCALE_GEO ||
      (mesh && !(mesh->centre.longitude && mesh->centre.longitude->rank == 1)))
    return false;
  const int k = mesh ? mesh->part[0].grid.axis[0].position : grid->axis[0].position;
  const fg__variable *along = fg__coordinate(data, u, k);
  return along && fg__attribute_text(along, "long_name", text, sizeof text) &&
         strstr(text, "nominal");
}

fg_status fg__defaults_find(fg_read_defaults *out, const fg__dataset *data,
                            const fg__pair *pair, const fg__grid *grid,
                            const fg_read_options *options)
{
  *out = (fg_read_defaults){0};
  if (grid->unusable[0])
    return FG_STATUS_OK;
  if (grid->scale == FG_SCALE_PLAIN && options->scale != FG_SCALE_PLAIN &&
      !grid->unstructured)
    list_absent(out->absent, sizeof out->absent, data, pair->component[0]);
  if (is_placed_nominally(data, pair->component[0], grid))
    snprintf(out->absent, sizeof out->absent,
             "true longitudes and latitudes (those of its axes are nominal)");
  return find_level(&out->level, data, grid);
}
