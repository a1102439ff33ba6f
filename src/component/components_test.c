#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "component/components.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

/* The reference: the bilinear density itself, sampled FINE times a cell, flooded from
 * sample to sample. Values are whole numbers up to 3, so that a saddle is 1/12 at least
 * when it is not zero, and samples 1/16 apart see it. */
enum { FINE = 16, WIDTH = 11, HEIGHT = 8 };

typedef struct fine_grid {
  int width, height;
  bool periodic_x;
  float u[WIDTH * HEIGHT];
  unsigned char active[WIDTH * HEIGHT];
  int *label; /* of the samples */
} fine_grid;

static bool fine_cell_active(const fine_grid *fine, int x, int y)
{
  int cells = fine->periodic_x ? WIDTH : WIDTH - 1;
  if (fine->periodic_x)
    x = (x + WIDTH) % WIDTH;
  return x >= 0 && x < cells && y >= 0 && y < HEIGHT - 1 && fine->active[y * cells + x];
}

static double fine_value(const fine_grid *fine, int i, int j)
{
  int x = i / FINE;
  int y = j / FINE < HEIGHT - 1 ? j / FINE : HEIGHT - 2;
  if (!fine->periodic_x && x > WIDTH - 2)
    x = WIDTH - 2;
  double s = (double)(i - x * FINE) / FINE;
  double t = (double)(j - y * FINE) / FINE;
  const float *low = fine->u + y * WIDTH;
  const float *high = low + WIDTH;
  int next = (x + 1) % WIDTH;
  return (1 - t) * ((1 - s) * (double)low[x] + s * (double)low[next]) +
         t * ((1 - s) * (double)high[x] + s * (double)high[next]);
}

/* Whether one of the cells that hold both samples is active; a sample with itself:
 * whether one of its cells is. */
static bool fine_joined(const fine_grid *fine, int i, int j, int di, int dj)
{
  for (int dy = -1; dy <= 0; ++dy) {
    for (int dx = -1; dx <= 0; ++dx) {
      int low_i = di < 0 ? i - 1 : i;
      int low_j = dj < 0 ? j - 1 : j;
      bool on_line_x = di == 0 && i % FINE == 0;
      bool on_line_y = dj == 0 && j % FINE == 0;
      if ((dx < 0 && !on_line_x) || (dy < 0 && !on_line_y))
        continue;
      if (fine_cell_active(fine, low_i / FINE - (low_i < 0) + dx,
                           low_j / FINE - (low_j < 0) + dy))
        return true;
    }
  }
  return false;
}

static void fine_flood(fine_grid *fine)
{
  static int queue[WIDTH * HEIGHT * FINE * FINE];
  fine->width = fine->periodic_x ? WIDTH * FINE : (WIDTH - 1) * FINE + 1;
  fine->height = (HEIGHT - 1) * FINE + 1;
  fine->label = calloc((size_t)fine->width * (size_t)fine->height, sizeof(int));
  int count = 0;
  for (int start = 0; start < fine->width * fine->height; ++start) {
    int i = start % fine->width;
    int j = start / fine->width;
    if (fine->label[start] || !(fine_value(fine, i, j) > 0) ||
        !fine_joined(fine, i, j, 0, 0))
      continue;
    int tail = 0;
    queue[tail++] = start;
    fine->label[start] = ++count;
    for (int head = 0; head < tail; ++head) {
      i = queue[head] % fine->width;
      j = queue[head] / fine->width;
      const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
      for (int k = 0; k < 4; ++k) {
        int next_i = i + step[k][0];
        int next_j = j + step[k][1];
        if (!fine_joined(fine, i, j, step[k][0], step[k][1]))
          continue;
        if (fine->periodic_x)
          next_i = (next_i + fine->width) % fine->width;
        int next = next_j * fine->width + next_i;
        if (fine->label[next] || !(fine_value(fine, next_i, next_j) > 0))
          continue;
        fine->label[next] = count;
        queue[tail++] = next;
      }
    }
  }
}

static void agrees_with_flood_fill(bool periodic, int masked_of_ten)
{
  for (int round = 0; round < 60; ++round) {
    fine_grid fine = {.periodic_x = periodic};
    for (int k = 0; k < WIDTH * HEIGHT; ++k) {
      int value = rand() % 6;
      fine.u[k] = (float)(value < 3 ? value - 3 : value - 2);
      fine.active[k] = rand() % 10 >= masked_of_ten;
    }
    fine_flood(&fine);
    fg__component_grid grid = {.nodes = {WIDTH, HEIGHT},
                               .periodic = {periodic, false},
                               .u = fine.u,
                               .active = masked_of_ten ? fine.active : NULL};
    fg__components components = {0};
    assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
    int match[WIDTH * HEIGHT + 1] = {0};
    int newest = 0;
    for (int k = 0; k < WIDTH * HEIGHT; ++k) {
      int label = components.label[k];
      int expected = fine.label[k / WIDTH * FINE * fine.width + k % WIDTH * FINE];
      assert_int_equal(label > 0, expected > 0);
      if (label <= 0)
        continue;
      assert_in_range(label, 1, newest + 1); /* in the order of the first nodes */
      if (label > newest) {
        newest = label;
        match[label] = expected;
        for (int m = 1; m < label; ++m)
          assert_int_not_equal(match[m], expected);
      }
      assert_int_equal(match[label], expected);
    }
    assert_int_equal(newest, components.count);
    assert_int_equal(components.debris, 0);
    fg__components_clear(&components);
    free(fine.label);
  }
}

static void test_agrees_with_flood_fill(void **state)
{
  (void)state;
  srand(7);
  agrees_with_flood_fill(false, 0);
  agrees_with_flood_fill(true, 0);
  agrees_with_flood_fill(false, 3);
  agrees_with_flood_fill(true, 3);
}

/* A wide row, so that whole words of eight nodes lie inside, outside and across. The
 * shares of u and -u make up the domain, and a straight boundary has no bias. */
static void test_area_under_a_plane(void **state)
{
  (void)state;
  enum { N = 61, M = 40 };
  float u[N * M];
  /* 0.3 x - 0.7 y + 2 > 0: below y = (0.3 x + 2)/0.7, from 2.857 to 28.571 */
  for (int y = 0; y < M; ++y) {
    for (int x = 0; x < N; ++x)
      u[y * N + x] = 0.3F * (float)x - 0.7F * (float)y + 2.0F;
  }
  double area[2];
  for (int side = 0; side < 2; ++side) {
    fg__component_grid grid = {.nodes = {N, M}, .u = u};
    fg__components components = {0};
    assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
    assert_int_equal(components.count, 1);
    area[side] = components.area[0];
    for (int k = 0; k < N * M; ++k)
      u[k] = -u[k];
    fg__components_clear(&components);
  }
  assert_near(area[0], 60 * (2 / 0.7 + 20 / 0.7) / 2, 0.05);
  assert_near(area[0] + area[1], 60 * 39, 1e-3);
}

static double disc_area(int nodes)
{
  float *u = malloc((size_t)(nodes * nodes) * sizeof *u);
  double h = 1.0 / (nodes - 1);
  for (int k = 0; k < nodes * nodes; ++k)
    u[k] = (float)(0.31 * 0.31 - pow(k % nodes * h - 0.52, 2) -
                   pow(k / nodes * h - 0.47, 2));
  fg__component_grid grid = {.nodes = {nodes, nodes}, .u = u};
  fg__components components = {0};
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  double area = components.area[0] * h * h;
  fg__components_clear(&components);
  free(u);
  return area;
}

static void test_area_of_a_disc_converges(void **state)
{
  (void)state;
  double exact = 3.14159265358979 * 0.31 * 0.31;
  double coarse = fabs(disc_area(33) - exact);
  double fine = fabs(disc_area(129) - exact);
  assert_true(coarse < 2e-3 * exact * 4);
  assert_true(fine < coarse / 8); /* order 2 would be 16 */
}

static void test_masked_cells_have_no_area(void **state)
{
  (void)state;
  float u[5 * 4];
  unsigned char active[4 * 3];
  for (int k = 0; k < 20; ++k)
    u[k] = 1.0F;
  memset(active, 1, sizeof active);
  active[0 * 4 + 2] = active[1 * 4 + 2] = active[2 * 4 + 2] = 0; /* parts the domain */
  active[2 * 4 + 0] = 0;
  fg__component_grid grid = {.nodes = {5, 4}, .u = u, .active = active};
  fg__components components = {0};
  assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 2);
  assert_near(components.area[0], 5.0, 1e-12);
  assert_near(components.area[1], 3.0, 1e-12);
  assert_int_equal(components.label[15], 0); /* its only cell is masked */
  assert_int_equal(components.label[2], 1);
  assert_int_equal(components.label[3], 2);
  fg__components_clear(&components);
}

static void test_debris_is_no_component(void **state)
{
  (void)state;
  float u[30 * 9];
  for (int k = 0; k < 30 * 9; ++k)
    u[k] = -1.0F;
  u[2 * 30 + 3] = 1.0F; /* a quarter of each of four cells */
  u[5 * 30 + 20] = 1.0F;
  u[5 * 30 + 21] = 1.0F; /* two cells half, four a quarter */
  fg__component_grid grid = {.nodes = {30, 9}, .u = u, .debris_area = 1.1};
  fg__components components = {0};
  assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 1);
  assert_int_equal(components.debris, 1);
  assert_int_equal(components.label[2 * 30 + 3], -1);
  assert_int_equal(components.label[5 * 30 + 21], 1);
  assert_near(components.area[0], 2.0, 1e-12);
  grid.debris_area = 0.9;
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 2);
  assert_near(components.area[0], 1.0, 1e-12);
  fg__components_clear(&components);
}

static void test_periodic_both_ways(void **state)
{
  (void)state;
  float u[7 * 6];
  for (int k = 0; k < 42; ++k)
    u[k] = -1.0F;
  u[0] = u[6] = u[5 * 7] = u[5 * 7 + 6] = 1.0F; /* one square across the corner */
  fg__component_grid grid = {.nodes = {7, 6}, .periodic = {true, true}, .u = u};
  fg__components components = {0};
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 1);
  assert_near(components.area[0], 1 + 4 * 0.5 + 4 * 0.25, 1e-12);
  grid.periodic[0] = grid.periodic[1] = false;
  assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 4);
  fg__components_clear(&components);
}

static void test_a_nan_harms_nothing(void **state)
{
  (void)state;
  float u[6 * 6];
  for (int k = 0; k < 36; ++k)
    u[k] = 1.0F;
  u[14] = NAN;
  fg__component_grid grid = {.nodes = {6, 6}, .u = u};
  fg__components components = {0};
  assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
  assert_int_equal(components.count, 1);
  assert_int_equal(components.label[14], 0);
  assert_near(components.area[0], 25 - 4, 1e-5);
  fg__components_clear(&components);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_agrees_with_flood_fill),
      cmocka_unit_test(test_area_under_a_plane),
      cmocka_unit_test(test_area_of_a_disc_converges),
      cmocka_unit_test(test_masked_cells_have_no_area),
      cmocka_unit_test(test_debris_is_no_component),
      cmocka_unit_test(test_periodic_both_ways),
      cmocka_unit_test(test_a_nan_harms_nothing),
  };
  return cmocka_run_group_tests_name("component/components", tests, NULL, NULL);
}
