#include "solver/subdomain/pocket.h"

#include <math.h>
#include <string.h>

/* Newton's method is done when it has moved no node by more than this: it would next by
 * about the square, less than the rounding of floats. */
static const double solved = 1e-4;
enum { MOST_ITERATIONS = 12, MOST_SUBSTEPS = 400 };

/* Beyond this an iterate has left the wells' neighbourhood for good. */
static const double most_density = 3.0;

/* Share of a pocket's energy by which the rounding of its density to floats, and so of
 * its mass, may raise it: with 1e-12 a fifth of the solutions were refused. */
static const double energy_rounding = 1e-8;

/* Of the nodes' numbers that a row of L K joins. */
static int bandwidth_of(const fg__pocket *pocket)
{
  int width = 0;
  for (int n = 0; n < pocket->nodes; ++n)
    for (int k = 0; k < pocket->entries; ++k) {
      int target = pocket->target[n * pocket->entries + k];
      int distance = target > n ? target - n : n - target;
      if (target >= 0 && distance > width)
        width = distance;
    }
  return 2 * width;
}

/* A band of `width` entries on both sides of the diagonal, which pivots widen to the
 * right: entry (n, j) is at n * stride + j - n + width. */
typedef struct room {
  int width, stride;
  double *matrix; /* [nodes * stride] */
  double *rhs, *curvature, *start;
} room;

enum { VECTORS = 3 };

static room room_in(double *space, const fg__pocket *pocket)
{
  room r = {.width = bandwidth_of(pocket), .matrix = space};
  r.stride = 3 * r.width + 1;
  r.rhs = space + pocket->nodes * r.stride;
  r.curvature = r.rhs + pocket->nodes;
  r.start = r.curvature + pocket->nodes;
  return r;
}

int fg__pocket_space(const fg__pocket *pocket)
{
  return pocket->nodes * (3 * bandwidth_of(pocket) + 1 + VECTORS);
}

/* So that [j] is the entry in column j. */
static double *row_of(const room *r, int n)
{
  return r->matrix + (n * r->stride + r->width - n);
}

static double apply(const fg__pocket *pocket, const double *rows, const double *x,
                    int node)
{
  const int *target = pocket->target + node * pocket->entries;
  const double *row = rows + node * pocket->entries;
  double sum = 0.0;
  for (int n = 0; n < pocket->entries; ++n)
    if (target[n] >= 0)
      sum += row[n] * x[target[n]];
  return sum;
}

static void find_potential(const fg__pocket *pocket, const double *u, double *w)
{
  for (int n = 0; n < pocket->nodes; ++n)
    w[n] = 2.0 * u[n] * (u[n] * u[n] - 1.0) + apply(pocket, pocket->energy, u, n);
}

static double energy_of(const fg__pocket *pocket, const double *u)
{
  double sum = 0.0;
  for (int n = 0; n < pocket->nodes; ++n) {
    double well = u[n] * u[n] - 1.0;
    sum += 0.5 * pocket->mass[n] *
           (well * well + u[n] * apply(pocket, pocket->energy, u, n));
  }
  return sum;
}

static int least(int a, int b)
{
  return a < b ? a : b;
}

/* 1 + tau L (Psi'' + K). */
static void fill_matrix(const fg__pocket *pocket, double tau, const room *r)
{
  int nodes = pocket->nodes, entries = pocket->entries;
  memset(r->matrix, 0, (size_t)(nodes * r->stride) * sizeof *r->matrix);
  for (int n = 0; n < nodes; ++n) {
    double *row = row_of(r, n);
    row[n] = 1.0;
    for (int k = 0; k < entries; ++k) {
      int middle = pocket->target[n * entries + k];
      if (middle < 0)
        continue;
      double factor = tau * pocket->laplacian[n * entries + k];
      const int *target = pocket->target + middle * entries;
      const double *energy = pocket->energy + middle * entries;
      row[middle] += factor * r->curvature[middle];
      for (int m = 0; m < entries; ++m)
        if (target[m] >= 0)
          row[target[m]] += factor * energy[m];
    }
  }
}

static void swap_rows(double *a, double *b, int count)
{
  for (int n = 0; n < count; ++n) {
    double kept = a[n];
    a[n] = b[n];
    b[n] = kept;
  }
}

static void subtract(double *restrict from, const double *restrict row, double factor,
                     int count)
{
  for (int n = 0; n < count; ++n)
    from[n] -= factor * row[n];
}

/* Gauss with row pivots; the solution replaces the right-hand side. False: singular. */
static bool eliminate(const room *r, int nodes)
{
  double *x = r->rhs;
  int filled = 0; /* columns that rows to come may reach, for the pivots so far */
  for (int k = 0; k < nodes; ++k) {
    int last = least(k + r->width, nodes - 1), pivot = k;
    for (int i = k + 1; i <= last; ++i)
      if (fabs(row_of(r, i)[k]) > fabs(row_of(r, pivot)[k]))
        pivot = i;
    double *row = row_of(r, k);
    int reach = least(pivot + r->width + 1, nodes);
    filled = reach > filled ? reach : filled;
    if (pivot != k) {
      swap_rows(row + k, row_of(r, pivot) + k, filled - k);
      swap_rows(x + k, x + pivot, 1);
    }
    if (!(fabs(row[k]) > 0.0))
      return false;
    for (int i = k + 1; i <= last; ++i) {
      double *below = row_of(r, i), factor = below[k] / row[k];
      if (factor == 0.0)
        continue;
      subtract(below + k + 1, row + k + 1, factor, filled - k - 1);
      x[i] -= factor * x[k];
    }
  }
  for (int k = nodes - 1; k >= 0; --k) {
    int end = least(k + 2 * r->width + 1, nodes);
    const double *row = row_of(r, k);
    for (int j = k + 1; j < end; ++j)
      x[k] -= row[j] * x[j];
    x[k] /= row[k];
  }
  return true;
}

/* Newton's method on u + tau L w(u) = p. */
static bool solve(const fg__pocket *pocket, double tau, const double *p, double *u,
                  double *w, const room *r)
{
  int nodes = pocket->nodes;
  for (int iteration = 0; iteration < MOST_ITERATIONS; ++iteration) {
    find_potential(pocket, u, w);
    for (int n = 0; n < nodes; ++n) {
      r->rhs[n] = p[n] - u[n] - tau * apply(pocket, pocket->laplacian, w, n);
      r->curvature[n] = 6.0 * u[n] * u[n] - 2.0;
    }
    fill_matrix(pocket, tau, r);
    if (!eliminate(r, nodes))
      return false;
    double largest = 0.0;
    for (int n = 0; n < nodes; ++n) {
      u[n] += r->rhs[n];
      if (!(fabs(u[n]) <= most_density))
        return false;
      largest = fmax(largest, fabs(r->rhs[n]));
    }
    if (largest <= solved) {
      find_potential(pocket, u, w);
      return true;
    }
  }
  return false;
}

static bool falls(double after, double before)
{
  return after <= before + energy_rounding * fabs(before);
}

void fg__pocket_step(const fg__pocket *pocket, const fg__pocket_task *task, double *u,
                     double *w, double *space)
{
  room r = room_in(space, pocket);
  size_t size = (size_t)pocket->nodes * sizeof *u;
  double energy = energy_of(pocket, task->before);
  if (solve(pocket, task->effective, task->p, u, w, &r) &&
      falls(energy_of(pocket, u), energy))
    return;
  double done = 0.0, tau = 0.5 * task->tau;
  memcpy(u, task->before, size);
  for (int n = 0; n < MOST_SUBSTEPS && done < task->tau; ++n) {
    memcpy(r.start, u, size);
    tau = fmin(tau, task->tau - done);
    bool good = solve(pocket, tau, r.start, u, w, &r);
    double after = good ? energy_of(pocket, u) : energy;
    if (good && falls(after, energy)) {
      done += tau;
      energy = after;
      tau *= 2.0;
    } else {
      memcpy(u, r.start, size);
      tau *= 0.5;
    }
  }
  find_potential(pocket, u, w);
}
