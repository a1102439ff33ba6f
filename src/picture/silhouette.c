#include "picture/silhouette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/vector.h"

/* Nodes along the longest side, and at most that many times those of the data. */
enum { NODES = 121, FINER = 2 };

/* Nodes beyond each side of the box, where a surface may close. */
enum { RIM = 4 };

/* Passes of the binomial filter 1 2 1 along each axis. */
enum { PASSES = 4 };

/* The field is mostly dead when more than half of it is slower than this share of the
 * root mean square. */
static const double dead_speed = 0.1;

/* The level, in speeds above which lies half of the sum of squares. */
static const double level_share = 0.2;

/* The surface is open at a side of the box of which this share is valid: the domain goes
 * up to it. A cylinder that only touches a side is closed there. */
static const double open_side = 0.15;

/* What is smaller than this share of the raster is a crumb. */
static const double crumb = 2e-4;

enum { BISECTIONS = 40 };

typedef struct raster {
  int nodes[3]; /* with the rim, but along a periodic axis */
  int rim[3];
  bool periodic[3];
  double origin[3], spacing[3]; /* of the first node, input coordinates */
  size_t count;
  float *value, *spare;
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

static void lay_out(raster *r, const fg_field_arrays *field)
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
    double wanted = fmin(side[k] / longest * (NODES - 1), FINER * field->size[k]);
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

/* The level of speed that bounds what moves; 0 where most of the field does. */
static double find_level(const raster *r)
{
  double squares = 0.0, fastest = 0.0;
  size_t valid = 0, slow = 0;
  for (size_t i = 0; i < r->count; ++i) {
    double speed = (double)r->value[i];
    if (speed < 0.0)
      continue;
    ++valid;
    squares += speed * speed;
    fastest = fmax(fastest, speed);
  }
  double limit = dead_speed * sqrt(squares / (double)valid);
  for (size_t i = 0; i < r->count; ++i)
    slow += r->value[i] >= 0.0F && (double)r->value[i] < limit;
  return 2 * slow > valid ? level_share * strong_speed(r, squares, fastest) : 0.0;
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

static void filter(raster *r, int axis)
{
  int at[3] = {0, 0, 0}, last = r->nodes[axis] - 1;
  do {
    int before[3] = {at[0], at[1], at[2]}, after[3] = {at[0], at[1], at[2]};
    before[axis] = at[axis] > 0 ? at[axis] - 1 : r->periodic[axis] ? last : 0;
    after[axis] = at[axis] < last ? at[axis] + 1 : r->periodic[axis] ? 0 : last;
    size_t own = index_of(r, at);
    r->spare[own] = 0.25F * r->value[index_of(r, before)] + 0.5F * r->value[own] +
                    0.25F * r->value[index_of(r, after)];
  } while (next_node(r, at));
  float *swap = r->value;
  r->value = r->spare;
  r->spare = swap;
}

/* Makes the values positive inside, smooth, and closed but where the box is. Returns
 * whether there is anything to show. */
static bool find_inside(raster *r)
{
  double level = find_level(r);
  bool open[3][2], all = true;
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side) {
      int layer = side ? r->nodes[k] - 1 - r->rim[k] : r->rim[k];
      open[k][side] =
          r->periodic[k] || level > 0.0 || valid_share(r, k, layer) > open_side;
    }
  int at[3] = {0, 0, 0};
  do {
    float *value = &r->value[index_of(r, at)];
    all = all && (*value >= 0.0F || !is_in_box(r, at));
    *value = level > 0.0 ? fmaxf(*value, 0.0F) / (float)level : *value >= 0.0F;
    *value -= level > 0.0 ? 1.0F : 0.5F;
  } while (next_node(r, at));
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side)
      if (open[k][side] && !r->periodic[k])
        extend(r, k, side);
  for (int n = 0; n < PASSES; ++n)
    for (int k = 0; k < 3; ++k)
      filter(r, k);
  return level > 0.0 || !all;
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

fg_status fg__silhouette_create(fg_surface **out, fg_context *context,
                                const fg_field *field)
{
  *out = NULL;
  if (fg_field_is_part(field, NULL, NULL))
    return FG_STATUS_OK;
  raster r = {.value = NULL};
  lay_out(&r, fg_field_contents(field));
  r.value = fg__allocate(r.count, sizeof *r.value);
  r.spare = fg__allocate(r.count, sizeof *r.spare);
  fg_status status = FG_STATUS_OK;
  if (!r.value || !r.spare)
    status = fg__fail_memory(context, "a silhouette", 2 * r.count * sizeof *r.value);
  if (!status) {
    sample(&r, field);
    if (find_inside(&r))
      status = make_surface(out, context, &r);
    if (*out)
      press(*out, fg_field_contents(field));
  }
  free(r.value);
  free(r.spare);
  return status;
}
