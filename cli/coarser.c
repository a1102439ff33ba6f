#include "coarser.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#include "input.h"
#include "ranks.h"

static int halve(cli_run *run)
{
  fg_status status = fg_evolution_coarsen(run->evolution, run->field,
                                          &run->evolution_options, &run->step);
  if (!status)
    return EXIT_DONE;
  progress_wipe(&run->progress);
  return complain_of(run->context, status, run->settings->operand);
}

static void remember(run_facts *facts, const fg_step *step, double energy_before,
                     const fg_mesh_info *mesh)
{
  if (facts->change_count == MAX_MESH_CHANGES)
    return;
  mesh_change *change = &facts->change[facts->change_count++];
  *change = (mesh_change){.step = step->step,
                          .time = step->time,
                          .energy_before = energy_before,
                          .energy_after = step->energy,
                          .clusters = step->clusters};
  memcpy(change->cells, mesh->cells, sizeof change->cells);
}

int coarser_when_ample(cli_run *run)
{
  if (!settings_adapt_mesh(run->settings) || !fg_evolution_is_ample(run->evolution))
    return EXIT_DONE;
  double energy = run->step.energy;
  int code = halve(run);
  if (code)
    return code;
  const fg_mesh_info *mesh = fg_evolution_mesh(run->evolution);
  remember(&run->facts, &run->step, energy, mesh);
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    fprintf(stderr, "flowgrain: step %ld, %d clusters: ", run->step.step,
            run->step.clusters);
    input_print_cells(mesh);
    fprintf(stderr, "\n");
  }
  return EXIT_DONE;
}

int coarser_as_before(cli_run *run, const fg_checkpoint *checkpoint)
{
  int code = EXIT_DONE;
  for (int n = fg_checkpoint_halvings(checkpoint); n > 0 && !code; --n)
    code = halve(run);
  return code;
}

void coarser_add(cJSON *object, const run_facts *facts)
{
  cJSON *list = cJSON_AddArrayToObject(object, "coarser");
  for (int n = 0; n < facts->change_count; ++n) {
    const mesh_change *change = &facts->change[n];
    cJSON *item = cJSON_CreateObject();
    cJSON_AddNumberToObject(item, "step", (double)change->step);
    cJSON_AddNumberToObject(item, "time", change->time);
    cJSON_AddNumberToObject(item, "energy_before", change->energy_before);
    cJSON_AddNumberToObject(item, "energy_after", change->energy_after);
    cJSON_AddNumberToObject(item, "clusters", change->clusters);
    cJSON_AddItemToObject(item, "cells",
                          cJSON_CreateIntArray(change->cells, facts->mesh.dimension));
    cJSON_AddItemToArray(list, item);
  }
}

static double number_of(const cJSON *object, const char *name)
{
  return cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(object, name));
}

bool coarser_raised_energy(const run_facts *facts)
{
  for (int n = 0; n < facts->change_count; ++n)
    if (facts->change[n].energy_after > facts->change[n].energy_before)
      return true;
  return false;
}

void coarser_restore(run_facts *facts, const cJSON *object)
{
  const cJSON *item, *cells;
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(object, "coarser"))
  {
    if (facts->change_count == MAX_MESH_CHANGES)
      return;
    mesh_change *change = &facts->change[facts->change_count++];
    *change = (mesh_change){.step = (long)number_of(item, "step"),
                            .time = number_of(item, "time"),
                            .energy_before = number_of(item, "energy_before"),
                            .energy_after = number_of(item, "energy_after"),
                            .clusters = (int)number_of(item, "clusters"),
                            .cells = {1, 1, 1}};
    cells = cJSON_GetObjectItemCaseSensitive(item, "cells");
    for (int k = 0; k < facts->mesh.dimension; ++k) {
      const cJSON *count = cJSON_GetArrayItem(cells, k);
      change->cells[k] = count ? count->valueint : 1;
    }
  }
}
