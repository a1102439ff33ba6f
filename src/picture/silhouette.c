#include "picture/silhouette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/vector.h"
#include "field/still.h"

/* Nodes along the longest side, and at most that many times those of the data. */
enum { NODES = 121, FINER = 2 };

/* Nodes beyond each side of the box, where a surface may close. */
enum { RIM = 4 };

/* Passes of the binomial filter 1 2 1 along each axis. All of them wash away a vessel as
 * thin as a sample: there the surface is that after the first. */
enum { PASSES = 4 };

/* The level, in speeds above which lies half of the sum of squares. */
static const double level_share = 0.2;

/* The surface is open at a side of the box of which this share is valid: the domain goes
 * up to it. A cylinder that only touches a side is closed there. */
static const double open_side = 0.15;

/* What is smaller than this share of the raster is a crumb. */
static const double crumb = 5e-5;

/* Where a field is valid everywhere and less than this share of a few samples is slow,
 * most of it moves. */
static const double hardly_dead = 0.42;
enum { PROBES = 41 }; /* along the longest side */

enum { BISECTIONS = 40 };

typedef struct raster {
  int nodes[3]; /* with the rim, but along a periodic axis */
  int rim[3];
  bool periodic[3];
  double origin[3], spacing[3]; /* of the first node, input coordinates */
  size_t count;
  float *value, *spare, *thin;
} raster;

static size_t index_of(const raster *r, const int at[3])
{
  return ((size_t)at[2] * (size_t)r->nodes[1] + (size_t)at[1]) * (size_t)r->nodes[0] +
         (size_t)at[0];
}

static bool is_in_box(const raster *r, const int at[3])
{
  for (int k = 0; k < 3; ++k)
    if (at[k] < r->rim[k] || at[k] >= r->nodes[k] - r->rim[k])
      return false;
  return true;
}

/* Steps to the next node, lexicographically; false after the last. */
static bool next_node(const raster *r, int at[3])
{
  for (int k = 0; k < 3; ++k) {
    if (++at[k] < r->nodes[k])
      return true;
    at[k] = 0;
  }
  return false;
}

/* A raster of `nodes` along the longest side. */
static void lay_out(raster *r, const fg_field_arrays *field, int nodes)
{
  double low[3], side[3], longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    low[k] = field->axis[k][0];
    r->periodic[k] = field->period[k] > 0.0;
    side[k] =
        r->periodic[k] ? field->period[k] : field->axis[k][field->size[k] - 1] - low[k];
    longest = fmax(longest, side[k]);
  }
  r->count = 1;
  for (int k = 0; k < 3; ++k) {
    double wanted = fmin(side[k] / longest * (nodes - 1), FINER * field->size[k]);
    int cells = (int)fmax(ceil(wanted), 4.0);
    r->spacing[k] = side[k] / cells;
    r->rim[k] = r->periodic[k] ? 0 : RIM;
    r->nodes[k] = cells + !r->periodic[k] + 2 * r->rim[k];
    r->origin[k] = low[k] - r->rim[k] * r->spacing[k];
    r->count *= (size_t)r->nodes[k];
  }
}

/* Speeds at the nodes; -1 where there is none. */
static void sample(raster *r, const fg_field *field)
{
  const fg_field_arrays *about = fg_field_contents(field);
  int at[3] = {0, 0, 0};
  do {
    double place[3], velocity[3];
    float *value = &r->value[index_of(r, at)];
    for (int k = 0; k < 3; ++k) {
      place[k] = r->origin[k] + at[k] * r->spacing[k];
      if (!r->periodic[k]) /* the last node lies on the box, in spite of rounding */
        place[k] = fmin(place[k], about->axis[k][about->size[k] - 1]);
      place[k] = fmax(place[k], about->axis[k][0]);
    }
    *value = -1.0F;
    if (is_in_box(r, at) && fg_field_velocity(field, place, velocity))
      *value = (float)fg__length(velocity);
  } while (next_node(r, at));
}

/* The speed above which lies half of the sum of squares. */
static double strong_speed(const raster *r, double squares, double fastest)
{
  double low = 0.0, high = fastest;
  for (int n = 0; n < BISECTIONS; ++n) {
    double middle = (low + high) / 2.0, above = 0.0;
    for (size_t i = 0; i < r->count; ++i)
      if ((double)r->value[i] > middle)
        above += (double)r->value[i] * (double)r->value[i];
    if (above > squares / 2.0)
      low = middle;
    else
      high = middle;
  }
  return high;
}

/* The share of what is valid that is slow. */
static double slow_share(const raster *r)
{
  const double top = fg__top_speed(r->value, r->count);
  return fg__slow_share(r->value, r->count, fg__usual_speed(r->value, r->count, top));
}

/* The level of speed that bounds what moves; 0 where most of the field does. */
static double find_level(const raster *r)
{
  double squares = 0.0, fastest = 0.0;
  if (!(slow_share(r) > 0.5))
    return 0.0;
  for (size_t i = 0; i < r->count; ++i)
    if (r->value[i] >= 0.0F) {
      squares += (double)r->value[i] * (double)r->value[i];
      fastest = fmax(fastest, (double)r->value[i]);
    }
  return level_share * strong_speed(r, squares, fastest);
}

/* The share of a side's nodes that have a speed. */
static double valid_share(const raster *r, int axis, int layer)
{
  int at[3] = {0, 0, 0};
  size_t all = 0, valid = 0;
  do {
    if (at[axis] != layer || !is_in_box(r, at))
      continue;
    ++all;
    valid += r->value[index_of(r, at)] >= 0.0F;
  } while (next_node(r, at));
  return (double)valid / (double)all;
}

/* Copies the outermost layer of the box to the rim beyond it. */
static void extend(raster *r, int axis, int side)
{
  int layer = side ? r->nodes[axis] - 1 - r->rim[axis] : r->rim[axis];
  int at[3] = {0, 0, 0};
  do {
    int from[3] = {at[0], at[1], at[2]};
    from[axis] = layer;
    if (side ? at[axis] > layer : at[axis] < layer)
      r->value[index_of(r, at)] = r->value[index_of(r, from)];
  } while (next_node(r, at));
}

/* The binomial filter along an axis; rows of x at a time. */
static void filter(raster *r, int axis)
{
  const ptrdiff_t step[3] = {1, r->nodes[0], (ptrdiff_t)r->nodes[0] * r->nodes[1]};
  const int last = r->nodes[axis] - 1;
  ptrdiff_t own = 0;
  for (int z = 0; z < r->nodes[2]; ++z)
    for (int y = 0; y < r->nodes[1]; ++y)
      for (int x = 0; x < r->nodes[0]; ++x, ++own) {
        int at = axis == 0 ? x : axis == 1 ? y : z;
        ptrdiff_t round = r->periodic[axis] ? last * step[axis] : 0;
        ptrdiff_t before = at > 0 ? own - step[axis] : own + round;
        ptrdiff_t after = at < last ? own + step[axis] : own - round;
        r->spare[own] =
            0.25F * r->value[before] + 0.5F * r->value[own] + 0.25F * r->value[after];
      }
  float *swap = r->value;
  r->value = r->spare;
  r->spare = swap;
}

/* thin: what is above the level after one pass stays so. */
static void smooth(raster *r, bool thin)
{
  for (int n = 0; n < PASSES; ++n) {
    for (int k = 0; k < 3; ++k)
      filter(r, k);
    if (n == 0)
      memcpy(r->thin, r->value, r->count * sizeof *r->thin);
  }
  for (size_t i = 0; i < r->count && thin; ++i)
    r->value[i] = fmaxf(r->value[i], r->thin[i]);
}

/* Whether there is a speed everywhere in the box. */
static bool is_full(const raster *r)
{
  int at[3] = {0, 0, 0};
  do {
    if (r->value[index_of(r, at)] < 0.0F && is_in_box(r, at))
      return false;
  } while (next_node(r, at));
  return true;
}

/* Makes the values positive inside, smooth, and closed but where the box is. Returns
 * whether there is anything to show. */
static bool find_inside(raster *r)
{
  double level = find_level(r);
  bool open[3][2];
  if (!(level > 0.0) && is_full(r))
    return false;
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side) {
      int layer = side ? r->nodes[k] - 1 - r->rim[k] : r->rim[k];
      open[k][side] =
          r->periodic[k] || level > 0.0 || valid_share(r, k, layer) > open_side;
    }
  int at[3] = {0, 0, 0};
  do {
    float *value = &r->value[index_of(r, at)];
    *value = level > 0.0 ? fmaxf(*value, 0.0F) / (float)level : *value >= 0.0F;
    *value -= level > 0.0 ? 1.0F : 0.5F;
  } while (next_node(r, at));
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side)
      if (open[k][side] && !r->periodic[k])
        extend(r, k, side);
  smooth(r, level > 0.0);
  return true;
}

static fg_status make_surface(fg_surface **out, fg_context *context, const raster *r)
{
  fg_density_arrays arrays = {.dimension = 3,
                              .u = r->value,
                              .debris_area = crumb * (double)r->count * r->spacing[0] *
                                             r->spacing[1] * r->spacing[2]};
  for (int k = 0; k < 3; ++k) {
    arrays.nodes[k] = r->nodes[k];
    arrays.origin[k] = r->origin[k];
    arrays.spacing[k] = r->spacing[k];
    arrays.periodic[k] = r->periodic[k];
  }
  fg_density *density;
  fg_status status = fg_density_create_from_arrays(&density, context, &arrays);
  if (status)
    return status;
  status = fg_density_surface(out, context, density);
  fg_density_destroy(density);
  return status;
}

/* Moves what lies in the rim onto the box. */
static void press(fg_surface *surface, const fg_field_arrays *field)
{
  for (int n = 0; n < surface->vertex_count; ++n)
    for (int k = 0; k < 3; ++k)
      if (!(field->period[k] > 0.0))
        surface->vertex[n][k] = fmin(fmax(surface->vertex[n][k], field->axis[k][0]),
                                     field->axis[k][field->size[k] - 1]);
}

static bool is_complete(const fg_field_arrays *field)
{
  size_t count = (size_t)field->size[0] * (size_t)field->size[1] * (size_t)field->size[2];
  for (size_t n = 0; n < count; ++n)
    if ((field->valid && !field->valid[n]) || !isfinite(field->velocity[0][n]) ||
        !isfinite(field->velocity[1][n]) || !isfinite(field->velocity[2][n]))
      return false;
  return true;
}

/* Whether a few samples show already that there is nothing to draw. */
static bool is_all_moving(const fg_field *field)
{
  raster r = {.value = NULL};
  if (!is_complete(fg_field_contents(field)))
    return false;
  lay_out(&r, fg_field_contents(field), PROBES);
  r.value = fg__allocate(r.count, sizeof *r.value);
  if (!r.value)
    return false; /* the larger raster will say so */
  sample(&r, field);
  bool moving = slow_share(&r) < hardly_dead;
  free(r.value);
  return moving;
}

fg_status fg__silhouette_create(fg_surface **out, fg_context *context,
                                const fg_field *field)
{
  *out = NULL;
  if (fg_field_is_slab(field, NULL, NULL) || is_all_moving(field))
    return FG_STATUS_OK;
  raster r = {.value = NULL};
  lay_out(&r, fg_field_contents(field), NODES);
  r.value = fg__allocate(r.count, sizeof *r.value);
  r.spare = fg__allocate(r.count, sizeof *r.spare);
  r.thin = fg__allocate(r.count, sizeof *r.thin);
  fg_status status = FG_STATUS_OK;
  if (!r.value || !r.spare || !r.thin)
    status = fg__fail_memory(context, "a silhouette", 3 * r.count * sizeof *r.value);
  if (!status) {
    sample(&r, field);
    if (find_inside(&r))
      status = make_surface(out, context, &r);
    if (*out)
      press(*out, fg_field_contents(field));
  }
  free(r.value);
  free(r.spare);
  free(r.thin);
  return status;
}
