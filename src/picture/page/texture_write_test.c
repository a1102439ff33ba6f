#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/context_test.h"
#include "icon/icons.h"
#include "picture/page/texture_image.h"

/* A uniform stream on [0, 4] x [0, 2] that is missing in x > 2, where the speed grows
 * along y: 80 x 40 pixels. */
enum { NX = 41, NY = 21 };

typedef struct example {
  fg_context *context;
  fg_field *field;
  fg_texture *texture;
  char path[64];
} example;

static int set_up(void **state)
{
  static double x[NX], y[NY];
  static float u[NX * NY], v[NX * NY];
  example *e = calloc(1, sizeof *e);
  assert_non_null(e);
  for (int i = 0; i < NX; ++i)
    x[i] = 0.1 * i;
  for (int j = 0; j < NY; ++j)
    y[j] = 0.1 * j;
  for (int n = 0; n < NX * NY; ++n) {
    u[n] = n % NX > NX / 2 ? NAN : (float)(1.0 + y[n / NX]);
    v[n] = 0.0F;
  }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {NX, NY, 0},
                                  .axis = {x, y, NULL},
                                  .velocity = {u, v, NULL}};
  const fg_texture_options options = {.longest = 80, .threads = 1};
  assert_int_equal(fg_context_create(&e->context), FG_STATUS_OK);
  assert_int_equal(fg_field_create(&e->field, e->context, &arrays), FG_STATUS_OK);
  assert_int_equal(fg_texture_create(&e->texture, e->context, e->field, &options),
                   FG_STATUS_OK);
  snprintf(e->path, sizeof e->path, "/tmp/flowgrain-texture-%d.png", (int)getpid());
  *state = e;
  return 0;
}

static int tear_down(void **state)
{
  example *e = *state;
  unlink(e->path);
  fg_texture_destroy(e->texture);
  fg_field_destroy(e->field);
  fg_context_destroy(e->context);
  free(e);
  return 0;
}

typedef struct rgba {
  double red, green, blue, alpha;
} rgba;

static cairo_surface_t *written(example *e, const fg_texture_style *style)
{
  if (fg_texture_write(e->context, e->path, e->field, e->texture, style))
    fail_msg("%s", fg_context_message(e->context));
  cairo_surface_t *image = cairo_image_surface_create_from_png(e->path);
  assert_int_equal(cairo_image_surface_get_width(image), 80);
  assert_int_equal(cairo_image_surface_get_height(image), 40);
  return image;
}

static rgba pixel_at(cairo_surface_t *image, int x, int y)
{
  const unsigned char *row =
      cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image);
  const uint32_t pixel = ((const uint32_t *)(const void *)row)[x];
  const bool opaque = cairo_image_surface_get_format(image) == CAIRO_FORMAT_RGB24;
  return (rgba){(pixel >> 16 & 255) / 255.0, (pixel >> 8 & 255) / 255.0,
                (pixel & 255) / 255.0, opaque ? 1.0 : (pixel >> 24) / 255.0};
}

/* The mask's boundary is at the middle, rounded within a cell of two pixels. */
static void test_pixels_are_the_textures(void **state)
{
  example *e = *state;
  cairo_surface_t *image = written(e, NULL);
  const fg_texture_arrays *t = fg_texture_contents(e->texture);
  double least = 1.0, most = 0.0;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 37; ++i) {
      const rgba p = pixel_at(image, i, 39 - j);
      const double value = (double)t->value[j * 80 + i];
      assert_true(p.red == p.green && p.green == p.blue && p.alpha == 1.0);
      /* greys in the order of the values, from nearly black to white */
      assert_true(fabs(p.red - (0.08 + 0.92 * value)) < 0.003);
      least = fmin(least, p.red);
      most = fmax(most, p.red);
    }
  assert_true(least < 0.1 && most > 0.98);
  cairo_surface_destroy(image);
}

static cairo_surface_t *written_large(example *e, const fg_texture *texture,
                                      const fg_texture_style *style)
{
  if (fg_texture_write(e->context, e->path, e->field, texture, style))
    fail_msg("%s", fg_context_message(e->context));
  cairo_surface_t *image = cairo_image_surface_create_from_png(e->path);
  assert_int_equal(cairo_image_surface_get_width(image), 400);
  return image;
}

/* A title lies above, in a picture of a wanted width: the texture's pixels stay. */
static void test_a_title_comes_above(void **state)
{
  example *e = *state;
  const fg_texture_options options = {.longest = 400, .threads = 1};
  fg_texture *texture = NULL;
  assert_int_equal(fg_texture_create(&texture, e->context, e->field, &options),
                   FG_STATUS_OK);
  const fg_texture_style plain = {.palette = "gale"},
                         titled = {.palette = "gale", .title = "Shear", .width = 200.0},
                         small = {.palette = "gale",
                                  .title = "Shear",
                                  .width = 200.0,
                                  .font_size = 5.0},
                         narrow = {.width = 10.0};
  cairo_surface_t *without = written_large(e, texture, &plain);
  cairo_surface_t *with = written_large(e, texture, &titled);
  cairo_surface_t *smaller = written_large(e, texture, &small);
  const int height = cairo_image_surface_get_height(with), above = height - 200;
  assert_true(above > 15 && above < 60);
  assert_true(cairo_image_surface_get_height(smaller) < height);
  double darkest = 1.0;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < 400; ++i) {
      const rgba b = pixel_at(with, i, j);
      if (j < above) {
        darkest = fmin(darkest, b.green);
        continue;
      }
      const rgba a = pixel_at(without, i, j - above);
      assert_true(a.red == b.red && a.green == b.green && a.blue == b.blue);
    }
  assert_true(darkest < 0.5);
  assert_int_equal(fg_texture_write(e->context, e->path, e->field, texture, &narrow),
                   FG_STATUS_ARGUMENT);
  cairo_surface_destroy(without);
  cairo_surface_destroy(with);
  cairo_surface_destroy(smaller);
  fg_texture_destroy(texture);
}

/* The key lies below: what is above stays to the pixel. Its bar runs from the colours of
 * slow to those of fast places. */
static void test_a_key_comes_below(void **state)
{
  example *e = *state;
  const fg_texture_options options = {.longest = 400, .threads = 1};
  fg_texture *texture = NULL;
  assert_int_equal(fg_texture_create(&texture, e->context, e->field, &options),
                   FG_STATUS_OK);
  const fg_texture_style plain = {.palette = "gale"},
                         keyed = {.palette = "gale", .key = true}, grey = {.key = true};
  cairo_surface_t *without = written_large(e, texture, &plain);
  cairo_surface_t *with = written_large(e, texture, &keyed);
  cairo_surface_t *none = written_large(e, texture, &grey);
  assert_int_equal(cairo_image_surface_get_height(without), 200);
  assert_int_equal(cairo_image_surface_get_height(none), 200); /* nothing to explain */
  const int height = cairo_image_surface_get_height(with);
  assert_true(height > 230 && height < 320);
  for (int j = 0; j < 200; ++j)
    for (int i = 0; i < 400; ++i) {
      const rgba a = pixel_at(without, i, j), b = pixel_at(with, i, j);
      assert_true(a.red == b.red && a.green == b.green && a.blue == b.blue);
    }
  int bar = 200; /* its first row below the texture */
  while (bar < height && pixel_at(with, 200, bar).green > 0.9)
    ++bar;
  bar += 6;
  assert_true(bar < height);
  const rgba slow = pixel_at(with, 60, bar), fast = pixel_at(with, 340, bar);
  assert_true(slow.green > fast.green + 0.2); /* gale: from a light blue to a dark red */
  cairo_surface_destroy(without);
  cairo_surface_destroy(with);
  cairo_surface_destroy(none);
  fg_texture_destroy(texture);
}

/* Under what covers them. */
static void test_missing_pixels_are_like_their_neighbours(void **state)
{
  example *e = *state;
  const fg_texture_style style = {.palette = "gale"};
  const fg_texture_arrays *t = fg_texture_contents(e->texture);
  cairo_surface_t *image;
  assert_int_equal(fg__texture_image(&image, e->context, t, &style), FG_STATUS_OK);
  for (int j = 0; j < 40; ++j) {
    int last = 0;
    while (last < 79 && !isnan(t->speed[j * 80 + last + 1]))
      ++last;
    assert_true(last > 30 && last < 50);
    const rgba known = pixel_at(image, last, 39 - j), far = pixel_at(image, 79, 39 - j);
    assert_true(known.red == far.red && known.green == far.green);
  }
  cairo_surface_destroy(image);
}

/* Bands of a third each, whose edges are mixed from the two. */
static void test_speeds_are_shown_in_bands(void **state)
{
  enum { BANDS = 3 };
  example *e = *state;
  const double range[2] = {1.0, 3.0};
  fg__palette palette;
  fg_texture *speeds;
  cairo_surface_t *image;
  assert_int_equal(
      fg_texture_create(&speeds, e->context, e->field,
                        &(fg_texture_options){.kind = FG_TEXTURE_SPEED, .longest = 80}),
      FG_STATUS_OK);
  assert_int_equal(fg__palette_create(&palette, e->context, "#2f6ea8"), FG_STATUS_OK);
  fg__palette_make_pale(&palette, 0.25, BANDS);
  const fg_texture_arrays *t = fg_texture_contents(speeds);
  assert_int_equal(fg__texture_image_speeds(&image, e->context, t, &palette, range),
                   FG_STATUS_OK);
  int mixed = 0;
  double last = 2.0;
  for (int j = 0; j < 40; ++j) {
    const double share = ((double)t->speed[j * 80 + 10] - 1.0) / 2.0 * BANDS;
    const fg__color band = fg__palette_color(&palette, share / BANDS);
    const double red = pixel_at(image, 10, 39 - j).red;
    const bool at_edge = fabs(share - floor(share + 0.5)) < 0.04;
    assert_true(red <= last); /* the faster, the darker */
    assert_true(at_edge || fabs(red - band.red) < 0.01);
    mixed += at_edge;
    last = red;
  }
  assert_true(mixed > 0 && mixed < 8);
  assert_true(pixel_at(image, 10, 39).red == 1.0);
  const double darkest = 0.25 + 0.75 * 0x2f / 255.0;
  assert_true(fabs(pixel_at(image, 10, 0).red - darkest) < 0.01);
  cairo_surface_destroy(image);
  fg_texture_destroy(speeds);
}

static void test_missing_is_covered(void **state)
{
  example *e = *state;
  const fg_texture_style marked = {.mask_color = "#ff0000"},
                         clear = {.transparent = true};
  cairo_surface_t *red = written(e, &marked), *hole = written(e, &clear);
  for (int j = 2; j < 38; ++j) {
    for (int i = 43; i < 78; ++i) {
      const rgba p = pixel_at(red, i, j);
      assert_true(p.red == 1.0 && p.green == 0.0 && p.blue == 0.0);
      assert_true(pixel_at(hole, i, j).alpha == 0.0);
    }
    for (int i = 0; i < 37; ++i)
      assert_true(pixel_at(hole, i, j).alpha == 1.0);
  }
  cairo_surface_destroy(red);
  cairo_surface_destroy(hole);
}

static double mean_lightness(cairo_surface_t *image, int first, int last)
{
  double sum = 0.0;
  for (int j = first; j < last; ++j)
    for (int i = 0; i < 37; ++i) {
      const rgba p = pixel_at(image, i, j);
      sum += (p.red + p.green + p.blue) / 3.0;
    }
  return sum / (last - first) / 37.0;
}

/* In the map "grey" fast places are darker; they are above, in the first rows. */
static void test_palette_shows_speed(void **state)
{
  example *e = *state;
  const fg_texture_style style = {.palette = "grey"};
  cairo_surface_t *image = written(e, &style);
  assert_true(mean_lightness(image, 0, 12) < mean_lightness(image, 28, 40) - 0.03);
  cairo_surface_destroy(image);
}

static void test_fading_leads_to_white(void **state)
{
  example *e = *state;
  const fg_texture_style half = {.fade = 0.5}, full = {.fade = 1.0};
  cairo_surface_t *plain = written(e, NULL), *pale = written(e, &half),
                  *white = written(e, &full);
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 37; ++i) {
      const double before = pixel_at(plain, i, j).red;
      assert_true(fabs(pixel_at(pale, i, j).red - 0.5 - 0.5 * before) < 0.006);
      assert_true(pixel_at(white, i, j).red == 1.0);
    }
  cairo_surface_destroy(plain);
  cairo_surface_destroy(pale);
  cairo_surface_destroy(white);
}

/* Icons of none, no frame: the picture is the background, at its own pixels, faded, and
 * the mask. */
static void test_background_fills_the_frame(void **state)
{
  example *e = *state;
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, e->context), FG_STATUS_OK);
  fg_picture_options options = {.width = 40.0, .no_frame = true, .background_fade = 0.25};
  int size[2];
  assert_int_equal(fg_picture_frame(size, e->context, e->field, icons, &options),
                   FG_STATUS_OK);
  assert_int_equal(size[0], 80);
  assert_int_equal(size[1], 40);
  options.background = e->texture;
  if (fg_picture_write(e->context, e->path, e->field, NULL, icons, &options))
    fail_msg("%s", fg_context_message(e->context));
  cairo_surface_t *image = cairo_image_surface_create_from_png(e->path);
  const fg_texture_arrays *t = fg_texture_contents(e->texture);
  for (int j = 2; j < 38; ++j) {
    for (int i = 2; i < 37; ++i) {
      const double grey = 0.08 + 0.92 * (double)t->value[j * 80 + i];
      const double shown = pixel_at(image, i, 39 - j).red;
      assert_true(fabs(shown - 0.25 - 0.75 * grey) < 0.006);
    }
    assert_true(fabs(pixel_at(image, 60, j).red - 0.855) < 0.003);
  }
  cairo_surface_destroy(image);
  options.background_fade = 1.5;
  assert_int_equal(fg_picture_write(e->context, e->path, e->field, NULL, icons, &options),
                   FG_STATUS_ARGUMENT);
  fg_icons_destroy(icons);
}

/* Grey places of a picture with the usual fade: land, and the darkest of the sea. */
static void find_tones(example *e, const fg_texture *background, double *land,
                       double *darkest)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, e->context), FG_STATUS_OK);
  const fg_picture_options options = {
      .width = 40.0, .no_frame = true, .background = background};
  if (fg_picture_write(e->context, e->path, e->field, NULL, icons, &options))
    fail_msg("%s", fg_context_message(e->context));
  cairo_surface_t *image = cairo_image_surface_create_from_png(e->path);
  *land = pixel_at(image, 60, 20).red;
  *darkest = 1.0;
  for (int j = 2; j < 38; ++j)
    for (int i = 2; i < 37; ++i)
      *darkest = fmin(*darkest, pixel_at(image, i, j).red);
  cairo_surface_destroy(image);
  fg_icons_destroy(icons);
}

static void test_stripes_are_not_darker_than_land(void **state)
{
  example *e = *state;
  double land, darkest, of_lic;
  fg_texture *stripes;
  const fg_texture_options options = {
      .kind = FG_TEXTURE_STRIPES, .size = {80, 40}, .length = 20.0, .threads = 1};
  assert_int_equal(fg_texture_create(&stripes, e->context, e->field, &options),
                   FG_STATUS_OK);
  find_tones(e, stripes, &land, &darkest);
  assert_true(darkest > land - 0.01);
  assert_true(darkest < land + 0.05);
  find_tones(e, e->texture, &land, &of_lic);
  assert_true(of_lic < land - 0.05); /* a few of its pixels are */
  fg_texture_destroy(stripes);
}

static void test_refusals(void **state)
{
  static const fg_texture_style wrong[] = {
      {.palette = "nosuch"}, {.fade = -0.1},     {.fade = (double)NAN},
      {.mask_color = "red"}, {.speed_min = 2.0}, {.speed_max = (double)INFINITY},
  };
  example *e = *state;
  for (size_t n = 0; n < sizeof wrong / sizeof *wrong; ++n) {
    assert_int_equal(
        fg_texture_write(e->context, e->path, e->field, e->texture, &wrong[n]),
        FG_STATUS_ARGUMENT);
    fg_context_clear(e->context);
  }
  assert_int_equal(
      fg_texture_write(e->context, "/tmp/texture.gif", e->field, e->texture, NULL),
      FG_STATUS_UNSUPPORTED);
  fg_context_clear(e->context);
  assert_int_equal(
      fg_texture_write(e->context, "/no/such/place.png", e->field, e->texture, NULL),
      FG_STATUS_FILE_ACCESS);
  assert_int_equal(access(e->path, F_OK), -1);
}

/* What a process has drawn before does not show in a file, as it would in a resumed run.
 */
static void test_a_second_file_is_the_same(void **state)
{
  example *e = *state;
  static unsigned char bytes[2][1 << 18];
  size_t length[2];
  char path[64];
  snprintf(path, sizeof path, "/tmp/flowgrain-texture-%d.svg", (int)getpid());
  for (int n = 0; n < 2; ++n) {
    cairo_surface_destroy(cairo_image_surface_create(CAIRO_FORMAT_A8, 3, 3));
    assert_int_equal(fg_texture_write(e->context, path, e->field, e->texture, NULL),
                     FG_STATUS_OK);
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    length[n] = fread(bytes[n], 1, sizeof bytes[n], stream);
    fclose(stream);
  }
  unlink(path);
  assert_true(length[0] > 100 && length[0] < sizeof bytes[0]);
  assert_int_equal(length[0], length[1]);
  assert_memory_equal(bytes[0], bytes[1], length[0]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_pixels_are_the_textures, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_a_title_comes_above, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_a_key_comes_below, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_missing_is_covered, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_missing_pixels_are_like_their_neighbours,
                                      set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_palette_shows_speed, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_speeds_are_shown_in_bands, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_fading_leads_to_white, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_background_fills_the_frame, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_stripes_are_not_darker_than_land, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_a_second_file_is_the_same, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_refusals, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
