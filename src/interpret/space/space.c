#include "interpret/space/space.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/decimal.h"
#include "base/memory.h"

int fg__space_domain_along(const fg__space_domain *domain, int k)
{
  return domain->is_tilted && k < 2 ? domain->basis.axis[k] : domain->axis[k];
}

const char *fg__space_domain_axis_name(const fg__space_domain *domain, int k)
{
  static const char *const names[2][3] = {{"x", "y", "z"}, {"x'", "y'", "z'"}};
  const bool turned = domain->is_tilted && k < 2 && !fg__plane_is_axis(&domain->basis, k);
  return names[turned][fg__space_domain_along(domain, k)];
}

int fg__pair_components(const fg__pair *pair)
{
  return pair->component[2] ? 3 : 2;
}

/* The axis that a name means by the letter in which it differs from another; -1: none. */
static int axis_of(const char *name, const char *other)
{
  static const char letters[] = "xyzXYZ";
  while (*name && *name == *other) {
    ++name;
    ++other;
  }
  const char *letter = *name ? strchr(letters, *name) : NULL;
  return letter ? (int)(letter - letters) % 3 : -1;
}

/* Two components that are found by names, and whose names are those of axes, lie along
 * these. */
static void check_names(fg__grid *grid, const fg__space_domain *domain,
                        const fg__pair *pair)
{
  static const char letters[] = "xyz";
  const char *u = pair->component[0]->name, *v = pair->component[1]->name;
  int along[2] = {axis_of(u, v), axis_of(v, u)};
  if (pair->across > 0)
    for (int k = 0, n = 0; k < 3; ++k)
      if (k != pair->across - 1)
        along[n++] = k;
  if (along[0] < 0 || along[1] < 0 || strcmp(pair->found_by, "names") != 0 ||
      (along[0] == domain->axis[0] && along[1] == domain->axis[1]))
    return;
  fg__set_unusable(
      grid->unusable,
      "'%.60s' and '%.60s' are the components along %c and %c, which are not "
      "those of its plane, %s and %s",
      u, v, letters[along[0]], letters[along[1]], fg__space_domain_axis_name(domain, 0),
      fg__space_domain_axis_name(domain, 1));
  snprintf(grid->hint, sizeof grid->hint, "--vars %.80s,%.80s draws them as if they were",
           u, v);
}

static void check_components(fg__grid *grid, const fg__space_domain *domain,
                             const fg__pair *pair)
{
  const fg__variable *const *v = pair->component;
  const int components = fg__pair_components(pair);
  for (int k = 0; k < components; ++k) {
    if (!fg__is_number(v[k]))
      fg__set_unusable(grid->unusable, "'%.120s' holds no numbers", v[k]->name);
    if (v[k]->location != v[0]->location)
      fg__set_unusable(grid->unusable,
                       "'%.100s' and '%.100s' lie on different places, points and cells",
                       v[0]->name, v[k]->name);
  }
  if (domain->is_tilted && components < 3)
    fg__set_unusable(grid->unusable,
                     "a tilted plane needs three components, \"%.100s\" "
                     "has two",
                     v[0]->name);
  if (domain->dimension > components) {
    fg__set_unusable(grid->unusable,
                     "a volume of %zu x %zu x %zu points needs three components, "
                     "\"%.100s\" has two",
                     domain->size[0], domain->size[1], domain->size[2], v[0]->name);
    snprintf(grid->hint, sizeof grid->hint, "name three variables: --vars U,V,W");
  }
  if (domain->dimension == 2 && components == 2 && !v[0]->element)
    check_names(grid, domain, pair);
}

/* What a file along its axes says of them and of its plane. */
static void use_words(fg__grid *grid, const fg__dataset *data)
{
  char scale[FG__TEXT_BYTES];
  const fg__variable *file = fg__group_of(&data->variables[data->space.axis[0]]);
  for (int k = 0; k < grid->dimension; ++k)
    if (grid->domain->axis[k] != k)
      return;
  for (int k = 0; k < grid->dimension; ++k) {
    const fg__variable *v = &data->variables[data->space.axis[k]];
    fg__grid_axis *axis = &grid->axis[k];
    char name[FG__TEXT_BYTES];
    if (fg__attribute_text(v, "long_name", name, sizeof name))
      memcpy(axis->name, name, sizeof name);
    fg__attribute_text(v, "units", axis->units, sizeof axis->units);
  }
  fg__attribute_text(file, "Scale", scale, sizeof scale);
  if (grid->scale == FG_SCALE_AUTO)
    grid->scale = strcmp(scale, "geo") == 0   ? FG_SCALE_GEO
                  : strcmp(scale, "map") == 0 ? FG_SCALE_MAP
                                              : FG_SCALE_AUTO;
  if (grid->scale == FG_SCALE_GEO)
    fg__attribute_numbers(file, "AxisPeriod", &grid->axis[0].period, 1);
  if (grid->scale == FG_SCALE_MAP)
    fg__attribute_text(file, "Projection", grid->projection, sizeof grid->projection);
}

fg_status fg__space_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                         const fg_read_options *options)
{
  const fg__space_domain *domain = data->space.domain;
  const bool three = fg__pair_components(pair) == 3;
  *grid = (fg__grid){.domain = domain,
                     .dimension = domain->dimension,
                     .time = -1,
                     .level = -1,
                     .times = data->times > 0 ? (size_t)data->times : 1,
                     .levels = 1,
                     .samples = 1,
                     .scale = options->scale};
  if (domain->dimension < 2) {
    const size_t *points = data->space.points;
    fg__set_unusable(grid->unusable,
                     "a line of %zu x %zu x %zu points; a field needs two directions",
                     points[0], points[1], points[2]);
    return FG_STATUS_OK;
  }
  for (int k = 0; k < domain->dimension; ++k) {
    grid->axis[k].size = domain->size[k];
    grid->samples *= domain->size[k];
    grid->component[k] = three ? domain->axis[k] : k;
    snprintf(grid->axis[k].name, sizeof grid->axis[k].name, "%s",
             fg__space_domain_axis_name(domain, k));
  }
  check_components(grid, domain, pair);
  if (data->space.on_axes)
    use_words(grid, data);
  if (grid->scale == FG_SCALE_AUTO)
    grid->scale = FG_SCALE_PLAIN;
  return FG_STATUS_OK;
}

enum { TIME_BYTES = FG__NUMBER_BYTES + 8 };

static void write_time(char out[TIME_BYTES], double time)
{
  char number[FG__NUMBER_BYTES];
  fg__number_write(number, time);
  snprintf(out, TIME_BYTES, "t = %s", number);
}

fg_status fg__space_time(char out[FG__TEXT_BYTES], const fg__dataset *data, int time)
{
  const fg__variable *file = &data->groups[0];
  double value = 0.0;
  out[0] = '\0';
  if (data->times > 0)
    value = data->time[time];
  else if (fg__attribute_text(file, "TimeWords", out, FG__TEXT_BYTES) ||
           fg__attribute_numbers(file, "TimeValue", &value, 1) == 0)
    return FG_STATUS_OK;
  write_time(out, value);
  return FG_STATUS_OK;
}

fg_status fg__space_times(fg_axis_value **out, char **text, const fg__dataset *data)
{
  const size_t count = data->time ? (size_t)data->times : 0;
  *out = NULL;
  *text = NULL;
  if (count == 0)
    return FG_STATUS_OK;
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(count, TIME_BYTES);
  if (!*out || !*text)
    return fg__fail_memory(data->context, "times", count * sizeof **out);
  for (size_t n = 0; n < count; ++n) {
    char *words = *text + n * TIME_BYTES;
    write_time(words, data->time[n]);
    (*out)[n] = (fg_axis_value){data->time[n], "", words};
  }
  return FG_STATUS_OK;
}
