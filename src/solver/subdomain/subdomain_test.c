/* A step of a small subdomain solves its system, holds its mass, and never raises its
 * energy, however long it is. */
#include <math.h>

#include "base/context_test.h"
#include "solver/subdomain/subdomain.h"

/* An L-shaped room, cells of unequal sides. Node numbers go along x, then y. */
enum { WIDE = 6, HIGH = 7, ENTRIES = 9, CELLS = WIDE * HIGH };
enum { MOST = (WIDE + 1) * (HIGH + 1) };

static double space[MOST * (3 * MOST + 10)];

typedef struct room {
  int nodes, number[MOST];
  int target[MOST * ENTRIES];
  double laplacian[MOST * ENTRIES], energy[MOST * ENTRIES];
  double mass[MOST];
  fg__subdomain subdomain;
} room;

static bool inside(int x, int y)
{
  return x >= 0 && y >= 0 && x < WIDE && y < HIGH && !(x > 2 && y > 1 && y < 6);
}

/* Bilinear elements of a constant tensor; b: corners of a cell, x fastest. */
static double stiffness(double xx, double yy, double xy, int a, int b)
{
  const double hx = 0.8, hy = 1.1;
  int ax = a % 2, ay = a / 2, bx = b % 2, by = b / 2;
  double sx = ax == bx ? 1.0 : -1.0, sy = ay == by ? 1.0 : -1.0;
  double along_x = sx / (hx * hx) * (ay == by ? 1.0 / 3.0 : 1.0 / 6.0);
  double along_y = sy / (hy * hy) * (ax == bx ? 1.0 / 3.0 : 1.0 / 6.0);
  double mixed =
      (ax ? 0.5 : -0.5) * (by ? 0.5 : -0.5) + (ay ? 0.5 : -0.5) * (bx ? 0.5 : -0.5);
  return xx * along_x + yy * along_y + xy / (hx * hy) * mixed;
}

static void create(room *r)
{
  *r = (room){.nodes = 0};
  for (int j = 0; j <= HIGH; ++j)
    for (int i = 0; i <= WIDE; ++i) {
      bool any =
          inside(i, j) || inside(i - 1, j) || inside(i, j - 1) || inside(i - 1, j - 1);
      r->number[j * (WIDE + 1) + i] = any ? r->nodes++ : -1;
    }
  for (int n = 0; n < MOST * ENTRIES; ++n)
    r->target[n] = -1;
  for (int cell = 0; cell < CELLS; ++cell) {
    int x = cell % WIDE, y = cell / WIDE;
    for (int pair = 0; pair < 16 && inside(x, y); ++pair) {
      int a = pair % 4, b = pair / 4;
      int from = r->number[(y + a / 2) * (WIDE + 1) + x + a % 2];
      int entry = 4 + (b % 2 - a % 2) + 3 * (b / 2 - a / 2);
      r->target[from * ENTRIES + entry] = r->number[(y + b / 2) * (WIDE + 1) + x + b % 2];
      r->laplacian[from * ENTRIES + entry] += stiffness(1.0, 1.0, 0.0, a, b);
      r->energy[from * ENTRIES + entry] += stiffness(1.3, 0.9, 0.3, a, b);
      r->mass[from] += a == b ? 0.25 : 0.0;
    }
  }
  for (int n = 0; n < r->nodes * ENTRIES; ++n) {
    r->laplacian[n] /= r->mass[n / ENTRIES];
    r->energy[n] /= r->mass[n / ENTRIES];
  }
  r->subdomain =
      (fg__subdomain){r->nodes, ENTRIES, r->target, r->laplacian, r->energy, r->mass};
}

static double apply(const room *r, const double *rows, const double *x, int node)
{
  double sum = 0.0;
  for (int n = node * ENTRIES; n < (node + 1) * ENTRIES; ++n)
    sum += r->target[n] >= 0 ? rows[n] * x[r->target[n]] : 0.0;
  return sum;
}

static double energy_of(const room *r, const double *u)
{
  double sum = 0.0;
  for (int n = 0; n < r->nodes; ++n)
    sum += r->mass[n] * (pow(u[n] * u[n] - 1.0, 2.0) + u[n] * apply(r, r->energy, u, n));
  return 0.5 * sum;
}

static double mass_of(const room *r, const double *u)
{
  double sum = 0.0;
  for (int n = 0; n < r->nodes; ++n)
    sum += r->mass[n] * u[n];
  return sum;
}

static void fill(const room *r, uint64_t seed, double *u)
{
  for (int n = 0; n < r->nodes; ++n) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    u[n] = -0.3 + 2.6 * ((double)(seed >> 11) / 9007199254740992.0 - 0.5);
  }
}

static void a_short_step_solves_both_equations(void **state)
{
  (void)state;
  static room r;
  create(&r);
  double before[MOST], u[MOST], w[MOST];
  fill(&r, 3, before);
  fill(&r, 3, u);
  const double tau = 0.02;
  fg__subdomain_step(&r.subdomain, &(fg__subdomain_task){tau, tau, before, before}, u, w,
                     space);
  double moved = 0.0;
  for (int n = 0; n < r.nodes; ++n) {
    double potential = 2.0 * u[n] * (u[n] * u[n] - 1.0) + apply(&r, r.energy, u, n);
    assert_true(fabs(w[n] - potential) < 1e-12);
    assert_true(fabs(u[n] - before[n] + tau * apply(&r, r.laplacian, w, n)) < 1e-12);
    moved = fmax(moved, fabs(u[n] - before[n]));
  }
  assert_true(moved > 0.1);
}

/* Also one that has many solutions, or none near by. */
static void no_step_raises_the_energy_or_changes_the_mass(void **state)
{
  (void)state;
  static room r;
  create(&r);
  for (uint64_t seed = 1; seed <= 20; ++seed)
    for (double tau = 1e-3; tau < 1e7; tau *= 30.0) {
      double before[MOST], u[MOST], w[MOST];
      fill(&r, seed, before);
      for (int n = 0; n < r.nodes; ++n)
        u[n] = before[n];
      fg__subdomain_step(&r.subdomain, &(fg__subdomain_task){tau, tau, before, before}, u,
                         w, space);
      assert_true(energy_of(&r, u) <= energy_of(&r, before) * (1.0 + 1e-12));
      assert_true(fabs(mass_of(&r, u) - mass_of(&r, before)) < 1e-6);
    }
}

/* Long steps end where nothing drives a flux any more. */
static void a_subdomain_becomes_stationary(void **state)
{
  (void)state;
  static room r;
  create(&r);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    double u[MOST], w[MOST], before[MOST];
    fill(&r, seed, u);
    for (int step = 0; step < 6; ++step) {
      for (int n = 0; n < r.nodes; ++n)
        before[n] = u[n];
      fg__subdomain_step(&r.subdomain, &(fg__subdomain_task){1e4, 1e4, before, before}, u,
                         w, space);
    }
    for (int n = 0; n < r.nodes; ++n)
      assert_true(fabs(u[n] - before[n]) < 1e-7 && fabs(w[n] - w[0]) < 1e-6);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_short_step_solves_both_equations),
      cmocka_unit_test(no_step_raises_the_energy_or_changes_the_mass),
      cmocka_unit_test(a_subdomain_becomes_stationary),
  };
  return cmocka_run_group_tests_name("solver/subdomain/subdomain", tests, NULL, NULL);
}
