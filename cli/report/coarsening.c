#include "report/coarsening.h"

#include <cjson/cJSON.h>
#include <inttypes.h>
#include <stdio.h>

#include "ranks.h"
#include "run/input.h"

const fg_coarsening *coarsening_record(cli_run *run)
{
  run_facts *facts = &run->facts;
  const fg_coarsening *last = fg_evolution_coarsening(fg_run_evolution(run->scales));
  if (facts->coarsening_count < MOST_COARSENINGS)
    facts->coarsening[facts->coarsening_count++] = *last;
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    fprintf(stderr, "flowgrain: step %" PRId64 ", %d clusters: ", last->step,
            last->clusters);
    input_print_cells(facts->mesh.dimension, last->cells);
    fprintf(stderr, "\n");
  }
  return last;
}

void coarsening_add(cJSON *object, const run_facts *facts)
{
  cJSON *list = cJSON_AddArrayToObject(object, "coarser");
  for (int n = 0; n < facts->coarsening_count; ++n) {
    const fg_coarsening *change = &facts->coarsening[n];
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

bool coarsening_raised_energy(const run_facts *facts)
{
  for (int n = 0; n < facts->coarsening_count; ++n)
    if (facts->coarsening[n].energy_after > facts->coarsening[n].energy_before)
      return true;
  return false;
}

void coarsening_restore(run_facts *facts, const cJSON *object)
{
  const cJSON *item, *cells;
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(object, "coarser"))
  {
    if (facts->coarsening_count == MOST_COARSENINGS)
      return;
    fg_coarsening *change = &facts->coarsening[facts->coarsening_count++];
    *change = (fg_coarsening){.step = (long)number_of(item, "step"),
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
