/* The parts of a domain that have only a few nodes (pocket.h): cycles may go round in
 * them for ever where an interface across a passage is held by the little bulk beside it,
 * and would hold up the whole (docs/design/evolution.md). Every rank knows all of them
 * and computes the same. */
#ifndef FG__POCKETS_H
#define FG__POCKETS_H

#include <stdint.h>
#include <string.h>

#include "solver/subdomain/means.h"
#include "solver/subdomain/pocket.h"

/* What ranks tell of a node: first its place, later u, the guess and p. */
enum { FG__POCKET_WORDS = 3 };

typedef struct fg__pockets {
  int count;   /* pockets */
  int nodes;   /* of all */
  int entries; /* of a row */
  int *first;  /* [count + 1] a pocket's first node */
  int *target; /* [nodes * entries] from the pocket's first node; -1: none */
  double *laplacian, *energy, *mass;
  int own_count;       /* nodes that this rank owns */
  int *own;            /* [own_count] which they are */
  ptrdiff_t *at;       /* [own_count] where they lie in arrays of the finest level */
  uint32_t *word;      /* [3 * nodes] u, guess and p as they travel */
  float *u, *w;        /* [nodes] the solution */
  int small;           /* pockets to so many nodes are solved in every step, */
  int largest;         /* larger ones to this where cycles have failed */
  double stiffness;    /* greatest of a node's own L times K */
  unsigned char *done; /* [nodes] solved in this step */
  double *space;       /* for one of them */
} fg__pockets;

/* Collects the pockets among a domain's parts. Collective. MEMORY. */
fg_status fg__pockets_create(fg__pockets *out, fg_context *context,
                             const fg__multigrid *multigrid, const fg__means *means);
void fg__pockets_clear(fg__pockets *pockets);

fg__pocket fg__pocket_of(const fg__pockets *pockets, int n);

/* Floats travel as words. */
static inline uint32_t fg__bits_of(float value)
{
  uint32_t word;
  memcpy(&word, &value, sizeof word);
  return word;
}

static inline double fg__float_of(uint32_t word)
{
  float value;
  memcpy(&value, &word, sizeof value);
  return (double)value;
}

/* Solves the finest level's system of a step of length tau, whose formula has another,
 * from what u and p hold, where the step is long enough for cycles to go round; larger
 * pockets only with `failed`. Collective. */
void fg__pockets_solve(const fg__pockets *pockets, const fg__multigrid *multigrid,
                       double tau, double effective, const float *current, bool failed);

/* Puts the solution into u, w and a copy of u, without ghosts. */
void fg__pockets_put(const fg__pockets *pockets, const fg__multigrid *multigrid,
                     float *copy);

#endif
