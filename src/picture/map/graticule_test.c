/* Degrees inside a map, with arrows and without, and round it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture/map/map_scene.h"
#include "picture/map/page_map.h"
#include "picture/map/views_test.h"
#include "picture/polygons.h"

/* Bars across a box, so near to each other that nothing fits between. */
static void cover(fg__polygons *out, const fg__page_box *box)
{
  for (double y = box->y0; y < box->y1; y += 4.0) {
    const double bar[][2] = {{box->x0, y}, {box->x1, y}, {box->x1, y + 1.0}};
    assert_true(fg__polygons_begin(out));
    for (int k = 0; k < 3; ++k)
      assert_true(fg__polygons_add(out, bar[k]));
  }
}

/* A circle in a square frame. */
static void add_rim(fg__polygons *out, const fg__page_box *frame)
{
  const double radius = 0.5 * (frame->x1 - frame->x0);
  assert_true(fg__polygons_begin(out));
  for (int k = 0; k < 180; ++k) {
    const double angle = k * acos(-1.0) / 90.0;
    const double at[2] = {frame->x0 + radius * (1.0 + cos(angle)),
                          frame->y0 + radius * (1.0 + sin(angle))};
    assert_true(fg__polygons_add(out, at));
  }
}

/* The boxes of the labels; returns how many. covered: where arrows are; NULL: none. */
static int label(fg__page_box at[], const fg__graticule *graticule, const fg__page *laid,
                 const fg__page_box *covered)
{
  fg__page *page = malloc(sizeof *page);
  assert_non_null(page);
  *page = *laid;
  fg__map_scene scene = {.coasts = false};
  fg__polygons arrows = {0};
  add_rim(&scene.outline, &page->frame);
  if (covered)
    cover(&arrows, covered);
  cairo_t *ruler = fg__text_ruler();
  fg__map_scene_label(&scene, page, graticule, &arrows, ruler);
  cairo_destroy(ruler);
  int count = 0;
  for (int k = 0; k < page->text_count; ++k)
    if (page->text[k].halo)
      at[count++] = page->text[k].box;
  fg__polygons_clear(&arrows);
  fg__map_scene_clear(&scene);
  free(page);
  return count;
}

static double angle_of(const fg__page *page, const fg__page_box *box)
{
  return atan2(box->y0 + box->y1 - page->frame.y0 - page->frame.y1,
               box->x0 + box->x1 - page->frame.x0 - page->frame.x1);
}

static void are_in_a_row(const fg__page *page, const fg__page_box *at, int count)
{
  for (int k = 1; k < count; ++k)
    assert_true(fabs(angle_of(page, &at[k]) - angle_of(page, &at[0])) < 1e-3);
}

/* All parallels round a pole have their degrees in one row along a meridian, where arrows
 * cover all of it, too; a label that an arrow is in the way of goes elsewhere. */
static void parallels_round_a_pole_are_labelled_in_a_row(void **state)
{
  static const struct {
    view cap;
    int parallels;
  } caps[] = {
      {{"+proj=laea +lat_0=-90 +R=6371000 +units=km", {-5300, -5300}, {5300, 5300}, true},
       4},
      {{"+proj=stere +lat_0=90 +lon_0=-30 +R=6371000 +units=km",
        {-4500, -4500},
        {4500, 4500},
        true},
       3}};
  fg_context *context = *state;
  for (size_t n = 0; n < sizeof caps / sizeof *caps; ++n) {
    const int parallels = caps[n].parallels;
    fg__plane plane;
    make_plane(&plane, context, &caps[n].cap);
    fg__graticule *graticule = calloc(1, sizeof *graticule);
    fg__page *page = calloc(1, sizeof *page);
    assert_non_null(graticule);
    assert_non_null(page);
    assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
    const fg__page_plan plan = plan_of(&plane, graticule);
    cairo_t *ruler = fg__text_ruler();
    fg__page_layout(page, &plan, ruler);
    cairo_destroy(ruler);
    fg__page_box alone[FG__PAGE_TEXTS], other[FG__PAGE_TEXTS];
    assert_int_equal(label(alone, graticule, page, NULL), parallels);
    are_in_a_row(page, alone, parallels);
    assert_int_equal(label(other, graticule, page, &page->frame), parallels);
    are_in_a_row(page, other, parallels);
    assert_int_equal(label(other, graticule, page, &alone[1]), parallels);
    for (int k = 0; k < parallels; ++k)
      assert_true(other[k].x1 < alone[1].x0 || other[k].x0 > alone[1].x1 ||
                  other[k].y1 < alone[1].y0 || other[k].y0 > alone[1].y1);
    fg__graticule_clear(graticule);
    fg__plane_clear(&plane);
    free(graticule);
    free(page);
  }
}

/* A label at a side of a box stands where its line leaves it, also of a parallel round a
 * pole in the box; the others of these have their degrees inside. */
static void parallels_round_a_pole_in_a_box_are_labelled_inside(void **state)
{
  static const view pole = {"+proj=stere +lat_0=90 +lat_ts=60 +lon_0=-45 +R=6370000 "
                            "+units=km",
                            {-1300, -1100},
                            {1300, 1100},
                            false};
  fg_context *context = *state;
  fg__plane plane;
  fg__graticule *graticule = calloc(1, sizeof *graticule);
  assert_non_null(graticule);
  make_plane(&plane, context, &pole);
  assert_false(plane.whole);
  assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
  assert_true(graticule->insides > 0);
  for (int n = 0; n < graticule->labels + graticule->insides; ++n) {
    const bool at_side = n < graticule->labels;
    const fg__map_label *label =
        at_side ? &graticule->label[n] : &graticule->inside[n - graticule->labels];
    double longitude, latitude;
    if (!strchr(label->text, 'N'))
      continue;
    fg__plane_inverse(&plane, 1, &label->at[0], &label->at[1], &longitude, &latitude);
    assert_float_equal(latitude, strtod(label->text, NULL), 0.01);
    for (int k = 0; k < graticule->labels; ++k)
      assert_true(at_side || graticule->label[k].line != label->line);
  }
  fg__graticule_clear(graticule);
  fg__plane_clear(&plane);
  free(graticule);
}

static void lay_out(fg__page *page, fg_context *context, const view *v, double width)
{
  fg__plane plane;
  fg__graticule *graticule = calloc(1, sizeof *graticule);
  assert_non_null(graticule);
  make_plane(&plane, context, v);
  assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
  fg__page_plan plan = plan_of(&plane, graticule);
  plan.width = width;
  cairo_t *ruler = fg__text_ruler();
  fg__page_layout(page, &plan, ruler);
  cairo_destroy(ruler);
  fg__graticule_clear(graticule);
  fg__plane_clear(&plane);
  free(graticule);
}

/* Degrees east, from 0 on, that stand below the frame, from left to right. */
static int longitudes(const fg__page *page, double at[])
{
  int count = 0;
  for (int n = 0; n < page->text_count; ++n) {
    const char *text = page->text[n].text, last = text[strlen(text) - 1];
    const double west = last == 'W' ? -1.0 : 1.0;
    if (page->text[n].box.y0 < page->frame.y1)
      continue;
    at[count++] = fmod(west * strtod(text, NULL) + 360.0, 360.0);
  }
  return count;
}

/* At the lower side, which meridians end half a sample before: of all or, where it is
 * narrow, of every second one from the middle on. */
static void meridians_of_cylinders_have_degrees(void **state)
{
  static const double wide[] = {240, 300, 0, 60, 120}, narrow[] = {240, 0, 120};
  fg__page *page = calloc(1, sizeof *page);
  double at[FG__PAGE_TEXTS];
  assert_non_null(page);
  lay_out(page, *state, &plate, 400.0);
  assert_int_equal(longitudes(page, at), 5);
  assert_memory_equal(at, wide, sizeof wide);
  lay_out(page, *state, &plate, 150.0);
  assert_int_equal(longitudes(page, at), 3);
  assert_memory_equal(at, narrow, sizeof narrow);
  free(page);
}

/* Of three that have no room the first and the last stay. */
static void degrees_of_a_narrow_box_are_its_ends(void **state)
{
  static const view andes = {
      "+proj=tmerc +lon_0=-70 +R=6371000 +units=km", {-560, -6100}, {560, 1100}, false};
  fg__page *page = calloc(1, sizeof *page);
  double at[FG__PAGE_TEXTS];
  assert_non_null(page);
  lay_out(page, *state, &andes, 300.0);
  assert_int_equal(longitudes(page, at), 2);
  assert_true(at[0] == 285.0 && at[1] == 295.0);
  free(page);
}

/* Also where the middle ones have more room than the others, for they are shorter. */
static void degrees_of_a_box_are_even(void **state)
{
  static const view indian = {
      "+proj=merc +lon_0=75 +R=6371000 +units=km", {-5100, -3480}, {5100, 3480}, false};
  fg__page *page = calloc(1, sizeof *page);
  double at[FG__PAGE_TEXTS];
  int least = FG__PAGE_TEXTS, most = 0;
  assert_non_null(page);
  for (double width = 70.0; width < 300.0; width += 5.0) {
    lay_out(page, *state, &indian, width);
    const int count = longitudes(page, at);
    for (int n = 2; n < count; ++n)
      assert_true(at[n] - at[n - 1] == at[1] - at[0]);
    least = count < least ? count : least;
    most = count > most ? count : most;
  }
  assert_true(least < most && most > 4);
  free(page);
}

/* Of small parts of the Earth, and where meridians meet in a point. */
static void frames_have_lines_enough(void **state)
{
  static const view small[] = {
      /* 30 km wide; from a pole to 80 degrees north */
      {"+proj=merc +lon_0=0.1 +R=6371000 +units=km", {-15, 6650}, {15, 6690}, false},
      {"+proj=laea +lon_0=20 +lat_0=90 +R=6371000 +units=km",
       {-600, -1120},
       {500, 20},
       false},
      /* the poles are in the middle of the sides */
      {"+proj=laea +lon_0=-60 +R=6371000 +units=km",
       {-5000, -9000},
       {5000, 9000},
       false}};
  static const int least[] = {3, 2, 1};
  fg_context *context = *state;
  fg__page *page = calloc(1, sizeof *page);
  double at[FG__PAGE_TEXTS];
  assert_non_null(page);
  for (size_t n = 0; n < sizeof small / sizeof *small; ++n) {
    lay_out(page, context, &small[n], 300.0);
    const int count = longitudes(page, at);
    if (count < least[n])
      fail_msg("view %zu: %d longitudes", n, count);
  }
  /* where all meridians meet the middle one has the place */
  assert_true(at[longitudes(page, at) / 2] == 300.0);
  free(page);
}

/* Of maps of the world, whatever their outline's shape. */
static void degrees_keep_off_the_outline(void **state)
{
  fg_context *context = *state;
  fg__page *page = calloc(1, sizeof *page);
  assert_non_null(page);
  int labels = 0;
  for (int k = 0; k < VIEWS; ++k) {
    fg__plane plane;
    lay_out(page, context, views[k], 400.0);
    make_plane(&plane, context, views[k]);
    for (int n = 0; n < page->text_count && plane.whole; ++n) {
      const fg__page_box *box = &page->text[n].box;
      ++labels;
      for (size_t i = 0; i < plane.outline.point_count; ++i) {
        const double *point = plane.outline.point[i];
        const double x = page->frame.x0 + page->scale * (point[0] - plane.low[0]);
        const double y = page->frame.y1 - page->scale * (point[1] - plane.low[1]);
        if (x > box->x0 && x < box->x1 && y > box->y0 && y < box->y1)
          fail_msg("view %d: %s", k, page->text[n].text);
      }
    }
    fg__plane_clear(&plane);
  }
  assert_true(labels > 30);
  free(page);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(parallels_round_a_pole_are_labelled_in_a_row,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(parallels_round_a_pole_in_a_box_are_labelled_inside,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(meridians_of_cylinders_have_degrees, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(degrees_of_a_narrow_box_are_its_ends,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(degrees_of_a_box_are_even, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(frames_have_lines_enough, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(degrees_keep_off_the_outline, context_set_up,
                                      context_tear_down),
  };
  return cmocka_run_group_tests_name("picture/map/graticule", tests, NULL, NULL);
}
