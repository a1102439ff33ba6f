#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/context_test.h"
#include "flowgrain/brush.h"

static const double PI = 3.14159265358979323846;

typedef double pattern(double x, double y);

static fg_image *image_of(fg_context *context, int width, int height, pattern *grey,
                          const float *alpha)
{
  float *sample = calloc((size_t)width * (size_t)height, sizeof *sample);
  assert_non_null(sample);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      sample[j * width + i] = (float)grey(i + 0.5, j + 0.5);
  fg_image_arrays arrays = {width, height, 1, sample, alpha};
  fg_image *image = NULL;
  assert_int_equal(fg_image_create(&image, context, &arrays), FG_STATUS_OK);
  free(sample);
  return image;
}

static fg_strokes *strokes_of(fg_context *context, const fg_image *image,
                              const fg_brush_options *options)
{
  fg_strokes *strokes = NULL;
  assert_int_equal(fg_strokes_create(&strokes, context, image, options), FG_STATUS_OK);
  assert_true(fg_strokes_count(strokes) > 0);
  return strokes;
}

/* Round (60, 20), beyond which lies a corner of the picture. */
static double circles(double x, double y)
{
  return 0.5 + 0.4 * sin(hypot(x - 60.0, y - 20.0) / 9.0);
}

static double slope(double x, double y)
{
  return (1.7 * x + 0.6 * y + 10.0) / 400.0;
}

static double turned_slope(double x, double y) /* by 90 degrees, 140 pixels high */
{
  return slope(140.0 - y, x);
}

/* Root of the mean squared sine between strokes and the direction across the gradient,
 * weighted by length: of the clusters' strokes, or of the touches of colour under them,
 * which have two points. */
static double deviation(const fg_strokes *strokes, bool touches,
                        void (*across)(const double at[2], double out[2]))
{
  double sum = 0.0, length = 0.0;
  for (int n = 0; n < fg_strokes_count(strokes); ++n) {
    const fg_stroke *s = fg_strokes_at(strokes, n);
    if ((s->point_count < 4) != touches)
      continue;
    for (int k = 1; k < s->point_count; ++k) {
      const double *a = s->points[k - 1], *b = s->points[k];
      double x = b[0] - a[0], y = b[1] - a[1], piece = hypot(x, y), e[2];
      across(a, e);
      double sine = (x * e[1] - y * e[0]) / fmax(piece * hypot(e[0], e[1]), 1e-12);
      sum += piece * sine * sine;
      length += piece;
    }
  }
  assert_true(length > 100.0);
  return sqrt(sum / length);
}

static void across_circles(const double at[2], double out[2])
{
  out[0] = at[1] - 20.0;
  out[1] = 60.0 - at[0];
}

static void across_slope(const double at[2], double out[2])
{
  (void)at;
  out[0] = 0.6;
  out[1] = -1.7;
}

static void across_turned_slope(const double at[2], double out[2])
{
  (void)at;
  out[0] = 1.7;
  out[1] = 0.6;
}

static void strokes_lie_along_level_sets(void **state)
{
  const int clusters[] = {60};
  fg_brush_options options = {.clusters = clusters, .cluster_count = 1};
  fg_image *image = image_of(*state, 140, 120, slope, NULL);
  fg_strokes *strokes = strokes_of(*state, image, &options);
  assert_true(deviation(strokes, false, across_slope) < sin(12.0 * PI / 180.0));
  /* the mean squared sine of directions that mean nothing is a half */
  assert_true(deviation(strokes, false, across_turned_slope) > 0.9);
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
  const int many[] = {150};
  options.clusters = many;
  image = image_of(*state, 140, 120, circles, NULL);
  strokes = strokes_of(*state, image, &options);
  assert_true(deviation(strokes, false, across_circles) < sin(17.0 * PI / 180.0));
  assert_true(deviation(strokes, true, across_circles) < sin(17.0 * PI / 180.0));
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
}

static void strokes_turn_with_the_image(void **state)
{
  const int clusters[] = {60};
  fg_brush_options options = {.clusters = clusters, .cluster_count = 1};
  fg_image *image = image_of(*state, 120, 140, turned_slope, NULL);
  fg_strokes *strokes = strokes_of(*state, image, &options);
  assert_true(deviation(strokes, false, across_turned_slope) < sin(12.0 * PI / 180.0));
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
}

/* Broad strokes first; the same strokes on any number of threads. */
static void layers_go_from_broad_to_fine(void **state)
{
  const int clusters[] = {150, 45, 12};
  fg_brush_options options = {.clusters = clusters, .cluster_count = 3, .threads = 1};
  fg_image *image = image_of(*state, 140, 120, circles, NULL);
  fg_strokes *strokes = strokes_of(*state, image, &options);
  options.threads = 3;
  fg_strokes *others = strokes_of(*state, image, &options);
  assert_int_equal(fg_strokes_layers(strokes), 3);
  assert_int_equal(fg_strokes_count(strokes), fg_strokes_count(others));
  double sum[3] = {0.0}, count[3] = {0.0};
  for (int n = 0; n < fg_strokes_count(strokes); ++n) {
    const fg_stroke *s = fg_strokes_at(strokes, n), *o = fg_strokes_at(others, n);
    assert_true(n == 0 || s->layer >= fg_strokes_at(strokes, n - 1)->layer);
    assert_true(s->width == o->width && s->point_count == o->point_count);
    assert_memory_equal(s->points, o->points, (size_t)s->point_count * sizeof *s->points);
    for (int k = 0; k < 3; ++k)
      assert_true(s->color[k] >= 0.0 && s->color[k] <= 1.0);
    if (s->point_count > 2) {
      sum[s->layer] += s->width;
      count[s->layer] += 1.0;
    }
  }
  assert_true(count[0] > 0.0 && count[1] > 0.0 && count[2] > 0.0);
  assert_true(sum[0] / count[0] > 1.3 * sum[1] / count[1]);
  assert_true(sum[1] / count[1] > 1.3 * sum[2] / count[2]);
  fg_strokes_destroy(strokes);
  fg_strokes_destroy(others);
  fg_image_destroy(image);
}

static void what_is_transparent_gets_no_strokes(void **state)
{
  enum { W = 140, H = 120 };
  float *alpha = calloc(W * H, sizeof *alpha);
  assert_non_null(alpha);
  for (int n = 0; n < W * H; ++n)
    alpha[n] = n % W < W / 2 ? 1.0F : 0.0F;
  const int clusters[] = {40};
  fg_brush_options options = {.clusters = clusters, .cluster_count = 1};
  fg_image *image = image_of(*state, W, H, slope, alpha);
  fg_strokes *strokes = strokes_of(*state, image, &options);
  double left = 0.0, right = 0.0;
  for (int n = 0; n < fg_strokes_count(strokes); ++n) {
    const fg_stroke *s = fg_strokes_at(strokes, n);
    for (int k = 0; k < s->point_count; ++k)
      if (s->points[k][0] > W / 2 + 10)
        right += s->width;
      else
        left += s->width;
  }
  assert_true(left > 0.0 && right < 0.02 * left);
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
  free(alpha);
}

static void refused(fg_context *context, const fg_image *image,
                    const fg_brush_options *options, const char *part_of_message)
{
  fg_strokes *strokes = NULL;
  assert_int_equal(fg_strokes_create(&strokes, context, image, options),
                   FG_STATUS_ARGUMENT);
  assert_null(strokes);
  assert_non_null(strstr(fg_context_message(context), part_of_message));
  fg_context_clear(context);
}

/* On a round piece of glass with a soft rim, whose pixels are grey where they are seen
 * and white where they are not: its strokes have its own grey to the very rim. */
static void what_lies_under_transparent_pixels_is_not_seen(void **state)
{
  enum { W = 90, H = 76 };
  const float own = 0.3F;
  float *alpha = calloc(2 * W * H, sizeof *alpha);
  assert_non_null(alpha);
  float *sample = alpha + W * H;
  for (int n = 0; n < W * H; ++n) {
    double inside = 28.0 - hypot(n % W - 48.0, n / W - 38.0); /* of the rim, in pixels */
    alpha[n] = (float)fmin(fmax(0.5 + inside / 6.0, 0.0), 1.0);
    sample[n] = alpha[n] > 0.0F ? own : 1.0F;
  }
  fg_image_arrays arrays = {W, H, 1, sample, alpha};
  fg_image *image = NULL;
  assert_int_equal(fg_image_create(&image, *state, &arrays), FG_STATUS_OK);
  fg_strokes *strokes = strokes_of(*state, image, NULL);
  for (int n = 0; n < fg_strokes_count(strokes); ++n)
    assert_true(fabs(fg_strokes_at(strokes, n)->color[0] - (double)own) < 1e-4);
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
  free(alpha);
}

static void wrong_arguments_are_refused(void **state)
{
  fg_context *context = *state;
  const int none[] = {0};
  fg_image *image = image_of(context, 20, 20, slope, NULL);
  refused(context, image, &(fg_brush_options){.anisotropy = 1.0}, "anisotropy 1 ");
  refused(context, image, &(fg_brush_options){.clusters = none, .cluster_count = 1},
          "0 clusters");
  refused(context, image, &(fg_brush_options){.clusters = none, .cluster_count = 99},
          "99 scales");
  fg_image_destroy(image);
  float sample[4] = {0.0F, 0.5F, 1.5F, 0.25F};
  fg_image_arrays arrays = {2, 2, 1, sample, NULL};
  assert_int_equal(fg_image_create(&image, context, &arrays), FG_STATUS_ARGUMENT);
  assert_null(image);
  fg_context_clear(context);
  arrays.channels = 2;
  assert_int_equal(fg_image_create(&image, context, &arrays), FG_STATUS_ARGUMENT);
  fg_context_clear(context);
  fg_context_stop(context);
  sample[2] = 1.0F;
  arrays.channels = 1;
  assert_int_equal(fg_image_create(&image, context, &arrays), FG_STATUS_OK);
  fg_strokes *strokes = NULL;
  assert_int_equal(fg_strokes_create(&strokes, context, image, NULL), FG_STATUS_STOPPED);
  fg_image_destroy(image);
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(strokes_lie_along_level_sets),
      CASE(strokes_turn_with_the_image),
      CASE(layers_go_from_broad_to_fine),
      CASE(what_is_transparent_gets_no_strokes),
      CASE(what_lies_under_transparent_pixels_is_not_seen),
      CASE(wrong_arguments_are_refused),
  };
  return cmocka_run_group_tests_name("brush/strokes", tests, NULL, NULL);
}
