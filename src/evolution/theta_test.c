/* The theta scheme against the equations of its paper, and its limit of stability against
 * linear theory. */
#include "base/memory.h"
#include "evolution/theta.h"
#include "solver/reference_test.h"

/* Enough to solve a substep to float rounding. */
enum { CYCLES = 20 };

static double turning(double x, double y, const void *data)
{
  (void)data;
  return 2.3 * x - 4.1 * y + 1.7 * sin(5.0 * x * y);
}

static bool outside_a_hole(double x, double y)
{
  return !(x > 0.3 && x < 0.55 && y > 0.17 && y < 0.33);
}

/* A problem with a theta scheme; `of` still has the whole gamma. */
typedef struct setting {
  problem p;
  fg__theta theta;
  float *memory, *start;
} setting;

static void setting_create(setting *s, const problem_description *of,
                           fg__splitting splitting)
{
  problem_description part = *of;
  part.gamma *= fg__theta_held(splitting);
  problem_create(&s->p, &part);
  s->p.of.gamma = of->gamma;
  assert_int_equal(fg__theta_create(&s->theta, s->p.context, &s->p.multigrid, splitting),
                   FG_STATUS_OK);
  const fg__layout *layout = &s->p.multigrid.level[0].layout;
  s->memory = fg__allocate_aligned(layout->array_size, sizeof *s->memory);
  assert_non_null(s->memory);
  s->start = s->memory + layout->first;
}

static void setting_clear(setting *s)
{
  free(s->memory);
  fg__theta_clear(&s->theta);
  problem_clear(&s->p);
}

/* One substep; the first guess of the first is the density itself. */
static void substep(setting *s, int n, double tau, double *u)
{
  const fg__level *level = &s->p.multigrid.level[0];
  if (n == 0)
    fg__pass_copy(&s->p.multigrid, s->start, level->u);
  double implicit = fg__theta_prepare(&s->theta, &s->p.multigrid, n, tau, s->start);
  fg__pass_solve(&s->p.multigrid, implicit, CYCLES, NULL);
  get(&s->p, level->u, u);
}

/* out := M^-1 L M^-1 gamma L_A u, or M^-1 L Psi'(u): the rates of the paper's two terms.
 */
static void rate_of(const problem *p, bool double_well, const double *u, double *out)
{
  double *w = values_of(p);
  apply_stiffness(p, false, u, w);
  for (size_t n = 0; n < p->nodes; ++n)
    if (double_well)
      w[n] = 2.0 * u[n] * (u[n] * u[n] - 1.0);
    else
      w[n] = p->mass[n] > 0.0 ? p->of.gamma * w[n] / p->mass[n] : 0.0;
  apply_stiffness(p, true, w, out);
  for (size_t n = 0; n < p->nodes; ++n)
    out[n] = p->mass[n] > 0.0 ? out[n] / p->mass[n] : 0.0;
  free(w);
}

/* What is left of a substep's equation
 *     after + tau (a K after + b Psi'(after)) = before - tau (c K before + d
 * Psi'(before)), relative to the largest of its terms. */
static double residual(const problem *p, double tau, const double weight[4],
                       const double *before, const double *after)
{
  double *rate = values_of(p), *sum = values_of(p), largest = 0.0, left = 0.0;
  for (size_t n = 0; n < p->nodes; ++n)
    sum[n] = after[n] - before[n];
  for (int k = 0; k < 4; ++k) {
    rate_of(p, k % 2 == 1, k < 2 ? after : before, rate);
    for (size_t n = 0; n < p->nodes; ++n)
      rate[n] *= tau * weight[k];
    largest = fmax(largest, norm(p, rate));
    for (size_t n = 0; n < p->nodes; ++n)
      sum[n] += rate[n];
  }
  left = norm(p, sum);
  free(rate);
  free(sum);
  return left / largest;
}

static const problem_description PROBLEMS[] = {
    {{48, 32}, {1.0, 0.61}, {false, false}, 0.0031, 0.15, turning, NULL, NULL},
    {{38, 22}, {1.0, 0.69}, {true, false}, 0.0071, 0.4, turning, NULL, NULL},
    {{40, 24}, {1.0, 0.57}, {false, true}, 0.005, 0.3, turning, NULL, outside_a_hole},
    {{16, 12, 20}, {1.0, 0.53, 0.8}, {false, true, false}, 0.013, 0.3, turning, 0, 0},
};

static void substeps_solve_the_papers_equations(void **state)
{
  (void)state;
  const fg__splitting splittings[] = {
      {1.0 - 1.0 / sqrt(2.0), 2.0 - sqrt(2.0)}, {0.15, 0.7}, {0.4, 1.0}};
  enum { SPLITTINGS = sizeof splittings / sizeof *splittings };
  assert_true(fabs(splittings[0].theta - fg__theta_default.theta) < 1e-15);
  assert_true(fabs(splittings[0].alpha - fg__theta_default.alpha) < 1e-15);
  for (size_t n = 0; n < SPLITTINGS * sizeof PROBLEMS / sizeof *PROBLEMS; ++n) {
    const problem_description *of = &PROBLEMS[n / SPLITTINGS];
    const fg__splitting splitting = splittings[n % SPLITTINGS];
    const double alpha = splitting.alpha, beta = 1.0 - alpha, theta = splitting.theta;
    setting s;
    setting_create(&s, of, splitting);
    double *before = values_of(&s.p), *after = values_of(&s.p);
    uint64_t seed = 99 + n;
    for (size_t k = 0; k < s.p.nodes; ++k)
      before[k] = s.p.mass[k] > 0.0 ? -0.4 + 0.9 * random_value(&seed) : 0.0;
    put(&s.p, s.start, before);
    get(&s.p, s.start, before);
    double tau = 0.1 * of->anisotropy * of->gamma;
    const double share[3] = {theta, 1.0 - 2.0 * theta, theta};
    const double outer[4] = {alpha, 0.0, beta, 1.0}, middle[4] = {beta, 1.0, alpha, 0.0};
    for (int k = 0; k < FG__THETA_SUBSTEPS; ++k) {
      substep(&s, k, tau, after);
      double left =
          residual(&s.p, share[k] * tau, k == 1 ? middle : outer, before, after);
      if (!(left < 5e-6))
        fail_msg("problem %zu, substep %d: residual %g", n, k, left);
      memcpy(before, after, s.p.nodes * sizeof *before);
    }
    free(before);
    free(after);
    setting_clear(&s);
  }
}

static void the_energy_is_that_of_the_whole_gamma(void **state)
{
  (void)state;
  for (size_t n = 0; n < sizeof PROBLEMS / sizeof *PROBLEMS; ++n) {
    setting s;
    setting_create(&s, &PROBLEMS[n], (fg__splitting){0.3, n % 2 == 0 ? 0.6 : 1.0});
    double *u = values_of(&s.p);
    uint64_t seed = 7 + n;
    for (size_t k = 0; k < s.p.nodes; ++k)
      u[k] = s.p.mass[k] > 0.0 ? 0.2 + random_value(&seed) : 0.0;
    const fg__level *level = &s.p.multigrid.level[0];
    put(&s.p, level->u, u);
    double energy = fg__pass_evaluate(&s.p.multigrid, level->u, level->w).energy;
    double expected = reference_energy(&s.p, u);
    assert_true(fabs(level->cell_volume * energy - expected) < 1e-6 * expected);
    free(u);
    setting_clear(&s);
  }
}

/* By what a step multiplies a mode of A = I round u = 1, where Psi'' = 4; lambda is its
 * eigenvalue of M^-1 L. */
static double amplification(fg__splitting s, double gamma, double lambda, double tau)
{
  double alpha = s.alpha, theta = s.theta, middle = 1.0 - 2.0 * theta;
  double one = tau * lambda * alpha * gamma * lambda;
  double other = tau * lambda * ((1.0 - alpha) * gamma * lambda + 4.0);
  double outer = (1.0 - theta * other) / (1.0 + theta * one);
  return outer * outer * (1.0 - middle * one) / (1.0 + middle * other);
}

/* cos(wave x) at the nodes, and its eigenvalue. */
static double mode_of(const problem *p, int wave, double *mode)
{
  double *flux = values_of(p);
  for (size_t n = 0; n < p->nodes; ++n)
    mode[n] = cos(PI * wave * (double)(n % (size_t)p->columns) / p->count[0]);
  apply_stiffness(p, true, mode, flux);
  double lambda = flux[0] / p->mass[0];
  free(flux);
  return lambda;
}

/* The largest factor of a step's ripples, which are to be those of linear theory. */
static double largest_factor(fg__splitting splitting, double gamma, int first_wave)
{
  const problem_description of = {
      .cells = {64, 16}, .side = {1.0, 0.25}, .gamma = gamma, .anisotropy = 1.0};
  setting s;
  setting_create(&s, &of, splitting);
  double *mode = values_of(&s.p), *u = values_of(&s.p), most = 0.0;
  for (int wave = first_wave; wave <= 60; wave += 3)
    for (int n = 0; n < 3; ++n) {
      double lambda = mode_of(&s.p, wave, mode), tau = (0.2 + 0.6 * n) * of.gamma;
      const double ripple = 1e-3;
      for (size_t k = 0; k < s.p.nodes; ++k)
        u[k] = 1.0 + ripple * mode[k];
      put(&s.p, s.start, u);
      for (int k = 0; k < FG__THETA_SUBSTEPS; ++k)
        substep(&s, k, tau, u);
      double factor = inner_product(&s.p, mode, u) / inner_product(&s.p, mode, mode);
      double expected = amplification(splitting, of.gamma, lambda, tau);
      assert_true(fabs(factor / ripple - expected) < 0.01);
      if (n > 0)
        most = fmax(most, fabs(factor / ripple));
    }
  free(mode);
  free(u);
  setting_clear(&s);
  return most;
}

static void ripples_grow_as_linear_theory_says(void **state)
{
  (void)state;
  assert_true(largest_factor(fg__theta_default, 5e-4, 3) > 1.05);
  assert_true(largest_factor((fg__splitting){0.45, 0.6}, 5e-4, 3) > 1.05);
}

/* Stiff waves, of which K is much more than Psi'', decay for every alpha of the range:
 * the less the nearer it is to 1/2. Below the range they grow. */
static void stiff_waves_decay_for_alpha_in_its_range(void **state)
{
  (void)state;
  const double theta = fg__theta_default.theta;
  static const struct {
    double alpha, least, most;
  } of[] = {{1.0, 0.0, 0.1}, {0.7, 0.3, 0.6}, {0.55, 0.6, 0.95}, {0.45, 1.05, 1.3}};
  for (size_t n = 0; n < sizeof of / sizeof *of; ++n) {
    double most = largest_factor((fg__splitting){theta, of[n].alpha}, 0.05, 24);
    print_message("# alpha %g: stiff waves by %.3f\n", of[n].alpha, most);
    assert_true(most > of[n].least && most < of[n].most);
  }
}

/* No wave of a mesh grows in the stable step; a slightly longer one lets some. */
static void the_stable_step_is_the_longest(void **state)
{
  (void)state;
  static const struct {
    fg__splitting splitting;
    double least, most, stiffest;
  } of[] = {{{0.2929, 0.5858}, 1.21, 8.07, 4.0}, {{0.2929, 0.5858}, 2.25, 2.25, 4.0},
            {{0.2929, 0.7}, 1.21, 8.07, 4.0},    {{0.2929, 0.5858}, 1e-2, 1e-1, 1e7},
            {{0.2929, 0.51}, 3.0, 4.0, 4.0},     {{0.1, 0.6}, 1.21, 8.07, 4.0},
            {{0.45, 0.9}, 1.21, 8.07, 4.0},      {{0.2929, 1.0}, 1.21, 8.07, 4.0}};
  for (size_t n = 0; n < sizeof of / sizeof *of; ++n)
    for (int longer = 0; longer < 2; ++longer) {
      double tau =
          (longer ? 1.01 : 0.999) *
          fg__theta_stable_step(of[n].splitting, of[n].least, of[n].most, of[n].stiffest);
      double most = 0.0;
      for (double lambda = of[n].stiffest; lambda > 1e-7 * of[n].stiffest; lambda *= 0.99)
        for (double gamma = of[n].least; gamma <= of[n].most; gamma *= 1.02)
          most = fmax(most, fabs(amplification(of[n].splitting, gamma, lambda, tau)));
      assert_int_equal(most > 1.0, longer);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(substeps_solve_the_papers_equations),
      cmocka_unit_test(the_energy_is_that_of_the_whole_gamma),
      cmocka_unit_test(ripples_grow_as_linear_theory_says),
      cmocka_unit_test(stiff_waves_decay_for_alpha_in_its_range),
      cmocka_unit_test(the_stable_step_is_the_longest),
  };
  return cmocka_run_group_tests_name("evolution/theta", tests, NULL, NULL);
}
