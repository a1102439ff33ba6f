#include "brush/structure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "brush/grey.h"

/* The wide average: how much wider, and its weight. */
static const double wider = 4.0, wide_weight = 0.02;

/* Where gradients agree at least by half the full anisotropy is given, as for flows
 * (tensor/smooth.c). */
static const double full_coherence = 0.5;

/* Gradients below a step of 8-bit grey over eight pixels say nothing. */
static const double least_slope = 1.0 / 255.0 / 8.0;

/* The double-angle vector of the gradient and its squared length, y upwards. */
static void gradients(const float *grey, int width, int height, float *x, float *y,
                      float *square)
{
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      size_t row = (size_t)width, n = (size_t)j * row + (size_t)i;
      size_t left = i > 0 ? n - 1 : n, right = i + 1 < width ? n + 1 : n;
      size_t above = j > 0 ? n - row : n, below = j + 1 < height ? n + row : n;
      float gx = (grey[right] - grey[left]) / (float)(right - left);
      float gy = (grey[above] - grey[below]) / (float)((below - above) / row);
      x[n] = gx * gx - gy * gy;
      y[n] = 2.0F * gx * gy;
      square[n] = gx * gx + gy * gy;
    }
}

static bool average(float *plane, int width, int height, double deviation)
{
  size_t count = (size_t)width * (size_t)height;
  float *wide = fg__allocate(count, sizeof *wide);
  if (!wide)
    return false;
  bool whole = fg__image_blur(plane, width, height, deviation);
  memcpy(wide, plane, count * sizeof *wide);
  whole = whole && fg__image_blur(wide, width, height, wider * deviation);
  for (size_t n = 0; n < count; ++n)
    plane[n] += (float)wide_weight * wide[n];
  free(wide);
  return whole;
}

fg_status fg__structure_create(fg__structure *out, fg_context *context, const float *grey,
                               int width, int height, double deviation, double anisotropy)
{
  size_t count = (size_t)width * (size_t)height;
  *out = (fg__structure){.width = width, .height = height};
  out->xx = fg__allocate(count, sizeof *out->xx);
  out->xy = fg__allocate(count, sizeof *out->xy);
  out->yy = fg__allocate(count, sizeof *out->yy);
  bool whole = out->xx && out->xy && out->yy;
  if (whole) {
    gradients(grey, width, height, out->xx, out->xy, out->yy);
    whole = average(out->xx, width, height, deviation) &&
            average(out->xy, width, height, deviation) &&
            average(out->yy, width, height, deviation);
  }
  if (!whole) {
    fg__structure_clear(out);
    return fg__fail_memory(context, "an image's structure", 4 * count * sizeof(float));
  }
  double floor_square = least_slope * least_slope;
  for (size_t n = 0; n < count; ++n) {
    double x = (double)out->xx[n], y = (double)out->xy[n], length = hypot(x, y);
    double coherence = length / ((double)out->yy[n] + floor_square);
    double contrast = (1.0 - anisotropy) * fmin(coherence / full_coherence, 1.0);
    double cosine = length > 0.0 ? x / length : 0.0;
    double sine = length > 0.0 ? y / length : 0.0;
    out->xx[n] = (float)(1.0 - 0.5 * contrast * (1.0 + cosine));
    out->yy[n] = (float)(1.0 - 0.5 * contrast * (1.0 - cosine));
    out->xy[n] = (float)(-0.5 * contrast * sine);
  }
  return FG_STATUS_OK;
}

void fg__structure_clear(fg__structure *structure)
{
  free(structure->xx);
  free(structure->xy);
  free(structure->yy);
  *structure = (fg__structure){0};
}

/* The pixel whose centre lies below a coordinate, and the share of the next. */
static int pixel_below(double at, int count, double *share)
{
  double limited = fmin(fmax(at - 0.5, 0.0), count - 1.0);
  int index = (int)limited;
  index = index < count - 1 ? index : count - 2;
  *share = limited - index;
  return index;
}

void fg__structure_tensor(double tensor[6], const fg_energy_place *place,
                          const void *data)
{
  const fg__structure *s = data;
  double across, down;
  int i = pixel_below(place->position[0], s->width, &across);
  int j = pixel_below(s->height - place->position[1], s->height, &down);
  size_t row = (size_t)s->width, n = (size_t)j * row + (size_t)i;
  const float *plane[3] = {s->xx, s->xy, s->yy};
  for (int k = 0; k < 3; ++k) {
    const float *p = plane[k] + n;
    double upper = (1.0 - across) * (double)p[0] + across * (double)p[1];
    double lower = (1.0 - across) * (double)p[row] + across * (double)p[row + 1];
    tensor[k] = (1.0 - down) * upper + down * lower;
  }
}
