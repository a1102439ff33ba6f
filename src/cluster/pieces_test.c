/* A window over many periods, and which of its pieces are kept. */
#include <math.h>

#include "base/context_test.h"
#include "cluster/pieces.h"

/* Along x the window begins 3 nodes before the domain, along y 7 behind its first node;
 * both then have five stretches. */
enum { WIDE = 26, HIGH = 22, PERIOD_X = 6, PERIOD_Y = 5, STRETCHES = 5, CLUSTERS = 40 };
static const double SPACING[2] = {0.5, 2.0};
static const double LOW[2] = {10.0, -3.0};

/* First and last node of each stretch. */
static const int along_x[STRETCHES][2] = {{0, 3}, {3, 9}, {9, 15}, {15, 21}, {21, 25}};
static const int along_y[STRETCHES][2] = {{0, 3}, {3, 8}, {8, 13}, {13, 18}, {18, 21}};

static float level[WIDE * HIGH];

/* Nodes of the cluster in each piece, off the boundaries. */
static const int nodes_in[STRETCHES * STRETCHES] = {0, 3, 1, 4, 0, 2, 5, 0, 3, 7,
                                                    0, 3, 8, 0, 4, 6, 0, 3, 0, 0};

static void fill(void)
{
  for (int n = 0; n < WIDE * HIGH; ++n)
    level[n] = -0.5F;
  for (int n = 0; n < STRETCHES * STRETCHES; ++n)
    for (int k = 0; k < nodes_in[n]; ++k) {
      int x = along_x[n % STRETCHES][0] + 1 + k % 2; /* two columns, up to four rows */
      int y = along_y[n / STRETCHES][0] + 1 + k / 2;
      level[y * WIDE + x] = 0.25F;
    }
}

static int find(fg__piece out[FG__WINDOW_PIECES], double area, double other_areas)
{
  double origin[2] = {LOW[0] - 3 * SPACING[0], LOW[1] + 7 * SPACING[1]};
  double areas[CLUSTERS];
  for (int n = 0; n < CLUSTERS; ++n)
    areas[n] = n == 1 ? area : other_areas;
  fg_density_arrays density = {.dimension = 2,
                               .nodes = {PERIOD_X, PERIOD_Y, 1},
                               .origin = {LOW[0], LOW[1]},
                               .spacing = {SPACING[0], SPACING[1]},
                               .periodic = {true, true}};
  fg__labels labels = {.count = CLUSTERS, .area = areas};
  const fg__window window = {.cluster = 2,
                             .dimension = 2,
                             .nodes = {WIDE, HIGH, 1},
                             .origin = {origin[0], origin[1]},
                             .level = level};
  return fg__pieces_find(out, &density, &labels, &window);
}

/* Of pieces of the same size the first. */
static bool comes_before(int one, int other)
{
  if (nodes_in[one] != nodes_in[other])
    return nodes_in[one] > nodes_in[other];
  return one < other;
}

static void the_largest_pieces_are_kept(void **state)
{
  (void)state;
  fg__piece piece[FG__WINDOW_PIECES];
  int kept[FG__WINDOW_PIECES] = {0}, count = 0, nodes = 0;
  fill();
  assert_int_equal(find(piece, 1000.0, 1.0), FG__WINDOW_PIECES);
  for (int n = 0; n < STRETCHES * STRETCHES; ++n) {
    int larger = 0;
    for (int m = 0; m < STRETCHES * STRETCHES; ++m)
      larger += comes_before(m, n);
    if (larger < FG__WINDOW_PIECES) {
      nodes += nodes_in[n];
      kept[count++] = n;
    }
  }
  assert_int_equal(count, FG__WINDOW_PIECES);
  for (int n = 0; n < count; ++n) {
    const fg__stretch *x = &piece[n].range[0], *y = &piece[n].range[1];
    const int *of_x = along_x[kept[n] % STRETCHES], *of_y = along_y[kept[n] / STRETCHES];
    assert_true(x->first == of_x[0] && x->last == of_x[1]);
    assert_true(y->first == of_y[0] && y->last == of_y[1]);
    assert_int_equal(x->start, x->first == 0 ? PERIOD_X - 3 : 0);
    assert_int_equal(y->start, y->first == 0 ? 7 - PERIOD_Y : 0);
    assert_true(fabs(piece[n].share - (double)nodes_in[kept[n]] / nodes) < 1e-12);
  }
}

/* A piece needs a quarter of the cluster, or of the mean cluster; the largest is kept. */
static void small_pieces_are_left_out(void **state)
{
  (void)state;
  fg__piece piece[FG__WINDOW_PIECES];
  fill();
  assert_int_equal(find(piece, 1.0, 1.0), 1);
  assert_int_equal(piece[0].range[0].first, along_x[2][0]);
  assert_true(fabs(piece[0].share - 1.0) < 1e-12);
  /* of 49 nodes those with 4.3 at least: the mean cluster is 0.35 of this one */
  assert_int_equal(find(piece, 3.0, 1.0), 4);
  assert_true(fabs(piece[1].share - 7.0 / 26.0) < 1e-12);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_largest_pieces_are_kept),
      cmocka_unit_test(small_pieces_are_left_out),
  };
  return cmocka_run_group_tests_name("cluster/pieces", tests, NULL, NULL);
}
