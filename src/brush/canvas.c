#include "brush/canvas.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static fg_status allocate(fg__brush_canvas *out, fg_context *context,
                          const fg_image_arrays *image)
{
  size_t count = (size_t)image->width * (size_t)image->height;
  *out = (fg__brush_canvas){.width = image->width, .height = image->height};
  for (int k = 0; k < 3; ++k)
    out->plane[k] = fg__allocate(count, sizeof *out->plane[k]);
  if (out->plane[0] && out->plane[1] && out->plane[2])
    return FG_STATUS_OK;
  fg__canvas_clear(out);
  return fg__fail_memory(context, "a canvas", 3 * count * sizeof(float));
}

static float sample_of(const fg_image_arrays *image, size_t n, int k)
{
  return image->channels == 3 ? image->sample[3 * n + (size_t)k] : image->sample[n];
}

/* Where nothing is seen within reach of the average, no colour is known. */
static void divide_by_alpha(fg__brush_canvas *out, const float *alpha,
                            const double other[3])
{
  size_t count = (size_t)out->width * (size_t)out->height;
  for (size_t n = 0; n < count; ++n)
    for (int k = 0; k < 3; ++k)
      out->plane[k][n] =
          alpha[n] > FLT_EPSILON ? out->plane[k][n] / alpha[n] : (float)other[k];
}

/* Colours count as much as they are seen: what lies under transparent pixels does not. */
static bool average(fg__brush_canvas *out, const fg_image_arrays *image, float *alpha,
                    double deviation)
{
  size_t count = (size_t)out->width * (size_t)out->height;
  for (int k = 0; k < 3; ++k) {
    for (size_t n = 0; n < count; ++n)
      out->plane[k][n] = (alpha ? alpha[n] : 1.0F) * sample_of(image, n, k);
    if (!fg__image_blur(out->plane[k], out->width, out->height, deviation))
      return false;
  }
  if (!alpha)
    return true;
  double mean[3];
  fg__image_mean(mean, image);
  if (!fg__image_blur(alpha, out->width, out->height, deviation))
    return false;
  divide_by_alpha(out, alpha, mean);
  return true;
}

fg_status fg__canvas_of_image(fg__brush_canvas *out, fg_context *context,
                              const fg_image_arrays *image, double deviation)
{
  fg_status status = allocate(out, context, image);
  if (status)
    return status;
  size_t count = (size_t)image->width * (size_t)image->height;
  float *alpha = NULL;
  if (image->alpha) {
    alpha = fg__allocate(count, sizeof *alpha);
    if (alpha)
      memcpy(alpha, image->alpha, count * sizeof *alpha);
  }
  if ((image->alpha && !alpha) || !average(out, image, alpha, deviation)) {
    fg__canvas_clear(out);
    status = fg__fail_memory(context, "a canvas", count * sizeof(float));
  }
  free(alpha);
  return status;
}

void fg__image_mean(double color[3], const fg_image_arrays *image)
{
  size_t count = (size_t)image->width * (size_t)image->height;
  double seen = 0.0;
  color[0] = color[1] = color[2] = 0.0;
  for (size_t n = 0; n < count; ++n) {
    double alpha = image->alpha ? (double)image->alpha[n] : 1.0;
    seen += alpha;
    for (int k = 0; k < 3; ++k)
      color[k] += alpha * (double)sample_of(image, n, k);
  }
  for (int k = 0; k < 3; ++k)
    color[k] = seen > 0.0 ? color[k] / seen : 1.0;
}

fg_status fg__canvas_blank(fg__brush_canvas *out, fg_context *context,
                           const fg_image_arrays *image)
{
  fg_status status = allocate(out, context, image);
  double mean[3];
  size_t count = (size_t)image->width * (size_t)image->height;
  fg__image_mean(mean, image);
  for (int k = 0; k < 3 && !status; ++k)
    for (size_t n = 0; n < count; ++n)
      out->plane[k][n] = (float)mean[k];
  if (!status) {
    out->painted = fg__allocate(count, 1);
    if (!out->painted) {
      fg__canvas_clear(out);
      return fg__fail_memory(context, "a canvas", count);
    }
  }
  return status;
}

void fg__canvas_clear(fg__brush_canvas *canvas)
{
  for (int k = 0; k < 3; ++k)
    free(canvas->plane[k]);
  free(canvas->painted);
  *canvas = (fg__brush_canvas){0};
}

void fg__canvas_color(double color[3], const fg__brush_canvas *canvas, const double at[2])
{
  double x = fmin(fmax(at[0] - 0.5, 0.0), canvas->width - 1.0);
  double y = fmin(fmax(at[1] - 0.5, 0.0), canvas->height - 1.0);
  int i = (int)x < canvas->width - 1 ? (int)x : canvas->width - 2;
  int j = (int)y < canvas->height - 1 ? (int)y : canvas->height - 2;
  double s = x - i, t = y - j;
  size_t row = (size_t)canvas->width, n = (size_t)j * row + (size_t)i;
  for (int k = 0; k < 3; ++k) {
    const float *p = canvas->plane[k] + n;
    double upper = (1.0 - s) * (double)p[0] + s * (double)p[1];
    double lower = (1.0 - s) * (double)p[row] + s * (double)p[row + 1];
    color[k] = (1.0 - t) * upper + t * lower;
  }
}

static int limited(double value, int count)
{
  return (int)fmin(fmax(value, 0.0), (double)count);
}

void fg__canvas_dab(fg__brush_canvas *canvas, const double at[2], double radius,
                    const double color[3])
{
  int left = limited(floor(at[0] - radius), canvas->width);
  int right = limited(ceil(at[0] + radius), canvas->width);
  int top = limited(floor(at[1] - radius), canvas->height);
  int bottom = limited(ceil(at[1] + radius), canvas->height);
  for (int j = top; j < bottom; ++j)
    for (int i = left; i < right; ++i) {
      double x = i + 0.5 - at[0], y = j + 0.5 - at[1];
      size_t n = (size_t)j * (size_t)canvas->width + (size_t)i;
      if (x * x + y * y > radius * radius)
        continue;
      canvas->painted[n] = 1;
      for (int k = 0; k < 3; ++k)
        canvas->plane[k][n] = (float)color[k];
    }
}

bool fg__canvas_is_bare(const fg__brush_canvas *canvas, const double at[2])
{
  if (!(at[0] >= 0.0 && at[0] < canvas->width && at[1] >= 0.0 && at[1] < canvas->height))
    return false;
  return !canvas->painted[(size_t)at[1] * (size_t)canvas->width + (size_t)at[0]];
}
