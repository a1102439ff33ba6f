/* Samples where lines along the axes cross, as a field. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sample/points/points.h"

/* Of a step: longitudes that go round end within so much of where they began. */
static const double ROUND = 0.02;

void fg__point_grid_clear(fg__point_grid *grid)
{
  for (int k = 0; k < 3; ++k) {
    free(grid->axis[k]);
    free(grid->velocity[k]);
  }
  *grid = (fg__point_grid){0};
}

size_t fg__point_grid_samples(const fg__point_grid *grid)
{
  size_t samples = 1;
  for (int k = 0; k < grid->dimension && k < 3; ++k)
    samples *= (size_t)grid->size[k];
  return samples;
}

/* Turns the order of the samples along axis k round. */
static void reverse(fg__point_grid *grid, int k)
{
  size_t step = 1;
  for (int i = 0; i < k; ++i)
    step *= (size_t)grid->size[i];
  const size_t size = (size_t)grid->size[k], all = fg__point_grid_samples(grid);
  for (size_t i = 0; i < size / 2; ++i) {
    const double at = grid->axis[k][i];
    grid->axis[k][i] = grid->axis[k][size - 1 - i];
    grid->axis[k][size - 1 - i] = at;
  }
  for (int c = 0; c < grid->dimension && c < 3; ++c)
    for (size_t first = 0; first < all; first += step * size)
      for (size_t i = 0; i < size / 2; ++i)
        for (size_t n = 0; n < step; ++n) {
          float *a = grid->velocity[c] + first + i * step + n;
          float *b = grid->velocity[c] + first + (size - 1 - i) * step + n;
          const float value = *a;
          *a = *b;
          *b = value;
        }
}

/* The last column of a grid that goes round may be the first again. */
static void drop_last_column(fg__point_grid *grid)
{
  const size_t size = (size_t)grid->size[0];
  const size_t rows = fg__point_grid_samples(grid) / size;
  for (int c = 0; c < grid->dimension && c < 3; ++c)
    for (size_t row = 1; row < rows; ++row)
      memmove(grid->velocity[c] + row * (size - 1), grid->velocity[c] + row * size,
              (size - 1) * sizeof(float));
  --grid->size[0];
}

static void close_round(fg__point_grid *grid)
{
  const int last = grid->size[0] - 1;
  const double *x = grid->axis[0];
  if (last < 2)
    return;
  const double step = x[last] - x[last - 1], rest = 360.0 - (x[last] - x[0]);
  if (fabs(rest) <= ROUND * step) {
    drop_last_column(grid);
    grid->period = 360.0;
  } else if (rest > 0.0 && rest <= (1.0 + ROUND) * step) {
    grid->period = 360.0;
  }
}

fg_status fg__point_grid_straighten(fg__point_grid *grid, fg_context *context,
                                    const char *path, bool geographic)
{
  for (int k = 0; k < grid->dimension && k < 3; ++k) {
    const double *at = grid->axis[k];
    if (at[1] < at[0])
      reverse(grid, k);
    for (int i = 1; i < grid->size[k]; ++i)
      if (!(at[i] > at[i - 1]))
        return fg__fail(context, FG_STATUS_FILE_FORMAT,
                        "%s: coordinates along axis %d neither ascend nor descend: %g, "
                        "then %g",
                        path, k + 1, at[i - 1], at[i]);
  }
  if (geographic && grid->cells == 0)
    close_round(grid);
  return FG_STATUS_OK;
}

fg_status fg__point_grid_field(fg_field **out, fg_context *context, fg__point_grid *grid,
                               const fg_field_arrays *words, fg__slab_index slab)
{
  fg_field_arrays arrays = *words;
  const int last = grid->dimension - 1;
  const fg__rows rows = fg__rows_of(&slab, grid->size[last], false);
  const size_t row = fg__point_grid_samples(grid) / (size_t)grid->size[last];
  arrays.dimension = grid->dimension;
  arrays.period[0] = grid->period;
  for (int k = 0; k < grid->dimension && k < 3; ++k) {
    arrays.size[k] = grid->size[k];
    arrays.axis[k] = grid->axis[k];
    arrays.velocity[k] = grid->velocity[k];
    memmove(grid->velocity[k], grid->velocity[k] + (size_t)rows.first * row,
            (size_t)rows.held * row * sizeof(float));
  }
  return fg__field_of_rows(out, context, &arrays, grid->velocity, &slab);
}
