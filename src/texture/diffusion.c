/* Nonlinear anisotropic diffusion (Preusser and Rumpf, IEEE Visualization 1999): noise is
 * diffused along the flow and hardly across it, while a right-hand side keeps its
 * contrast,
 *
 *     du/dt = div(A grad u) + f(u),   A = d d^T + G(|grad u_s|) (I - d d^T),
 *
 * d the direction of the flow, u_s a smoothed u, f(u) = c u (1 - u^2).
 *
 * The stiffness is that of bilinear elements with the gradient at each cell's middle
 * (cells lie between four pixels): it adds hardly any diffusion across the flow of its
 * own; what it does not see, the checkerboard, is damped apart. Time goes by the
 * first order Runge-Kutta-Chebyshev method (Verwer 1996): s stages make a step s^2 times
 * as long as one. */
#include "texture/texture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "texture/contrast.h"
#include "texture/grain.h"

/* Steps of the nonlinear terms, each of as many stages as it needs. */
enum { STEPS = 12 };

/* Growth of small contrast over the whole time, e^3: as much as diffusion takes away. */
static const double growth = 3.0;

/* Of the noise at first: its contrast is even within this share of `length`, and it goes
 * from -1/2 to 1/2; u settles near -1 and 1. */
static const double widest_share = 0.12, noise_cut = 2.0;

/* Diffusion across the flow where there are no edges, against 1 along it, and the slope
 * (per pixel) at which an edge halves it. By eye: streaks keep their width. */
static const float across = 0.06F, edge = 0.35F;

/* Elements with exact gradients would damp the checkerboard by (1 + G) / 12, and streaks
 * with it; so much holds it down, too. */
static const float checks = 0.06F;

/* A Gaussian of this share of `length` is as long as the kernel of the other kinds. */
static const double spread_of_length = 0.25;

/* Damping of the Chebyshev method, and the largest eigenvalue. Of stiff modes a step
 * leaves up to 1 / cosh(sqrt(2 damping)), here 0.27; with the usual damping of 0.05,
 * which leaves 0.95, some outlive all steps, as rows of dots. */
static const double damping = 2.0, stiffest = 4.0;

/* Of one stage: out = a now + b before + tau F(now). */
typedef struct stage {
  float now, before, tau;
} stage;

typedef struct diffusion {
  const fg__raster *raster;
  int columns, rows; /* of pixels */
  size_t stride;     /* of u: a column more at either side */
  size_t cells;      /* a row of cells: one more than pixels */
  float *along[2];   /* direction a cell; 0, 0: none */
  float *width;      /* G, a cell */
  float *state[3];
  const float *now, *before;
  float *out;
  float *flux; /* six rows of cells a thread */
  float rate;  /* c */
  stage stage;
} diffusion;

/* The row beyond the picture: the other end, or (its cells carry nothing) the nearest. */
static const float *row_of(const diffusion *d, const float *u, int j)
{
  return u + (size_t)fg__raster_wrap(d->raster, 1, j) * d->stride;
}

static void close_row(const diffusion *d, float *row)
{
  const bool periodic = d->raster->periodic[0];
  row[0] = row[periodic ? d->columns : 1];
  row[d->columns + 1] = row[periodic ? 1 : d->columns];
}

/* Whether a cell, numbered from -1, lies inside the picture or across a boundary that is
 * none. */
static bool conducts(const diffusion *d, int k, int cell)
{
  const int pixels = k == 0 ? d->columns : d->rows;
  return d->raster->periodic[k] || (cell >= 0 && cell < pixels - 1);
}

static bool still_at(const diffusion *d, int i, int j)
{
  const fg__raster *r = d->raster;
  const size_t at = (size_t)fg__raster_wrap(r, 1, j) * (size_t)r->size[0] +
                    (size_t)fg__raster_wrap(r, 0, i);
  return r->pixel[at] == FG__PIXEL_STILL;
}

static void direct_cell(const diffusion *d, int i, int j)
{
  const fg__raster *r = d->raster;
  const size_t cell = (size_t)(j + 1) * d->cells + (size_t)(i + 1);
  float sum[2] = {0.0F, 0.0F};
  bool still = false;
  for (int n = 0; n < 4; ++n) {
    const float *direction = r->direction[fg__raster_at(r, i + n % 2, j + n / 2)];
    sum[0] += direction[0];
    sum[1] += direction[1];
    still = still || (!r->all_moving && still_at(d, i + n % 2, j + n / 2));
  }
  const float size = sqrtf(sum[0] * sum[0] + sum[1] * sum[1]);
  const bool directed = size > 0.1F && !still; /* of 4: they do not cancel out */
  d->along[0][cell] = directed ? sum[0] / size : 0.0F;
  d->along[1][cell] = directed ? sum[1] / size : 0.0F;
}

static void direct_part(void *argument, const fg__thread *thread)
{
  const diffusion *d = argument;
  int begin, end;
  fg__threads_range(thread, d->rows + 1, 1, &begin, &end);
  for (int j = begin - 1; j < end - 1; ++j)
    for (int i = -1; i < d->columns; ++i)
      direct_cell(d, i, j);
}

static void start_part(void *argument, const fg__thread *thread)
{
  const diffusion *d = argument;
  int begin, end;
  fg__threads_range(thread, d->rows, 1, &begin, &end);
  for (int j = begin; j < end; ++j) {
    const float *noise = d->before + (size_t)j * (size_t)d->columns;
    float *row = d->out + (size_t)j * d->stride;
    for (int i = 0; i < d->columns; ++i)
      row[i + 1] = noise[i] - 0.5F;
    close_row(d, row);
  }
}

/* u_s: neighbours weigh 1, 2, 1 along both axes. */
static void smooth_part(void *argument, const fg__thread *thread)
{
  const diffusion *d = argument;
  int begin, end;
  fg__threads_range(thread, d->rows, 1, &begin, &end);
  for (int j = begin; j < end; ++j) {
    const float *lower = row_of(d, d->now, j - 1), *at = row_of(d, d->now, j),
                *upper = row_of(d, d->now, j + 1);
    float *row = d->out + (size_t)j * d->stride;
    for (int i = 1; i <= d->columns; ++i) {
      const float left = lower[i - 1] + 2.0F * at[i - 1] + upper[i - 1];
      const float middle = lower[i] + 2.0F * at[i] + upper[i];
      const float right = lower[i + 1] + 2.0F * at[i + 1] + upper[i + 1];
      row[i] = (left + 2.0F * middle + right) * 0.0625F;
    }
    close_row(d, row);
  }
}

static void widen_part(void *argument, const fg__thread *thread)
{
  const diffusion *d = argument;
  const float sharp = 1.0F / (edge * edge);
  int begin, end;
  fg__threads_range(thread, d->rows + 1, 1, &begin, &end);
  for (int j = begin - 1; j < end - 1; ++j) {
    const float *lower = row_of(d, d->now, j), *upper = row_of(d, d->now, j + 1);
    float *width = d->width + (size_t)(j + 1) * d->cells;
    for (size_t i = 0; i < d->cells; ++i) {
      const float x = 0.5F * (lower[i + 1] - lower[i] + upper[i + 1] - upper[i]);
      const float y = 0.5F * (upper[i] - lower[i] + upper[i + 1] - lower[i + 1]);
      width[i] = across / (1.0F + sharp * (x * x + y * y));
    }
  }
}

/* A row of cells: sum and difference of half its flux's components, and its part of the
 * checkerboard. */
static void find_flux(const diffusion *d, int j, float *const flux[3])
{
  float *restrict sum = flux[0], *restrict difference = flux[1],
                  *restrict twist = flux[2];
  const float *restrict lower = row_of(d, d->now, j);
  const float *restrict upper = row_of(d, d->now, j + 1);
  const size_t row = (size_t)(j + 1) * d->cells;
  const float *restrict dx = d->along[0] + row, *restrict dy = d->along[1] + row;
  const float *restrict width = d->width + row;
  const size_t cells = d->cells;
  for (size_t i = 0; i < cells; ++i) {
    const float rising = upper[i + 1] - lower[i], falling = lower[i + 1] - upper[i];
    const float x = 0.5F * (rising + falling), y = 0.5F * (rising - falling);
    const float along = (1.0F - width[i]) * (dx[i] * x + dy[i] * y);
    const float flux_x = width[i] * x + along * dx[i];
    const float flux_y = width[i] * y + along * dy[i];
    sum[i] = 0.5F * (flux_x + flux_y);
    difference[i] = 0.5F * (flux_x - flux_y);
    twist[i] = checks * (lower[i] - lower[i + 1] - upper[i] + upper[i + 1]);
  }
  if (!conducts(d, 0, -1))
    for (int n = 0; n < 3; ++n)
      flux[n][0] = flux[n][cells - 1] = 0.0F;
  if (!conducts(d, 1, j))
    for (int n = 0; n < 3; ++n)
      memset(flux[n], 0, cells * sizeof *flux[n]);
}

static void step_row(const diffusion *d, int j, float *const lower[3],
                     float *const upper[3])
{
  const float *restrict now = d->now + (size_t)j * d->stride + 1;
  const float *restrict before = d->before + (size_t)j * d->stride + 1;
  float *restrict out = d->out + (size_t)j * d->stride + 1;
  const float *restrict sum_below = lower[0], *restrict difference_below = lower[1];
  const float *restrict sum = upper[0], *restrict difference = upper[1];
  const float *restrict twist_below = lower[2], *restrict twist = upper[2];
  const stage s = d->stage;
  const float rate = d->rate;
  for (int i = 0; i < d->columns; ++i) {
    const float spread = sum[i + 1] - difference[i] + difference_below[i + 1] -
                         sum_below[i] -
                         (twist[i + 1] - twist[i] - twist_below[i + 1] + twist_below[i]);
    const float u = now[i];
    const float force = rate * (u * (1.0F - u * u));
    out[i] = s.now * u + s.before * before[i] + s.tau * (spread + force);
  }
  close_row(d, d->out + (size_t)j * d->stride);
}

static void stage_part(void *argument, const fg__thread *thread)
{
  const diffusion *d = argument;
  float *own = d->flux + (size_t)thread->index * 6 * d->cells;
  float *rows[2][3];
  for (int n = 0; n < 6; ++n)
    rows[n / 3][n % 3] = own + (size_t)n * d->cells;
  int begin, end;
  fg__threads_range(thread, d->rows, 1, &begin, &end);
  if (begin < end)
    find_flux(d, begin - 1, rows[0]);
  for (int j = begin; j < end; ++j) {
    float *const *lower = rows[(j - begin) % 2], *const *upper =
                                                     rows[(j - begin + 1) % 2];
    find_flux(d, j, upper);
    step_row(d, j, lower, upper);
  }
}

/* s stages are stable up to s^2 times this, for any damping. */
static int stage_count(double tau)
{
  const double root = sqrt(2.0 * damping);
  return (int)ceil(sqrt(tau * stiffest / (2.0 * tanh(root) / root))) + 1;
}

/* One step of length tau from state[0] to state[0]. Chebyshev polynomials T_j and their
 * slopes at w0 by their recurrences. */
static void make_step(diffusion *d, double tau, fg__threads *threads)
{
  const int stages = stage_count(tau);
  const double w0 = 1.0 + damping / ((double)stages * stages);
  double t = w0, t_before = 1.0, slope = 1.0, slope_before = 0.0;
  for (int j = 2; j <= stages; ++j) {
    const double next = 2.0 * w0 * t - t_before;
    const double next_slope = 2.0 * t + 2.0 * w0 * slope - slope_before;
    t_before = t;
    t = next;
    slope_before = slope;
    slope = next_slope;
  }
  const double w1 = t / slope;
  d->stage = (stage){1.0F, 0.0F, (float)(w1 / w0 * tau)};
  d->now = d->before = d->state[0];
  d->out = d->state[1];
  fg__threads_run(threads, stage_part, d);
  t = w0;
  t_before = 1.0;
  for (int j = 2; j <= stages; ++j) {
    const double next = 2.0 * w0 * t - t_before;
    d->stage = (stage){(float)(2.0 * w0 * t / next), (float)(-t_before / next),
                       (float)(2.0 * w1 * t / next * tau)};
    d->before = d->state[(j + 1) % 3];
    d->now = d->state[(j + 2) % 3];
    d->out = d->state[j % 3];
    fg__threads_run(threads, stage_part, d);
    t_before = t;
    t = next;
  }
  float *last = d->state[stages % 3];
  d->state[stages % 3] = d->state[0];
  d->state[0] = last;
}

/* state[1] from state[0]. */
static void smooth(diffusion *d, fg__threads *threads)
{
  d->now = d->state[0];
  d->out = d->state[1];
  fg__threads_run(threads, smooth_part, d);
}

static void update_width(diffusion *d, fg__threads *threads)
{
  smooth(d, threads);
  d->now = d->state[1];
  fg__threads_run(threads, widen_part, d);
}

static void swap(diffusion *d)
{
  float *first = d->state[0];
  d->state[0] = d->state[1];
  d->state[1] = first;
}

/* Noise without what is wider than a streak: it would be left as blotches. `value` is for
 * use on the way. */
static fg_status start(diffusion *d, float *value, fg_context *context,
                       const fg__canvas *canvas)
{
  const size_t padded = (size_t)d->raster->stride * (size_t)d->raster->rows;
  float *grain = fg__allocate(padded, sizeof *grain);
  if (!grain)
    return fg__fail_memory(context, "noise", padded * sizeof *grain);
  fg_status status =
      fg__grain_fill(grain, context, d->raster, canvas->seed, canvas->threads);
  for (int j = 0; j < d->rows && !status; ++j)
    memcpy(value + (size_t)j * (size_t)d->columns, grain + fg__raster_at(d->raster, 0, j),
           (size_t)d->columns * sizeof *value);
  free(grain);
  const double widest = fmax(widest_share * canvas->length, 1.0);
  if (!status)
    status = fg__contrast_even(value, context, d->raster, (int)widest, noise_cut,
                               canvas->threads);
  if (status)
    return status;
  d->before = value;
  d->out = d->state[0];
  fg__threads_run(canvas->threads, start_part, d);
  smooth(d, canvas->threads);
  swap(d);
  fg__threads_run(canvas->threads, direct_part, d);
  return FG_STATUS_OK;
}

static fg_status allocate(diffusion *d, fg_context *context, size_t members)
{
  const size_t pixels = d->stride * (size_t)d->rows;
  const size_t cells = d->cells * ((size_t)d->rows + 1);
  float **of_cells[] = {&d->along[0], &d->along[1], &d->width};
  bool whole = true;
  for (int n = 0; n < 3; ++n) {
    d->state[n] = fg__allocate_aligned(pixels, sizeof *d->state[n]);
    *of_cells[n] = fg__allocate_aligned(cells, sizeof **of_cells[n]);
    whole = whole && d->state[n] && *of_cells[n];
  }
  d->flux = fg__allocate(6 * members * d->cells, sizeof *d->flux);
  if (whole && d->flux)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a diffusion", 3 * (pixels + cells) * sizeof *d->width);
}

static void clear(diffusion *d)
{
  for (int n = 0; n < 3; ++n)
    free(d->state[n]);
  free(d->along[0]);
  free(d->along[1]);
  free(d->width);
  free(d->flux);
}

fg_status fg__diffusion_paint(float *value, fg_context *context, const fg__canvas *canvas)
{
  const fg__raster *r = &canvas->raster;
  const double spread = spread_of_length * canvas->length;
  const double time = 0.5 * spread * spread;
  diffusion d = {.raster = r,
                 .columns = r->size[0],
                 .rows = r->size[1],
                 .stride = (size_t)r->size[0] + 2,
                 .cells = (size_t)r->size[0] + 1,
                 .rate = (float)(growth / time)};
  fg_status status = allocate(&d, context, (size_t)fg__threads_count(canvas->threads));
  if (!status)
    status = start(&d, value, context, canvas);
  for (int n = 0; n < STEPS && !status; ++n) {
    update_width(&d, canvas->threads);
    make_step(&d, time / STEPS, canvas->threads);
    status = fg__check_stop(context);
  }
  if (!status)
    smooth(&d, canvas->threads); /* what is left of the checkerboard */
  for (int j = 0; j < d.rows && !status; ++j)
    for (int i = 0; i < d.columns; ++i)
      value[(size_t)j * (size_t)d.columns + (size_t)i] =
          d.state[1][(size_t)j * d.stride + (size_t)i + 1];
  clear(&d);
  return status;
}

int fg__diffusion_margin(double length)
{
  (void)length;
  return 1;
}
