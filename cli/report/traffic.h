/* What the ranks of a run told each other, for --verbose and run.json. */
#ifndef REPORT_TRAFFIC_H
#define REPORT_TRAFFIC_H

#include "report/report.h"

struct cJSON;

/* Asks all ranks; collective. */
void traffic_collect(run_facts *facts, const fg_evolution *evolution);

/* Prints a line an activity, when there are several ranks. */
void traffic_print(const run_facts *facts);

/* The object "traffic" of run.json. */
void traffic_add(struct cJSON *root, const run_facts *facts);

#endif
