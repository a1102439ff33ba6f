#include "sample/gap_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sample/gaps.h"

size_t fg__axis_gaps(const double *axis, size_t size)
{
  bool *gap;
  size_t count;
  fg__gaps_along(&gap, &count, axis, size);
  free(gap);
  return count;
}

/* Copies lines of `bytes` bytes, `lines` of them, and fills those after gaps; of several
 * runs of lines one after the other. */
static void *spread(const void *samples, const bool *gap, size_t lines, size_t gaps,
                    size_t bytes, size_t runs, const void *filling, size_t filling_bytes)
{
  unsigned char *out = fg__allocate((lines + gaps) * runs, bytes), *to = out;
  const unsigned char *from = samples;
  for (size_t n = 0; n < lines * runs && out; ++n, from += bytes) {
    memcpy(to, from, bytes);
    to += bytes;
    if (n % lines + 1 == lines || !gap[n % lines])
      continue;
    for (size_t b = 0; b < bytes; b += filling_bytes)
      memcpy(to + b, filling, filling_bytes);
    to += bytes;
  }
  return out;
}

static bool replace(void **samples, const bool *gap, size_t lines, size_t gaps,
                    size_t line, size_t runs, const void *filling, size_t filling_bytes)
{
  void *out = spread(*samples, gap, lines, gaps, line * filling_bytes, runs, filling,
                     filling_bytes);
  if (!out)
    return false;
  free(*samples);
  *samples = out;
  return true;
}

static bool insert_along(fg_field_arrays *arrays, int k, const bool *gap, size_t gaps,
                         float *velocity[3], unsigned char **valid, double **axis)
{
  static const float missing = NAN;
  static const unsigned char hidden = 0;
  const size_t lines = (size_t)arrays->size[k];
  size_t line = 1, runs = 1;
  for (int m = 0; m < arrays->dimension; ++m)
    *(m < k ? &line : &runs) *= m == k ? 1 : (size_t)arrays->size[m];
  double *own = fg__allocate(lines + gaps, sizeof *own);
  for (size_t i = 0, n = 0; i < lines && own; ++i) {
    own[n++] = arrays->axis[k][i];
    if (i + 1 < lines && gap[i])
      own[n++] = 0.5 * (arrays->axis[k][i] + arrays->axis[k][i + 1]);
  }
  bool done = own != NULL;
  for (int m = 0; m < arrays->dimension && done; ++m) {
    void *samples = velocity[m];
    done = replace(&samples, gap, lines, gaps, line, runs, &missing, sizeof missing);
    arrays->velocity[m] = velocity[m] = samples;
  }
  if (*valid && done) {
    void *samples = *valid;
    done = replace(&samples, gap, lines, gaps, line, runs, &hidden, sizeof hidden);
    arrays->valid = *valid = samples;
  }
  *axis = own;
  if (own)
    arrays->axis[k] = own;
  arrays->size[k] = (int)(lines + gaps);
  return done;
}

fg_status fg__gap_lines_insert(fg_field_arrays *arrays, float *velocity[3],
                               unsigned char **valid, double *axis[3],
                               fg_context *context)
{
  bool done = true;
  for (int k = 0; k < arrays->dimension && done; ++k) {
    bool *gap;
    size_t gaps;
    done = fg__gaps_along(&gap, &gaps, arrays->axis[k], (size_t)arrays->size[k]);
    if (gaps > 0)
      done = insert_along(arrays, k, gap, gaps, velocity, valid, &axis[k]);
    free(gap);
  }
  return done ? FG_STATUS_OK : fg__fail_memory(context, "lines in gaps", 0);
}
