/* Solves small isolated subdomains directly (subdomain.h), because multigrid does not
 * converge on them (docs/design/evolution.md). Every rank solves all of them alike. */
#ifndef FG__SUBDOMAINS_H
#define FG__SUBDOMAINS_H

#include <stdint.h>
#include <string.h>

#include "solver/subdomain/mass.h"
#include "solver/subdomain/subdomain.h"

/* Words that ranks exchange of a node: first its place, later u, the guess and p. */
enum { FG__SUBDOMAIN_WORDS = 3 };

typedef struct fg__subdomains {
  int count;   /* subdomains */
  int nodes;   /* of all */
  int entries; /* of a row */
  int *first;  /* [count + 1] a subdomain's first node */
  int *target; /* [nodes * entries] from the subdomain's first node; -1: none */
  double *laplacian, *energy, *mass;
  int own_count;       /* nodes that this rank owns */
  int *own;            /* [own_count] which they are */
  ptrdiff_t *at;       /* [own_count] where they lie in arrays of the finest level */
  uint32_t *word;      /* [3 * nodes] u, guess and p as they travel */
  float *u, *w;        /* [nodes] the solution */
  int small;           /* those of up to so many nodes are solved in every step, */
  int largest;         /* larger ones to this where cycles have failed */
  double stiffness;    /* greatest of a node's own L times K */
  unsigned char *done; /* [nodes] solved in this step */
  double *space;       /* for one of them */
} fg__subdomains;

/* Collects a domain's small subdomains. Collective. MEMORY. */
fg_status fg__subdomains_create(fg__subdomains *out, fg_context *context,
                                const fg__multigrid *multigrid,
                                const fg__mass_constraint *masses);
void fg__subdomains_clear(fg__subdomains *subdomains);

fg__subdomain fg__subdomain_of(const fg__subdomains *subdomains, int n);

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
 * from u and p, where the step is long enough; larger subdomains only with `failed`,
 * after a rejected step. Collective. */
void fg__subdomains_solve(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, double tau, double effective,
                          const float *current, bool failed);

/* Puts the solution into u, w and a copy of u, without ghosts. */
void fg__subdomains_apply(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, float *copy);

#endif
