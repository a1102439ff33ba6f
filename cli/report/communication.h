/* Communication between a run's ranks, for --verbose and run.json. */
#ifndef REPORT_COMMUNICATION_H
#define REPORT_COMMUNICATION_H

#include "report/report.h"

struct cJSON;

/* Collects the counters of all ranks. Collective. */
void communication_collect(run_facts *facts, const fg_evolution *evolution);

/* Prints one line for each phase, if there are several ranks. */
void communication_print(const run_facts *facts);

/* Adds the object "traffic" to run.json. */
void communication_add(struct cJSON *root, const run_facts *facts);

#endif
