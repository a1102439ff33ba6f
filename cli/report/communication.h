/* The communication of a run's ranks, for --verbose and run.json. */
#ifndef REPORT_COMMUNICATION_H
#define REPORT_COMMUNICATION_H

#include "report/report.h"

struct cJSON;

/* Asks all ranks; collective. */
void communication_collect(run_facts *facts, const fg_evolution *evolution);

/* Prints a line a phase, when there are several ranks. */
void communication_print(const run_facts *facts);

/* The object "traffic" of run.json. */
void communication_add(struct cJSON *root, const run_facts *facts);

#endif
