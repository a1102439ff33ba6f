/* The coarsenings of a run's mesh, for its report. */
#ifndef REPORT_COARSENING_H
#define REPORT_COARSENING_H

#include "run/run.h"

struct cJSON;

/* Records the evolution's last coarsening, and prints it with --verbose. */
const fg_coarsening *coarsening_record(cli_run *run);

/* "coarser" in run.json and in a checkpoint's note: each coarsening's step, time, energy
 * before and after, clusters, cells. */
void coarsening_add(struct cJSON *object, const run_facts *facts);
void coarsening_restore(run_facts *facts, const struct cJSON *object);

/* Whether the energy stepped up at any of them. */
bool coarsening_raised_energy(const run_facts *facts);

#endif
