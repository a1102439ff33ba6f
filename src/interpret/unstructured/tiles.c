/* Grids of tiles, as the six faces of a cubed sphere: longitude and latitude in arrays
 * [tiles][rows][columns], whose points are one set on the sphere. */
#include "interpret/unstructured/unstructured.h"
#include "terms/frame.h"

#include <stdio.h>

/* Where a variable has a dimension; -1: nowhere. */
static int place_of(const fg__variable *v, int dimension)
{
  int k = v->rank - 1;
  while (k >= 0 && v->dimension[k] != dimension)
    --k;
  return k;
}

/* Whether positions lie along three of the vector's dimensions, in its order, of which
 * the first is neither time nor level, and the last is that which is looked at. */
static bool lie_on_tiles(const fg__mesh_search *search, const fg__variable *v)
{
  const fg__variable *u = search->u;
  if (v->rank != 3 || !fg__is_array(v))
    return false;
  const int at[] = {place_of(u, v->dimension[0]), place_of(u, v->dimension[1]),
                    place_of(u, v->dimension[2])};
  return at[0] >= 0 && at[0] < at[1] && at[1] < at[2] && at[2] == search->k &&
         search->data->dimensions[v->dimension[0]].length > 1 &&
         fg__claimed_role(search->data, u, at[0]) == FG__NO_ROLE;
}

/* Whether the first two tiles are at different places; members of an ensemble are not. */
static bool are_apart(const fg__mesh_search *search, const fg__variable *const at[2])
{
  double here[2][2];
  size_t index[3] = {0, 0, 0};
  for (int k = 1; k < 3; ++k)
    index[k] = search->data->dimensions[at[0]->dimension[k]].length / 2;
  for (int tile = 0; tile < 2; ++tile)
    for (int k = 0; k < 2; ++k) {
      index[0] = (size_t)tile;
      if (fg__variable_fetch_one(at[k], index, &here[tile][k]))
        return false;
    }
  return here[0][0] != here[1][0] || here[0][1] != here[1][1];
}

bool fg__find_tiles(fg__unstructured *out, fg__mesh_search *search)
{
  const fg__dataset *data = search->data;
  char names[FG__TEXT_BYTES];
  const fg__variable *at[2] = {NULL, NULL};
  fg__attribute_text(search->u, "coordinates", names, sizeof names);
  for (int named = 1; named >= 0; --named)
    for (size_t n = 0; n < data->variable_count; ++n) {
      const fg__variable *v = &data->variables[n];
      const fg__role role = v->geographic;
      if (role != FG__NO_ROLE && !at[role] && lie_on_tiles(search, v) &&
          (!named || fg__is_listed(names, v->plain_name)))
        at[role] = v;
    }
  if (!at[0] || !at[1] || !are_apart(search, at))
    return false;
  out->is_tiled = true;
  out->rank = 3;
  for (int k = 0; k < 2; ++k) {
    out->before[k] = at[0]->dimension[k];
    out->node[k] = at[k];
    if (at[1]->dimension[k] != at[0]->dimension[k])
      return false;
  }
  snprintf(out->rule, sizeof out->rule,
           "east and north, on points of %zu tiles ('%.40s') at '%.40s', '%.40s'",
           data->dimensions[out->before[0]].length, data->dimensions[out->before[0]].name,
           at[0]->plain_name, at[1]->plain_name);
  return true;
}

void fg__check_tiles(fg__grid *grid, const fg__pair *pair, fg_frame wanted)
{
  char why[2 * FG__TEXT_BYTES];
  const fg__term u = fg__term_of(pair->component[0]), v = fg__term_of(pair->component[1]);
  const fg__frame_evidence evidence = {.staggered = false};
  const int frame = wanted == FG_FRAME_EAST || pair->polar.sense != 0
                        ? 1
                        : fg__frame_of_terms(why, sizeof why, &u, &v, &evidence);
  if (frame > 0)
    return;
  fg__set_unusable(grid->unusable,
                   frame < 0 ? "'%.60s' and '%.60s' are along the grids of their tiles, "
                               "whose directions are not known"
                             : "nothing says whether '%.60s' and '%.60s' point east and "
                               "north or along the grids of their tiles",
                   pair->component[0]->plain_name, pair->component[1]->plain_name);
  snprintf(grid->hint, sizeof grid->hint,
           "--frame east says that they point east and "
           "north");
}
