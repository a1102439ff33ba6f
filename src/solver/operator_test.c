/* The finest level's operator and sums against their definitions. */
#include "solver/reference_test.h"

static const fg__thread ALONE = {.count = 1};

/* Sums of nine float products: a few units in the last place of the largest. */
static const double ROUNDING = 1e-6;

static double turning(double x, double y, const void *data)
{
  (void)data;
  return 2.3 * x - 4.1 * y + 1.7 * sin(5.0 * x * y);
}

static bool outside_a_hole_and_a_notch(double x, double y)
{
  bool hole = x > 0.3 && x < 0.55 && y > 0.17 && y < 0.33;
  bool notch = x > 0.8 && y < 0.21;
  bool lone_cells = x < 0.1 && y > 0.4 && (x < 0.04 || y < 0.47);
  return !hole && !notch && !lone_cells;
}

/* Unequal cells, odd and even numbers of vectors, all kinds of boundaries, masks. */
static const problem_description PROBLEMS[] = {
    {{24, 16}, {1.0, 0.53}, {false, false}, 0.013, 0.15, turning, NULL, NULL},
    {{38, 22}, {1.0, 0.69}, {true, false}, 0.0071, 0.4, turning, NULL, NULL},
    {{16, 40}, {0.55, 1.0}, {false, true}, 0.022, 0.15, turning, NULL, NULL},
    {{48, 32}, {1.0, 0.61}, {true, true}, 0.0031, 0.07, turning, NULL, NULL},
    {{40, 24},
     {1.0, 0.57},
     {false, false},
     0.013,
     0.15,
     turning,
     NULL,
     outside_a_hole_and_a_notch},
    {{36, 26},
     {1.0, 0.57},
     {true, true},
     0.013,
     0.3,
     turning,
     NULL,
     outside_a_hole_and_a_notch},
    {{16, 12, 20}, {1.0, 0.53, 0.8}, {false, false, false}, 0.013, 0.15, turning, 0, 0},
    {{12, 16, 8}, {0.7, 0.9, 0.41}, {true, false, true}, 0.0171, 0.3, turning, 0, 0},
    {{20, 14, 18},
     {1.0, 0.83, 0.9},
     {false, true, false},
     0.011,
     0.15,
     turning,
     NULL,
     outside_a_hole_and_a_notch},
};

static void for_all_problems(void (*holds)(const problem *p))
{
  for (size_t n = 0; n < sizeof PROBLEMS / sizeof *PROBLEMS; ++n) {
    problem p;
    problem_create(&p, &PROBLEMS[n]);
    holds(&p);
    problem_clear(&p);
  }
}

static double *random_values(const problem *p, uint64_t seed, double mean, double size)
{
  double *values = values_of(p);
  for (size_t n = 0; n < p->nodes; ++n)
    values[n] = (double)(float)(mean + size * random_value(&seed));
  return values;
}

/* The largest entry of the operator, in whose units it rounds. */
static double largest_coefficient(const problem *p)
{
  double sum = 0.0;
  for (int k = 0; k < p->dimension; ++k)
    sum += 1.0 / (p->spacing[k] * p->spacing[k]);
  return 4.0 * p->of.gamma * sum;
}

/* Takes u through the level's operator; returns its sums. */
static fg__sums evaluate(const problem *p, const double *u, double *w)
{
  const fg__level *level = &p->multigrid.level[0];
  put(p, level->u, u);
  fg__sums sums = p->multigrid.kernel->evaluate(level, level->u, level->w, &ALONE);
  get(p, level->w, w);
  return sums;
}

/* The couplings of a node are its own and those its neighbours hold; it must be inside,
 * where no coupling is to a mirrored node. */
static void row_sums_to_zero(const fg__level *level, const fg__stencil *stencil, int i,
                             int j, int k)
{
  const fg__layout *at = &level->layout;
  double center = (double)stencil->center[fg__node_at(at, i, j, k)], sum = center;
  for (int r = 0; r < fg__upper_rows(at->dimension); ++r)
    for (int c = -1; c <= 1; ++c) {
      int dy, dz;
      fg__upper_row(r, &dy, &dz);
      const float *to = stencil->to[2 + 3 * r + c];
      sum += (double)to[fg__node_at(at, i, j, k)] +
             (double)to[fg__node_at(at, i - c, j - dy, k - dz)];
    }
  sum += (double)stencil->to[0][fg__node_at(at, i, j, k)] +
         (double)stencil->to[0][fg__node_at(at, i - 1, j, k)];
  assert_true(center >= 0.0);
  assert_true(fabs(sum) <= ROUNDING * center);
}

static void rows_sum_to_zero(const problem *p)
{
  for (int n = 0; n < p->multigrid.level_count; ++n) {
    const fg__level *level = &p->multigrid.level[n];
    const int *nodes = level->layout.nodes;
    const fg__stencil *stencil[2] = {&level->energy, &level->laplacian};
    bool solid = p->dimension == 3;
    for (int s = 0; s < (level->mass ? 2 : 1); ++s)
      for (int k = solid; k < nodes[2] - solid; ++k)
        for (int j = 1; j + 1 < nodes[1]; ++j)
          for (int i = 1; i + 1 < nodes[0]; ++i)
            row_sums_to_zero(level, stencil[s], i, j, k);
  }
}

static void stencil_rows_sum_to_zero(void **state)
{
  (void)state;
  for_all_problems(rows_sum_to_zero);
}

static void keeps_constants(const problem *p)
{
  const double constant = 0.37;
  double *u = random_values(p, 1, constant, 0.0), *w = values_of(p);
  evaluate(p, u, w);
  for (size_t n = 0; n < p->nodes; ++n)
    if (p->mass[n] > 0.0)
      assert_true(fabs(w[n] - 2.0 * constant * (constant * constant - 1.0)) <
                  ROUNDING * largest_coefficient(p));
  free(u);
  free(w);
}

static void constants_have_no_gradient(void **state)
{
  (void)state;
  for_all_problems(keeps_constants);
}

/* The patch test: a constant tensor's flux through a linear density has no divergence. */
static void linear_functions_have_no_divergence(void **state)
{
  (void)state;
  for (size_t n = 0; n < sizeof PROBLEMS / sizeof *PROBLEMS; ++n) {
    problem_description description = PROBLEMS[n];
    description.angle = NULL;
    problem p;
    problem_create(&p, &description);
    double *u = values_of(&p), *w = values_of(&p);
    size_t columns = (size_t)p.columns, rows = (size_t)p.rows;
    for (size_t k = 0; k < p.nodes; ++k)
      u[k] = (double)(float)(0.31 + 0.83 * p.spacing[0] * (double)(k % columns) -
                             1.21 * p.spacing[1] * (double)(k / columns % rows) +
                             0.57 * p.spacing[2] * (double)(k / columns / rows));
    evaluate(&p, u, w);
    int inner = 0;
    for (size_t k = 0; k < p.nodes; ++k) {
      size_t i = k % columns, j = k / columns % rows, plane = k / columns / rows;
      bool boundary = i == 0 || i + 1 == columns || j == 0 || j + 1 == rows;
      if (p.dimension == 3)
        boundary = boundary || plane == 0 || plane + 1 == (size_t)p.planes;
      if (boundary || p.mass[k] < 0.99 * volume_of(&p))
        continue;
      ++inner;
      assert_true(fabs(w[k] - 2.0 * u[k] * (u[k] * u[k] - 1.0)) <
                  ROUNDING * largest_coefficient(&p));
    }
    assert_true(inner > 100);
    free(u);
    free(w);
    problem_clear(&p);
  }
}

static void agrees_with_the_reference(const problem *p)
{
  double *u = random_values(p, 77, 0.2, 1.1), *w = values_of(p);
  double *expected = values_of(p);
  evaluate(p, u, w);
  reference_potential(p, u, expected);
  for (size_t n = 0; n < p->nodes; ++n)
    if (p->mass[n] > 0.0)
      assert_true(fabs(w[n] - expected[n]) < ROUNDING * largest_coefficient(p));
  free(u);
  free(w);
  free(expected);
}

static void the_potential_is_that_of_the_definition(void **state)
{
  (void)state;
  for_all_problems(agrees_with_the_reference);
}

/* (K u, v) = (u, K v) in the sum weighted with masses; K u is w less Psi'(u). */
static void is_symmetric(const problem *p)
{
  double *u = random_values(p, 5, 0.1, 0.9), *v = random_values(p, 6, -0.3, 0.6);
  double *ku = values_of(p), *kv = values_of(p);
  evaluate(p, u, ku);
  evaluate(p, v, kv);
  for (size_t n = 0; n < p->nodes; ++n) {
    ku[n] -= 2.0 * u[n] * (u[n] * u[n] - 1.0);
    kv[n] -= 2.0 * v[n] * (v[n] * v[n] - 1.0);
  }
  double uv = inner_product(p, ku, v), vu = inner_product(p, u, kv);
  double scale = norm(p, ku) * norm(p, v) + norm(p, kv) * norm(p, u);
  assert_true(fabs(uv - vu) < ROUNDING * scale);
  assert_true(inner_product(p, ku, u) > 0.0);
  free(u);
  free(v);
  free(ku);
  free(kv);
}

static void the_operator_is_symmetric_and_positive(void **state)
{
  (void)state;
  for_all_problems(is_symmetric);
}

static void sums_are_integrals(const problem *p)
{
  const fg__level *level = &p->multigrid.level[0];
  double *u = random_values(p, 21, 0.2, 1.1), *a = random_values(p, 22, 0.1, 0.7);
  double *b = random_values(p, 23, 0.4, 1.3), *w = values_of(p);
  double cell = volume_of(p);
  fg__sums sums = evaluate(p, u, w);
  double energy = reference_energy(p, u), mass = integral(p, u);
  assert_true(fabs(cell * sums.energy - energy) < ROUNDING * energy);
  assert_true(fabs(cell * sums.u - mass) < ROUNDING * fabs(mass));
  put(p, level->w, a);
  put(p, level->p, b);
  const fg__kernel *kernel = p->multigrid.kernel;
  fg__changes changes =
      kernel->changes(level, level->u, level->w, level->p, level->p, &ALONE);
  for (size_t n = 0; n < p->nodes; ++n) {
    b[n] -= a[n];
    a[n] -= u[n];
  }
  double from_a = inner_product(p, a, a), along = inner_product(p, a, b);
  for (size_t n = 0; n < p->nodes; ++n)
    b[n] += a[n];
  double from_b = inner_product(p, b, b);
  assert_true(fabs(cell * changes.u - mass) < ROUNDING * fabs(mass));
  assert_true(fabs(cell * changes.change - from_a) < ROUNDING * from_a);
  assert_true(fabs(cell * changes.correction - from_b) < ROUNDING * from_b);
  assert_true(fabs(cell * changes.product - along) < ROUNDING * (from_a + from_b));
  free(u);
  free(a);
  free(b);
  free(w);
}

static void energy_mass_and_changes_are_integrals(void **state)
{
  (void)state;
  for_all_problems(sums_are_integrals);
}

/* The potential is the derivative of the energy: what proves decay. A quartic's central
 * difference errs by the third derivative times e^2, 1e-4 of what is compared here. */
static void derives_from_the_energy(const problem *p)
{
  const double e = 0x1p-7;
  double *u = random_values(p, 8, 0.2, 0.9), *v = random_values(p, 9, 0.1, 1.0);
  double *w = values_of(p), *at = values_of(p), *unused = values_of(p);
  evaluate(p, u, w);
  double difference = 0.0;
  for (int sign = -1; sign <= 1; sign += 2) {
    for (size_t n = 0; n < p->nodes; ++n)
      at[n] = u[n] + sign * e * v[n];
    difference += sign * evaluate(p, at, unused).energy / (2.0 * e);
  }
  double slope = inner_product(p, w, v);
  assert_true(fabs(volume_of(p) * difference - slope) < 2e-4 * norm(p, w) * norm(p, v));
  free(u);
  free(v);
  free(w);
  free(at);
  free(unused);
}

static void the_potential_is_the_energys_derivative(void **state)
{
  (void)state;
  for_all_problems(derives_from_the_energy);
}

/* Full weighting keeps the integral of what it restricts: here of the first equation's
 * residual, whose flux has none. */
static void residual_keeps_its_integral(const problem *p)
{
  const fg__level *fine = &p->multigrid.level[0], *coarse = fine + 1;
  double *u = random_values(p, 31, 0.2, 0.9), *w = random_values(p, 32, -0.4, 1.0);
  double *rhs = random_values(p, 33, 0.7, 0.9);
  double tau = 0.37 * p->spacing[0] * p->spacing[0];
  put(p, fine->u, u);
  put(p, fine->w, w);
  put(p, fine->p, rhs);
  p->multigrid.kernel->restrict_residuals(fine, coarse, (float)tau, &ALONE);
  double restricted =
      p->multigrid.kernel
          ->changes(coarse, coarse->p, coarse->p, coarse->p, coarse->p, &ALONE)
          .u *
      coarse->cell_volume;
  double wanted = integral(p, rhs) - integral(p, u);
  assert_true(fabs(restricted - wanted) < ROUNDING * (norm(p, rhs) + norm(p, u)));
  free(u);
  free(w);
  free(rhs);
}

static void restricting_a_residual_keeps_its_integral(void **state)
{
  (void)state;
  for_all_problems(residual_keeps_its_integral);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stencil_rows_sum_to_zero),
      cmocka_unit_test(constants_have_no_gradient),
      cmocka_unit_test(linear_functions_have_no_divergence),
      cmocka_unit_test(the_potential_is_that_of_the_definition),
      cmocka_unit_test(the_operator_is_symmetric_and_positive),
      cmocka_unit_test(energy_mass_and_changes_are_integrals),
      cmocka_unit_test(the_potential_is_the_energys_derivative),
      cmocka_unit_test(restricting_a_residual_keeps_its_integral),
  };
  return cmocka_run_group_tests_name("solver/operator", tests, NULL, NULL);
}
