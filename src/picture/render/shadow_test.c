#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "base/memory.h"
#include "picture/render/light.h"
#include "picture/render/shadow.h"

/* A box of 1 x 1 x 0.8 that is seen from so far that a texel is its 500th part. */
static fg__rendering make_box(void)
{
  fg__rendering out = {.width = 400, .height = 400};
  out.view_box.half[0] = out.view_box.half[1] = 0.5;
  out.view_box.half[2] = 0.4;
  out.camera.eye[1] = -5.0;
  out.camera.factor = 2500.0;
  return out;
}

/* A square plate in the plane z = height, of two triangles that face up. */
static void make_plate(fg__caster out[2], const double middle[2], double half,
                       double height, bool clipped)
{
  const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  static const int triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (int n = 0; n < 2; ++n) {
    out[n].clipped = clipped;
    for (int m = 0; m < 3; ++m) {
      for (int k = 0; k < 2; ++k)
        out[n].at[m][k] = middle[k] + half * corner[triangle[n][m]][k];
      out[n].at[m][2] = height;
    }
  }
}

static void make_shadow(fg__shadow *out, const fg__rendering *box, fg__caster *caster,
                        size_t count)
{
  const fg__geometry geometry = {.caster = caster, .caster_count = count};
  assert_int_equal(fg__shadow_make(out, NULL, box, &geometry), FG_STATUS_OK);
  uint32_t *marks = fg__allocate((size_t)FG__BAND * (size_t)out->size[0], sizeof *marks);
  assert_non_null(marks);
  for (int band = 0; band < out->bands.count; ++band)
    fg__shadow_fill(out, band, marks);
  free(marks);
}

static double light_at(const fg__shadow *s, double x, double y)
{
  const double place[3] = {x, y, -0.4};
  return fg__shadow_light(s, place);
}

/* Half of the light comes to the shadow's edge, and what is higher has a softer one. */
static void edges_are_the_softer_the_higher_the_plate(void **state)
{
  (void)state;
  const fg__rendering box = make_box();
  const double middle[2] = {0.1, -0.15};
  double width[2];
  for (int high = 0; high < 2; ++high) {
    fg__caster plate[2];
    fg__shadow s;
    double above = high ? 0.7 : 0.3;
    make_plate(plate, middle, 0.1, above - 0.4, false);
    make_shadow(&s, &box, plate, 2);
    assert_true(light_at(&s, 0.1, -0.15) < 1e-12);
    assert_true(light_at(&s, -0.3, 0.2) > 1.0 - 1e-12);
    double sum = 0.0;
    for (int n = 0; n < 400; ++n)
      sum += light_at(&s, 0.1 + (n + 0.5) / 2000.0, -0.13);
    assert_true(fabs(sum / 2000.0 - 0.1) < 0.001); /* the lit half of the way */
    double first = 1.0, last = 0.0;
    for (int n = 0; n < 400; ++n) {
      double x = 0.1 + (n + 0.5) / 2000.0, light = light_at(&s, x, -0.13);
      first = light > 0.05 && x < first ? x : first;
      last = light < 0.95 ? x : last;
    }
    width[high] = last - first;
    assert_true(width[high] < 2.0 * above * fg__overhead_size + 0.005);
    fg__shadow_clear(&s);
  }
  assert_true(width[1] > 1.6 * width[0]);
}

/* What lies beyond the box casts no shadow where the box cuts, nor what is below. */
static void what_is_outside_hides_nothing(void **state)
{
  (void)state;
  const fg__rendering box = make_box();
  const double middle[2] = {0.45, 0.0};
  for (int clipped = 0; clipped < 2; ++clipped) {
    fg__caster plate[4];
    fg__shadow s;
    make_plate(plate, middle, 0.1, 0.45, clipped);       /* above the box */
    make_plate(plate + 2, middle, 0.05, -0.41, clipped); /* below the floor */
    make_shadow(&s, &box, plate, 4);
    double light = light_at(&s, 0.45, 0.0);
    assert_true(clipped ? light > 1.0 - 1e-12 : light < 1e-12);
    fg__shadow_clear(&s);
  }
  fg__caster below[2];
  fg__shadow s;
  make_plate(below, middle, 0.05, -0.41, false);
  make_shadow(&s, &box, below, 2);
  assert_true(light_at(&s, 0.45, 0.0) > 1.0 - 1e-12);
  fg__shadow_clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_are_the_softer_the_higher_the_plate),
      cmocka_unit_test(what_is_outside_hides_nothing),
  };
  return cmocka_run_group_tests_name("picture/render/shadow", tests, NULL, NULL);
}
