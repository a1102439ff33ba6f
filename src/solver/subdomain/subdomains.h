/* Solves small isolated subdomains directly (subdomain.h), because multigrid does not
 * converge on them (docs/design/evolution.md). Every rank solves all of them alike. */
#ifndef FG__SUBDOMAINS_H
#define FG__SUBDOMAINS_H

#include <stdint.h>
#include <string.h>

#include "solver/subdomain/mass.h"
#include "solver/subdomain/subdomain.h"

/* Words of 32 bits that ranks exchange for a node: in the set-up its place in the grid,
 * in a step u, the guess of the new u, and p. */
enum { FG__SUBDOMAIN_WORDS = 3 };

typedef struct fg__subdomains {
  int count;   /* subdomains */
  int nodes;   /* of all */
  int entries; /* of a row */
  int *first;  /* [count + 1] a subdomain's first node */
  int *target; /* [nodes * entries] from the subdomain's first node; -1: none */
  double *laplacian, *energy; /* [nodes * entries] rows of L and K over the mass */
  double *mass;               /* [nodes] relative */
  int own_count;              /* nodes that this rank owns */
  int *own;                   /* [own_count] which they are */
  ptrdiff_t *at;    /* [own_count] where they lie in arrays of the finest level */
  uint32_t *word;   /* [FG__SUBDOMAIN_WORDS * nodes] floats as words, exchanged */
  float *u, *w;     /* [nodes] the solution */
  int small;        /* subdomains of up to so many nodes are solved in each long step; */
  int largest;      /* larger ones up to so many after a rejected step */
  double stiffness; /* greatest product of the diagonal entries of L and K */
  unsigned char *done; /* [nodes] solved in this step */
  double *space;       /* working memory of fg__subdomain_step */
} fg__subdomains;

/* Collects a domain's small subdomains. Collective. MEMORY. */
fg_status fg__subdomains_create(fg__subdomains *out, fg_context *context,
                                const fg__multigrid *multigrid,
                                const fg__mass_constraint *masses);
void fg__subdomains_clear(fg__subdomains *subdomains);

fg__subdomain fg__subdomain_of(const fg__subdomains *subdomains, int n);

/* A float as a word that fg__ranks_combine exchanges, and back. */
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

/* Solves the finest level's system, from its u and p, where the step is long enough. tau:
 * the step's length; effective: the tau in its formula (fg__subdomain_task); current: u
 * before the step; failed: an attempt was rejected lately, so that larger subdomains are
 * solved, too. Collective. */
void fg__subdomains_solve(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, double tau, double effective,
                          const float *current, bool failed);

/* Writes the solution to the finest level's u and w and to `copy`, an array like u,
 * without ghosts. */
void fg__subdomains_apply(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, float *copy);

/* Copies the nodes that are solved, between arrays like u. */
void fg__subdomains_copy(const fg__subdomains *subdomains, const float *from, float *to);

#endif
