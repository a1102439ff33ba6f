/* Components in 3D. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "component/components.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

/* The reference: the density on the faces of the cells, sampled FINE times a cell,
 * flooded from sample to sample. Values are whole numbers up to 3, so that a saddle is
 * 1/12 at least when it is not zero, and samples 1/16 apart see it. */
enum { FINE = 16, WIDTH = 6, HEIGHT = 4, DEPTH = 4, NODES = WIDTH * HEIGHT * DEPTH };

static const int nodes[3] = {WIDTH, HEIGHT, DEPTH};

typedef struct fine_grid {
  int size[3];
  bool periodic[3];
  float u[NODES];
  unsigned char active[NODES];
  int *label; /* of the samples */
} fine_grid;

static int cells_along(const fine_grid *fine, int axis)
{
  return fine->periodic[axis] ? nodes[axis] : nodes[axis] - 1;
}

static int sample_index(const fine_grid *fine, const int place[3])
{
  return (place[2] * fine->size[1] + place[1]) * fine->size[0] + place[0];
}

static double fine_value(const fine_grid *fine, const int place[3])
{
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    int node[3];
    for (int k = 0; k < 3; ++k) {
      double t = (double)(place[k] % FINE) / FINE;
      int step = corner >> k & 1;
      weight *= step ? t : 1.0 - t;
      node[k] = (place[k] / FINE + step) % nodes[k];
    }
    if (weight > 0.0)
      value += weight * (double)fine->u[(node[2] * HEIGHT + node[1]) * WIDTH + node[0]];
  }
  return value;
}

/* Whether an active cell holds a sample and the one `step` further along an axis, or, for
 * step 0, the sample. */
static bool fine_active(const fine_grid *fine, const int place[3], int axis, int step)
{
  for (int way = 0; way < 8; ++way) {
    int cell[3];
    bool holds = true;
    for (int k = 0; k < 3; ++k) {
      bool between = place[k] % FINE != 0 || (k == axis && step != 0);
      int low = place[k] - (k == axis && step < 0);
      cell[k] = (low + FINE) / FINE - 1;
      if (way >> k & 1) {
        holds = holds && !between;
        --cell[k];
      }
      if (fine->periodic[k])
        cell[k] = (cell[k] + nodes[k]) % nodes[k];
      holds = holds && cell[k] >= 0 && cell[k] < cells_along(fine, k);
    }
    if (holds &&
        fine->active[(cell[2] * cells_along(fine, 1) + cell[1]) * cells_along(fine, 0) +
                     cell[0]])
      return true;
  }
  return false;
}

static bool on_grid_plane(const int place[3], int but_axis)
{
  for (int k = 0; k < 3; ++k)
    if (k != but_axis && place[k] % FINE == 0)
      return true;
  return false;
}

static bool fine_next(const fine_grid *fine, const int place[3], int axis, int step,
                      int next[3])
{
  if (!on_grid_plane(place, axis) || !fine_active(fine, place, axis, step))
    return false;
  memcpy(next, place, 3 * sizeof *next);
  next[axis] += step;
  if (fine->periodic[axis])
    next[axis] = (next[axis] + fine->size[axis]) % fine->size[axis];
  return next[axis] >= 0 && next[axis] < fine->size[axis] && fine_value(fine, next) > 0.0;
}

static void fine_flood(fine_grid *fine)
{
  int count = 0, samples = 1;
  for (int k = 0; k < 3; ++k) {
    fine->size[k] = cells_along(fine, k) * FINE + !fine->periodic[k];
    samples *= fine->size[k];
  }
  fine->label = calloc((size_t)samples, sizeof(int));
  int(*queue)[3] = malloc((size_t)samples * sizeof *queue);
  for (int n = 0; n < NODES; ++n) {
    int start[3] = {n % WIDTH * FINE, n / WIDTH % HEIGHT * FINE,
                    n / (WIDTH * HEIGHT) * FINE};
    if (fine->label[sample_index(fine, start)] || !(fine_value(fine, start) > 0.0) ||
        !fine_active(fine, start, 0, 0))
      continue;
    int tail = 0;
    fine->label[sample_index(fine, start)] = ++count;
    memcpy(queue[tail++], start, sizeof start);
    for (int head = 0; head < tail; ++head)
      for (int way = 0; way < 6; ++way) {
        int next[3];
        if (!fine_next(fine, queue[head], way / 2, way % 2 ? 1 : -1, next) ||
            fine->label[sample_index(fine, next)])
          continue;
        fine->label[sample_index(fine, next)] = count;
        memcpy(queue[tail++], next, sizeof next);
      }
  }
  free(queue);
}

static void agrees_with_flood_fill(const bool periodic[3], int masked_of_ten)
{
  for (int round = 0; round < 8; ++round) {
    fine_grid fine = {0};
    memcpy(fine.periodic, periodic, sizeof fine.periodic);
    for (int n = 0; n < NODES; ++n) {
      int value = rand() % 7;
      fine.u[n] = (float)(value < 4 ? value - 4 : value - 3);
      if (fine.u[n] < -3.0F)
        fine.u[n] = -3.0F;
      fine.active[n] = rand() % 10 >= masked_of_ten;
    }
    fine_flood(&fine);
    fg__component_grid grid = {.nodes = {WIDTH, HEIGHT, DEPTH},
                               .periodic = {periodic[0], periodic[1], periodic[2]},
                               .u = fine.u,
                               .active = masked_of_ten ? fine.active : NULL};
    fg__components components = {0};
    assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
    int newest = 0;
    for (int n = 0; n < NODES; ++n) { /* both number in the order of first nodes */
      const int place[3] = {n % WIDTH * FINE, n / WIDTH % HEIGHT * FINE,
                            n / (WIDTH * HEIGHT) * FINE};
      int expected = fine.label[sample_index(&fine, place)];
      assert_int_equal(components.label[n], expected);
      newest = expected > newest ? expected : newest;
    }
    assert_int_equal(newest, components.count);
    fg__components_clear(&components);
    free(fine.label);
  }
}

static void test_agrees_with_flood_fill_on_faces(void **state)
{
  (void)state;
  srand(11);
  for (int way = 0; way < 5; ++way) {
    const bool periodic[3] = {way == 1 || way == 4, way == 2 || way == 4,
                              way == 3 || way == 4};
    agrees_with_flood_fill(periodic, 0);
    agrees_with_flood_fill(periodic, 4);
  }
}

/* Opposite corners of a cell, with faces that join nothing: two components, however large
 * the density inside is. */
static void test_a_body_diagonal_joins_nothing(void **state)
{
  (void)state;
  float u[8] = {5.0F, -0.1F, -0.1F, -0.1F, -0.1F, -0.1F, -0.1F, 5.0F};
  fg__component_grid grid = {.nodes = {2, 2, 2}, .u = u};
  fg__components components = {0};
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 2);
  u[3] = 0.01F; /* across the lower face from node 0: 5 * 0.01 > 0.1 * 0.1 */
  u[7] = -1.0F;
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 1);
  u[3] = 0.001F;
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 2);
  fg__components_clear(&components);
}

static double ball_volume(int side, double radius)
{
  float *u = malloc((size_t)(side * side * side) * sizeof *u);
  double h = 1.0 / (side - 1);
  for (int n = 0; n < side * side * side; ++n) {
    double x = n % side * h - 0.52, y = n / side % side * h - 0.47;
    double z = n / side / side * h - 0.505;
    u[n] = (float)tanh((radius - sqrt(x * x + y * y + z * z)) / 0.07);
  }
  fg__component_grid grid = {.nodes = {side, side, side}, .u = u};
  fg__components components = {0};
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 1);
  double volume = components.area[0] * h * h * h;
  fg__components_clear(&components);
  free(u);
  return volume;
}

static void test_volume_of_a_ball_converges(void **state)
{
  (void)state;
  double exact = 4.0 / 3.0 * 3.14159265358979 * 0.31 * 0.31 * 0.31;
  double coarse = fabs(ball_volume(17, 0.31) - exact);
  double fine = fabs(ball_volume(65, 0.31) - exact);
  assert_true(coarse < 0.03 * exact);
  assert_true(fine < coarse / 8); /* order 2 would be 16 */
}

/* Turning the grid changes neither volumes nor the number of components. */
static void test_axes_are_alike(void **state)
{
  (void)state;
  enum { A = 13, B = 9, C = 7 };
  const int size[3] = {A, B, C};
  float u[A * B * C], turned[A * B * C];
  srand(5);
  for (int n = 0; n < A * B * C; ++n)
    u[n] = (float)(rand() % 2001 - 1200) / 1000.0F;
  fg__component_grid grid = {.nodes = {A, B, C}, .u = u, .debris_area = 0.9};
  fg__components whole = {0}, other = {0};
  assert_int_equal(fg__components_count(&whole, NULL, &grid), FG_STATUS_OK);
  for (int turn = 1; turn < 3; ++turn) {
    int order[3] = {turn, (turn + 1) % 3, (turn + 2) % 3};
    fg__component_grid view = {.nodes = {size[order[0]], size[order[1]], size[order[2]]},
                               .u = turned,
                               .debris_area = 0.9};
    for (int n = 0; n < A * B * C; ++n) {
      const int place[3] = {n % A, n / A % B, n / (A * B)};
      turned[(place[order[2]] * view.nodes[1] + place[order[1]]) * view.nodes[0] +
             place[order[0]]] = u[n];
    }
    assert_int_equal(fg__components_count(&other, NULL, &view), FG_STATUS_OK);
    assert_int_equal(other.count, whole.count);
    assert_int_equal(other.debris, whole.debris);
    assert_true(whole.count > 1 && whole.debris > 1);
    double sum[2] = {0.0, 0.0};
    for (int n = 0; n < whole.count; ++n) {
      sum[0] += whole.area[n] * whole.area[n];
      sum[1] += other.area[n] * other.area[n];
    }
    assert_near(sum[0], sum[1], 1e-5 * sum[0]);
    assert_true(whole.covered == other.covered);
  }
  fg__components_clear(&whole);
  fg__components_clear(&other);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_agrees_with_flood_fill_on_faces),
      cmocka_unit_test(test_a_body_diagonal_joins_nothing),
      cmocka_unit_test(test_volume_of_a_ball_converges),
      cmocka_unit_test(test_axes_are_alike),
  };
  return cmocka_run_group_tests_name("component/space", tests, NULL, NULL);
}
