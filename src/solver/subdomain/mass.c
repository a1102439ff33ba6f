#include "solver/subdomain/mass.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "component/clusters.h"
#include "solver/passes.h"

static float axis_mass(const fg__level *box, int axis, int at)
{
  bool low = box->boundary[axis][0] && at == 0;
  bool high = box->boundary[axis][1] && at == box->layout.nodes[axis] - 1;
  return low || high ? 0.5F : 1.0F;
}

/* Cuts a row's nodes into runs, by their labels from 1 (0: no subdomain); with `run` NULL
 * they are only counted. */
static int cut_row(const fg__level *box, int j, int k, const int *label,
                   fg__subdomain_run *run)
{
  const fg__layout *at = &box->layout;
  float row_mass = axis_mass(box, 1, j) * axis_mass(box, 2, k);
  int count = 0;
  for (int odd = 0; odd < 2; ++odd)
    for (int i = odd, end; i < at->nodes[0]; i = end) {
      end = i + 2;
      while (end < at->nodes[0] && label[end] == label[i])
        end += 2;
      if (label[i] <= 0)
        continue;
      ptrdiff_t column = fg__column(at, i), node = fg__row_at(at, j, k) + column;
      if (run)
        run[count] = (fg__subdomain_run){.at = node,
                                         .nodes = (end - i) / 2,
                                         .subdomain = label[i] - 1,
                                         .row_mass = row_mass,
                                         .column_mass = box->column_mass + column,
                                         .mass = box->mass + node};
      ++count;
    }
  return count;
}

static int cut_box(const fg__level *box, const int *label, fg__subdomain_run *run)
{
  const int *nodes = box->layout.nodes;
  int count = 0;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j, label += nodes[0])
      count += cut_row(box, j, k, label, run ? run + count : NULL);
  return count;
}

static fg_status take_runs(fg__mass_constraint *out, fg_context *context,
                           const fg__level *box, const int *label)
{
  int count = cut_box(box, label, NULL);
  out->run = fg__allocate((size_t)count, sizeof *out->run);
  if (!out->run)
    return fg__fail_memory(context, "the parts of the domain",
                           (size_t)count * sizeof *out->run);
  out->run_count = cut_box(box, label, out->run);
  return FG_STATUS_OK;
}

static size_t node_count(const fg__level *box)
{
  const int *nodes = box->layout.nodes;
  return (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
}

static fg_status find_subdomains(fg__clusters *subdomains, fg_context *context,
                                 const fg__multigrid *multigrid)
{
  const fg__level *block = fg__multigrid_finest(multigrid);
  ptrdiff_t origin;
  unsigned char *active = fg__cells_mask(&block->tensor, &origin);
  fg_status status = FG_STATUS_OK;
  if (!active)
    status = fg__fail_memory(context, "the mask", node_count(block));
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (!status) {
    const fg__cluster_grid grid = {.partition = &multigrid->partition,
                                   .layout = &block->layout,
                                   .active = active + origin,
                                   .cell_row = block->tensor.row,
                                   .cell_plane = block->tensor.plane};
    status = fg__clusters_find(subdomains, context, &grid, NULL,
                               &(fg__cluster_request){.counting = true});
  }
  free(active);
  return status;
}

static fg_status find(fg__mass_constraint *out, fg_context *context,
                      const fg__multigrid *multigrid)
{
  const fg__level *block = fg__multigrid_finest(multigrid);
  fg__clusters subdomains = {0};
  fg_status status = find_subdomains(&subdomains, context, multigrid);
  out->count = subdomains.found.count;
  if (!status && out->count > 1) {
    int *label = fg__allocate(node_count(block), sizeof *label);
    if (label) {
      fg__clusters_label(&subdomains, label);
      status = take_runs(out, context, block, label);
    } else {
      status = fg__fail_memory(context, "the parts of the domain",
                               node_count(block) * sizeof *label);
    }
    free(label);
  }
  fg__clusters_clear(&subdomains);
  return status;
}

static fg_status take_arrays(fg__mass_constraint *out, fg_context *context)
{
  size_t count = (size_t)out->count;
  out->mass = fg__allocate(count, sizeof *out->mass);
  out->mean = fg__allocate(count, sizeof *out->mean);
  out->sum = fg__allocate(count, sizeof *out->sum);
  out->units = fg__allocate(count, sizeof *out->units);
  if (out->mass && out->mean && out->sum && out->units)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "the parts of the domain", 4 * count * sizeof(double));
}

/* Mass times u (times 1 when u is NULL); lanes are one vector's or several. */
static double sum_of_run(const fg__subdomain_run *run, const float *u, double rounding)
{
  double lane[FG__LANES] = {0.0}, sum = 0.0;
  for (int n = 0; n < run->nodes; n += FG__LANES) {
    int lanes = run->nodes - n < FG__LANES ? run->nodes - n : FG__LANES;
    for (int m = 0; m < lanes; ++m) {
      float mass = run->row_mass * run->column_mass[n + m] * run->mass[n + m];
      double term = (double)(u ? mass * u[run->at + n + m] : mass);
      lane[m] += (term + rounding) - rounding;
    }
  }
  for (int m = 0; m < FG__LANES; ++m)
    sum += lane[m];
  return sum;
}

static void add_up(const fg__mass_constraint *masses, const fg__multigrid *multigrid,
                   const float *u, double *sum)
{
  double rounding = masses->rounding;
  for (int n = 0; n < masses->count; ++n)
    sum[n] = 0.0;
  for (int n = 0; n < masses->run_count; ++n)
    sum[masses->run[n].subdomain] += sum_of_run(&masses->run[n], u, rounding);
  for (int n = 0; n < masses->count; ++n)
    masses->units[n] = fg__level_units(sum[n], rounding, multigrid->ranks->count);
  fg__ranks_add(multigrid->ranks, masses->units, masses->count);
  for (int n = 0; n < masses->count; ++n)
    sum[n] = fg__level_sum(masses->units[n], rounding);
}

fg_status fg__mass_constraint_create(fg__mass_constraint *out, fg_context *context,
                                     const fg__multigrid *multigrid, const float *u)
{
  *out = (fg__mass_constraint){.count = 1};
  if (!fg__multigrid_finest(multigrid)->mass)
    return FG_STATUS_OK;
  fg_status status = find(out, context, multigrid);
  if (!status && out->count > 1)
    status = take_arrays(out, context);
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (status || out->count <= 1) {
    fg__mass_constraint_clear(out);
    return status;
  }
  const int *nodes = multigrid->partition.nodes;
  out->rounding = fg__level_rounding((double)nodes[0] * nodes[1] * nodes[2]);
  add_up(out, multigrid, NULL, out->mass);
  add_up(out, multigrid, u, out->mean);
  for (int n = 0; n < out->count; ++n)
    out->mean[n] /= out->mass[n];
  return FG_STATUS_OK;
}

void fg__mass_constraint_clear(fg__mass_constraint *masses)
{
  free(masses->run);
  free(masses->mass);
  free(masses->mean);
  free(masses->sum);
  free(masses->units);
  *masses = (fg__mass_constraint){.count = 1};
}

double fg__mass_constraint_hold(fg__mass_constraint *masses,
                                const fg__multigrid *multigrid, const float *u)
{
  double sum = 0.0, mass = 0.0;
  add_up(masses, multigrid, u, masses->mean);
  for (int n = 0; n < masses->count; ++n) {
    double mean = masses->mean[n] / masses->mass[n];
    masses->mean[n] = ldexp(rint(ldexp(mean, 20)), -20);
    sum += masses->mass[n] * masses->mean[n];
    mass += masses->mass[n];
  }
  return sum / mass;
}

bool fg__mass_constraint_bound(fg__mass_constraint *masses, double low, double high)
{
  bool changed = false;
  for (int n = 0; masses->count > 1 && n < masses->count; ++n) {
    double bounded = fmin(fmax(masses->mean[n], low), high);
    changed = changed || bounded != masses->mean[n];
    masses->mean[n] = bounded;
  }
  return changed;
}

void fg__mass_constraint_restore(const fg__mass_constraint *masses,
                                 const fg__multigrid *multigrid, float *u)
{
  if (masses->count <= 1)
    return;
  add_up(masses, multigrid, u, masses->sum);
  for (int n = 0; n < masses->run_count; ++n) {
    const fg__subdomain_run *run = &masses->run[n];
    int subdomain = run->subdomain;
    float shift = (float)(masses->mean[subdomain] -
                          masses->sum[subdomain] / masses->mass[subdomain]);
    for (int m = 0; m < run->nodes; ++m)
      u[run->at + m] += shift;
  }
  fg__pass_fill_ghosts(multigrid, u);
}
