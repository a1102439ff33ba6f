/* Coarsenings of a run's mesh in its report. */
#ifndef REPORT_COARSENING_H
#define REPORT_COARSENING_H

#include "run/run.h"

struct cJSON;

/* Adds the evolution's last coarsening to the run's record; prints it with --verbose. */
const fg_coarsening *coarsening_record(cli_run *run);

/* Adds "coarser" to run.json or to a checkpoint's note: step, time, energy before and
 * after, clusters and cells of each coarsening. */
void coarsening_add(struct cJSON *object, const run_facts *facts);
void coarsening_restore(run_facts *facts, const struct cJSON *object);

/* Whether any of them increased the energy. */
bool coarsening_raised_energy(const run_facts *facts);

#endif
