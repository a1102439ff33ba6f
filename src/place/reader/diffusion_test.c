#include "place/reader/diffusion.h"

#include "place/fields_test.h"

typedef struct setting {
  fg_context *context;
  fg_field *field;
  fg__place_domain domain;
  fg__place_scale scale;
  fg__place_raster raster;
  fg__place_diffusion reader;
} setting;

static void set(setting *s, fg_context *context, const sampling *box,
                velocity_of velocity, int count)
{
  *s = (setting){.context = context, .field = field_of(context, box, velocity)};
  assert_int_equal(fg__place_domain_create(&s->domain, context, s->field), FG_STATUS_OK);
  s->scale = fg__place_scale_of(&s->domain, count, true, FG__PLACE_FINE);
  assert_int_equal(fg__place_raster_create(&s->raster, context, &s->domain, &s->scale),
                   FG_STATUS_OK);
  assert_int_equal(
      fg__place_diffusion_create(&s->reader, context, &s->raster, &s->domain, &s->scale),
      FG_STATUS_OK);
}

static void clear(setting *s)
{
  fg__place_diffusion_clear(&s->reader);
  fg__place_raster_clear(&s->raster);
  fg__place_domain_clear(&s->domain);
  fg_field_destroy(s->field);
}

/* A straight line along x with tangents of its own, at heights in lambda. */
static fg__place_line line_at(double y, double z, double length, double start,
                              const double tangent[3])
{
  fg__place_line line = {.count = FG__PLACE_SAMPLES};
  for (int n = 0; n < line.count; ++n) {
    line.position[0][n] = (float)(start + (n + 0.5) * length / line.count);
    line.position[1][n] = (float)y;
    line.position[2][n] = (float)z;
    for (int k = 0; k < 3; ++k)
      line.tangent[k][n] = (float)tangent[k];
  }
  return line;
}

/* Gives each sample the share that its piece of the line has of a sampling step. */
static void share(fg__place_line *line, const setting *s, double length)
{
  for (int n = 0; n < line->count; ++n)
    line->share[n] =
        (float)(length / line->count / (s->scale.sampling / s->scale.lambda));
}

static void solve(setting *s, int times)
{
  for (int n = 0; n < times; ++n)
    assert_int_equal(fg__place_diffusion_solve(&s->reader, s->context, false),
                     FG_STATUS_OK);
}

/* Between two lines that reach from wall to wall the harmonic field is linear; beyond
 * them it is theirs. */
static void fields_between_two_lines_are_linear(void **state)
{
  setting s;
  set(&s, *state, &PLAIN, slant, 12);
  const double lambda = s.scale.lambda;
  const double width = (s.domain.high[0] - s.domain.low[0]) / lambda;
  const double height = (s.domain.high[1] - s.domain.low[1]) / lambda;
  const double low = 0.3 * height, high = 0.8 * height;
  fg__place_line one = line_at(low, 0, width, 0, (const double[3]){0.8, 0.6, 0});
  fg__place_line two = line_at(high, 0, width, 0, (const double[3]){-0.28, 0.96, 0});
  share(&one, &s, width);
  share(&two, &s, width);
  fg__place_diffusion_add(&s.reader, &one);
  fg__place_diffusion_add(&s.reader, &two);
  solve(&s, 12);
  int compared = 0;
  for (int y = 0; y < s.raster.cells[1]; ++y) {
    double at = (y + 0.5) * (double)s.raster.cell;
    double t = fmax(0, fmin(1, (at - low) / (high - low)));
    if (at > height)
      break;
    for (int x = 1; x + 1 < s.raster.cells[0]; ++x, ++compared) {
      size_t n = (size_t)y * (size_t)s.raster.cells[0] + (size_t)x;
      if (s.reader.faces[n] == 0.0F)
        continue;
      assert_close((double)s.reader.value[0][n], 0.8 * (1 - t) - 0.28 * t, 0.05);
      assert_close((double)s.reader.value[1][n], 0.6 * (1 - t) + 0.96 * t, 0.05);
      const double value[2] = {(double)s.reader.value[0][n],
                               (double)s.reader.value[1][n]};
      const double flow[2] = {(double)s.raster.direction[0][n],
                              (double)s.raster.direction[1][n]};
      if (s.raster.weight[n] > 0.0F)
        assert_close((double)(s.reader.error[n] / s.raster.weight[n]),
                     degrees_between(value, flow, 2), 0.05);
    }
  }
  assert_true(compared > 500);
  clear(&s);
}

/* A trial's growth is what a solution of the whole with the new line has more, and
 * what is kept becomes that solution. */
static void trials_agree_with_whole_solutions(setting *s, const double place[][3],
                                              int lines)
{
  fg__place_line line[8];
  const double lambda = s->scale.lambda;
  for (int n = 0; n < lines; ++n) {
    const fg__place_seed seed = {{place[n][0], place[n][1], place[n][2]},
                                 {0.6 * lambda, 0.5 * lambda}};
    fg__place_trace(&line[n], &s->domain, &s->scale, &seed);
    assert_true(line[n].count > 0);
  }
  for (int n = 0; n + 1 < lines; ++n)
    fg__place_diffusion_add(&s->reader, &line[n]);
  solve(s, 12);
  double before = fg__place_diffusion_sum(&s->reader), growth;
  assert_int_equal(fg__place_diffusion_try(&growth, &s->reader.window, &s->reader,
                                           s->context, &line[0], &line[lines - 1]),
                   FG_STATUS_OK);
  assert_true(fg__place_diffusion_sum(&s->reader) == before); /* a trial only */
  fg__place_diffusion_keep(&s->reader, &s->reader.window, &line[0], &line[lines - 1]);
  assert_close(fg__place_diffusion_sum(&s->reader), before + growth, 1e-4 * before);
  solve(s, 12);
  double after = fg__place_diffusion_sum(&s->reader);
  assert_true(fabs(after - before) > 0.01 * before);
  /* a window and few steps see at least a third of it with so few lines */
  assert_true(growth / (after - before) > 0.33 && growth / (after - before) < 1.2);
  /* the same lines from the start */
  fg__place_diffusion again;
  assert_int_equal(
      fg__place_diffusion_create(&again, s->context, &s->raster, &s->domain, &s->scale),
      FG_STATUS_OK);
  for (int n = 1; n < lines; ++n)
    fg__place_diffusion_add(&again, &line[n]);
  for (int n = 0; n < 12; ++n)
    assert_int_equal(fg__place_diffusion_solve(&again, s->context, false), FG_STATUS_OK);
  assert_close(after, fg__place_diffusion_sum(&again), 2e-3 * after);
  fg__place_diffusion_clear(&again);
}

static void trials_agree_with_whole_solutions_in_the_plane(void **state)
{
  static const double place[][3] = {{-1.2, 7.1}, {-5, 5},    {-4.6, 9},   {1.4, 4.6},
                                    {1.1, 9.2},  {3.4, 6.8}, {-2.1, 4.2}, {-0.4, 6.2}};
  setting s;
  set(&s, *state, &PLAIN, swirl, 8);
  trials_agree_with_whole_solutions(&s, place, 8);
  clear(&s);
}

static void trials_agree_with_whole_solutions_in_space(void **state)
{
  static const double place[][3] = {
      {-4.3, 5.1, 0.4}, {-3.1, 4.2, 1.1}, {-5.2, 6.3, -0.7}, {-5.5, 4.4, 1.4}};
  setting s;
  set(&s, *state, &SOLID, swirl, 4);
  trials_agree_with_whole_solutions(&s, place, 4);
  clear(&s);
}

/* Five channels across the box, as wide as they are far apart, or not. */
static void channels(const double position[3], double v[3])
{
  static const double edge[][2] = {
      {0.3, 0.8}, {2.1, 2.5}, {2.9, 5.2}, {7.7, 8.1}, {11.0, 11.6}};
  v[0] = (double)NAN;
  v[1] = 1.0;
  for (size_t n = 0; n < sizeof edge / sizeof *edge; ++n)
    if (position[0] > edge[n][0] - 0.01 && position[0] < edge[n][1] + 0.01)
      v[0] = 0.5;
}

/* Where one line holds a channel, its tangent is all that is read there; all channels are
 * solved, wherever in a row they begin. */
static void every_part_of_a_domain_is_read(void **state)
{
  static const sampling box = {
      .dimension = 2, .nodes = {121, 11}, .low = {0, 0}, .high = {12, 1}};
  setting s;
  set(&s, *state, &box, channels, 12);
  const double width = 12.0 / s.scale.lambda;
  fg__place_line line =
      line_at(0.4 / s.scale.lambda, 0, width, 0, (const double[3]){0.6, 0.8, 0});
  share(&line, &s, width);
  fg__place_diffusion_add(&s.reader, &line);
  solve(&s, 12);
  int inside = 0, first = 0;
  for (size_t n = 0; n < s.raster.count; ++n) {
    const bool in = s.reader.faces[n] > 0.0F;
    inside += in;
    first += in && (n == 0 || !(s.reader.faces[n - 1] > 0.0F));
    assert_close((double)s.reader.value[0][n], in ? 0.6 : 0.0, 0.01);
    assert_close((double)s.reader.value[1][n], in ? 0.8 : 0.0, 0.01);
  }
  assert_true(s.raster.cells[0] > 100 && inside > 300);
  assert_true(first >= 5 * (s.raster.cells[1] - 2));
  clear(&s);
}

/* Without lines nothing is read: a right angle everywhere, and no value outside. */
static void nothing_is_read_without_lines(void **state)
{
  setting s;
  set(&s, *state, &PLAIN, coast, 17);
  solve(&s, 1);
  assert_close(fg__place_diffusion_sum(&s.reader), 90.0 * s.scale.count, 0.1);
  const fg__place_seed seed = {{1.3, 8.1}, {0.5 * s.scale.lambda, 0.5 * s.scale.lambda}};
  fg__place_line line;
  fg__place_trace(&line, &s.domain, &s.scale, &seed);
  double growth;
  assert_int_equal(fg__place_diffusion_try(&growth, &s.reader.window, &s.reader,
                                           s.context, NULL, &line),
                   FG_STATUS_OK);
  assert_true(growth < -1);
  fg__place_diffusion_keep(&s.reader, &s.reader.window, NULL, &line);
  for (size_t n = 0; n < s.raster.count; ++n)
    if (s.reader.faces[n] == 0.0F)
      assert_true(s.reader.value[0][n] == 0.0F && s.reader.value[1][n] == 0.0F);
  assert_int_equal(fg__place_diffusion_try(&growth, &s.reader.window, &s.reader,
                                           s.context, NULL, NULL),
                   FG_STATUS_OK);
  assert_true(growth == 0.0);
  clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(fields_between_two_lines_are_linear),
      CASE(trials_agree_with_whole_solutions_in_the_plane),
      CASE(trials_agree_with_whole_solutions_in_space),
      CASE(every_part_of_a_domain_is_read),
      CASE(nothing_is_read_without_lines),
  };
  return cmocka_run_group_tests_name("place/reader/reader/diffusion", tests, NULL, NULL);
}
