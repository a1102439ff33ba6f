#include "place/domain/gaps.h"

#include "base/memory.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A hole is narrow where it is at most so wide along an axis: a share of the domain's
 * side, the root of its area, a fifth of lambda of 25 arrows; or so many samples. */
static const double NARROW_SHARE = 0.04;
enum { NARROW_SAMPLES = 3 };

/* Straight walls are narrow, too, but one of so many times that width long. */
enum { STRAIGHT = 4 };

/* The search for gaps ends with a pass that adds less than one in so many; so many of
 * them are asked whether they are in walls. */
enum { HARDLY = 1000, SOME = 4096 };

/* Of a sample. GAP: missing in a narrow hole. FRESH: found or filled in this pass. */
typedef enum kind { MISSING, VALID, GAP, FRESH } kind;

typedef struct holes {
  const fg_field_arrays *field;
  const fg__place_domain *domain;
  size_t count; /* samples */
  double width; /* of a narrow hole */
  unsigned char *kind;
} holes;

/* Finds the missing samples; whether there are any. */
static bool mark_missing(holes *all)
{
  bool any = false;
  for (size_t n = 0; n < all->count; ++n) {
    all->kind[n] = fg__field_is_missing(all->field, n) ? MISSING : VALID;
    any |= all->kind[n] == MISSING;
  }
  return any;
}

/* All samples of a kind become of another; returns how many. */
static size_t turn(holes *all, kind from, kind to)
{
  size_t count = 0;
  for (size_t n = 0; n < all->count; ++n)
    if (all->kind[n] == from) {
      all->kind[n] = (unsigned char)to;
      ++count;
    }
  return count;
}

/* Whether a hole between two samples along axis k is narrow. */
static bool is_narrow(const holes *all, int k, int before, int after)
{
  const double *axis = all->field->axis[k];
  return after - before <= NARROW_SAMPLES + 1 || axis[after] - axis[before] <= all->width;
}

static bool is_there(const holes *all, size_t n)
{
  return all->kind[n] == VALID || all->kind[n] == GAP;
}

/* Finds what is narrow along the axes. before: a column: room for the last sample that is
 * there. */
static void bridge(holes *all, int *before)
{
  const int *size = all->field->size;
  const size_t row = (size_t)size[0];
  for (int i = 0; i < size[0]; ++i)
    before[i] = -1;
  for (int j = 0; j < size[1]; ++j) {
    const size_t first = (size_t)j * row;
    int left = -1;
    for (int i = 0; i < size[0]; ++i) {
      if (!is_there(all, first + (size_t)i))
        continue;
      if (left >= 0 && i > left + 1 && is_narrow(all, 0, left, i))
        memset(all->kind + first + left + 1, FRESH, (size_t)(i - left - 1));
      if (before[i] >= 0 && j > before[i] + 1 && is_narrow(all, 1, before[i], j))
        for (int m = before[i] + 1; m < j; ++m)
          all->kind[(size_t)m * row + (size_t)i] = FRESH;
      left = i;
      before[i] = j;
    }
  }
}

/* Finds narrow holes, and what is narrow with these bridged, until there is hardly more.
 */
static size_t find_gaps(holes *all, int *before)
{
  size_t count = 0, found;
  do {
    bridge(all, before);
    found = turn(all, FRESH, GAP);
    count += found;
  } while (HARDLY * found > count);
  return count;
}

/* How far a hole reaches from a sample along a diagonal or an axis. */
static double reach(const holes *all, const int at[2], const int step[2], double most)
{
  const int *size = all->field->size;
  const double *const *axis = all->field->axis;
  double way[2] = {0.0, 0.0};
  for (int x = at[0] + step[0], y = at[1] + step[1];
       x >= 0 && x < size[0] && y >= 0 && y < size[1] && fmax(way[0], way[1]) <= most &&
       fg__field_is_missing(all->field, (size_t)y * (size_t)size[0] + (size_t)x);
       x += step[0], y += step[1]) {
    way[0] = fabs(axis[0][x] - axis[0][at[0]]);
    way[1] = fabs(axis[1][y] - axis[1][at[1]]);
  }
  return hypot(way[0], way[1]);
}

/* Whether a sample is in a hole that is long. */
static bool is_in_wall(const holes *all, size_t sample)
{
  static const int STEP[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  const size_t row = (size_t)all->field->size[0];
  const int at[2] = {(int)(sample % row), (int)(sample / row)};
  const double most =
      STRAIGHT * fmax(all->width, NARROW_SAMPLES * all->domain->data_step);
  for (int k = 0; k < 4; ++k) {
    const int back[2] = {-STEP[k][0], -STEP[k][1]};
    if (reach(all, at, STEP[k], most) + reach(all, at, back, most) > most)
      return true;
  }
  return false;
}

/* Whether most gaps are in no wall, by some of them. */
static bool are_scattered(const holes *all, size_t count)
{
  const size_t every = 1 + count / SOME;
  size_t gaps = 0, asked = 0, walls = 0;
  for (size_t n = 0; n < all->count; ++n)
    if (all->kind[n] == GAP && gaps++ % every == 0) {
      ++asked;
      walls += is_in_wall(all, n);
    }
  return 2 * walls < asked;
}

/* The mean velocity at the valid neighbours along the axes; false: there are none. */
static bool mean_around(float mean[2], const holes *all, float *const velocity[2],
                        size_t sample)
{
  const size_t width = (size_t)all->field->size[0];
  const size_t stride[2] = {1, width};
  const size_t at[2] = {sample % width, sample / width};
  double sum[2] = {0.0, 0.0};
  int count = 0;
  for (int k = 0; k < 2; ++k)
    for (int side = 0; side < 2; ++side) {
      if (at[k] == (side ? (size_t)all->field->size[k] - 1 : 0))
        continue;
      const size_t beside = side ? sample + stride[k] : sample - stride[k];
      if (all->kind[beside] != VALID)
        continue;
      sum[0] += (double)velocity[0][beside];
      sum[1] += (double)velocity[1][beside];
      ++count;
    }
  for (int k = 0; k < 2 && count > 0; ++k)
    mean[k] = (float)(sum[k] / count);
  return count > 0;
}

/* Fills gaps from their sides on, a sample deep in each pass. gap: room for them. */
static void fill(holes *all, float *const velocity[2], size_t *gap)
{
  size_t count = 0, left;
  for (size_t n = 0; n < all->count; ++n)
    if (all->kind[n] == GAP)
      gap[count++] = n;
  for (bool any = true; any; count = left) {
    left = 0;
    for (size_t k = 0; k < count; ++k) {
      float mean[2];
      if (!mean_around(mean, all, velocity, gap[k]))
        continue;
      velocity[0][gap[k]] = mean[0];
      velocity[1][gap[k]] = mean[1];
      all->kind[gap[k]] = FRESH;
    }
    for (size_t k = 0; k < count; ++k)
      if (all->kind[gap[k]] == FRESH)
        all->kind[gap[k]] = VALID;
      else
        gap[left++] = gap[k];
    any = left < count;
  }
}

static fg_status create_filled(fg_field **out, fg_context *context, holes *all,
                               size_t count)
{
  const size_t bytes = all->count * sizeof(float);
  fg_field_arrays filled = *all->field;
  float *velocity[2] = {fg__allocate(all->count, sizeof(float)),
                        fg__allocate(all->count, sizeof(float))};
  size_t *gap = fg__allocate(count, sizeof *gap);
  fg_status status = FG_STATUS_OK;
  if (velocity[0] && velocity[1] && gap) {
    for (int k = 0; k < 2; ++k) {
      memcpy(velocity[k], all->field->velocity[k], bytes);
      filled.velocity[k] = velocity[k];
    }
    fill(all, velocity, gap);
    filled.valid = all->kind;
    status = fg_field_create(out, context, &filled);
  } else {
    status =
        fg__fail_memory(context, "a field without gaps", 2 * bytes + count * sizeof *gap);
  }
  free(gap);
  free(velocity[0]);
  free(velocity[1]);
  return status;
}

fg_status fg__place_fill_gaps(fg_field **out, fg_context *context,
                              const fg__place_domain *domain)
{
  holes all = {.field = fg_field_contents(domain->field),
               .domain = domain,
               .width = NARROW_SHARE * sqrt(domain->whole)};
  *out = NULL;
  if (domain->dimension != 2)
    return FG_STATUS_OK;
  all.count = (size_t)all.field->size[0] * (size_t)all.field->size[1];
  all.kind = fg__allocate(all.count, 1);
  int *before = fg__allocate((size_t)all.field->size[0], sizeof *before);
  fg_status status = FG_STATUS_OK;
  if (!all.kind || !before) {
    status = fg__fail_memory(context, "the gaps of a field", all.count);
  } else {
    const size_t count = mark_missing(&all) ? find_gaps(&all, before) : 0;
    if (count > 0 && are_scattered(&all, count))
      status = create_filled(out, context, &all, count);
  }
  free(before);
  free(all.kind);
  return status;
}
