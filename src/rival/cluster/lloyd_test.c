/* Centroidal Voronoi seeds and k-means. */
#include "rival/cluster/lloyd.h"
#include "rival/fields_test.h"

#include <stdlib.h>
#include <string.h>

typedef struct bench {
  fg_field *field;
  fg__domain domain;
  fg__lloyd lloyd;
} bench;

static void set_up(bench *b, fg_context *context, velocity_of velocity, bool round,
                   int count, double weight)
{
  b->field = field_of(context, velocity, round);
  assert_int_equal(fg__domain_create(&b->domain, context, b->field, 91), FG_STATUS_OK);
  assert_int_equal(fg__lloyd_create(&b->lloyd, context, &b->domain, count, weight),
                   FG_STATUS_OK);
}

static void tear_down(bench *b)
{
  fg__lloyd_clear(&b->lloyd);
  fg__domain_clear(&b->domain);
  fg_field_destroy(b->field);
}

/* Mean direction of a cluster's members. */
static void mean_direction(const bench *b, int n, double mean[2])
{
  int first = b->lloyd.first[n], end = b->lloyd.first[n + 1];
  mean[0] = mean[1] = 0;
  for (int i = first; i < end; i++)
    for (int k = 0; k < 2; k++)
      mean[k] += fg__domain_direction(&b->domain, b->lloyd.member[i])[k] / (end - first);
}

/* Squared distance of a cell to a cluster, all clusters looked at one by one. */
static double cost_of(const bench *b, int cell, int n, const double mean[2],
                      double weight)
{
  double lambda = sqrt(b->domain.area / b->lloyd.count), way[2];
  const double *direction = fg__domain_direction(&b->domain, cell);
  fg__domain_center(&b->domain, cell, way);
  for (int k = 0; k < 2; k++)
    way[k] -= b->lloyd.center[n][k];
  fg__domain_shortest(&b->domain, way);
  double cost = 0;
  for (int k = 0; k < 2; k++) {
    double turn = weight * (direction[k] - mean[k]);
    cost += way[k] * way[k] / (lambda * lambda) + turn * turn;
  }
  return cost;
}

/* Every moving cell is a member once; but for what the last round has moved, it is with
 * the nearest centre, and each centre is the mean of its members. */
static void assert_settled(const bench *b, double weight)
{
  const fg__lloyd *lloyd = &b->lloyd;
  double(*mean)[2] = calloc((size_t)lloyd->count, sizeof *mean);
  unsigned char *met = calloc((size_t)fg__domain_cell_count(&b->domain), 1);
  double lambda = sqrt(b->domain.area / lloyd->count);
  int members = 0;
  if (!mean || !met) {
    fail();
    return;
  }
  for (int n = 0; n < lloyd->count; n++)
    mean_direction(b, n, mean[n]);
  for (int n = 0; n < lloyd->count; n++) {
    double offset[2] = {0, 0};
    int size = lloyd->first[n + 1] - lloyd->first[n];
    assert_true(size > 0);
    for (int i = lloyd->first[n]; i < lloyd->first[n + 1]; i++, members++) {
      int cell = lloyd->member[i];
      assert_true(b->domain.valid[cell] && !met[cell]);
      met[cell] = 1;
      double own = cost_of(b, cell, n, mean[n], weight), place[2];
      for (int m = 0; m < lloyd->count; m++)
        assert_true(cost_of(b, cell, m, mean[m], weight) > own * 0.95 - 0.02);
      fg__domain_center(&b->domain, cell, place);
      for (int k = 0; k < 2; k++)
        place[k] -= lloyd->center[n][k];
      fg__domain_shortest(&b->domain, place);
      for (int k = 0; k < 2; k++)
        offset[k] += place[k] / size;
    }
    assert_true(hypot(offset[0], offset[1]) < 0.05 * lambda);
  }
  assert_int_equal(members, b->domain.valid_count);
  free(mean);
  free(met);
}

static void cells_belong_to_the_nearest_centre(void **state)
{
  static const double weight[] = {0, 1};
  for (int w = 0; w < 2; w++)
    for (int count = 1; count < 80; count += 26)
      for (int round = 0; round < 2; round++) {
        bench b;
        set_up(&b, *state, round ? swirl : coast, round, count, weight[w]);
        assert_int_equal(b.lloyd.count, count);
        assert_settled(&b, weight[w]);
        tear_down(&b);
      }
}

/* Members are in the order of their distance, so that the first stands for the cluster.
 */
static void the_nearest_member_is_first(void **state)
{
  bench b;
  set_up(&b, *state, coast, false, 23, 1);
  for (int n = 0; n < b.lloyd.count; n++) {
    double mean[2], before = 0;
    mean_direction(&b, n, mean);
    for (int i = b.lloyd.first[n]; i < b.lloyd.first[n + 1]; i++) {
      double cost = cost_of(&b, b.lloyd.member[i], n, mean, 1);
      assert_true(cost > before - 0.01);
      before = cost;
    }
  }
  tear_down(&b);
}

/* Two halves that flow apart: clusters of direction do not mix them, those of place do.
 */
static void shear(double x, double y, double v[2])
{
  v[0] = y + 0.2 * x < 8.13 ? 2 : -3;
  v[1] = 0.1 * v[0];
}

static int mixed_clusters(fg_context *context, double weight)
{
  bench b;
  int mixed = 0;
  set_up(&b, context, shear, false, 14, weight);
  for (int n = 0; n < b.lloyd.count; n++) {
    double mean[2];
    mean_direction(&b, n, mean);
    mixed += hypot(mean[0], mean[1]) < 0.9;
  }
  tear_down(&b);
  return mixed;
}

static void direction_parts_clusters(void **state)
{
  assert_int_equal(mixed_clusters(*state, 1), 0);
  assert_true(mixed_clusters(*state, 0) > 1);
}

static void exactly_so_many_arrows(void **state)
{
  static const fg_rival_method method[] = {FG_RIVAL_VORONOI, FG_RIVAL_K_MEANS};
  fg_context *context = *state;
  for (int m = 0; m < 2; m++)
    for (int round = 0; round < 2; round++) {
      fg_field *field = field_of(context, coast, round);
      fg_rival *rival = rival_of(context, field, method[m], 81);
      for (int count = 1; count < 150; count += 74) {
        fg_icons *icons = curved_icons(rival, field, count);
        assert_int_equal(fg_icons_count(icons), count);
        assert_int_equal(fg_icons_dropped(icons), 0);
        fg_icons_destroy(icons);
      }
      fg_rival_destroy(rival);
      fg_field_destroy(field);
    }
}

/* More than there are cells: one each. */
static void no_more_than_there_are_cells(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, swirl, false);
  fg__domain domain;
  fg__lloyd lloyd;
  assert_int_equal(fg__domain_create(&domain, context, field, 7), FG_STATUS_OK);
  assert_int_equal(fg__lloyd_create(&lloyd, context, &domain, 1000, 0), FG_STATUS_OK);
  assert_int_equal(lloyd.count, domain.valid_count);
  fg__lloyd_clear(&lloyd);
  fg__domain_clear(&domain);
  fg_field_destroy(field);
}

/* An oblong field, and the same turned by a quarter: velocity (u, v) at (x, y) becomes
 * (-v, u) at (-y, x). */
enum { LONG = 49, SHORT = 31 };

static fg_field *oblong(fg_context *context, bool turned)
{
  static float sample[2][LONG * SHORT];
  double axis[2][LONG];
  for (int i = 0; i < LONG; i++) {
    axis[0][i] = 0.25 * (i - LONG / 2);
    axis[1][i] = 0.25 * (i - SHORT / 2);
  }
  for (int j = 0; j < SHORT; j++)
    for (int i = 0; i < LONG; i++) {
      double x = axis[0][i], y = axis[1][j];
      double v[2] = {sin(0.5 * y + 0.2) + 0.3 * x, 0.7 + cos(0.4 * x) * 1.1 + 0.1 * y};
      int at = turned ? i * SHORT + (SHORT - 1 - j) : j * LONG + i;
      sample[0][at] = (float)(turned ? -v[1] : v[0]);
      sample[1][at] = (float)(turned ? v[0] : v[1]);
    }
  const fg_field_arrays arrays = {
      .dimension = 2,
      .size = {turned ? SHORT : LONG, turned ? LONG : SHORT, 1},
      .axis = {axis[turned ? 1 : 0], axis[turned ? 0 : 1]},
      .velocity = {sample[0], sample[1]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* Where the start is halves all through, it turns with the field, and so does what comes
 * of it. */
static void a_turned_field_turns_the_seeds(void **state)
{
  fg_context *context = *state;
  fg__lloyd lloyd[2];
  for (int turned = 0; turned < 2; turned++) {
    fg_field *field = oblong(context, turned);
    fg__domain domain;
    assert_int_equal(fg__domain_create(&domain, context, field, 65), FG_STATUS_OK);
    assert_int_equal(fg__lloyd_create(&lloyd[turned], context, &domain, 8, 1),
                     FG_STATUS_OK);
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
  for (int n = 0; n < 8; n++) {
    const double *seed = lloyd[0].center[n];
    double nearest = HUGE_VAL;
    for (int m = 0; m < 8; m++)
      nearest = fmin(nearest, hypot(lloyd[1].center[m][0] + seed[1],
                                    lloyd[1].center[m][1] - seed[0]));
    assert_true(nearest < 0.02);
  }
  for (int turned = 0; turned < 2; turned++)
    fg__lloyd_clear(&lloyd[turned]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(cells_belong_to_the_nearest_centre), CASE(the_nearest_member_is_first),
      CASE(direction_parts_clusters),           CASE(exactly_so_many_arrows),
      CASE(no_more_than_there_are_cells),       CASE(a_turned_field_turns_the_seeds),
  };
  return cmocka_run_group_tests_name("rival/cluster/cluster/lloyd", tests, NULL, NULL);
}
