/* States of a search to come back to. */
#include "place/search/search.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

void fg__place_snapshot_clear(fg__place_snapshot *snapshot)
{
  free(snapshot->icon);
  *snapshot = (fg__place_snapshot){0};
}

fg_status fg__place_remember(fg__place_snapshot *out, fg__place_search *search)
{
  free(out->icon);
  out->count = search->count;
  out->ink = search->scale.ink;
  out->shortest = search->scale.shortest;
  out->icon = fg__allocate((size_t)search->count, sizeof *out->icon);
  if (!out->icon)
    return fg__fail_memory(search->context, "a copy of the icons",
                           (size_t)search->count * sizeof *out->icon);
  for (int n = 0; n < search->count; ++n) {
    out->icon[n].seed = search->icon[n]->seed;
    out->icon[n].step = search->icon[n]->step;
    out->icon[n].identity = search->icon[n]->identity;
    out->icon[n].removal_cost = search->icon[n]->removal_cost;
    out->icon[n].has_removal_cost = search->icon[n]->has_removal_cost;
  }
  return FG_STATUS_OK;
}

/* Moves icon n to a place before it. */
static void move_to(fg__place_search *search, int n, int place)
{
  fg__place_icon *icon = search->icon[n];
  const fg__place_box box = search->box[n];
  const size_t between = (size_t)(n - place);
  memmove(&search->icon[place + 1], &search->icon[place],
          between * sizeof(fg__place_icon *));
  memmove(&search->box[place + 1], &search->box[place], between * sizeof box);
  search->icon[place] = icon;
  search->box[place] = box;
}

fg_status fg__place_restore(fg__place_search *search, const fg__place_snapshot *from)
{
  fg_status status = FG_STATUS_OK;
  search->scale.ink = from->ink;
  search->scale.shortest = from->shortest;
  /* those that stayed where they were keep their place, the rest are made again */
  for (int n = search->count - 1; n >= 0 && status == FG_STATUS_OK; --n) {
    fg__place_icon *icon = search->icon[n];
    bool same = false;
    for (int k = 0; k < from->count && !same; ++k)
      same = from->icon[k].identity == icon->identity &&
             memcmp(&from->icon[k].seed, &icon->seed, sizeof icon->seed) == 0;
    if (!same)
      status = fg__place_remove(search, n);
  }
  int kept = 0;
  for (int k = 0; k < from->count && status == FG_STATUS_OK; ++k) {
    int n = kept;
    while (n < search->count && search->icon[n]->identity != from->icon[k].identity)
      ++n;
    bool added = true;
    if (n >= search->count)
      status = fg__place_add(search, &added, &from->icon[k].seed, from->icon[k].identity);
    if (status != FG_STATUS_OK || !added)
      continue;
    move_to(search, n, kept);
    search->icon[kept++]->step = from->icon[k].step;
  }
  for (int k = 0, n = 0; k < from->count && n < kept && status == FG_STATUS_OK; ++k) {
    if (search->icon[n]->identity != from->icon[k].identity)
      continue;
    search->icon[n]->removal_cost = from->icon[k].removal_cost;
    search->icon[n++]->has_removal_cost = from->icon[k].has_removal_cost;
  }
  return status;
}
