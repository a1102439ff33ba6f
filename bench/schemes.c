/* Steps of implicit Euler and of the theta scheme compared, for docs/method/schemes.md:
 * how long they can be, and how exact. vortex3, 257 nodes, from the densities of one
 * tight run at 150, 40 and 12 clusters. Takes ten minutes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "evolve/stepper.h"

enum { NODES = 257, COUNT = NODES * NODES, MOMENTS = 3 };
static const int wanted_clusters[MOMENTS] = {150, 40, 12};
static const char *const moment_names[MOMENTS] = {"early", "middle", "late"};
static const double anisotropy = 0.15;

static void check(bool good, const char *what)
{
  if (good)
    return;
  fprintf(stderr, "bench_schemes: %s failed\n", what);
  exit(1);
}

typedef struct moment {
  double time;
  int clusters;
  float *u;
} moment;

static fg_field *field;

static void keep_moment(moment *m, const fg_evolution *evolution, const fg_step *step)
{
  fg_density *density;
  check(!fg_density_create(&density, evolution), "a snapshot");
  m->time = step->time;
  m->clusters = step->clusters;
  m->u = malloc(COUNT * sizeof *m->u);
  check(m->u != NULL, "memory");
  memcpy(m->u, fg_density_contents(density)->u, COUNT * sizeof *m->u);
  fg_density_destroy(density);
}

static void take_moments(moment moments[MOMENTS])
{
  fg_evolution *evolution;
  fg_evolution_options options = {
      .nodes = NODES, .threads = 1, .accuracy = 0.01, .cycles = 6};
  check(!fg_evolution_create(&evolution, NULL, field, &options), "an evolution");
  for (int next = 0; next < MOMENTS;) {
    fg_step step;
    check(!fg_evolution_step(evolution, &step), "a step");
    if (step.clusters && step.clusters <= wanted_clusters[next])
      keep_moment(&moments[next++], evolution, &step);
  }
  fg_evolution_destroy(evolution);
}

/* The same equations by hand, as fg_evolution_create sets them up. */

typedef struct domain {
  fg__mesh mesh;
  fg__tensor tensor;
  double h, gamma, volume;
} domain;

static void create_domain(domain *d)
{
  fg__mesh_description description = {.dimension = 2, .side = {1.0, 1.0}, .nodes = NODES};
  check(!fg__mesh_create(&d->mesh, NULL, &description), "a mesh");
  d->h = d->mesh.spacing[0];
  d->volume = d->h * d->h;
  double width = 1.1 * d->h;
  d->gamma = width * width / anisotropy;
  fg__cells cells = {.dimension = 2, .spacing = {d->h, d->h}};
  size_t count = 1;
  for (int k = 0; k < 2; ++k) {
    cells.count[k] = d->mesh.cells[k];
    count *= (size_t)d->mesh.cells[k];
  }
  float **components[] = {&d->tensor.xx, &d->tensor.xy, &d->tensor.yy};
  for (int k = 0; k < 3; ++k)
    check((*components[k] = fg__allocate(count, sizeof(float))) != NULL, "memory");
  check((d->tensor.active = fg__allocate(count, 1)) != NULL, "memory");
  check(!fg__tensor_fill_box(&d->tensor, NULL, field, FG_ENERGY_FLOW, anisotropy, &cells,
                             d->mesh.periodic, sqrt(d->gamma)),
        "the tensor");
}

/* alpha 0: implicit Euler. */
static void create_multigrid(fg__multigrid *out, const domain *d, double alpha)
{
  check(!fg__multigrid_create(out, NULL, &d->mesh, &d->mesh.tile[0], &d->tensor,
                              (1.0 - alpha) * d->gamma, 1),
        "a multigrid");
}

/* Single steps of any length, each solved. */

typedef struct engine {
  fg__multigrid multigrid;
  fg__theta theta; /* alpha 0: implicit Euler */
  float *start, *before, *memory;
  double volume;
} engine;

static void create_engine(engine *s, const domain *d, double alpha)
{
  *s = (engine){.volume = d->volume};
  create_multigrid(&s->multigrid, d, alpha);
  if (alpha > 0.0)
    check(!fg__theta_create(&s->theta, NULL, &s->multigrid, alpha), "the theta scheme");
  fg__array_shape shape = fg__multigrid_shape(&s->multigrid, 0);
  s->memory = fg__allocate_aligned(2 * (shape.size + FG__LANES), sizeof(float));
  check(s->memory != NULL, "memory");
  s->start = s->memory + shape.first;
  s->before = s->start + shape.size + FG__LANES;
}

static void clear_engine(engine *s)
{
  fg__multigrid_clear(&s->multigrid);
  fg__theta_clear(&s->theta);
  free(s->memory);
}

/* Solved: the last cycle's correction is this share of the change. */
static const double solved = 1e-3;
enum { MOST_CYCLES = 100 };

static bool solve(engine *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  for (int n = 0; n < MOST_CYCLES; ++n) {
    fg__pass_cycle(m, tau, s->before);
    fg__changes c =
        fg__pass_changes(m, fg__multigrid_u(m), s->start, s->before, s->start);
    if (!(c.from_a < 1e30))
      return false;
    if (n > 0 && c.from_b <= solved * solved * c.from_a)
      return true;
  }
  return false;
}

/* From start to the multigrid's u; false when the cycles do not converge. */
static bool step(engine *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  fg__pass_copy(m, s->start, fg__multigrid_u(m));
  if (s->theta.alpha == 0.0) {
    fg__pass_copy(m, s->start, fg__multigrid_p(m));
    fg__pass_evaluate(m, s->start, fg__multigrid_w(m));
    return solve(s, tau);
  }
  bool good = true;
  for (int n = 0; n < FG__THETA_SUBSTEPS && good; ++n)
    good = solve(s, fg__theta_prepare(&s->theta, m, n, tau, s->start));
  return good;
}

typedef struct question {
  engine *engine;
  const float *u;
  bool unsolved; /* the cycles, not the answer, have ended the search */
} question;

typedef bool answer(question *q, double tau);

static bool converges(question *q, double tau)
{
  fg__level_import(&q->engine->multigrid.level[0], q->engine->start, q->u);
  return step(q->engine, tau);
}

/* Over many steps, so that what grows slowly shows. */
enum { ENERGY_STEPS = 40 };

static bool energy_falls(question *q, double tau)
{
  engine *s = q->engine;
  fg__multigrid *m = &s->multigrid;
  fg__level_import(&m->level[0], s->start, q->u);
  double energy = fg__pass_evaluate(m, s->start, s->before).energy;
  for (int n = 0; n < ENERGY_STEPS; ++n) {
    if (!step(s, tau)) {
      q->unsolved = true;
      return false;
    }
    double now = fg__pass_evaluate(m, fg__multigrid_u(m), s->before).energy;
    if (!(now <= energy)) {
      q->unsolved = false;
      return false;
    }
    energy = now;
    fg__pass_copy(m, fg__multigrid_u(m), s->start);
  }
  return true;
}

/* The largest tau with that answer, within 5 %, if the answer changes once. */
static double largest(answer *holds, question *q, double low)
{
  if (!holds(q, low))
    return 0.0;
  double high = 2.0 * low;
  while (high < 1.0 && holds(q, high)) {
    low = high;
    high *= 2.0;
  }
  while (high > 1.05 * low) {
    double middle = sqrt(low * high);
    if (holds(q, middle))
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Runs by the program's own stepper, in steps of one length. */

static void create_stepper(fg__stepper *out, const domain *d, const float *u,
                           double alpha, int cycles, double most_tau)
{
  fg__multigrid multigrid;
  create_multigrid(&multigrid, d, alpha);
  fg__level_import(&multigrid.level[0], multigrid.level[0].u, u);
  /* a change of 0.9 is accepted: lengths are ours to choose */
  fg__stepper_description description = {.cell_volume = d->volume,
                                         .first_tau = most_tau,
                                         .most_tau = most_tau,
                                         .accuracy = 0.3,
                                         .cycles = cycles,
                                         .alpha = alpha};
  check(!fg__stepper_create(out, NULL, &multigrid, &description), "a stepper");
}

/* Steps of at most tau for a time; what is rejected is taken in shorter ones. */
static void advance(fg__stepper *s, double time, double tau)
{
  double end = s->time + time;
  tau = time / ceil(time / tau * (1.0 - 1e-9));
  while (end - s->time > 1e-6 * tau) {
    s->tau = fmin(tau, end - s->time);
    s->tau_limit = (double)INFINITY;
    check(!fg__stepper_advance(s, NULL), "a step of one length");
  }
}

static void export_current(const fg__stepper *s, float *u)
{
  fg__level_export(&s->multigrid.level[0], s->current, u);
}

typedef struct error {
  double of_u, of_change; /* relative to u about its mean, and to the change */
} error;

static error error_of(const float *u, const float *exact, const float *start)
{
  double wrong = 0.0, change = 0.0, sum = 0.0, square = 0.0;
  for (size_t n = 0; n < COUNT; ++n) {
    double e = (double)u[n] - (double)exact[n], x = (double)exact[n];
    double c = x - (double)start[n];
    wrong += e * e;
    change += c * c;
    sum += x;
    square += x * x;
  }
  return (error){sqrt(wrong / (square - sum * sum / COUNT)), sqrt(wrong / change)};
}

static float *plain_array(void)
{
  float *u = malloc(COUNT * sizeof *u);
  check(u != NULL, "memory");
  return u;
}

/* What is taken as exact: theta in steps of this share of its stable one, four cycles a
 * substep. */
static const double tight_share = 0.1;
enum { TIGHT_CYCLES = 4 };

static double stable_step(const domain *d)
{
  return fg__theta_stable_step(fg__theta_alpha, anisotropy * d->gamma, d->gamma,
                               4.0 / (d->h * d->h));
}

/* Takes a density along for a few tight steps: what the run's own errors have left then
 * no longer counts as change. */
static void settle(const domain *d, moment *m)
{
  fg__stepper s;
  double time = 4.0 * stable_step(d);
  create_stepper(&s, d, m->u, fg__theta_alpha, TIGHT_CYCLES, stable_step(d));
  advance(&s, time, tight_share * stable_step(d));
  export_current(&s, m->u);
  m->time += time;
  fg__stepper_clear(&s);
}

/* The largest steps whose error against the tight solution is at most 1 % of u, and 10 %
 * of the change: found by going up with that solution. Very short steps say nothing: what
 * they change is near the rounding of floats. */
static void find_accurate_steps(const domain *d, const moment *m, engine *engines[2],
                                double found[2][2])
{
  static const double allowed[2] = {0.01, 0.1}, factor = 1.1, first = 1e-6;
  float *exact = plain_array(), *u = plain_array();
  fg__stepper tight;
  create_stepper(&tight, d, m->u, fg__theta_alpha, TIGHT_CYCLES, stable_step(d));
  bool open[2][2] = {{true, true}, {true, true}};
  memset(found, 0, 4 * sizeof(double));
  for (double tau = first; open[0][0] || open[0][1] || open[1][0] || open[1][1];
       tau *= factor) {
    advance(&tight, tau - tight.time, tight_share * stable_step(d));
    export_current(&tight, exact);
    for (int k = 0; k < 2; ++k) {
      if (!open[k][0] && !open[k][1])
        continue;
      question q = {engines[k], m->u, false};
      bool good = converges(&q, tau);
      const fg__multigrid *grid = &engines[k]->multigrid;
      fg__level_export(&grid->level[0], grid->level[0].u, u);
      error e = error_of(u, exact, m->u);
      const double shares[2] = {e.of_u, e.of_change};
      for (int n = 0; n < 2; ++n) {
        open[k][n] = open[k][n] && good && shares[n] <= allowed[n];
        if (open[k][n])
          found[k][n] = tau;
      }
    }
  }
  fg__stepper_clear(&tight);
  free(exact);
  free(u);
}

static void print_energy_limit(question *q, double unit)
{
  double limit = largest(energy_falls, q, 1e-7) / unit;
  printf(q->unsolved ? "> %.3g" : "%.3g", limit);
}

static void compare_largest_steps(const domain *d, const moment moments[MOMENTS])
{
  engine schemes[2], *both[2] = {&schemes[0], &schemes[1]};
  double h2 = d->h * d->h;
  create_engine(&schemes[0], d, 0.0);
  create_engine(&schemes[1], d, fg__theta_alpha);
  puts("\n## Largest steps, in h²\n");
  puts("| state | scheme | energy falls | cycles converge | error of u ≤ 1 % | error of "
       "the change ≤ 10 % |\n|---|---|---|---|---|---|");
  for (int n = 0; n < MOMENTS; ++n) {
    double found[2][2];
    find_accurate_steps(d, &moments[n], both, found);
    for (int k = 0; k < 2; ++k) {
      question q = {&schemes[k], moments[n].u, false};
      printf("| %s, N = %d, t = %.3g | %s | ", moment_names[n], moments[n].clusters,
             moments[n].time, k ? "θ" : "Euler");
      print_energy_limit(&q, h2);
      printf(" | %.3g | %.3g | %.3g |\n", largest(converges, &q, 1e-7) / h2,
             found[k][0] / h2, found[k][1] / h2);
      fflush(stdout);
    }
  }
  clear_engine(&schemes[0]);
  clear_engine(&schemes[1]);
  puts("\n| α, middle | linear theory | energy falls | cycles converge "
       "|\n|---|---|---|---|");
  static const double alphas[] = {0.51, 0.5858, 0.65, 0.7, 0.8, 0.9};
  for (size_t n = 0; n < sizeof alphas / sizeof alphas[0]; ++n) {
    engine s;
    create_engine(&s, d, alphas[n]);
    question q = {&s, moments[1].u, false};
    double theory =
        fg__theta_stable_step(alphas[n], anisotropy * d->gamma, d->gamma, 4.0 / h2);
    printf("| %g | %.3g | ", alphas[n], theory / h2);
    print_energy_limit(&q, h2);
    printf(" | %.3g |\n", largest(converges, &q, 1e-7) / h2);
    fflush(stdout);
    clear_engine(&s);
  }
}

static error run_steps(const domain *d, const moment *m, double alpha, double time,
                       int steps, const float *exact, long *cycles)
{
  fg__stepper s;
  float *u = plain_array();
  create_stepper(&s, d, m->u, alpha, 2, time / steps);
  advance(&s, time, time / steps);
  export_current(&s, u);
  *cycles = s.cycles_spent;
  error e = error_of(u, exact, m->u);
  fg__stepper_clear(&s);
  free(u);
  return e;
}

/* Over an eighth of the time so far, in equal steps of two cycles a step or substep. */
static void compare_accuracy(const domain *d, const moment moments[MOMENTS])
{
  puts("\n## Accuracy at equal cost\n");
  puts("| state, time | scheme | steps | cycles | error of u % | of the change % "
       "|\n|---|---|---|---|---|---|");
  float *exact = plain_array(), *finer = plain_array();
  for (int n = 0; n < MOMENTS; ++n) {
    const moment *m = &moments[n];
    double time = m->time / 8.0;
    fg__stepper s;
    create_stepper(&s, d, m->u, fg__theta_alpha, TIGHT_CYCLES, stable_step(d));
    advance(&s, time, tight_share * stable_step(d));
    export_current(&s, exact);
    fg__stepper_clear(&s);
    int least = (int)ceil(time / stable_step(d));
    const struct {
      double alpha;
      int steps;
    } runs[] = {{fg__theta_alpha, least},
                {0.0, 3 * least},
                {fg__theta_alpha, 2 * least},
                {0.0, 6 * least},
                {fg__theta_alpha, 4 * least},
                {0.0, 12 * least},
                {0.0, least},
                {0.0, least / 10},
                {0.0, least / 100}};
    for (size_t k = 0; k < sizeof runs / sizeof runs[0]; ++k) {
      if (runs[k].steps < 1)
        continue;
      long cycles;
      error e = run_steps(d, m, runs[k].alpha, time, runs[k].steps, exact, &cycles);
      printf("| %s, %.3g | %s | %d | %ld | %.3f | %.2f |\n", moment_names[n], time,
             runs[k].alpha > 0.0 ? "θ" : "Euler", runs[k].steps, cycles, 100.0 * e.of_u,
             100.0 * e.of_change);
      fflush(stdout);
    }
    /* how exact the exact is */
    double part = n == MOMENTS - 1 ? time / 8.0 : time;
    for (int half = 0; half < 2; ++half) {
      create_stepper(&s, d, m->u, fg__theta_alpha, TIGHT_CYCLES, stable_step(d));
      advance(&s, part, (half ? 0.5 : 1.0) * tight_share * stable_step(d));
      export_current(&s, half ? finer : exact);
      fg__stepper_clear(&s);
    }
    error e = error_of(exact, finer, m->u);
    printf("| %s, %.3g | what is taken as exact, against half its steps | | | %.4f | "
           "%.3f |\n",
           moment_names[n], part, 100.0 * e.of_u, 100.0 * e.of_change);
  }
  free(exact);
  free(finer);
}

/* From the early to the middle state with the step chosen by the control: what the limit
 * of linear theory spares. */
static void compare_limits(const domain *d, const moment moments[MOMENTS])
{
  puts("\n## The control, from early to middle\n");
  puts("| scheme | most τ, h² | steps | rejected | cycles |\n|---|---|---|---|---|");
  for (int k = 0; k < 3; ++k) {
    fg__multigrid multigrid;
    double alpha = k == 0 ? 0.0 : fg__theta_alpha, limit = k == 1 ? stable_step(d) : 1.0;
    create_multigrid(&multigrid, d, alpha);
    fg__level_import(&multigrid.level[0], multigrid.level[0].u, moments[0].u);
    fg__stepper_description description = {.cell_volume = d->volume,
                                           .first_tau = 1e-6,
                                           .most_tau = limit,
                                           .accuracy = 0.05,
                                           .cycles = 2,
                                           .alpha = alpha};
    fg__stepper s;
    check(!fg__stepper_create(&s, NULL, &multigrid, &description), "a stepper");
    while (s.time < moments[1].time - moments[0].time)
      check(!fg__stepper_advance(&s, NULL), "a step");
    printf("| %s | ", k == 0 ? "Euler" : "θ");
    if (k == 1)
      printf("%.3g", limit / (d->h * d->h));
    else
      printf("none");
    printf(" | %ld | %ld | %ld |\n", s.accepted, s.rejected, s.cycles_spent);
    fg__stepper_clear(&s);
  }
}

int main(void)
{
  check(!fg_field_create_analytic(&field, NULL, "vortex3", NODES), "the field");
  moment moments[MOMENTS];
  take_moments(moments);
  domain d = {0};
  create_domain(&d);
  for (int n = 0; n < MOMENTS; ++n)
    settle(&d, &moments[n]);
  printf("h² = %.4g, γ = %.3g h², %s\n", d.h * d.h, d.gamma / (d.h * d.h),
         fg__kernel_choose(2)->name);
  compare_largest_steps(&d, moments);
  compare_limits(&d, moments);
  compare_accuracy(&d, moments);
  for (int n = 0; n < MOMENTS; ++n)
    free(moments[n].u);
  free(d.tensor.xx);
  free(d.tensor.xy);
  free(d.tensor.yy);
  free(d.tensor.active);
  fg__mesh_clear(&d.mesh);
  fg_field_destroy(field);
  return 0;
}
