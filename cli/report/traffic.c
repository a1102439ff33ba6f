#include "report/traffic.h"

#include <cjson/cJSON.h>
#include <stdio.h>

#include "ranks.h"

static const char *const names[FG_ACTIVITIES] = {"other", "setup",    "step",
                                                 "cycle", "counting", "snapshot"};

/* A number of fg_traffic by its place, so that all are treated alike. */
typedef struct entry {
  const char *name;
  size_t place;
} entry;

static const entry numbers[] = {
    {"exchanges", offsetof(fg_traffic, exchanges)},
    {"messages", offsetof(fg_traffic, messages)},
    {"bytes", offsetof(fg_traffic, bytes)},
    {"gathers", offsetof(fg_traffic, gathers)},
    {"gathered_bytes", offsetof(fg_traffic, gathered)},
    {"reductions", offsetof(fg_traffic, reductions)},
    {"reduced_bytes", offsetof(fg_traffic, reduced)},
};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

/* Per time of the activity; what no activity counts is told as a whole. */
static double value_of(const fg_traffic *traffic, const entry *number)
{
  const char *at = (const char *)traffic + number->place;
  double total = *(const double *)(const void *)at;
  return traffic->times > 0.0 ? total / traffic->times : total;
}

void traffic_collect(run_facts *facts, const fg_evolution *evolution)
{
  facts->ranks = ranks_count();
  fg_evolution_traffic(evolution, facts->traffic, facts->most_traffic);
}

static void print_activity(const char *name, const fg_traffic *mean,
                           const fg_traffic *most)
{
  fprintf(stderr, "flowgrain: %s (%.0f):", name, mean->times);
  for (int n = 0; n < NUMBERS; ++n)
    if (value_of(most, &numbers[n]) > 0.0)
      fprintf(stderr, " %s %.1f (%.1f)", numbers[n].name, value_of(mean, &numbers[n]),
              value_of(most, &numbers[n]));
  fputc('\n', stderr);
}

void traffic_print(const run_facts *facts)
{
  if (facts->ranks == 1)
    return;
  fprintf(stderr, "flowgrain: what each of %d ranks told the others, mean (most):\n",
          facts->ranks);
  for (int a = 1; a < FG_ACTIVITIES; ++a)
    print_activity(names[a], &facts->traffic[a], &facts->most_traffic[a]);
}

void traffic_add(cJSON *root, const run_facts *facts)
{
  cJSON *traffic = cJSON_AddObjectToObject(root, "traffic");
  cJSON_AddNumberToObject(traffic, "ranks", facts->ranks);
  for (int a = 0; a < FG_ACTIVITIES; ++a) {
    const fg_traffic *mean = &facts->traffic[a], *most = &facts->most_traffic[a];
    cJSON *activity = cJSON_AddObjectToObject(traffic, names[a]);
    cJSON_AddNumberToObject(activity, "times", mean->times);
    for (int n = 0; n < NUMBERS; ++n) {
      cJSON *pair = cJSON_AddObjectToObject(activity, numbers[n].name);
      cJSON_AddNumberToObject(pair, "mean", value_of(mean, &numbers[n]));
      cJSON_AddNumberToObject(pair, "most", value_of(most, &numbers[n]));
    }
  }
}
