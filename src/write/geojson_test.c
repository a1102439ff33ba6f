#include <dirent.h>
#include <math.h>

#include "file/folder_test.h"
#include "icon/icons.h"

static int set_up(void **state)
{
  int failed = folder_set_up(state);
  if (!failed)
    path_of(*state, "icons.geojson");
  return failed;
}

static const double SPIRAL[4][3] = {{-179.25, 0.1, 0.0},
                                    {1.0 / 3.0, 2e-7, 0.0},
                                    {12345.678901234567, -4.0, 0.0},
                                    {7, 9, 0}};
static const double STROKE[2][3] = {{0.03, 0.7}, {0.30000000000000004, -1e300}};

static fg_icons *make_icons(fg_context *context)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  const fg_icon first = {.cluster = 7,
                         .kind = FG_ICON_RING,
                         .point_count = 4,
                         .points = SPIRAL,
                         .width = 0.03,
                         .tail_width = 0.01,
                         .head_length = 0.1 + 0.2,
                         .head_width = 5e-324,
                         .center = {2.5, -3.5, 0.0},
                         .area = 1e22,
                         .speed = 1.0 / 7.0};
  const fg_icon second = {.cluster = 2, .point_count = 2, .points = STROKE, .width = 4.0};
  assert_int_equal(fg__icons_add(icons, context, &first), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, context, &second), FG_STATUS_OK);
  fg__icons_set_clusters(icons, 9, 3);
  return icons;
}

static void assert_equal_icons(const fg_icons *a, const fg_icons *b)
{
  assert_int_equal(fg_icons_count(a), fg_icons_count(b));
  assert_int_equal(fg_icons_clusters(a), fg_icons_clusters(b));
  assert_int_equal(fg_icons_dropped(a), fg_icons_dropped(b));
  for (int n = 0; n < fg_icons_count(a); ++n) {
    const fg_icon *p = fg_icons_at(a, n), *q = fg_icons_at(b, n);
    assert_int_equal(p->cluster, q->cluster);
    assert_true(p->kind == q->kind);
    assert_int_equal(p->point_count, q->point_count);
    assert_memory_equal(p->points, q->points,
                        (size_t)p->point_count * sizeof p->points[0]);
    assert_memory_equal(p->center, q->center, sizeof p->center);
    assert_true(p->width == q->width && p->tail_width == q->tail_width);
    assert_true(p->head_length == q->head_length && p->head_width == q->head_width);
    assert_true(p->area == q->area && p->speed == q->speed);
  }
}

static char *read_text(const char *path)
{
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  char *text = calloc(1, 1 << 20);
  assert_non_null(text);
  size_t size = fread(text, 1, (1 << 20) - 1, file);
  assert_true(size > 0);
  fclose(file);
  return text;
}

static void write_text(const char *path, const char *text, size_t size)
{
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(text, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
}

static void icons_come_back_bit_for_bit(void **state)
{
  folder *f = *state;
  fg_icons *icons = make_icons(f->context), *back = NULL;
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  assert_int_equal(fg_icons_read(&back, f->context, f->path), FG_STATUS_OK);
  assert_equal_icons(icons, back);
  fg_icons_destroy(back);
  /* over an existing file too */
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  fg_icons_destroy(icons);
}

/* A vortex that turns clockwise and a saddle, as Points behind the icons. */
static void critical_points_are_written_and_passed_over(void **state)
{
  folder *f = *state;
  enum { SIDE = 41 };
  double axis[SIDE];
  float u[SIDE * SIDE], v[SIDE * SIDE];
  for (int n = 0; n < SIDE; ++n)
    axis[n] = n - 20;
  for (int n = 0; n < SIDE * SIDE; ++n) {
    u[n] = (float)axis[n / SIDE];
    v[n] = (float)(81.0 - axis[n % SIDE] * axis[n % SIDE]);
  }
  const fg_field_arrays arrays = {
      .dimension = 2, .size = {SIDE, SIDE}, .axis = {axis, axis}, .velocity = {u, v}};
  fg_field *field = NULL;
  fg_critical_points *points = NULL;
  fg_icons *icons = make_icons(f->context), *read = NULL;
  assert_int_equal(fg_field_create(&field, f->context, &arrays), FG_STATUS_OK);
  assert_int_equal(fg_critical_points_find(&points, f->context, field, NULL),
                   FG_STATUS_OK);
  fg_icons_keep_critical(icons, points);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  char *text = read_text(f->path);
  assert_non_null(strstr(text, "\"type\":\"Point\""));
  assert_non_null(
      strstr(text, "\"kind\":\"centre\",\"index\":1,\"sense\":\"clockwise\"}}"));
  assert_non_null(strstr(text, "\"kind\":\"saddle\",\"index\":-1,\"outflow\":["));
  free(text);
  assert_int_equal(fg_icons_read(&read, f->context, f->path), FG_STATUS_OK);
  assert_equal_icons(icons, read);
  assert_null(fg_icons_kept_critical(read));
  fg_icons_destroy(icons);
  fg_icons_destroy(read);
  fg_field_destroy(field);
}

static void numbers_are_short_and_icons_have_lines_of_their_own(void **state)
{
  folder *f = *state;
  fg_icons *icons = make_icons(f->context);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  char *text = read_text(f->path);
  assert_non_null(strstr(text, "\"width\":0.03,"));
  assert_non_null(strstr(text, "\"kind\":\"ring\""));
  assert_non_null(strstr(text, "\"center\":[2.5,-3.5]"));
  int lines = 0;
  for (const char *c = text; *c; ++c)
    lines += *c == '\n';
  assert_int_equal(lines, 4);
  free(text);
  fg_icons_destroy(icons);
}

static void no_icons_are_a_collection_too(void **state)
{
  folder *f = *state;
  fg_icons *icons = NULL, *back = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, f->context), FG_STATUS_OK);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  assert_int_equal(fg_icons_read(&back, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(back), 0);
  fg_icons_destroy(back);
  fg_icons_destroy(icons);
}

static void lines_of_other_programs_are_read(void **state)
{
  folder *f = *state;
  static const char text[] =
      "\n{\"bbox\":[0,0,1,1], \"features\":[{\"geometry\":{\"coordinates\":"
      "[[1,2],[3,4,5],[6,7]],\"type\":\"LineString\"},\"type\":\"Feature\","
      "\"properties\":null}],\"type\":\"FeatureCollection\"} \n";
  write_text(f->path, text, sizeof text - 1);
  fg_icons *icons = NULL;
  assert_int_equal(fg_icons_read(&icons, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 1);
  assert_int_equal(fg_icons_clusters(icons), 1);
  const fg_icon *icon = fg_icons_at(icons, 0);
  assert_int_equal(icon->cluster, 1);
  assert_int_equal(icon->point_count, 3);
  assert_true(icon->points[1][2] == 5.0 && icon->points[2][2] == 0.0);
  assert_true(icon->center[0] == 3.0 && icon->center[1] == 4.0);
  fg_icons_destroy(icons);
}

static void assert_refused(folder *f, const char *text, size_t size)
{
  fg_icons *icons = NULL;
  write_text(f->path, text, size);
  assert_int_equal(fg_icons_read(&icons, f->context, f->path), FG_STATUS_FILE_FORMAT);
  assert_null(icons);
  assert_true(strncmp(fg_context_message(f->context), f->path, strlen(f->path)) == 0);
  fg_context_clear(f->context);
}

static void every_wrong_value_is_refused(void **state)
{
  folder *f = *state;
  static const char *const swaps[][2] = {
      {"\"FeatureCollection\"", "\"Feature\""},
      {"\"FeatureCollection\"", "7"},
      {"\"features\":[", "\"features\":[1,"},
      {"\"LineString\"", "\"Polygon\""},
      {"\"LineString\"", "\"Point\""},
      {"[-179.25,0.1]", "[-179.25]"},
      {"[-179.25,0.1]", "[-179.25,0.1,0,0]"},
      {"[-179.25,0.1]", "[-179.25,\"0.1\"]"},
      {"[-179.25,0.1]", "[-179.25,1e999]"},
      {"[-179.25,0.1]", "[-179.25,nan]"},
      {"[-179.25,0.1]", "null"},
      {"\"cluster\":7", "\"cluster\":-1"},
      {"\"cluster\":7", "\"cluster\":7.5"},
      {"\"cluster\":7", "\"cluster\":2147483648"},
      {"\"cluster\":7", "\"cluster\":\"7\""},
      {"\"kind\":\"ring\"", "\"kind\":\"star\""},
      {"\"kind\":\"ring\"", "\"kind\":3"},
      {"\"width\":0.03", "\"width\":-0.03"},
      {"\"width\":0.03", "\"width\":null"},
      {"\"speed\":", "\"speed\":-"},
      {"\"center\":[2.5,-3.5]", "\"center\":[2.5]"},
      {"\"center\":[2.5,-3.5]", "\"center\":3"},
      {"\"clusters\":9", "\"clusters\":-9"},
      {"\"dropped\":3", "\"dropped\":{}"},
      {"\"properties\":{", "\"properties\":7,\"x\":{"},
      {"{\"type\":\"FeatureC", "7{\"type\":\"FeatureC"},
  };
  fg_icons *icons = make_icons(f->context);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  fg_icons_destroy(icons);
  char *text = read_text(f->path);
  for (size_t i = 0; i < sizeof swaps / sizeof swaps[0]; ++i) {
    const char *at = strstr(text, swaps[i][0]);
    assert_non_null(at);
    char changed[4096];
    int size = snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text,
                        swaps[i][1], at + strlen(swaps[i][0]));
    assert_refused(f, changed, (size_t)size);
  }
  free(text);
  static const char deep[5000] = "";
  assert_refused(f, deep, sizeof deep);
  char nested[5000];
  memset(nested, '[', sizeof nested);
  assert_refused(f, nested, sizeof nested);
}

static void every_truncation_is_refused(void **state)
{
  folder *f = *state;
  fg_icons *icons = make_icons(f->context);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  fg_icons_destroy(icons);
  char *text = read_text(f->path);
  size_t whole = strlen(text) - 1; /* without the last line end it is still whole */
  for (size_t size = 1; size < whole; ++size)
    assert_refused(f, text, size);
  free(text);
}

static void a_failed_write_leaves_the_old_file_and_nothing_else(void **state)
{
  folder *f = *state;
  write_text(f->path, "old", 3);
  const double points[2][3] = {{0, 1}, {(double)NAN, 2}};
  fg_icon icon = {.cluster = 1, .point_count = 2, .points = points};
  fg_icons *icons = make_icons(f->context);
  assert_int_equal(fg__icons_add(icons, f->context, &icon), FG_STATUS_OK);
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_ARGUMENT);
  fg_context_clear(f->context);
  char *text = read_text(f->path);
  assert_string_equal(text, "old");
  free(text);
  fg_icons_destroy(icons);

  icons = make_icons(f->context);
  char nowhere[128];
  snprintf(nowhere, sizeof nowhere, "%s/missing/icons.geojson", f->name);
  assert_int_equal(fg_icons_write(f->context, nowhere, icons), FG_STATUS_FILE_ACCESS);
  fg_context_clear(f->context);
  assert_int_equal(fg_icons_write(f->context, f->name, icons), FG_STATUS_FILE_ACCESS);
  fg_context_clear(f->context);
  if (access("/dev/full", W_OK) == 0) {
    assert_int_equal(fg_icons_write(f->context, "/dev/full", icons),
                     FG_STATUS_FILE_ACCESS);
    assert_int_equal(access("/dev/full", W_OK), 0);
    fg_context_clear(f->context);
  }
  fg_icons_destroy(icons);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(icons_come_back_bit_for_bit),
      TEST(critical_points_are_written_and_passed_over),
      TEST(numbers_are_short_and_icons_have_lines_of_their_own),
      TEST(no_icons_are_a_collection_too),
      TEST(lines_of_other_programs_are_read),
      TEST(every_wrong_value_is_refused),
      TEST(every_truncation_is_refused),
      TEST(a_failed_write_leaves_the_old_file_and_nothing_else),
  };
  return cmocka_run_group_tests_name("write/geojson", tests, NULL, NULL);
}
