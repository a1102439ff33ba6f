#include "run/evolving.h"

#include <math.h>
#include <string.h>

/* The interval between two densities is at least this many seconds, this fraction of the
 * evolution so far, and this multiple of the time that the last density took. */
static const double least_seconds = 0.02, share_of_evolution = 0.05, times_its_work = 10;

static int smaller(int a, int b)
{
  return a < b ? a : b;
}

/* A plane of a density; in 3D the middle one across z. */
typedef struct density_slice {
  const fg_density_arrays *density;
  const float *u;
  const unsigned char *active; /* NULL: all */
  int cells[2];
} density_slice;

static density_slice slice_of(const fg_density_arrays *density)
{
  int cells[3];
  for (int k = 0; k < 3; ++k)
    cells[k] = density->nodes[k] - (k < density->dimension && !density->periodic[k]);
  const size_t at = (size_t)(density->nodes[2] / 2);
  const size_t below = (size_t)smaller((int)at, cells[2] - 1);
  density_slice slice = {
      .density = density, .u = density->u, .cells = {cells[0], cells[1]}};
  slice.u += at * (size_t)density->nodes[0] * (size_t)density->nodes[1];
  if (density->active)
    slice.active = density->active + below * (size_t)cells[0] * (size_t)cells[1];
  return slice;
}

static bool is_active(const density_slice *slice, int x, int y)
{
  const int column = smaller(x, slice->cells[0] - 1),
            row = smaller(y, slice->cells[1] - 1);
  return !slice->active ||
         slice->active[(size_t)row * (size_t)slice->cells[0] + (size_t)column];
}

/* The mean of u over a square of nodes from (x, y), as a byte. */
static unsigned char tone(const density_slice *slice, int x, int y, int width)
{
  const int *nodes = slice->density->nodes;
  double sum = 0.0;
  int count = 0;
  for (int j = y; j < smaller(y + width, nodes[1]); ++j)
    for (int i = x; i < smaller(x + width, nodes[0]); ++i)
      if (is_active(slice, i, j)) {
        sum += (double)slice->u[(size_t)j * (size_t)nodes[0] + (size_t)i];
        ++count;
      }
  if (!count)
    return 0;
  const double mean = fmin(fmax(sum / count, -1.0), 1.0);
  return (unsigned char)(1 + lround(127.0 * (1.0 + mean)));
}

static void draw(progress_message *out, const fg_density_arrays *density)
{
  const density_slice slice = slice_of(density);
  const int *nodes = density->nodes;
  const int longest = nodes[0] > nodes[1] ? nodes[0] : nodes[1];
  const int width = (longest + PROGRESS_NODES - 1) / PROGRESS_NODES;
  memset(out, 0, offsetof(progress_message, u));
  for (int k = 0; k < 2; ++k)
    out->nodes[k] = (nodes[k] + width - 1) / width;
  unsigned char *pixel = out->u;
  for (int row = 0; row < out->nodes[1]; ++row)
    for (int column = 0; column < out->nodes[0]; ++column)
      *pixel++ = tone(&slice, column * width, row * width, width);
}

void evolving_show(cli_run *run)
{
  const double begin = clock_seconds();
  fg_density *density;
  if (!run->progress.socket || (begin < run->density_due && !fg_run_ended(run->scales)))
    return;
  run->density_due = (double)INFINITY; /* no more densities without memory */
  if (fg_density_create(&density, fg_run_evolution(run->scales))) {
    fg_context_clear(run->context);
    return;
  }
  progress_message message;
  draw(&message, fg_density_contents(density));
  fg_density_destroy(density);
  progress_density(&run->progress, &message);
  const double end = clock_seconds();
  run->density_due = end + fmax(fmax(least_seconds, times_its_work * (end - begin)),
                                share_of_evolution * (end - run->evolving_since));
}
