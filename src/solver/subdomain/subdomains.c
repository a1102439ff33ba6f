#include "solver/subdomain/subdomains.h"

#include <string.h>

#include "solver/passes.h"

/* A step's length times a node's L and K from which subdomains are solved: tau gamma /
 * h^4 times 4 to 7 in 2D. Cycles contract up to 1e3 of it and go round at 1e4; thresholds
 * of 400 to 2e4 took much the same number of cycles to rest (docs/design/evolution.md).
 */
static const double least_stiffness = 2e4;

void fg__subdomains_solve(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, double tau, double effective,
                          const float *current, bool failed)
{
  const fg__subdomains *s = subdomains;
  if (s->count == 0)
    return;
  memset(s->done, 0, (size_t)s->nodes);
  int largest = failed ? s->largest : s->small;
  if (largest == 0 || !(tau * s->stiffness >= least_stiffness))
    return;
  const float *const values[FG__SUBDOMAIN_WORDS] = {current, fg__multigrid_u(multigrid),
                                                    fg__multigrid_p(multigrid)};
  if (multigrid->ranks->count > 1)
    memset(s->word, 0, FG__SUBDOMAIN_WORDS * (size_t)s->nodes * sizeof *s->word);
  for (int n = 0; n < s->own_count; ++n)
    for (int k = 0; k < FG__SUBDOMAIN_WORDS; ++k)
      s->word[FG__SUBDOMAIN_WORDS * s->own[n] + k] = fg__bits_of(values[k][s->at[n]]);
  fg__ranks_combine(multigrid->ranks, s->word, FG__SUBDOMAIN_WORDS * s->nodes);
  double *before = s->space, *u = before + s->largest, *p = u + s->largest;
  double *w = p + s->largest, *space = w + s->largest;
  for (int k = 0; k < s->count; ++k) {
    fg__subdomain subdomain = fg__subdomain_of(s, k);
    int first = s->first[k], nodes = subdomain.nodes;
    if (nodes > largest)
      continue;
    memset(s->done + first, 1, (size_t)nodes);
    for (int n = 0; n < nodes; ++n) {
      const uint32_t *word = s->word + FG__SUBDOMAIN_WORDS * (first + n);
      before[n] = fg__float_of(word[0]);
      u[n] = fg__float_of(word[1]);
      p[n] = fg__float_of(word[2]);
    }
    fg__subdomain_task task = {tau, effective, p, before};
    fg__subdomain_step(&subdomain, &task, u, w, space);
    for (int n = 0; n < nodes; ++n) {
      s->u[first + n] = (float)u[n];
      s->w[first + n] = (float)w[n];
    }
  }
}

void fg__subdomains_apply(const fg__subdomains *subdomains,
                          const fg__multigrid *multigrid, float *copy)
{
  if (subdomains->count == 0 || !memchr(subdomains->done, 1, (size_t)subdomains->nodes))
    return;
  float *u = fg__multigrid_u(multigrid), *w = fg__multigrid_w(multigrid);
  for (int n = 0; n < subdomains->own_count; ++n) {
    ptrdiff_t at = subdomains->at[n];
    if (!subdomains->done[subdomains->own[n]])
      continue;
    u[at] = copy[at] = subdomains->u[subdomains->own[n]];
    w[at] = subdomains->w[subdomains->own[n]];
  }
  fg__pass_fill_ghosts(multigrid, u);
  fg__pass_fill_ghosts(multigrid, w);
}

void fg__subdomains_copy(const fg__subdomains *subdomains, const float *from, float *to)
{
  for (int n = 0; n < subdomains->own_count; ++n)
    if (subdomains->done[subdomains->own[n]])
      to[subdomains->at[n]] = from[subdomains->at[n]];
}
