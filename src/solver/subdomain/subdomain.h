/* Solves a step on a small isolated subdomain directly, in double. */
#ifndef FG__SUBDOMAIN_H
#define FG__SUBDOMAIN_H

#include <stdbool.h>

/* The rows of L and K over the node's mass. */
typedef struct fg__subdomain {
  int nodes, entries;               /* entries of a row: a node and its neighbours */
  const int *target;                /* [nodes * entries] -1: none */
  const double *laplacian, *energy; /* [nodes * entries] */
  const double *mass;               /* [nodes] */
} fg__subdomain;

/* Doubles of working space that a step of it takes. */
int fg__subdomain_space(const fg__subdomain *subdomain);

/* The system of a step: u + effective L w = p, w = Psi'(u) + K u. */
typedef struct fg__subdomain_task {
  double tau;       /* the step's length */
  double effective; /* that of its formula */
  const double *p;
  const double *before; /* u, when the step begins */
} fg__subdomain_task;

/* Solves it from a guess in u. Where Newton's method fails, or the energy of the
 * subdomain would rise, it takes as many shorter steps of implicit Euler as it needs. */
void fg__subdomain_step(const fg__subdomain *subdomain, const fg__subdomain_task *task,
                        double *u, double *w, double *space);

#endif
