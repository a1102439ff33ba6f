/* A run's mesh, halved whenever its clusters have grown enough. */
#ifndef COARSER_H
#define COARSER_H

#include "run.h"

struct cJSON;

/* Halves the mesh if the run's settings and the clusters are such. Collective. */
int coarser_when_ample(cli_run *run);

/* Halves a new run's mesh as often as a checkpoint's was. Collective. */
int coarser_as_before(cli_run *run, const fg_checkpoint *checkpoint);

/* "coarser" in run.json and in a checkpoint's note: each halving's step, time, energy
 * before and after, clusters, cells. */
void coarser_add(struct cJSON *object, const run_facts *facts);
void coarser_restore(run_facts *facts, const struct cJSON *object);

/* Whether the energy stepped up at any of them. */
bool coarser_raised_energy(const run_facts *facts);

#endif
