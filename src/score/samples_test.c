#include "score/picture_test.h"
#include "score/samples.h"

typedef struct bench {
  fg_field *field;
  fg__domain_raster raster;
  fg_icons *icons;
  fg__samples samples;
} bench;

static void set_up(bench *b, fg_context *context, const sampling *box)
{
  *b = (bench){.field = field_of(context, box, swirl), .icons = no_icons(context)};
  assert_int_equal(fg__domain_raster_create(&b->raster, context, b->field, NULL),
                   FG_STATUS_OK);
}

static void take(bench *b, fg_context *context, double longest, double all)
{
  fg__samples_clear(&b->samples);
  assert_int_equal(
      fg__samples_create(&b->samples, context, &b->raster, b->icons, longest, all),
      FG_STATUS_OK);
}

static void tear_down(bench *b)
{
  fg__samples_clear(&b->samples);
  fg__domain_raster_clear(&b->raster);
  fg_icons_destroy(b->icons);
  fg_field_destroy(b->field);
}

/* An angle of legs 3 and 2. */
static const double ANGLE[3][3] = {{-5, 4, 9}, {-2, 4, 9}, {-2, 6, 9}};

static void samples_are_middles_of_equal_pieces_with_their_directions(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN);
  add_line(b.icons, *state, ANGLE, 3);
  take(&b, *state, HUGE_VAL, HUGE_VAL);
  const size_t count = b.samples.count;
  assert_int_equal(count, (size_t)ceil(5 / (0.5 * b.raster.spacing)));
  for (size_t n = 0; n < count; ++n) {
    const double s = 5 * ((double)n + 0.5) / (double)count;
    assert_close(b.samples.position[n][0], s < 3 ? -5 + s : -2, 1e-12);
    assert_close(b.samples.position[n][1], s < 3 ? 4 : 4 + s - 3, 1e-12);
    assert_close(b.samples.position[n][2], 0, 0);
    if (fabs(s - 3) > b.raster.spacing)
      assert_close(b.samples.tangent[n][s < 3 ? 0 : 1], 1, 1e-12);
  }
  assert_close(b.samples.length, 5, 1e-12);
  tear_down(&b);
}

static void lines_are_cut_about_their_middles(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN);
  add_line(b.icons, *state, ANGLE, 3);
  take(&b, *state, 2, HUGE_VAL);
  /* from 1.5 to 3.5 along it */
  const size_t last = b.samples.count - 1;
  const double half = 1.0 / (double)b.samples.count;
  assert_close(b.samples.position[0][0], -5 + 1.5 + half, 1e-12);
  assert_close(b.samples.position[last][1], 4 + 0.5 - half, 1e-12);
  assert_close(b.samples.longest, 2, 1e-12);
  tear_down(&b);
}

static void ink_is_taken_from_the_longest(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN);
  add_straight(b.icons, *state, -6, 4, -6, 5);
  add_straight(b.icons, *state, -6, 9, -1, 9);
  add_straight(b.icons, *state, -4, 5, 0, 5);
  /* lengths 1, 5, 4: 7 is 1 + 3 + 3 */
  take(&b, *state, HUGE_VAL, 7);
  assert_close(b.samples.length, 7, 1e-12);
  assert_close(b.samples.shortest, 1, 1e-12);
  assert_close(b.samples.longest, 3, 1e-12);
  /* 9.5 is 1 + 4.5 + 4 */
  take(&b, *state, HUGE_VAL, 9.5);
  assert_close(b.samples.longest, 4.5, 1e-12);
  /* not all of them reach 1 */
  take(&b, *state, HUGE_VAL, 1.5);
  assert_close(b.samples.shortest, 0.5, 1e-12);
  take(&b, *state, HUGE_VAL, 11);
  assert_close(b.samples.length, 10, 1e-12);
  tear_down(&b);
}

static void what_lies_outside_counts_as_outside(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN);
  add_straight(b.icons, *state, 4, 8, 8, 8); /* the box ends at 5 */
  take(&b, *state, HUGE_VAL, HUGE_VAL);
  const double all = (double)(b.samples.count + b.samples.outside);
  assert_close((double)b.samples.outside / all, 0.75, 1 / all);
  for (size_t n = 0; n < b.samples.count; ++n)
    assert_true(b.samples.position[n][0] <= 5);
  tear_down(&b);
}

static void periods_are_taken_off(void **state)
{
  sampling box = PLAIN;
  box.round = true;
  bench b;
  set_up(&b, *state, &box);
  const double period = fg_field_contents(b.field)->period[0];
  add_straight(b.icons, *state, -7 + 2.5 * period, 5, -7 + 2.5 * period + 0.3, 5);
  add_straight(b.icons, *state, -7.5, 7, -6.5, 7); /* across the side */
  take(&b, *state, HUGE_VAL, HUGE_VAL);
  assert_int_equal(b.samples.outside, 0);
  for (size_t n = 0; n < b.samples.count; ++n) {
    const double x = b.samples.position[n][0];
    assert_true(x >= -7 && x < -7 + period);
    if (n < b.samples.first[1])
      assert_close(x, -7 + 0.5 * period + 0.15, 0.15);
  }
  const double last = b.samples.position[b.samples.first[1]][0];
  assert_close(last, -7.5 + period, 0.5 * b.raster.spacing);
  tear_down(&b);
}

static void a_point_and_a_line_without_end(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN);
  add_straight(b.icons, *state, 1, 8, 1, 8);
  take(&b, *state, HUGE_VAL, HUGE_VAL);
  assert_int_equal(b.samples.count, 0);
  add_straight(b.icons, *state, -1e30, 8, 1e30, 8);
  take(&b, *state, 2, HUGE_VAL); /* its middle counts */
  assert_close(b.samples.longest, 2, 1e-12);
  fg__samples samples;
  assert_int_equal(
      fg__samples_create(&samples, *state, &b.raster, b.icons, HUGE_VAL, HUGE_VAL),
      FG_STATUS_ARGUMENT);
  fg__samples_clear(&samples);
  add_straight(b.icons, *state, -1.5e308, 8, 1.5e308, 8);
  assert_int_equal(fg__samples_create(&samples, *state, &b.raster, b.icons, 2, HUGE_VAL),
                   FG_STATUS_ARGUMENT);
  fg__samples_clear(&samples);
  tear_down(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(samples_are_middles_of_equal_pieces_with_their_directions),
      CASE(lines_are_cut_about_their_middles),
      CASE(ink_is_taken_from_the_longest),
      CASE(what_lies_outside_counts_as_outside),
      CASE(periods_are_taken_off),
      CASE(a_point_and_a_line_without_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
