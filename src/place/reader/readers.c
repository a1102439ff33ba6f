#include "place/reader/readers.h"

#include "base/memory.h"
#include "base/vector.h"
#include "place/reader/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A subdomain smaller than this many fair shares gets no icon, and does not
 * count, unless it is the largest. */
static const double SMALLEST_PART_2D = 0.25;
static const double SMALLEST_PART_3D = 1.0;

void fg__place_raster_center(double center[3], const fg__place_raster *raster,
                             const fg__place_scale *scale, const int at[3])
{
  for (int k = 0; k < 3; ++k)
    center[k] =
        k < raster->dimension
            ? scale->origin[k] + (at[k] + 0.5) * (double)raster->cell * scale->lambda
            : 0.0;
}

/* The least area (volume) of a subdomain that counts. */
static double smallest_subdomain(const fg__place_domain *domain,
                                 const fg__place_scale *scale)
{
  double largest = 0.0;
  const double least = domain->measure / scale->count *
                       (domain->dimension == 2 ? SMALLEST_PART_2D : SMALLEST_PART_3D);
  for (int n = 0; n < domain->subdomain_count; ++n)
    largest = fg__most(largest, domain->subdomains[n].measure);
  return fg__least(least, largest);
}

static void fill_raster(fg__place_raster *raster, const fg__place_domain *domain,
                        const fg__place_scale *scale)
{
  double sum = 0.0, smallest = smallest_subdomain(domain, scale);
  size_t cell = 0;
  for (int z = 0; z < raster->cells[2]; ++z)
    for (int y = 0; y < raster->cells[1]; ++y)
      for (int x = 0; x < raster->cells[0]; ++x, ++cell) {
        double center[3], direction[3];
        fg__place_raster_center(center, raster, scale, (const int[3]){x, y, z});
        double speed = fg__place_speed(domain, center);
        const fg__place_subdomain *subdomain = fg__place_subdomain_at(domain, center);
        if (!fg__place_moves(domain, speed) || !subdomain ||
            !fg__place_direction(domain, center, direction))
          continue;
        for (int k = 0; k < raster->dimension; ++k)
          raster->direction[k][cell] = (float)direction[k];
        if (subdomain->measure < smallest)
          continue;
        double weight = fg__place_weight(domain, speed);
        raster->weight[cell] = (float)weight;
        sum += weight;
      }
  float norm = sum > 0.0 ? (float)(scale->count / sum) : 0.0F;
  for (size_t n = 0; n < raster->count; ++n)
    raster->weight[n] *= norm;
}

fg_status fg__place_raster_create(fg__place_raster *out, fg_context *context,
                                  const fg__place_domain *domain,
                                  const fg__place_scale *scale)
{
  *out = (fg__place_raster){.dimension = domain->dimension,
                            .cell = (float)(scale->cell / scale->lambda),
                            .count = 1};
  for (int k = 0; k < 3; ++k) {
    double length = domain->high[k] - domain->low[k];
    out->cells[k] = k < domain->dimension ? (int)(length / scale->cell + 0.999) : 1;
    out->cells[k] = out->cells[k] > 1 ? out->cells[k] : 1;
    out->count *= (size_t)out->cells[k];
  }
  const size_t room = out->count + FG__PLACE_PAD;
  out->weight = fg__allocate(room, sizeof *out->weight);
  bool whole = out->weight != NULL;
  for (int k = 0; k < domain->dimension; ++k) {
    out->direction[k] = fg__allocate(room, sizeof *out->direction[k]);
    whole = whole && out->direction[k];
  }
  if (!whole) {
    fg__place_raster_clear(out);
    return fg__fail_memory(context, "a raster for readers", out->count * 16);
  }
  fill_raster(out, domain, scale);
  return FG_STATUS_OK;
}

void fg__place_raster_clear(fg__place_raster *raster)
{
  free(raster->weight);
  for (int k = 0; k < 3; ++k)
    free(raster->direction[k]);
  raster->weight = raster->direction[0] = raster->direction[1] = raster->direction[2] =
      NULL;
}

void fg__place_contribution_clear(fg__place_contribution *contribution)
{
  free(contribution->room);
  *contribution = (fg__place_contribution){0};
}

static fg_status make_room(fg__place_contribution *contribution, fg_context *context,
                           int dimension, const fg__place_box *box)
{
  size_t count = fg__place_box_count(box) + FG__PLACE_PAD;
  contribution->box = *box;
  contribution->dimension = dimension;
  if (count <= contribution->capacity)
    return FG_STATUS_OK;
  free(contribution->room);
  contribution->capacity = fg__place_array_stride(count + count / 4);
  size_t values = contribution->capacity * FG__PLACE_ARRAYS((size_t)dimension) +
                  2 * (size_t)FG__PLACE_PAD;
  contribution->room = fg__allocate_aligned(values, sizeof(float));
  if (contribution->room) {
    contribution->value = contribution->room + FG__PLACE_PAD;
    return FG_STATUS_OK;
  }
  contribution->capacity = 0;
  return fg__fail_memory(context, "icons' contributions", values * sizeof(float));
}

fg_status fg__place_contribution_start(fg__place_contribution *contribution,
                                       fg_context *context, int dimension,
                                       const fg__place_box *box, float reach)
{
  fg_status status = make_room(contribution, context, dimension, box);
  if (status != FG_STATUS_OK)
    return status;
  size_t count = fg__place_box_count(box);
  for (size_t n = 0; n < count; ++n)
    contribution->value[n] = reach * reach;
  for (int array = 1; array < FG__PLACE_ARRAYS(dimension); ++array)
    memset(contribution->value + (size_t)array * contribution->capacity, 0,
           count * sizeof(float));
  return FG_STATUS_OK;
}

fg__place_box fg__place_box_around(const fg__place_raster *raster,
                                   const fg__place_line *line, float distance)
{
  fg__place_box box = {{0}, {0}};
  for (int k = 0; k < 3 && line->count > 0; ++k) {
    box.size[k] = 1;
    if (k >= raster->dimension)
      continue;
    float least = line->position[k][0], most = least;
    for (int n = 1; n < line->count; ++n) {
      const float at = line->position[k][n];
      least = at < least ? at : least;
      most = at > most ? at : most;
    }
    int low = (int)((least - distance) / raster->cell);
    int high = (int)((most + distance) / raster->cell) + 1;
    box.low[k] = low > 0 ? low : 0;
    high = high < raster->cells[k] ? high : raster->cells[k];
    box.size[k] = high > box.low[k] ? high - box.low[k] : 0;
  }
  return box;
}

fg__place_box fg__place_box_of(const fg__place_raster *raster,
                               const fg__place_scale *scale, const fg__place_line *line)
{
  return fg__place_box_around(raster, line, (float)(scale->reach / scale->lambda));
}

void fg__place_box_widen(fg__place_box *box, const fg__place_box *by)
{
  if (fg__place_box_count(by) == 0)
    return;
  if (fg__place_box_count(box) == 0)
    *box = *by;
  for (int k = 0; k < 3; ++k) {
    int end = box->low[k] + box->size[k], other = by->low[k] + by->size[k];
    box->low[k] = box->low[k] < by->low[k] ? box->low[k] : by->low[k];
    box->size[k] = (end > other ? end : other) - box->low[k];
  }
}

fg_status fg__place_contribution_compute(fg__place_contribution *out, fg_context *context,
                                         const fg__place_raster *raster,
                                         const fg__place_scale *scale,
                                         const fg__place_line *line)
{
  float reach = (float)(scale->reach / scale->lambda);
  fg__place_box box = fg__place_box_of(raster, scale, line);
  fg_status status = make_room(out, context, raster->dimension, &box);
  if (status == FG_STATUS_OK)
    fg__place_contribute_rows(out, raster, line, reach);
  return status;
}

/* The common part of two boxes. */
static bool common_box(fg__place_box *out, const fg__place_box *a, const fg__place_box *b)
{
  for (int k = 0; k < 3; ++k) {
    int low = a->low[k] > b->low[k] ? a->low[k] : b->low[k];
    int end_a = a->low[k] + a->size[k], end_b = b->low[k] + b->size[k];
    out->low[k] = low;
    out->size[k] = (end_a < end_b ? end_a : end_b) - low;
    if (out->size[k] <= 0)
      return false;
  }
  return true;
}

void fg__place_contribution_add(fg__place_contribution *to,
                                const fg__place_contribution *from)
{
  fg__place_box both;
  if (common_box(&both, &to->box, &from->box))
    fg__place_add_rows(to, from, &both);
}

double fg__place_cost(float *cost, const fg__place_raster *raster,
                      const fg__place_box *box, const fg__place_contribution *one,
                      const fg__place_contribution *other,
                      const fg__place_weights *weights)
{
  const fg__place_contribution *const parts[2] = {one, other};
  return fg__place_cost_rows(cost, raster, box, parts, weights);
}

static const float BEYOND = 1e9F;

void fg__place_points_clear(fg__place_points *points)
{
  free(points->position);
  *points = (fg__place_points){0};
}

fg_status fg__place_points_start(fg__place_points *points, fg_context *context,
                                 int dimension, int most)
{
  size_t needed = ((size_t)most / FG__PLACE_PAD + 1) * FG__PLACE_PAD;
  points->dimension = dimension;
  points->count = 0;
  if (needed > points->capacity) {
    free(points->position);
    points->capacity = needed;
    points->position =
        fg__allocate_aligned(needed * (size_t)dimension, sizeof *points->position);
    if (!points->position) {
      points->capacity = 0;
      return fg__fail_memory(context, "samples of lines",
                             needed * (size_t)dimension * sizeof *points->position);
    }
  }
  for (int k = 0; k < dimension; ++k)
    for (size_t n = 0; n < needed; ++n)
      points->position[(size_t)k * points->capacity + n] = BEYOND;
  return FG_STATUS_OK;
}

void fg__place_points_add(fg__place_points *points, const fg__place_line *line)
{
  for (int k = 0; k < points->dimension; ++k)
    memcpy(points->position + (size_t)k * points->capacity + points->count,
           line->position[k], (size_t)line->count * sizeof *points->position);
  points->count += line->count;
}

void fg__place_points_nearest(float square[FG__PLACE_SAMPLES],
                              const fg__place_points *points, const fg__place_line *line)
{
  int count = (points->count + FG__PLACE_PAD - 1) / FG__PLACE_PAD * FG__PLACE_PAD;
  fg__place_nearest_points(points->dimension, square, line, points->position,
                           points->capacity, count);
}
