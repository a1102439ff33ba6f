#include "picture/map/missing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/field.h"
#include "field/mask.h"
#include "picture/polygons.h"

/* Nodes along the frame's longer side. */
enum { NODES = 400 };

/* Nodes: what lies so near to data everywhere is of the grid's making, as strips along
 * coasts are; a narrower one along the Earth's outline is half a step of the grid; what
 * is averaged for a smooth outline. */
enum { STRIP = 6, OUTER_STRIP = 3, SMOOTH = 2 };

/* Areas of less than this share of the frame are specks; of bays, whose bounds are coasts
 * but for this share, smaller ones are seen, too. */
static const double speck_share = 0.004, bay_speck_share = 1.5e-4, mouth_share = 0.35;

/* A field with values on more than this share of the land is there on land, too: ocean
 * models on coarse grids have them near coasts. */
static const double land_share = 0.3;

enum {
  INSIDE = 1,
  VALID = 2,
  LAND = 4,
  LAKE = 8,
  MISSING = 16,
  KEPT = 32,
  COASTAL = 64 /* as near to land that a field has no values on as a strip is wide */
};

typedef struct raster {
  int size[2];
  double low[2], spacing[2];
  unsigned char *node, *scratch;
  int *list; /* room for all nodes */
  float *level;
} raster;

static size_t at(const raster *r, int i, int j)
{
  return (size_t)j * (size_t)r->size[0] + (size_t)i;
}

static size_t nodes_of(const raster *r)
{
  return (size_t)r->size[0] * (size_t)r->size[1];
}

static bool create(raster *r, const fg__plane *plane)
{
  const double wide[2] = {plane->high[0] - plane->low[0], plane->high[1] - plane->low[1]};
  const double step = fmax(wide[0], wide[1]) / (NODES - 1);
  for (int k = 0; k < 2; ++k) {
    r->size[k] = (int)fmax(ceil(wide[k] / step), 1.0) + 1;
    r->low[k] = plane->low[k];
    r->spacing[k] = wide[k] / (r->size[k] - 1);
  }
  r->node = fg__allocate(nodes_of(r), 1);
  r->scratch = fg__allocate(nodes_of(r), 1);
  r->list = fg__allocate(nodes_of(r), sizeof *r->list);
  r->level = fg__allocate(nodes_of(r), sizeof *r->level);
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
static int row_near(const raster *r, double y, int beyond)
{
  const double row = (y - r->low[1]) / r->spacing[1] + beyond;
  return (int)fmin(fmax(row, 0.0), r->size[1] - 1.0);
}

static bool add_crossings(crossings *out, const raster *r, const double a[2],
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

/* Marks the nodes that lie in polygons, by the even-odd rule. */
static bool mark(raster *r, const fg__polygons *polygons, unsigned char what)
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
      r->node[at(r, i, all.list[n].row)] |= what;
  }
  free(all.list);
  return good;
}

/* The sample nearest to a coordinate, -1 where the field has none; a rounding error
 * beyond the axis is at its end. */
static int nearest_sample(const fg__axis *axis, double x)
{
  double share;
  const double first = axis->coordinate[0], last = axis->coordinate[axis->cells];
  const double slack = 1e-9 * (last - first);
  if (axis->period == 0.0 && x >= first - slack && x <= last + slack)
    x = fmin(fmax(x, first), last);
  const int cell = fg__axis_cell(axis, x, &share);
  return cell < 0 || share < 0.5 ? cell : (cell + 1) % axis->samples;
}

static void mark_valid(raster *r, const fg_field *field)
{
  for (int j = 0; j < r->size[1]; ++j) {
    const int y = nearest_sample(&field->axis[1], r->low[1] + j * r->spacing[1]);
    for (int i = 0; i < r->size[0] && y >= 0; ++i) {
      const int x = nearest_sample(&field->axis[0], r->low[0] + i * r->spacing[0]);
      if (x >= 0 && fg__field_sample_is_valid(field, x, y))
        r->node[at(r, i, j)] |= VALID;
    }
  }
}

/* Marks what is missing. Returns whether land counts. */
static bool mark_missing(raster *r)
{
  size_t land = 0, both = 0;
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->node[n] & INSIDE && r->node[n] & LAND) {
      ++land;
      both += r->node[n] & VALID ? 1 : 0;
    }
  const bool on_land = land == 0 || (double)both > land_share * (double)land;
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->node[n] & INSIDE && !(r->node[n] & VALID) && (on_land || !(r->node[n] & LAND)))
      r->node[n] |= MISSING;
  return on_land;
}

/* scratch becomes 1 wherever it was within `reach` nodes along axis k. */
static void dilate_along(raster *r, int k, int reach)
{
  const int lines = r->size[1 - k], count = r->size[k];
  const size_t step = k == 0 ? 1 : (size_t)r->size[0];
  for (int line = 0; line < lines; ++line) {
    unsigned char *first = r->scratch + (k == 0 ? at(r, 0, line) : at(r, line, 0));
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

static void dilate(raster *r, int reach)
{
  dilate_along(r, 0, reach);
  dilate_along(r, 1, reach);
}

/* The eight nodes round one, those beside it first. Returns how many there are. */
static int nodes_round(size_t out[8], const raster *r, size_t n)
{
  static const int ways[][2] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  const int i = (int)(n % (size_t)r->size[0]), j = (int)(n / (size_t)r->size[0]);
  int count = 0;
  for (int k = 0; k < 8; ++k) {
    const int x = i + ways[k][0], y = j + ways[k][1];
    if (x >= 0 && y >= 0 && x < r->size[0] && y < r->size[1])
      out[count++] = at(r, x, y);
  }
  return count;
}

/* From the nodes whose scratch is 1 through missing ones without the mark `barrier`:
 * scratch becomes the number of steps plus 1, and stays 0 beyond `reach` steps; reach 0:
 * it becomes 1 at any distance. */
static void spread(raster *r, int reach, unsigned char barrier)
{
  size_t count = 0, round[8];
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->scratch[n])
      r->list[count++] = (int)n;
  for (size_t done = 0; done < count; ++done) {
    const int steps = r->scratch[r->list[done]];
    const bool ends = reach && steps > reach;
    const int near = ends ? 0 : nodes_round(round, r, (size_t)r->list[done]);
    for (int k = 0; k < near; ++k)
      if ((r->node[round[k]] & (MISSING | barrier)) == MISSING && !r->scratch[round[k]]) {
        r->scratch[round[k]] = (unsigned char)(reach ? steps + 1 : 1);
        r->list[count++] = (int)round[k];
      }
  }
}

static bool at_outline(const raster *r, size_t n)
{
  size_t round[8];
  const int count = nodes_round(round, r, n);
  for (int k = 0; k < count; ++k)
    if (!(r->node[round[k]] & INSIDE))
      return true;
  return false;
}

static void mark_coastal(raster *r)
{
  for (size_t n = 0; n < nodes_of(r); ++n)
    r->scratch[n] = r->node[n] & LAND ? 1 : 0;
  dilate(r, STRIP);
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->scratch[n])
      r->node[n] |= COASTAL;
}

/* Keeps what is missing farther than a strip from data, by a way over what is missing, so
 * that a bay counts however near data lie beyond its shore; what is as near to that, or
 * to the Earth's outline, beyond which nothing is; and what is connected with it away
 * from coasts, as a wedge between data and the frame. */
static void keep_wide(raster *r)
{
  for (size_t n = 0; n < nodes_of(r); ++n)
    r->scratch[n] = r->node[n] & VALID ? 1 : 0;
  spread(r, STRIP, 0);
  for (size_t n = 0; n < nodes_of(r); ++n)
    r->scratch[n] = r->node[n] & MISSING &&
                    (!r->scratch[n] || (r->scratch[n] > OUTER_STRIP && at_outline(r, n)));
  spread(r, STRIP, 0);
  for (size_t n = 0; n < nodes_of(r); ++n)
    r->scratch[n] = r->scratch[n] ? 1 : 0;
  spread(r, 0, COASTAL);
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->scratch[n])
      r->node[n] |= KEPT;
}

/* Clears a connected area of KEPT nodes when it is small. inside: nodes of the frame. */
static void drop_speck(raster *r, size_t from, double inside)
{
  size_t count = 1, round[8], bounds = 0, mouths = 0;
  r->list[0] = (int)from;
  r->scratch[from] = 1;
  for (size_t done = 0; done < count; ++done) {
    const int near = nodes_round(round, r, (size_t)r->list[done]);
    for (int k = 0; k < near; ++k) {
      const size_t n = round[k];
      bounds += !(r->node[n] & KEPT);
      mouths += !(r->node[n] & KEPT) && !(r->node[n] & LAND);
      if (!(r->node[n] & KEPT) || r->scratch[n])
        continue;
      r->scratch[n] = 1;
      r->list[count++] = (int)n;
    }
  }
  const bool bay = (double)mouths <= mouth_share * (double)bounds;
  const double least = (bay ? bay_speck_share : speck_share) * inside;
  for (size_t done = 0; done < count && (double)count <= least; ++done)
    r->node[r->list[done]] &= (unsigned char)~KEPT;
}

static void drop_specks(raster *r)
{
  size_t inside = 0;
  for (size_t n = 0; n < nodes_of(r); ++n)
    inside += r->node[n] & INSIDE;
  memset(r->scratch, 0, nodes_of(r));
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->node[n] & KEPT && !r->scratch[n])
      drop_speck(r, n, (double)inside);
}

/* Averages, of which the outline is the line of one half. What lies at the Earth's
 * outline goes on beyond it, and what lies at a coast goes on under land that is drawn
 * above it (over_land), so that narrow bays stay. False: nothing is kept. */
static bool smooth(raster *r, bool over_land)
{
  const unsigned char exact = INSIDE | (over_land ? LAND : 0);
  bool any = false;
  for (size_t n = 0; n < nodes_of(r); ++n)
    any = (r->scratch[n] = r->node[n] & KEPT ? 1 : 0) || any;
  if (!any)
    return false;
  dilate(r, 2 * SMOOTH + 1);
  for (size_t n = 0; n < nodes_of(r); ++n)
    if ((r->node[n] & exact) == INSIDE)
      r->scratch[n] = (r->node[n] & KEPT) != 0;
  for (int j = 0; j < r->size[1]; ++j)
    for (int i = 0; i < r->size[0]; ++i) {
      int sum = 0;
      for (int dj = -SMOOTH; dj <= SMOOTH; ++dj)
        for (int di = -SMOOTH; di <= SMOOTH; ++di) {
          const int x = i + di, y = j + dj;
          sum += r->scratch[at(r,
                               x < 0            ? 0
                               : x < r->size[0] ? x
                                                : r->size[0] - 1,
                               y < 0            ? 0
                               : y < r->size[1] ? y
                                                : r->size[1] - 1)];
        }
      const int all = (2 * SMOOTH + 1) * (2 * SMOOTH + 1);
      r->level[at(r, i, j)] = (float)sum / (float)all - 0.5F;
    }
  return true;
}

static bool valid_near(const raster *r, double x, double y, bool over_land)
{
  const int i = (int)floor((x - r->low[0]) / r->spacing[0] + 0.5);
  const int j = (int)floor((y - r->low[1]) / r->spacing[1] + 0.5);
  if (over_land && i >= 0 && j >= 0 && i < r->size[0] && j < r->size[1] &&
      r->node[at(r, i, j)] & LAND)
    return false;
  for (int dj = -SMOOTH; dj <= SMOOTH; ++dj)
    for (int di = -SMOOTH; di <= SMOOTH; ++di)
      if (i + di >= 0 && j + dj >= 0 && i + di < r->size[0] && j + dj < r->size[1] &&
          r->node[at(r, i + di, j + dj)] & VALID)
        return true;
  return false;
}

static bool on_frame(const raster *r, const double a[2], const double b[2])
{
  for (int k = 0; k < 2; ++k) {
    const double slack = 0.01 * r->spacing[k];
    const double high = r->low[k] + r->spacing[k] * (r->size[k] - 1);
    if ((fabs(a[k] - r->low[k]) < slack && fabs(b[k] - r->low[k]) < slack) ||
        (fabs(a[k] - high) < slack && fabs(b[k] - high) < slack))
      return true;
  }
  return false;
}

static bool add_rim(fg__missing *out, const raster *r)
{
  bool good = true;
  for (size_t k = 0; k < out->area.count && good; ++k) {
    const size_t first = out->area.start[k], end = out->area.start[k + 1];
    bool going = false;
    for (size_t n = first; n < end && good; ++n) {
      const double *a = out->area.point[n];
      const double *b = out->area.point[n + 1 < end ? n + 1 : first];
      const bool wanted =
          !on_frame(r, a, b) &&
          valid_near(r, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), !out->on_land);
      if (wanted && !going)
        good = fg__polygons_begin(&out->rim) && fg__polygons_add(&out->rim, a);
      if (wanted && good)
        good = fg__polygons_add(&out->rim, b);
      going = wanted;
    }
  }
  return good;
}

static fg_status contour(fg__missing *out, fg_context *context, const raster *r)
{
  const fg_density_arrays level = {.dimension = 2,
                                   .nodes = {r->size[0], r->size[1], 1},
                                   .origin = {r->low[0], r->low[1], 0.0},
                                   .spacing = {r->spacing[0], r->spacing[1], 1.0},
                                   .u = r->level};
  fg_status status = fg__contour_positive(&out->area, context, &level);
  if (!status && !add_rim(out, r))
    status = fg__fail_memory(context, "the rim of the data", nodes_of(r));
  return status;
}

/* Whether lakes are shown and the field has values on hardly any of them. */
static bool lakes_are_missing(const raster *r)
{
  size_t lakes = 0, both = 0;
  for (size_t n = 0; n < nodes_of(r); ++n)
    if (r->node[n] & INSIDE && r->node[n] & LAKE) {
      ++lakes;
      both += r->node[n] & VALID ? 1 : 0;
    }
  return (double)both <= land_share * (double)lakes;
}

fg_status fg__missing_find(fg__missing *out, fg_context *context, const fg__plane *plane,
                           const fg_field *field, const fg__polygons *land,
                           const fg__polygons *lakes)
{
  raster r = {.node = NULL};
  fg_status status = FG_STATUS_OK;
  *out = (fg__missing){.area = {.point = NULL}};
  bool good = create(&r, plane);
  if (good && !plane->whole)
    memset(r.node, INSIDE, nodes_of(&r));
  good = good && (!plane->whole || mark(&r, &plane->outline, INSIDE)) &&
         mark(&r, land, LAND) && mark(&r, lakes, LAKE);
  if (good) {
    mark_valid(&r, field);
    out->on_land = mark_missing(&r);
    out->lakes = !out->on_land && lakes_are_missing(&r);
    if (!out->on_land)
      mark_coastal(&r);
    keep_wide(&r);
    drop_specks(&r);
  }
  if (!good)
    status = fg__fail_memory(context, "where a field is missing", nodes_of(&r));
  else if (smooth(&r, !out->on_land))
    status = contour(out, context, &r);
  free(r.node);
  free(r.scratch);
  free(r.list);
  free(r.level);
  if (status)
    fg__missing_clear(out);
  return status;
}

void fg__missing_clear(fg__missing *missing)
{
  fg__polygons_clear(&missing->area);
  fg__polygons_clear(&missing->rim);
}
