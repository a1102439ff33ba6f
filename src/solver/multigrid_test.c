/* What cycles do to the true residual of a step, computed in double precision from the
 * definitions. docs/design quotes the factors printed here. */
#include "solver/passes.h"
#include "solver/reference_test.h"
#include "solver/subdomain/mass.h"

enum { CYCLES = 5 };

static double turning(double x, double y, const void *data)
{
  (void)data;
  return 2.3 * x - 4.1 * y + 0.7 * sin(5.0 * x * y);
}

static bool outside_a_notch_and_a_disc(double x, double y)
{
  return !(x > 0.3 && x < 0.45 && y < 0.2) && hypot(x - 0.7, y - 0.2) > 0.06;
}

/* Rooms of 4 x 6 cells behind walls one cell thick, of which a third of the cells are
 * missing: passages one cell wide and long, rooms shut off, dead ends where a wall's cell
 * is missing that another wall closes. */
static bool in_rooms(double x, double y)
{
  unsigned i = (unsigned)(x * 128.0), j = (unsigned)(y / 0.51 * 64.0);
  if (i % 5 > 0 && j % 7 > 0)
    return true;
  uint64_t place = 1000U * i + j;
  return random_value(&place) > 0.33;
}

typedef struct shape {
  const char *name;
  int cells[2];
  double side[2];
  bool periodic[2];
  bool (*inside)(double x, double y);
} shape;

static const shape SHAPES[] = {
    {"square", {128, 128}, {1.0, 1.0}, {false, false}, NULL},
    {"long", {256, 80}, {1.0, 0.3125}, {false, false}, NULL},
    {"unequal cells", {256, 80}, {1.0, 0.4}, {false, false}, NULL},
    {"periodic", {128, 96}, {1.0, 0.77}, {true, true}, NULL},
    {"long, periodic", {256, 80}, {1.0, 0.3125}, {true, false}, NULL},
    {"masked", {128, 64}, {1.0, 0.51}, {false, false}, outside_a_notch_and_a_disc},
    {"masked, periodic",
     {128, 64},
     {1.0, 0.51},
     {true, true},
     outside_a_notch_and_a_disc},
};

static const shape ROOMS[] = {
    {"rooms", {128, 64}, {1.0, 0.51}, {false, false}, in_rooms},
    {"rooms, periodic", {128, 64}, {1.0, 0.51}, {true, true}, in_rooms},
};

/* The default interface: gamma = (1.1 h)^2 / a. */
static void create(problem *p, const shape *s)
{
  double anisotropy = 0.15;
  double h = fmax(s->side[0] / s->cells[0], s->side[1] / s->cells[1]);
  problem_create(p, &(problem_description){.cells = {s->cells[0], s->cells[1]},
                                           .side = {s->side[0], s->side[1]},
                                           .periodic = {s->periodic[0], s->periodic[1]},
                                           .gamma = 1.21 * h * h / anisotropy,
                                           .anisotropy = anisotropy,
                                           .angle = turning,
                                           .inside = s->inside});
}

static double *random_density(const problem *p, double mean, double size)
{
  double *u = values_of(p);
  uint64_t seed = 11;
  for (size_t n = 0; n < p->nodes; ++n)
    u[n] = p->mass[n] > 0.0 ? (double)(float)(mean + size * random_value(&seed)) : 0.0;
  return u;
}

static double square_of_spacing(const problem *p)
{
  double h = fmax(p->spacing[0], p->spacing[1]);
  return h * h;
}

static double residual(const problem *p, double tau, const double *rhs)
{
  const fg__level *level = &p->multigrid.level[0];
  double *u = values_of(p), *w = values_of(p), *first = values_of(p);
  double *second = values_of(p);
  get(p, level->u, u);
  get(p, level->w, w);
  reference_residuals(p, tau, rhs, u, w, first, second);
  /* what w lacks reaches the first equation through tau L ~ tau / h^2 */
  double size = hypot(norm(p, first), tau / square_of_spacing(p) * norm(p, second));
  free(u);
  free(w);
  free(first);
  free(second);
  return size;
}

/* What rounding the density to floats makes of the residual, through w. */
static double rounding_of(const problem *p, double tau, const double *density)
{
  double *u = values_of(p), *exact = values_of(p), *rounded = values_of(p);
  uint64_t seed = 29;
  for (size_t n = 0; n < p->nodes; ++n)
    u[n] = density[n] * (1.0 + 0x1p-24 * random_value(&seed));
  reference_potential(p, density, exact);
  reference_potential(p, u, rounded);
  for (size_t n = 0; n < p->nodes; ++n)
    rounded[n] -= exact[n];
  double size = tau / square_of_spacing(p) * norm(p, rounded);
  free(u);
  free(exact);
  free(rounded);
  return size;
}

/* Starts a step from a density and returns the mean factor by which each of CYCLES cycles
 * lowers the residual, or each of those before rounding is what is left of it. tau is
 * given as tau gamma / h^4. */
static double factor(const problem *p, const double *density, double scaled_tau)
{
  const fg__level *level = &p->multigrid.level[0];
  double h2 = square_of_spacing(p), tau = scaled_tau * h2 * h2 / p->of.gamma;
  double *w = values_of(p);
  reference_potential(p, density, w);
  put(p, level->u, density);
  put(p, level->w, w);
  put(p, level->p, density);
  free(w);
  double before = residual(p, tau, density);
  fg__mass_constraint means;
  assert_int_equal(fg__mass_constraint_create(&means, NULL, &p->multigrid, level->u),
                   FG_STATUS_OK);
  double after = before, least = 4.0 * rounding_of(p, tau, density);
  int cycles = 0;
  while (cycles < CYCLES && after > least) {
    fg__pass_solve(&p->multigrid, tau, 1, NULL);
    fg__mass_constraint_restore(&means, &p->multigrid, level->u);
    after = residual(p, tau, density);
    ++cycles;
  }
  fg__mass_constraint_clear(&means);
  return pow(after / before, 1.0 / cycles);
}

/* A density of separated phases: steps of growing size from noise. */
static double *separated_density(const problem *p)
{
  const fg__level *level = &p->multigrid.level[0];
  double *u = random_density(p, -0.4, 1.0), *w = values_of(p);
  reference_potential(p, u, w);
  put(p, level->u, u);
  put(p, level->w, w);
  double tau = 0.1 * square_of_spacing(p);
  for (int step = 0; step < 60; ++step, tau *= 1.1) {
    put(p, level->p, u);
    fg__pass_solve(&p->multigrid, tau, 4, NULL);
    get(p, level->u, u);
  }
  free(w);
  return u;
}

/* A density, the sizes of step to take from it, and the factor to stay below. */
typedef struct demand {
  double scaled_tau, factor;
} demand;

enum { OPEN = sizeof SHAPES / sizeof *SHAPES, SHUT = sizeof ROOMS / sizeof *ROOMS };

static void assert_factors(const shape *shapes, size_t shape_count, const char *name,
                           double *(*density_of)(const problem *), const demand *demands,
                           size_t count)
{
  for (size_t s = 0; s < shape_count; ++s) {
    problem p;
    create(&p, &shapes[s]);
    double *density = density_of(&p);
    for (size_t n = 0; n < count; ++n) {
      double measured = factor(&p, density, demands[n].scaled_tau);
      print_message("# %s, %s, tau gamma / h^4 = %g: %.3f a cycle\n", name,
                    shapes[s].name, demands[n].scaled_tau, measured);
      assert_true(measured < demands[n].factor);
    }
    free(density);
    problem_clear(&p);
  }
}

static double *density_near_a_minimum(const problem *p)
{
  return random_density(p, 0.9, 0.2);
}

/* Where both minima's curvature is positive the solution is unique, and any step will do.
 */
static void cycles_converge_near_a_minimum_for_any_step(void **state)
{
  (void)state;
  const demand demands[] = {
      {1.0, 0.33}, {1e1, 0.33}, {1e2, 0.33}, {1e3, 0.33}, {1e4, 0.33}};
  assert_factors(SHAPES, OPEN, "near a well", density_near_a_minimum, demands, 5);
}

static double *strong_noise(const problem *p)
{
  return random_density(p, -0.4, 1.5);
}

/* As at the start of a run. Larger steps have several solutions here. */
static void cycles_converge_on_strong_noise(void **state)
{
  (void)state;
  const demand demands[] = {{0.1, 0.3}, {1.0, 0.35}, {1e1, 0.45}};
  assert_factors(SHAPES, OPEN, "strong noise", strong_noise, demands, 3);
}

/* As in the middle of a run. */
static void cycles_converge_on_separated_phases(void **state)
{
  (void)state;
  const demand demands[] = {{1.0, 0.36}, {1e1, 0.5}, {1e2, 0.68}};
  assert_factors(SHAPES, OPEN, "separated phases", separated_density, demands, 3);
}

/* Where walls, passages and rooms shut off are one cell wide. */
static void cycles_converge_in_rooms(void **state)
{
  (void)state;
  const demand well[] = {{1.0, 0.3}, {1e1, 0.4}, {1e2, 0.5}, {1e3, 0.7}, {1e4, 0.9}};
  const demand noise[] = {{0.1, 0.3}, {1.0, 0.35}, {1e1, 0.45}};
  const demand phases[] = {{1.0, 0.36}, {1e1, 0.5}, {1e2, 0.78}};
  assert_factors(ROOMS, SHUT, "near a well", density_near_a_minimum, well, 5);
  assert_factors(ROOMS, SHUT, "strong noise", strong_noise, noise, 3);
  assert_factors(ROOMS, SHUT, "separated phases", separated_density, phases, 3);
}

/* A solved step stays solved: cycles do not wander off at float rounding. */
static void a_solution_is_a_fixed_point(void **state)
{
  (void)state;
  for (size_t s = 0; s < sizeof SHAPES / sizeof *SHAPES; ++s) {
    problem p;
    create(&p, &SHAPES[s]);
    const fg__level *level = &p.multigrid.level[0];
    double *density = density_near_a_minimum(&p), *u = values_of(&p), *v = values_of(&p);
    factor(&p, density, 30.0);
    double tau = 30.0 * pow(square_of_spacing(&p), 2.0) / p.of.gamma;
    fg__pass_solve(&p.multigrid, tau, 15, NULL);
    get(&p, level->u, u);
    fg__pass_solve(&p.multigrid, tau, 10, NULL);
    get(&p, level->u, v);
    for (size_t n = 0; n < p.nodes; ++n)
      assert_true(fabs(u[n] - v[n]) < 2e-6);
    free(density);
    free(u);
    free(v);
    problem_clear(&p);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cycles_converge_near_a_minimum_for_any_step),
      cmocka_unit_test(cycles_converge_on_strong_noise),
      cmocka_unit_test(cycles_converge_on_separated_phases),
      cmocka_unit_test(cycles_converge_in_rooms),
      cmocka_unit_test(a_solution_is_a_fixed_point),
  };
  return cmocka_run_group_tests_name("solver/multigrid", tests, NULL, NULL);
}
