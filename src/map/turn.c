/* How a projection turns and enlarges what is small: by differences. */
#include <math.h>

#include "map/map.h"
#include "sphere/sphere.h"

/* Step of differences, in degrees: they agree with proj_factors to some 1e-10. */
static const double STEP = 1e-4;

/* Derivatives of the plane's coordinates along east and north, column 0 and 1, by metres
 * on the ground: N cos(latitude) and M a radian. At a pole they are those a little off
 * it, on the same meridian. */
static void differentiate(const fg__map *map, double longitude, double latitude,
                          double out[2][2])
{
  const double most = 90.0 - 2.0 * STEP;
  const double at = fmin(fmax(latitude, -most), most);
  const double cosine = cos(at * FG__RADIANS), sine = sin(at * FG__RADIANS);
  double radius, flatness;
  fg__map_ellipsoid(map, &radius, &flatness);
  const double w = 1.0 - flatness * sine * sine, across = radius / sqrt(w);
  const double along = across * (1.0 - flatness) / w;
  const double per_step = fg__map_unit(map) / (2.0 * STEP * FG__RADIANS);
  const double east[4] = {longitude + STEP, longitude - STEP, longitude, longitude};
  const double north[4] = {at, at, at + STEP, at - STEP};
  double image[2][4];
  fg__map_forward(map, 4, east, north, image[0], image[1]);
  for (int k = 0; k < 2; ++k) {
    out[k][0] = (image[k][0] - image[k][1]) * per_step / (across * cosine);
    out[k][1] = (image[k][2] - image[k][3]) * per_step / along;
  }
}

static void turn_by(double by[2][2], float *east, float *north)
{
  const double u = (double)*east, v = (double)*north, speed = sqrt(u * u + v * v);
  const double x = by[0][0] * u + by[0][1] * v, y = by[1][0] * u + by[1][1] * v;
  const double factor = speed / sqrt(x * x + y * y);
  if (!(speed > 0.0) && !isnan(speed)) /* calm wherever there is an image */
    return;
  *east = isfinite(factor) ? (float)(x * factor) : NAN;
  *north = isfinite(factor) ? (float)(y * factor) : NAN;
}

void fg__map_turn(const fg__map *map, size_t n, const double *longitude,
                  const double *latitude, float *east, float *north)
{
  for (size_t i = 0; i < n; ++i) {
    double by[2][2];
    differentiate(map, longitude[i], latitude[i], by);
    turn_by(by, &east[i], &north[i]);
  }
}

void fg__map_turn_back(const fg__map *map, size_t n, const double *longitude,
                       const double *latitude, float *x, float *y)
{
  for (size_t i = 0; i < n; ++i) {
    double by[2][2];
    differentiate(map, longitude[i], latitude[i], by);
    const double determinant = by[0][0] * by[1][1] - by[0][1] * by[1][0];
    double back[2][2] = {{by[1][1] / determinant, -by[0][1] / determinant},
                         {-by[1][0] / determinant, by[0][0] / determinant}};
    turn_by(back, &x[i], &y[i]);
  }
}

/* Derivatives at every fourth position, of which quartics go through five. */
enum { STRIDE = 4, NODES = 5, SPAN = STRIDE * (NODES - 1) };

/* Fourth differences of derivatives, over their size: what they are interpolated from is
 * smooth enough for errors of some 1e-8. */
static const double SMOOTH = 1e-6;

/* Derivatives at the nodes of a span; false where they are not smooth. */
static bool find_nodes(double by[NODES][2][2], const fg__map *map,
                       const double *longitude, const double *latitude)
{
  double size = 0.0, rough = 0.0;
  for (int k = 0; k < NODES; ++k)
    differentiate(map, longitude[STRIDE * k], latitude[STRIDE * k], by[k]);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const double fourth = by[0][a][b] - 4.0 * by[1][a][b] + 6.0 * by[2][a][b] -
                            4.0 * by[3][a][b] + by[4][a][b];
      size += by[2][a][b] * by[2][a][b];
      rough += fourth * fourth;
    }
  return rough <= SMOOTH * SMOOTH * size; /* not where there is no image: NaN */
}

/* Weights of the nodes at position i of a span, after Lagrange. */
static void weigh_nodes(double weight[NODES], int i)
{
  for (int k = 0; k < NODES; ++k) {
    weight[k] = 1.0;
    for (int other = 0; other < NODES; ++other)
      if (other != k)
        weight[k] *= ((double)i / STRIDE - other) / (k - other);
  }
}

void fg__map_turn_row(const fg__map *map, size_t n, const double *longitude,
                      const double *latitude, float *east, float *north)
{
  double weight[SPAN][NODES], node[NODES][2][2];
  for (int i = 0; i < SPAN; ++i)
    weigh_nodes(weight[i], i);
  size_t first = 0;
  for (; first + SPAN < n; first += SPAN) {
    if (!find_nodes(node, map, longitude + first, latitude + first)) {
      fg__map_turn(map, SPAN, longitude + first, latitude + first, east + first,
                   north + first);
      continue;
    }
    for (size_t i = 0; i < SPAN; ++i) {
      double by[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
      for (int k = 0; k < NODES; ++k)
        for (int a = 0; a < 4; ++a)
          by[a / 2][a % 2] += weight[i][k] * node[k][a / 2][a % 2];
      turn_by(by, &east[first + i], &north[first + i]);
    }
  }
  fg__map_turn(map, n - first, longitude + first, latitude + first, east + first,
               north + first);
}

double fg__map_area_scale(const fg__map *map, double longitude, double latitude)
{
  double by[2][2];
  differentiate(map, longitude, latitude, by);
  return fabs(by[0][0] * by[1][1] - by[0][1] * by[1][0]);
}

double fg__map_length_scale(const fg__map *map, double longitude, double latitude)
{
  double by[2][2], sum = 0.0;
  differentiate(map, longitude, latitude, by);
  for (int k = 0; k < 2; ++k)
    sum += by[k][0] * by[k][0] + by[k][1] * by[k][1];
  const double product = by[0][0] * by[1][1] - by[0][1] * by[1][0];
  const double root = sum * sum - 4.0 * product * product;
  return sqrt(0.5 *
              (sum + sqrt(root > 0.0 ? root : 0.0))); /* the larger singular value */
}
