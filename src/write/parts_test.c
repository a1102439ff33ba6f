/* Icons of maps as GeoJSON in longitude and latitude, back again, and on other maps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "file/folder_test.h"
#include "flowgrain/map.h"
#include "icon/icons.h"
#include "map/map.h"

static int set_up(void **state)
{
  int failed = folder_set_up(state);
  if (!failed)
    path_of(*state, "icons.geojson");
  return failed;
}

enum { POINTS = 5 };

/* Icons whose points are given in degrees. */
static fg_icons *make(fg_context *context, const char *projection,
                      const double degrees[][POINTS][2], int count)
{
  fg_icons *icons;
  fg__map *map;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  assert_int_equal(fg__icons_set_projection(icons, context, projection), FG_STATUS_OK);
  assert_int_equal(fg__map_create(&map, context, projection), FG_STATUS_OK);
  for (int n = 0; n < count; ++n) {
    double points[POINTS][3] = {{0}};
    const bool any_turn = strcmp(projection, "+proj=longlat") == 0;
    const double turn =
        any_turn ? 0.0
                 : 360.0 * nearbyint((degrees[n][2][0] - fg__map_center(map)) / 360.0);
    for (int i = 0; i < POINTS; ++i) {
      const double longitude = degrees[n][i][0] - turn;
      fg__map_forward(map, 1, &longitude, &degrees[n][i][1], &points[i][0],
                      &points[i][1]);
    }
    fg_icon icon = {.cluster = n + 1,
                    .point_count = POINTS,
                    .points = (const double(*)[3])points,
                    .width = 100.0 / 3.0,
                    .head_length = 77.0,
                    .area = 1e6 / 7.0,
                    .speed = 3.0,
                    .id = n + 1,
                    .way = {10.0, 20.0}};
    memcpy(icon.center, points[2], sizeof icon.center);
    memcpy(icon.seed, points[1], sizeof icon.seed);
    assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
  }
  fg__map_destroy(map);
  fg__icons_set_clusters(icons, count, 0);
  return icons;
}

static cJSON *parse(const char *path)
{
  static char text[1 << 18];
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  cJSON *root = cJSON_Parse(text);
  assert_non_null(root);
  return root;
}

static const cJSON *member(const cJSON *object, const char *name)
{
  return cJSON_GetObjectItemCaseSensitive(object, name);
}

static double number_at(const cJSON *list, int index)
{
  return cJSON_GetArrayItem(list, index)->valuedouble;
}

static void assert_same(const fg_icons *a, const fg_icons *b)
{
  assert_int_equal(fg_icons_count(a), fg_icons_count(b));
  assert_string_equal(fg_icons_projection(a), fg_icons_projection(b));
  for (int n = 0; n < fg_icons_count(a); ++n) {
    const fg_icon *p = fg_icons_at(a, n), *q = fg_icons_at(b, n);
    assert_int_equal(p->point_count, q->point_count);
    assert_memory_equal(p->points, q->points,
                        (size_t)p->point_count * sizeof p->points[0]);
    assert_memory_equal(p->center, q->center, sizeof p->center);
    assert_memory_equal(p->seed, q->seed, sizeof p->seed);
    assert_true(p->area == q->area && p->width == q->width && p->way[1] == q->way[1]);
  }
}

static const double LINES[][POINTS][2] = {
    {{10, 20}, {12, 21}, {14, 23}, {15, 26}, {15, 30}},
    {{170, -40}, {175, -41}, {179, -42}, {183, -41}, {190, -40}},
    {{-175, 5}, {-178, 6}, {-180, 7}, {-182, 8}, {-185, 9}},
};

static void lines_are_cut_at_the_antimeridian(void **state)
{
  folder *f = *state;
  static const char *const planes[] = {"+proj=eqearth +lon_0=200 +R=6371000 +units=km",
                                       "+proj=longlat",
                                       "+proj=merc +lon_0=180 +ellps=WGS84"};
  for (size_t k = 0; k < sizeof planes / sizeof *planes; ++k) {
    fg_icons *icons = make(f->context, planes[k], LINES, 3), *back;
    assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
    cJSON *root = parse(f->path);
    assert_string_equal(cJSON_GetStringValue(member(root, "projection")), planes[k]);
    for (int n = 0; n < 3; ++n) {
      const cJSON *feature = cJSON_GetArrayItem(member(root, "features"), n);
      const cJSON *geometry = member(feature, "geometry");
      const cJSON *parts = member(geometry, "coordinates"), *part, *position;
      assert_string_equal(cJSON_GetStringValue(member(geometry, "type")),
                          n ? "MultiLineString" : "LineString");
      if (n == 0)
        continue;
      assert_int_equal(cJSON_GetArraySize(parts), 2);
      cJSON_ArrayForEach(part, parts)
      {
        double side = 0.0;
        assert_true(cJSON_GetArraySize(part) >= 2);
        cJSON_ArrayForEach(position, part)
        {
          const double longitude = number_at(position, 0);
          assert_true(fabs(longitude) <= 180.0 && longitude * side >= 0.0);
          side = longitude;
        }
      }
      const cJSON *first = parts->child;
      const cJSON *end = cJSON_GetArrayItem(first, cJSON_GetArraySize(first) - 1);
      const cJSON *begin = first->next->child;
      assert_true(fabs(number_at(end, 0)) == 180.0);
      assert_true(number_at(end, 0) == -number_at(begin, 0));
      assert_true(number_at(end, 1) == number_at(begin, 1));
    }
    cJSON_Delete(root);
    assert_int_equal(fg_icons_read(&back, f->context, f->path), FG_STATUS_OK);
    assert_same(icons, back);
    fg_icons_destroy(back);
    fg_icons_destroy(icons);
  }
}

/* Areas on the globe; Mercator's are 4 times as large at 60 degrees. */
static void areas_are_those_on_the_globe(void **state)
{
  folder *f = *state;
  static const double line[][POINTS][2] = {
      {{-2, 60}, {-1, 60}, {0, 60}, {1, 60}, {2, 60}}};
  static const struct {
    const char *plane;
    double factor;
  } cases[] = {{"+proj=merc +R=6371000 +units=km", 4.0},
               {"+proj=moll +R=6371000 +units=km", 1.0}};
  for (size_t k = 0; k < 2; ++k) {
    fg_icons *icons = make(f->context, cases[k].plane, line, 1);
    assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
    cJSON *root = parse(f->path);
    const cJSON *properties = member(member(root, "features")->child, "properties");
    assert_true(fabs(member(properties, "area")->valuedouble * cases[k].factor -
                     1e6 / 7.0) < 1.0);
    assert_true((member(properties, "plane_area") != NULL) == (k == 0));
    assert_true(fabs(number_at(member(properties, "center"), 1) - 60.0) < 1e-6);
    cJSON_Delete(root);
    fg_icons_destroy(icons);
  }
}

static fg_field *field_of(fg_context *context, const char *projection)
{
  static const double axis[] = {-1e4, 0.0, 1e4};
  static const float velocity[] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {3, 3},
                                  .axis = {axis, axis},
                                  .velocity = {velocity, velocity},
                                  .scale = FG_SCALE_MAP,
                                  .projection = projection};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static void icons_go_to_other_maps_and_come_back(void **state)
{
  folder *f = *state;
  static const char from[] = "+proj=eqearth +lon_0=200 +R=6371000 +units=km";
  static const char to[] = "+proj=merc +lon_0=160 +R=6371000";
  fg_field *there = field_of(f->context, to), *here = field_of(f->context, from);
  fg_icons *icons = make(f->context, from, LINES, 3), *same = icons;
  assert_int_equal(fg_icons_project(&icons, f->context, here), FG_STATUS_OK);
  assert_ptr_equal(icons, same);
  assert_int_equal(fg_icons_project(&icons, f->context, there), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 3);
  const fg_icon *icon = fg_icons_at(icons, 1);
  /* 42 degrees south, 179 E: metres from 160 E; areas 1 / cos^2 as large */
  const double cosine = cos(42.0 * 0.017453292519943295);
  assert_true(fabs(icon->center[0] - 19.0 * 0.017453292519943295 * 6371000.0) < 1e-3);
  assert_true(fabs(icon->width - 1e5 / 3.0 / cosine) < 1.0);
  assert_int_equal(fg_icons_project(&icons, f->context, here), FG_STATUS_OK);
  fg_icons *whole = make(f->context, from, LINES, 3);
  for (int n = 0; n < 3; ++n) {
    const fg_icon *p = fg_icons_at(icons, n), *q = fg_icons_at(whole, n);
    assert_int_equal(p->point_count, q->point_count);
    for (int i = 0; i < p->point_count; ++i)
      assert_true(hypot(p->points[i][0] - q->points[i][0],
                        p->points[i][1] - q->points[i][1]) < 1e-5);
    assert_true(fabs(p->width - q->width) < 1e-5 && fabs(p->area - q->area) < 1.0);
  }
  fg_icons_destroy(whole);
  fg_icons_destroy(icons);
  /* a line across the new cut loses its shorter part, and another program's lines are in
   * degrees */
  fg_field *cut = field_of(f->context, "+proj=eqearth +lon_0=0 +R=6371000 +units=km");
  icons = make(f->context, "+proj=longlat", LINES, 3);
  assert_int_equal(fg__icons_set_projection(icons, f->context, NULL), FG_STATUS_OK);
  assert_int_equal(fg_icons_project(&icons, f->context, cut), FG_STATUS_OK);
  assert_int_equal(fg_icons_at(icons, 0)->point_count, POINTS);
  assert_int_equal(fg_icons_at(icons, 1)->point_count, 3);
  fg_icons_destroy(icons);
  fg_field_destroy(cut);
  fg_field_destroy(here);
  fg_field_destroy(there);
}

static void planes_that_do_not_fit_are_refused(void **state)
{
  folder *f = *state;
  fg_icons *icons = make(f->context, "+proj=moll +R=6371000", LINES, 1), *back;
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  fg_icons_destroy(icons);
  cJSON *root = parse(f->path);
  char *text = cJSON_PrintUnformatted(root);
  cJSON_Delete(root);
  static const char *const swaps[][2] = {
      {"\"plane\"", "\"plain\""},
      {"\"projection\":\"+proj", "\"projection\":7,\"q\":\""},
      {"\"plane\":[[", "\"plane\":[[[],"},
      {"\"plane_center\":[", "\"plane_center\":[[],"}};
  for (size_t k = 0; k < sizeof swaps / sizeof *swaps; ++k) {
    const char *at = strstr(text, swaps[k][0]);
    assert_non_null(at);
    FILE *file = fopen(f->path, "wb");
    assert_non_null(file);
    fprintf(file, "%.*s%s%s", (int)(at - text), text, swaps[k][1],
            at + strlen(swaps[k][0]));
    fclose(file);
    assert_int_equal(fg_icons_read(&back, f->context, f->path), FG_STATUS_FILE_FORMAT);
    fg_context_clear(f->context);
  }
  cJSON_free(text);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(lines_are_cut_at_the_antimeridian),
      TEST(areas_are_those_on_the_globe),
      TEST(icons_go_to_other_maps_and_come_back),
      TEST(planes_that_do_not_fit_are_refused),
  };
  return cmocka_run_group_tests_name("write/parts", tests, NULL, NULL);
}
