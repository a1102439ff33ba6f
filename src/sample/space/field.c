/* Fields of vectors in space, and what an inventory says of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/field.h"
#include "field/slab.h"
#include "sample/space/space.h"

enum { NAME_BYTES = 256, COUNTED_AT_ONCE = 1 << 22 };

/* "U_x" for a component of a vector variable U; a variable's own name. */
static void name_component(char name[NAME_BYTES], const fg__pair *pair,
                           const fg__grid *grid, int k)
{
  const fg__space_domain *domain = grid->domain;
  const char *axis = fg__space_domain_axis_name(domain, k);
  const bool three = fg__pair_components(pair) == 3;
  if (pair->component[0]->element)
    snprintf(name, NAME_BYTES, "%.200s_%s", pair->component[0]->name, axis);
  else
    snprintf(name, NAME_BYTES, "%.200s%s",
             pair->component[three ? fg__space_domain_along(domain, k) : k]->name,
             axis + 1);
}

static fg_status create_axes(double *out[3], const fg__dataset *data,
                             const fg__space_domain *domain)
{
  for (int k = 0; k < domain->dimension; ++k) {
    const size_t count = domain->size[k];
    out[k] = fg__allocate(count, sizeof(double));
    if (!out[k])
      return fg__fail_memory(data->context, "an axis", count * sizeof(double));
    const fg_status status = fg__space_domain_coordinates(out[k], data, k, 0, count);
    if (status != FG_STATUS_OK)
      return status;
    if (!(out[k][1] > out[k][0]) || !isfinite(out[k][count - 1]))
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: points along %s, from %g and then at %g, are no axis",
                      data->file[0].path, fg__space_domain_axis_name(domain, k),
                      out[k][0], out[k][1]);
  }
  return FG_STATUS_OK;
}

static fg_status create_field(fg_field **out, const fg__dataset *data,
                              const fg__pair *pair, const fg__grid *grid,
                              const fg_read_options *options, float *velocity[3],
                              double *const axis[3], const fg__slab_index *slab)
{
  char component[3][NAME_BYTES], units[FG__TEXT_BYTES], time[FG__TEXT_BYTES];
  char level[FG__TEXT_BYTES] = "";
  fg__velocity_units(units, sizeof units, pair);
  if (data->space.on_axes)
    fg__attribute_text(&data->groups[0], "LevelWords", level, sizeof level);
  fg_status status = fg__space_time(time, data, options->time);
  if (status != FG_STATUS_OK)
    return status;
  fg_field_arrays arrays = {
      .dimension = grid->dimension,
      .scale = grid->scale,
      .velocity_units = units,
      .title = pair->component[0]->element ? pair->component[0]->name : NULL,
      .projection = grid->projection[0] ? grid->projection : NULL,
      .time = time[0] ? time : NULL,
      .level = level[0] ? level : NULL,
      .doubts = grid->doubts[0] ? grid->doubts : NULL};
  for (int k = 0; k < grid->dimension && k < 3; ++k) {
    name_component(component[k], pair, grid, k);
    arrays.size[k] = (int)grid->axis[k].size;
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = velocity[k];
    arrays.velocity_name[k] = component[k];
    arrays.axis_name[k] = grid->axis[k].name;
    arrays.axis_units[k] = grid->axis[k].units;
    arrays.period[k] = grid->axis[k].period;
  }
  return fg__field_of_rows(out, data->context, &arrays, velocity, slab);
}

/* Adds up squares: of the normal component, and of all. */
static void add_squares(double sum[2], float *const velocity[3], size_t i)
{
  double all = 0.0;
  for (int k = 0; k < 3; ++k)
    all += (double)velocity[k][i] * (double)velocity[k][i];
  sum[0] += isfinite(all) ? (double)velocity[2][i] * (double)velocity[2][i] : 0.0;
  sum[1] += isfinite(all) ? all : 0.0;
}

static bool moves_in_plane(float *const velocity[3], size_t count)
{
  for (size_t i = 0; i < count; ++i)
    for (int k = 0; k < 2; ++k)
      if (isfinite(velocity[k][i]) && velocity[k][i] != 0.0f)
        return true;
  return false;
}

static void clear(float *velocity[3], double *axis[3])
{
  for (int k = 0; k < 3; ++k) {
    free(velocity[k]);
    free(axis[k]);
  }
}

/* Whether the dataset's region is one in the axes of a grid, whose samples are not yet
 * those of the region alone. */
static bool has_region(const fg__dataset *data, const fg__grid *grid)
{
  return data->region.axes > 0 && data->region.axes <= grid->dimension &&
         !grid->domain->cells && grid->scale != FG_SCALE_GEO && !grid->projection[0];
}

/* Of a grid along axes only the rows that the dataset's region needs. */
static fg_status find_rows(fg__rows *rows, fg__grid *part, const fg__dataset *data,
                           const fg__grid *grid, const double *axis)
{
  const int last = grid->dimension - 1;
  const fg__field_region *region = &data->region;
  fg__region_range range;
  *part = *grid;
  if (!has_region(data, grid) || region->axes <= last)
    return FG_STATUS_OK;
  const fg_status status =
      fg__region_find(&range, data->context, data->file[0].path, region, last,
                      grid->axis[last].name, "", axis, grid->axis[last].size);
  if (status == FG_STATUS_OK) {
    *rows = (fg__rows){(int)range.first, (int)range.count, (int)range.count};
    part->axis[last].size = range.count;
  }
  return status;
}

/* Of a plane that is read whole the normal component is read, too, for its share. */
fg_status fg__space_field(fg_field **out, const fg__dataset *data, const fg__pair *pair,
                          const fg__grid *grid, const fg_read_options *options,
                          fg__slab_index slab)
{
  const fg__space_domain *domain = grid->domain;
  const size_t last = domain->size[domain->dimension - 1],
               row = fg__space_domain_row(domain);
  fg__rows rows = fg__rows_of(&slab, (int)last, false);
  fg__grid part = *grid;
  const bool plane =
      domain->dimension == 2 && fg__pair_components(pair) == 3 && slab.count == 1;
  float *velocity[3] = {NULL, NULL, NULL};
  double *axis[3] = {NULL, NULL, NULL}, sum[2] = {0.0, 0.0};
  double *held[3];
  fg_status status = create_axes(axis, data, domain);
  if (status == FG_STATUS_OK)
    status = find_rows(&rows, &part, data, grid, axis[domain->dimension - 1]);
  const fg__row_range range = {(size_t)rows.first, (size_t)rows.held};
  if (status == FG_STATUS_OK)
    status = fg__check_memory(data->context, data->file[0].path, (double)row * rows.held,
                              domain->dimension * (double)sizeof(float));
  if (status == FG_STATUS_OK)
    status =
        fg__space_samples(velocity, data, pair, grid, &range, options->mask, plane, NULL);
  for (size_t i = 0; plane && i < row * range.count && status == FG_STATUS_OK; ++i)
    add_squares(sum, velocity, i);
  /* parts of the plane are refused for this, too: they are zero everywhere */
  if (status == FG_STATUS_OK && sum[0] >= sum[1] &&
      !moves_in_plane(velocity, row * range.count))
    status =
        fg__field_check_plane(data->context, sum[0], sum[1],
                              (const char *[2]){fg__space_domain_axis_name(domain, 0),
                                                fg__space_domain_axis_name(domain, 1)});
  memcpy(held, axis, sizeof held);
  if (part.axis[domain->dimension - 1].size < last)
    held[domain->dimension - 1] += rows.first;
  if (status == FG_STATUS_OK)
    status = create_field(out, data, pair, &part, options, velocity, held, &slab);
  if (status == FG_STATUS_OK)
    (*out)->normal_share = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
  clear(velocity, axis);
  return status;
}

/* Counts missing samples, and in a plane what is normal to it. */
fg_status fg__space_count(fg_inventory_vector *vector, const fg__dataset *data,
                          const fg__pair *pair, const fg__grid *grid)
{
  const fg__space_domain *domain = grid->domain;
  const bool normal = domain->dimension == 2 && fg__pair_components(pair) == 3;
  const size_t all = domain->size[domain->dimension - 1],
               row = fg__space_domain_row(domain);
  const size_t most = row < COUNTED_AT_ONCE ? COUNTED_AT_ONCE / row : 1;
  double sum[2] = {0.0, 0.0};
  size_t missing = 0;
  bool is_settled = false;
  for (size_t first = 0; first < all; first += most) {
    float *velocity[3];
    const fg__row_range some = {first, all - first < most ? all - first : most};
    fg_status status =
        fg__space_samples(velocity, data, pair, grid, &some, NULL, normal, &is_settled);
    if (status != FG_STATUS_OK)
      return status;
    for (size_t i = 0; i < row * some.count; ++i) {
      bool here = true;
      for (int k = 0; k < domain->dimension; ++k)
        here = here && isfinite(velocity[k][i]);
      missing += !here;
      if (normal)
        add_squares(sum, velocity, i);
    }
    for (int k = 0; k < 3; ++k)
      free(velocity[k]);
  }
  vector->missing_share = (double)missing / ((double)row * (double)all);
  vector->normal_share = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
  return FG_STATUS_OK;
}

/* Size and bounds of the part in the dataset's region. */
static fg_status describe_part(fg_inventory_vector *vector, const fg__dataset *data,
                               const fg__grid *grid)
{
  double *axis[3] = {NULL, NULL, NULL};
  fg_status status = create_axes(axis, data, grid->domain);
  for (int k = 0; k < grid->domain->dimension && status == FG_STATUS_OK; ++k) {
    fg__region_range part;
    status = fg__region_find(&part, data->context, data->file[0].path, &data->region, k,
                             grid->axis[k].name, "", axis[k], grid->axis[k].size);
    vector->size[k] = (int)part.count;
    vector->bounds[2 * k] = part.low;
    vector->bounds[2 * k + 1] = part.high;
  }
  for (int k = 0; k < 3; ++k)
    free(axis[k]);
  return status;
}

fg_status fg__space_describe(fg_inventory_vector *vector, const fg__dataset *data,
                             const fg__pair *pair, const fg__grid *grid)
{
  const fg__space_domain *domain = grid->domain;
  const fg__variable *const *v = pair->component;
  vector->components = fg__pair_components(pair);
  vector->name[2] = v[2] && !v[0]->element ? v[2]->name : NULL;
  if (domain->cells)
    vector->cells = fg__cell_set_count(domain->cells);
  for (int k = 0; k < domain->dimension; ++k) {
    double *bounds = &vector->bounds[2 * k];
    vector->size[k] = (int)domain->size[k];
    vector->axis_name[k] = fg__space_domain_axis_name(domain, k);
    fg_status status = fg__space_domain_coordinates(&bounds[0], data, k, 0, 1);
    if (status == FG_STATUS_OK)
      status = fg__space_domain_coordinates(&bounds[1], data, k, domain->size[k] - 1, 1);
    if (status != FG_STATUS_OK)
      return status;
  }
  return has_region(data, grid) ? describe_part(vector, data, grid) : FG_STATUS_OK;
}
