#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "file/folder_test.h"
#include "flowgrain/brush.h"

enum { WIDTH = 90, HEIGHT = 70 };

/* A red and a blue half with a soft boundary, and shades across. */
static fg_image *two_halves(fg_context *context)
{
  static float sample[WIDTH * HEIGHT * 3];
  for (int j = 0; j < HEIGHT; ++j)
    for (int i = 0; i < WIDTH; ++i) {
      float *s = sample + 3 * (j * WIDTH + i);
      float share = (float)(0.5 + 0.5 * tanh((i - 38.0) / 4.0));
      s[0] = 0.85F - 0.7F * share;
      s[1] = 0.2F + 0.3F * (float)j / HEIGHT;
      s[2] = 0.1F + 0.8F * share;
    }
  fg_image_arrays arrays = {WIDTH, HEIGHT, 3, sample, NULL};
  fg_image *image = NULL;
  assert_int_equal(fg_image_create(&image, context, &arrays), FG_STATUS_OK);
  return image;
}

/* Mean of the columns from `first` to `last`, as shares of the width. */
static void mean_color(double mean[3], const fg_image *image, double first, double last)
{
  const fg_image_arrays *a = fg_image_contents(image);
  assert_int_equal(a->channels, 3);
  double count = 0.0;
  mean[0] = mean[1] = mean[2] = 0.0;
  for (int j = 0; j < a->height; ++j)
    for (int i = (int)(first * a->width); i < (int)(last * a->width); ++i) {
      count += 1.0;
      for (int k = 0; k < 3; ++k)
        mean[k] += (double)a->sample[3 * (j * a->width + i) + k];
    }
  for (int k = 0; k < 3; ++k)
    mean[k] /= count;
}

static void a_painting_has_the_images_colours(void **state)
{
  folder *f = *state;
  fg_image *image = two_halves(f->context), *painted = NULL;
  fg_strokes *strokes = NULL;
  snprintf(f->path, sizeof f->path, "%s/painting.png", f->name);
  assert_int_equal(fg_strokes_create(&strokes, f->context, image, NULL), FG_STATUS_OK);
  assert_int_equal(fg_painting_write(f->context, f->path, image, strokes, NULL),
                   FG_STATUS_OK);
  assert_int_equal(fg_image_read(&painted, f->context, f->path), FG_STATUS_OK);
  const fg_image_arrays *a = fg_image_contents(painted);
  assert_int_equal(a->width, 2 * WIDTH);
  assert_int_equal(a->height, 2 * HEIGHT);
  const double part[][2] = {{0.0, 1.0}, {0.0, 0.3}, {0.6, 1.0}};
  for (size_t n = 0; n < sizeof part / sizeof *part; ++n) {
    double wanted[3], got[3];
    mean_color(wanted, image, part[n][0], part[n][1]);
    mean_color(got, painted, part[n][0], part[n][1]);
    for (int k = 0; k < 3; ++k)
      assert_true(fabs(got[k] - wanted[k]) < 0.02);
  }
  fg_image_destroy(painted);
  /* nowhere bare: the same without a ground is opaque */
  fg_painting_options options = {.transparent = true};
  assert_int_equal(fg_painting_write(f->context, f->path, image, strokes, &options),
                   FG_STATUS_OK);
  assert_int_equal(fg_image_read(&painted, f->context, f->path), FG_STATUS_OK);
  a = fg_image_contents(painted);
  long bare = 0, pixels = (long)a->width * a->height;
  for (long n = 0; n < pixels && a->alpha; ++n)
    bare += a->alpha[n] < 0.5F;
  assert_true(bare <= pixels / 500);
  fg_image_destroy(painted);
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
}

static void what_can_not_be_painted_is_refused(void **state)
{
  folder *f = *state;
  fg_image *image = two_halves(f->context);
  fg_strokes *strokes = NULL;
  const int clusters[] = {12};
  fg_brush_options few = {.clusters = clusters, .cluster_count = 1};
  assert_int_equal(fg_strokes_create(&strokes, f->context, image, &few), FG_STATUS_OK);
  assert_int_equal(fg_painting_write(f->context, "painting.gif", image, strokes, NULL),
                   FG_STATUS_UNSUPPORTED);
  fg_context_clear(f->context);
  snprintf(f->path, sizeof f->path, "%s/painting.png", f->name);
  fg_painting_options options = {.width = 19000.0, .pixels_per_point = 9.0};
  assert_int_equal(fg_painting_write(f->context, f->path, image, strokes, &options),
                   FG_STATUS_ARGUMENT);
  f->path[0] = '\0';
  fg_strokes_destroy(strokes);
  fg_image_destroy(image);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, folder_set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_painting_has_the_images_colours),
      CASE(what_can_not_be_painted_is_refused),
  };
  return cmocka_run_group_tests_name("picture/page/painting", tests, NULL, NULL);
}
