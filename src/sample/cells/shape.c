/* The maps from reference cells: P(at) = sum of weight[i](at) * corner[i], and their
 * inverses. */
#include <math.h>

#include "sample/cells/set.h"

static const struct {
  int dimension, corners;
} SHAPES[FG__CELL_SHAPES] = {
    [FG__CELL_TRIANGLE] = {2, 3},    [FG__CELL_QUAD] = {2, 4},
    [FG__CELL_TETRAHEDRON] = {3, 4}, [FG__CELL_PYRAMID] = {3, 5},
    [FG__CELL_WEDGE] = {3, 6},       [FG__CELL_HEXAHEDRON] = {3, 8}};

int fg__cell_dimension(fg__cell_shape shape)
{
  return SHAPES[shape].dimension;
}

int fg__cell_corners(fg__cell_shape shape)
{
  return SHAPES[shape].corners;
}

/* A factor of a weight, 1 - x or x, and its slope. */
static double factor(double x, int end)
{
  return end ? x : 1.0 - x;
}

static double factor_slope(int end)
{
  return end ? 1.0 : -1.0;
}

/* Corners of a quad and of both ends of a hexahedron go round: (0,0) (1,0) (1,1) (0,1).
 */
static const int ROUND[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static void weigh_quad(const double at[3], double weight[4], double slope[4][3])
{
  for (int i = 0; i < 4; ++i) {
    const double x = factor(at[0], ROUND[i][0]), y = factor(at[1], ROUND[i][1]);
    weight[i] = x * y;
    slope[i][0] = factor_slope(ROUND[i][0]) * y;
    slope[i][1] = x * factor_slope(ROUND[i][1]);
    slope[i][2] = 0.0;
  }
}

/* 1 - x - y (- z), x, y (, z) */
static void weigh_simplex(const double at[3], int dimension, double *weight,
                          double slope[][3])
{
  weight[0] = 1.0;
  for (int i = 0; i <= dimension; ++i)
    for (int k = 0; k < 3; ++k)
      slope[i][k] = i == 0 ? -1.0 : k + 1 == i ? 1.0 : 0.0;
  for (int k = 0; k < dimension; ++k) {
    weight[0] -= at[k];
    weight[k + 1] = at[k];
  }
}

/* Those of a face, once for each of its two ends along the last coordinate. */
static void extrude(const double at[3], int corners, double *weight, double slope[][3])
{
  for (int i = corners - 1; i >= 0; --i)
    for (int end = 1; end >= 0; --end) {
      const int to = i + end * corners;
      const double z = factor(at[2], end);
      slope[to][2] = weight[i] * factor_slope(end);
      slope[to][0] = slope[i][0] * z;
      slope[to][1] = slope[i][1] * z;
      weight[to] = weight[i] * z;
    }
}

void fg__cell_weights(fg__cell_shape shape, const double at[3],
                      double weight[FG__CELL_CORNERS], double slope[FG__CELL_CORNERS][3])
{
  double unused[FG__CELL_CORNERS][3];
  if (!slope)
    slope = unused;
  switch (shape) {
  case FG__CELL_TRIANGLE:
    weigh_simplex(at, 2, weight, slope);
    break;
  case FG__CELL_QUAD:
    weigh_quad(at, weight, slope);
    break;
  case FG__CELL_TETRAHEDRON:
    weigh_simplex(at, 3, weight, slope);
    break;
  case FG__CELL_PYRAMID: /* a hexahedron whose one end is a point */
    weigh_quad(at, weight, slope);
    for (int i = 0; i < 4; ++i) {
      slope[i][2] = -weight[i];
      slope[i][0] *= 1.0 - at[2];
      slope[i][1] *= 1.0 - at[2];
      weight[i] *= 1.0 - at[2];
    }
    weight[4] = at[2];
    slope[4][0] = slope[4][1] = 0.0;
    slope[4][2] = 1.0;
    break;
  case FG__CELL_WEDGE:
    weigh_simplex(at, 2, weight, slope);
    extrude(at, 3, weight, slope);
    break;
  case FG__CELL_HEXAHEDRON:
  case FG__CELL_SHAPES:
    weigh_quad(at, weight, slope);
    extrude(at, 4, weight, slope);
    break;
  }
}

double fg__cell_excess(fg__cell_shape shape, const double at[3])
{
  const int dimension = SHAPES[shape].dimension;
  double excess = -1.0;
  for (int k = 0; k < dimension; ++k) {
    excess = fmax(excess, -at[k]);
    excess = fmax(excess, at[k] - 1.0);
  }
  if (shape == FG__CELL_TETRAHEDRON)
    excess = fmax(excess, at[0] + at[1] + at[2] - 1.0);
  if (shape == FG__CELL_TRIANGLE || shape == FG__CELL_WEDGE)
    excess = fmax(excess, at[0] + at[1] - 1.0);
  return excess;
}

/* Solves matrix * x = right by Cramer's rule; false when the matrix is singular. Two
 * dimensions are three with a last one that is untouched. */
static bool solve(double x[3], double m[3][3], const double right[3])
{
  double cofactor[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      cofactor[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  const double determinant =
      m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
  for (int j = 0; j < 3; ++j)
    x[j] = (right[0] * cofactor[0][j] + right[1] * cofactor[1][j] +
            right[2] * cofactor[2][j]) /
           determinant;
  return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
}

/* Newton's method doubles the figures with each step, so that a place inside a sound cell
 * takes 2 to 6; what needs more lies far outside, or the cell is folded. */
enum { MOST_STEPS = 16 };

/* Of the cell's width: the rounding of double precision and a few products. */
static const double MISS = 1e-13;

/* In cells: an iterate that is further away has diverged. */
static const double FAR_AWAY = 8.0;

bool fg__cell_invert(double at[3], fg__cell_shape shape,
                     double corner[FG__CELL_CORNERS][3], const double point[3],
                     double width)
{
  const int dimension = SHAPES[shape].dimension, corners = SHAPES[shape].corners;
  const bool affine = shape == FG__CELL_TRIANGLE || shape == FG__CELL_TETRAHEDRON;
  double weight[FG__CELL_CORNERS], slope[FG__CELL_CORNERS][3];
  for (int step = 0; step < MOST_STEPS; ++step) {
    double rest[3] = {0.0, 0.0, 0.0}, matrix[3][3] = {{0}, {0}, {0, 0, 1}}, move[3];
    fg__cell_weights(shape, at, weight, slope);
    for (int k = 0; k < dimension; ++k) {
      rest[k] = point[k];
      for (int j = 0; j < dimension; ++j)
        matrix[k][j] = 0.0;
      for (int i = 0; i < corners; ++i) {
        rest[k] -= weight[i] * corner[i][k];
        for (int j = 0; j < dimension; ++j)
          matrix[k][j] += slope[i][j] * corner[i][k];
      }
    }
    if (fabs(rest[0]) <= MISS * width && fabs(rest[1]) <= MISS * width &&
        fabs(rest[2]) <= MISS * width)
      return true;
    if (!solve(move, matrix, rest))
      return false;
    for (int k = 0; k < dimension; ++k) {
      at[k] += move[k];
      if (!(fabs(at[k] - 0.5) <= FAR_AWAY))
        return false;
    }
    if (affine)
      return true;
  }
  return false;
}
