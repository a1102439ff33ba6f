/* The reader that continues the tangents harmonically. */
#include "score/picture_test.h"
#include "score/reader.h"

typedef struct bench {
  fg_field *field;
  fg_icons *icons;
  fg__domain_raster raster;
  fg__samples samples;
} bench;

static void set_up(bench *b, fg_context *context, const sampling *box,
                   velocity_of velocity, int count)
{
  *b = (bench){.field = field_of(context, box, velocity), .icons = no_icons(context)};
  assert_int_equal(fg__domain_raster_create(&b->raster, context, b->field, NULL),
                   FG_STATUS_OK);
  if (count > 0)
    add_scribbles(b->icons, context, box, count,
                  0.4 * b->raster.side / pow(count, 1.0 / box->dimension));
}

static void take_samples(bench *b, fg_context *context)
{
  assert_int_equal(
      fg__samples_create(&b->samples, context, &b->raster, b->icons, HUGE_VAL, HUGE_VAL),
      FG_STATUS_OK);
}

static void tear_down(bench *b)
{
  fg__samples_clear(&b->samples);
  fg__domain_raster_clear(&b->raster);
  fg_icons_destroy(b->icons);
  fg_field_destroy(b->field);
}

static fg__harmonic solve(const bench *b, fg_context *context, double tolerance)
{
  fg__harmonic out;
  assert_int_equal(fg__harmonic_create(&out, context, &b->raster, &b->samples, tolerance),
                   FG_STATUS_OK);
  return out;
}

static double error_of(const bench *b, fg_context *context, const fg__harmonic *harmonic)
{
  fg_reader_error error;
  float *angle = calloc(b->raster.cells, sizeof *angle);
  fg__harmonic_angles(angle, &b->raster, harmonic);
  assert_int_equal(fg__reader_error(&error, context, &b->raster, angle), FG_STATUS_OK);
  free(angle);
  return error.mean;
}

static const sampling SOLID = {
    .dimension = 3, .nodes = {12, 9, 14}, .low = {-7, 3, 1}, .high = {5, 11, 6}};

/* Cells without samples are the mean of those beside them in the domain. */
static void check_means(const bench *b, const fg__harmonic *harmonic)
{
  const fg__domain_raster *raster = &b->raster;
  const size_t step[3] = {1, (size_t)raster->size[0],
                          (size_t)raster->size[0] * (size_t)raster->size[1]};
  unsigned char *sampled = calloc(raster->cells, 1);
  size_t free_cells = 0;
  for (size_t n = 0; n < b->samples.count; ++n) {
    size_t place;
    assert_true(fg__domain_raster_find(raster, b->samples.position[n], &place));
    sampled[place] = 1;
  }
  for (size_t n = 0; n < raster->cells; ++n) {
    double mean[3] = {0};
    int count = 0;
    if (!raster->inside[n] || sampled[n] || !harmonic->known[n])
      continue;
    for (int k = 0; k < raster->dimension; ++k) {
      const size_t at = n / step[k] % (size_t)raster->size[k];
      for (int side = 0; side < 2; ++side) {
        const size_t beside = side ? n + step[k] : n - step[k];
        if ((side ? at + 1 == (size_t)raster->size[k] : at == 0) ||
            !raster->inside[beside])
          continue;
        ++count;
        for (int c = 0; c < raster->dimension; ++c)
          mean[c] += harmonic->value[c][beside];
      }
    }
    for (int c = 0; c < raster->dimension; ++c)
      assert_close(mean[c] / count, harmonic->value[c][n], 1e-7);
    ++free_cells;
  }
  assert_true(free_cells > raster->cells / 4);
  free(sampled);
}

static void unsampled_cells_are_the_mean_of_their_neighbours(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN, coast, 9);
  take_samples(&b, *state);
  fg__harmonic harmonic = solve(&b, *state, 1e-9);
  check_means(&b, &harmonic);
  fg__harmonic_clear(&harmonic);
  tear_down(&b);
  set_up(&b, *state, &SOLID, swirl, 9);
  take_samples(&b, *state);
  harmonic = solve(&b, *state, 1e-9);
  check_means(&b, &harmonic);
  fg__harmonic_clear(&harmonic);
  tear_down(&b);
}

static void the_usual_tolerance_is_a_hundredth_of_a_degree(void **state)
{
  static const int counts[] = {1, 6, 40};
  for (int n = 0; n < 3; ++n) {
    bench b;
    set_up(&b, *state, &PLAIN, n % 2 ? coast : swirl, counts[n]);
    take_samples(&b, *state);
    fg__harmonic usual = solve(&b, *state, 0), tight = solve(&b, *state, 1e-9);
    assert_close(error_of(&b, *state, &usual), error_of(&b, *state, &tight), 0.01);
    fg__harmonic_clear(&usual);
    fg__harmonic_clear(&tight);
    tear_down(&b);
  }
}

/* Between a line up and a line down the reader goes linearly from one to the other. */
static void between_parallel_lines_values_are_linear(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN, slant, 0);
  add_straight(b.icons, *state, -4, 3, -4, 11);
  add_straight(b.icons, *state, 3, 11, 3, 3);
  take_samples(&b, *state);
  fg__harmonic harmonic = solve(&b, *state, 1e-9);
  const int row = b.raster.size[1] / 3;
  for (int i = 0; i < b.raster.size[0]; ++i) {
    const double x = b.raster.origin[0] + (i + 0.5) * b.raster.cell[0];
    const double expected = x < -4 ? 1 : x > 3 ? -1 : 1 - 2 * (x + 4) / 7;
    const size_t place = (size_t)row * (size_t)b.raster.size[0] + (size_t)i;
    assert_close(harmonic.value[1][place], expected, 2 * b.raster.cell[0] / 7);
    assert_close(harmonic.value[0][place], 0, 1e-9);
  }
  fg__harmonic_clear(&harmonic);
  tear_down(&b);
}

static void tangents_that_cancel_fix_nothing(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN, slant, 0);
  add_straight(b.icons, *state, 0, 8, 1, 8);
  add_straight(b.icons, *state, 1, 8, 0, 8);
  add_straight(b.icons, *state, -5, 9, -5, 10);
  take_samples(&b, *state);
  fg__harmonic harmonic = solve(&b, *state, 0);
  for (size_t n = 0; n < b.raster.cells; ++n) {
    assert_close(harmonic.value[0][n], 0, 1e-3);
    assert_close(harmonic.value[1][n], 1, 1e-3);
  }
  fg__harmonic_clear(&harmonic);
  tear_down(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(unsampled_cells_are_the_mean_of_their_neighbours),
      CASE(the_usual_tolerance_is_a_hundredth_of_a_degree),
      CASE(between_parallel_lines_values_are_linear),
      CASE(tangents_that_cancel_fix_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
