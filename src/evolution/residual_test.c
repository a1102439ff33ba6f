/* The residual of a step: against the equation in double, over cycles, and as what steps
 * are solved to. docs/method/schemes.md has whole runs. */
#include "evolution/residual.h"

#include "solver/passes.h"
#include "solver/reference_test.h"

static double turning(double x, double y, const void *data)
{
  (void)data;
  return 2.3 * x - 4.1 * y + 1.7 * sin(5.0 * x * y);
}

static bool outside_a_hole(double x, double y)
{
  return !(x > 0.3 && x < 0.55 && y > 0.17 && y < 0.33);
}

static const problem_description PROBLEMS[] = {
    {{48, 32}, {1.0, 0.61}, {false, false}, 0.0031, 0.15, turning, NULL, NULL},
    {{40, 24}, {1.0, 0.57}, {false, true}, 0.005, 0.3, turning, NULL, outside_a_hole},
    {{16, 12, 20}, {1.0, 0.53, 0.8}, {false, true, false}, 0.013, 0.3, turning, 0, 0},
};
enum { PROBLEMS_COUNT = sizeof PROBLEMS / sizeof *PROBLEMS };

/* The largest of p - u - tau L w, w = Psi'(u) + K u, or w = K u. */
static double expected_residual(const problem *p, double tau, const double *rhs,
                                const double *u, bool linear)
{
  double *w = values_of(p), *flux = values_of(p), most = 0.0;
  reference_potential(p, u, w);
  for (size_t n = 0; linear && n < p->nodes; ++n)
    w[n] -= p->mass[n] > 0.0 ? 2.0 * u[n] * (u[n] * u[n] - 1.0) : 0.0;
  apply_stiffness(p, true, w, flux);
  for (size_t n = 0; n < p->nodes; ++n)
    if (p->mass[n] > 0.0)
      most = fmax(most, fabs(rhs[n] - u[n] - tau * flux[n] / p->mass[n]));
  free(w);
  free(flux);
  return most;
}

static float *array_of(const problem *p)
{
  return (float *)allocate_or_fail(p->multigrid.level[0].layout.array_size,
                                   sizeof(float)) +
         p->multigrid.level[0].layout.first;
}

static void free_array(const problem *p, float *array)
{
  free(array - p->multigrid.level[0].layout.first);
}

static void it_is_that_of_the_equation(void **state)
{
  (void)state;
  for (int n = 0; n < 2 * PROBLEMS_COUNT; ++n) {
    const bool linear = n % 2 == 1;
    problem p;
    problem_create(&p, &PROBLEMS[n / 2]);
    float *scratch[2] = {array_of(&p), array_of(&p)};
    double *u = values_of(&p), *rhs = values_of(&p);
    uint64_t seed = 11 + (uint64_t)n;
    for (size_t k = 0; k < p.nodes; ++k) {
      u[k] = p.mass[k] > 0.0 ? -0.4 + 0.9 * random_value(&seed) : 0.0;
      rhs[k] = p.mass[k] > 0.0 ? random_value(&seed) : 0.0;
    }
    put(&p, fg__multigrid_u(&p.multigrid), u);
    put(&p, fg__multigrid_p(&p.multigrid), rhs);
    p.multigrid.linear = linear; /* K u and L w are the same functions then */
    double tau = 0.02 * p.spacing[0] * p.spacing[0] * (n + 1);
    double found =
        fg__residual(&p.multigrid, &(fg__subdomains){0}, tau, scratch[0], scratch[1]);
    double expected = expected_residual(&p, tau, rhs, u, linear);
    assert_true(fabs(found - expected) < 1e-5 * expected);
    fg__multigrid_u(&p.multigrid)[0] = NAN;
    assert_true(isinf(
        fg__residual(&p.multigrid, &(fg__subdomains){0}, tau, scratch[0], scratch[1])));
    p.multigrid.linear = false;
    for (int k = 0; k < 2; ++k)
      free_array(&p, scratch[k]);
    free(u);
    free(rhs);
    problem_clear(&p);
  }
}

/* Interfaces round a disc and a strip, which move. */
static double pattern(const problem *p, size_t n)
{
  double x = p->spacing[0] * (double)(n % (size_t)p->columns) - 0.4;
  double y = p->spacing[1] * (double)(n / (size_t)p->columns % (size_t)p->rows) - 0.3;
  double width = sqrt(p->of.gamma);
  return fmax(tanh((0.17 - hypot(x, y)) / width), tanh((x - 0.35) / width));
}

static void cycles_make_it_fall_geometrically(void **state)
{
  (void)state;
  enum { CYCLES = 16, APART = 4 };
  for (int n = 0; n < PROBLEMS_COUNT; ++n) {
    problem p;
    problem_create(&p, &PROBLEMS[n]);
    fg__multigrid *m = &p.multigrid;
    float *scratch[2] = {array_of(&p), array_of(&p)};
    double *u = values_of(&p), left[CYCLES + 1], tau = 0.5 * p.of.gamma;
    for (size_t k = 0; k < p.nodes; ++k)
      u[k] = p.mass[k] > 0.0 ? pattern(&p, k) : 0.0;
    put(&p, fg__multigrid_u(m), u);
    put(&p, fg__multigrid_p(m), u);
    fg__pass_evaluate(m, fg__multigrid_u(m), fg__multigrid_w(m));
    for (int k = 0; k <= CYCLES; ++k) {
      left[k] = fg__residual(m, &(fg__subdomains){0}, tau, scratch[0], scratch[1]);
      fg__pass_solve(m, tau, 1, NULL);
    }
    print_message("# problem %d: residual %.3g", n, left[0]);
    for (int k = APART; k <= CYCLES; k += APART) {
      print_message(", after %d cycles %.2e of it", k, left[k] / left[0]);
      if (left[k - APART] > 3e-5 * left[0]) /* above the rounding of floats */
        assert_true(left[k] < 0.4 * left[k - APART]);
    }
    print_message("\n");
    assert_true(left[CYCLES] < 1e-3 * left[0]);
    for (int k = 0; k < 2; ++k)
      free_array(&p, scratch[k]);
    free(u);
    problem_clear(&p);
  }
}

/* A run of STEPS steps. */
enum { STEPS = 70, NODES = 97 };

typedef struct run {
  fg_step step[STEPS];
  long cycles, rejected;
} run;

static run run_of(fg_evolution_options options)
{
  run out = {.cycles = 0};
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  options.nodes = NODES;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, "vortex3", 33),
                   FG_STATUS_OK);
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  for (int n = 0; n < STEPS; ++n) {
    assert_int_equal(fg_evolution_step(evolution, &out.step[n]), FG_STATUS_OK);
    out.cycles += out.step[n].cycles;
    out.rejected += out.step[n].rejected;
  }
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return out;
}

/* Nothing is measured by default; a large residual is always reached. */
static void measuring_changes_nothing(void **state)
{
  (void)state;
  run plain = run_of((fg_evolution_options){.nodes = 0});
  run measured = run_of((fg_evolution_options){.residual = 1e9});
  assert_int_equal(measured.cycles, plain.cycles);
  for (int n = 0; n < STEPS; ++n) {
    assert_true(plain.step[n].residual == 0.0);
    assert_true(measured.step[n].residual > 1e-4 && measured.step[n].residual < 10.0);
    assert_memory_equal(&plain.step[n].energy, &measured.step[n].energy, sizeof(double));
    assert_memory_equal(&plain.step[n].tau, &measured.step[n].tau, sizeof(double));
  }
}

static void steps_are_solved_to_it(void **state)
{
  (void)state;
  static const fg_scheme schemes[] = {FG_SCHEME_BDF2, FG_SCHEME_EULER, FG_SCHEME_THETA};
  static const double residuals[] = {1e-1, 1e-3};
  for (int k = 0; k < 3; ++k) {
    long before = 0;
    for (int r = 0; r < 2; ++r) {
      run done =
          run_of((fg_evolution_options){.scheme = schemes[k], .residual = residuals[r]});
      double energy = HUGE_VAL, largest = 0.0;
      int beyond = 0;
      for (int n = 0; n < STEPS; ++n) {
        assert_true(done.step[n].energy <= energy);
        energy = done.step[n].energy;
        largest = fmax(largest, done.step[n].residual);
        beyond += done.step[n].residual > residuals[r];
      }
      print_message("# scheme %d, residual %g: %ld cycles, %ld rejected, largest %.2e, "
                    "%d beyond\n",
                    k, residuals[r], done.cycles, done.rejected, largest, beyond);
      assert_int_equal(beyond, 0);
      assert_true(done.cycles > before);
      before = done.cycles;
    }
  }
}

/* A residual below what floats can hold is no reason to fail. */
static void rounding_ends_a_step(void **state)
{
  (void)state;
  run done = run_of((fg_evolution_options){.residual = 1e-12});
  double largest = 0.0;
  for (int n = 0; n < STEPS; ++n)
    largest = fmax(largest, done.step[n].residual);
  print_message("# residual 1e-12: largest %.2e, %ld cycles, %ld rejected\n", largest,
                done.cycles, done.rejected);
  assert_true(largest > 1e-12 && largest < 1e-2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_that_of_the_equation),
      cmocka_unit_test(cycles_make_it_fall_geometrically),
      cmocka_unit_test(measuring_changes_nothing),
      cmocka_unit_test(steps_are_solved_to_it),
      cmocka_unit_test(rounding_ends_a_step),
  };
  return cmocka_run_group_tests_name("evolution/residual", tests, NULL, NULL);
}
