/* Line integral convolution (Cabral and Leedom, SIGGRAPH 1993) by the fast algorithm of
 * Stalling and Hege (SIGGRAPH 1995): one streamline serves all pixels that it passes.
 *
 * The picture falls into blocks of a fixed size. A streamline belongs to the block it
 * starts in and gives values to that block's pixels only (Zoeckler, Stalling and Hege,
 * 1996), so that blocks can be painted by anyone, in any order, to the same result. */
#include "texture/texture.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "texture/blocks.h"
#include "texture/grain.h"

enum {
  BLOCK = FG__BLOCK,
  REACH = 64,      /* steps a way that a streamline serves pixels; more are lost
                      outside the block, fewer cost more convolution ends */
  MOST_HALF = 200, /* half a kernel: fg_texture_options.length is 400 at most */
  MOST_STEPS = 2 * (REACH + MOST_HALF) + 1,
  FIRST_SEEDS = 4 /* seeds first go to every fourth pixel of every fourth row */
};

/* Where directions cancel out there is no telling which way to go. */
static const float least_direction = 1e-3F;

struct block;

typedef struct painting {
  const fg__raster *raster;
  const float *grain;
  float *value;
  int half; /* of the kernel: steps of a pixel */
  fg__texture_blocks blocks;
  struct block *block; /* one a thread */
} painting;

typedef struct block {
  const painting *p;
  int first[2], size[2];
  float sum[BLOCK * BLOCK];
  int hits[BLOCK * BLOCK];
  /* of the streamline: its seed in the middle, places in padded arrays */
  int begin, end;
  int at[MOST_STEPS];
  int own[MOST_STEPS]; /* place in the block, or -1 */
  float once[MOST_STEPS + 1], twice[MOST_STEPS + 1];
} block;

/* The direction at a place, between four pixels; as before where there is none. */
static inline void look(const fg__raster *r, const float at[2], float direction[2])
{
  const int i = (int)at[0], j = (int)at[1];
  const float s = at[0] - (float)i, t = at[1] - (float)j;
  const float *lower = r->direction[(size_t)j * (size_t)r->stride + (size_t)i];
  const float *upper = lower + 2 * (size_t)r->stride;
  float v[2];
  for (int k = 0; k < 2; ++k) {
    const float low = lower[k] + s * (lower[k + 2] - lower[k]);
    const float high = upper[k] + s * (upper[k + 2] - upper[k]);
    v[k] = low + t * (high - low);
  }
  const float square = v[0] * v[0] + v[1] * v[1];
  if (square < least_direction * least_direction)
    return;
  const float scale = 1.0F / sqrtf(square);
  direction[0] = scale * v[0];
  direction[1] = scale * v[1];
}

/* Notes the pixel at a place of padded arrays; returns whether it is the block's own. */
static bool note(block *b, int step, const float at[2])
{
  const fg__raster *r = b->p->raster;
  const int i = (int)(at[0] + 0.5F), j = (int)(at[1] + 0.5F);
  b->at[step] = j * r->stride + i;
  const int x = i - r->margin - b->first[0], y = j - r->margin - b->first[1];
  const bool own = x >= 0 && x < b->size[0] && y >= 0 && y < b->size[1];
  b->own[step] = own ? y * BLOCK + x : -1;
  return own;
}

/* Follows the streamline one way, in steps of a pixel by the midpoint rule, until it has
 * been outside the block for half a kernel. Returns the last step. */
static int follow(block *b, const float seed[2], int way)
{
  const fg__raster *r = b->p->raster;
  const int half = b->p->half, middle = MOST_STEPS / 2;
  float at[2] = {seed[0], seed[1]};
  float direction[2] = {0.0F, 0.0F};
  int outside = 0, step = 0;
  while (step < REACH + half && outside < half) {
    look(r, at, direction);
    const float h = 0.5F * (float)way;
    const float between[2] = {at[0] + h * direction[0], at[1] + h * direction[1]};
    look(r, between, direction);
    at[0] += (float)way * direction[0];
    at[1] += (float)way * direction[1];
    ++step;
    outside = note(b, middle + way * step, at) ? 0 : outside + 1;
  }
  return middle + way * step;
}

/* The noise along the streamline under a triangle, which is a box under a box: both by
 * sums that run along. Gives the block's pixels their values. */
static void convolve(block *b)
{
  const float *grain = b->p->grain;
  const int box = b->p->half;
  const int count = b->end - b->begin + 1;
  const int *at = b->at + b->begin, *own = b->own + b->begin;
  float *once = b->once, *twice = b->twice;
  once[0] = twice[0] = 0.0F;
  for (int n = 0; n < count; ++n)
    once[n + 1] = once[n] + grain[at[n]];
  const int boxes = count - box + 1; /* boxes that fit */
  for (int n = 0; n < boxes; ++n)
    twice[n + 1] = twice[n] + (once[n + box] - once[n]);
  for (int n = 0; n + box <= boxes; ++n) {
    const int place = own[n + box - 1]; /* in the middle of 2 box - 1 steps */
    if (place < 0)
      continue;
    b->sum[place] += twice[n + box] - twice[n];
    ++b->hits[place];
  }
}

static void serve(block *b, int x, int y)
{
  const int margin = b->p->raster->margin;
  const float seed[2] = {(float)(b->first[0] + x + margin),
                         (float)(b->first[1] + y + margin)};
  note(b, MOST_STEPS / 2, seed);
  b->end = follow(b, seed, 1);
  b->begin = follow(b, seed, -1);
  convolve(b);
}

static void serve_all(block *b)
{
  for (int n = 0; n < BLOCK * BLOCK; ++n) {
    b->sum[n] = 0.0F;
    b->hits[n] = 0;
  }
  /* every fourth pixel of every fourth row, the others between them, then what is left */
  for (int spacing = FIRST_SEEDS; spacing > 0; spacing /= 2)
    for (int y = spacing / 2; y < b->size[1]; y += spacing)
      for (int x = spacing / 2; x < b->size[0]; x += spacing)
        if (!b->hits[y * BLOCK + x])
          serve(b, x, y);
}

static void write_block(const block *b)
{
  const painting *p = b->p;
  const size_t columns = (size_t)p->raster->size[0];
  for (int y = 0; y < b->size[1]; ++y) {
    float *out = p->value + (size_t)(b->first[1] + y) * columns + (size_t)b->first[0];
    for (int x = 0; x < b->size[0]; ++x)
      out[x] = b->sum[y * BLOCK + x] / (float)b->hits[y * BLOCK + x];
  }
}

static void paint_part(void *argument, const fg__thread *thread)
{
  painting *p = argument;
  block *b = &p->block[thread->index];
  b->p = p;
  while (fg__blocks_take(&p->blocks, b->first, b->size)) {
    serve_all(b);
    write_block(b);
  }
}

static double spread_of(const float *value, const fg__raster *r, bool padded)
{
  double sum = 0.0, squares = 0.0;
  for (int j = 0; j < r->size[1]; ++j)
    for (int i = 0; i < r->size[0]; ++i) {
      const size_t at =
          padded ? fg__raster_at(r, i, j) : (size_t)j * (size_t)r->size[0] + (size_t)i;
      sum += (double)value[at];
      squares += (double)value[at] * (double)value[at];
    }
  const double count = (double)r->size[0] * r->size[1];
  return sqrt(fmax(squares / count - sum / count * (sum / count), 0.0));
}

/* Where nothing moves there is no line to integrate along: the noise stays as it is, of
 * the same spread as the rest. */
static void leave_still(float *value, const fg__raster *r, const float *grain)
{
  const double noise = spread_of(grain, r, true);
  const double scale = noise > 0.0 ? spread_of(value, r, false) / noise : 0.0;
  for (int j = 0; j < r->size[1]; ++j)
    for (int i = 0; i < r->size[0]; ++i) {
      const size_t at = (size_t)j * (size_t)r->size[0] + (size_t)i;
      if (r->pixel[at] == FG__PIXEL_STILL)
        value[at] = (float)scale * grain[fg__raster_at(r, i, j)];
    }
}

static int half_of(double length)
{
  return (int)(0.5 * length + 0.5);
}

int fg__lic_margin(double length)
{
  return half_of(length) + 3; /* between pixels, and half a pixel of rounding */
}

fg_status fg__lic_paint(float *value, fg_context *context, const fg__canvas *canvas)
{
  const fg__raster *r = &canvas->raster;
  const size_t padded = (size_t)r->stride * (size_t)r->rows;
  const size_t thread_count = (size_t)fg__threads_count(canvas->threads);
  float *grain = fg__allocate(padded, sizeof *grain);
  painting p = {.raster = r, .grain = grain, .value = value};
  p.half = half_of(canvas->length);
  p.block = fg__allocate(thread_count, sizeof *p.block);
  fg__blocks_begin(&p.blocks, r);
  fg_status status = FG_STATUS_OK;
  if (!grain || !p.block)
    status = fg__fail_memory(context, "noise",
                             padded * sizeof *grain + thread_count * sizeof *p.block);
  if (!status)
    status = fg__grain_fill(grain, context, r, canvas->seed, canvas->threads);
  if (!status) {
    fg__threads_run(canvas->threads, paint_part, &p);
    if (!r->all_moving)
      leave_still(value, r, grain);
  }
  free(grain);
  free(p.block);
  return status;
}
