/* Whole runs by BDF2, by implicit Euler and by the theta scheme compared with a tight
 * one, for docs/method/schemes.md: vortex3, 257 nodes, to 12 clusters, one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "flowgrain/flowgrain.h"

enum { NODES = 257, CLUSTERS = 12, MOST_STEPS = 40000, TIMES = 10 };

static void check(bool good, const char *what)
{
  if (good)
    return;
  fprintf(stderr, "bench_scheme_runs: %s failed\n", what);
  exit(1);
}

static double cpu_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct curve {
  int count; /* of steps */
  long cycles, rejected;
  double seconds, residual; /* the residual: mean of logarithms */
  double time[MOST_STEPS], energy[MOST_STEPS];
  int clusters[MOST_STEPS];
} curve;

static fg_field *field;

static curve *run_to_end(fg_evolution_options options)
{
  fg_evolution *evolution;
  curve *c = calloc(1, sizeof *c);
  options.nodes = NODES;
  options.threads = 1;
  check(c != NULL, "memory");
  check(!fg_evolution_create(&evolution, NULL, field, &options), "an evolution");
  double start = cpu_seconds();
  fg_step step;
  do {
    check(!fg_evolution_step(evolution, &step) && c->count < MOST_STEPS, "a step");
    c->time[c->count] = step.time;
    c->energy[c->count] = step.energy;
    c->clusters[c->count++] = step.clusters;
    c->cycles += step.cycles;
    c->rejected += step.rejected;
    c->residual += log(step.residual);
  } while (!step.clusters || step.clusters > CLUSTERS);
  c->seconds = cpu_seconds() - start;
  c->residual = exp(c->residual / c->count);
  fg_evolution_destroy(evolution);
  return c;
}

static int step_at(const curve *c, double time)
{
  int k = 0;
  while (k + 1 < c->count && c->time[k] < time)
    ++k;
  return k;
}

static double energy_at(const curve *c, double time)
{
  int k = step_at(c, time);
  if (k == 0)
    return c->energy[0];
  double share = (time - c->time[k - 1]) / (c->time[k] - c->time[k - 1]);
  return c->energy[k - 1] + share * (c->energy[k] - c->energy[k - 1]);
}

static void compare_run(const char *name, const curve *c, const curve *tight,
                        const double times[TIMES])
{
  if (c->residual > 0.0)
    printf("| %.2g ", c->residual);
  double clusters = 0.0, energy = 0.0;
  for (int k = 0; k < TIMES; ++k) {
    int wanted = tight->clusters[step_at(tight, times[k])];
    clusters += fabs((double)(c->clusters[step_at(c, times[k])] - wanted)) / wanted;
    double e = energy_at(tight, times[k]);
    energy += fabs(energy_at(c, times[k]) - e) / e;
  }
  printf("| %s | %d | %ld | %ld | %.2f | %.1f | %.2f |\n", name, c->count, c->rejected,
         c->cycles, c->seconds, 100.0 * clusters / TIMES, 100.0 * energy / TIMES);
  fflush(stdout);
}

static void spread_times(double times[TIMES], const curve *tight)
{
  double first = 0.0, last = 0.9 * tight->time[tight->count - 1];
  for (int k = 0; first == 0.0; ++k)
    if (tight->clusters[k])
      first = 1.3 * tight->time[k];
  for (int k = 0; k < TIMES; ++k)
    times[k] = first * pow(last / first, k / (TIMES - 1.0));
}

/* Fixed numbers of cycles against steps that are solved. */
static void compare_cycles(void)
{
  static const struct {
    const char *name;
    fg_evolution_options options;
  } runs[] = {{"1 cycle", {.cycles = 1, .residual = 1e9}},
              {"2 cycles (default)", {.cycles = 2, .residual = 1e9}},
              {"3 cycles", {.cycles = 3, .residual = 1e9}},
              {"4 cycles", {.cycles = 4, .residual = 1e9}},
              {"6 cycles", {.cycles = 6, .residual = 1e9}},
              {"to 0.1", {.residual = 1e-1}},
              {"to 0.01", {.residual = 1e-2}},
              {"to 0.001", {.residual = 1e-3}}};
  double times[TIMES];
  curve *solved = run_to_end((fg_evolution_options){.residual = 1e-4});
  spread_times(times, solved);
  puts("\n| residual | a step of BDF2 takes | steps | rejected | cycles | CPU s | N "
       "differs by % | E differs by % |\n|---|---|---|---|---|---|---|---|");
  for (size_t n = 0; n < sizeof runs / sizeof runs[0]; ++n) {
    curve *c = run_to_end(runs[n].options);
    compare_run(runs[n].name, c, solved, times);
    free(c);
  }
  compare_run("to 0.0001", solved, solved, times);
  free(solved);
}

static void compare_whole_runs(const curve *tight)
{
  double times[TIMES];
  spread_times(times, tight);
  static const struct {
    const char *name;
    fg_evolution_options options;
  } runs[] = {
      {"BDF2, η = 0.07 (default)", {.scheme = FG_SCHEME_BDF2}},
      {"BDF2, η = 0.1", {.scheme = FG_SCHEME_BDF2, .accuracy = 0.1}},
      {"BDF2, η = 0.03", {.scheme = FG_SCHEME_BDF2, .accuracy = 0.03}},
      {"Euler, η = 0.05 (default)", {.scheme = FG_SCHEME_EULER}},
      {"Euler, η = 0.02", {.scheme = FG_SCHEME_EULER, .accuracy = 0.02}},
      {"θ (default)", {.scheme = FG_SCHEME_THETA}},
  };
  enum { RUNS = sizeof runs / sizeof runs[0], EULER = 3, THETA = 5 };
  curve *c[RUNS];
  puts("| run to 12 clusters | steps | rejected | cycles | CPU s | N differs by % | E "
       "differs by % |\n|---|---|---|---|---|---|---|");
  compare_run("tight: BDF2, η = 0.01, 6 cycles", tight, tight, times);
  for (int n = 0; n < RUNS; ++n) {
    c[n] = run_to_end(runs[n].options);
    compare_run(runs[n].name, c[n], tight, times);
  }
  puts("\n| t | tight: N, E | BDF2: N, E | Euler: N, E | θ: N, E "
       "|\n|---|---|---|---|---|");
  const curve *shown[] = {tight, c[0], c[EULER], c[THETA]};
  for (int k = 0; k < TIMES; ++k) {
    printf("| %.2e |", times[k]);
    for (int n = 0; n < 4; ++n)
      printf(" %d, %.5f |", shown[n]->clusters[step_at(shown[n], times[k])],
             energy_at(shown[n], times[k]));
    puts("");
  }
  for (int n = 0; n < RUNS; ++n)
    free(c[n]);
}

int main(void)
{
  check(!fg_field_create_analytic(&field, NULL, "vortex3", NODES), "the field");
  curve *tight = run_to_end((fg_evolution_options){.accuracy = 0.01, .cycles = 6});
  compare_cycles();
  compare_whole_runs(tight);
  free(tight);
  fg_field_destroy(field);
  return 0;
}
