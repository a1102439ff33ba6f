/* Counts clusters in smooth noise, and compares measures of a drop's size: the figures of
 * docs/design/components.md. Usage: bench_components; least CPU time of 100 repetitions
 * (40 in 3D), one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "component/components.h"
#include "field/noise.h"

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Noise with a correlation length of some nodes, a third of it positive. */
static float *smooth_noise(const int nodes[3], double length)
{
  const int cells[3] = {nodes[0] - 1, nodes[1] - 1, nodes[2] - 1};
  const double spacing[3] = {1.0, 1.0, 1.0};
  const bool periodic[3] = {false, false, false};
  int dimension = nodes[2] > 1 ? 3 : 2;
  double mean = dimension == 3 ? -0.30 : -0.35;
  fg__noise noise =
      fg__noise_of(dimension, cells, spacing, periodic, mean, 1.5, length, 1);
  size_t row = (size_t)nodes[0];
  float *u = malloc(row * (size_t)nodes[1] * (size_t)nodes[2] * sizeof *u);
  for (int k = 0; u && k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      fg__noise_row(&noise, j, k, 0, nodes[0],
                    u + ((size_t)k * (size_t)nodes[1] + (size_t)j) * row);
  return u;
}

static void time_counts(int side, int dimension, double length)
{
  const int nodes[3] = {side, side, dimension == 3 ? side : 1};
  float *u = smooth_noise(nodes, length);
  fg__component_grid grid = {
      .nodes = {nodes[0], nodes[1], nodes[2]}, .u = u, .debris_area = 12.0};
  fg__components components = {0};
  double least[2] = {HUGE_VAL, HUGE_VAL};
  for (int n = 0; u && n < (dimension == 3 ? 40 : 100); ++n) {
    double start = now();
    if (fg__components_count(&components, NULL, &grid))
      break;
    double between = now();
    if (fg__components_find(&components, NULL, &grid))
      break;
    least[0] = fmin(least[0], between - start);
    least[1] = fmin(least[1], now() - between);
  }
  printf(
      "%dD %4d nodes, noise over %2.0f nodes: %4d clusters %4d debris, count %7.3f ms, "
      "with labels %7.3f ms\n",
      dimension, side, length, components.count, components.debris, 1e3 * least[0],
      1e3 * least[1]);
  fg__components_clear(&components);
  free(u);
}

enum { DISC_NODES = 24, FINE = 16 };

/* The area where the bilinear density is positive. */
static double bilinear_area(const float *u)
{
  long inside = 0;
  for (int n = 0; n < (DISC_NODES - 1) * (DISC_NODES - 1); ++n) {
    const float *low = u + n / (DISC_NODES - 1) * DISC_NODES + n % (DISC_NODES - 1);
    const float *high = low + DISC_NODES;
    for (int k = 0; k < FINE * FINE; ++k) {
      double s = (k % FINE + 0.5) / FINE, t = ((double)(k / FINE) + 0.5) / FINE;
      inside += (1 - t) * ((1 - s) * (double)low[0] + s * (double)low[1]) +
                    t * ((1 - s) * (double)high[0] + s * (double)high[1]) >
                0.0;
    }
  }
  return (double)inside / (FINE * FINE);
}

/* Discs whose density falls off like tanh over 1.1 cells, at 100 places. */
static void compare_sizes(double radius)
{
  enum { PLACES = 100 };
  double exact = 3.14159265358979 * radius * radius, sum[2] = {0.0, 0.0};
  fg__components components = {0};
  for (int place = 0; place < PLACES; ++place) {
    float u[DISC_NODES * DISC_NODES];
    double x = 11.0 + 0.1 * (place % 10), y = 11.0 + place / 10 * 0.1;
    for (int n = 0; n < DISC_NODES * DISC_NODES; ++n)
      u[n] = (float)tanh(
          (radius - hypot(n % DISC_NODES - x, (double)(n / DISC_NODES) - y)) / 1.1);
    fg__component_grid grid = {.nodes = {DISC_NODES, DISC_NODES}, .u = u};
    if (fg__components_count(&components, NULL, &grid))
      return;
    sum[0] += components.area[0] / exact - 1.0;
    sum[1] += bilinear_area(u) / exact - 1.0;
  }
  printf("disc of radius %g cells: shares %+.1f %%, bilinear zero set %+.1f %%\n", radius,
         100.0 * sum[0] / PLACES, 100.0 * sum[1] / PLACES);
  fg__components_clear(&components);
}

int main(void)
{
  for (double length = 3.0; length <= 12.0; length *= 2.0)
    time_counts(257, 2, length);
  time_counts(1025, 2, 6.0);
  time_counts(65, 3, 6.0);
  for (double length = 3.0; length <= 12.0; length *= 2.0)
    time_counts(129, 3, length);
  for (double radius = 1.5; radius <= 6.0; radius *= 2.0)
    compare_sizes(radius);
  compare_sizes(2.0);
  return EXIT_SUCCESS;
}
