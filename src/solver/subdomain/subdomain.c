#include "solver/subdomain/subdomain.h"

#include <math.h>
#include <string.h>

/* Newton's method is done when it has moved no node by more than this: it would next by
 * about the square, less than the rounding of floats. */
static const double solved = 1e-4;
enum { MOST_ITERATIONS = 12, MOST_SUBSTEPS = 400 };

/* Beyond this an iterate has left the minima's neighbourhood for good. */
static const double most_density = 3.0;

/* Share of a subdomain's energy by which the rounding of its density to floats, and so of
 * its mass, may raise it: with 1e-12 a fifth of the solutions were refused. */
static const double energy_rounding = 1e-8;

/* Of the nodes' numbers that a row of L K joins. */
static int bandwidth_of(const fg__subdomain *subdomain)
{
  int width = 0;
  for (int n = 0; n < subdomain->nodes; ++n)
    for (int k = 0; k < subdomain->entries; ++k) {
      int target = subdomain->target[n * subdomain->entries + k];
      int distance = target > n ? target - n : n - target;
      if (target >= 0 && distance > width)
        width = distance;
    }
  return 2 * width;
}

/* A band of `width` entries on both sides of the diagonal, which pivots widen to the
 * right: entry (n, j) is at n * stride + j - n + width. */
typedef struct workspace {
  int width, stride;
  double *matrix; /* [nodes * stride] */
  double *rhs, *curvature, *start;
} workspace;

enum { VECTORS = 3 };

static workspace workspace_in(double *space, const fg__subdomain *subdomain)
{
  workspace r = {.width = bandwidth_of(subdomain), .matrix = space};
  r.stride = 3 * r.width + 1;
  r.rhs = space + subdomain->nodes * r.stride;
  r.curvature = r.rhs + subdomain->nodes;
  r.start = r.curvature + subdomain->nodes;
  return r;
}

int fg__subdomain_space(const fg__subdomain *subdomain)
{
  return subdomain->nodes * (3 * bandwidth_of(subdomain) + 1 + VECTORS);
}

/* So that [j] is the entry in column j. */
static double *row_of(const workspace *r, int n)
{
  return r->matrix + (n * r->stride + r->width - n);
}

static double apply(const fg__subdomain *subdomain, const double *rows, const double *x,
                    int node)
{
  const int *target = subdomain->target + node * subdomain->entries;
  const double *row = rows + node * subdomain->entries;
  double sum = 0.0;
  for (int n = 0; n < subdomain->entries; ++n)
    if (target[n] >= 0)
      sum += row[n] * x[target[n]];
  return sum;
}

static void find_potential(const fg__subdomain *subdomain, const double *u, double *w)
{
  for (int n = 0; n < subdomain->nodes; ++n)
    w[n] = 2.0 * u[n] * (u[n] * u[n] - 1.0) + apply(subdomain, subdomain->energy, u, n);
}

static double energy_of(const fg__subdomain *subdomain, const double *u)
{
  double sum = 0.0;
  for (int n = 0; n < subdomain->nodes; ++n) {
    double well = u[n] * u[n] - 1.0;
    sum += 0.5 * subdomain->mass[n] *
           (well * well + u[n] * apply(subdomain, subdomain->energy, u, n));
  }
  return sum;
}

static int least(int a, int b)
{
  return a < b ? a : b;
}

/* 1 + tau L (Psi'' + K). */
static void fill_matrix(const fg__subdomain *subdomain, double tau, const workspace *r)
{
  int nodes = subdomain->nodes, entries = subdomain->entries;
  memset(r->matrix, 0, (size_t)(nodes * r->stride) * sizeof *r->matrix);
  for (int n = 0; n < nodes; ++n) {
    double *row = row_of(r, n);
    row[n] = 1.0;
    for (int k = 0; k < entries; ++k) {
      int middle = subdomain->target[n * entries + k];
      if (middle < 0)
        continue;
      double factor = tau * subdomain->laplacian[n * entries + k];
      const int *target = subdomain->target + middle * entries;
      const double *energy = subdomain->energy + middle * entries;
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
static bool eliminate(const workspace *r, int nodes)
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
static bool solve(const fg__subdomain *subdomain, double tau, const double *p, double *u,
                  double *w, const workspace *r)
{
  int nodes = subdomain->nodes;
  for (int iteration = 0; iteration < MOST_ITERATIONS; ++iteration) {
    find_potential(subdomain, u, w);
    for (int n = 0; n < nodes; ++n) {
      r->rhs[n] = p[n] - u[n] - tau * apply(subdomain, subdomain->laplacian, w, n);
      r->curvature[n] = 6.0 * u[n] * u[n] - 2.0;
    }
    fill_matrix(subdomain, tau, r);
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
      find_potential(subdomain, u, w);
      return true;
    }
  }
  return false;
}

static bool falls(double after, double before)
{
  return after <= before + energy_rounding * fabs(before);
}

void fg__subdomain_step(const fg__subdomain *subdomain, const fg__subdomain_task *task,
                        double *u, double *w, double *space)
{
  workspace r = workspace_in(space, subdomain);
  size_t size = (size_t)subdomain->nodes * sizeof *u;
  double energy = energy_of(subdomain, task->before);
  if (solve(subdomain, task->effective, task->p, u, w, &r) &&
      falls(energy_of(subdomain, u), energy))
    return;
  double done = 0.0, tau = 0.5 * task->tau;
  memcpy(u, task->before, size);
  for (int n = 0; n < MOST_SUBSTEPS && done < task->tau; ++n) {
    memcpy(r.start, u, size);
    tau = fmin(tau, task->tau - done);
    bool good = solve(subdomain, tau, r.start, u, w, &r);
    double after = good ? energy_of(subdomain, u) : energy;
    if (good && falls(after, energy)) {
      done += tau;
      energy = after;
      tau *= 2.0;
    } else {
      memcpy(u, r.start, size);
      tau *= 0.5;
    }
  }
  find_potential(subdomain, u, w);
}
