/* Writes the problem that the contestants of `make bench` solve, or counts clusters.
 *   bench_problem export FIELD NODES CLUSTERS FILE   the first density of at most
 *                                                    CLUSTERS clusters (0: the noise,
 *                                                    with the first step that is made)
 *   bench_problem count FILE DENSITY                 clusters of a contestant's density
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "problem.h"
#include "tensor/tensor.h"

/* The tensor as fg_evolution_create makes it for the default energy. */
static fg_status take_tensor(problem *p, fg_context *context, const fg_field *field,
                             const fg_mesh_info *mesh, const double origin[3])
{
  size_t count = problem_cell_count(p), entries = (size_t)problem_tensor_entries(p);
  float *memory = calloc(entries * count, sizeof *memory);
  unsigned char *active = calloc(count, 1);
  p->tensor = calloc(entries * count, sizeof *p->tensor);
  fg_status status = FG_STATUS_MEMORY;
  if (memory && active && p->tensor) {
    float *entry[6];
    for (size_t e = 0; e < 6; ++e)
      entry[e] = e < entries ? memory + e * count : NULL;
    bool flat = p->dimension == 2;
    fg__tensor tensor = {.xx = entry[0],
                         .xy = entry[1],
                         .xz = flat ? NULL : entry[2],
                         .yy = flat ? entry[2] : entry[3],
                         .yz = entry[4],
                         .zz = entry[5],
                         .active = active};
    fg__cells cells = {.dimension = p->dimension};
    for (int k = 0; k < 3; ++k) {
      cells.count[k] = p->cells[k];
      cells.origin[k] = origin[k];
      cells.spacing[k] = mesh->spacing[k];
    }
    status = fg__tensor_fill_box(&tensor, context, field, &fg__law_flow, mesh->anisotropy,
                                 &cells, (const bool[3]){false},
                                 sqrt(mesh->gamma) * mesh->length, NULL);
    for (size_t n = 0; n < entries * count; ++n)
      p->tensor[n] = entry[n % entries][n / entries];
  }
  free(memory);
  free(active);
  return status;
}

static fg_status evolve(fg_evolution *evolution, int clusters, fg_step *step,
                        int *rejected)
{
  fg_status status = FG_STATUS_OK;
  while (!status && clusters > 0 && (step->clusters > clusters || step->clusters == 0)) {
    status = fg_evolution_step(evolution, step);
    *rejected += step->rejected;
  }
  return status;
}

static fg_status take_density(problem *p, const fg_density *density,
                              const fg_mesh_info *mesh)
{
  const fg_density_arrays *arrays = fg_density_contents(density);
  p->dimension = arrays->dimension;
  p->gamma = mesh->gamma;
  p->time = arrays->time;
  p->energy = arrays->energy;
  p->clusters = arrays->clusters;
  p->debris_area = arrays->debris_area / pow(mesh->length, arrays->dimension);
  for (int k = 0; k < 3; ++k) {
    bool used = k < arrays->dimension;
    p->cells[k] = used ? mesh->cells[k] : 1;
    p->nodes[k] = used ? arrays->nodes[k] : 1;
    p->spacing[k] = used ? mesh->spacing[k] / mesh->length : 1.0;
    if (used && (arrays->periodic[k] || arrays->active))
      return FG_STATUS_UNSUPPORTED;
  }
  size_t count = problem_node_count(p);
  p->u = calloc(count, sizeof *p->u);
  if (!p->u)
    return FG_STATUS_MEMORY;
  memcpy(p->u, arrays->u, count * sizeof *p->u);
  return FG_STATUS_OK;
}

static int export(fg_context *context, const char *input, int nodes, int clusters,
                  const char *path)
{
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_evolution_options options = {.nodes = nodes, .threads = 1};
  fg_step step = {0};
  problem p = {0};
  fg_status status = fg_field_read(&field, context, input, NULL);
  if (!status)
    status = fg_evolution_create(&evolution, context, field, &options);
  int rejected = 0;
  double processor = processor_seconds(), wall = wall_seconds();
  if (!status)
    status = evolve(evolution, clusters, &step, &rejected);
  processor = processor_seconds() - processor;
  wall = wall_seconds() - wall;
  if (!status)
    status = fg_density_create(&density, evolution);
  if (!status)
    status = take_density(&p, density, fg_evolution_mesh(evolution));
  if (!status)
    status = take_tensor(&p, context, field, fg_evolution_mesh(evolution),
                         fg_density_contents(density)->origin);
  if (!status && clusters == 0) /* the first step that will be made */
    status = fg_evolution_step(evolution, &step);
  p.tau = step.tau;
  int result = 1;
  if (status)
    fprintf(stderr, "bench_problem: %s: %s\n", fg_status_name(status),
            fg_context_message(context));
  else if (problem_write(&p, path)) {
    printf("t %.6e tau %.4e E %.6f clusters %d steps %ld rejected %d cpu %.4f wall %.4f "
           "MB %.0f\n",
           p.time, p.tau, p.energy, p.clusters, step.step, rejected, processor, wall,
           most_megabytes());
    result = 0;
  }
  problem_clear(&p);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  return result;
}

/* Clusters as the library counts them, of any density on the problem's mesh. */
static int count(fg_context *context, const char *path, const char *density_path)
{
  problem p;
  if (!problem_read(&p, path))
    return 1;
  double *values = problem_read_density(&p, density_path);
  size_t nodes = problem_node_count(&p);
  for (size_t n = 0; values && n < nodes; ++n)
    p.u[n] = (float)values[n];
  fg_density_arrays arrays = {
      .dimension = p.dimension, .u = p.u, .debris_area = p.debris_area};
  for (int k = 0; k < 3; ++k) {
    arrays.nodes[k] = p.nodes[k];
    arrays.spacing[k] = p.spacing[k];
  }
  fg_density *density = NULL;
  fg_field *field = NULL;
  fg_icons *icons = NULL;
  fg_status status =
      values ? fg_density_create_from_arrays(&density, context, &arrays) : FG_STATUS_OK;
  if (density)
    status = fg_field_create_analytic(&field, context, "vortex3", 65);
  if (field)
    status = fg_icons_create(&icons, context, field, density, NULL);
  if (icons)
    printf("%d\n", fg_icons_clusters(icons));
  if (status)
    fprintf(stderr, "bench_problem: %s\n", fg_context_message(context));
  fg_icons_destroy(icons);
  fg_field_destroy(field);
  fg_density_destroy(density);
  free(values);
  problem_clear(&p);
  return status || !values;
}

int main(int argc, char **argv)
{
  fg_context *context;
  int result = 2;
  if (fg_context_create(&context))
    return 1;
  if (argc == 6 && strcmp(argv[1], "export") == 0)
    result = export(context, argv[2], atoi(argv[3]), atoi(argv[4]), argv[5]);
  else if (argc == 4 && strcmp(argv[1], "count") == 0)
    result = count(context, argv[2], argv[3]);
  else
    fprintf(stderr, "usage: bench_problem export FIELD NODES CLUSTERS FILE\n"
                    "       bench_problem count FILE DENSITY\n");
  fg_context_destroy(context);
  return result;
}
