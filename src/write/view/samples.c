#include "base/context.h"
#include "base/memory.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

uint16_t fg__view_half(float x)
{
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  const uint32_t sign = bits >> 16 & 0x8000U;
  uint32_t size = bits & 0x7fffffffU;
  if (size > 0x7f800000U)
    return 0x7e00U;
  if (size >= 0x477ff000U) /* 65520 and more */
    return (uint16_t)(sign | 0x7c00U);
  if (size < 0x38800000U) { /* below the least normal one: in units of 2^-24 */
    const float steps = fabsf(x) * 16777216.0F;
    return (uint16_t)(sign | (uint32_t)rintf(steps));
  }
  size += 0xfffU + (size >> 13 & 1U);
  return (uint16_t)(sign | ((size - 0x38000000U) >> 13));
}

/* Along an axis the samples that the page has: sample k lies at nearest[k], and is the
 * mean of those within `reach`. */
typedef struct thinning {
  int *nearest;
  int reach;
} thinning;

static fg_status thin(thinning *out, fg_context *context, int count, int kept,
                      bool periodic)
{
  *out = (thinning){.nearest = fg__allocate((size_t)kept, sizeof(int)),
                    .reach = count / kept / 2};
  if (!out->nearest)
    return fg__fail_memory(context, "a page's samples", (size_t)kept * sizeof(int));
  const double step = periodic ? (double)count / kept : (count - 1.0) / (kept - 1.0);
  for (int k = 0; k < kept; ++k)
    out->nearest[k] = (int)floor(k * step + 0.5);
  return FG_STATUS_OK;
}

/* The mean of what there is around a sample; false: it is missing itself. */
static bool mean_around(double mean[2], const fg_field_arrays *a, const thinning along[2],
                        int i, int j)
{
  const int at[2] = {along[0].nearest[i], along[1].nearest[j]};
  int low[2], high[2], count = 0;
  for (int k = 0; k < 2; ++k) {
    low[k] = at[k] - along[k].reach < 0 ? 0 : at[k] - along[k].reach;
    high[k] = at[k] + along[k].reach;
    high[k] = high[k] < a->size[k] ? high[k] : a->size[k] - 1;
  }
  mean[0] = mean[1] = 0.0;
  const size_t row = (size_t)a->size[0];
  if (a->valid && !a->valid[(size_t)at[1] * row + (size_t)at[0]])
    return false;
  for (int y = low[1]; y <= high[1]; ++y)
    for (int x = low[0]; x <= high[0]; ++x) {
      const size_t n = (size_t)y * row + (size_t)x;
      if (a->valid && !a->valid[n])
        continue;
      for (int k = 0; k < 2; ++k)
        mean[k] += (double)a->velocity[k][n];
      ++count;
    }
  for (int k = 0; k < 2; ++k)
    mean[k] /= count;
  return true;
}

double fg__view_fastest(const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t count = 1;
  double most = 0.0;
  for (int k = 0; k < a->dimension; ++k)
    count *= (size_t)a->size[k];
  for (size_t n = 0; n < count; ++n)
    for (int k = 0; k < a->dimension; ++k)
      if (!a->valid || a->valid[n])
        most = fmax(most, fabs((double)a->velocity[k][n]));
  return most;
}

static void fill(fg__view_samples *s, const fg_field_arrays *a, const thinning along[2])
{
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < s->size[k]; ++i)
      s->axis[k][i] = a->axis[k][along[k].nearest[i]];
  const float missing = nanf("");
  size_t n = 0;
  for (int j = 0; j < s->size[1]; ++j)
    for (int i = 0; i < s->size[0]; ++i, ++n) {
      double mean[2];
      const bool is_there = mean_around(mean, a, along, i, j);
      for (int k = 0; k < 2; ++k)
        s->velocity[k][n] =
            fg__view_half(is_there ? (float)(mean[k] / s->unit) : missing);
    }
}

fg_status fg__view_samples_create(fg__view_samples *out, fg_context *context,
                                  const fg_field *field, size_t most)
{
  const fg_field_arrays *a = fg_field_contents(field);
  thinning along[2] = {{NULL, 0}, {NULL, 0}};
  *out = (fg__view_samples){.unit = 1.0};
  const double count = (double)a->size[0] * (double)a->size[1];
  const double shrink = fmin(1.0, sqrt((double)most / count));
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && !status; ++k) {
    out->size[k] = (int)fmax(2.0, floor(shrink * a->size[k]));
    status = thin(&along[k], context, a->size[k], out->size[k], a->period[k] > 0.0);
  }
  const size_t kept = (size_t)out->size[0] * (size_t)out->size[1];
  for (int k = 0; k < 2 && !status; ++k) {
    out->axis[k] = fg__allocate((size_t)out->size[k], sizeof(double));
    out->velocity[k] = fg__allocate(kept, sizeof(uint16_t));
    if (!out->axis[k] || !out->velocity[k])
      status = fg__fail_memory(context, "a page's samples", kept * sizeof(uint16_t));
  }
  out->unit = fg__view_fastest(field);
  if (!status)
    fill(out, a, along);
  else
    fg__view_samples_clear(out);
  for (int k = 0; k < 2; ++k)
    free(along[k].nearest);
  return status;
}

void fg__view_samples_clear(fg__view_samples *samples)
{
  for (int k = 0; k < 2; ++k) {
    free(samples->axis[k]);
    free(samples->velocity[k]);
    samples->axis[k] = NULL;
    samples->velocity[k] = NULL;
  }
}
