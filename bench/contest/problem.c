#include "problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static size_t product(const int count[3])
{
  return (size_t)count[0] * (size_t)count[1] * (size_t)count[2];
}

size_t problem_cell_count(const problem *p)
{
  return product(p->cells);
}

size_t problem_node_count(const problem *p)
{
  return product(p->nodes);
}

double problem_node_mass(const problem *p, size_t node)
{
  double mass = 1.0;
  for (int k = 0; k < p->dimension; ++k) {
    size_t count = (size_t)p->nodes[k], index = node % count;
    node /= count;
    if (index == 0 || index == count - 1)
      mass *= 0.5;
  }
  return mass;
}

double problem_distance(const problem *p, const double *a, const double *b)
{
  double sum = 0.0, weight = 0.0;
  size_t count = problem_node_count(p);
  for (size_t n = 0; n < count; ++n) {
    double mass = problem_node_mass(p, n);
    sum += mass * (a[n] - b[n]) * (a[n] - b[n]);
    weight += mass;
  }
  return sqrt(sum / weight);
}

static bool read_line(problem *p, const char *line)
{
  int found = 0;
  double *s = p->spacing;
  int *c = p->cells;
  found += sscanf(line, "dimension %d", &p->dimension) == 1;
  found += sscanf(line, "cells %d %d %d", &c[0], &c[1], &c[2]) == 3;
  found += sscanf(line, "spacing %lf %lf %lf", &s[0], &s[1], &s[2]) == 3;
  found += sscanf(line, "gamma %lf", &p->gamma) == 1;
  found += sscanf(line, "time %lf", &p->time) == 1;
  found += sscanf(line, "tau %lf", &p->tau) == 1;
  found += sscanf(line, "energy %lf", &p->energy) == 1;
  found += sscanf(line, "clusters %d", &p->clusters) == 1;
  found += sscanf(line, "debris_area %lf", &p->debris_area) == 1;
  return found == 1;
}

static bool read_all(problem *p, FILE *file)
{
  char line[256];
  while (fgets(line, sizeof line, file) && strcmp(line, "data\n") != 0)
    if (!read_line(p, line))
      return false;
  if (p->dimension != 2 && p->dimension != 3)
    return false;
  for (int k = 0; k < 3; ++k) {
    if (p->cells[k] < 1 || p->cells[k] > 1 << 14)
      return false;
    p->nodes[k] = k < p->dimension ? p->cells[k] + 1 : 1;
  }
  size_t entries = problem_cell_count(p) * (size_t)problem_tensor_entries(p);
  size_t nodes = problem_node_count(p);
  p->tensor = calloc(entries, sizeof *p->tensor);
  p->u = calloc(nodes, sizeof *p->u);
  return p->tensor && p->u &&
         fread(p->tensor, sizeof *p->tensor, entries, file) == entries &&
         fread(p->u, sizeof *p->u, nodes, file) == nodes;
}

bool problem_read(problem *out, const char *path)
{
  *out = (problem){0};
  FILE *file = fopen(path, "rb");
  bool good = file && read_all(out, file);
  if (file)
    fclose(file);
  if (good)
    return true;
  fprintf(stderr, "%s: not a problem file\n", path);
  problem_clear(out);
  return false;
}

bool problem_write(const problem *p, const char *path)
{
  FILE *file = fopen(path, "wb");
  if (!file) {
    perror(path);
    return false;
  }
  fprintf(file,
          "dimension %d\ncells %d %d %d\nspacing %.17g %.17g %.17g\ngamma %.17g\n"
          "time %.17g\ntau %.17g\nenergy %.17g\nclusters %d\ndebris_area %.17g\ndata\n",
          p->dimension, p->cells[0], p->cells[1], p->cells[2], p->spacing[0],
          p->spacing[1], p->spacing[2], p->gamma, p->time, p->tau, p->energy, p->clusters,
          p->debris_area);
  size_t entries = problem_cell_count(p) * (size_t)problem_tensor_entries(p);
  fwrite(p->tensor, sizeof *p->tensor, entries, file);
  fwrite(p->u, sizeof *p->u, problem_node_count(p), file);
  bool good = !ferror(file);
  if (fclose(file) == 0 && good)
    return true;
  perror(path);
  return false;
}

void problem_clear(problem *p)
{
  free(p->tensor);
  free(p->u);
  *p = (problem){0};
}

double *problem_read_density(const problem *p, const char *path)
{
  size_t count = problem_node_count(p);
  double *u = calloc(count, sizeof *u);
  FILE *file = fopen(path, "rb");
  bool good = u && file && fread(u, sizeof *u, count, file) == count;
  if (file)
    fclose(file);
  if (good)
    return u;
  fprintf(stderr, "%s: no density of %zu nodes\n", path, count);
  free(u);
  return NULL;
}

bool problem_write_density(const problem *p, const char *path, const double *u)
{
  size_t count = problem_node_count(p);
  FILE *file = fopen(path, "wb");
  bool good = file && fwrite(u, sizeof *u, count, file) == count;
  if (file && fclose(file) != 0)
    good = false;
  if (!good)
    perror(path);
  return good;
}

static double seconds(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double processor_seconds(void)
{
  return seconds(CLOCK_PROCESS_CPUTIME_ID);
}

double wall_seconds(void)
{
  return seconds(CLOCK_MONOTONIC);
}

double most_megabytes(void)
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return (double)usage.ru_maxrss / 1024.0;
}
