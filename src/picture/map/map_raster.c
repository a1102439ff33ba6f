#include "picture/map/map_raster.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

size_t fg__map_raster_at(const fg__map_raster *r, int i, int j)
{
  return (size_t)j * (size_t)r->size[0] + (size_t)i;
}

size_t fg__map_raster_nodes(const fg__map_raster *r)
{
  return (size_t)r->size[0] * (size_t)r->size[1];
}

bool fg__map_raster_create(fg__map_raster *r, const fg__plane *plane)
{
  const double wide[2] = {plane->high[0] - plane->low[0], plane->high[1] - plane->low[1]};
  const double step = fmax(wide[0], wide[1]) / (FG__MAP_RASTER_NODES - 1);
  for (int k = 0; k < 2; ++k) {
    r->size[k] = (int)fmax(ceil(wide[k] / step), 1.0) + 1;
    r->low[k] = plane->low[k];
    r->spacing[k] = wide[k] / (r->size[k] - 1);
  }
  r->node = fg__allocate(fg__map_raster_nodes(r), 1);
  r->scratch = fg__allocate(fg__map_raster_nodes(r), 1);
  r->list = fg__allocate(fg__map_raster_nodes(r), sizeof *r->list);
  r->level = fg__allocate(fg__map_raster_nodes(r), sizeof *r->level);
  return r->node && r->scratch && r->list && r->level;
}

/* Where polygons cross rows, from west to east row by row. */
typedef struct crossing {
  int row;
  double x;
} crossing;

typedef struct crossings {
  crossing *list;
  size_t count, capacity;
} crossings;

static int compare_crossings(const void *a, const void *b)
{
  const crossing *one = a, *other = b;
  if (one->row != other->row)
    return one->row < other->row ? -1 : 1;
  return (one->x > other->x) - (one->x < other->x);
}

/* The first or last row that an edge which ends at y may cross. */
static int row_near(const fg__map_raster *r, double y, int beyond)
{
  const double row = (y - r->low[1]) / r->spacing[1] + beyond;
  return (int)fmin(fmax(row, 0.0), r->size[1] - 1.0);
}

static bool add_crossings(crossings *out, const fg__map_raster *r, const double a[2],
                          const double b[2])
{
  const int last = row_near(r, fmax(a[1], b[1]), 1);
  for (int j = row_near(r, fmin(a[1], b[1]), -1); j <= last; ++j) {
    const double y = r->low[1] + j * r->spacing[1] + 1e-7 * r->spacing[1];
    if ((a[1] > y) == (b[1] > y))
      continue;
    void *grown = out->list;
    if (!fg__grow(&grown, &out->capacity, out->count + 1, sizeof *out->list))
      return false;
    out->list = grown;
    out->list[out->count++] =
        (crossing){j, a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])};
  }
  return true;
}

bool fg__map_raster_mark(fg__map_raster *r, const fg__polygons *polygons,
                         unsigned char what)
{
  crossings all = {.list = NULL};
  bool good = true;
  for (size_t k = 0; k < polygons->count; ++k) {
    const size_t first = polygons->start[k], end = polygons->start[k + 1];
    for (size_t n = first; n < end && good; ++n)
      good = add_crossings(&all, r, polygons->point[n],
                           polygons->point[n + 1 < end ? n + 1 : first]);
  }
  if (all.count)
    qsort(all.list, all.count, sizeof *all.list, compare_crossings);
  for (size_t n = 0; good && n + 1 < all.count; n += 2) { /* a row has an even number */
    const double from = ceil((all.list[n].x - r->low[0]) / r->spacing[0]);
    const double to = floor((all.list[n + 1].x - r->low[0]) / r->spacing[0]);
    for (int i = (int)fmax(from, 0.0); i <= fmin(to, r->size[0] - 1.0); ++i)
      r->node[fg__map_raster_at(r, i, all.list[n].row)] |= what;
  }
  free(all.list);
  return good;
}

int fg__map_raster_round(size_t out[8], const fg__map_raster *r, size_t n)
{
  static const int ways[][2] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  const int i = (int)(n % (size_t)r->size[0]), j = (int)(n / (size_t)r->size[0]);
  int count = 0;
  for (int k = 0; k < 8; ++k) {
    const int x = i + ways[k][0], y = j + ways[k][1];
    if (x >= 0 && y >= 0 && x < r->size[0] && y < r->size[1])
      out[count++] = fg__map_raster_at(r, x, y);
  }
  return count;
}

/* scratch becomes 1 wherever it was within `reach` nodes along axis k. */
static void dilate_along(fg__map_raster *r, int k, int reach)
{
  const int lines = r->size[1 - k], count = r->size[k];
  const size_t step = k == 0 ? 1 : (size_t)r->size[0];
  for (int line = 0; line < lines; ++line) {
    unsigned char *first = r->scratch + (k == 0 ? fg__map_raster_at(r, 0, line)
                                                : fg__map_raster_at(r, line, 0));
    int last = -2 * count;
    for (int n = 0; n < count; ++n) { /* 2: reached from behind, was 0 */
      unsigned char *here = first + (size_t)n * step;
      if (*here == 1)
        last = n;
      else if (n - last <= reach)
        *here = 2;
    }
    last = 3 * count;
    for (int n = count - 1; n >= 0; --n) {
      unsigned char *here = first + (size_t)n * step;
      if (*here == 1)
        last = n;
      else if (last - n <= reach)
        *here = 2;
    }
    for (int n = 0; n < count; ++n)
      if (first[(size_t)n * step])
        first[(size_t)n * step] = 1;
  }
}

void fg__map_raster_dilate(fg__map_raster *r, int reach)
{
  dilate_along(r, 0, reach);
  dilate_along(r, 1, reach);
}

void fg__map_raster_clear(fg__map_raster *r)
{
  free(r->node);
  free(r->scratch);
  free(r->list);
  free(r->level);
}
