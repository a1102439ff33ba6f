#include <cairo.h>
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_test.h"
#include "icon/icons.h"
#include "picture/palette.h"

/* A field on [10, 40] x [-5, 15] with a hole, three arrows, and a density: with no frame
 * a picture of 300 points has 10 points a unit. */
typedef struct example {
  fg_context *context;
  fg_field *field;
  fg_icons *icons;
  fg_density *density;
  char folder[64];
} example;

enum { NX = 61, NY = 41 };

static const double speeds[] = {2.0, 5.5, 11.0};

static void add_arrow(example *e, double x, double y, double dx, double dy, double speed)
{
  double points[5][3] = {{0}};
  for (int n = 0; n < 5; ++n) {
    points[n][0] = x + 0.25 * n * dx;
    points[n][1] = y + 0.25 * n * dy;
  }
  const double spine[2][3] = {{x, y + 2.0, 0.0}, {x + dx, y + dy + 2.0, 0.0}};
  double length = hypot(dx, dy);
  fg_icon icon = {.spine_count = 2,
                  .spine = spine,
                  .center = {x, y - 2.0},
                  .cluster = 1,
                  .point_count = 5,
                  .points = (const double(*)[3])points,
                  .width = 0.12 * length,
                  .tail_width = 0.05 * length,
                  .head_length = 0.3 * length,
                  .head_width = 0.3 * length,
                  .speed = speed};
  assert_int_equal(fg__icons_add(e->icons, e->context, &icon), FG_STATUS_OK);
}

static void make_field(example *e, bool periodic)
{
  static double x[NX], y[NY];
  static float u[NX * NY], v[NX * NY];
  for (int i = 0; i < NX; ++i)
    x[i] = 10.0 + 0.5 * i * (periodic ? 60.0 / 61.0 : 1.0);
  for (int j = 0; j < NY; ++j)
    y[j] = -5.0 + 0.5 * j;
  for (int n = 0; n < NX * NY; ++n) {
    double px = x[n % NX], py = y[n / NX];
    u[n] = hypot(px - 32.0, py - 10.0) < 3.0 ? NAN : 1.0F;
    v[n] = 0.5F;
  }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {NX, NY, 0},
                            .axis = {x, y, NULL},
                            .velocity = {u, v, NULL},
                            .velocity_units = "m/s",
                            .title = "Wind & waves <1 \xFF",
                            .level = "10 m"};
  arrays.period[0] = periodic ? 30.0 : 0.0;
  assert_int_equal(fg_field_create(&e->field, e->context, &arrays), FG_STATUS_OK);
}

static void make_density(example *e)
{
  static float u[NX * NY];
  for (int n = 0; n < NX * NY; ++n)
    u[n] = (float)(3.0 - hypot(10.0 + 0.5 * (n % NX) - 15.0, -5.0 + 0.5 * (n / NX)));
  fg_density_arrays arrays = {.dimension = 2,
                              .nodes = {NX, NY, 1},
                              .origin = {10.0, -5.0, 0.0},
                              .spacing = {0.5, 0.5, 0.0},
                              .u = u};
  assert_int_equal(fg_density_create_from_arrays(&e->density, e->context, &arrays),
                   FG_STATUS_OK);
}

static int set_up(void **state)
{
  example *e = calloc(1, sizeof *e);
  assert_non_null(e);
  assert_int_equal(fg_context_create(&e->context), FG_STATUS_OK);
  make_field(e, false);
  make_density(e);
  assert_int_equal(fg__icons_create_empty(&e->icons, e->context), FG_STATUS_OK);
  add_arrow(e, 13.0, 0.0, 6.0, 0.0, speeds[0]);
  add_arrow(e, 22.0, -2.0, 0.0, 7.0, speeds[1]);
  add_arrow(e, 36.0, 2.0, -5.0, -3.0, speeds[2]);
  snprintf(e->folder, sizeof e->folder, "/tmp/flowgrain-picture-XXXXXX");
  assert_non_null(mkdtemp(e->folder));
  *state = e;
  return 0;
}

static int files_in(const char *folder)
{
  DIR *listing = opendir(folder);
  assert_non_null(listing);
  int count = 0;
  for (struct dirent *entry; (entry = readdir(listing));)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
      ++count;
  closedir(listing);
  return count;
}

static void path_in(char path[160], const example *e, const char *name)
{
  snprintf(path, 160, "%s/%s", e->folder, name);
}

static int tear_down(void **state)
{
  example *e = *state;
  DIR *listing = opendir(e->folder);
  if (!listing)
    return -1;
  for (struct dirent *entry; (entry = readdir(listing));) {
    char path[400];
    snprintf(path, sizeof path, "%s/%s", e->folder, entry->d_name);
    unlink(path);
  }
  closedir(listing);
  rmdir(e->folder);
  fg_density_destroy(e->density);
  fg_icons_destroy(e->icons);
  fg_field_destroy(e->field);
  fg_context_destroy(e->context);
  free(e);
  return 0;
}

static void write_picture(const example *e, const char *name,
                          const fg_picture_options *options)
{
  char path[160];
  path_in(path, e, name);
  fg_status status =
      fg_picture_write(e->context, path, e->field, e->density, e->icons, options);
  if (status)
    print_error("%s\n", fg_context_message(e->context));
  assert_int_equal(status, FG_STATUS_OK);
}

static char *read_file(const example *e, const char *name, size_t *size)
{
  char path[160];
  path_in(path, e, name);
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  char *bytes = calloc(*size + 1, 1);
  assert_non_null(bytes);
  assert_int_equal(fread(bytes, 1, *size, file), *size);
  fclose(file);
  return bytes;
}

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

/* The box of the numbers in an SVG path's d attribute. */
static void path_box(double box[4], const char *path)
{
  box[0] = box[1] = HUGE_VAL;
  box[2] = box[3] = -HUGE_VAL;
  const char *at = strstr(path, " d=\"");
  assert_non_null(at);
  at += 4;
  for (int n = 0; *at && *at != '"';) {
    char *end;
    double value = strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    box[n] = fmin(box[n], value);
    box[n + 2] = fmax(box[n + 2], value);
    n = 1 - n;
    at = end;
  }
}

static bool fill_of(const char *path, double rgb[3])
{
  const char *end = strchr(path, '>');
  const char *fill = strstr(path, "fill:rgb(");
  return end && fill && fill < end &&
         sscanf(fill, "fill:rgb(%lf%%,%lf%%,%lf%%)", &rgb[0], &rgb[1], &rgb[2]) == 3;
}

static void an_svg_has_one_path_an_arrow_in_its_colour(void **state)
{
  const example *e = *state;
  fg_picture_options options = {
      .width = 300.0, .no_frame = true, .speed_min = 1.0, .speed_max = 12.0};
  write_picture(e, "a.svg", &options);
  size_t size;
  char *text = read_file(e, "a.svg", &size);
  assert_null(strstr(text, "<use"));
  assert_non_null(strstr(text, "width=\"300pt\" height=\"200pt\""));
  fg__palette palette;
  assert_int_equal(fg__palette_create(&palette, NULL, NULL), FG_STATUS_OK);
  /* tail, tip, and reach of the head to either side, points from the upper left */
  static const double boxes[3][4] = {{30.0, 141.0, 90.0, 159.0},
                                     {109.5, 100.0, 130.5, 170.0},
                                     {210.0, 125.0, 262.0, 162.0}};
  for (int n = 0; n < 3; ++n) {
    fg__color color = fg__palette_color(&palette, (speeds[n] - 1.0) / 11.0);
    int found = 0;
    for (const char *path = text; (path = strstr(path, "<path")); ++path) {
      double rgb[3] = {0}, box[4] = {0};
      if (!fill_of(path, rgb) || fabs(rgb[0] - 100.0 * color.red) > 0.01 ||
          fabs(rgb[1] - 100.0 * color.green) > 0.01 ||
          fabs(rgb[2] - 100.0 * color.blue) > 0.01)
        continue;
      ++found;
      path_box(box, path);
      assert_true(box[0] > boxes[n][0] - 2.0 && box[1] > boxes[n][1] - 2.0);
      assert_true(box[2] < boxes[n][2] + 2.0 && box[3] < boxes[n][3] + 2.0);
      assert_true(box[2] - box[0] > 0.9 * (boxes[n][2] - boxes[n][0]) - 4.0);
      assert_true(box[3] - box[1] > 0.9 * (boxes[n][3] - boxes[n][1]) - 4.0);
    }
    assert_int_equal(found, 1);
  }
  free(text);
}

/* Every element that opens also closes, in order; attributes hold no raw marks. */
static void framed_svgs_are_well_formed(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.tint = true};
  write_picture(e, "a.svg", &options);
  size_t size;
  char *text = read_file(e, "a.svg", &size);
  const char *open[64] = {NULL};
  int depth = 0, texts = 0;
  for (char *at = text; (at = strchr(at, '<')); ++at) {
    char *end = strchr(at, '>');
    assert_non_null(end);
    if (at[1] == '?')
      continue;
    if (at[1] == '/') {
      assert_true(depth > 0);
      size_t length = strcspn(at + 2, " >");
      assert_memory_equal(at + 2, open[--depth], length);
      continue;
    }
    texts += strncmp(at, "<use", 4) == 0;
    if (end[-1] != '/') {
      assert_true(depth < 64);
      open[depth++] = at + 1;
    }
  }
  assert_int_equal(depth, 0);
  assert_true(texts > 40); /* a glyph each */
  free(text);
}

static void an_arrow_across_a_periodic_border_shows_on_both_sides(void **state)
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

static void writing_twice_gives_the_same_bytes(void **state)
{
  const example *e = *state;
  static const char *const names[][2] = {{"a.png", "b.png"}, {"a.pdf", "b.pdf"}};
  for (int k = 0; k < 2; ++k) {
    char *bytes[2];
    size_t size[2];
    for (int n = 0; n < 2; ++n) {
      write_picture(e, names[k][n], NULL);
      bytes[n] = read_file(e, names[k][n], &size[n]);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    assert_int_equal(memcmp(bytes[0], k ? "%PDF" : "\x89PNG", 4), 0);
    free(bytes[0]);
    free(bytes[1]);
  }
  assert_int_equal(files_in(e->folder), 4);
}

static void expect_failure(const example *e, const char *path, fg_status expected,
                           const char *words, const fg_picture_options *options)
{
  fg_status status =
      fg_picture_write(e->context, path, e->field, NULL, e->icons, options);
  assert_int_equal(status, expected);
  assert_non_null(strstr(fg_context_message(e->context), words));
  fg_context_clear(e->context);
  assert_int_equal(files_in(e->folder), 0);
}

static void bad_options_are_refused(void **state)
{
  const example *e = *state;
  char path[160];
  path_in(path, e, "a.png");
  static const struct {
    fg_picture_options options;
    const char *words;
  } cases[] = {{{.width = -3.0}, "-3"},
               {{.width = 20001.0}, "20001"},
               {{.height = (double)NAN}, "nan"},
               {{.pixels_per_point = -1.0}, "-1 pixels"},
               {{.pixels_per_point = HUGE_VAL}, "inf pixels"},
               {{.pixels_per_point = 1e5}, "pixels, at most"},
               {{.palette = "jet"}, "'jet'"},
               {{.tint_color = "blue"}, "'blue'"},
               {{.mask_color = "#12"}, "'#12'"},
               {{.speed_min = 4.0, .speed_max = 1.5}, "from 4 to 1.5"},
               {{.speed_max = HUGE_VAL}, "inf"},
               {{.font_size = -9.0}, "-9"},
               {{.tint = true}, "density"}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    expect_failure(e, path, FG_STATUS_ARGUMENT, cases[k].words, &cases[k].options);
}

static void a_place_that_cannot_be_written_is_reported(void **state)
{
  const example *e = *state;
  char path[160];
  path_in(path, e, "a.jpg");
  expect_failure(e, path, FG_STATUS_UNSUPPORTED, "a.jpg", NULL);
  path_in(path, e, "png");
  expect_failure(e, path, FG_STATUS_UNSUPPORTED, "png", NULL);
  path_in(path, e, "missing/a.png");
  expect_failure(e, path, FG_STATUS_FILE_ACCESS, "missing/a.png", NULL);
}

static void a_full_disk_is_reported(void **state)
{
  const example *e = *state;
  static const char *const names[] = {"a.svg", "a.pdf", "a.png"};
  for (int k = 0; k < 3; ++k) {
    char path[160];
    path_in(path, e, names[k]);
    assert_int_equal(symlink("/dev/full", path), 0);
    fg_status status = fg_picture_write(e->context, path, e->field, NULL, e->icons, NULL);
    assert_int_equal(status, FG_STATUS_FILE_ACCESS);
    assert_non_null(strstr(fg_context_message(e->context), "No space left"));
    fg_context_clear(e->context);
    unlink(path);
  }
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

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      TEST(a_png_shows_arrows_mask_and_tint),
      TEST(skeletons_are_shown_when_asked_for),
      TEST(arrows_and_their_keys_can_be_left_out),
      TEST(a_transparent_png_has_no_background),
      TEST(an_svg_has_one_path_an_arrow_in_its_colour),
      TEST(framed_svgs_are_well_formed),
      TEST(an_arrow_across_a_periodic_border_shows_on_both_sides),
      TEST(writing_twice_gives_the_same_bytes),
      TEST(bad_options_are_refused),
      TEST(a_place_that_cannot_be_written_is_reported),
      TEST(a_full_disk_is_reported),
      TEST(odd_icons_are_drawn_without_trouble),
  };
  return cmocka_run_group_tests_name("picture/picture", tests, NULL, NULL);
}
