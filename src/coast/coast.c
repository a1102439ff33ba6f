#include "coast/coast.h"

#include <stdlib.h>

#include "base/memory.h"

static const double grain = 0.002;

/* Bytes that are still to be read. */
typedef struct bytes {
  const unsigned char *at, *end;
} bytes;

static size_t next_number(bytes *b)
{
  size_t value = 0;
  for (int shift = 0; b->at < b->end; shift += 7) {
    const unsigned char byte = *b->at++;
    value |= (size_t)(byte & 127u) << shift;
    if (byte < 128)
      break;
  }
  return value;
}

static double next_difference(bytes *b)
{
  const size_t code = next_number(b);
  const double size = (double)((code + 1) / 2);
  return code & 1 ? -size : size;
}

/* Lines and points of a layer; reads past it. */
static void count_layer(size_t *lines, size_t *points, bytes *b)
{
  *lines = next_number(b);
  *points = 0;
  for (size_t line = 0; line < *lines; ++line) {
    const size_t count = next_number(b);
    *points += count;
    for (size_t n = 0; n < 2 * count; ++n)
      next_number(b);
  }
}

static void read_layer(fg__coast_lines *out, bytes *b)
{
  size_t points = 0;
  out->count = next_number(b);
  for (size_t line = 0; line < out->count; ++line) {
    double at[2] = {0.0, 0.0};
    out->start[line] = points;
    for (size_t left = next_number(b); left > 0; --left, ++points)
      for (int k = 0; k < 2; ++k) {
        at[k] += next_difference(b);
        out->point[points][k] = grain * at[k];
      }
  }
  out->start[out->count] = points;
}

static bytes bytes_of(fg__coast_detail detail)
{
  switch (detail) {
  case FG__COAST_110M:
    return (bytes){fg__coast_110m, fg__coast_110m + fg__coast_110m_size};
  case FG__COAST_50M:
    return (bytes){fg__coast_50m, fg__coast_50m + fg__coast_50m_size};
  case FG__COAST_10M:
    break;
  }
  return (bytes){fg__coast_10m, fg__coast_10m + fg__coast_10m_size};
}

fg_status fg__coast_read(fg__coast_lines *out, fg_context *context, fg__coast_layer layer,
                         fg__coast_detail detail)
{
  bytes b = bytes_of(detail);
  size_t lines, points;
  for (int k = FG__COAST_LAND; k < (int)layer; ++k)
    count_layer(&lines, &points, &b);
  bytes ahead = b;
  count_layer(&lines, &points, &ahead);
  *out = (fg__coast_lines){.start = fg__allocate(lines + 1, sizeof *out->start),
                           .point = fg__allocate(points, sizeof *out->point)};
  if (!out->start || !out->point) {
    fg__coast_clear(out);
    return fg__fail_memory(context, "coast lines", points * sizeof *out->point);
  }
  read_layer(out, &b);
  return FG_STATUS_OK;
}

void fg__coast_clear(fg__coast_lines *lines)
{
  free(lines->point);
  free(lines->start);
  *lines = (fg__coast_lines){0};
}
