/* Where the numbers round a box go. */
#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/page/text.h"
#include "picture/render/box_axes.h"

static const double EM = 20.0;
static const fg__pane PANE = {84.0, 82.0, 1030.0, 720.0};

typedef struct scenery {
  fg__view_box view_box;
  fg__camera camera;
  fg__box_axes axes;
  double lowest;
  cairo_t *ruler;
} scenery;

/* A box from (-1, 0, 10) on, seen so; what is kept free. */
static void look(scenery *s, const double side[3], double azimuth, double elevation,
                 const fg__pane *kept)
{
  static const double low[3] = {-1.0, 0.0, 10.0};
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
  if (kept)
    s->axes.kept = *kept;
  s->lowest = fg__box_axes_place(&s->axes, &s->view_box, &s->camera, s->ruler);
  cairo_destroy(s->ruler);
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
      look(&s, side, azimuth, elevation, NULL);
      for (int n = 0; n < s.axes.texts; ++n) {
        assert_true(s.axes.text[n].box.y1 <= s.lowest);
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
  look(&s, side, 30.0, 22.0, NULL);
  assert_int_equal(s.axes.texts, wanted_of(&s.axes));
  int last = s.axes.ticks[0].count - 1;
  assert_string_equal(s.axes.text[last].text, "5");
  assert_string_equal(s.axes.text[last + 2].text, "0");
}

static void the_kept_place_stays_free(void **state)
{
  (void)state;
  static const double side[3] = {6.0, 2.75, 2.4};
  scenery s;
  look(&s, side, 30.0, 22.0, NULL);
  int all = s.axes.texts;
  const fg__pane kept = {900.0, 100.0, 1200.0, 700.0};
  look(&s, side, 30.0, 22.0, &kept);
  assert_true(s.axes.texts > all / 2 && s.axes.texts < all);
  for (int n = 0; n < s.axes.texts; ++n)
    assert_false(are_near(&s.axes.text[n].box, &kept, 0.0, 0.0));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts_keep_apart),
      cmocka_unit_test(both_numbers_of_a_corner_are_there),
      cmocka_unit_test(the_kept_place_stays_free),
  };
  return cmocka_run_group_tests_name("picture/render/box_axes", tests, NULL, NULL);
}
