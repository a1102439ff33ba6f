#include "evolution/checkpoint/runs.h"

fg__runs fg__runs_of(const fg__box *record, const fg__box *box)
{
  fg__runs runs = {.part = fg__box_intersection(record, box)};
  const int *nodes = runs.part.nodes;
  if (fg__box_is_empty(&runs.part))
    return runs;
  bool whole[2];
  for (int k = 0; k < 2; ++k)
    whole[k] = nodes[k] == record->nodes[k] && nodes[k] == box->nodes[k];
  runs.length = (size_t)nodes[0];
  runs.rows = nodes[1];
  runs.planes = nodes[2];
  if (whole[0]) {
    runs.length *= (size_t)nodes[1];
    runs.rows = 1;
  }
  if (whole[0] && whole[1]) {
    runs.length *= (size_t)nodes[2];
    runs.planes = 1;
  }
  return runs;
}

uint64_t fg__run_at(const fg__runs *runs, const fg__box *of, int row, int plane)
{
  uint64_t at[3];
  for (int k = 0; k < 3; ++k)
    at[k] = (uint64_t)(runs->part.first[k] - of->first[k]);
  at[1] += (uint64_t)row;
  at[2] += (uint64_t)plane;
  return (at[2] * (uint64_t)of->nodes[1] + at[1]) * (uint64_t)of->nodes[0] + at[0];
}
