/* Pictures as SVG. */
#include "picture/page/picture_example.h"
#include "picture/page/text.h"
#include "picture/palette.h"

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

/* Every element that opens also closes, in order; attributes hold no raw marks. Returns
 * how many elements begin so. */
static int count_elements(const char *text, const char *start)
{
  const char *open[64] = {NULL};
  int depth = 0, count = 0;
  for (const char *at = text; (at = strchr(at, '<')); ++at) {
    const char *end = strchr(at, '>');
    assert_non_null(end);
    if (at[1] == '?')
      continue;
    if (at[1] == '/') {
      assert_true(depth > 0);
      size_t length = strcspn(at + 2, " >");
      assert_memory_equal(at + 2, open[--depth], length);
      continue;
    }
    count += strncmp(at, start, strlen(start)) == 0;
    if (end[-1] != '/') {
      assert_true(depth < 64);
      open[depth++] = at + 1;
    }
  }
  assert_int_equal(depth, 0);
  return count;
}

static void framed_svgs_are_well_formed(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.tint = true, .outline_text = true};
  write_picture(e, "a.svg", &options);
  size_t size;
  char *text = read_file(e, "a.svg", &size);
  assert_true(count_elements(text, "<path") > 20);
  assert_int_equal(count_elements(text, "<text"), 0);
  free(text);
}

static double attribute(const char *element, const char *name)
{
  const char *at = strstr(element, name);
  assert_non_null(at);
  return atof(at + strlen(name));
}

/* As wide as they were measured, whatever the viewer's font; what XML means otherwise is
 * escaped. */
static void texts_of_an_svg_are_texts(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.label = "\"fast\" & {units}",
                                .subtitle = "\xC3\xA9t\xC3\xA9"};
  write_picture(e, "a.svg", &options);
  size_t size;
  char *text = read_file(e, "a.svg", &size);
  assert_int_equal(count_elements(text, "<use"), 0);
  assert_true(count_elements(text, "<text") > 10);
  assert_non_null(strstr(text, ">Wind &amp; waves &lt;1 ?</text>"));
  assert_non_null(strstr(text, ">\xC3\xA9t\xC3\xA9</text>"));
  /* m s^-1: the exponent is raised, and what would follow is not */
  const char *label = strstr(text, ">&quot;fast&quot; &amp; m/s</text>");
  const char *raised = strstr(text, "<tspan dy=\"-");
  assert_true(label || (raised && strstr(raised, ">\xE2\x88\x92"
                                                 "1</tspan></text>")));
  cairo_t *ruler = fg__text_ruler();
  const char *title = strstr(text, ">Wind &amp;");
  while (strncmp(title, "<text", 5) != 0)
    --title;
  const double width =
      fg__text_width(ruler, "Wind & waves <1 ?", attribute(title, "font-size=\""), true);
  assert_true(fabs(attribute(title, "textLength=\"") - width) < 0.01);
  cairo_destroy(ruler);
  free(text);
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, example_set_up, example_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(an_svg_has_one_path_an_arrow_in_its_colour),
      TEST(framed_svgs_are_well_formed),
      TEST(texts_of_an_svg_are_texts),
  };
  return cmocka_run_group_tests_name("picture/page/picture_svg", tests, NULL, NULL);
}
