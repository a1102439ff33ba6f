/* Where a field on a map has no data. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "flowgrain/flowgrain.h"
#include "picture/map/missing.h"
#include "picture/map/views_test.h"
#include "picture/polygons.h"

static const view sea = {"+proj=laea +lat_0=-35 +lon_0=-120 +R=6371000 +units=km",
                         {-3000, -3000},
                         {3000, 3000},
                         false};

static const fg__polygons nothing = {0};

/* Samples lie 100 km apart: data reach to between 1900 and 2000. */
static bool in_the_west(double x, double y)
{
  (void)y;
  return x < 2000.0;
}

static double area_of(const fg__polygons *loops)
{
  double area = 0.0;
  for (size_t k = 0; k < loops->count; ++k)
    area += fg__polygon_area(loops, k);
  return area;
}

static void add_loop(fg__polygons *out, const double (*point)[2], int count)
{
  assert_true(fg__polygons_begin(out));
  for (int n = 0; n < count; ++n)
    assert_true(fg__polygons_add(out, point[n]));
}

static bool contains(const fg__polygons *loops, double x, double y)
{
  bool inside = false;
  for (size_t k = 0; k < loops->count; ++k)
    inside = inside != fg__polygon_contains(loops, k, x, y);
  return inside;
}

/* Of the field in the west. */
static void find(fg__missing *out, fg_context *context, const fg__polygons *land,
                 const fg__polygons *lakes)
{
  double low[2] = {-3000, -3000}, high[2] = {3000, 3000};
  fg_field *field = make_field(context, &sea, in_the_west);
  fg__plane plane;
  assert_int_equal(fg__plane_create(&plane, context, field, low, high), FG_STATUS_OK);
  assert_int_equal(fg__missing_find(out, context, &plane, field, land, lakes),
                   FG_STATUS_OK);
  fg__plane_clear(&plane);
  fg_field_destroy(field);
}

static void the_rim_is_where_data_end(void **state)
{
  fg__missing missing;
  find(&missing, *state, &nothing, &nothing);
  assert_true(fabs(area_of(&missing.area) - 1050.0 * 6000.0) < 60.0 * 6000.0);
  assert_int_equal(missing.rim.count, 1);
  for (size_t n = 0; n < missing.rim.point_count; ++n)
    assert_true(fabs(missing.rim.point[n][0] - 1950.0) < 60.0);
  fg__missing_clear(&missing);
}

static void what_land_explains_is_not_missing(void **state)
{
  static const double corner[][2] = {
      {1900, -4000}, {4000, -4000}, {4000, 4000}, {1900, 4000}};
  fg__polygons land = {0};
  fg__missing missing;
  add_loop(&land, corner, 4);
  find(&missing, *state, &land, &nothing);
  assert_int_equal(missing.area.count, 0);
  fg__missing_clear(&missing);
  /* nor is a strip along the coast, as grids leave it */
  fg__polygons_clear(&land);
  double inland[4][2];
  memcpy(inland, corner, sizeof inland);
  inland[0][0] = inland[3][0] = 2000.0;
  add_loop(&land, (const double(*)[2])inland, 4);
  find(&missing, *state, &land, &nothing);
  assert_int_equal(missing.area.count, 0);
  fg__polygons_clear(&land);
  fg__missing_clear(&missing);
}

/* A coarse grid of the sea has values on a third of the land, along its coast. */
static void a_field_on_coasts_is_of_the_sea(void **state)
{
  static const double corner[][2] = {
      {1500, -4000}, {4000, -4000}, {4000, 4000}, {1500, 4000}};
  static const double inland[][2] = {
      {-2000, -4000}, {4000, -4000}, {4000, 4000}, {-2000, 4000}};
  fg__polygons land = {0};
  fg__missing missing;
  add_loop(&land, corner, 4);
  find(&missing, *state, &land, &nothing);
  assert_false(missing.on_land);
  assert_int_equal(missing.area.count, 0);
  fg__polygons_clear(&land);
  fg__missing_clear(&missing);
  add_loop(&land, inland, 4);
  find(&missing, *state, &land, &nothing);
  assert_true(missing.on_land);
  assert_true(missing.area.count > 0);
  fg__polygons_clear(&land);
  fg__missing_clear(&missing);
}

/* A long bay that is narrower than strips are, beyond a coast with data before it, and a
 * lake. */
static void bays_without_data_are_missing(void **state)
{
  static const double coast[][2] = {{1900, -4000}, {4000, -4000}, {4000, 4000},
                                    {1900, 4000},  {1900, 40},    {2900, 40},
                                    {2900, -20},   {1900, -20}};
  static const double shore[][2] = {
      {2300, 1000}, {2700, 1000}, {2700, 1400}, {2300, 1400}};
  fg__polygons land = {0}, lakes = {0};
  fg__missing missing;
  add_loop(&land, coast, 8);
  find(&missing, *state, &land, &lakes);
  assert_false(missing.on_land);
  assert_true(contains(&missing.area, 2500.0, 10.0));
  assert_true(contains(&missing.area, 2800.0, 10.0));
  assert_false(contains(&missing.area, 1800.0, 10.0));
  assert_false(contains(&missing.area, 2500.0, 1200.0));
  fg__missing_clear(&missing);
  add_loop(&lakes, shore, 4);
  find(&missing, *state, &land, &lakes);
  assert_true(missing.lakes);
  fg__polygons_clear(&land);
  fg__polygons_clear(&lakes);
  fg__missing_clear(&missing);
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(the_rim_is_where_data_end),
      TEST(what_land_explains_is_not_missing),
      TEST(a_field_on_coasts_is_of_the_sea),
      TEST(bays_without_data_are_missing),
  };
  return cmocka_run_group_tests_name("picture/map/missing", tests, NULL, NULL);
}
