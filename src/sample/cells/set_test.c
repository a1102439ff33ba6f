/* Cells together, and the raster over them. */
#include "sample/cells/set_example.h"

static double of_points(const double p[3])
{
  return p[0] * p[1] * p[2];
}

enum { N = 5, NODES = N * N * N };

/* Points of a box whose inner ones are moved, so that cells are warped and yet fill it.
 */
static fg__cell_set warped_box(fg_context *context, double amount)
{
  double position[3 * NODES];
  for (int n = 0; n < NODES; ++n) {
    const int at[3] = {n % N, n / N % N, n / N / N};
    for (int k = 0; k < 3; ++k) {
      const bool boundary = at[k] == 0 || at[k] == N - 1;
      position[3 * n + k] =
          (k + 1.0) * at[k] + (boundary ? 0.0 : amount * sin(5.0 * n + k));
    }
  }
  fg__cell_set set = set_of(context, position, NODES);
  for (int k = 0; k < N - 1; ++k)
    for (int j = 0; j < N - 1; ++j)
      for (int i = 0; i < N - 1; ++i) {
        const int c = (k * N + j) * N + i, up = N * N;
        const int corner[] = {c,      c + 1,      c + 1 + N,      c + N,
                              c + up, c + up + 1, c + up + 1 + N, c + up + N};
        if ((i + j + k) % 2) { /* as two wedges */
          const int low[] = {corner[0], corner[1], corner[3],
                             corner[4], corner[5], corner[7]};
          const int high[] = {corner[2], corner[3], corner[1],
                              corner[6], corner[7], corner[5]};
          add(&set, FG__CELL_WEDGE, low);
          add(&set, FG__CELL_WEDGE, high);
        } else {
          add(&set, FG__CELL_HEXAHEDRON, corner);
        }
      }
  return set;
}

static void cells_leave_no_gap_between_them(void **state)
{
  fg__cell_set set = warped_box(*state, 0.0);
  locate(&set);
  assert_int_equal(set.dimension, 3);
  float *value = sample(&set, linear);
  for (size_t n = 0; n < samples_of(&set); ++n) {
    double p[3];
    position_of(p, &set, n);
    assert_true(fabs((double)value[n] - linear(p)) < 1e-4);
  }
  free(value);
  fg__cell_set_clear(&set);
}

static void warped_cells_keep_linear_fields(void **state)
{
  fg__cell_set set = warped_box(*state, 0.25);
  locate(&set);
  float *value = sample(&set, linear);
  size_t missing = 0;
  for (size_t n = 0; n < samples_of(&set); ++n) {
    double p[3];
    position_of(p, &set, n);
    missing += isnan(value[n]) ? 1 : 0;
    assert_true(isnan(value[n]) || fabs((double)value[n] - linear(p)) < 1e-4);
  }
  /* a warped face is not the plane that a wedge has there, which leaves slits */
  assert_true(missing < samples_of(&set) / 50);
  free(value);
  fg__cell_set_clear(&set);
}

/* A NaN in one of them hides the point. */
static void means_of_cells_are_those_of_the_cells_round_a_point(void **state)
{
  static const double position[] = {0, 0, 5, 1, 0, 5, 3, 0, 5, 0, 2, 5, 1, 2, 5, 3, 2, 5};
  static const int left[] = {0, 1, 4, 3}, low[] = {1, 2, 5}, high[] = {1, 5, 4};
  fg__cell_set set = set_of(*state, position, 6);
  add(&set, FG__CELL_QUAD, left);
  add(&set, FG__CELL_TRIANGLE, low);
  add(&set, FG__CELL_TRIANGLE, high);
  float of_point[6];
  const float of_cell[3] = {1.0f, 10.0f, 100.0f};
  assert_int_equal(fg__cell_set_to_points(of_point, &set, of_cell), FG_STATUS_OK);
  const float expected[6] = {1.0f, 37.0f, 10.0f, 1.0f, 50.5f, 55.0f};
  for (int p = 0; p < 6; ++p)
    assert_true(of_point[p] == expected[p]);
  const float hidden[3] = {1.0f, NAN, 100.0f};
  assert_int_equal(fg__cell_set_to_points(of_point, &set, hidden), FG_STATUS_OK);
  assert_true(isnan(of_point[1]) && isnan(of_point[2]) && isnan(of_point[5]));
  assert_true(of_point[0] == 1.0f && of_point[4] == 50.5f);
  locate(&set);
  assert_int_equal(set.flat, 2);
  assert_true(set.size[2] == 1 && set.origin[2] == 5.0);
  fg__cell_set_clear(&set);
}

/* Triangles in each of the three planes; no sample beyond their slanting edge. */
static void planes_lie_across_any_axis(void **state)
{
  for (int flat = 0; flat < 3; ++flat) {
    double position[9] = {0};
    const int x = (flat + 1) % 3, y = (flat + 2) % 3;
    static const int corner[] = {0, 1, 2};
    for (int p = 0; p < 3; ++p)
      position[3 * p + flat] = -2.5;
    position[3 + x] = 4.0;
    position[6 + y] = 3.0;
    fg__cell_set set = set_of(*state, position, 3);
    add(&set, FG__CELL_TRIANGLE, corner);
    locate(&set);
    assert_true(set.dimension == 2 && set.flat == flat && set.size[flat] == 1);
    float *value = sample(&set, linear);
    for (size_t n = 0; n < samples_of(&set); ++n) {
      double p[3];
      position_of(p, &set, n);
      const double beyond = p[x] / 4.0 + p[y] / 3.0 - 1.0;
      assert_true(isnan(value[n]) == (beyond > 1e-3));
      assert_true(isnan(value[n]) || fabs((double)value[n] - linear(p)) < 1e-5);
    }
    free(value);
    fg__cell_set_clear(&set);
  }
}

/* One layer of hexahedra is a plane, with the mean of its two sides. */
static void a_layer_is_the_plane_in_its_middle(void **state)
{
  double position[36];
  for (int n = 0; n < 12; ++n) {
    position[3 * n] = 2.0 * (n % 3) + 0.3 * (n / 3 % 2);
    position[3 * n + 1] = n / 6 ? 5.0 : 4.0;
    position[3 * n + 2] = 3.0 * (n / 3 % 2) + 0.5 * (n % 3);
  }
  static const int left[] = {0, 1, 4, 3, 6, 7, 10, 9},
                   right[] = {1, 2, 5, 4, 7, 8, 11, 10};
  fg__cell_set set = set_of(*state, position, 12);
  add(&set, FG__CELL_HEXAHEDRON, left);
  add(&set, FG__CELL_HEXAHEDRON, right);
  locate(&set);
  assert_true(set.dimension == 2 && set.flat == 1);
  float *value = sample(&set, linear);
  size_t inside = 0;
  for (size_t n = 0; n < samples_of(&set); ++n) {
    double p[3];
    position_of(p, &set, n);
    assert_true(p[1] == 4.5);
    inside += isnan(value[n]) ? 0 : 1;
    assert_true(isnan(value[n]) || fabs((double)value[n] - linear(p)) < 1e-5);
  }
  assert_true(inside > samples_of(&set) / 2 && inside < samples_of(&set));
  free(value);
  fg__cell_set_clear(&set);
}

static void refuse(fg__cell_set *set, fg_status status, const char *words)
{
  const fg_status got = fg__cell_set_locate(set);
  if (got != status || !strstr(fg_context_message(set->context), words))
    fail_msg("%d: %s", got, fg_context_message(set->context));
  fg__cell_set_clear(set);
}

static void sets_that_fill_nothing_are_refused(void **state)
{
  static const int corner[] = {0, 1, 2, 3, 4, 5, 6, 7}, same[8] = {0};
  double position[24] = {0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 1, 1};
  fg__cell_set set = set_of(*state, position, 8);
  set.numbers = 12;
  refuse(&set, FG_STATUS_UNSUPPORTED, "none of its 12 cells");
  set = set_of(*state, position, 8);
  set.position[11] = 0.5;
  add(&set, FG__CELL_QUAD, corner);
  refuse(&set, FG_STATUS_UNSUPPORTED, "that is not plane");
  set = set_of(*state, position, 8);
  add(&set, FG__CELL_HEXAHEDRON, same);
  refuse(&set, FG_STATUS_UNSUPPORTED, "fill no volume");
  set = set_of(*state, position, 8);
  add(&set, FG__CELL_TRIANGLE, (const int[]){0, 1, 1});
  refuse(&set, FG_STATUS_UNSUPPORTED, "fill no area");
  position[4] = (double)NAN;
  set = set_of(*state, position, 8);
  add(&set, FG__CELL_QUAD, corner);
  refuse(&set, FG_STATUS_FILE_FORMAT, "corner 1 of cell 0 is at");
  position[4] = 1e300;
  set = set_of(*state, position, 8);
  add(&set, FG__CELL_QUAD, corner);
  refuse(&set, FG_STATUS_FILE_FORMAT, "corner 1 of cell 0 is at");
}

/* A hundred cells that all fill the box would take a hundred times as long. */
static void cells_over_each_other_are_refused(void **state)
{
  fg__cell_set set = warped_box(*state, 0.1);
  static const int all[] = {0,           N - 1,           N * N - 1,
                            N * (N - 1), N * N * (N - 1), NODES - N * N + N - 1,
                            NODES - 1,   NODES - N};
  for (int i = 0; i < 40; ++i)
    add(&set, FG__CELL_HEXAHEDRON, all);
  locate(&set); /* unusual, but it can be done */
  free(set.place);
  set.place = NULL;
  for (int i = 0; i < 40; ++i)
    add(&set, FG__CELL_HEXAHEDRON, all);
  refuse(&set, FG_STATUS_FILE_FORMAT, "lie over each other");
}

/* Cells without a volume, folded cells and faces of others leave all else as it is. */
static void cells_that_fill_nothing_are_left_out(void **state)
{
  fg__cell_set sound = warped_box(*state, 0.0), set = warped_box(*state, 0.0);
  add(&set, FG__CELL_HEXAHEDRON, (const int[]){0, 1, 2, 3, 0, 1, 2, 3});
  add(&set, FG__CELL_TETRAHEDRON, (const int[]){0, 1, 2, 3});
  add(&set, FG__CELL_QUAD, (const int[]){0, 1, N + 1, N});
  add(&set, FG__CELL_HEXAHEDRON, (const int[]){7, 7, 7, 7, 7, 7, 7, 7});
  locate(&sound);
  locate(&set);
  assert_memory_equal(sound.size, set.size, sizeof set.size);
  float *a = sample(&sound, of_points), *b = sample(&set, of_points);
  for (size_t n = 0; n < samples_of(&set); ++n)
    assert_true(fabsf(a[n] - b[n]) < 1e-4f);
  free(a);
  free(b);
  fg__cell_set_clear(&sound);
  fg__cell_set_clear(&set);
}

/* However small some cells are, the raster is not too large, and has their box. */
static void the_raster_has_an_upper_limit(void **state)
{
  enum { LINES = 25 };
  double position[3 * LINES * LINES];
  for (int n = 0; n < LINES * LINES; ++n) {
    position[3 * n] = pow(1.6, n % LINES);
    position[3 * n + 1] = -3.0 * pow(1.6, n / LINES);
    position[3 * n + 2] = 0.0;
  }
  fg__cell_set set = set_of(*state, position, (size_t)LINES * LINES);
  for (int n = 0; n < LINES * (LINES - 1); ++n)
    if (n % LINES < LINES - 1)
      add(&set, FG__CELL_QUAD, (const int[]){n, n + 1, n + 1 + LINES, n + LINES});
  locate(&set);
  assert_int_equal(set.flat, 2);
  assert_true(samples_of(&set) <= 1 << 20 && samples_of(&set) > 1 << 19);
  const double end = set.origin[0] + set.spacing[0] * (set.size[0] - 1);
  assert_true(fabs(end - pow(1.6, LINES - 1)) < 1e-6 * end);
  float *value = sample(&set, linear);
  for (size_t n = 0; n < samples_of(&set); ++n)
    assert_true(!isnan(value[n]));
  free(value);
  fg__cell_set_clear(&set);
}

/* Each is looked at with every sample in its box: a few cells in one place, made fine by
 * small ones, get a coarser raster. */
static void few_cells_over_each_other_have_few_samples(void **state)
{
  enum { LARGE = 12, SMALL = 24, CELLS = LARGE + SMALL };
  static const int round[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  double position[3 * 8 * CELLS];
  for (int n = 0; n < 8 * CELLS; ++n)
    for (int k = 0; k < 3; ++k)
      position[3 * n + k] =
          n / 8 < LARGE ? round[n % 8][k] : 0.01 * (n / 8 + round[n % 8][k]);
  fg__cell_set set = set_of(*state, position, 8 * CELLS);
  for (int c = 0; c < CELLS; ++c) {
    int corner[8];
    for (int i = 0; i < 8; ++i)
      corner[i] = 8 * c + i;
    add(&set, FG__CELL_HEXAHEDRON, corner);
  }
  locate(&set);
  const size_t samples = samples_of(&set);
  assert_true(samples > 1 << 16 && samples * LARGE < 1 << 21);
  float *value = sample(&set, linear);
  for (size_t n = 0; n < samples; ++n) {
    double p[3];
    position_of(p, &set, n);
    assert_true(fabs((double)value[n] - linear(p)) < 1e-4);
  }
  free(value);
  fg__cell_set_clear(&set);
}

/* The narrower of two cells would have the wider one in 80,000 samples along an axis. */
static void a_narrow_cell_makes_no_large_raster(void **state)
{
  static const double position[] = {0,    0, 0, 1e-4, 0, 0, 1, 0, 0,
                                    1e-4, 1, 0, 0,    1, 0, 1, 1, 0};
  static const int narrow[] = {0, 1, 3, 4}, wide[] = {1, 2, 5, 3};
  fg__cell_set set = set_of(*state, position, 6);
  add(&set, FG__CELL_QUAD, narrow);
  add(&set, FG__CELL_QUAD, wide);
  locate(&set);
  assert_true(samples_of(&set) > 1 << 14 && samples_of(&set) < 1 << 17);
  float *value = sample(&set, linear);
  for (size_t n = 0; n < samples_of(&set); ++n)
    assert_true(!isnan(value[n]));
  free(value);
  fg__cell_set_clear(&set);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_leave_no_gap_between_them),
      cmocka_unit_test(warped_cells_keep_linear_fields),
      cmocka_unit_test(means_of_cells_are_those_of_the_cells_round_a_point),
      cmocka_unit_test(planes_lie_across_any_axis),
      cmocka_unit_test(a_layer_is_the_plane_in_its_middle),
      cmocka_unit_test(sets_that_fill_nothing_are_refused),
      cmocka_unit_test(cells_over_each_other_are_refused),
      cmocka_unit_test(cells_that_fill_nothing_are_left_out),
      cmocka_unit_test(the_raster_has_an_upper_limit),
      cmocka_unit_test(few_cells_over_each_other_have_few_samples),
      cmocka_unit_test(a_narrow_cell_makes_no_large_raster),
  };
  return cmocka_run_group_tests_name("sample/cells/set", tests, context_set_up,
                                     context_tear_down);
}
