#include "schemes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "solver/multigrid_test.h"

const char *const scheme_names[SCHEMES] = {"Euler", "BDF2", "θ"};
static const int wanted_clusters[SNAPSHOTS] = {150, 40, 12};
static const char *const names[SNAPSHOTS] = {"early", "middle", "late"};
static const double anisotropy = 0.15;

void check(bool good, const char *what)
{
  if (good)
    return;
  fprintf(stderr, "bench_schemes: %s failed\n", what);
  exit(1);
}

static void keep_snapshot(snapshot *m, const fg_evolution *evolution, const fg_step *step)
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

void take_snapshots(snapshot snapshots[SNAPSHOTS], fg_field *field)
{
  fg_evolution *evolution;
  fg_evolution_options options = {
      .nodes = NODES, .threads = 1, .accuracy = 0.01, .cycles = 6};
  check(!fg_evolution_create(&evolution, NULL, field, &options), "an evolution");
  for (int next = 0; next < SNAPSHOTS;) {
    fg_step step;
    check(!fg_evolution_step(evolution, &step), "a step");
    if (step.clusters && step.clusters <= wanted_clusters[next]) {
      snapshots[next].name = names[next];
      keep_snapshot(&snapshots[next++], evolution, &step);
    }
  }
  fg_evolution_destroy(evolution);
}

void domain_create(domain *d, fg_field *field)
{
  *d = (domain){0};
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
  check(!fg__tensor_fill_box(&d->tensor, NULL, field, &fg__law_flow, anisotropy, &cells,
                             d->mesh.periodic, sqrt(d->gamma), NULL),
        "the tensor");
}

void domain_clear(domain *d)
{
  free(d->tensor.xx);
  free(d->tensor.xy);
  free(d->tensor.yy);
  free(d->tensor.active);
  fg__mesh_clear(&d->mesh);
}

void create_multigrid(fg__multigrid *out, const domain *d, double alpha)
{
  check(!multigrid_of_tensor(out, NULL, &d->mesh, &d->tensor,
                             fg__theta_held(splitting_of(alpha)) * d->gamma, NULL),
        "a multigrid");
}

double stable_step(const domain *d, double alpha)
{
  return fg__theta_stable_step(splitting_of(alpha), anisotropy * d->gamma, d->gamma,
                               4.0 / (d->h * d->h));
}

void create_stepper(fg__stepper *out, const domain *d, const float *u, scheme by,
                    int cycles, double most_tau)
{
  fg__multigrid multigrid;
  double alpha = by == THETA ? fg__theta_default.alpha : 0.0;
  create_multigrid(&multigrid, d, alpha);
  fg__level_import(&multigrid.level[0], multigrid.level[0].u, u);
  fg__fill_ghosts(&multigrid.level[0], multigrid.level[0].u);
  /* a change of 0.9 is accepted: lengths are ours to choose */
  fg__stepper_description description = {.cell_volume = d->volume,
                                         .first_tau = most_tau,
                                         .most_tau = most_tau,
                                         .accuracy = 0.3,
                                         .cycles = cycles,
                                         .second_order = by == BDF2,
                                         .splitting = splitting_of(alpha)};
  check(!fg__stepper_create(out, NULL, &multigrid, &description), "a stepper");
}

void advance(fg__stepper *s, double time, double tau)
{
  double end = s->time + time;
  tau = time / ceil(time / tau * (1.0 - 1e-9));
  while (end - s->time > 1e-6 * tau) {
    s->tau = fmin(tau, end - s->time);
    s->tau_limit = (double)INFINITY;
    check(!fg__stepper_advance(s, NULL), "a step of one length");
  }
}

void export_current(const fg__stepper *s, float *u)
{
  fg__level_export(&s->multigrid.level[0], s->current, u);
}

void create_exact(fg__stepper *out, const domain *d, const float *u)
{
  enum { TIGHT_CYCLES = 4 };
  create_stepper(out, d, u, THETA, TIGHT_CYCLES, stable_step(d, fg__theta_default.alpha));
}

double exact_step(const domain *d)
{
  return 0.1 * stable_step(d, fg__theta_default.alpha);
}

error error_of(const float *u, const float *exact, const float *start)
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

float *plain_array(void)
{
  float *u = malloc(COUNT * sizeof *u);
  check(u != NULL, "memory");
  return u;
}
