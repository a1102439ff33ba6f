#include "report/communication.h"

#include <cjson/cJSON.h>
#include <stdio.h>

#include "ranks.h"

static const char *const names[FG_PHASES] = {"other", "setup",    "step",
                                             "cycle", "counting", "snapshot"};

/* A number of fg_communication by its offset, for a loop over all. */
typedef struct entry {
  const char *name;
  size_t place;
} entry;

static const entry numbers[] = {
    {"exchanges", offsetof(fg_communication, exchanges)},
    {"messages", offsetof(fg_communication, messages)},
    {"bytes", offsetof(fg_communication, bytes)},
    {"gathers", offsetof(fg_communication, gathers)},
    {"gathered_bytes", offsetof(fg_communication, gathered)},
    {"reductions", offsetof(fg_communication, reductions)},
    {"reduced_bytes", offsetof(fg_communication, reduced)},
};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

/* Counts of a phase per repetition; counts outside of phases are totals. */
static double value_of(const fg_communication *communication, const entry *number)
{
  const char *at = (const char *)communication + number->place;
  double total = *(const double *)(const void *)at;
  return communication->times > 0.0 ? total / communication->times : total;
}

void communication_collect(run_facts *facts, const fg_evolution *evolution)
{
  facts->ranks = ranks_count();
  fg_evolution_communication(evolution, facts->communication, facts->most_communication);
}

static void print_phase(const char *name, const fg_communication *mean,
                        const fg_communication *most)
{
  fprintf(stderr, "flowgrain: %s (%.0f):", name, mean->times);
  for (int n = 0; n < NUMBERS; ++n)
    if (value_of(most, &numbers[n]) > 0.0)
      fprintf(stderr, " %s %.1f (%.1f)", numbers[n].name, value_of(mean, &numbers[n]),
              value_of(most, &numbers[n]));
  fputc('\n', stderr);
}

void communication_print(const run_facts *facts)
{
  if (facts->ranks == 1)
    return;
  fprintf(stderr, "flowgrain: communication of each of %d ranks, mean (greatest):\n",
          facts->ranks);
  for (int a = 1; a < FG_PHASES; ++a)
    print_phase(names[a], &facts->communication[a], &facts->most_communication[a]);
}

void communication_add(cJSON *root, const run_facts *facts)
{
  cJSON *communication = cJSON_AddObjectToObject(root, "traffic");
  cJSON_AddNumberToObject(communication, "ranks", facts->ranks);
  for (int a = 0; a < FG_PHASES; ++a) {
    const fg_communication *mean = &facts->communication[a],
                           *most = &facts->most_communication[a];
    cJSON *phase = cJSON_AddObjectToObject(communication, names[a]);
    cJSON_AddNumberToObject(phase, "times", mean->times);
    for (int n = 0; n < NUMBERS; ++n) {
      cJSON *pair = cJSON_AddObjectToObject(phase, numbers[n].name);
      cJSON_AddNumberToObject(pair, "mean", value_of(mean, &numbers[n]));
      cJSON_AddNumberToObject(pair, "most", value_of(most, &numbers[n]));
    }
  }
}
