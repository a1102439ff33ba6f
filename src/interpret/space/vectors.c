/* Vector variables, and which variables in space may be vectors. */
#include <string.h>

#include "interpret/space/space.h"
#include "terms/vectors.h"

/* Before what is found by names: vectors that the file calls so, then other vectors. */
enum { RANK_MARKED = -2, RANK_VECTOR = -1 };

/* Whole numbers are no velocity unless the file says so, and x and y are positions. */
bool fg__may_be_in_space(const fg__variable *v)
{
  return v->location != FG__ON_GRID && fg__is_floating(v) && !v->no_velocity &&
         !v->element && !(v->name[0] && strchr("xyzXYZ", v->name[0]) && !v->name[1]);
}

fg__pair fg__pair_of_elements(const fg__variable *first)
{
  fg__pair pair = {.component = {first, first + 1}};
  if (first->components == 3)
    pair.component[2] = first + 2;
  return pair;
}

bool fg__pair_of_vector(fg__pair *out, const fg__variable *v)
{
  if (v->element != 1 || v->components > 3 || !fg__is_number(v) || v->no_velocity ||
      (!fg__is_floating(v) && !v->is_marked))
    return false;
  *out = fg__pair_of_elements(v);
  out->is_velocity = true;
  out->found_by = v->is_marked ? "Vectors attribute" : "vector variable";
  out->rank = v->is_marked ? RANK_MARKED : RANK_VECTOR;
  return true;
}

static bool are_named_alike(const fg__pair *a, const fg__pair *b)
{
  return strcmp(a->component[0]->name, b->component[0]->name) == 0 &&
         strcmp(a->component[1]->name, b->component[1]->name) == 0;
}

/* Whether another pair has the names of one at another place and is marked, or, where
 * neither is more than the other, at points. */
static bool is_repeated(const fg__pair *pair, const fg__pair *other)
{
  const fg__location here = pair->component[0]->location,
                     there = other->component[0]->location;
  return here != there && are_named_alike(pair, other) &&
         (other->rank < pair->rank ||
          (other->rank == pair->rank && there == FG__AT_POINTS));
}

void fg__drop_repeated(fg__pair *pairs, size_t *count)
{
  size_t kept = 0;
  for (size_t i = 0; i < *count; ++i) {
    bool repeated = false;
    for (size_t k = 0; k < *count && !repeated; ++k)
      repeated = is_repeated(&pairs[i], &pairs[k]);
    if (!repeated)
      pairs[kept++] = pairs[i];
  }
  *count = kept;
}
