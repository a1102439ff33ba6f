/* Scores that can be worked out by hand. */
#include "score/picture_test.h"

static const double PI = 3.14159265358979323846;
static const double DEGREE = 3.14159265358979323846 / 180;

static void assert_reader(const fg_reader_error *error, double expected, double most)
{
  assert_close(error->mean, expected, most);
  assert_close(error->percentile_95, expected, most);
  assert_close(error->speed_weighted, expected, most);
}

static void add_slanted(fg_icons *icons, fg_context *context, double x, double y,
                        double angle, double length)
{
  add_straight(icons, context, x, y, x + length * cos(angle), y + length * sin(angle));
}

static void icons_along_a_uniform_field_tell_all(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  add_slanted(icons, *state, -5, 4, SLANT, 2);
  add_slanted(icons, *state, 1, 8, SLANT, 1);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_int_equal(score.icons, 2);
  assert_close(score.count_length, sqrt(12.0 * 8 / 2), 1e-12);
  assert_reader(&score.diffusion, 0, 1e-4);
  assert_reader(&score.nearest, 0, 1e-4);
  assert_reader(&score.inverse_distance, 0, 1e-4);
  assert_close(score.mean, 0, 1e-4);
  assert_close(score.advection, 0, 1e-6);
  assert_close(score.critical_f1, 1, 0);
  assert_close(score.tangency, 0, 1e-5);
  assert_close(score.outside, 0, 0);
  assert_close(score.clutter, 0, 0);
  assert_close(score.ink, 3 / (2 * sqrt(48)), 1e-12);
  assert_close(score.shortest, 1 / sqrt(48), 1e-12);
  assert_close(score.longest, 2 / sqrt(48), 1e-12);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void icons_at_an_angle_are_wrong_by_it(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  add_slanted(icons, *state, -5, 4, SLANT + 30 * DEGREE, 2);
  add_slanted(icons, *state, 1, 8, SLANT + 30 * DEGREE, 1);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_reader(&score.diffusion, 30, 1e-4);
  assert_reader(&score.nearest, 30, 1e-4);
  assert_reader(&score.inverse_distance, 30, 1e-4);
  assert_close(score.mean, 30, 1e-4);
  assert_close(score.percentile_95, 30, 1e-4);
  assert_close(score.tangency, 30, 1e-5);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static double halton(int n, int base)
{
  double value = 0;
  for (double digit = 1.0 / base; n; n /= base, digit /= base)
    value += digit * (n % base);
  return value;
}

/* How far a particle comes straight on: to the disc or to the box. */
static double way_of(const double start[2], double angle, double radius)
{
  double way = radius;
  const double direction[2] = {cos(angle), sin(angle)};
  for (int k = 0; k < 2; ++k) {
    const double wall = direction[k] > 0 ? PLAIN.high[k] : PLAIN.low[k];
    way = fmin(way, (wall - start[k]) / direction[k]);
  }
  return way;
}

static void particles_go_astray_as_far_as_the_angle_says(void **state)
{
  const double radius = 0.15 * sqrt(96), away = 50 * DEGREE;
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  add_slanted(icons, *state, -5, 4, SLANT + away, 2);
  const fg_score score = score_of(*state, field, icons, NULL);
  double sum = 0;
  for (int n = 1; n <= 500; ++n) {
    const double start[2] = {-7 + 12 * halton(n, 2), 3 + 8 * halton(n, 3)};
    const double a = way_of(start, SLANT, radius);
    const double b = way_of(start, SLANT + away, radius);
    sum += sqrt(a * a + b * b - 2 * a * b * cos(away));
  }
  /* the last step inside the box is left out */
  assert_close(score.advection, sum / 500 / radius, 2e-3);
  assert_true(score.advection > 0.5);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* Up to y = 7 one way, above another, and faster. */
static void two_ways(const double position[3], double v[3])
{
  const double angle = position[1] < 7 ? 0 : 110 * DEGREE;
  v[0] = (position[1] < 7 ? 1 : 3) * cos(angle);
  v[1] = (position[1] < 7 ? 1 : 3) * sin(angle);
}

static void halves_count_by_area_and_by_speed(void **state)
{
  /* rows of data at the boundary: the turn takes 8 / 400 of the height */
  sampling box = PLAIN;
  box.nodes[1] = 401;
  fg_field *field = field_of(*state, &box, two_ways);
  fg_icons *icons = no_icons(*state);
  add_straight(icons, *state, -5, 4, -3, 4);
  add_straight(icons, *state, 0, 5, 1, 5);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_close(score.diffusion.mean, 55, 0.3);
  assert_close(score.diffusion.speed_weighted, 110 * 3 / 4.0, 0.3);
  assert_close(score.diffusion.percentile_95, 110, 1e-4);
  assert_close(score.nearest.mean, 55, 0.3);
  fg_icons_destroy(icons);
  /* an icon in either half, as far from the boundary: nearest tells them apart */
  icons = no_icons(*state);
  add_straight(icons, *state, -2, 5, 0, 5);
  add_straight(icons, *state, -1, 9, -1 + 1e-3 * cos(110 * DEGREE),
               9 + 1e-3 * sin(110 * DEGREE));
  const fg_score_options options = {.count = 1000}; /* short ones: what is near is seen */
  const fg_score both = score_of(*state, field, icons, &options);
  assert_true(both.nearest.mean < 15);
  assert_true(both.nearest.mean > 0.5);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* Two basins with land from x = 0 to x = 1 between. */
static void basins(const double position[3], double v[3])
{
  slant(position, v);
  if (position[0] > 0.01 && position[0] < 0.99)
    v[1] = (double)NAN;
}

static void a_basin_without_an_icon_counts_ninety(void **state)
{
  sampling box = PLAIN;
  box.nodes[0] = 121; /* every 0.1 */
  fg_field *field = field_of(*state, &box, basins);
  fg_icons *icons = no_icons(*state);
  add_slanted(icons, *state, -5, 4, SLANT, 2);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_close(score.count_length, sqrt(11 * 8), 1e-9);
  assert_close(score.diffusion.mean, 90 * 4 / 11.0, 0.3);
  assert_close(score.diffusion.percentile_95, 90, 0);
  assert_reader(&score.nearest, 0, 1e-4);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void without_icons_all_is_ninety(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_icons *icons = no_icons(*state);
  for (int n = 0; n < 2; ++n) {
    const fg_score score = score_of(*state, field, icons, NULL);
    assert_int_equal(score.icons, n);
    assert_reader(&score.diffusion, 90, 0);
    assert_reader(&score.nearest, 90, 0);
    assert_reader(&score.inverse_distance, 90, 0);
    assert_true(isinf(score.void_mean) && isinf(score.void_max));
    assert_true(isnan(score.tangency));
    assert_close(score.ink, 0, 0);
    add_straight(icons, *state, 2, 8, 2, 8); /* a point is none */
  }
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* On the unit square, squares of a fifth: to the middle of one it is 0.3826 of its side
 * on average, (sqrt 2 + asinh 1) / 6. */
static void voids_of_a_lattice(void **state)
{
  const sampling unit = {.dimension = 2, .nodes = {17, 17}, .high = {1, 1}};
  fg_field *field = field_of(*state, &unit, slant);
  fg_icons *icons = no_icons(*state);
  for (int i = 0; i < 25; ++i) {
    const double x = 0.1 + 0.2 * (i % 5), y = 0.1 + 0.2 * (i / 5);
    add_slanted(icons, *state, x, y, SLANT, 1e-6);
  }
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_close(score.count_length, 0.2, 1e-12);
  assert_close(score.void_mean, (sqrt(2) + asinh(1)) / 6, 1e-3);
  assert_close(score.void_max, sqrt(0.5), 0.03);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void clutter_is_the_share_near_another(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  const fg_score_options options = {.lengths = FG_SCORE_FREE, .count = 6};
  /* lambda is 4, near is within 0.4: 2 of 4 and all 3 of 3 but what lies beyond */
  add_straight(icons, *state, -6, 4, -2, 4);
  add_straight(icons, *state, -4, 4.2, -1, 4.2);
  add_straight(icons, *state, 0, 9, 1, 9);
  const fg_score score = score_of(*state, field, icons, &options);
  const double reach = sqrt(0.4 * 0.4 - 0.2 * 0.2);
  assert_close(score.clutter, (2 + reach + 2 + reach) / 8, 0.01);
  fg_icons_destroy(icons);
  icons = no_icons(*state);
  const double hairpin[4][3] = {{-6, 4}, {-3, 4}, {-3, 4.1}, {-6, 4.1}};
  add_line(icons, *state, hairpin, 4);
  add_straight(icons, *state, -6, 4.6, -3, 4.6);
  assert_close(score_of(*state, field, icons, &options).clutter, 0, 0); /* with itself */
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void classes_and_ink_cut_lines(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  fg_score_options options = {.count = 6}; /* lambda is 4 */
  add_straight(icons, *state, -6, 4, 4, 4);
  add_straight(icons, *state, -6, 7, -4, 7);
  add_straight(icons, *state, -2, 7, 10, 7); /* class A leaves it inside, from 2 to 6 */
  fg_score score = score_of(*state, field, icons, &options);
  assert_close(score.ink, (4 + 2 + 4) / 24.0, 1e-12);
  assert_close(score.longest, 1, 1e-12);
  assert_close(score.outside, 1.0 / 10, 0.01);
  options.lengths = FG_SCORE_FREE;
  score = score_of(*state, field, icons, &options);
  assert_close(score.ink, (10 + 2 + 12) / 24.0, 1e-12);
  assert_close(score.longest, 3, 1e-12);
  assert_close(score.outside, 5.0 / 24, 0.01);
  options.ink = 0.75;
  score = score_of(*state, field, icons, &options);
  assert_close(score.ink, 0.75, 1e-12);
  assert_close(score.longest, 2, 1e-12);
  assert_close(score.shortest, 0.5, 1e-12);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* Round (1, 6). */
static void vortex(const double position[3], double v[3])
{
  v[0] = -(position[1] - 6);
  v[1] = position[0] - 1;
}

static void a_ring_tells_of_a_vortex_and_a_line_does_not(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, vortex);
  fg_icons *icons = no_icons(*state);
  double ring[31][3] = {{0}};
  for (int n = 0; n < 31; ++n) {
    ring[n][0] = 1 + 1.2 * cos(2 * PI * n / 36);
    ring[n][1] = 6 + 1.2 * sin(2 * PI * n / 36);
  }
  add_line(icons, *state, (const double(*)[3])ring, 31);
  const fg_score_options options = {.count = 4, .lengths = FG_SCORE_FREE};
  fg_score score = score_of(*state, field, icons, &options);
  assert_close(score.critical_f1, 1, 0);
  assert_true(score.tangency < 4);
  fg_icons_destroy(icons);
  icons = no_icons(*state);
  add_straight(icons, *state, 2, 5, 2, 7);
  score = score_of(*state, field, icons, &options);
  assert_close(score.critical_f1, 0, 0);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* On the map a wind to the north-east goes twice as far in longitude at 60 degrees. */
static void northeast(const double position[3], double v[3])
{
  (void)position;
  v[0] = v[1] = 5;
}

static void directions_are_those_on_the_map(void **state)
{
  const sampling box = {.dimension = 2,
                        .nodes = {9, 9},
                        .low = {10, 59.9},
                        .high = {10.2, 60.1},
                        .scale = FG_SCALE_GEO};
  fg_field *field = field_of(*state, &box, northeast);
  fg_icons *icons = no_icons(*state);
  add_straight(icons, *state, 10.05, 60, 10.05 + 0.04, 60.02);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_close(score.diffusion.mean, 0, 0.1);
  assert_close(score.tangency, 0, 0.1);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void a_period_away_is_the_same_place(void **state)
{
  sampling box = PLAIN;
  box.round = true;
  fg_field *field = field_of(*state, &box, coast);
  const double period = fg_field_contents(field)->period[0];
  fg_score scores[2];
  for (int n = 0; n < 2; ++n) {
    fg_icons *icons = no_icons(*state);
    add_straight(icons, *state, 3 - n * period, 9, 4 - n * period, 10);
    add_straight(icons, *state, 2 + n * period, 4, 2.5 + n * period, 6);
    scores[n] = score_of(*state, field, icons, NULL);
    fg_icons_destroy(icons);
  }
  assert_close(scores[0].mean, scores[1].mean, 1e-6);
  assert_close(scores[0].advection, scores[1].advection, 1e-6);
  assert_close(scores[1].outside, 0, 0);
  fg_field_destroy(field);
}

static void threads_and_less_work_give_the_same(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_icons *icons = no_icons(*state);
  add_scribbles(icons, *state, &PLAIN, 21, 0.9);
  const fg_score one = score_of(*state, field, icons, NULL);
  const fg_score three =
      score_of(*state, field, icons, &(fg_score_options){.threads = 3});
  assert_memory_equal(&one, &three, sizeof one);
  const fg_score part =
      score_of(*state, field, icons, &(fg_score_options){.readers_only = true});
  assert_memory_equal(&one.diffusion, &part.diffusion, sizeof one.diffusion);
  assert_close(part.mean, one.mean, 0);
  assert_close(part.ink, one.ink, 0);
  assert_true(isnan(part.advection) && isnan(part.critical_f1) && isnan(part.void_max));
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static const sampling SOLID = {
    .dimension = 3, .nodes = {12, 9, 14}, .low = {-7, 3, 1}, .high = {5, 11, 6}};

static void upwards(const double position[3], double v[3])
{
  (void)position;
  v[0] = 1;
  v[1] = 2;
  v[2] = 2;
}

static void solids_are_scored_likewise(void **state)
{
  fg_field *field = field_of(*state, &SOLID, upwards);
  fg_icons *icons = no_icons(*state);
  /* 2/3 is the cosine of the angle to (0, 0, 1) */
  const double angle = acos(2 / 3.0) / DEGREE;
  const double lines[2][2][3] = {{{-3, 5, 2}, {-3, 5, 3}}, {{2, 8, 3}, {2, 8, 5}}};
  add_line(icons, *state, lines[0], 2);
  add_line(icons, *state, lines[1], 2);
  const fg_score score = score_of(*state, field, icons, NULL);
  assert_close(score.count_length, cbrt(12 * 8 * 5 / 2.0), 1e-9);
  assert_reader(&score.diffusion, angle, 1e-4);
  assert_reader(&score.nearest, angle, 1e-4);
  assert_reader(&score.inverse_distance, angle, 1e-4);
  assert_close(score.tangency, angle, 1e-4);
  assert_close(score.ink, 3 / (2 * cbrt(240)), 1e-9);
  assert_true(isnan(score.critical_f1));
  assert_true(score.advection > 0.4 && score.advection < 2 * sin(angle / 2 * DEGREE));
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* Two cells at opposite corners of a huge box. */
static void corners(const double position[3], double v[3])
{
  const bool low = position[0] < 1.5 && position[1] < 1.5;
  const bool high = position[0] > 997.5 && position[1] > 997.5;
  v[0] = low || high ? 1 : (double)NAN;
  v[1] = 0;
}

static void what_makes_no_sense_is_refused(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  const fg_score_options wrong[] = {
      {.lengths = (fg_score_class)2}, {.count = -1},     {.ink = -0.5},
      {.ink = (double)NAN},           {.ink = HUGE_VAL}, {.threads = -1}};
  fg_score score;
  for (size_t n = 0; n < sizeof wrong / sizeof wrong[0]; ++n) {
    fg_context_clear(*state);
    assert_int_equal(fg_icons_score(&score, *state, field, icons, &wrong[n]),
                     FG_STATUS_ARGUMENT);
    assert_non_null(strstr(fg_context_message(*state), "score: "));
  }
  assert_int_equal(fg_icons_score(NULL, *state, field, icons, NULL), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_icons_score(&score, *state, NULL, icons, NULL), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_icons_score(&score, *state, field, NULL, NULL), FG_STATUS_ARGUMENT);
  fg_field_destroy(field);
  const sampling wide = {.dimension = 2, .nodes = {1000, 1000}, .high = {999, 999}};
  field = field_of(*state, &wide, corners);
  assert_int_equal(fg_icons_score(&score, *state, field, icons, NULL),
                   FG_STATUS_UNSUPPORTED);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void a_stop_ends_it(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, slant);
  fg_icons *icons = no_icons(*state);
  fg_score score;
  fg_context_stop(*state);
  assert_int_equal(fg_icons_score(&score, *state, field, icons, NULL), FG_STATUS_STOPPED);
  assert_int_equal(score.icons, 0);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(icons_along_a_uniform_field_tell_all),
      CASE(icons_at_an_angle_are_wrong_by_it),
      CASE(particles_go_astray_as_far_as_the_angle_says),
      CASE(halves_count_by_area_and_by_speed),
      CASE(a_basin_without_an_icon_counts_ninety),
      CASE(without_icons_all_is_ninety),
      CASE(voids_of_a_lattice),
      CASE(clutter_is_the_share_near_another),
      CASE(classes_and_ink_cut_lines),
      CASE(a_ring_tells_of_a_vortex_and_a_line_does_not),
      CASE(directions_are_those_on_the_map),
      CASE(a_period_away_is_the_same_place),
      CASE(threads_and_less_work_give_the_same),
      CASE(solids_are_scored_likewise),
      CASE(what_makes_no_sense_is_refused),
      CASE(a_stop_ends_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
