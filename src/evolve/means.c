#include "evolve/means.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const double steps = 0x1p31;

/* Wells are at -1 and 1; what is far beyond is cut, so that 2^24 nodes of mass 1 can be
 * that large, and 2^31 be in the wells, before a sum overflows. */
static const double largest = 128.0;

fg_status fg__means_create(fg__means *out, fg_context *context, int count)
{
  size_t parts = (size_t)count;
  *out = (fg__means){.count = count};
  out->mass = fg__allocate(parts, sizeof *out->mass);
  out->sum = fg__allocate(parts, sizeof *out->sum);
  out->mean = fg__allocate(parts, sizeof *out->mean);
  out->shift = fg__allocate(parts, sizeof *out->shift);
  if (out->mass && out->sum && out->mean && out->shift)
    return FG_STATUS_OK;
  fg__means_clear(out);
  return fg__fail_memory(context, "the parts of the domain", 4 * parts * sizeof(double));
}

void fg__means_clear(fg__means *means)
{
  free(means->mass);
  free(means->sum);
  free(means->mean);
  free(means->shift);
  *means = (fg__means){0};
}

static double mean_of(const fg__means *means, int part)
{
  return means->mass[part] > 0 ? (double)means->sum[part] / (double)means->mass[part]
                               : 0.0;
}

void fg__means_hold(fg__means *means)
{
  for (int n = 0; n < means->count; ++n)
    means->mean[n] = mean_of(means, n);
}

void fg__means_begin(fg__means *means)
{
  memset(means->sum, 0, (size_t)means->count * sizeof *means->sum);
}

void fg__means_add_row(fg__means *means, const int *part, const float *mass,
                       const float *u, int nodes, bool weigh)
{
  for (int n = 0; n < nodes; ++n) {
    if (part[n] <= 0)
      continue;
    double value = fmin(fmax((double)u[n], -largest), largest); /* a NaN is cut too */
    means->sum[part[n] - 1] += llrint(value * (double)mass[n] * steps);
    if (weigh)
      means->mass[part[n] - 1] += llrint((double)mass[n] * steps);
  }
}

void fg__means_settle(fg__means *means)
{
  for (int n = 0; n < means->count; ++n)
    means->shift[n] = (float)(means->mean[n] - mean_of(means, n));
}

void fg__means_shift_row(const fg__means *means, const int *part, float *u, int nodes)
{
  for (int n = 0; n < nodes; ++n)
    if (part[n] > 0)
      u[n] += means->shift[part[n] - 1];
}
