/* Degrees inside a map, with arrows and without. */
#include <math.h>
#include <stdlib.h>

#include "picture/map/map_scene.h"
#include "picture/map/page_map.h"
#include "picture/map/views_test.h"
#include "picture/polygons.h"

/* Bars across all of the frame, so near to each other that nothing fits between. */
static void cover(fg__polygons *out, const fg__page_box *frame)
{
  for (double y = frame->y0; y < frame->y1; y += 4.0) {
    const double bar[][2] = {{frame->x0, y}, {frame->x1, y}, {frame->x1, y + 1.0}};
    assert_true(fg__polygons_begin(out));
    for (int k = 0; k < 3; ++k)
      assert_true(fg__polygons_add(out, bar[k]));
  }
}

/* The texts with a halo; returns how many. */
static int label(double at[][2], const fg__graticule *graticule, const fg__page *laid,
                 bool covered)
{
  fg__page *page = malloc(sizeof *page);
  assert_non_null(page);
  *page = *laid;
  fg__map_scene scene = {.coasts = false};
  fg__polygons arrows = {0};
  if (covered)
    cover(&arrows, &page->frame);
  cairo_t *ruler = fg__text_ruler();
  fg__map_scene_label(&scene, page, graticule, &arrows, ruler);
  cairo_destroy(ruler);
  int count = 0;
  for (int k = 0; k < page->text_count; ++k) {
    const fg__page_box *box = &page->text[k].box;
    if (!page->text[k].halo)
      continue;
    at[count][0] = 0.5 * (box->x0 + box->x1);
    at[count++][1] = 0.5 * (box->y0 + box->y1);
  }
  fg__polygons_clear(&arrows);
  fg__map_scene_clear(&scene);
  free(page);
  return count;
}

/* All parallels round a pole have their degrees in one row along a meridian, the same
 * whatever arrows there are. */
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
    double alone[FG__PAGE_TEXTS][2], covered[FG__PAGE_TEXTS][2];
    assert_int_equal(label(alone, graticule, page, false), caps[n].parallels);
    assert_int_equal(label(covered, graticule, page, true), caps[n].parallels);
    const double middle[2] = {0.5 * (page->frame.x0 + page->frame.x1),
                              0.5 * (page->frame.y0 + page->frame.y1)};
    const double first = atan2(alone[0][1] - middle[1], alone[0][0] - middle[0]);
    for (int k = 0; k < caps[n].parallels; ++k) {
      assert_true(hypot(alone[k][0] - covered[k][0], alone[k][1] - covered[k][1]) < 1e-9);
      assert_true(fabs(atan2(alone[k][1] - middle[1], alone[k][0] - middle[0]) - first) <
                  1e-3);
    }
    fg__graticule_clear(graticule);
    fg__plane_clear(&plane);
    free(graticule);
    free(page);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(parallels_round_a_pole_are_labelled_in_a_row,
                                      context_set_up, context_tear_down),
  };
  return cmocka_run_group_tests_name("picture/map/graticule", tests, NULL, NULL);
}
