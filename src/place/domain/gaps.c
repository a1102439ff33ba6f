#include "place/domain/gaps.h"

#include "base/memory.h"
#include "place/domain/distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A hole is small up to this share of the domain's side, the root of its area: a fifth of
 * lambda of 25 arrows. */
static const double SMALL_SHARE = 0.04;

/* Small holes are gaps where for them more than this share of the domain is too near to a
 * wall for a line of 25 arrows, a tenth of lambda. */
static const double TOO_NEAR = 0.02, LEAST_TAKEN = 0.25;

/* Of a sample. FRESH: filled in the present pass. */
typedef enum kind { VALID, MISSING, SMALL, LARGE, FRESH } kind;

/* Samples along the sides of a hole, with those around it. */
typedef struct extent {
  int low[2], high[2];
} extent;

typedef struct holes {
  const fg_field_arrays *field;
  const fg__place_domain *domain;
  size_t count;         /* samples */
  unsigned char *kind;  /* a sample */
  size_t *stack, *hole; /* samples to be looked at, and those of one hole */
  /* A cell of the domain's map: whether it is inside with small holes as walls, and
   * without. */
  int *with, *without;
  float *distance, *other;
} holes;

static size_t cell_count(const fg__place_domain *domain)
{
  return (size_t)domain->cells[0] * (size_t)domain->cells[1];
}

static bool is_missing(const fg_field_arrays *field, size_t n)
{
  return (field->valid && !field->valid[n]) || !isfinite(field->velocity[0][n]) ||
         !isfinite(field->velocity[1][n]);
}

static void release(holes *all)
{
  free(all->kind);
  free(all->stack);
  free(all->hole);
  free(all->with);
  free(all->without);
  free(all->distance);
  free(all->other);
}

/* Finds the missing samples; whether there are any. */
static bool mark_missing(holes *all)
{
  bool any = false;
  for (size_t n = 0; n < all->count; ++n) {
    all->kind[n] = is_missing(all->field, n) ? MISSING : VALID;
    any |= all->kind[n] == MISSING;
  }
  return any;
}

static fg_status allocate(holes *all, fg_context *context)
{
  const size_t cells = cell_count(all->domain);
  all->stack = fg__allocate(all->count, sizeof *all->stack);
  all->hole = fg__allocate(all->count, sizeof *all->hole);
  all->with = fg__allocate(cells, sizeof *all->with);
  all->without = fg__allocate(cells, sizeof *all->without);
  all->distance = fg__allocate(cells, sizeof *all->distance);
  all->other = fg__allocate(cells, sizeof *all->other);
  if (!all->stack || !all->hole || !all->with || !all->without || !all->distance ||
      !all->other)
    return fg__fail_memory(context, "the gaps of a field",
                           all->count * 2 * sizeof *all->stack + cells * 16);
  return FG_STATUS_OK;
}

static void widen(extent *around, int x, int y)
{
  const int at[2] = {x, y};
  for (int k = 0; k < 2; ++k) {
    around->low[k] = at[k] < around->low[k] ? at[k] : around->low[k];
    around->high[k] = at[k] > around->high[k] ? at[k] : around->high[k];
  }
}

/* Lists the samples of a hole, which touch along sides or at corners; returns their
 * number. */
static size_t list_hole(holes *all, extent *around, size_t first)
{
  const int *size = all->field->size;
  size_t depth = 0, count = 0;
  *around = (extent){{size[0], size[1]}, {-1, -1}};
  all->stack[depth++] = first;
  all->kind[first] = LARGE;
  while (depth > 0) {
    const size_t sample = all->stack[--depth];
    const int i = (int)(sample % (size_t)size[0]), j = (int)(sample / (size_t)size[0]);
    all->hole[count++] = sample;
    widen(around, i - 1, j - 1);
    widen(around, i + 1, j + 1);
    for (int y = j - 1; y <= j + 1; ++y)
      for (int x = i - 1; x <= i + 1; ++x) {
        if (x < 0 || x >= size[0] || y < 0 || y >= size[1])
          continue;
        const size_t next = (size_t)y * (size_t)size[0] + (size_t)x;
        if (all->kind[next] != MISSING)
          continue;
        all->kind[next] = LARGE;
        all->stack[depth++] = next;
      }
  }
  return count;
}

/* Whether a hole lies within the field, and is small. */
static bool is_small(const fg_field_arrays *field, const extent *around, double most)
{
  for (int k = 0; k < 2; ++k)
    if (around->low[k] < 0 || around->high[k] >= field->size[k] ||
        field->axis[k][around->high[k]] - field->axis[k][around->low[k]] > most)
      return false;
  return true;
}

/* Sets the map's cells round a small hole: a wall, or none. */
static void map_hole(holes *all, const extent *around)
{
  const fg__place_domain *domain = all->domain;
  int low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    const double *axis = all->field->axis[k];
    low[k] = (int)((axis[around->low[k]] - domain->low[k]) / domain->spacing);
    high[k] = (int)((axis[around->high[k]] - domain->low[k]) / domain->spacing);
    high[k] = high[k] < domain->cells[k] ? high[k] : domain->cells[k] - 1;
  }
  for (int y = low[1]; y <= high[1]; ++y)
    for (int x = low[0]; x <= high[0]; ++x)
      all->without[(size_t)y * (size_t)domain->cells[0] + (size_t)x] = 1;
  /* it may be smaller than a cell */
  all->with[(size_t)((low[1] + high[1]) / 2) * (size_t)domain->cells[0] +
            (size_t)((low[0] + high[0]) / 2)] = 0;
}

/* Tells small holes from large ones. */
static void find_small(holes *all)
{
  const double most = SMALL_SHARE * sqrt(all->domain->whole);
  for (size_t n = 0; n < cell_count(all->domain); ++n)
    all->with[n] = all->without[n] = all->domain->subdomain[n] != 0;
  for (size_t n = 0; n < all->count; ++n) {
    extent around;
    if (all->kind[n] != MISSING)
      continue;
    const size_t count = list_hole(all, &around, n);
    if (!is_small(all->field, &around, most))
      continue;
    for (size_t k = 0; k < count; ++k)
      all->kind[all->hole[k]] = SMALL;
    map_hole(all, &around);
  }
}

/* Whether small holes take lines their room. */
static fg_status are_gaps(bool *out, holes *all, fg_context *context)
{
  const fg__place_domain *domain = all->domain;
  const double near = TOO_NEAR * sqrt(domain->whole);
  size_t inside = 0, taken = 0;
  fg_status status = fg__place_distance(all->distance, context, all->with, domain->cells,
                                        2, domain->spacing);
  if (status == FG_STATUS_OK)
    status = fg__place_distance(all->other, context, all->without, domain->cells, 2,
                                domain->spacing);
  for (size_t n = 0; n < cell_count(domain) && status == FG_STATUS_OK; ++n) {
    inside += domain->subdomain[n] != 0;
    taken += domain->subdomain[n] != 0 && (double)all->distance[n] < near &&
             (double)all->other[n] >= near;
  }
  *out = (double)taken > LEAST_TAKEN * (double)inside;
  return status;
}

/* The mean velocity at the valid neighbours along the axes; false: there are none. */
static bool mean_around(float mean[2], const holes *all, float *const velocity[2],
                        size_t sample)
{
  const size_t row = (size_t)all->field->size[0];
  const size_t beside[4] = {sample - 1, sample + 1, sample - row, sample + row};
  double sum[2] = {0.0, 0.0};
  int count = 0;
  for (int k = 0; k < 4; ++k)
    if (all->kind[beside[k]] == VALID) {
      sum[0] += (double)velocity[0][beside[k]];
      sum[1] += (double)velocity[1][beside[k]];
      ++count;
    }
  for (int k = 0; k < 2 && count > 0; ++k)
    mean[k] = (float)(sum[k] / count);
  return count > 0;
}

/* Fills small holes from their sides on, a sample deep in each pass. */
static void fill(holes *all, float *const velocity[2])
{
  for (bool any = true; any;) {
    any = false;
    for (size_t n = 0; n < all->count; ++n) {
      float mean[2];
      if (all->kind[n] != SMALL || !mean_around(mean, all, velocity, n))
        continue;
      velocity[0][n] = mean[0];
      velocity[1][n] = mean[1];
      all->kind[n] = FRESH;
      any = true;
    }
    for (size_t n = 0; n < all->count; ++n)
      all->kind[n] = all->kind[n] == FRESH ? VALID : all->kind[n];
  }
}

static fg_status create_filled(fg_field **out, fg_context *context, holes *all)
{
  const size_t bytes = all->count * sizeof(float);
  fg_field_arrays filled = *all->field;
  float *velocity[2] = {fg__allocate(all->count, sizeof(float)),
                        fg__allocate(all->count, sizeof(float))};
  fg_status status = FG_STATUS_OK;
  if (velocity[0] && velocity[1]) {
    for (int k = 0; k < 2; ++k) {
      memcpy(velocity[k], all->field->velocity[k], bytes);
      filled.velocity[k] = velocity[k];
    }
    fill(all, velocity);
    for (size_t n = 0; n < all->count; ++n)
      all->kind[n] = all->kind[n] == VALID; /* as fg_field_arrays has it */
    filled.valid = all->kind;
    status = fg_field_create(out, context, &filled);
  } else {
    status = fg__fail_memory(context, "a field without gaps", 2 * bytes);
  }
  free(velocity[0]);
  free(velocity[1]);
  return status;
}

fg_status fg__place_fill_gaps(fg_field **out, fg_context *context,
                              const fg__place_domain *domain)
{
  holes all = {.field = fg_field_contents(domain->field), .domain = domain};
  bool gaps = false;
  *out = NULL;
  if (domain->dimension != 2)
    return FG_STATUS_OK;
  all.count = (size_t)all.field->size[0] * (size_t)all.field->size[1];
  all.kind = fg__allocate(all.count, 1);
  if (!all.kind)
    return fg__fail_memory(context, "the gaps of a field", all.count);
  fg_status status = FG_STATUS_OK;
  if (mark_missing(&all)) {
    status = allocate(&all, context);
    if (status == FG_STATUS_OK) {
      find_small(&all);
      status = are_gaps(&gaps, &all, context);
    }
    if (status == FG_STATUS_OK && gaps)
      status = create_filled(out, context, &all);
  }
  release(&all);
  return status;
}
