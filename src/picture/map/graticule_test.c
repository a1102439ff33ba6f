/* Degrees inside a map, with arrows and without. */
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(parallels_round_a_pole_are_labelled_in_a_row,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(parallels_round_a_pole_in_a_box_are_labelled_inside,
                                      context_set_up, context_tear_down),
  };
  return cmocka_run_group_tests_name("picture/map/graticule", tests, NULL, NULL);
}
