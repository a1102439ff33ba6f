#include "icon/slender.h"

#include "base/context_test.h"
#include "base/vector.h"

enum { POINTS = 41 };

static double points[POINTS][3];

static fg_icon straight(double length)
{
  for (int n = 0; n < POINTS; ++n) {
    double s = length * n / (POINTS - 1);
    points[n][0] = 3.0 - s * 2.0 / 3;
    points[n][1] = 0.5 + s / 3;
    points[n][2] = s * 2.0 / 3;
  }
  return (fg_icon){.point_count = POINTS, .points = (const double(*)[3])points};
}

/* An arc of a circle, which begins at its lowest point. */
static fg_icon arc(double radius, double angle)
{
  for (int n = 0; n < POINTS; ++n) {
    double t = angle * n / (POINTS - 1);
    points[n][0] = radius * sin(t);
    points[n][1] = 7.0;
    points[n][2] = radius * (1.0 - cos(t));
  }
  return (fg_icon){.point_count = POINTS, .points = (const double(*)[3])points};
}

static void arrows_of_all_lengths_are_slender(void **state)
{
  (void)state;
  const double lambda = 0.8;
  for (double share = 0.35; share < 2.05; share += 0.15) {
    fg_icon icon = straight(share * lambda);
    fg__solid_set_slender(&icon, lambda);
    assert_true(icon.width > 0.02 * lambda && icon.width < 0.13 * share * lambda);
    assert_true(icon.tail_width > 0.0 && icon.tail_width < icon.width);
    assert_true(icon.head_width > 2.0 * icon.width && icon.head_width < 3.0 * icon.width);
    assert_true(icon.head_length < 0.45 * share * lambda);
    assert_true(icon.head_length > icon.head_width);
  }
}

static void what_is_longer_is_no_thinner(void **state)
{
  (void)state;
  fg_icon brief = straight(0.3), usual = straight(0.7), longest = straight(1.4);
  fg__solid_set_slender(&longest, 1.0);
  usual = straight(0.7);
  fg__solid_set_slender(&usual, 1.0);
  brief = straight(0.3);
  fg__solid_set_slender(&brief, 1.0);
  assert_true(brief.width < usual.width);
  assert_true(fabs(usual.width - longest.width) < 1e-12);
}

static void bodies_and_heads_follow_narrow_bends(void **state)
{
  (void)state;
  fg_icon wide = arc(0.5, 2.0);
  fg__solid_set_slender(&wide, 1.0);
  fg_icon narrow = arc(0.17, 5.0);
  fg__solid_set_slender(&narrow, 1.0);
  assert_true(narrow.head_length < 0.7 * 0.17 && wide.head_length > 0.19);
  fg_icon ring = arc(0.02, 6.0);
  fg__solid_set_slender(&ring, 1.0);
  assert_true(ring.width / 2 < 0.71 * 0.02 && ring.width > 0.0);
}

/* Two straight halves with a bend of a radius between them. */
static fg_icon elbow(double radius, double angle)
{
  enum { BENT = 21, SIDE = (POINTS - BENT) / 2 };
  for (int n = 0; n < POINTS; ++n) {
    const double t = angle * fmin(fmax((n - SIDE) / (BENT - 1.0), 0.0), 1.0);
    const double before = 0.7 * fmin((double)(n - SIDE) / SIDE, 0.0);
    const double after = 0.7 * fmax((double)(n - POINTS + 1 + SIDE) / SIDE, 0.0);
    points[n][0] = before + radius * sin(t) + after * cos(t);
    points[n][1] = 7.0;
    points[n][2] = radius * (1.0 - cos(t)) + after * sin(t);
  }
  return (fg_icon){.point_count = POINTS, .points = (const double(*)[3])points};
}

static void an_elbow_leaves_the_head_as_it_is(void **state)
{
  (void)state;
  fg_icon line = straight(1.4);
  fg__solid_set_slender(&line, 1.0);
  const double usual = line.head_length;
  line = elbow(0.002, 1.2);
  fg__solid_set_slender(&line, 1.0);
  assert_true(fabs(line.head_length - usual) < 1e-3 * usual);
  line = elbow(0.01, 3.0); /* a hairpin is no arrow's */
  fg__solid_set_slender(&line, 1.0);
  assert_true(line.head_length >= 0.4 * usual);
}

static void what_has_no_length_has_no_width(void **state)
{
  (void)state;
  fg_icon icon = straight(0.0);
  icon.width = 3.0;
  fg__solid_set_slender(&icon, 1.0);
  assert_true(!(icon.width > 0.0) && !(icon.head_length > 0.0));
  icon = straight(1.0);
  fg__solid_set_slender(&icon, 0.0);
  assert_true(!(icon.width > 0.0) && isfinite(icon.width));
}

/* All its measures alike, and only down. */
static void plump_arrows_become_slim(void **state)
{
  (void)state;
  fg_icon usual = straight(1.4);
  fg__solid_set_slender(&usual, 1.0);
  fg_icon plump = usual, slim = usual;
  plump.width = 0.3;
  plump.tail_width = 0.12;
  plump.head_length = 0.6;
  plump.head_width = 0.75;
  fg__solid_slim(&plump, 1.0);
  assert_true(fabs(plump.width - 1.5 * usual.width) < 1e-12);
  assert_true(fabs(plump.head_length - 2.0 * plump.width) < 1e-12);
  assert_true(fabs(plump.head_width - 2.5 * plump.width) < 1e-12);
  assert_true(fabs(plump.tail_width - 0.4 * plump.width) < 1e-12);
  fg__solid_slim(&slim, 1.0);
  assert_memory_equal(&slim, &usual, sizeof slim);
  fg_icon none = {.cluster = 7};
  fg__solid_slim(&none, 1.0);
  assert_true(!(none.width > 0.0) && none.cluster == 7);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arrows_of_all_lengths_are_slender),
      cmocka_unit_test(what_is_longer_is_no_thinner),
      cmocka_unit_test(bodies_and_heads_follow_narrow_bends),
      cmocka_unit_test(plump_arrows_become_slim),
      cmocka_unit_test(an_elbow_leaves_the_head_as_it_is),
      cmocka_unit_test(what_has_no_length_has_no_width),
  };
  return cmocka_run_group_tests_name("icon/slender", tests, NULL, NULL);
}
