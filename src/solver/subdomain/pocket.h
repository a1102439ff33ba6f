/* One step of a part of the domain that has only a few nodes, solved as it stands: a
 * system in double instead of cycles. */
#ifndef FG__POCKET_H
#define FG__POCKET_H

#include <stdbool.h>

/* The rows of L and K over the node's mass. */
typedef struct fg__pocket {
  int nodes, entries;               /* entries of a row: a node and its neighbours */
  const int *target;                /* [nodes * entries] -1: none */
  const double *laplacian, *energy; /* [nodes * entries] */
  const double *mass;               /* [nodes] */
} fg__pocket;

/* Doubles of working space that a step of it takes. */
int fg__pocket_space(const fg__pocket *pocket);

/* The system of a step: u + effective L w = p, w = Psi'(u) + K u. */
typedef struct fg__pocket_task {
  double tau;       /* the step's length */
  double effective; /* that of its formula */
  const double *p;
  const double *before; /* u, when the step begins */
} fg__pocket_task;

/* Solves it from a guess in u. Where Newton's method fails, or the energy of the pocket
 * would rise, it takes as many shorter steps of implicit Euler as it needs. */
void fg__pocket_step(const fg__pocket *pocket, const fg__pocket_task *task, double *u,
                     double *w, double *space);

#endif
