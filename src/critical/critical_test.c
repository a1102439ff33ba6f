/* Critical points of fields whose points are known. */
#include "critical/field_test.h"
#include "flowgrain/critical.h"

/* Off the middle of a box that is no square. */
static const double CENTRE[2] = {-1.37, 6.81};
static const sampling BOX = {
    .dimension = 2, .nodes = {61, 41}, .low = {-7, 3}, .high = {5, 11}};

static double matrix[2][2];

static void linear(const double position[3], double v[3])
{
  const double x = position[0] - CENTRE[0], y = position[1] - CENTRE[1];
  for (int k = 0; k < 2; ++k)
    v[k] = matrix[k][0] * x + matrix[k][1] * y;
}

static fg_critical_points *points_of(fg_context *context, const sampling *box,
                                     velocity_of velocity,
                                     const fg_critical_options *options)
{
  fg_critical_points *points = NULL;
  fg_field *field = field_of(context, box, velocity);
  if (fg_critical_points_find(&points, context, field, options) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  fg_field_destroy(field);
  return points;
}

static void assert_at(const fg_critical_point *point, double x, double y, double most)
{
  assert_close(point->at[0], x, most);
  assert_close(point->at[1], y, most);
}

typedef struct expected {
  double matrix[2][2];
  fg_critical_kind kind;
  int index, sense, outward;
} expected;

static void linear_fields_have_the_kind_of_their_matrix(void **state)
{
  static const expected table[] = {
      {{{1, 0}, {0, -1}}, FG_CRITICAL_SADDLE, -1, 0, 0},
      {{{-2, 1}, {3, 1}}, FG_CRITICAL_SADDLE, -1, 0, 0},
      {{{0, -3}, {3, 0}}, FG_CRITICAL_CENTRE, 1, 1, 0},
      {{{0, 3}, {-3, 0}}, FG_CRITICAL_CENTRE, 1, -1, 0},
      {{{0, -1}, {3, 0}}, FG_CRITICAL_CENTRE, 1, 1, 0},
      {{{0.05, 1}, {-1, 0.05}}, FG_CRITICAL_CENTRE, 1, -1, 0},
      {{{1, -1}, {1, 1}}, FG_CRITICAL_SPIRAL, 1, 1, 1},
      {{{1, 2}, {-2, 1}}, FG_CRITICAL_SPIRAL, 1, -1, 1},
      {{{-1, -2}, {2, -1}}, FG_CRITICAL_SPIRAL, 1, 1, -1},
      {{{-1, 1}, {-1, -1}}, FG_CRITICAL_SPIRAL, 1, -1, -1},
      {{{1, 0}, {0, 1}}, FG_CRITICAL_SOURCE, 1, 0, 1},
      {{{4, 1}, {0, 1}}, FG_CRITICAL_SOURCE, 1, 0, 1},
      {{{1, -0.2}, {0.2, 1}}, FG_CRITICAL_SOURCE, 1, 0, 1},
      {{{-2, 0}, {0, -1}}, FG_CRITICAL_SINK, 1, 0, -1},
      {{{-1, 0.1}, {-0.1, -1}}, FG_CRITICAL_SINK, 1, 0, -1},
  };
  const double cell = sqrt(12 * 8) / 256;
  for (size_t n = 0; n < sizeof table / sizeof table[0]; ++n) {
    memcpy(matrix, table[n].matrix, sizeof matrix);
    fg_critical_points *points = points_of(*state, &BOX, linear, NULL);
    assert_int_equal(fg_critical_points_count(points), 1);
    const fg_critical_point *point = fg_critical_points_at(points, 0);
    assert_int_equal(point->kind, table[n].kind);
    assert_int_equal(point->index, table[n].index);
    assert_int_equal(point->sense, table[n].sense);
    assert_int_equal(point->outward, table[n].outward);
    assert_at(point, CENTRE[0], CENTRE[1], 0.2 * cell);
    assert_null(fg_critical_points_at(points, 1));
    fg_critical_points_destroy(points);
  }
}

static void a_saddle_tells_where_it_flows_out_and_in(void **state)
{
  const double angle[2] = {0.3, 0.3 + 1.2}; /* of what flows out, and in */
  const double value[2] = {1.0, -1.5};
  const double cross = sin(angle[1] - angle[0]);
  for (int k = 0; k < 2; ++k) {
    const double other = angle[1 - k], sign = k ? 1.0 : -1.0;
    const double row[2] = {sign * -sin(other) / cross, sign * cos(other) / cross};
    for (int i = 0; i < 2; ++i) {
      matrix[0][i] = (k ? matrix[0][i] : 0.0) + value[k] * cos(angle[k]) * row[i];
      matrix[1][i] = (k ? matrix[1][i] : 0.0) + value[k] * sin(angle[k]) * row[i];
    }
  }
  /* the matrix is made of these vectors and values */
  for (int k = 0; k < 2; ++k) {
    const double v[2] = {cos(angle[k]), sin(angle[k])};
    for (int i = 0; i < 2; ++i)
      assert_close(matrix[i][0] * v[0] + matrix[i][1] * v[1], value[k] * v[i], 1e-12);
  }
  fg_critical_points *points = points_of(*state, &BOX, linear, NULL);
  const fg_critical_point *point = fg_critical_points_at(points, 0);
  for (int k = 0; k < 2; ++k) {
    const double *axis = point->axis[k];
    assert_close(hypot(axis[0], axis[1]), 1, 1e-12);
    assert_close(fabs(axis[0] * cos(angle[k]) + axis[1] * sin(angle[k])), 1, 0.01);
  }
  fg_critical_points_destroy(points);
}

/* Stream function y^2 / 2 + x^3 / 3 - a^2 x: a saddle at -a, a vortex at a. */
static const double APART = 0.9;

static void pair(const double position[3], double v[3])
{
  const double x = position[0] + 1, y = position[1] - 7;
  v[0] = y;
  v[1] = APART * APART - x * x;
}

static void a_saddle_and_a_vortex_cancel_at_a_large_scale(void **state)
{
  fg_critical_points *points =
      points_of(*state, &BOX, pair, &(fg_critical_options){.length = APART});
  assert_close(fg_critical_points_length(points), APART, 0);
  assert_int_equal(fg_critical_points_count(points), 2);
  const int vortex = fg_critical_points_at(points, 0)->kind == FG_CRITICAL_SADDLE ? 1 : 0;
  const fg_critical_point *point = fg_critical_points_at(points, vortex);
  assert_int_equal(point->kind, FG_CRITICAL_CENTRE);
  assert_int_equal(point->sense, -1);
  assert_at(point, -1 + APART, 7, 0.1);
  point = fg_critical_points_at(points, 1 - vortex);
  assert_int_equal(point->kind, FG_CRITICAL_SADDLE);
  assert_at(point, -1 - APART, 7, 0.1);
  fg_critical_points_destroy(points);
  points = points_of(*state, &BOX, pair, &(fg_critical_options){.length = 4.2 * APART});
  assert_int_equal(fg_critical_points_count(points), 0);
  fg_critical_points_destroy(points);
}

/* Two vortices at a distance of twice APART that turn in opposite senses, a jet between
 * them: stream function x exp(-r^2 / (2 APART^2)). */
static void dipole(const double position[3], double v[3])
{
  const double x = (position[0] + 1) / APART, y = (position[1] - 7) / APART;
  v[0] = -x * y;
  v[1] = x * x - 1;
}

static void a_dipole_is_two_vortices_or_nothing(void **state)
{
  for (int quarters = 4; quarters <= 24; ++quarters) {
    fg_critical_points *points = points_of(
        *state, &BOX, dipole, &(fg_critical_options){.length = 0.25 * quarters * APART});
    const bool apart = quarters < 16;
    assert_int_equal(fg_critical_points_count(points), apart ? 2 : 0);
    for (int n = 0; n < 2 && apart; ++n) {
      const fg_critical_point *point = fg_critical_points_at(points, n);
      const int sense = point->at[0] > -1 ? 1 : -1;
      assert_int_equal(point->kind, FG_CRITICAL_CENTRE);
      assert_int_equal(point->sense, sense);
      assert_at(point, -1 + sense * APART, 7, 0.03);
    }
    fg_critical_points_destroy(points);
  }
}

/* Turns a field by 90 degrees (sign 1), or mirrors it across x = y (sign -1). */
static double turning;

static void turned(const double position[3], double v[3])
{
  double w[3];
  swirl((const double[3]){position[1], turning * position[0], 0}, w);
  v[0] = turning * w[1];
  v[1] = w[0];
}

static void points_turn_and_are_mirrored_with_the_field(void **state)
{
  const sampling straight = {
      .dimension = 2, .nodes = {81, 51}, .low = {-7, 3}, .high = {5, 11}};
  fg_critical_points *before = points_of(*state, &straight, swirl, NULL);
  const int count = fg_critical_points_count(before);

  assert_true(count >= 4);
  for (int k = 0; k < 2; ++k) {
    turning = k ? 1.0 : -1.0;
    const sampling box = {.dimension = 2,
                          .nodes = {51, 81},
                          .low = {turning > 0 ? 3 : -11, -7},
                          .high = {turning > 0 ? 11 : -3, 5}};
    fg_critical_points *after = points_of(*state, &box, turned, NULL);
    assert_int_equal(fg_critical_points_count(after), count);
    for (int n = 0; n < count; ++n) {
      const fg_critical_point *a = fg_critical_points_at(before, n);
      const double at[2] = {turning * a->at[1], a->at[0]};
      int same = 0;
      for (int i = 0; i < count; ++i) {
        const fg_critical_point *b = fg_critical_points_at(after, i);
        same += hypot(b->at[0] - at[0], b->at[1] - at[1]) < 0.02 && b->kind == a->kind &&
                b->index == a->index && b->outward == a->outward &&
                b->sense == (turning > 0 ? -a->sense : a->sense);
      }
      assert_int_equal(same, 1);
    }
    fg_critical_points_destroy(after);
  }
  fg_critical_points_destroy(before);
}

static double island;

static void beside_an_island(const double position[3], double v[3])
{
  linear(position, v);
  if (position[0] - CENTRE[0] > island)
    v[0] = (double)NAN;
}

static void none_lies_where_the_smoothing_reaches_nothing(void **state)
{
  static const double vortex[2][2] = {{0, -1}, {1, 0}};
  memcpy(matrix, vortex, sizeof matrix);
  for (int k = 0; k < 2; ++k) {
    island = k ? 0.41 : 1.41; /* missing from the next node on: a fifth apart */
    fg_critical_points *points =
        points_of(*state, &BOX, beside_an_island, &(fg_critical_options){.length = 2.4});
    assert_int_equal(fg_critical_points_count(points), k ? 0 : 1);
    fg_critical_points_destroy(points);
  }
}

/* Two vortices turn one way, the third the other, and a saddle lies between the two. */
static void vortex3_has_its_vortices(void **state)
{
  static const struct {
    double at[2];
    fg_critical_kind kind;
    int sense;
  } table[] = {{{0.28, 0.30}, FG_CRITICAL_CENTRE, 1},
               {{0.74, 0.34}, FG_CRITICAL_CENTRE, -1},
               {{0.48, 0.74}, FG_CRITICAL_CENTRE, 1},
               {{0.33, 0.54}, FG_CRITICAL_SADDLE, 0}};
  static const int counts[] = {12, 40, 200, 2000};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, *state, "vortex3", 0), FG_STATUS_OK);
  for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c) {
    fg_critical_points *points = NULL;
    const fg_critical_options options = {.count = counts[c]};
    assert_int_equal(fg_critical_points_find(&points, *state, field, &options),
                     FG_STATUS_OK);
    assert_close(fg_critical_points_length(points), sqrt(1.0 / counts[c]), 1e-12);
    assert_int_equal(fg_critical_points_count(points), 4);
    for (int k = 0; k < 4; ++k) {
      int same = 0;
      for (int n = 0; n < 4; ++n) {
        const fg_critical_point *p = fg_critical_points_at(points, n);
        double v[2];
        same += hypot(p->at[0] - table[k].at[0], p->at[1] - table[k].at[1]) < 0.06 &&
                p->kind == table[k].kind && p->sense == table[k].sense;
        /* at a small scale the field is at rest there: elsewhere it is faster than 1 */
        if (counts[c] == 2000 && fg_field_velocity(field, p->at, v))
          assert_true(hypot(v[0], v[1]) < 0.1);
      }
      assert_int_equal(same, 1);
    }
    fg_critical_points_destroy(points);
  }
  fg_field_destroy(field);
}

static void the_result_does_not_depend_on_threads(void **state)
{
  fg_critical_points *one = points_of(*state, &BOX, coast, NULL);
  fg_critical_points *three =
      points_of(*state, &BOX, coast, &(fg_critical_options){.threads = 3});
  const int count = fg_critical_points_count(one);
  assert_true(count > 0);
  assert_int_equal(fg_critical_points_count(three), count);
  assert_memory_equal(fg_critical_points_at(one, 0), fg_critical_points_at(three, 0),
                      (size_t)count * sizeof(fg_critical_point));
  fg_critical_points_destroy(one);
  fg_critical_points_destroy(three);
}

static void what_makes_no_sense_is_refused(void **state)
{
  static const fg_critical_options wrong[] = {
      {.count = -1},           {.count = 2000000},   {.length = -1}, {.length = 1e-9},
      {.length = (double)NAN}, {.length = HUGE_VAL}, {.threads = -1}};
  const sampling cube = {.dimension = 3, .nodes = {5, 5, 5}, .high = {1, 1, 1}};
  fg_critical_points *points = NULL;
  fg_field *field = field_of(*state, &BOX, swirl),
           *space = field_of(*state, &cube, swirl);
  for (size_t n = 0; n < sizeof wrong / sizeof wrong[0]; ++n) {
    assert_int_equal(fg_critical_points_find(&points, *state, field, &wrong[n]),
                     FG_STATUS_ARGUMENT);
    assert_null(points);
  }
  assert_int_equal(fg_critical_points_find(NULL, *state, field, NULL),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(fg_critical_points_find(&points, *state, NULL, NULL),
                   FG_STATUS_ARGUMENT);
  fg_context_clear(*state);
  assert_int_equal(fg_critical_points_find(&points, *state, space, NULL),
                   FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(*state), "3D"));
  assert_int_equal(fg_critical_points_count(NULL), 0);
  assert_null(fg_critical_kind_word((fg_critical_kind)FG_CRITICAL_KINDS));
  fg_field_destroy(field);
  fg_field_destroy(space);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(linear_fields_have_the_kind_of_their_matrix),
      CASE(a_saddle_tells_where_it_flows_out_and_in),
      CASE(a_saddle_and_a_vortex_cancel_at_a_large_scale),
      CASE(a_dipole_is_two_vortices_or_nothing),
      CASE(points_turn_and_are_mirrored_with_the_field),
      CASE(none_lies_where_the_smoothing_reaches_nothing),
      CASE(vortex3_has_its_vortices),
      CASE(the_result_does_not_depend_on_threads),
      CASE(what_makes_no_sense_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
