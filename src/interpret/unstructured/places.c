/* Points in a plane or in space: coordinates that the options name, or x, y(, z) by their
 * names, along the vectors' dimension or in arrays like theirs. */
#include "interpret/unstructured/unstructured.h"
#include "terms/coordinates.h"

#include <stdio.h>
#include <string.h>

enum { SPACE = 3 };

/* px and py may be a momentum. */
static bool is_component(const fg__mesh_search *search, const fg__variable *v)
{
  const fg__pair *pair = search->pair;
  return pair &&
         (v == pair->component[0] || v == pair->component[1] || v == pair->component[2]);
}

static const fg__variable *find_named(const fg__mesh_search *search, fg__column_use use,
                                      int rank)
{
  const fg__variable *best = NULL;
  int fits = 0;
  for (size_t i = 0; i < search->data->variable_count; ++i) {
    const fg__variable *v = &search->data->variables[i];
    if (is_component(search, v) || !fg__search_lies(search, v, rank))
      continue;
    const int here = fg__column_fits(v->plain_name, use);
    if (here > fits) {
      best = v;
      fits = here;
    }
  }
  return best;
}

/* x and y, perhaps with z; else x and z, or y and z, of a plane across the third. */
static bool find_by_names(fg__unstructured *out, const fg__mesh_search *search, int rank)
{
  const fg__variable *at[SPACE], *here[SPACE] = {NULL};
  int count = 0;
  for (int k = 0; k < SPACE; ++k) {
    at[k] = find_named(search, (fg__column_use)(FG__COLUMN_X + k), rank);
    if (at[k])
      here[count++] = at[k];
  }
  if (count < 2)
    return false;
  memcpy(out->node, here, sizeof here);
  return true;
}

static bool are_named(fg__unstructured *out, const fg__mesh_search *search, int rank)
{
  const fg__pair *pair = search->pair;
  if (!pair || !pair->position[0])
    return false;
  for (int k = 0; k < SPACE; ++k) {
    if (pair->position[k] && !fg__search_lies(search, pair->position[k], rank))
      return false;
    out->node[k] = pair->position[k];
  }
  return true;
}

bool fg__find_places(fg__unstructured *out, fg__mesh_search *search)
{
  const fg__variable *u = search->u;
  const int most = search->k + 1 < SPACE ? search->k + 1 : SPACE;
  for (int rank = 1; rank <= most; ++rank) {
    const bool one = rank == 1;
    if (!one && (search->k + 1 != u->rank ||
                 !search->data->dimensions[u->dimension[search->k]].is_nameless))
      return false;
    if (!are_named(out, search, rank) && !find_by_names(out, search, rank))
      continue;
    out->rank = rank;
    for (int k = 0; k + 1 < rank; ++k)
      out->before[k] = u->dimension[search->k - rank + 1 + k];
    out->in_plane =
        out->node[0]->geographic != FG__ROLE_X || out->node[1]->geographic != FG__ROLE_Y;
    snprintf(out->rule, sizeof out->rule, "%s, on points at '%.40s', '%.40s'%s%.40s%s",
             out->in_plane ? "along x and y" : "east and north", out->node[0]->plain_name,
             out->node[1]->plain_name, out->node[2] ? ", '" : "",
             out->node[2] ? out->node[2]->plain_name : "", out->node[2] ? "'" : "");
    return true;
  }
  return false;
}
