/* Whole runs through the public interface, recorded: N(t), E(t) and densities at chosen
 * times. */
#ifndef FG__CURVE_TEST_H
#define FG__CURVE_TEST_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"

enum { MOST_POINTS = 4096, TIMES = 10 };

typedef struct curve {
  int count; /* of steps */
  double time[MOST_POINTS], energy[MOST_POINTS];
  int clusters[MOST_POINTS];
  size_t nodes;
  float *density[TIMES]; /* where times were asked for */
} curve;

static inline size_t node_count(const fg_density_arrays *density)
{
  return (size_t)density->nodes[0] * (size_t)density->nodes[1];
}

/* Keeps the density of each time passed in the last step, interpolated linearly. */
static inline void keep_densities(curve *c, const fg_evolution *evolution,
                                  const double *times, int *kept, float **last)
{
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *now = fg_density_contents(density);
  c->nodes = node_count(now);
  if (!*last) {
    *last = malloc(c->nodes * sizeof **last);
    assert_non_null(*last);
    memcpy(*last, now->u, c->nodes * sizeof **last);
  }
  double before = c->count > 1 ? c->time[c->count - 2] : 0.0;
  for (; *kept < TIMES && times[*kept] <= now->time; ++*kept) {
    float share = (float)((times[*kept] - before) / (now->time - before));
    float *u = malloc(c->nodes * sizeof *u);
    assert_non_null(u);
    for (size_t n = 0; n < c->nodes; ++n)
      u[n] = (*last)[n] + share * (now->u[n] - (*last)[n]);
    c->density[*kept] = u;
  }
  memcpy(*last, now->u, c->nodes * sizeof **last);
  fg_density_destroy(density);
}

/* Runs until `clusters` are left (0: never) or until `end` (0: never). `times` may be
 * NULL; else ascending, TIMES of them. */
static inline curve *run_curve(const char *field_name,
                               const fg_evolution_options *options, int clusters,
                               double end, const double *times)
{
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  curve *c = calloc(1, sizeof *c);
  assert_non_null(c);
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, field_name, 257),
                   FG_STATUS_OK);
  assert_int_equal(fg_evolution_create(&evolution, context, field, options),
                   FG_STATUS_OK);
  fg_step step;
  float *last = NULL;
  int kept = 0;
  do {
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    assert_true(c->count < MOST_POINTS);
    c->time[c->count] = step.time;
    c->energy[c->count] = step.energy;
    c->clusters[c->count++] = step.clusters;
    if (times)
      keep_densities(c, evolution, times, &kept, &last);
  } while ((step.clusters == 0 || step.clusters > clusters) &&
           (end == 0.0 || step.time < end));
  free(last);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return c;
}

static inline void destroy_curve(curve *c)
{
  for (int k = 0; k < TIMES; ++k)
    free(c->density[k]);
  free(c);
}

/* The step that reaches a time. */
static inline int step_at(const curve *c, double time)
{
  int k = 0;
  while (k + 1 < c->count && c->time[k] < time)
    ++k;
  return k;
}

static inline int clusters_at(const curve *c, double time)
{
  return c->clusters[step_at(c, time)];
}

static inline double energy_at(const curve *c, double time)
{
  int k = step_at(c, time);
  if (k == 0)
    return c->energy[0];
  double share = (time - c->time[k - 1]) / (c->time[k] - c->time[k - 1]);
  return c->energy[k - 1] + share * (c->energy[k] - c->energy[k - 1]);
}

static inline double first_count_time(const curve *c)
{
  int k = 0;
  while (k + 1 < c->count && c->clusters[k] == 0)
    ++k;
  return c->time[k];
}

static inline double end_of(const curve *c)
{
  return c->time[c->count - 1];
}

/* TIMES evenly spaced logarithms. */
static inline void spread_times(double first, double last, double times[TIMES])
{
  for (int k = 0; k < TIMES; ++k)
    times[k] = first * pow(last / first, k / (TIMES - 1.0));
}

/* Mean and standard deviation of a sample. */
static inline double mean_of(const double *values, int count)
{
  double sum = 0.0;
  for (int k = 0; k < count; ++k)
    sum += values[k];
  return sum / count;
}

static inline double scatter_of(const double *values, int count)
{
  double mean = mean_of(values, count), sum = 0.0;
  for (int k = 0; k < count; ++k)
    sum += (values[k] - mean) * (values[k] - mean);
  return sqrt(sum / (count - 1));
}

/* Slope of log N (or of log E) over log t where at most `most` clusters are left. */
static inline double exponent_of(const curve *c, bool of_energy, int most)
{
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, count = 0.0;
  for (int k = 0; k < c->count; ++k) {
    if (c->clusters[k] == 0 || c->clusters[k] > most)
      continue;
    double a = log(c->time[k]), b = log(of_energy ? c->energy[k] : c->clusters[k]);
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
    count += 1.0;
  }
  assert_true(count > 10.0);
  return (count * xy - x * y) / (count * xx - x * x);
}

#endif
