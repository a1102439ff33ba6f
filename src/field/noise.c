#include "field/noise.h"

#include <math.h>

#include "base/mix.h"

/* Mean over all phases of the sum of squared weights of the quadratic B-spline: by its
 * root smoothing lowers the standard deviation along each axis. */
static const double spline_square_sum = 0.55;

/* A number in [-1, 1) of the lattice point i of a row. */
static double lattice_value(uint64_t row_key, int64_t i)
{
  return (double)(int64_t)fg__mix(row_key ^ (uint64_t)i) * 0x1p-63;
}

static fg__noise_axis axis_of(int cells, double spacing, bool periodic, double length)
{
  if (!periodic)
    return (fg__noise_axis){spacing, length, 0};
  double side = spacing * cells;
  int64_t intervals = (int64_t)fmax(1.0, round(side / length));
  return (fg__noise_axis){spacing, side / (double)intervals, intervals};
}

fg__noise fg__noise_of(int dimension, const int cells[3], const double spacing[3],
                       const bool periodic[3], double mean, double amplitude,
                       double length, uint64_t seed)
{
  fg__noise out = {.dimension = dimension,
                   .mean = mean,
                   .scale = amplitude / spline_square_sum,
                   .key = fg__mix(seed)};
  if (dimension == 3)
    out.scale /= sqrt(spline_square_sum);
  for (int k = 0; k < dimension; ++k)
    out.axis[k] = axis_of(cells[k], spacing[k], periodic[k], length);
  return out;
}

/* Quadratic B-spline weights of the three lattice points round a node; returns the index
 * of the first. */
static int64_t weigh(const fg__noise_axis *axis, int node, double weight[3])
{
  double scaled = node * axis->node_spacing / axis->spacing;
  double nearest = floor(scaled + 0.5);
  double t = scaled - nearest;
  weight[0] = 0.5 * (0.5 - t) * (0.5 - t);
  weight[1] = 0.75 - t * t;
  weight[2] = 0.5 * (0.5 + t) * (0.5 + t);
  return (int64_t)nearest - 1;
}

static int64_t closed(const fg__noise_axis *axis, int64_t index)
{
  return axis->period ? (index % axis->period + axis->period) % axis->period : index;
}

/* The lattice rows round a row of nodes: three in 2D, nine in 3D. */
typedef struct lattice_rows {
  int count;
  uint64_t key[9];
  double weight[9];
} lattice_rows;

static lattice_rows rows_round(const fg__noise *noise, int j, int k)
{
  lattice_rows out = {.count = noise->dimension == 3 ? 9 : 3};
  double wy[3], wz[3] = {1.0, 0.0, 0.0};
  int64_t y = weigh(&noise->axis[1], j, wy);
  int64_t z = noise->dimension == 3 ? weigh(&noise->axis[2], k, wz) : 0;
  for (int n = 0; n < out.count; ++n) {
    uint64_t key = noise->key;
    if (noise->dimension == 3)
      key = fg__mix(key ^ (uint64_t)closed(&noise->axis[2], z + n / 3));
    out.key[n] = fg__mix(key ^ (uint64_t)closed(&noise->axis[1], y + n % 3));
    out.weight[n] = noise->dimension == 3 ? wz[n / 3] * wy[n % 3] : wy[n];
  }
  return out;
}

void fg__noise_row(const fg__noise *noise, int j, int k, int first, int count, float *out)
{
  const fg__noise_axis *axis = &noise->axis[0];
  lattice_rows rows = rows_round(noise, j, k);
  double value[9][3] = {{0.0}}; /* at lattice points held ... held + 2 of each row */
  int64_t held = INT64_MIN;
  for (int n = 0; n < count; ++n) {
    double wx[3];
    int64_t x = weigh(axis, first + n, wx);
    if (held < x - 3)
      held = x - 3;
    for (; held < x; ++held)
      for (int r = 0; r < rows.count; ++r) {
        value[r][0] = value[r][1];
        value[r][1] = value[r][2];
        value[r][2] = lattice_value(rows.key[r], closed(axis, held + 3));
      }
    double sum = 0.0;
    for (int r = 0; r < rows.count; ++r)
      for (int a = 0; a < 3; ++a)
        sum += rows.weight[r] * wx[a] * value[r][a];
    out[n] = (float)(noise->mean + noise->scale * sum);
  }
}
