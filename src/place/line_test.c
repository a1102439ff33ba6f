#include "place/line.h"

#include "place/fields_test.h"

typedef struct setting {
  fg_field *field;
  fg__place_domain domain;
  fg__place_scale scale;
} setting;

static setting set(fg_context *context, const sampling *box, velocity_of velocity,
                   int count)
{
  setting s = {.field = field_of(context, box, velocity)};
  assert_int_equal(fg__place_domain_create(&s.domain, context, s.field), FG_STATUS_OK);
  s.scale = fg__place_scale_of(&s.domain, count, true, FG__PLACE_FINE);
  return s;
}

static void clear(setting *s)
{
  fg__place_domain_clear(&s->domain);
  fg_field_destroy(s->field);
}

static void point_of(double out[3], const setting *s, const fg__place_line *line, int n)
{
  for (int k = 0; k < 3; ++k)
    out[k] = s->domain.low[k] + (double)line->position[k][n] * s->scale.lambda;
}

static double arc_of(const setting *s, const fg__place_line *line)
{
  double sum = 0.0, a[3], b[3];
  for (int n = 1; n < line->count; ++n) {
    point_of(a, s, line, n - 1);
    point_of(b, s, line, n);
    sum += distance_between(a, b, s->domain.dimension);
  }
  return sum;
}

static void a_line_round_a_vortex_is_an_arc(void **state)
{
  setting s = set(*state, &PLAIN, vortex, 25);
  const double radius = 1.3 * s.scale.lambda, way[2] = {0.31, 1.07};
  fg__place_seed seed = {{EYE[0] + radius * cos(0.7), EYE[1] + radius * sin(0.7)}, {0}};
  for (int k = 0; k < 2; ++k)
    seed.way[k] = way[k] * s.scale.lambda;
  fg__place_line line;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  assert_true(line.count > 10);
  for (int n = 0; n < line.count; ++n) {
    double p[3];
    point_of(p, &s, &line, n);
    const double out[2] = {p[0] - EYE[0], p[1] - EYE[1]};
    const double t[2] = {(double)line.tangent[0][n], (double)line.tangent[1][n]};
    assert_close(hypot(out[0], out[1]), radius, 2e-3 * s.scale.lambda);
    const double around[2] = {-out[1], out[0]};
    assert_close(degrees_between(t, around, 2), 0, 0.1);
  }
  /* from tail to tip, the seed on it, as far as its ways */
  double p[3], share = 0.0;
  const double angle = radius / s.scale.lambda;
  point_of(p, &s, &line, 0);
  assert_close(atan2(p[1] - EYE[1], p[0] - EYE[0]), 0.7 - way[0] / angle, 3e-3);
  point_of(p, &s, &line, line.count - 1);
  assert_close(atan2(p[1] - EYE[1], p[0] - EYE[0]), 0.7 + way[1] / angle, 3e-3);
  point_of(p, &s, &line, line.seed);
  assert_close(distance_between(p, seed.position, 2), 0, 1e-5);
  for (int k = 0; k < 2; ++k)
    assert_close(line.way[k], seed.way[k], 1e-9);
  assert_close(line.length, (way[0] + way[1]) * s.scale.lambda, 1e-9);
  for (int n = 0; n < line.count; ++n)
    share += (double)line.share[n] * s.scale.sampling;
  assert_close(share, line.length, 1e-5);
  clear(&s);
}

static void a_line_ends_where_it_has_turned_enough(void **state)
{
  setting s = set(*state, &PLAIN, vortex, 12);
  const double radius = 0.25 * s.scale.lambda;
  const fg__place_seed seed = {{EYE[0] + radius, EYE[1]},
                               {0.95 * s.scale.lambda, 0.4 * s.scale.lambda}};
  fg__place_line line;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  /* against the flow 165 degrees, less a step at most; along it its way */
  assert_true(line.way[0] <= 165.5 * DEGREE * radius);
  assert_true(line.way[0] >= 165 * DEGREE * radius - s.scale.sampling);
  assert_close(line.way[1], seed.way[1], 1e-9);
  assert_close(line.length, arc_of(&s, &line), 0.03 * line.length);
  clear(&s);
}

static void lines_keep_off_walls(void **state)
{
  setting s = set(*state, &PLAIN, slant, 40);
  unsigned random = 3;
  const double far = s.scale.lambda;
  int ended = 0, refused = 0;
  for (int n = 0; n < 500; ++n) {
    const fg__place_seed seed = {
        {-7 + 12 * next_random(&random), 3 + 8 * next_random(&random)}, {far, far}};
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.scale, &seed);
    const double *at = seed.position;
    double room = fmin(fmin(at[0] + 7, 5 - at[0]), fmin(at[1] - 3, 11 - at[1]));
    if (room < 0.99 * s.scale.clearance)
      assert_int_equal(line.count, 0);
    refused += line.count == 0;
    for (int i = 0; i < line.count; ++i) {
      double p[3];
      point_of(p, &s, &line, i);
      double clear_of = fmin(fmin(p[0] + 7, 5 - p[0]), fmin(p[1] - 3, 11 - p[1]));
      assert_true(clear_of >= s.scale.clearance - 1e-4);
    }
    /* it goes as near as the halves of a step allow */
    if (line.count > 0 && line.way[1] < far - 1e-9) {
      double p[3];
      point_of(p, &s, &line, line.count - 1);
      double ahead = fmin(5 - p[0], 11 - p[1]);
      assert_true(ahead < s.scale.clearance + s.scale.sampling);
      ++ended;
    }
  }
  assert_true(ended > 50 && refused > 10 && refused < 250);
  clear(&s);
}

/* To both sides of a line at which the flow meets itself. */
static void clash(const double position[3], double v[3])
{
  v[0] = EYE[0] - position[0];
  v[1] = 1e-4;
}

static void a_line_ends_before_the_flow_reverses_or_breaks(void **state)
{
  setting s = set(*state, &PLAIN, clash, 12);
  const double lambda = s.scale.lambda;
  const fg__place_seed seed = {{EYE[0] - 0.6 * lambda, EYE[1]}, {lambda, lambda}};
  fg__place_line line;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  assert_true(line.count > 0);
  assert_true(line.way[1] < 0.62 * lambda && line.way[1] > 0.3 * lambda);
  for (int n = 0; n < line.count; ++n)
    assert_true((double)line.tangent[0][n] > 0.99);
  clear(&s);
}

/* To the right, but for a step to the left that is shorter than a sample of a line. */
static const sampling CLOSE = {
    .dimension = 2, .nodes = {241, 161}, .low = {-7, 3}, .high = {5, 11}};

static void stair(const double position[3], double v[3])
{
  bool step = fabs(position[0] - EYE[0]) < 0.01;
  v[0] = step ? 0.1 : 1.0;
  v[1] = step ? 1.0 : 0.0;
}

static void a_line_ends_before_it_breaks_between_samples(void **state)
{
  setting s = set(*state, &CLOSE, stair, 12);
  const double lambda = s.scale.lambda;
  const fg__place_seed seed = {{EYE[0] - 0.45 * lambda, EYE[1]}, {0.4 * lambda, lambda}};
  fg__place_line line;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  assert_true(line.count > 0);
  assert_true(line.way[1] < 0.46 * lambda && line.way[1] > 0.3 * lambda);
  clear(&s);
}

/* To the right, and from x = 1 on 70 degrees up. */
static void elbow(const double position[3], double v[3])
{
  const double angle = position[0] < 1.0 ? 0.0 : 70.0 / 57.29577951308232;
  v[0] = cos(angle);
  v[1] = sin(angle);
  v[2] = 0;
}

/* A head is not on a short piece behind an elbow; a longer one stays. */
static void a_line_ends_before_a_hook(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {81, 71}, .low = {-3, 4}, .high = {5, 11}};
  setting s = set(*state, &box, elbow, 25);
  const struct {
    double behind; /* lambda */
    bool goes_on;
  } cases[] = {{0.2, false}, {0.3, false}, {0.6, true}, {0.9, true}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const double before = 0.7 * s.scale.lambda;
    fg__place_seed seed = {
        {1.0 - before, 5.0},
        {0.2 * s.scale.lambda, before + cases[n].behind * s.scale.lambda}};
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.scale, &seed);
    assert_true(line.count > 2);
    double end[3];
    point_of(end, &s, &line, line.count - 1);
    assert_int_equal(end[0] > 1.0, cases[n].goes_on);
    assert_true(end[0] > 1.0 - 0.3 * s.scale.lambda);
  }
  clear(&s);
}

static void too_short_a_line_is_none(void **state)
{
  setting s = set(*state, &PLAIN, slant, 30);
  fg__place_line line;
  fg__place_seed seed = {{-1, 7}, {0.24 * s.scale.lambda, 0.24 * s.scale.lambda}};
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  assert_int_equal(line.count, 0);
  seed.way[1] = 0.3 * s.scale.lambda;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  assert_true(line.count > 0);
  clear(&s);
}

/* Where the way of a fine line comes nearest to a point. */
static double distance_to_line(const double (*points)[3], int count,
                               const double point[3], int dimension)
{
  double least = HUGE_VAL;
  for (int n = 1; n < count; ++n) {
    double dot = 0.0, square = 0.0, foot[3] = {0};
    for (int k = 0; k < dimension; ++k) {
      double piece = points[n][k] - points[n - 1][k];
      dot += piece * (point[k] - points[n - 1][k]);
      square += piece * piece;
    }
    double t = square > 0.0 ? fmax(0.0, fmin(1.0, dot / square)) : 0.0;
    for (int k = 0; k < dimension; ++k)
      foot[k] = points[n - 1][k] + t * (points[n][k] - points[n - 1][k]);
    least = fmin(least, distance_between(foot, point, dimension));
  }
  return least;
}

/* Another direction at each place: no two steps agree. */
static void noise(const double p[3], double v[3])
{
  double angle = 40.0 * sin(12.9898 * p[0] + 78.233 * p[1]);
  v[0] = cos(angle);
  v[1] = sin(angle);
}

static void compare_fine(fg_context *context, const sampling *box, velocity_of velocity,
                         int count, int trials)
{
  setting s = set(context, box, velocity, count);
  int dimension = s.domain.dimension, lines = 0;
  unsigned random = 9;
  for (int n = 0; n < trials; ++n) {
    fg__place_seed seed = {{0},
                           {(0.2 + 0.8 * next_random(&random)) * s.scale.lambda,
                            (0.2 + 0.8 * next_random(&random)) * s.scale.lambda}};
    for (int k = 0; k < dimension; ++k)
      seed.position[k] =
          box->low[k] + (box->high[k] - box->low[k]) * next_random(&random);
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.scale, &seed);
    if (line.count == 0)
      continue;
    double(*fine)[3], arc = 0.0;
    int fine_count;
    assert_int_equal(
        fg__place_trace_fine(&fine, &fine_count, context, &s.domain, &s.scale, &line),
        FG_STATUS_OK);
    assert_true(fine_count >= 2);
    for (int i = 0; i < line.count; ++i) {
      double p[3];
      point_of(p, &s, &line, i);
      assert_true(distance_to_line((const double(*)[3])fine, fine_count, p, dimension) <
                  0.06 * s.scale.lambda);
    }
    for (int i = 1; i < fine_count; ++i)
      arc += distance_between(fine[i - 1], fine[i], dimension);
    assert_close(arc, line.length, 0.06 * s.scale.lambda);
    free(fine);
    ++lines;
  }
  assert_true(lines > trials / 5);
  clear(&s);
}

static void a_fine_line_is_the_coarse_one(void **state)
{
  compare_fine(*state, &PLAIN, swirl, 60, 100);
  compare_fine(*state, &SOLID, swirl, 30, 100);
  compare_fine(*state, &PLAIN, noise, 60, 4000);
}

/* Waves a few samples long across a stream: it turns by tens of degrees in a cell. */
static void rough(const double p[3], double v[3])
{
  v[0] =
      1.3 + 0.9 * sin(7.0 * p[0] + 3.0 * p[1]) + 0.7 * sin(2.0 - 5.0 * p[0] + 9.0 * p[1]);
  v[1] = 0.2 + 0.9 * cos(6.0 * p[0] - 8.0 * p[1]) + 0.7 * sin(4.0 * p[0] + 7.0 * p[1]);
}

/* Mean angle between a polyline's pieces and the flow along them, degrees. */
static double mean_angle_to_flow(const setting *s, const double (*points)[3], int count)
{
  double sum = 0.0, length = 0.0;
  for (int n = 1; n < count; ++n) {
    double piece[3], size = distance_between(points[n - 1], points[n], 2);
    for (int k = 0; k < 3; ++k)
      piece[k] = points[n][k] - points[n - 1][k];
    for (int i = 0; i < 8; ++i) {
      double place[3], flow[3];
      for (int k = 0; k < 3; ++k)
        place[k] = points[n - 1][k] + (i + 0.5) / 8 * piece[k];
      assert_true(fg__place_direction(&s->domain, place, flow));
      sum += size / 8 * degrees_between(piece, flow, 2);
    }
    length += size;
  }
  return sum / length;
}

static void a_fine_line_follows_a_rough_flow(void **state)
{
  setting s = set(*state, &PLAIN, rough, 12);
  unsigned random = 5;
  int lines = 0;
  for (int n = 0; n < 60; ++n) {
    fg__place_seed seed = {{0}, {0.9 * s.scale.lambda, 0.9 * s.scale.lambda}};
    for (int k = 0; k < 2; ++k)
      seed.position[k] =
          PLAIN.low[k] + (PLAIN.high[k] - PLAIN.low[k]) * next_random(&random);
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.scale, &seed);
    if (line.count == 0)
      continue;
    double(*fine)[3];
    int count;
    assert_int_equal(
        fg__place_trace_fine(&fine, &count, *state, &s.domain, &s.scale, &line),
        FG_STATUS_OK);
    assert_true(mean_angle_to_flow(&s, (const double(*)[3])fine, count) < 0.5);
    free(fine);
    ++lines;
  }
  assert_true(lines > 20);
  clear(&s);
}

/* Lines of one place are the same, whichever of them were traced before. */
static void lines_of_one_place_share_their_steps(void **state)
{
  setting s = set(*state, &PLAIN, rough, 12);
  unsigned random = 11;
  int lines = 0, shorter = 0;
  for (int n = 0; n < 60; ++n) {
    fg__place_seed seed = {{0}, {0}};
    fg__place_steps steps = {.count = {0}};
    for (int k = 0; k < 2; ++k)
      seed.position[k] =
          PLAIN.low[k] + (PLAIN.high[k] - PLAIN.low[k]) * next_random(&random);
    for (int trial = 0; trial < 6; ++trial) {
      fg__place_line alone, line;
      for (int k = 0; k < 2; ++k)
        seed.way[k] = (0.2 + 0.8 * next_random(&random)) * s.scale.lambda;
      const int before = steps.count[1];
      fg__place_trace(&alone, &s.domain, &s.scale, &seed);
      fg__place_trace_on(&line, &s.domain, &s.scale, &seed, &steps);
      assert_int_equal(line.count, alone.count);
      if (line.count == 0)
        continue;
      for (int k = 0; k < 3; ++k) {
        const size_t size = (size_t)line.count * sizeof(float);
        assert_memory_equal(line.position[k], alone.position[k], size);
        assert_memory_equal(line.tangent[k], alone.tangent[k], size);
      }
      assert_memory_equal(line.way, alone.way, sizeof line.way);
      assert_true(steps.count[1] >= before);
      shorter += before > 1 && steps.count[1] == before;
      ++lines;
    }
  }
  assert_true(lines > 100 && shorter > 50);
  clear(&s);
}

/* Traces through a seed a lambda to the right of the eye; *points is allocated. */
static int trace_beside_eye(double (**points)[3], double *radius, const setting *s,
                            fg_context *context)
{
  *radius = s->scale.lambda;
  fg__place_seed seed = {{EYE[0] + *radius, EYE[1]},
                         {0.5 * s->scale.lambda, 0.7 * s->scale.lambda}};
  fg__place_line line;
  int count;
  fg__place_trace(&line, &s->domain, &s->scale, &seed);
  assert_true(line.count > 7);
  assert_int_equal(
      fg__place_trace_fine(points, &count, context, &s->domain, &s->scale, &line),
      FG_STATUS_OK);
  return count;
}

static void a_fine_line_has_the_points_that_its_shape_needs(void **state)
{
  double(*points)[3], radius;
  setting s = set(*state, &PLAIN, slant, 25);
  int count = trace_beside_eye(&points, &radius, &s, *state);
  assert_in_range(count, 2, 5);
  free(points);
  clear(&s);
  s = set(*state, &PLAIN, vortex, 25);
  count = trace_beside_eye(&points, &radius, &s, *state);
  /* 69 degrees of an arc, whose pieces turn by 0.7 */
  assert_in_range(count, 86, 110);
  for (int n = 1; n < count; ++n) {
    const double along[2] = {points[n][0] - points[n - 1][0],
                             points[n][1] - points[n - 1][1]};
    const double around[2] = {EYE[1] - points[n][1], points[n][0] - EYE[0]};
    assert_close(degrees_between(along, around, 2), 0, 0.41);
    assert_close(hypot(around[0], around[1]), radius, 1e-3 * s.scale.lambda);
  }
  free(points);
  clear(&s);
}

static void a_ring_closes_and_a_spiral_does_not(void **state)
{
  setting s = set(*state, &PLAIN, vortex, 12);
  const double start[3] = {EYE[0] + 0.9, EYE[1] - 0.3};
  double gap, diameter, radius = hypot(0.9, 0.3);
  assert_true(fg__place_close(&gap, &diameter, &s.domain, &s.scale, start, radius));
  assert_true(gap < 0.06 * diameter);
  assert_close(diameter, 2 * radius, 0.02);
  clear(&s);
  s = set(*state, &PLAIN, drain, 12);
  assert_true(fg__place_close(&gap, &diameter, &s.domain, &s.scale, start, radius));
  assert_close(gap, radius * (1 - exp(-0.06 * 2 * 180 * DEGREE)), 0.06 * radius);
  clear(&s);
  s = set(*state, &PLAIN, slant, 12);
  assert_false(fg__place_close(&gap, &diameter, &s.domain, &s.scale, start, radius));
  clear(&s);
}

static void turns_add_up_as_vectors(void **state)
{
  (void)state;
  double arc[60][3], bend[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}};
  for (int n = 0; n < 60; ++n) {
    arc[n][0] = 3 * cos(0.09 * n);
    arc[n][1] = 3 * sin(0.09 * n);
    arc[n][2] = 0;
  }
  assert_close(fg__place_turning((const double(*)[3])arc, 60), 58 * 0.09, 0.02);
  assert_close(fg__place_turning((const double(*)[3])bend, 3), 90 * DEGREE, 1e-3);
  /* there and back again: a wave does not turn */
  for (int n = 0; n < 60; ++n)
    arc[n][1] = sin(2 * 180 * DEGREE * n / 59), arc[n][0] = 2.0 * n / 59;
  assert_close(fg__place_turning((const double(*)[3])arc, 60), 0, 0.02);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(a_line_round_a_vortex_is_an_arc),
      CASE(a_line_ends_where_it_has_turned_enough),
      CASE(lines_keep_off_walls),
      CASE(a_line_ends_before_the_flow_reverses_or_breaks),
      CASE(a_line_ends_before_it_breaks_between_samples),
      CASE(a_line_ends_before_a_hook),
      CASE(too_short_a_line_is_none),
      CASE(a_fine_line_is_the_coarse_one),
      CASE(a_fine_line_follows_a_rough_flow),
      CASE(lines_of_one_place_share_their_steps),
      CASE(a_fine_line_has_the_points_that_its_shape_needs),
      CASE(a_ring_closes_and_a_spiral_does_not),
      CASE(turns_add_up_as_vectors),
  };
  return cmocka_run_group_tests_name("place/line", tests, NULL, NULL);
}
