#include "texture/raster.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

enum { MOST_LEVELS = 20 }; /* 2^20 pixels a side are more than there can be */

/* Sums over squares of pixels, twice as wide at every level: a vector and the share of
 * the square that is known. */
typedef struct level {
  int size[2];
  float (*sum)[3];
} level;

static size_t place(const level *l, int i, int j)
{
  return (size_t)j * (size_t)l->size[0] + (size_t)i;
}

static void pull(const level *coarse, const level *fine)
{
  for (int j = 0; j < coarse->size[1]; ++j)
    for (int i = 0; i < coarse->size[0]; ++i) {
      float *sum = coarse->sum[place(coarse, i, j)];
      for (int b = 2 * j; b < 2 * j + 2 && b < fine->size[1]; ++b)
        for (int a = 2 * i; a < 2 * i + 2 && a < fine->size[0]; ++a)
          for (int k = 0; k < 3; ++k)
            sum[k] += fine->sum[place(fine, a, b)][k];
      /* one known pixel is enough: more only make it surer */
      float share = sum[2] > 1.0F ? 1.0F / sum[2] : 1.0F;
      for (int k = 0; k < 3; ++k)
        sum[k] *= share;
    }
}

static int clamped(int index, int size)
{
  return index < 0 ? 0 : (index < size ? index : size - 1);
}

/* The coarser level's value at a pixel, interpolated between the middles of its cells. */
static void interpolate(float out[3], const level *coarse, int i, int j)
{
  const int x[2] = {clamped(i / 2, coarse->size[0]),
                    clamped(i / 2 + (i % 2 ? 1 : -1), coarse->size[0])};
  const int y[2] = {clamped(j / 2, coarse->size[1]),
                    clamped(j / 2 + (j % 2 ? 1 : -1), coarse->size[1])};
  static const float near_and_far[2] = {0.75F, 0.25F};
  for (int k = 0; k < 3; ++k)
    out[k] = 0.0F;
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a)
      for (int k = 0; k < 3; ++k)
        out[k] +=
            near_and_far[a] * near_and_far[b] * coarse->sum[place(coarse, x[a], y[b])][k];
}

static void push(const level *fine, const level *coarse)
{
  for (int j = 0; j < fine->size[1]; ++j)
    for (int i = 0; i < fine->size[0]; ++i) {
      float *sum = fine->sum[place(fine, i, j)];
      if (sum[2] >= 1.0F)
        continue;
      float guess[3];
      interpolate(guess, coarse, i, j);
      const float missing = 1.0F - sum[2];
      for (int k = 0; k < 3; ++k)
        sum[k] += missing * guess[k];
    }
}

static void clear(level *pyramid, int levels)
{
  for (int n = 0; n < levels; ++n)
    free(pyramid[n].sum);
}

/* All levels up to one square, or 0 without memory. */
static int allocate(level *pyramid, const int size[2])
{
  int levels = 0;
  int wide = size[0], high = size[1];
  for (;;) {
    level *l = &pyramid[levels++];
    *l = (level){{wide, high}, fg__allocate((size_t)wide * (size_t)high, sizeof *l->sum)};
    if (!l->sum) {
      clear(pyramid, levels);
      return 0;
    }
    if ((wide == 1 && high == 1) || levels == MOST_LEVELS)
      return levels;
    wide = (wide + 1) / 2;
    high = (high + 1) / 2;
  }
}

/* Where guesses from all sides cancel out, any direction is as good. */
static void write(float (*direction)[2], const level *finest)
{
  size_t count = (size_t)finest->size[0] * (size_t)finest->size[1];
  for (size_t n = 0; n < count; ++n) {
    const float *sum = finest->sum[n];
    const float size = sqrtf(sum[0] * sum[0] + sum[1] * sum[1]);
    direction[n][0] = size > 0.0F ? sum[0] / size : 1.0F;
    direction[n][1] = size > 0.0F ? sum[1] / size : 0.0F;
  }
}

fg_status fg__fill_directions(float (*direction)[2], fg_context *context,
                              const unsigned char *pixel, const int size[2])
{
  level pyramid[MOST_LEVELS];
  const size_t count = (size_t)size[0] * (size_t)size[1];
  const int levels = allocate(pyramid, size);
  if (!levels)
    return fg__fail_memory(context, "directions beside the mask",
                           2 * count * sizeof *pyramid[0].sum);
  for (size_t n = 0; n < count; ++n)
    if (pixel[n] == FG__PIXEL_MOVING) {
      pyramid[0].sum[n][0] = direction[n][0];
      pyramid[0].sum[n][1] = direction[n][1];
      pyramid[0].sum[n][2] = 1.0F;
    }
  for (int n = 1; n < levels; ++n)
    pull(&pyramid[n], &pyramid[n - 1]);
  for (int n = levels - 1; n > 0; --n)
    push(&pyramid[n - 1], &pyramid[n]);
  write(direction, &pyramid[0]);
  clear(pyramid, levels);
  return FG_STATUS_OK;
}
