/* Where a particle goes, and where a reader would have it go. */
#include "score/measures.h"

#include <math.h>
#include <string.h>

enum { PARTICLES = 500, MOST_TRIALS = 1 << 18, STEPS_A_SIDE = 512 };

/* Of the disc that particles are followed in, of the domain's side; and their longest
 * way, in radii. */
static const double RADIUS = 0.15, LONGEST = 4.0;

typedef struct work {
  const fg__domain_raster *raster;
  const fg__harmonic *harmonic; /* NULL: the field itself */
  const double (*start)[3];
  double (*end)[3];
  int count;
} work;

/* Of index n in base b (Halton 1960). */
static double radical_inverse(int n, int b)
{
  double digit = 1.0 / b, sum = 0.0;
  for (; n > 0; n /= b, digit /= b)
    sum += n % b * digit;
  return sum;
}

static int place_particles(double (*out)[3], const fg__domain_raster *raster)
{
  static const int base[3] = {2, 3, 5};
  int count = 0;
  for (int n = 1; n <= MOST_TRIALS && count < PARTICLES; ++n) {
    double ignored[3], *at = out[count];
    for (int k = 0; k < 3; ++k)
      at[k] = raster->origin[k] +
              (k < raster->dimension
                   ? radical_inverse(n, base[k]) * raster->size[k] * raster->cell[k]
                   : 0.0);
    count += fg_field_velocity(raster->field, at, ignored);
  }
  return count;
}

/* Between the nearest centres of cells that are known. */
static bool interpolate(double out[3], const work *w, const double position[3])
{
  const fg__domain_raster *raster = w->raster;
  const int dimension = raster->dimension == 3 ? 3 : 2;
  int low[3] = {0};
  double inside[3] = {0.0}, weights = 0.0;
  for (int k = 0; k < dimension; ++k) {
    const double at = (position[k] - raster->origin[k]) / raster->cell[k] - 0.5;
    if (!(at >= -1.0 && at < raster->size[k]))
      return false;
    low[k] = (int)floor(at);
    inside[k] = at - low[k];
  }
  out[0] = out[1] = out[2] = 0.0;
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    double weight = 1.0;
    size_t place = 0;
    bool there = true;
    for (int k = dimension - 1; k >= 0; --k) {
      const int far = corner >> k & 1, at = low[k] + far;
      weight *= far ? inside[k] : 1.0 - inside[k];
      there = there && at >= 0 && at < raster->size[k];
      place = place * (size_t)raster->size[k] + (size_t)(there ? at : 0);
    }
    if (!there || !w->harmonic->known[place])
      continue;
    weights += weight;
    for (int k = 0; k < dimension; ++k)
      out[k] += weight * w->harmonic->value[k][place];
  }
  return weights > 0.0;
}

/* Unit; false outside the domain and where there is none. */
static bool direction_at(double out[3], const work *w, const double position[3])
{
  out[2] = 0.0;
  if (!fg_field_tangent(w->raster->field, position, out))
    return false;
  if (w->harmonic && !interpolate(out, w, position))
    return false;
  const double length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  for (int k = 0; k < 3; ++k)
    out[k] /= length;
  return length > 0.0;
}

/* One step of the classical method of Runge and Kutta. */
static bool step(double out[3], const work *w, const double from[3], double length)
{
  static const double part[4] = {0.0, 0.5, 0.5, 1.0};
  static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  double slope[3] = {0.0}, at[3], ignored[3];
  memcpy(out, from, 3 * sizeof *out);
  for (int stage = 0; stage < 4; ++stage) {
    for (int k = 0; k < 3; ++k)
      at[k] = from[k] + part[stage] * length * slope[k];
    if (!direction_at(slope, w, at))
      return false;
    for (int k = 0; k < 3; ++k)
      out[k] += weight[stage] * length * slope[k];
  }
  return fg_field_velocity(w->raster->field, out, ignored);
}

static double distance(const double a[3], const double b[3])
{
  return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Up to the disc's edge, the domain's or the longest way. */
static void follow(double end[3], const work *w, const double start[3])
{
  const double length = w->raster->side / STEPS_A_SIDE;
  const double radius = RADIUS * w->raster->side;
  double next[3];
  memcpy(end, start, 3 * sizeof *end);
  for (int n = (int)(LONGEST * radius / length); n > 0; --n) {
    if (!step(next, w, end, length))
      return;
    const double before = distance(end, start), after = distance(next, start);
    if (after >= radius) {
      for (int k = 0; k < 3; ++k)
        end[k] += (next[k] - end[k]) * (radius - before) / (after - before);
      return;
    }
    memcpy(end, next, sizeof next);
  }
}

static void follow_all(void *argument, const fg__thread *thread)
{
  const work *w = argument;
  int n, end;
  fg__threads_range(thread, w->count, 1, &n, &end);
  for (; n < end; ++n)
    follow(w->end[n], w, w->start[n]);
}

double fg__score_advection(const fg__domain_raster *raster, const fg__harmonic *harmonic,
                           fg__threads *threads)
{
  double start[PARTICLES][3], end[2][PARTICLES][3], sum = 0.0;
  const int count = place_particles(start, raster);
  for (int n = 0; n < 2; ++n) {
    work w = {.raster = raster,
              .harmonic = n ? harmonic : NULL,
              .start = (const double(*)[3])start,
              .end = end[n],
              .count = count};
    fg__threads_run(threads, follow_all, &w);
  }
  for (int n = 0; n < count; ++n)
    sum += distance(end[0][n], end[1][n]);
  return sum / (count * RADIUS * raster->side);
}
