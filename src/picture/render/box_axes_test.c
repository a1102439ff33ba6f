/* Where the numbers round a box go, and how much of a page it takes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_test.h"
#include "icon/icons.h"
#include "picture/page/text.h"
#include "picture/render/box_axes.h"
#include "picture/render/solid_picture.h"

static const double EM = 20.0;
static const fg__pane PANE = {84.0, 82.0, 1030.0, 720.0};

typedef struct scenery {
  fg__view_box view_box;
  fg__camera camera;
  fg__box_axes axes;
  fg__pane bounds; /* of the texts */
  cairo_t *ruler;
} scenery;

static void look_at(scenery *s, const double low[3], const double side[3], double azimuth,
                    double elevation)
{
  double axis[3][2];
  fg_field_arrays field = {.dimension = 3, .size = {2, 2, 2}};
  for (int k = 0; k < 3; ++k) {
    axis[k][0] = low[k];
    axis[k][1] = low[k] + side[k];
    field.axis[k] = axis[k];
    field.axis_name[k] = k == 0 ? "x" : k == 1 ? "latitude" : "z";
    field.axis_units[k] = "";
  }
  fg__view_box_of(&s->view_box, &field);
  fg__camera_look(&s->camera, &s->view_box, azimuth, elevation, &PANE);
  s->ruler = fg__text_ruler();
  fg__box_axes_of(&s->axes, &field, &s->view_box, &s->camera, EM, s->ruler);
  s->bounds = (fg__pane){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  fg__box_axes_place(&s->axes, &s->bounds, &s->view_box, &s->camera, s->ruler);
  cairo_destroy(s->ruler);
}

/* A box from (-1, 0, 10) on, seen so. */
static void look(scenery *s, const double side[3], double azimuth, double elevation)
{
  look_at(s, (const double[3]){-1.0, 0.0, 10.0}, side, azimuth, elevation);
}

static bool are_near(const fg__pane *a, const fg__pane *b, double x, double y)
{
  return a->x0 < b->x1 + x && b->x0 < a->x1 + x && a->y0 < b->y1 + y && b->y0 < a->y1 + y;
}

static int wanted_of(const fg__box_axes *axes)
{
  int count = 0;
  for (int k = 0; k < 3; ++k)
    count += axes->edge[k][k] ? axes->ticks[k].count + 1 : 0;
  return count;
}

/* From wherever it is seen: no two numbers read as one, and hardly any is left out. */
static void texts_keep_apart(void **state)
{
  (void)state;
  static const double side[3] = {6.0, 2.75, 2.4};
  int wanted = 0, placed = 0;
  for (int azimuth = 5; azimuth < 360; azimuth += 25)
    for (int elevation = -60; elevation < 80; elevation += 17) {
      scenery s;
      look(&s, side, azimuth, elevation);
      for (int n = 0; n < s.axes.texts; ++n) {
        const fg__pane *box = &s.axes.text[n].box;
        assert_true(box->x0 >= s.bounds.x0 && box->x1 <= s.bounds.x1);
        assert_true(box->y0 >= s.bounds.y0 && box->y1 <= s.bounds.y1);
        for (int m = 0; m < n; ++m)
          assert_false(are_near(&s.axes.text[n].box, &s.axes.text[m].box, 0.6 * EM - 1e-9,
                                0.25 * EM - 1e-9));
      }
      wanted += wanted_of(&s.axes);
      placed += s.axes.texts;
    }
  assert_true(placed <= wanted);
  assert_true(placed > 0.97 * wanted);
}

/* In the usual view the last number of x and the first of y meet at a corner. */
static void both_numbers_of_a_corner_are_there(void **state)
{
  (void)state;
  static const double side[3] = {6.0, 2.5, 2.4};
  scenery s;
  look(&s, side, 30.0, 22.0);
  assert_int_equal(s.axes.texts, wanted_of(&s.axes));
  int last = s.axes.ticks[0].count - 1;
  assert_string_equal(s.axes.text[last].text, "5");
  assert_string_equal(s.axes.text[last + 2].text, "0");
}

/* Two axes that begin with the same number have it once at the corner where they meet. */
static void a_shared_number_of_a_corner_is_there_once(void **state)
{
  (void)state;
  static const double low[3] = {0.0, 0.0, 0.0}, side[3] = {1.0, 0.5, 1.0};
  scenery s;
  look_at(&s, low, side, 0.0, 25.0);
  int zeros = 0, lowest = 0;
  for (int n = 0; n < s.axes.texts; ++n)
    if (strcmp(s.axes.text[n].text, "0.0") == 0) {
      ++zeros;
      lowest += s.axes.text[n].box.y1 > s.bounds.y1 - 6.0 * EM;
    }
  assert_true(zeros >= 1);
  assert_int_equal(lowest, 1);
}

/* Where one of the two has three numbers, too; y begins at another corner. */
static void the_first_of_three_numbers_is_shared(void **state)
{
  (void)state;
  static const double low[3] = {0.0, 0.0, 0.0}, side[3] = {1.0, 1.0, 1.0};
  scenery s;
  look_at(&s, low, side, 40.0, 46.0);
  int zeros = 0;
  for (int n = 0; n < s.axes.texts; ++n)
    zeros += strcmp(s.axes.text[n].text, "0.0") == 0;
  assert_int_equal(s.axes.ticks[2].count, 3);
  assert_int_equal(zeros, 2);
}

/* Different ones that stand beside an axis. */
static int numbers_of(const fg__box_axes *axes, int k)
{
  const fg__ticks *ticks = &axes->ticks[k];
  int count = 0;
  for (int n = 0; n < ticks->count; ++n) {
    bool placed = false;
    for (int m = 0; m < axes->texts; ++m)
      placed = placed || axes->text[m].text == ticks->text[n];
    for (int m = 0; m < n; ++m)
      placed = placed && strcmp(ticks->text[m], ticks->text[n]) != 0;
    count += placed;
  }
  return count;
}

/* Of a thin pipe, too, every side that has an axis has two numbers at least. */
static void each_axis_tells_its_scale(void **state)
{
  (void)state;
  static const double low[3] = {-0.0103, -0.0098, 0.0}, side[3] = {0.0206, 0.0199, 0.1};
  int thin = 0;
  for (int azimuth = 5; azimuth < 360; azimuth += 25)
    for (int elevation = -60; elevation < 80; elevation += 17) {
      scenery s;
      look_at(&s, low, side, azimuth, elevation);
      for (int k = 0; k < 3; ++k) {
        if (!s.axes.edge[k][k])
          continue;
        thin += k < 2;
        assert_true(numbers_of(&s.axes, k) >= 2);
      }
    }
  assert_true(thin > 100);
}

/* Writes a picture of a field of such sides, with an arrow along z, and reads the file as
 * a text; free it. */
static char *write_picture(const char *name, const double side[3],
                           const fg_solid_options *options)
{
  enum { MOST_BYTES = 1 << 22 };
  static const double line[2][3] = {{0.5, 0.5, 0.2}, {0.5, 0.5, 0.8}};
  static float velocity[3][8];
  char folder[] = "/tmp/flowgrain-box-XXXXXX", path[64];
  double axis[3][2] = {{0.0, side[0]}, {0.0, side[1]}, {0.0, side[2]}};
  fg_field_arrays arrays = {.dimension = 3, .size = {2, 2, 2}};
  fg_field *field;
  fg_icons *icons;
  for (int k = 0; k < 3; ++k) {
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = velocity[k];
  }
  for (int n = 0; n < 8; ++n)
    velocity[2][n] = n < 4 ? 1.0F : 2.0F;
  const fg_icon icon = {.point_count = 2,
                        .points = line,
                        .width = 0.1,
                        .tail_width = 0.1,
                        .head_length = 0.2,
                        .head_width = 0.2,
                        .speed = 1.0};
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/%s", folder, name);
  assert_int_equal(fg__solid_picture_write(NULL, path, field, icons, options),
                   FG_STATUS_OK);
  char *bytes = calloc(1, MOST_BYTES);
  FILE *file = fopen(path, "rb");
  assert_non_null(bytes);
  assert_non_null(file);
  assert_true(fread(bytes, 1, MOST_BYTES - 1, file) > 24);
  fclose(file);
  unlink(path);
  rmdir(folder);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
  return bytes;
}

static void measure_picture(int size[2], const double side[3])
{
  const fg_solid_options options = {
      .has_view = true, .azimuth = 30.0, .elevation = 22.0, .title = "a"};
  char *file = write_picture("a.png", side, &options);
  const unsigned char *head = (const unsigned char *)file;
  for (int k = 0; k < 2; ++k)
    size[k] = head[18 + 4 * k] << 8 | head[19 + 4 * k];
  free(file);
}

/* Neither a tall box nor a flat one leaves half of its picture empty. */
static void a_picture_is_as_large_as_its_box(void **state)
{
  (void)state;
  int tall[2], cube[2], flat[2];
  measure_picture(tall, (const double[3]){1.0, 1.0, 5.0});
  measure_picture(cube, (const double[3]){1.0, 1.0, 1.0});
  measure_picture(flat, (const double[3]){5.0, 1.0, 1.0});
  assert_true(tall[1] == 1200 && tall[0] >= 600 && tall[0] < 700);
  assert_true(cube[0] > 1000 && cube[1] > 1000);
  assert_true(flat[0] == 1200 && flat[1] >= 600 && flat[1] < 700);
}

/* Of all texts of an SVG file. */
static double least_font(const char *svg)
{
  double least = HUGE_VAL;
  for (const char *at = svg; (at = strstr(at, "<text")); ++at)
    least = fmin(least, atof(strstr(at, "font-size=\"") + 11));
  return least;
}

static double baseline_of(const char *svg, const char *words)
{
  const char *at = strstr(svg, words);
  assert_non_null(at);
  while (strncmp(at, "<text", 5) != 0)
    --at;
  return atof(strstr(at, "y=\"") + 3);
}

/* 8 cm wide: letters can be read, and a flat box has its key, with two numbers. */
static void small_pictures_are_read(void **state)
{
  (void)state;
  static const double flat[3] = {5.0, 1.0, 1.0};
  fg_solid_options options = {.width = 567,
                              .pixels_per_point = 2.5,
                              .has_view = true,
                              .azimuth = 30.0,
                              .elevation = 22.0,
                              .speed_min = 31.0,
                              .speed_max = 39.5,
                              .title = "a",
                              .subtitle = "b"};
  char *svg = write_picture("a.svg", flat, &options);
  int numbers = 0;
  assert_true(least_font(svg) > 6.99);
  assert_true(baseline_of(svg, ">speed</text>") > baseline_of(svg, ">b</text>") + 7.0);
  for (const char *at = svg; (at = strstr(at, ">3")); ++at)
    numbers += at[2] >= '1' && at[2] <= '9' && strncmp(at + 3, "</text>", 7) == 0;
  assert_true(numbers >= 2);
  free(svg);
}

static double number_after(const char *element, const char *name)
{
  const char *at = strstr(element, name);
  assert_non_null(at);
  return atof(at + strlen(name));
}

/* The box of an SVG's text. */
static fg__pane box_of(const char *element)
{
  const double x = number_after(element, " x=\""), y = number_after(element, " y=\"");
  const double size = number_after(element, " font-size=\"");
  const double width = number_after(element, " textLength=\"");
  const char *anchor = strstr(element, "text-anchor=\"middle");
  const double start = anchor && anchor < strchr(element, '>') ? x - width / 2.0 : x;
  return (fg__pane){start, y - 0.72 * size, start + width, y};
}

/* However small a picture is: no text is cut off at its edges or lies over another, and
 * each axis that is seen long enough has its name. */
static void no_text_of_a_small_picture_is_cut(void **state)
{
  enum { MOST = 64 };
  static const double sides[][3] = {
      {0.1, 0.1, 0.3}, {5000, 4000, 4200}, {1e-5, 2e-5, 1.5e-5}, {1, 1, 1}, {9, 6, 2}};
  static const double views[][2] = {{30, 22}, {0, 0}, {-60, -50}, {0, 90}};
  (void)state;
  for (size_t s = 0; s < sizeof sides / sizeof sides[0]; ++s)
    for (size_t v = 0; v < sizeof views / sizeof views[0]; ++v)
      for (int width = 150; width < 350; width += 80) {
        const fg_solid_options options = {.width = width,
                                          .pixels_per_point = 2.0,
                                          .has_view = true,
                                          .azimuth = views[v][0],
                                          .elevation = views[v][1],
                                          .speed_min = 0.001,
                                          .speed_max = 0.0035,
                                          .title = "a"};
        char *svg = write_picture("a.svg", sides[s], &options);
        const double page[2] = {number_after(svg, " width=\""),
                                number_after(svg, " height=\"")};
        fg__pane box[MOST];
        int count = 0;
        for (const char *at = svg; (at = strstr(at, "<text ")) && count < MOST; ++at) {
          const fg__pane *one = &box[count];
          box[count++] = box_of(at);
          assert_true(one->x0 >= 0.0 && one->x1 <= page[0]);
          assert_true(one->y0 >= 0.0 && one->y1 <= page[1]);
          for (int n = 0; n < count - 1; ++n)
            assert_false(are_near(one, &box[n], 0.0, 0.0));
        }

        assert_true(v > 0 ||
                    (strstr(svg, ">x") && strstr(svg, ">y") && strstr(svg, ">z")));
        free(svg);
      }
}

/* They can be searched and edited, unless shapes are wanted. */
static void texts_of_svg_stay_texts(void **state)
{
  (void)state;
  static const double cube[3] = {1.0, 1.0, 1.0};
  fg_solid_options options = {
      .has_view = true, .azimuth = 30.0, .elevation = 22.0, .title = "Swirl & rise"};
  char *svg = write_picture("a.svg", cube, &options);
  const char *title = strstr(svg, ">Swirl &amp; rise</text>");
  assert_non_null(title);
  while (strncmp(title, "<text", 5) != 0)
    --title;
  cairo_t *ruler = fg__text_ruler();
  const double em = atof(strstr(title, "font-size=\"") + 11);
  assert_true(em > 8.5 && em < 9.01);
  assert_true(fabs(atof(strstr(title, "textLength=\"") + 12) -
                   fg__text_width(ruler, "Swirl & rise", em, true)) < 0.01);
  cairo_destroy(ruler);
  free(svg);
  options.outline_text = true;
  svg = write_picture("a.svg", cube, &options);
  assert_null(strstr(svg, "<text"));
  free(svg);
}

/* Long ones are broken into lines, as in 2D, and leave the box its room. */
static void long_texts_are_whole(void **state)
{
  (void)state;
  static const double cube[3] = {1.0, 1.0, 1.0};
  const fg_solid_options options = {
      .width = 567,
      .pixels_per_point = 2.5,
      .has_view = true,
      .azimuth = 30.0,
      .elevation = 22.0,
      .speed_min = 31.0,
      .speed_max = 39.5,
      .title = "A title for a swirl about an upright axis, which rises in its core",
      .subtitle = "so long that it does not fit into a single line of a small picture",
      .label = "speed in metres a second"};
  char *svg = write_picture("a.svg", cube, &options);
  assert_null(strstr(svg, "\xE2\x80\xA6")); /* an ellipsis */
  assert_true(baseline_of(svg, "core</text>") > baseline_of(svg, ">A title"));
  assert_true(baseline_of(svg, "picture</text>") > baseline_of(svg, ">so long"));
  assert_true(baseline_of(svg, "second</text>") > baseline_of(svg, ">speed in"));
  free(svg);
}

/* Not a row or column more, which would stay transparent. */
static void a_file_has_the_pixels_that_are_drawn(void **state)
{
  (void)state;
  static const double cube[3] = {1.0, 1.0, 1.0};
  for (int height = 180; height < 240; ++height) {
    const fg_solid_options options = {.width = height + 61,
                                      .height = height,
                                      .pixels_per_point = 120.0 / 72.0,
                                      .has_view = true,
                                      .azimuth = 30.0,
                                      .elevation = 22.0};
    unsigned char *png = (unsigned char *)write_picture("a.png", cube, &options);
    assert_int_equal(png[18] << 8 | png[19], height + 61);
    assert_int_equal(png[22] << 8 | png[23], height);
    free(png);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(small_pictures_are_read),
      cmocka_unit_test(no_text_of_a_small_picture_is_cut),
      cmocka_unit_test(texts_of_svg_stay_texts),
      cmocka_unit_test(long_texts_are_whole),
      cmocka_unit_test(a_file_has_the_pixels_that_are_drawn),
      cmocka_unit_test(texts_keep_apart),
      cmocka_unit_test(both_numbers_of_a_corner_are_there),
      cmocka_unit_test(a_shared_number_of_a_corner_is_there_once),
      cmocka_unit_test(the_first_of_three_numbers_is_shared),
      cmocka_unit_test(each_axis_tells_its_scale),
      cmocka_unit_test(a_picture_is_as_large_as_its_box),
  };
  return cmocka_run_group_tests_name("picture/render/box_axes", tests, NULL, NULL);
}
