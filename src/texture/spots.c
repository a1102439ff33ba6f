/* Spot noise (van Wijk, SIGGRAPH 1991): many spots of random sign at random places, each
 * drawn out along the flow there and narrowed across it, the more the faster; bent along
 * the streamline, to second order, after the bent spots of de Leeuw and van Wijk (1995).
 *
 * One spot a cell of a fine lattice, at a place that a hash of the cell gives: no two
 * runs differ, no place has too few. The picture falls into blocks that anyone may paint.
 */
#include "texture/texture.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"
#include "texture/blocks.h"

enum { BLOCK = FG__BLOCK };

/* Spots that lie over a pixel on average: fewer leave single spots to be seen, more cost
 * time and change nothing (the sum is a bell curve by then). */
static const double overlap = 10.0;

/* A spot in slow places is round; the fastest are this much longer and as much narrower,
 * so that all have the same area. */
static const double most_stretch = 4.0;

/* Narrower spots would fall between the pixels. */
static const double least_radius = 0.8;

/* Bends reach half a spot's half-length aside at most: a parabola is no arc beyond. */
static const double most_bend = 1.0;

typedef struct painting {
  const fg__raster *raster;
  float *value;
  uint64_t key;
  double radius; /* of a round spot */
  double mean_speed;
  double cell[2]; /* of the lattice, pixels */
  int cells[2];   /* along a periodic axis */
  double reach;   /* of a spot from its centre, at most */
  fg__texture_blocks blocks;
  struct block *block;
} painting;

typedef struct block {
  const painting *p;
  int first[2], size[2];
  float sum[BLOCK * BLOCK];
} block;

typedef struct spot {
  double center[2]; /* of the picture's pixels: the middle of (0, 0) is at 0, 0 */
  double along[2];  /* direction */
  double half[2];   /* length and width, halved */
  double curvature;
  double weight;
} spot;

static double radius_of(double length)
{
  return fmax(0.5 * length / most_stretch, 1.5 * least_radius);
}

static double half_length(double radius)
{
  return most_stretch * radius;
}

static double reach_of(double radius)
{
  return hypot(half_length(radius), 0.5 * most_bend * half_length(radius) + radius);
}

int fg__spots_margin(double length)
{
  const double radius = radius_of(length);
  return (int)ceil(reach_of(radius) + 0.5 * half_length(radius)) + 4;
}

/* The direction at the nearest pixel. */
static const float *direction_at(const fg__raster *r, double x, double y)
{
  return r->direction[fg__raster_at(r, (int)floor(x + 0.5), (int)floor(y + 0.5))];
}

/* Speeds lie between 0 and 1 for slow and fast; the mean speed is at one half. */
static double share_of_speed(const painting *p, const double center[2])
{
  const fg__raster *r = p->raster;
  const int i = fg__raster_wrap(r, 0, (int)floor(center[0] + 0.5));
  const int j = fg__raster_wrap(r, 1, (int)floor(center[1] + 0.5));
  const double speed = (double)r->speed[(size_t)j * (size_t)r->size[0] + (size_t)i];
  if (isnan(speed))
    return 0.5; /* beside the mask */
  return speed > 0.0 ? speed / (speed + p->mean_speed) : 0.0;
}

/* How fast the direction turns along the stream: t x dt/ds. */
static double curvature_at(const fg__raster *r, const double center[2],
                           const double along[2], double half)
{
  const double step = fmax(0.5 * half, 1.0);
  const float *after =
      direction_at(r, center[0] + step * along[0], center[1] + step * along[1]);
  const float *before =
      direction_at(r, center[0] - step * along[0], center[1] - step * along[1]);
  const double turn[2] = {(double)(after[0] - before[0]) / (2.0 * step),
                          (double)(after[1] - before[1]) / (2.0 * step)};
  const double curvature = along[0] * turn[1] - along[1] * turn[0];
  const double most = most_bend / half;
  return fmin(fmax(curvature, -most), most);
}

/* Bits of a hash as a number in [0, 1). */
static double share_of(uint64_t bits, int shift)
{
  return (double)(bits >> shift & 0xffffff) * 0x1p-24;
}

static int64_t wrapped(const painting *p, int k, int64_t cell)
{
  const int64_t count = p->cells[k];
  return p->raster->periodic[k] ? (cell % count + count) % count : cell;
}

static void make_spot(spot *out, const painting *p, int64_t i, int64_t j)
{
  const uint64_t column = (uint32_t)wrapped(p, 0, i), row = (uint32_t)wrapped(p, 1, j);
  const uint64_t bits = fg__mix(p->key ^ (row << 32 | column));
  out->center[0] = p->cell[0] * ((double)i + share_of(bits, 0)) - 0.5;
  out->center[1] = p->cell[1] * ((double)j + share_of(bits, 24)) - 0.5;
  const float *along = direction_at(p->raster, out->center[0], out->center[1]);
  const double stretch = 1.0 + (most_stretch - 1.0) * share_of_speed(p, out->center);
  out->along[0] = (double)along[0];
  out->along[1] = (double)along[1];
  out->half[0] = stretch * p->radius;
  out->half[1] = fmax(p->radius / stretch, least_radius);
  out->curvature = curvature_at(p->raster, out->center, out->along, out->half[0]);
  /* the same energy for all */
  out->weight = 1.0 / sqrt(out->half[0] * out->half[1]);
  if (bits >> 63)
    out->weight = -out->weight;
}

/* Cuts an interval of x down to where low <= slope x + offset <= high. */
static void cut(double interval[2], double slope, double offset, double low, double high)
{
  if (fabs(slope) < 1e-6) {
    if (offset < low || offset > high)
      interval[1] = interval[0] - 1.0;
    return;
  }
  const double one = (low - offset) / slope, other = (high - offset) / slope;
  interval[0] = fmax(interval[0], fmin(one, other));
  interval[1] = fmin(interval[1], fmax(one, other));
}

/* Numbers of a spot's row: along and across the stream as they grow with x. */
typedef struct slice {
  float along, across;             /* per pixel */
  float first_along, first_across; /* at the first pixel */
  float bend;                      /* half the curvature */
  float narrow[2];                 /* 1 / half^2 */
  float weight;
} slice;

/* A bump (1 - q^2)^2 within the bent ellipse q < 1. */
static void add_slice(float *restrict out, int count, const slice *s)
{
  for (int n = 0; n < count; ++n) {
    const float along = s->first_along + (float)n * s->along;
    const float square = along * along;
    const float across = s->first_across + (float)n * s->across - s->bend * square;
    float q = 1.0F - square * s->narrow[0] - across * across * s->narrow[1];
    q = q > 0.0F ? q : 0.0F;
    out[n] += s->weight * (q * q);
  }
}

static void add_row(block *b, const spot *s, int y)
{
  const double dy = y - s->center[1];
  const double tx = s->along[0], ty = s->along[1];
  const double bend = 0.5 * s->curvature * s->half[0] * s->half[0];
  double interval[2] = {b->first[0] - s->center[0],
                        b->first[0] + b->size[0] - 1 - s->center[0]};
  cut(interval, tx, ty * dy, -s->half[0], s->half[0]);
  cut(interval, -ty, tx * dy, fmin(bend, 0.0) - s->half[1], fmax(bend, 0.0) + s->half[1]);
  const int first = (int)ceil(interval[0] + s->center[0]);
  const int last = (int)floor(interval[1] + s->center[0]);
  if (interval[1] < interval[0] || last < first)
    return;
  const double dx = first - s->center[0];
  const slice row = {.along = (float)tx,
                     .across = (float)-ty,
                     .first_along = (float)(tx * dx + ty * dy),
                     .first_across = (float)(tx * dy - ty * dx),
                     .bend = (float)(0.5 * s->curvature),
                     .narrow = {(float)(1.0 / (s->half[0] * s->half[0])),
                                (float)(1.0 / (s->half[1] * s->half[1]))},
                     .weight = (float)s->weight};
  add_slice(b->sum + (y - b->first[1]) * BLOCK + (first - b->first[0]), last - first + 1,
            &row);
}

static void add_spot(block *b, const spot *s)
{
  const double reach =
      hypot(s->half[0], 0.5 * fabs(s->curvature) * s->half[0] * s->half[0] + s->half[1]);
  const int lowest = (int)ceil(fmax(s->center[1] - reach, b->first[1]));
  const int highest =
      (int)floor(fmin(s->center[1] + reach, b->first[1] + b->size[1] - 1));
  if (s->center[0] + reach < b->first[0] ||
      s->center[0] - reach > b->first[0] + b->size[0] - 1)
    return;
  for (int y = lowest; y <= highest; ++y)
    add_row(b, s, y);
}

static void paint_block(block *b)
{
  const painting *p = b->p;
  int64_t first[2], last[2];
  for (int k = 0; k < 2; ++k) {
    first[k] = (int64_t)floor((b->first[k] - p->reach) / p->cell[k]);
    last[k] = (int64_t)floor((b->first[k] + b->size[k] + p->reach) / p->cell[k]);
  }
  for (int n = 0; n < BLOCK * BLOCK; ++n)
    b->sum[n] = 0.0F;
  for (int64_t j = first[1]; j <= last[1]; ++j)
    for (int64_t i = first[0]; i <= last[0]; ++i) {
      spot s;
      make_spot(&s, p, i, j);
      add_spot(b, &s);
    }
  for (int y = 0; y < b->size[1]; ++y)
    for (int x = 0; x < b->size[0]; ++x)
      p->value[(size_t)(b->first[1] + y) * (size_t)p->raster->size[0] +
               (size_t)(b->first[0] + x)] = b->sum[y * BLOCK + x];
}

static void paint_part(void *argument, const fg__thread *thread)
{
  painting *p = argument;
  block *b = &p->block[thread->index];
  b->p = p;
  while (fg__blocks_take(&p->blocks, b->first, b->size))
    paint_block(b);
}

static double mean_speed(const fg__raster *r)
{
  const size_t count = (size_t)r->size[0] * (size_t)r->size[1];
  double sum = 0.0;
  size_t known = 0;
  for (size_t n = 0; n < count; ++n)
    if (r->pixel[n] != FG__PIXEL_MASKED) {
      sum += (double)r->speed[n];
      ++known;
    }
  return known ? sum / (double)known : 0.0;
}

fg_status fg__spots_paint(float *value, fg_context *context, const fg__canvas *canvas)
{
  const fg__raster *r = &canvas->raster;
  const double radius = radius_of(canvas->length);
  const size_t thread_count = (size_t)fg__threads_count(canvas->threads);
  painting p = {.raster = r,
                .value = value,
                .key = fg__mix(canvas->seed ^ 0x73706f7473U), /* "spots" */
                .radius = radius,
                .mean_speed = mean_speed(r),
                .reach = reach_of(radius)};
  const double spacing = radius * sqrt(acos(-1.0) / overlap);
  for (int k = 0; k < 2; ++k) {
    p.cells[k] = (int)fmax(floor(r->size[k] / spacing), 1.0);
    p.cell[k] = r->periodic[k] ? (double)r->size[k] / p.cells[k] : spacing;
  }
  fg__blocks_begin(&p.blocks, r);
  p.block = fg__allocate(thread_count, sizeof *p.block);
  if (!p.block)
    return fg__fail_memory(context, "spots", thread_count * sizeof *p.block);
  fg__threads_run(canvas->threads, paint_part, &p);
  free(p.block);
  return FG_STATUS_OK;
}
