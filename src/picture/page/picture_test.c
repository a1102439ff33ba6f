/* Pictures as pixels. */
#include <cairo.h>

#include "picture/page/picture_example.h"

/* The pixel whose middle is nearest to a place in the field's coordinates, in a picture
 * without a frame: alpha, red, green, blue. */
static void pixel_at(unsigned char out[4], const example *e, const char *name,
                     double pixels_per_unit, double x, double y)
{
  char path[160];
  path_in(path, e, name);
  cairo_surface_t *image = cairo_image_surface_create_from_png(path);
  assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
  assert_int_equal(cairo_image_surface_get_width(image), lround(30.0 * pixels_per_unit));
  assert_int_equal(cairo_image_surface_get_height(image), lround(20.0 * pixels_per_unit));
  int column = (int)((x - 10.0) * pixels_per_unit);
  int row = (int)((15.0 - y) * pixels_per_unit);
  uint32_t pixel;
  memcpy(&pixel,
         cairo_image_surface_get_data(image) +
             row * cairo_image_surface_get_stride(image) + 4 * column,
         sizeof pixel);
  bool opaque = cairo_image_surface_get_format(image) == CAIRO_FORMAT_RGB24;
  out[0] = opaque ? 255 : (unsigned char)(pixel >> 24);
  for (int k = 1; k < 4; ++k)
    out[k] = (unsigned char)(pixel >> (24 - 8 * k) & 255);
  cairo_surface_destroy(image);
}

static void expect_pixel(const example *e, const char *name, double pixels_per_unit,
                         double x, double y, const unsigned char expected[4])
{
  unsigned char found[4];
  pixel_at(found, e, name, pixels_per_unit, x, y);
  for (int k = 0; k < 4; ++k)
    assert_true(abs(found[k] - expected[k]) <= 2);
}

static const unsigned char white[4] = {255, 255, 255, 255};
static const unsigned char nothing[4] = {0, 0, 0, 0};
static const unsigned char ink[4] = {255, 0x20, 0x40, 0xc0};

static void a_png_shows_arrows_mask_and_tint(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.width = 300.0,
                                .pixels_per_point = 3.0,
                                .no_frame = true,
                                .palette = "#2040c0",
                                .mask_color = "#909090",
                                .tint_color = "#ddeeff",
                                .tint = true};
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 30.0, 16.0, 0.0, ink);
  expect_pixel(e, "a.png", 30.0, 22.0, 1.0, ink);
  expect_pixel(e, "a.png", 30.0, 12.5, 12.5, white);
  expect_pixel(e, "a.png", 30.0, 32.0, 10.0, (unsigned char[]){255, 0x90, 0x90, 0x90});
  expect_pixel(e, "a.png", 30.0, 15.0, 2.0, (unsigned char[]){255, 0xdd, 0xee, 0xff});
  expect_pixel(e, "a.png", 30.0, 15.0, 3.2, white);
}

static void skeletons_are_shown_when_asked_for(void **state)
{
  const example *e = *state;
  fg_picture_options options = {
      .width = 300.0, .pixels_per_point = 3.0, .no_frame = true, .skeletons = true};
  write_picture(e, "a.png", &options);
  unsigned char begin[4], center[4];
  pixel_at(begin, e, "a.png", 30.0, 13.0, 2.0);
  assert_true(begin[1] < 0x60 && begin[2] < 0x60 && begin[3] < 0x60);
  expect_pixel(e, "a.png", 30.0, 13.0, -2.0, white);
  pixel_at(center, e, "a.png", 30.0, 13.0 + 0.26, -2.0); /* on its ring */
  assert_true(center[1] < 0xa0);
  options.skeletons = false;
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 30.0, 13.0, 2.0, white);
  expect_pixel(e, "a.png", 30.0, 13.0 + 0.26, -2.0, white);
  options.centers = true;
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 30.0, 13.0, 2.0, white);
  pixel_at(center, e, "a.png", 30.0, 13.0 + 0.26, -2.0);
  assert_true(center[1] < 0xa0);
}

static void arrows_and_their_keys_can_be_left_out(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.width = 300.0,
                                .pixels_per_point = 3.0,
                                .no_frame = true,
                                .palette = "#2040c0",
                                .tint_color = "#ddeeff",
                                .tint = true,
                                .no_arrows = true};
  const unsigned char tint[4] = {255, 0xdd, 0xee, 0xff};
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 30.0, 16.0, 0.0, tint);
  expect_pixel(e, "a.png", 30.0, 15.0, 2.0, tint);
  int with[2], without[2], keyless[2];
  options = (fg_picture_options){.width = 300.0, .height = 240.0};
  assert_int_equal(fg_picture_frame(with, e->context, e->field, e->icons, &options), 0);
  options.no_arrows = true;
  assert_int_equal(fg_picture_frame(without, e->context, e->field, e->icons, &options),
                   0);
  options = (fg_picture_options){.width = 300.0, .height = 240.0, .no_keys = true};
  assert_int_equal(fg_picture_frame(keyless, e->context, e->field, e->icons, &options),
                   0);
  assert_true(without[0] > with[0] || without[1] > with[1]);
  assert_memory_equal(without, keyless, sizeof without);
}

static void a_transparent_png_has_no_background(void **state)
{
  const example *e = *state;
  fg_picture_options options = {
      .width = 150.0, .no_frame = true, .transparent = true, .palette = "#2040c0"};
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 10.0, 16.0, 0.0, ink);
  expect_pixel(e, "a.png", 10.0, 12.5, 12.5, nothing);
  options.no_frame = false;
  write_picture(e, "b.png", &options);
}

static void an_arrow_across_a_periodic_boundary_shows_on_both_sides(void **state)
{
  example *e = *state;
  fg_field_destroy(e->field);
  make_field(e, true);
  add_arrow(e, 37.0, 12.5, 8.0, 0.0, 4.0); /* to x = 45, shown at 15 */
  fg_picture_options options = {.width = 300.0, .no_frame = true, .palette = "#2040c0"};
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 20.0, 39.9, 12.5, ink);
  expect_pixel(e, "a.png", 20.0, 10.1, 12.5, ink);
  expect_pixel(e, "a.png", 20.0, 14.0, 12.5, ink);
  expect_pixel(e, "a.png", 20.0, 16.0, 12.5, white);
}

static void odd_icons_are_drawn_without_trouble(void **state)
{
  example *e = *state;
  fg_icons_destroy(e->icons);
  assert_int_equal(fg__icons_create_empty(&e->icons, e->context), FG_STATUS_OK);
  write_picture(e, "none.png", NULL);
  add_arrow(e, 20.0, 3.0, 4.0, 1.0, 3.0);
  write_picture(e, "one.svg", NULL);
  add_arrow(e, 22.0, 5.0, 4.0, 1.0, 0.0);
  add_arrow(e, 900.0, 5.0, 4.0, 1.0, 2.0); /* outside the domain */
  fg_picture_options options = {.title = ""};
  write_picture(e, "three.pdf", &options);
}

/* Missing samples that lines go over are not shown as missing; the hole is. */
static void scattered_gaps_are_no_hole(void **state)
{
  static float u[NX * NY];
  example *e = *state;
  fg_field_arrays arrays = *fg_field_contents(e->field);
  int gap = 0;
  for (int n = 0; n < NX * NY; ++n) {
    const bool missing = (uint32_t)((uint32_t)n * UINT32_C(2654435761)) >> 29 == 0;
    u[n] = missing ? NAN : arrays.velocity[0][n];
    if (missing && n % NX > 10 && n % NX < 20 && n / NX > 10 && n / NX < 30)
      gap = n;
  }
  assert_true(gap > 0);
  const double x = arrays.axis[0][gap % NX], y = arrays.axis[1][gap / NX];
  const fg_picture_options options = {.width = 300.0,
                                      .pixels_per_point = 3.0,
                                      .no_frame = true,
                                      .no_arrows = true,
                                      .mask_color = "#909090"};
  fg_field *whole = e->field;
  arrays.velocity[0] = u;
  assert_int_equal(fg_field_create(&e->field, e->context, &arrays), FG_STATUS_OK);
  fg_field_destroy(whole);
  write_picture(e, "a.png", &options);
  expect_pixel(e, "a.png", 30.0, x, y, white);
  expect_pixel(e, "a.png", 30.0, 32.0, 10.0, (unsigned char[]){255, 0x90, 0x90, 0x90});
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, example_set_up, example_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(a_png_shows_arrows_mask_and_tint),
      TEST(skeletons_are_shown_when_asked_for),
      TEST(arrows_and_their_keys_can_be_left_out),
      TEST(a_transparent_png_has_no_background),
      TEST(an_arrow_across_a_periodic_boundary_shows_on_both_sides),
      TEST(odd_icons_are_drawn_without_trouble),
      TEST(scattered_gaps_are_no_hole),
  };
  return cmocka_run_group_tests_name("picture/page/picture", tests, NULL, NULL);
}
