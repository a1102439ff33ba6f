#include "rival/streamline/voids.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

fg_status fg__voids_create(fg__voids *out, fg_context *context, const fg__domain *domain)
{
  size_t cells = (size_t)fg__domain_cell_count(domain);
  *out = (fg__voids){.domain = domain};
  out->square = fg__allocate(cells, sizeof *out->square);
  out->nearest = fg__allocate(cells, sizeof *out->nearest);
  out->waiting = fg__allocate(cells, 1);
  out->queue = fg__allocate(cells, sizeof *out->queue);
  if (!out->square || !out->nearest || !out->waiting || !out->queue) {
    fg__voids_clear(out);
    return fg__fail_memory(context, "distances", cells * sizeof *out->nearest);
  }
  for (size_t i = 0; i < cells; i++)
    out->square[i] = HUGE_VAL;
  return FG_STATUS_OK;
}

void fg__voids_clear(fg__voids *voids)
{
  free(voids->square);
  free(voids->nearest);
  free(voids->waiting);
  free(voids->queue);
  fg__heap_clear(&voids->heap);
  *voids = (fg__voids){0};
}

/* Columns, rows and layers of a cell. */
static void find_place(const fg__domain *domain, int cell, int at[3])
{
  for (int k = 0; k < 3; k++) {
    at[k] = cell % domain->cells[k];
    cell /= domain->cells[k];
  }
}

/* The cell at a place, periods taken off, in place, too; -1 beyond the end of the box. */
static int find_cell(const fg__domain *domain, int at[3])
{
  for (int k = 0; k < 3; k++) {
    int cells = domain->cells[k];
    if (at[k] >= 0 && at[k] < cells)
      continue;
    if (!(domain->period[k] > 0))
      return -1;
    at[k] += at[k] < 0 ? cells : -cells;
  }
  return (at[2] * domain->cells[1] + at[1]) * domain->cells[0] + at[0];
}

/* Measures a cell to a point of the box, and puts it in the queue when that is the
 * nearest. */
static void consider(fg__voids *voids, int cell, const int at[3], const double point[3])
{
  const fg__domain *domain = voids->domain;
  double square = 0;
  for (int k = 0; k < 3 && k < domain->dimension; k++) {
    double period = domain->period[k];
    double way = fabs(domain->origin[k] + (at[k] + 0.5) * domain->spacing[k] - point[k]);
    if (period > 0 && way > period / 2)
      way = period - way;
    square += way * way;
  }
  if (!(square < voids->square[cell]))
    return;
  voids->square[cell] = square;
  memcpy(voids->nearest[cell], point, sizeof voids->nearest[cell]);
  if (voids->waiting[cell])
    return;
  int cells = fg__domain_cell_count(domain), free_place = voids->head + voids->waits++;
  voids->waiting[cell] = 1;
  voids->queue[free_place < cells ? free_place : free_place - cells] = cell;
}

void fg__voids_add(fg__voids *voids, const double point[])
{
  double wrapped[3] = {0};
  int at[3];
  for (int k = 0; k < voids->domain->dimension; k++)
    wrapped[k] = point[k];
  fg__domain_wrap(voids->domain, wrapped);
  int cell = fg__domain_cell(voids->domain, wrapped);
  if (cell < 0)
    return;
  find_place(voids->domain, cell, at);
  consider(voids, cell, at, wrapped);
}

void fg__voids_update(fg__voids *voids)
{
  const fg__domain *domain = voids->domain;
  int beside = domain->dimension == 2 ? 9 : 27, cells = fg__domain_cell_count(domain);
  while (voids->waits > 0) {
    int cell = voids->queue[voids->head], at[3];
    double point[3];
    voids->head = voids->head + 1 < cells ? voids->head + 1 : 0;
    voids->waits--;
    voids->waiting[cell] = 0;
    memcpy(point, voids->nearest[cell], sizeof point);
    find_place(domain, cell, at);
    for (int n = 0; n < beside; n++) {
      int next_at[3] = {at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1,
                        at[2] + (beside == 9 ? 0 : n / 9 - 1)};
      int next = find_cell(domain, next_at);
      if (next >= 0 && next != cell)
        consider(voids, next, next_at, point);
    }
  }
}

void fg__voids_add_boundary(fg__voids *voids)
{
  const fg__domain *domain = voids->domain;
  int cells = fg__domain_cell_count(domain);
  for (int i = 0; i < cells; i++)
    for (int side = 0; side < 2 * domain->dimension && domain->valid[i]; side++) {
      int at[3], beside[3], k = side / 2, step = side % 2 ? 1 : -1;
      find_place(domain, i, at);
      memcpy(beside, at, sizeof beside);
      beside[k] += step;
      int next = find_cell(domain, beside);
      if (next >= 0 && domain->valid[next])
        continue;
      double point[3] = {0};
      fg__domain_center(domain, i, point);
      point[k] += 0.5 * step * domain->spacing[k];
      consider(voids, i, at, point);
    }
}

static fg_status push(fg__voids *voids, fg_context *context, int cell)
{
  if (fg__heap_push(&voids->heap, -voids->square[cell], cell))
    return FG_STATUS_OK;
  return fg__fail_memory(context, "distances",
                         (voids->heap.count + 1) * sizeof *voids->heap.entry);
}

/* Distances only fall, so that a cell whose distance is still that by which it came out
 * on top is the farthest. */
fg_status fg__voids_take_farthest(fg__voids *voids, fg_context *context, int *cell)
{
  fg_status status = FG_STATUS_OK;
  int cells = fg__domain_cell_count(voids->domain);
  for (int i = 0; i < cells && !voids->is_heaped && status == FG_STATUS_OK; i++)
    if (fg__domain_cell_moves(voids->domain, i))
      status = push(voids, context, i);
  voids->is_heaped = true;
  *cell = -1;
  while (status == FG_STATUS_OK && voids->heap.count > 0) {
    fg__heap_entry top = fg__heap_pop(&voids->heap);
    if (-top.key <= voids->square[top.index]) {
      *cell = top.index;
      break;
    }
    status = push(voids, context, top.index);
  }
  return status;
}
