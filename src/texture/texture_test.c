/* What holds for every kind of texture. */
#include <string.h>

#include "texture/painted_test.h"

typedef struct promise {
  fg_texture_kind kind;
  const char *name;
  double along;   /* least correlation of pixels 6 apart along the stream */
  double across;  /* most of those as far apart across it */
  double turning; /* most degrees between streaks and stream */
  double uneven;  /* most ratio of spreads within large squares */
  double middle;  /* mean of all pixels */
  double off;     /* most distance of a large square's mean from it */
  double still;   /* least ratio of spreads in a still place and elsewhere */
} promise;

static const promise promises[] = {
    {FG_TEXTURE_LIC, "lic", 0.6, 0.15, 2.0, 1.2, 0.5, 0.06, 0.7},
    {FG_TEXTURE_SPOTS, "spots", 0.6, 0.15, 3.0, 1.2, 0.5, 0.06, 0.7},
    {FG_TEXTURE_CLUSTERS, "clusters", 0.6, 0.15, 3.0, 1.4, 0.69, 0.2, 0.1},
    {FG_TEXTURE_DIFFUSION, "diffusion", 0.6, 0.15, 2.0, 1.2, 0.5, 0.06, 0.7},
    {FG_TEXTURE_STRIPES, "stripes", 0.6, 0.15, 3.0, 1.2, 0.5, 0.06, 0.7},
};
enum { KINDS = sizeof promises / sizeof *promises };

static fg_texture_options options_of(const promise *p, int longest)
{
  return (fg_texture_options){
      .kind = p->kind, .longest = longest, .length = 40.0, .clusters = 200, .threads = 2};
}

static void test_lies_along_the_stream(void **state)
{
  for (int k = 0; k < KINDS; ++k) {
    const promise *p = &promises[k];
    const fg_texture_options options = options_of(p, 360);
    /* five pixels to the right, four up */
    const formula f = {straight, 38.65980825409009, false};
    fg_texture *texture = texture_of(*state, &f, &options);
    const fg_texture_arrays *t = fg_texture_contents(texture);
    const double along = correlation(t, 5, 4), across = correlation(t, -4, 5);
    if (along < p->along || across > p->across)
      fail_msg("%s: correlation %g along, %g across", p->name, along, across);
    fg_texture_destroy(texture);
  }
}

static void test_turns_with_the_field(void **state)
{
  static const double angles[] = {0.0, 70.0, 151.0};
  for (int k = 0; k < KINDS; ++k)
    for (size_t n = 0; n < sizeof angles / sizeof *angles; ++n) {
      const fg_texture_options options = options_of(&promises[k], 300);
      const formula f = {straight, angles[n], false};
      fg_texture *texture = texture_of(*state, &f, &options);
      const fg_texture_arrays *t = fg_texture_contents(texture);
      const double angle = streaks_angle(t, whole_of(t));
      if (angle_between(angle, angles[n]) > promises[k].turning)
        fail_msg("%s: streaks at %g degrees in a stream at %g", promises[k].name, angle,
                 angles[n]);
      fg_texture_destroy(texture);
    }
}

/* Round the swirl's centre streaks lie across the line to it. */
static void check_turning(const fg_texture_arrays *t, const promise *p)
{
  const int center[2] = {340, 220}; /* of pixels of 1/200 */
  for (int n = 0; n < 8; ++n) {
    const double angle = n * acos(-1.0) / 4.0;
    const int x = center[0] + (int)(150.0 * cos(angle)),
              y = center[1] + (int)(150.0 * sin(angle));
    const double streaks = streaks_angle(t, (part){{x - 16, y - 16}, {32, 32}});
    if (angle_between(streaks, 45.0 * n + 90.0) > 5.0 * p->turning)
      fail_msg("%s: streaks at %g degrees where the stream has %g", p->name, streaks,
               45.0 * n + 90.0);
  }
}

static void check_contrast(const fg_texture_arrays *t, const promise *p)
{
  enum { SIDE = 100 };
  assert_int_equal(t->size[0], 600);
  assert_int_equal(t->size[1], 400);
  double least = HUGE_VAL, most = 0.0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 6; ++i) {
      const part square = {{SIDE * i, SIDE * j}, {SIDE, SIDE}};
      const double deviation = spread_within(t, square), mean = mean_of(t, square);
      least = fmin(least, deviation);
      most = fmax(most, deviation);
      if (fabs(mean - p->middle) > p->off)
        fail_msg("%s: mean %g in square (%d, %d)", p->name, mean, i, j);
    }
  if (!(least > 0.15) || most > p->uneven * least)
    fail_msg("%s: spreads from %g to %g", p->name, least, most);
}

static void test_follows_a_curved_stream_with_even_contrast(void **state)
{
  for (int k = 0; k < KINDS; ++k) {
    const fg_texture_options options = options_of(&promises[k], 600);
    const formula f = {swirl, 0.0, false};
    fg_texture *texture = texture_of(*state, &f, &options);
    check_turning(fg_texture_contents(texture), &promises[k]);
    check_contrast(fg_texture_contents(texture), &promises[k]);
    fg_texture_destroy(texture);
  }
}

/* Mean difference of the pixels of two columns. */
static double step_between(const fg_texture_arrays *t, int i, int other)
{
  double sum = 0.0;
  for (int j = 0; j < t->size[1]; ++j)
    sum += fabs(value_at(t, i, j) - value_at(t, other, j));
  return sum / t->size[1];
}

static void test_periodic_boundary_has_no_seam(void **state)
{
  for (int k = 0; k < KINDS; ++k) {
    const fg_texture_options options = options_of(&promises[k], 300);
    const formula f = {waves, 180.0, true};
    fg_texture *texture = texture_of(*state, &f, &options);
    const fg_texture_arrays *t = fg_texture_contents(texture);
    double most = 0.0;
    for (int i = 0; i + 1 < t->size[0]; ++i)
      most = fmax(most, step_between(t, i, i + 1));
    const double seam = step_between(t, t->size[0] - 1, 0);
    if (seam > most)
      fail_msg("%s: a step of %g at the boundary, of at most %g inside", promises[k].name,
               seam, most);
    fg_texture_destroy(texture);
  }
}

static void test_missing_and_still_places(void **state)
{
  for (int k = 0; k < KINDS; ++k) {
    const fg_texture_options options = options_of(&promises[k], 300);
    const formula f = {holes, 20.0, false};
    fg_texture *texture = texture_of(*state, &f, &options);
    const fg_texture_arrays *t = fg_texture_contents(texture);
    for (int j = 0; j < t->size[1]; ++j)
      for (int i = 0; i < t->size[0]; ++i) {
        const double x = 10.0 + 0.01 * (i + 0.5), y = -2.0 + 0.01 * (j + 0.5);
        const float speed = t->speed[(size_t)j * (size_t)t->size[0] + (size_t)i];
        /* cells with a missing corner are missing: samples are 1/8 apart */
        assert_int_equal(isnan(speed), x < 11.0 && y < -1.125);
        if (x > 12.25 && y > -0.75)
          assert_true(speed == 0.0F);
        assert_true(value_at(t, i, j) >= 0.0 && value_at(t, i, j) <= 1.0);
      }
    /* a still place is as rich as the rest, and shows no direction */
    const part still = {{235, 135}, {60, 60}}, moving = {{130, 20}, {60, 60}};
    const double ratio = spread_within(t, still) / spread_within(t, moving);
    if (ratio < promises[k].still || ratio > 1.4)
      fail_msg("%s: spread %g times that of moving places", promises[k].name, ratio);
    fg_texture_destroy(texture);
  }
}

static bool alike(const fg_texture *one, const fg_texture *other)
{
  const fg_texture_arrays *a = fg_texture_contents(one), *b = fg_texture_contents(other);
  const size_t count = (size_t)a->size[0] * (size_t)a->size[1];
  assert_int_equal(a->size[0], b->size[0]);
  assert_int_equal(a->size[1], b->size[1]);
  return memcmp(a->value, b->value, count * sizeof *a->value) == 0 &&
         memcmp(a->speed, b->speed, count * sizeof *a->speed) == 0;
}

static void test_threads_and_seeds(void **state)
{
  for (int k = 0; k < KINDS; ++k) {
    const formula f = {holes, 20.0, true};
    fg_texture_options options = options_of(&promises[k], 150);
    options.threads = 1;
    fg_texture *alone = texture_of(*state, &f, &options);
    options.threads = 3;
    fg_texture *shared = texture_of(*state, &f, &options);
    assert_true(alike(alone, shared));
    options.seed = 2;
    fg_texture *other = texture_of(*state, &f, &options);
    assert_false(alike(alone, other));
    fg_texture_destroy(alone);
    fg_texture_destroy(shared);
    fg_texture_destroy(other);
  }
}

static void assert_refused(fg_context *context, const fg_field *field,
                           const fg_texture_options *options, fg_status expected)
{
  fg_texture *texture = NULL;
  assert_int_equal(fg_texture_create(&texture, context, field, options), expected);
  assert_null(texture);
  assert_string_not_equal(fg_context_message(context), "");
  fg_context_clear(context);
}

static void test_refusals(void **state)
{
  static const fg_texture_options wrong[] = {
      {.longest = 3},     {.longest = 20000},
      {.size = {10, -1}}, {.size = {20000, 5}},
      {.length = 1.0},    {.length = (double)NAN},
      {.threads = -1},    {.kind = (fg_texture_kind)99},
  };
  const formula f = {swirl, 0.0, false};
  fg_field *field = field_of(*state, &f);
  for (size_t n = 0; n < sizeof wrong / sizeof *wrong; ++n)
    assert_refused(*state, field, &wrong[n], FG_STATUS_ARGUMENT);
  assert_refused(*state, NULL, NULL, FG_STATUS_ARGUMENT);
  fg_field_destroy(field);
  assert_int_equal(fg_field_create_analytic(&field, *state, "abc", 5), FG_STATUS_OK);
  assert_refused(*state, field, NULL, FG_STATUS_UNSUPPORTED);
  fg_field_destroy(field);
}

/* Along a straight stream a smooth kernel leaves hardly any change from pixel to pixel.
 */
static void test_diffusion_has_no_dots(void **state)
{
  static const int steps[][2] = {{2, 0}, {1, 1}, {2, 1}, {1, 2}};
  for (size_t n = 0; n < sizeof steps / sizeof *steps; ++n) {
    const fg_texture_options options = {
        .kind = FG_TEXTURE_DIFFUSION, .longest = 400, .length = 60.0, .threads = 2};
    const formula f = {straight, atan2(steps[n][1], steps[n][0]) * 180.0 / acos(-1.0),
                       false};
    fg_texture *texture = texture_of(*state, &f, &options);
    const double left =
        1.0 - correlation(fg_texture_contents(texture), steps[n][0], steps[n][1]);
    if (left > 0.012)
      fail_msg("(%d, %d): %g of the contrast", steps[n][0], steps[n][1], left);
    fg_texture_destroy(texture);
  }
}

/* What is not given of a size follows from the domain's shape: 3 x 2 here. */
static void test_sizes(void **state)
{
  static const struct {
    int longest, size[2], made[2];
  } cases[] = {
      {60, {0, 0}, {60, 40}},
      {60, {30, 0}, {30, 20}},
      {60, {0, 30}, {45, 30}},
      {0, {17, 31}, {17, 31}},
  };
  const formula f = {swirl, 0.0, false};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg_texture_options options = {.longest = cases[n].longest,
                                        .size = {cases[n].size[0], cases[n].size[1]}};
    fg_texture *texture = texture_of(*state, &f, &options);
    for (int k = 0; k < 2; ++k)
      assert_int_equal(fg_texture_contents(texture)->size[k], cases[n].made[k]);
    fg_texture_destroy(texture);
  }
}

/* As large as the streaks, or a single row. */
static void test_tiny_pictures(void **state)
{
  static const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {16, 11}};
  for (int k = 0; k < KINDS; ++k)
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; ++n) {
      const fg_texture_options options = {
          .kind = promises[k].kind, .size = {sizes[n][0], sizes[n][1]}, .threads = 2};
      const formula f = {waves, 180.0, n % 2 == 0};
      fg_texture *texture = texture_of(*state, &f, &options);
      const fg_texture_arrays *t = fg_texture_contents(texture);
      for (int j = 0; j < t->size[1]; ++j)
        for (int i = 0; i < t->size[0]; ++i)
          assert_true(value_at(t, i, j) >= 0.0 && value_at(t, i, j) <= 1.0);
      fg_texture_destroy(texture);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lies_along_the_stream),
      cmocka_unit_test(test_turns_with_the_field),
      cmocka_unit_test(test_follows_a_curved_stream_with_even_contrast),
      cmocka_unit_test(test_periodic_boundary_has_no_seam),
      cmocka_unit_test(test_missing_and_still_places),
      cmocka_unit_test(test_threads_and_seeds),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_diffusion_has_no_dots),
      cmocka_unit_test(test_sizes),
      cmocka_unit_test(test_tiny_pictures),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
