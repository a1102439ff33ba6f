#include "brush/grey.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

float *fg__image_grey(const fg_image_arrays *image)
{
  static const float weight[3] = {0.2126F, 0.7152F, 0.0722F};
  size_t count = (size_t)image->width * (size_t)image->height;
  float *grey = fg__allocate(count, sizeof *grey);
  for (size_t n = 0; n < count && grey; ++n) {
    const float *s = image->sample + n * (size_t)image->channels;
    float value = image->channels == 1
                      ? s[0]
                      : weight[0] * s[0] + weight[1] * s[1] + weight[2] * s[2];
    float alpha = image->alpha ? image->alpha[n] : 1.0F;
    grey[n] = alpha * value + (1.0F - alpha);
  }
  return grey;
}

/* Mirrors an index into [0, count). */
static int mirrored(int index, int count)
{
  int period = 2 * count, rest = index % period;
  rest = rest < 0 ? rest + period : rest;
  return rest < count ? rest : period - 1 - rest;
}

/* A Gaussian as such, or for large deviations as three running means of odd lengths whose
 * variances add up to its own, (n^2 - 1) / 12 each (Wells 1986). */
typedef struct kernel {
  float *weight; /* NULL: running means */
  int radius;    /* of the Gaussian, or of each mean */
  int wider;     /* of the three means so many have radius + 1 */
} kernel;

/* Above, running means are within 3 % of the Gaussian's peak, and faster. */
static const double least_running = 4.0;

static bool kernel_create(kernel *out, double deviation)
{
  *out = (kernel){0};
  if (deviation >= least_running) {
    double variance = 12.0 * deviation * deviation;
    out->radius = (int)((sqrt(variance / 3.0 + 1.0) - 1.0) / 2.0);
    double n = 2.0 * out->radius + 1.0;
    /* (n + 2)^2 - n^2 = 4 n + 4 for each wider one */
    out->wider = (int)lround((variance - 3.0 * (n * n - 1.0)) / (4.0 * n + 4.0));
    return true;
  }
  out->radius = (int)ceil(3.0 * deviation);
  out->weight = fg__allocate((size_t)out->radius + 1, sizeof *out->weight);
  if (!out->weight)
    return false;
  double sum = 0.0;
  for (int k = 0; k <= out->radius; ++k) {
    double w = exp(-0.5 * k * k / (deviation * deviation));
    out->weight[k] = (float)w;
    sum += k ? 2.0 * w : w;
  }
  for (int k = 0; k <= out->radius; ++k)
    out->weight[k] = (float)((double)out->weight[k] / sum);
  return true;
}

static void running_mean(float *line, int count, int radius, float *padded)
{
  for (int i = -radius; i < count + radius; ++i)
    padded[i + radius] = line[mirrored(i, count)];
  double sum = 0.0;
  for (int k = 0; k < 2 * radius; ++k)
    sum += (double)padded[k];
  for (int i = 0; i < count; ++i) {
    sum += (double)padded[i + 2 * radius];
    line[i] = (float)(sum / (2 * radius + 1));
    sum -= (double)padded[i];
  }
}

static void weighted_mean(float *line, int count, const kernel *k, float *padded)
{
  int radius = k->radius;
  for (int i = -radius; i < count + radius; ++i)
    padded[i + radius] = line[mirrored(i, count)];
  for (int i = 0; i < count; ++i)
    line[i] = k->weight[0] * padded[i + radius];
  for (int m = 1; m <= radius; ++m)
    for (int i = 0; i < count; ++i)
      line[i] += k->weight[m] * (padded[i + radius - m] + padded[i + radius + m]);
}

static void blur_line(float *line, int count, const kernel *k, float *padded)
{
  if (k->weight)
    weighted_mean(line, count, k, padded);
  else
    for (int pass = 0; pass < 3; ++pass)
      running_mean(line, count, k->radius + (pass < k->wider), padded);
}

bool fg__image_blur(float *plane, int width, int height, double deviation)
{
  if (!(deviation > 0.0))
    return true;
  kernel k;
  if (!kernel_create(&k, deviation))
    return false;
  int longest = width > height ? width : height;
  float *padded =
      fg__allocate((size_t)longest + 2 * (size_t)k.radius + 2, sizeof *padded);
  float *column = fg__allocate((size_t)height, sizeof *column);
  bool whole = padded && column;
  for (int j = 0; j < height && whole; ++j)
    blur_line(plane + (size_t)j * (size_t)width, width, &k, padded);
  for (int i = 0; i < width && whole; ++i) {
    for (int j = 0; j < height; ++j)
      column[j] = plane[(size_t)j * (size_t)width + (size_t)i];
    blur_line(column, height, &k, padded);
    for (int j = 0; j < height; ++j)
      plane[(size_t)j * (size_t)width + (size_t)i] = column[j];
  }
  free(k.weight);
  free(padded);
  free(column);
  return whole;
}
