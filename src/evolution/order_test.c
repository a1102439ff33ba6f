/* Order of convergence in space and time against a manufactured solution. */
#include "base/memory.h"
#include "evolution/stepper.h"
#include "solver/passes.h"
#include "solver/reference_test.h"

/* Enough for every step to be solved to float rounding: a cycle gains a factor of 3 to 10
 * (multigrid_test), the first guess is the last step. */
enum { CYCLES = 14 };

/* u = mean + g_1(t) phi_1 + g_2(t) phi_2 with modes phi = cos cos. Natural axes: every
 * wave has a node or an extremum on the boundary, so that u is even, the tensor's angle
 * odd about it; then A grad u . n = 0 and grad w . n = 0 hold by symmetry. */
typedef struct axis {
  double wave_number;             /* of the first mode */
  double mode_phase, angle_phase; /* 0 on natural axes */
} axis;

typedef struct manufactured {
  axis x, y;
  double angle, anisotropy, gamma;
  double mean, size, frequency;
} manufactured;

enum { MODES = 2 };
static const int WAVES[MODES][2] = {{1, 2}, {3, 1}};

static double amplitude(const manufactured *m, int mode, double t)
{
  return m->size * (mode == 0 ? 0.45 + 0.25 * sin(m->frequency * t + 0.4)
                              : 0.2 * cos(0.6 * m->frequency * t));
}

static double amplitude_rate(const manufactured *m, int mode, double t)
{
  return m->size * m->frequency *
         (mode == 0 ? 0.25 * cos(m->frequency * t + 0.4)
                    : -0.12 * sin(0.6 * m->frequency * t));
}

/* A mode and its derivatives. */
typedef struct jet {
  double f, x, y, xx, xy, yy;
} jet;

static jet mode_at(const manufactured *m, int mode, double x, double y)
{
  double kx = WAVES[mode][0] * m->x.wave_number, ky = WAVES[mode][1] * m->y.wave_number;
  double cx = cos(kx * x + m->x.mode_phase), sx = sin(kx * x + m->x.mode_phase);
  double cy = cos(ky * y + m->y.mode_phase), sy = sin(ky * y + m->y.mode_phase);
  return (jet){cx * cy,           -kx * sx * cy,     -ky * cx * sy, -kx * kx * cx * cy,
               kx * ky * sx * sy, -ky * ky * cx * cy};
}

static double angle_at(const manufactured *m, double x, double y)
{
  return m->angle * sin(m->x.wave_number * x + m->x.angle_phase) *
         sin(m->y.wave_number * y + m->y.angle_phase);
}

/* div (A grad phi), A = a I + (1 - a) e e^T, e = (cos, sin) of the angle. */
static double diffusion_at(const manufactured *m, int mode, double x, double y)
{
  double sx = m->x.wave_number * x + m->x.angle_phase;
  double sy = m->y.wave_number * y + m->y.angle_phase;
  double angle = m->angle * sin(sx) * sin(sy), b = 1.0 - m->anisotropy;
  double angle_x = m->angle * m->x.wave_number * cos(sx) * sin(sy);
  double angle_y = m->angle * m->y.wave_number * sin(sx) * cos(sy);
  double c2 = cos(2.0 * angle), s2 = sin(2.0 * angle);
  double xx = 1.0 - 0.5 * b * (1.0 - c2), xy = 0.5 * b * s2;
  double yy = 1.0 - 0.5 * b * (1.0 + c2);
  jet p = mode_at(m, mode, x, y);
  return xx * p.xx + 2.0 * xy * p.xy + yy * p.yy +
         b * (-s2 * angle_x + c2 * angle_y) * p.x +
         b * (c2 * angle_x + s2 * angle_y) * p.y;
}

/* Its Laplacian by central differences of eighth order: good to 1e-9. */
static double biharmonic_at(const manufactured *m, int mode, double x, double y)
{
  static const double weight[] = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
  const double step = 0.004;
  double sum = 2.0 * weight[0] * diffusion_at(m, mode, x, y);
  for (int k = 1; k < 5; ++k)
    for (int sign = -1; sign <= 1; sign += 2)
      sum += weight[k] * (diffusion_at(m, mode, x + sign * k * step, y) +
                          diffusion_at(m, mode, x, y + sign * k * step));
  return sum / (step * step);
}

/* A manufactured solution on a problem, with what does not change at its nodes. */
typedef struct setting {
  manufactured m;
  problem p;
  fg__theta theta;
  jet *mode[MODES];
  double *biharmonic[MODES];
} setting;

static double angle_of_setting(double x, double y, const void *data)
{
  return angle_at(data, x, y);
}

/* Its alpha 0: implicit Euler. */
static void create_setting(setting *s, const bool periodic[2], int cells_x, double mean,
                           double size, double frequency, fg__splitting splitting)
{
  const double side[2] = {1.0, 0.7};
  s->m = (manufactured){.angle = 1.3,
                        .anisotropy = 0.2,
                        .gamma = 0.02,
                        .mean = mean,
                        .size = size,
                        .frequency = frequency};
  axis *axes[2] = {&s->m.x, &s->m.y};
  for (int k = 0; k < 2; ++k)
    *axes[k] = periodic[k] ? (axis){2.0 * PI / side[k], 0.9 + k, 0.3 - k}
                           : (axis){PI / side[k], 0.0, 0.0};
  problem_create(&s->p,
                 &(problem_description){.cells = {cells_x, cells_x / 2},
                                        .side = {side[0], side[1]},
                                        .periodic = {periodic[0], periodic[1]},
                                        .gamma = fg__theta_held(splitting) * s->m.gamma,
                                        .anisotropy = s->m.anisotropy,
                                        .angle = angle_of_setting,
                                        .angle_data = &s->m});
  s->p.of.gamma = s->m.gamma;
  s->theta = (fg__theta){0};
  if (splitting.alpha > 0.0)
    assert_int_equal(
        fg__theta_create(&s->theta, s->p.context, &s->p.multigrid, splitting),
        FG_STATUS_OK);
  for (int k = 0; k < MODES; ++k) {
    s->mode[k] = allocate_or_fail(s->p.nodes, sizeof(jet));
    s->biharmonic[k] = values_of(&s->p);
    for (size_t n = 0; n < s->p.nodes; ++n) {
      double x = s->p.spacing[0] * (double)(n % (size_t)s->p.columns);
      double y = s->p.spacing[1] * (double)(n / (size_t)s->p.columns);
      s->mode[k][n] = mode_at(&s->m, k, x, y);
      s->biharmonic[k][n] = biharmonic_at(&s->m, k, x, y);
    }
  }
}

static void clear_setting(setting *s)
{
  for (int k = 0; k < MODES; ++k) {
    free(s->mode[k]);
    free(s->biharmonic[k]);
  }
  fg__theta_clear(&s->theta);
  problem_clear(&s->p);
}

static void exact(const setting *s, double t, double *u)
{
  for (size_t n = 0; n < s->p.nodes; ++n) {
    u[n] = s->m.mean;
    for (int k = 0; k < MODES; ++k)
      u[n] += amplitude(&s->m, k, t) * s->mode[k][n].f;
  }
}

static double rate_at(const setting *s, size_t n, double t)
{
  double rate = 0.0;
  for (int k = 0; k < MODES; ++k)
    rate += amplitude_rate(&s->m, k, t) * s->mode[k][n].f;
  return rate;
}

/* f = u_t - Laplacian w of the equation itself; of the double well in w the Laplacian is
 * (6 u^2 - 2) Laplacian u + 12 u |grad u|^2. */
static void source(const setting *s, double t, double *f)
{
  for (size_t n = 0; n < s->p.nodes; ++n) {
    double u = s->m.mean, x = 0.0, y = 0.0, laplacian = 0.0, biharmonic = 0.0;
    for (int k = 0; k < MODES; ++k) {
      double a = amplitude(&s->m, k, t);
      const jet *mode = &s->mode[k][n];
      u += a * mode->f;
      x += a * mode->x;
      y += a * mode->y;
      laplacian += a * (mode->xx + mode->yy);
      biharmonic += a * s->biharmonic[k][n];
    }
    f[n] = rate_at(s, n, t) - (6.0 * u * u - 2.0) * laplacian -
           12.0 * u * (x * x + y * y) + s->m.gamma * biharmonic;
  }
}

/* f = u_t + L w of the equation discretised in space only: leaves the error of time. */
static void source_discrete_in_space(const setting *s, double t, double *f)
{
  double *u = values_of(&s->p), *w = values_of(&s->p);
  exact(s, t, u);
  reference_potential(&s->p, u, w);
  apply_stiffness(&s->p, true, w, f);
  for (size_t n = 0; n < s->p.nodes; ++n)
    f[n] = rate_at(s, n, t) + f[n] / s->p.mass[n];
  free(u);
  free(w);
}

typedef void source_term(const setting *s, double t, double *f);

/* Adds the source's share of a step to the right-hand side, which becomes `rhs`. */
static void add_source(const setting *s, source_term *f, double t, double tau,
                       double *rhs)
{
  double *values = values_of(&s->p);
  f(s, t, values);
  for (size_t n = 0; n < s->p.nodes; ++n)
    rhs[n] += tau * values[n];
  put(&s->p, s->p.multigrid.level[0].p, rhs);
  free(values);
}

static void solve(const setting *s, double tau)
{
  fg__pass_solve(&s->p.multigrid, tau, CYCLES, NULL);
}

/* One step from u at time t. */
static void step_by_euler(setting *s, source_term *f, double t, double tau, double *u)
{
  add_source(s, f, t + tau, tau, u);
  solve(s, tau);
  get(&s->p, s->p.multigrid.level[0].u, u);
}

/* The source goes with Psi': taken at the end of the middle substep, else from the start.
 */
static void step_by_theta(setting *s, source_term *f, double t, double tau, double *u)
{
  const fg__level *level = &s->p.multigrid.level[0];
  float *memory = fg__allocate_aligned(level->layout.array_size, sizeof *memory);
  assert_non_null(memory);
  float *start = memory + level->layout.first;
  put(&s->p, start, u);
  fg__splitting splitting = s->theta.splitting;
  double middle = 1.0 - splitting.theta;
  for (int n = 0; n < FG__THETA_SUBSTEPS; ++n) {
    double implicit = fg__theta_prepare(&s->theta, &s->p.multigrid, n, tau, start);
    get(&s->p, level->p, u);
    add_source(s, f, n == 0 ? t : t + middle * tau, fg__theta_share(splitting, n) * tau,
               u);
    solve(s, implicit);
  }
  get(&s->p, level->u, u);
  free(memory);
}

/* Runs from 0 to `end` in equal steps; returns the largest L2 error of any step. */
static double error_of(setting *s, source_term *f, double end, int steps)
{
  const problem *p = &s->p;
  const fg__level *level = &p->multigrid.level[0];
  double *u = values_of(p), *w = values_of(p), tau = end / steps;
  exact(s, 0.0, u);
  reference_potential(p, u, w);
  put(p, level->u, u);
  put(p, level->w, w);
  double worst = 0.0;
  for (int step = 0; step < steps; ++step) {
    (s->theta.splitting.alpha > 0.0 ? step_by_theta : step_by_euler)(s, f, tau * step,
                                                                     tau, u);
    exact(s, tau * (step + 1), w);
    for (size_t n = 0; n < p->nodes; ++n)
      w[n] -= u[n];
    worst = fmax(worst, norm(p, w));
  }
  free(u);
  free(w);
  return worst;
}

static const fg__splitting implicit = {0.0, 0.0};

/* Spinodal values included, for a time too short for growth. With tau ~ h^2 the error of
 * time falls with that of space, so that both must be right. */
static double error_in_space(const bool periodic[2], int cells_x)
{
  setting s;
  create_setting(&s, periodic, cells_x, 0.25, 1.0, 11.0, implicit);
  double error = error_of(&s, source, 0.002, cells_x * cells_x / 128);
  clear_setting(&s);
  return error;
}

static void assert_order_in_space(const bool periodic[2], int cells_x)
{
  double coarse = error_in_space(periodic, cells_x);
  double fine = error_in_space(periodic, 2 * cells_x);
  double order = log2(coarse / fine);
  print_message("# space, %d to %d cells: error %.3g to %.3g, order %.3f\n", cells_x,
                2 * cells_x, coarse, fine, order);
  assert_true(fabs(order - 2.0) < 0.15);
}

static void natural_boundaries_have_order_two(void **state)
{
  (void)state;
  assert_order_in_space((bool[]){false, false}, 32);
  assert_order_in_space((bool[]){false, false}, 64);
}

static void periodic_boundaries_have_order_two(void **state)
{
  (void)state;
  assert_order_in_space((bool[]){true, false}, 64);
  assert_order_in_space((bool[]){true, true}, 64);
}

/* A solution near a minimum, where errors do not grow. */
static void assert_order_in_time(bool periodic, fg__splitting splitting, double frequency,
                                 double end, int first, double order)
{
  setting s;
  create_setting(&s, (bool[]){periodic, false}, 64, 0.9, 0.4, frequency, splitting);
  double before = 0.0;
  for (int steps = first; steps <= 4 * first; steps *= 2) {
    double error = error_of(&s, source_discrete_in_space, end, steps);
    if (before > 0.0) {
      print_message("# time, %d to %d steps: error %.3g to %.3g, order %.3f\n", steps / 2,
                    steps, before, error, log2(before / error));
      assert_true(fabs(log2(before / error) - order) < 0.15);
    }
    before = error;
  }
  clear_setting(&s);
}

static void implicit_euler_has_order_one(void **state)
{
  (void)state;
  assert_order_in_time(false, implicit, 90.0, 0.1, 16, 1.0);
  assert_order_in_time(true, implicit, 90.0, 0.1, 16, 1.0);
}

/* Of second order with the default theta, whatever alpha, in steps that are stable; fast,
 * for else the rounding of floats hides its error. */
static void theta_has_its_order(void **state)
{
  (void)state;
  const double theta = fg__theta_default.theta;
  assert_order_in_time(false, fg__theta_default, 600.0, 0.02, 32, 2.0);
  assert_order_in_time(false, (fg__splitting){theta, 0.7}, 600.0, 0.02, 32, 2.0);
  assert_order_in_time(false, (fg__splitting){0.1, 0.7}, 600.0, 0.02, 32, 1.0);
  assert_order_in_time(false, (fg__splitting){0.45, 0.7}, 600.0, 0.02, 32, 1.0);
}

typedef struct stepping {
  bool second_order;
  fg__splitting splitting;
  int first; /* number of steps */
  double end, order;
} stepping;

/* The stepper's own steps, held at one length and solved to the rounding of floats, from
 * a density that decays; its differences of the second order begin with a step of the
 * first. */
static double *end_of_steps(const stepping *by, int steps)
{
  setting s;
  create_setting(&s, (bool[]){true, false}, 48, 0.9, 0.4, 0.0, by->splitting);
  problem *p = &s.p;
  double *u = values_of(p), tau = by->end / steps;
  exact(&s, 0.0, u);
  put(p, p->multigrid.level[0].u, u);
  fg__stepper_description description = {.cell_volume = volume_of(p),
                                         .first_tau = tau,
                                         .most_tau = tau,
                                         .accuracy = 0.9,
                                         .cycles = 1,
                                         .residual = 1e-7,
                                         .second_order = by->second_order,
                                         .splitting = by->splitting};
  fg__stepper stepper;
  assert_int_equal(fg__stepper_create(&stepper, p->context, &p->multigrid, &description),
                   FG_STATUS_OK);
  for (int n = 0; n < steps; ++n) {
    assert_int_equal(fg__stepper_advance(&stepper, p->context), FG_STATUS_OK);
    assert_true(stepper.last_tau == tau);
  }
  p->multigrid = stepper.multigrid;
  get(p, stepper.current, u);
  stepper.multigrid = (fg__multigrid){0};
  fg__stepper_clear(&stepper);
  clear_setting(&s);
  return u;
}

static void assert_order_of_steps(const stepping *by)
{
  enum { HALVINGS = 5 };
  const int first = by->first;
  setting s;
  create_setting(&s, (bool[]){true, false}, 48, 0.9, 0.4, 0.0, implicit);
  double *u[HALVINGS], before = 0.0;
  for (int n = 0; n < HALVINGS; ++n) {
    u[n] = end_of_steps(by, first << n);
    if (n == 0)
      continue;
    for (size_t k = 0; k < s.p.nodes; ++k)
      u[n - 1][k] -= u[n][k];
    double change = norm(&s.p, u[n - 1]);
    if (n > 1) {
      print_message("# %d to %d steps: %.3g to %.3g, order %.3f\n", first << (n - 1),
                    first << n, before, change, log2(before / change));
      if (n > 2)
        assert_true(fabs(log2(before / change) - by->order) < 0.2);
    }
    before = change;
  }
  for (int n = 0; n < HALVINGS; ++n)
    free(u[n]);
  clear_setting(&s);
}

static void steps_have_the_order_of_their_scheme(void **state)
{
  (void)state;
  const double theta = fg__theta_default.theta;
  const stepping steppings[] = {
      {false, implicit, 8, 4e-3, 1.0},          {true, implicit, 8, 4e-3, 2.0},
      {false, fg__theta_default, 8, 4e-3, 2.0}, {false, {theta, 1.0}, 8, 4e-3, 2.0},
      {false, {0.2, 0.6}, 8, 4e-3, 1.0},        {false, {0.4, 1.0}, 8, 4e-3, 1.0}};
  for (size_t n = 0; n < sizeof steppings / sizeof *steppings; ++n)
    assert_order_of_steps(&steppings[n]);
}

static bool outside_a_notch(double x, double y)
{
  return !(x > 0.4 && x < 0.6 && y < 0.45) && hypot(x - 0.8, y - 0.5) > 0.07;
}

/* With every step solved, Euler's energy decays and mass stays, whatever the shape. */
static void a_notched_domain_loses_energy_and_keeps_mass(void **state)
{
  (void)state;
  problem p;
  problem_create(&p, &(problem_description){.cells = {64, 40},
                                            .side = {1.0, 0.7},
                                            .gamma = 1.5e-3,
                                            .anisotropy = 0.25,
                                            .inside = outside_a_notch});
  const fg__level *level = &p.multigrid.level[0];
  double *u = values_of(&p), *w = values_of(&p);
  uint64_t seed = 2024;
  for (size_t n = 0; n < p.nodes; ++n)
    u[n] = p.mass[n] > 0.0 ? (double)(float)(-0.3 + random_value(&seed)) : 0.0;
  reference_potential(&p, u, w);
  put(&p, level->u, u);
  put(&p, level->w, w);
  double mass = integral(&p, u), area = 0.0, energy = reference_energy(&p, u);
  double first_energy = energy, tau = 1e-7;
  for (size_t n = 0; n < p.nodes; ++n)
    area += p.mass[n];
  for (int step = 0; step < 45; ++step, tau *= 1.15) {
    put(&p, level->p, u);
    fg__pass_solve(&p.multigrid, tau, CYCLES, NULL);
    get(&p, level->u, u);
    double now = reference_energy(&p, u);
    assert_true(now < energy);
    assert_true(fabs(integral(&p, u) - mass) < 1e-7 * area);
    energy = now;
  }
  assert_true(energy < 0.3 * first_energy);
  free(u);
  free(w);
  problem_clear(&p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(natural_boundaries_have_order_two),
      cmocka_unit_test(periodic_boundaries_have_order_two),
      cmocka_unit_test(implicit_euler_has_order_one),
      cmocka_unit_test(theta_has_its_order),
      cmocka_unit_test(steps_have_the_order_of_their_scheme),
      cmocka_unit_test(a_notched_domain_loses_energy_and_keeps_mass),
  };
  return cmocka_run_group_tests_name("evolution/order", tests, NULL, NULL);
}
