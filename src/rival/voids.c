#include "rival/voids.h"

#include "base/memory.h"
#include "solid/vector.h"

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
  *voids = (fg__voids){0};
}

/* Measures a cell to a point, and puts it in the queue when that is the nearest. */
static void consider(fg__voids *voids, int cell, const double point[3])
{
  const fg__domain *domain = voids->domain;
  double way[3] = {0};
  fg__domain_center(domain, cell, way);
  for (int k = 0; k < domain->dimension; k++)
    way[k] -= point[k];
  fg__domain_shortest(domain, way);
  double square = fg__dot(way, way);
  if (!(square < voids->square[cell]))
    return;
  voids->square[cell] = square;
  memcpy(voids->nearest[cell], point, sizeof voids->nearest[cell]);
  if (voids->waiting[cell])
    return;
  voids->waiting[cell] = 1;
  voids->queue[(voids->head + voids->waits++) % fg__domain_cell_count(domain)] = cell;
}

void fg__voids_add(fg__voids *voids, const double point[])
{
  double wrapped[3] = {0};
  for (int k = 0; k < voids->domain->dimension; k++)
    wrapped[k] = point[k];
  fg__domain_wrap(voids->domain, wrapped);
  int cell = fg__domain_cell(voids->domain, wrapped);
  if (cell >= 0)
    consider(voids, cell, wrapped);
}

/* The cell so many steps from another; -1 beyond the end of the box. */
static int cell_beside(const fg__domain *domain, int cell, const int step[3])
{
  int index = 0, stride = 1;
  for (int k = 0; k < domain->dimension; k++) {
    int cells = domain->cells[k], at = cell % cells + step[k];
    cell /= cells;
    if (domain->period[k] > 0)
      at = (at + cells) % cells;
    if (at < 0 || at >= cells)
      return -1;
    index += at * stride;
    stride *= cells;
  }
  return index;
}

void fg__voids_update(fg__voids *voids)
{
  const fg__domain *domain = voids->domain;
  int beside = domain->dimension == 2 ? 9 : 27, cells = fg__domain_cell_count(domain);
  while (voids->waits > 0) {
    int cell = voids->queue[voids->head];
    double point[3];
    voids->head = (voids->head + 1) % cells;
    voids->waits--;
    voids->waiting[cell] = 0;
    memcpy(point, voids->nearest[cell], sizeof point);
    for (int n = 0; n < beside; n++) {
      const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, beside == 9 ? 0 : n / 9 - 1};
      int next = cell_beside(domain, cell, step);
      if (next >= 0 && next != cell)
        consider(voids, next, point);
    }
  }
}

void fg__voids_add_boundary(fg__voids *voids)
{
  const fg__domain *domain = voids->domain;
  int cells = fg__domain_cell_count(domain);
  for (int i = 0; i < cells; i++)
    for (int side = 0; side < 2 * domain->dimension && domain->valid[i]; side++) {
      int step[3] = {0};
      step[side / 2] = side % 2 ? 1 : -1;
      int next = cell_beside(domain, i, step);
      if (next >= 0 && domain->valid[next])
        continue;
      double point[3] = {0};
      fg__domain_center(domain, i, point);
      point[side / 2] += 0.5 * step[side / 2] * domain->spacing[side / 2];
      consider(voids, i, point);
    }
}

int fg__voids_farthest(const fg__voids *voids, const unsigned char *left_out)
{
  int found = -1, cells = fg__domain_cell_count(voids->domain);
  for (int i = 0; i < cells; i++)
    if (!left_out[i] && (found < 0 || voids->square[i] > voids->square[found]) &&
        fg__domain_cell_moves(voids->domain, i))
      found = i;
  return found;
}
