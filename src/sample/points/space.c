/* Points that fill a volume, and lie on no grid: a lattice on which each sample is the
 * value of the linear field that fits the nearest points best (moving least squares:
 * Lancaster and Salkauskas 1981). */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/weighted.h"
#include "sample/points/nearest.h"
#include "sample/points/points.h"

enum {
  FITTED = 16, /* points of a sample's fit; the next one is where weights end */
  LEAST = 5,   /* of these that have a value: a linear field has 4 coefficients */
  FEWEST = 64, /* points of a volume */
  SAMPLES_A_POINT = 64, /* at most, and these: */
  FEWEST_SAMPLES = 4096,
  MOST_SAMPLES = 1 << 20
};

/* Samples lie so close, in mean distances of points. */
static const double FINE = 0.5;

/* Of the reach of its points, so far from their centre a sample lies outside them: 3/8 on
 * a plane that bounds random points, give or take 0.1, and 0.6 a mean distance beyond. */
static const double OUTSIDE = 0.6;

/* Of the nearest point's own reach: a sample farther from it lies in a gap. */
static const double GAP = 1.25;

/* Of a weight's: the slope across neighbours that lie in one plane is small, not any. */
static const double RIGID = 1e-5;

typedef struct cloud {
  const fg__scatter *points;
  fg__point_tree tree;
  float *reach; /* [count], distance to its 16th nearest */
} cloud;

/* Wendland's function: smooth, 0 from 1 on. */
static double weight_of(double r)
{
  const double rest = fmax(0.0, 1.0 - r);
  return rest * rest * rest * rest * (4.0 * r + 1.0);
}

/* Solves the symmetric, positive definite matrix for its first unknown, by elimination
 * from the last. */
static void solve_first(double out[3], double m[4][4], double right[4][3])
{
  for (int n = 3; n > 0; --n)
    for (int i = 0; i < n; ++i) {
      const double factor = m[i][n] / m[n][n];
      for (int j = 0; j < n; ++j)
        m[i][j] -= factor * m[n][j];
      for (int c = 0; c < 3; ++c)
        right[i][c] -= factor * right[n][c];
    }
  for (int c = 0; c < 3; ++c)
    out[c] = right[0][c] / m[0][0];
}

static bool has_value(const fg__scatter *points, int i)
{
  return isfinite(points->velocity[0][i]) && isfinite(points->velocity[1][i]) &&
         isfinite(points->velocity[2][i]);
}

/* The fit's value at its centre; false where fewer points have a value than it takes. */
static bool fit(double out[3], const cloud *c, const double at[3],
                const fg__nearest_points *near, double reach)
{
  const fg__scatter *points = c->points;
  double m[4][4] = {{0.0}}, right[4][3] = {{0.0}};
  int used = 0;
  for (int n = 0; n < FITTED; ++n) {
    const int i = near->point[n];
    if (!has_value(points, i))
      continue;
    ++used;
    const double weight = weight_of(sqrt(near->distance[n]) / reach);
    double term[4] = {1.0};
    for (int k = 0; k < 3; ++k)
      term[k + 1] = (points->position[k][i] - at[k]) / reach;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b)
        m[a][b] += weight * term[a] * term[b];
      for (int k = 0; k < 3; ++k)
        right[a][k] += weight * term[a] * (double)points->velocity[k][i];
    }
  }
  for (int a = 1; a < 4; ++a)
    m[a][a] += RIGID * m[0][0];
  if (used < LEAST || !(m[0][0] > 0.0))
    return false;
  solve_first(out, m, right);
  return true;
}

static bool is_outside(const cloud *c, const double at[3], const fg__nearest_points *near,
                       double reach)
{
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    double sum = 0.0;
    for (int n = 0; n < FITTED; ++n)
      sum += c->points->position[k][near->point[n]] - at[k];
    square += sum * sum;
  }
  return sqrt(square) > OUTSIDE * FITTED * reach ||
         sqrt(near->distance[0]) > GAP * (double)c->reach[near->point[0]];
}

static void sample(float *const out[3], size_t n, const cloud *c, const double at[3])
{
  fg__nearest_points near;
  double value[3] = {(double)NAN, (double)NAN, (double)NAN};
  if (fg__point_tree_find(&near, &c->tree, at, FITTED + 1)) {
    const double reach = sqrt(near.distance[FITTED]);
    double fitted[3];
    if (has_value(c->points, near.point[0]) && !is_outside(c, at, &near, reach) &&
        fit(fitted, c, at, &near, reach))
      for (int k = 0; k < 3; ++k)
        value[k] = fitted[k];
  }
  for (int k = 0; k < 3; ++k)
    out[k][n] = (float)value[k];
}

static bool is_in_region(const fg__scatter *points, size_t i)
{
  bool in = true;
  for (int k = 0; k < points->region.axes; ++k)
    in = in && points->position[k][i] >= points->region.low[k] &&
         points->position[k][i] <= points->region.high[k];
  return in;
}

/* The reach of each point; *spacing: the mean distance of points where they are as dense
 * as round the median one in the region. */
static fg_status measure(cloud *c, double *spacing)
{
  const fg__scatter *points = c->points;
  const size_t count = points->count;
  size_t inside = 0;
  float *sorted = fg__allocate(count, sizeof *sorted);
  c->reach = fg__allocate(count, sizeof *c->reach);
  if (!sorted || !c->reach) {
    free(sorted);
    return fg__fail_memory(points->context, "a local spacing", 2 * count * 4);
  }
  for (size_t i = 0; i < count; ++i) {
    const double at[3] = {points->position[0][i], points->position[1][i],
                          points->position[2][i]};
    fg__nearest_points near;
    const bool found = fg__point_tree_find(&near, &c->tree, at, FITTED + 1);
    c->reach[i] = found ? (float)sqrt(near.distance[FITTED]) : 0.0f;
    if (is_in_region(points, i))
      sorted[inside++] = c->reach[i];
  }
  if (inside == 0) {
    free(sorted);
    return fg__fail(points->context, FG_STATUS_ARGUMENT,
                    "%s: none of its %zu points lies in the region", points->path, count);
  }
  qsort(sorted, inside, sizeof *sorted, fg__by_size_of_floats);
  *spacing = (double)sorted[inside / 2] * cbrt(4.0 / 3.0 * 3.14159265358979 / FITTED);
  free(sorted);
  return FG_STATUS_OK;
}

static void fit_sizes(int size[3], const double width[3], double step, double most)
{
  double samples;
  step = fmax(step, fmax(width[0], fmax(width[1], width[2])) / MOST_SAMPLES);
  do {
    samples = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double intervals = fmin(fmax(ceil(width[k] / step), 2.0), MOST_SAMPLES);
      size[k] = 1 + (int)intervals;
      samples *= size[k];
    }
    step *= 1.02;
  } while (samples > most);
}

/* The box of the points, or its part in the region. */
static fg_status find_box(double low[3], double high[3], const fg__scatter *points)
{
  static const char *const letters[] = {"x", "y", "z"};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    low[k] = HUGE_VAL;
    high[k] = -HUGE_VAL;
    for (size_t i = 0; i < points->count; ++i) {
      low[k] = fmin(low[k], points->position[k][i]);
      high[k] = fmax(high[k], points->position[k][i]);
    }
    status = fg__region_clip(&low[k], &high[k], points->context, points->path,
                             &points->region, k, letters[k], "");
  }
  return status;
}

static fg_status make_lattice(fg__point_grid *out, const fg__scatter *points,
                              const double low[3], const double high[3], double step)
{
  const double most =
      fmin(MOST_SAMPLES, FEWEST_SAMPLES + SAMPLES_A_POINT * (double)points->count);
  const double width[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  *out = (fg__point_grid){.dimension = 3, .points = points->count};
  fit_sizes(out->size, width, step, most);
  const size_t samples = fg__point_grid_samples(out);
  for (int k = 0; k < 3; ++k) {
    out->axis[k] = fg__allocate((size_t)out->size[k], sizeof *out->axis[k]);
    out->velocity[k] = fg__allocate(samples, sizeof *out->velocity[k]);
    if (!out->axis[k] || !out->velocity[k])
      return fg__fail_memory(points->context, "a field's samples", 12 * samples);
    for (int i = 0; i < out->size[k]; ++i)
      out->axis[k][i] = low[k] + width[k] * i / (out->size[k] - 1);
  }
  return FG_STATUS_OK;
}

static fg_status fill(fg__point_grid *out, const cloud *c)
{
  size_t n = 0;
  for (int z = 0; z < out->size[2]; ++z)
    for (int y = 0; y < out->size[1]; ++y) {
      for (int x = 0; x < out->size[0]; ++x)
        sample(out->velocity, n++, c,
               (const double[3]){out->axis[0][x], out->axis[1][y], out->axis[2][z]});
      const fg_status status = fg__check_stop(c->points->context);
      if (status != FG_STATUS_OK)
        return status;
    }
  return FG_STATUS_OK;
}

bool fg__scatter_fills_space(const fg__scatter *points)
{
  return points->dimension == 3 && points->count >= FEWEST && !points->geographic;
}

fg_status fg__scatter_fit(fg__point_grid *out, const fg__scatter *points)
{
  cloud c = {.points = points};
  double spacing = 0.0, low[3], high[3];
  fg_status status = find_box(low, high, points);
  if (status == FG_STATUS_OK)
    status = fg__point_tree_create(
        &c.tree, points->context, (const double *const *)points->position, points->count);
  if (status == FG_STATUS_OK)
    status = measure(&c, &spacing);
  if (status == FG_STATUS_OK)
    status = make_lattice(out, points, low, high, FINE * spacing);
  if (status == FG_STATUS_OK)
    status = fill(out, &c);
  free(c.reach);
  fg__point_tree_clear(&c.tree);
  return status;
}
