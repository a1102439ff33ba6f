#include "picture/render/bands.h"

#include <stdlib.h>

#include "base/memory.h"

fg__band_rows fg__rows_between(double low, double high, int height)
{
  if (!(high >= 0.0) || !(low < height))
    return (fg__band_rows){0, -1};
  return (fg__band_rows){(int)fg__most(low, 0.0), (int)fg__least(high, height - 1.0)};
}

/* Counts the threads of each band into first[b + 1]. */
static void count_members(fg__bands *out, const fg__band_rows *rows, size_t triangles)
{
  for (size_t n = 0; n < triangles; ++n)
    if (rows[n].first <= rows[n].last)
      for (int b = rows[n].first / FG__BAND; b <= rows[n].last / FG__BAND; ++b)
        ++out->first[b + 1];
  for (int b = 0; b < out->count; ++b)
    out->first[b + 1] += out->first[b];
}

/* Writes the threads; first[b] ends as first[b + 1] was, and is moved back. */
static void write_members(fg__bands *out, const fg__band_rows *rows, size_t triangles)
{
  for (size_t n = 0; n < triangles; ++n)
    if (rows[n].first <= rows[n].last)
      for (int b = rows[n].first / FG__BAND; b <= rows[n].last / FG__BAND; ++b)
        out->member[out->first[b]++] = (int)n;
  for (int b = out->count; b > 0; --b)
    out->first[b] = out->first[b - 1];
  out->first[0] = 0;
}

fg_status fg__bands_make(fg__bands *out, fg_context *context, const fg__band_rows *rows,
                         size_t triangles, int height)
{
  *out = (fg__bands){.count = (height + FG__BAND - 1) / FG__BAND};
  out->first = fg__allocate((size_t)out->count + 1, sizeof *out->first);
  if (!out->first)
    return fg__fail_memory(context, "bands of a picture", (size_t)out->count);
  count_members(out, rows, triangles);
  size_t members = out->first[out->count];
  out->member = fg__allocate(members, sizeof *out->member);
  if (!out->member)
    return fg__fail_memory(context, "bands of a picture", members * sizeof *out->member);
  write_members(out, rows, triangles);
  return FG_STATUS_OK;
}

void fg__bands_clear(fg__bands *bands)
{
  free(bands->first);
  free(bands->member);
  *bands = (fg__bands){.first = NULL};
}
