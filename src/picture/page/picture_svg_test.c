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

/* A vortex that turns clockwise and a saddle; the hole is far from both. */
static void turn_field(example *e)
{
  static double x[NX], y[NY];
  static float u[NX * NY], v[NX * NY];
  for (int i = 0; i < NX; ++i)
    x[i] = 10.0 + 0.5 * i;
  for (int j = 0; j < NY; ++j)
    y[j] = -5.0 + 0.5 * j;
  for (int n = 0; n < NX * NY; ++n) {
    u[n] = (float)(y[n / NX] - 4.0);
    v[n] = (float)(36.0 - (x[n % NX] - 25.0) * (x[n % NX] - 25.0));
  }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {NX, NY, 0},
                                  .axis = {x, y, NULL},
                                  .velocity = {u, v, NULL}};
  fg_field_destroy(e->field);
  assert_int_equal(fg_field_create(&e->field, e->context, &arrays), FG_STATUS_OK);
}

/* Strokes of a colour, in percent; the boxes of the first two. */
static int strokes_of(double box[2][4], const char *text, const char *color)
{
  int found = 0;
  for (const char *path = text; (path = strstr(path, "<path")); ++path) {
    const char *end = strchr(path, '>'), *stroke = strstr(path, color);
    if (!stroke || stroke > end)
      continue;
    if (found < 2)
      path_box(box[found], path);
    ++found;
  }
  return found;
}

static void signs_of_critical_points_are_where_they_lie(void **state)
{
  static const char color[] = "stroke:rgb(68%,2%,32%)";
  example *e = *state;
  fg_critical_points *points = NULL;
  double box[2][4];
  size_t size;
  turn_field(e);
  assert_int_equal(fg_critical_points_find(&points, e->context, e->field, NULL),
                   FG_STATUS_OK);
  assert_int_equal(fg_critical_points_count(points), 2);
  fg_icons_keep_critical(e->icons, points);
  write_picture(e, "a.svg", &(fg_picture_options){.width = 300.0, .no_frame = true});
  char *text = read_file(e, "a.svg", &size);
  assert_int_equal(strokes_of(box, text, color), 2);
  for (int k = 0; k < 2; ++k) {
    const fg_critical_point *point = fg_critical_points_at(points, k);
    const double x = 10.0 * (point->at[0] - 10.0), y = 10.0 * (15.0 - point->at[1]);
    assert_true(fabs(0.5 * (box[k][0] + box[k][2]) - x) < 2.0);
    assert_true(fabs(0.5 * (box[k][1] + box[k][3]) - y) < 2.0);
    assert_true(box[k][2] - box[k][0] > 5.0 && box[k][3] - box[k][1] > 5.0);
  }
  free(text);
  write_picture(e, "b.svg", &(fg_picture_options){.width = 300.0});
  text = read_file(e, "b.svg", &size);
  assert_int_equal(strokes_of(box, text, color), 4); /* two of the key */
  assert_non_null(strstr(text, ">saddle</text>"));
  assert_non_null(strstr(text, ">centre</text>"));
  assert_null(strstr(text, ">sink</text>"));
  free(text);
  write_picture(e, "c.svg", &(fg_picture_options){.width = 300.0, .no_keys = true});
  text = read_file(e, "c.svg", &size);
  assert_null(strstr(text, ">saddle</text>"));
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
  assert_non_null(strstr(text, ">Wind &amp; waves &lt;1 \xC3\xBF</text>"));
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
  const double width = fg__text_width(ruler, "Wind & waves <1 \xC3\xBF",
                                      attribute(title, "font-size=\""), true);
  assert_true(fabs(attribute(title, "textLength=\"") - width) < 0.01);
  cairo_destroy(ruler);
  free(text);
}

/* An arrow whose head or most of whose line is beyond the frame is left out and not
 * counted, and an error that it has a part in not told. */
static void captions_tell_what_is_shown(void **state)
{
  example *e = *state;
  fg_icons_keep_score(e->icons, &(fg_score){.mean = 11.2});
  static const struct {
    double x, dx;
    const char *arrows;
  } more[] = {{0.0, 0.0, "3 arrows"},
              {52.0, -5.0, "3 arrows"},
              {37.0, 4.0, "3 arrows"},   /* its head */
              {46.0, -10.0, "3 arrows"}, /* three fifths of its line */
              {42.0, -6.0, "4 arrows"}};
  for (size_t n = 0; n < sizeof more / sizeof *more; ++n) {
    if (n > 0)
      add_arrow(e, more[n].x, 2.0, more[n].dx, 0.0, 99.0);
    write_picture(e, "a.svg", &(fg_picture_options){.no_keys = true});
    size_t size;
    char *text = read_file(e, "a.svg", &size);
    assert_non_null(strstr(text, more[n].arrows));
    assert_true((strstr(text, "mean direction error 12") != NULL) == (n == 0));
    free(text);
  }
}

/* A picture without a single arrow is none. */
static void arrows_all_beyond_the_frame_are_refused(void **state)
{
  example *e = *state;
  fg_icons *all = e->icons;
  assert_int_equal(fg__icons_create_empty(&e->icons, e->context), FG_STATUS_OK);
  add_arrow(e, 52.0, 2.0, -5.0, -3.0, 99.0);
  char path[160];
  path_in(path, e, "a.svg");
  assert_int_equal(fg_picture_write(e->context, path, e->field, NULL, e->icons, NULL),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(e->context), "none of its 1 arrow lies"));
  assert_int_equal(files_in(e->folder), 0);
  fg_icons_destroy(e->icons);
  e->icons = all;
}

static int count_of(const char *text, const char *words)
{
  int count = 0;
  for (const char *at = text; (at = strstr(at, words)); ++at)
    ++count;
  return count;
}

static fg_status write_panels(const example *e, const char *name, const fg_panel *panels,
                              int count, const fg_picture_options *options)
{
  char path[160];
  path_in(path, e, name);
  return fg_panels_write(e->context, path, panels, count, options);
}

/* A panel alone, without what lies round it, is the picture. */
static void a_bare_panel_is_the_picture(void **state)
{
  const example *e = *state;
  const fg_panel panel = {.field = e->field, .icons = e->icons, .density = e->density};
  const fg_picture_options options = {.width = 300.0, .tint = true, .no_frame = true};
  static const char *const names[][2] = {{"a.svg", "b.svg"}, {"a.png", "b.png"}};
  for (int k = 0; k < 2; ++k) {
    size_t size[2];
    write_picture(e, names[k][0], &options);
    assert_int_equal(write_panels(e, names[k][1], &panel, 1, &options), FG_STATUS_OK);
    char *one = read_file(e, names[k][0], &size[0]);
    char *other = read_file(e, names[k][1], &size[1]);
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(one, other, size[0]);
    free(one);
    free(other);
  }
}

/* Three panels: arrows three times in the same colours, one key, one caption, names that
 * occur once. */
static void panels_have_one_key(void **state)
{
  const example *e = *state;
  const fg_panel panel[3] = {
      {.field = e->field, .icons = e->icons},
      {.field = e->field, .icons = e->icons, .label = "{letter}) x"},
      {.field = e->field, .icons = e->icons, .label = ""}};
  const fg_picture_options options = {.speed_min = 1.0, .speed_max = 12.0};
  size_t size;
  assert_int_equal(write_panels(e, "a.svg", panel, 3, &options), FG_STATUS_OK);
  char *text = read_file(e, "a.svg", &size);
  assert_true(count_elements(text, "<text") > 10);
  assert_int_equal(count_elements(text, "<linearGradient"), 1);
  assert_int_equal(count_of(text, ">mean speed ("), 1);
  assert_int_equal(count_of(text, ">length<"), 1);
  assert_int_equal(count_of(text, ">Wind &amp; waves"), 1);
  assert_int_equal(count_of(text, ">(a)<"), 1);
  assert_int_equal(count_of(text, ">b) x<"), 1);
  fg__palette palette;
  assert_int_equal(fg__palette_create(&palette, NULL, NULL), FG_STATUS_OK);
  for (int n = 0; n < 3; ++n) {
    const fg__color color = fg__palette_color(&palette, (speeds[n] - 1.0) / 11.0);
    double left[3] = {0.0}, rgb[3];
    int found = 0;
    for (const char *path = text; (path = strstr(path, "<path")); ++path) {
      double box[4];
      if (!fill_of(path, rgb) || fabs(rgb[0] - 100.0 * color.red) > 0.01 ||
          fabs(rgb[2] - 100.0 * color.blue) > 0.01)
        continue;
      path_box(box, path);
      assert_true(found < 3);
      left[found++] = box[0];
    }
    assert_int_equal(found, 3);
    assert_true(left[1] > left[0] + 10.0);
    assert_true(fabs(left[2] - 2.0 * left[1] + left[0]) < 0.01); /* in a row */
  }
  for (const char *at = text; (at = strstr(at, " id=\"")); ++at) {
    char name[64];
    snprintf(name, sizeof name, " id=\"%.*s\"", (int)strcspn(at + 5, "\""), at + 5);
    assert_int_equal(count_of(text, name), 1);
  }
  free(text);
}

static void panels_that_do_not_go_together_are_refused(void **state)
{
  const example *e = *state;
  const fg_field_arrays *whole = fg_field_contents(e->field);
  for (int k = 0; k < 4; ++k) {
    static const char *const words[] = {"b has the units km/h, and a m/s",
                                        "b shows p, v, and a u, v", "the projection",
                                        "b reaches from -5 to 14.5 along y"};
    fg_field_arrays arrays = *whole;
    arrays.velocity_units = k == 0 ? "km/h" : arrays.velocity_units;
    arrays.velocity_name[0] = k == 1 ? "p" : arrays.velocity_name[0];
    arrays.scale = k == 2 ? FG_SCALE_GEO : arrays.scale;
    arrays.size[1] -= k == 3;
    fg_field *field = NULL;
    assert_int_equal(fg_field_create(&field, e->context, &arrays), FG_STATUS_OK);
    const fg_panel panel[2] = {{.field = e->field, .icons = e->icons, .name = "a"},
                               {.field = field, .icons = e->icons, .name = "b"}};
    assert_int_equal(write_panels(e, "a.svg", panel, 2, NULL), FG_STATUS_ARGUMENT);
    assert_non_null(strstr(fg_context_message(e->context), words[k]));
    fg_context_clear(e->context);
    fg_field_destroy(field);
  }
  assert_int_equal(write_panels(e, "a.svg", NULL, 0, NULL), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(e->context), "0 panels, 1 to 100"));
  assert_int_equal(files_in(e->folder), 0);
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, example_set_up, example_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(an_svg_has_one_path_an_arrow_in_its_colour),
      TEST(framed_svgs_are_well_formed),
      TEST(texts_of_an_svg_are_texts),
      TEST(captions_tell_what_is_shown),
      TEST(signs_of_critical_points_are_where_they_lie),
      TEST(arrows_all_beyond_the_frame_are_refused),
      TEST(a_bare_panel_is_the_picture),
      TEST(panels_have_one_key),
      TEST(panels_that_do_not_go_together_are_refused),
  };
  return cmocka_run_group_tests_name("picture/page/picture_svg", tests, NULL, NULL);
}
