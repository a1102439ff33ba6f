#include "picture/map/missing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/field.h"
#include "field/mask.h"
#include "picture/map/map_raster.h"
#include "picture/polygons.h"

/* Nodes: what lies so near to data everywhere is of the grid's making, as strips along
 * coasts are; a narrower one along the Earth's outline is half a step of the grid; what
 * is averaged for a smooth outline. */
enum { STRIP = 6, OUTER_STRIP = 3, SMOOTH = 2 };

/* Areas of less than this share of the frame are left out; of bays, whose bounds are
 * coasts but for this share, smaller ones are seen, too. */
static const double small_share = 0.004, small_bay_share = 1.5e-4, mouth_share = 0.35;

/* A field with values on more than this share of the land is there on land, too: of the
 * half of the land that is farthest from the sea, as coarse grids of the sea have values
 * near coasts. */
static const double land_share = 0.3, inland_share = 0.5;

enum {
  INSIDE = 1,
  VALID = 2,
  LAND = 4,
  LAKE = 8,
  MISSING = 16,
  KEPT = 32,
  COASTAL = 64 /* as near to land that a field has no values on as a strip is wide */
};

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

static void mark_valid(fg__map_raster *r, const fg_field *field)
{
  for (int j = 0; j < r->size[1]; ++j) {
    const int y = nearest_sample(&field->axis[1], r->low[1] + j * r->spacing[1]);
    for (int i = 0; i < r->size[0] && y >= 0; ++i) {
      const int x = nearest_sample(&field->axis[0], r->low[0] + i * r->spacing[0]);
      if (x >= 0 && fg__field_sample_is_valid(field, x, y))
        r->node[fg__map_raster_at(r, i, j)] |= VALID;
    }
  }
}

static bool is_land(const fg__map_raster *r, size_t n)
{
  return (r->node[n] & (INSIDE | LAND)) == (INSIDE | LAND);
}

/* Of each node of land the steps to the sea in level, where there is a sea; of others 0.
 */
static void find_inland(fg__map_raster *r)
{
  size_t count = 0, round[8];
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n) {
    r->level[n] = is_land(r, n) ? -1.0F : 0.0F;
    if (!is_land(r, n) && r->node[n] & INSIDE)
      r->list[count++] = (int)n;
  }
  for (size_t done = 0; done < count; ++done) {
    const int near = fg__map_raster_round(round, r, (size_t)r->list[done]);
    for (int k = 0; k < near; ++k)
      if (r->level[round[k]] < 0.0F) {
        r->level[round[k]] = r->level[r->list[done]] + 1.0F;
        r->list[count++] = (int)round[k];
      }
  }
}

/* Whether a field is there on land, too, or no land is shown. */
static bool is_on_land(fg__map_raster *r)
{
  /* land by the steps to the sea, all that has none at 0; of it what has values */
  size_t land[FG__MAP_RASTER_NODES + 1] = {0}, there[FG__MAP_RASTER_NODES + 1] = {0},
                                     all = 0;
  find_inland(r);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (is_land(r, n)) {
      const int steps = (int)fmaxf(r->level[n], 0.0F);
      ++land[steps];
      there[steps] += r->node[n] & VALID ? 1 : 0;
      ++all;
    }
  size_t inland = 0, both = 0;
  for (int k = FG__MAP_RASTER_NODES; k >= 0; --k)
    if ((double)inland < inland_share * (double)all) {
      inland += land[k];
      both += there[k];
    }
  return all == 0 || (double)both > land_share * (double)inland;
}

/* Marks what is missing; on_land: land counts. */
static void mark_missing(fg__map_raster *r, bool on_land)
{
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (r->node[n] & INSIDE && !(r->node[n] & VALID) && (on_land || !(r->node[n] & LAND)))
      r->node[n] |= MISSING;
}

/* From the nodes whose scratch is 1 through missing ones without the mark `barrier`:
 * scratch becomes the number of steps plus 1, and stays 0 beyond `reach` steps; reach 0:
 * it becomes 1 at any distance. */
static void flood(fg__map_raster *r, int reach, unsigned char barrier)
{
  size_t count = 0, round[8];
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (r->scratch[n])
      r->list[count++] = (int)n;
  for (size_t done = 0; done < count; ++done) {
    const int steps = r->scratch[r->list[done]];
    const bool ends = reach && steps > reach;
    const int near = ends ? 0 : fg__map_raster_round(round, r, (size_t)r->list[done]);
    for (int k = 0; k < near; ++k)
      if ((r->node[round[k]] & (MISSING | barrier)) == MISSING && !r->scratch[round[k]]) {
        r->scratch[round[k]] = (unsigned char)(reach ? steps + 1 : 1);
        r->list[count++] = (int)round[k];
      }
  }
}

static bool at_outline(const fg__map_raster *r, size_t n)
{
  size_t round[8];
  const int count = fg__map_raster_round(round, r, n);
  for (int k = 0; k < count; ++k)
    if (!(r->node[round[k]] & INSIDE))
      return true;
  return false;
}

static void mark_coastal(fg__map_raster *r)
{
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    r->scratch[n] = r->node[n] & LAND ? 1 : 0;
  fg__map_raster_dilate(r, STRIP);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (r->scratch[n])
      r->node[n] |= COASTAL;
}

/* Keeps what is missing farther than a strip from data, by a way over what is missing, so
 * that a bay counts however near data lie beyond its shore; what is as near to that, or
 * to the Earth's outline, beyond which nothing is; and what is connected with it away
 * from coasts, as a wedge between data and the frame. */
static void keep_wide(fg__map_raster *r)
{
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    r->scratch[n] = r->node[n] & VALID ? 1 : 0;
  flood(r, STRIP, 0);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    r->scratch[n] = r->node[n] & MISSING &&
                    (!r->scratch[n] || (r->scratch[n] > OUTER_STRIP && at_outline(r, n)));
  flood(r, STRIP, 0);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    r->scratch[n] = r->scratch[n] ? 1 : 0;
  flood(r, 0, COASTAL);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (r->scratch[n])
      r->node[n] |= KEPT;
}

/* Clears a connected area of KEPT nodes when it is small. inside: nodes of the frame. */
static void drop_small(fg__map_raster *r, size_t from, double inside)
{
  size_t count = 1, round[8], bounds = 0, mouths = 0;
  r->list[0] = (int)from;
  r->scratch[from] = 1;
  for (size_t done = 0; done < count; ++done) {
    const int near = fg__map_raster_round(round, r, (size_t)r->list[done]);
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
  const double least = (bay ? small_bay_share : small_share) * inside;
  for (size_t done = 0; done < count && (double)count <= least; ++done)
    r->node[r->list[done]] &= (unsigned char)~KEPT;
}

static void drop_small_areas(fg__map_raster *r)
{
  size_t inside = 0;
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    inside += r->node[n] & INSIDE;
  memset(r->scratch, 0, fg__map_raster_nodes(r));
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if (r->node[n] & KEPT && !r->scratch[n])
      drop_small(r, n, (double)inside);
}

/* Averages, of which the outline is the line of one half. What lies at the Earth's
 * outline goes on beyond it, and what lies at a coast goes on under land that is drawn
 * above it (over_land), so that narrow bays stay. False: nothing is kept. */
static bool smooth(fg__map_raster *r, bool over_land)
{
  const unsigned char exact = INSIDE | (over_land ? LAND : 0);
  bool any = false;
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    any = (r->scratch[n] = r->node[n] & KEPT ? 1 : 0) || any;
  if (!any)
    return false;
  fg__map_raster_dilate(r, 2 * SMOOTH + 1);
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
    if ((r->node[n] & exact) == INSIDE)
      r->scratch[n] = (r->node[n] & KEPT) != 0;
  for (int j = 0; j < r->size[1]; ++j)
    for (int i = 0; i < r->size[0]; ++i) {
      int sum = 0;
      for (int dj = -SMOOTH; dj <= SMOOTH; ++dj)
        for (int di = -SMOOTH; di <= SMOOTH; ++di) {
          const int x = i + di, y = j + dj;
          sum += r->scratch[fg__map_raster_at(r,
                                              x < 0            ? 0
                                              : x < r->size[0] ? x
                                                               : r->size[0] - 1,
                                              y < 0            ? 0
                                              : y < r->size[1] ? y
                                                               : r->size[1] - 1)];
        }
      const int all = (2 * SMOOTH + 1) * (2 * SMOOTH + 1);
      r->level[fg__map_raster_at(r, i, j)] = (float)sum / (float)all - 0.5F;
    }
  return true;
}

static bool valid_near(const fg__map_raster *r, double x, double y, bool over_land)
{
  const int i = (int)floor((x - r->low[0]) / r->spacing[0] + 0.5);
  const int j = (int)floor((y - r->low[1]) / r->spacing[1] + 0.5);
  if (over_land && i >= 0 && j >= 0 && i < r->size[0] && j < r->size[1] &&
      r->node[fg__map_raster_at(r, i, j)] & LAND)
    return false;
  for (int dj = -SMOOTH; dj <= SMOOTH; ++dj)
    for (int di = -SMOOTH; di <= SMOOTH; ++di)
      if (i + di >= 0 && j + dj >= 0 && i + di < r->size[0] && j + dj < r->size[1] &&
          r->node[fg__map_raster_at(r, i + di, j + dj)] & VALID)
        return true;
  return false;
}

static bool on_frame(const fg__map_raster *r, const double a[2], const double b[2])
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

static bool add_rim(fg__missing *out, const fg__map_raster *r)
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

static fg_status contour(fg__missing *out, fg_context *context, const fg__map_raster *r)
{
  const fg_density_arrays level = {.dimension = 2,
                                   .nodes = {r->size[0], r->size[1], 1},
                                   .origin = {r->low[0], r->low[1], 0.0},
                                   .spacing = {r->spacing[0], r->spacing[1], 1.0},
                                   .u = r->level};
  fg_status status = fg__contour_positive(&out->area, context, &level);
  if (!status && !add_rim(out, r))
    status = fg__fail_memory(context, "the rim of the data", fg__map_raster_nodes(r));
  return status;
}

/* Whether lakes are shown and the field has values on hardly any of them. */
static bool lakes_are_missing(const fg__map_raster *r)
{
  size_t lakes = 0, both = 0;
  for (size_t n = 0; n < fg__map_raster_nodes(r); ++n)
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
  fg__map_raster r = {.node = NULL};
  fg_status status = FG_STATUS_OK;
  *out = (fg__missing){.area = {.point = NULL}};
  bool good = fg__map_raster_create(&r, plane);
  if (good && !plane->whole)
    memset(r.node, INSIDE, fg__map_raster_nodes(&r));
  good = good && (!plane->whole || fg__map_raster_mark(&r, &plane->outline, INSIDE)) &&
         fg__map_raster_mark(&r, land, LAND) && fg__map_raster_mark(&r, lakes, LAKE);
  if (good) {
    mark_valid(&r, field);
    out->on_land = is_on_land(&r);
    mark_missing(&r, out->on_land);
    out->lakes = !out->on_land && lakes_are_missing(&r);
    if (!out->on_land)
      mark_coastal(&r);
    keep_wide(&r);
    drop_small_areas(&r);
  }
  if (!good)
    status =
        fg__fail_memory(context, "where a field is missing", fg__map_raster_nodes(&r));
  else if (smooth(&r, !out->on_land))
    status = contour(out, context, &r);
  fg__map_raster_clear(&r);
  if (status)
    fg__missing_clear(out);
  return status;
}

void fg__missing_clear(fg__missing *missing)
{
  fg__polygons_clear(&missing->area);
  fg__polygons_clear(&missing->rim);
}
