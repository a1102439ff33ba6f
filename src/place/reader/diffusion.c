#include "place/reader/diffusion.h"

#include "base/memory.h"
#include "place/reader/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A line holds the cells it passes by so much, beside the 1 of each face: soft, so that
 * the error changes smoothly as the line moves. Twice as much or half as much changes
 * E_ang by 2 %. */
static const float HOLD_2D = 6.0F;
static const float HOLD_3D = 30.0F;

/* A window reaches so many lambda beyond the lines. */
static const float MARGIN = 0.6F;

/* Steps of Chebyshev's iteration for a spectral radius that gaps of ten cells between
 * lines have; even, so that the values end where they began. With twice as many the
 * errors of placements stay. */
static const float RADIUS = 0.95F;
enum { STEPS = 8, NEAR_STEPS = 32, WHOLE_STEPS = 80 };

enum { SCALARS = 3, WINDOW_SCALARS = 3, PAD = FG__PLACE_PAD };

/* Counts each cell's faces to other cells of the domain; `inside` is 1 there. */
static void count_faces(fg__place_diffusion *reader, const float *inside)
{
  const fg__place_raster *raster = &reader->raster;
  const size_t step[3] = {1, (size_t)raster->cells[0],
                          (size_t)raster->cells[0] * (size_t)raster->cells[1]};
  size_t n = 0;
  for (int z = 0; z < raster->cells[2]; ++z)
    for (int y = 0; y < raster->cells[1]; ++y)
      for (int x = 0; x < raster->cells[0]; ++x, ++n) {
        const int at[3] = {x, y, z};
        float faces = 0.0F;
        for (int k = 0; k < 3 && k < raster->dimension; ++k) {
          faces += at[k] > 0 ? inside[n - step[k]] : 0.0F;
          faces += at[k] + 1 < raster->cells[k] ? inside[n + step[k]] : 0.0F;
        }
        reader->faces[n] = inside[n] * faces;
      }
}

static void map_domain(fg__place_diffusion *reader, const fg__place_domain *domain,
                       const fg__place_scale *scale)
{
  const fg__place_raster *raster = &reader->raster;
  float *inside = reader->error; /* no errors yet */
  size_t n = 0;
  for (int z = 0; z < raster->cells[2]; ++z)
    for (int y = 0; y < raster->cells[1]; ++y)
      for (int x = 0; x < raster->cells[0]; ++x, ++n) {
        double center[3];
        fg__place_raster_center(center, raster, scale, (const int[3]){x, y, z});
        inside[n] = fg__place_subdomain_at(domain, center) ? 1.0F : 0.0F;
      }
  count_faces(reader, inside);
  memset(inside, 0, raster->count * sizeof *inside);
}

fg_status fg__place_diffusion_create(fg__place_diffusion *out, fg_context *context,
                                     const fg__place_raster *raster,
                                     const fg__place_domain *domain,
                                     const fg__place_scale *scale)
{
  const int dimension = raster->dimension;
  const size_t count = raster->count, arrays = SCALARS + 2 * (size_t)dimension;
  *out = (fg__place_diffusion){.raster = *raster};
  out->hold =
      (dimension == 2 ? HOLD_2D : HOLD_3D) * (float)(scale->sampling / scale->cell);
  out->cells = fg__allocate(count * arrays + PAD, sizeof *out->cells);
  if (!out->cells)
    return fg__fail_memory(context, "a reader by diffusion",
                           count * arrays * sizeof *out->cells);
  out->faces = out->cells;
  out->strength = out->cells + count;
  out->error = out->cells + 2 * count;
  for (int k = 0; k < dimension; ++k) {
    out->source[k] = out->cells + (SCALARS + (size_t)k) * count;
    out->value[k] = out->cells + (SCALARS + (size_t)(dimension + k)) * count;
  }
  map_domain(out, domain, scale);
  return FG_STATUS_OK;
}

void fg__place_window_clear(fg__place_window *window)
{
  free(window->room);
  free(window->run);
  *window = (fg__place_window){.reader = NULL};
}

void fg__place_diffusion_clear(fg__place_diffusion *reader)
{
  free(reader->cells);
  fg__place_window_clear(&reader->window);
  *reader = (fg__place_diffusion){0};
}

/* Arrays over a box of the raster in which lines are held. */
typedef struct held {
  fg__place_box box;
  size_t stride[2];
  float *strength, *source[3];
} held;

/* Adds one corner of the cell-centre square (cube) around a sample. */
static void hold_corner(const held *to, const fg__place_raster *raster, const int at[3],
                        float weight, const fg__place_line *line, int sample)
{
  int in[3];
  for (int k = 0; k < 3; ++k) {
    in[k] = at[k] - to->box.low[k];
    if (in[k] < 0 || in[k] >= to->box.size[k])
      return;
  }
  size_t cell =
      (size_t)in[2] * to->stride[1] + (size_t)in[1] * to->stride[0] + (size_t)in[0];
  to->strength[cell] += weight;
  for (int k = 0; k < raster->dimension; ++k)
    to->source[k][cell] += weight * line->tangent[k][sample];
}

/* Spreads a line's samples linearly over the nearest cells. */
static void hold_line(const held *to, const fg__place_raster *raster,
                      const fg__place_line *line, float strength)
{
  for (int n = 0; n < line->count; ++n) {
    int first[3] = {0};
    float part[3] = {0};
    for (int k = 0; k < raster->dimension; ++k) {
      float x = line->position[k][n] / raster->cell - 0.5F;
      first[k] = (int)floorf(x);
      part[k] = x - (float)first[k];
    }
    for (int corner = 0; corner < 1 << raster->dimension; ++corner) {
      float weight = strength * line->share[n];
      int at[3] = {0};
      for (int k = 0; k < raster->dimension; ++k) {
        int high = corner >> k & 1;
        at[k] = first[k] + high;
        weight *= high ? part[k] : 1.0F - part[k];
      }
      hold_corner(to, raster, at, weight, line, n);
    }
  }
}

static held whole_of(const fg__place_diffusion *reader)
{
  const fg__place_raster *raster = &reader->raster;
  held all = {.strength = reader->strength};
  memcpy(all.box.size, raster->cells, sizeof all.box.size);
  memcpy(all.source, reader->source, sizeof all.source);
  all.stride[0] = (size_t)raster->cells[0];
  all.stride[1] = all.stride[0] * (size_t)raster->cells[1];
  return all;
}

void fg__place_diffusion_add(fg__place_diffusion *reader, const fg__place_line *line)
{
  held all = whole_of(reader);
  hold_line(&all, &reader->raster, line, reader->hold);
}

double fg__place_diffusion_sum(const fg__place_diffusion *reader)
{
  double sum = 0.0;
  for (size_t n = 0; n < reader->raster.count; ++n)
    sum += (double)reader->error[n];
  return sum;
}

/* Lays the window's arrays out for its box. */
static fg_status open_window(fg__place_window *window, fg_context *context,
                             const fg__place_diffusion *reader)
{
  const int dimension = reader->raster.dimension;
  const int *size = window->box.size;
  size_t wide = ((size_t)size[0] + 2 + PAD - 1) / PAD * PAD;
  size_t plane = wide * ((size_t)size[1] + 2);
  size_t deep = dimension == 3 ? (size_t)size[2] + 2 : 1;
  /* a row is read in whole vectors, from one cell before to one behind */
  size_t needed = plane * deep + 2 * PAD, count = fg__place_array_stride(needed);
  size_t arrays = WINDOW_SCALARS + 3 * (size_t)dimension;
  window->reader = reader;
  window->stride[0] = wide;
  window->stride[1] = plane;
  window->origin = 1 + wide + (dimension == 3 ? plane : 0);
  if (window->capacity < count * arrays) {
    free(window->room);
    window->capacity = count * arrays + count * arrays / 4;
    window->room = fg__allocate_aligned(window->capacity, sizeof *window->room);
    if (!window->room) {
      window->capacity = 0;
      return fg__fail_memory(context, "a window of a reader by diffusion",
                             count * arrays * sizeof *window->room);
    }
  }
  /* of a row's vectors every other one may begin a run */
  const size_t runs = (wide / PAD + 1) / 2 * (size_t)size[1] * (size_t)size[2];
  if (!fg__grow((void **)&window->run, &window->run_capacity, runs, sizeof *window->run))
    return fg__fail_memory(context, "runs of cells", runs * sizeof *window->run);
  float *next = window->room;
  float **const scalars[WINDOW_SCALARS] = {&window->inverse, &window->strength,
                                           &window->error};
  for (int k = 0; k < WINDOW_SCALARS; ++k, next += count)
    *scalars[k] = next;
  for (int k = 0; k < dimension; ++k, next += 3 * count) {
    window->source[k] = next;
    window->value[k] = next + count;
    window->last[k] = next + 2 * count;
    memset(window->value[k], 0, needed * sizeof *next);
    memset(window->last[k], 0, needed * sizeof *next);
  }
  return FG_STATUS_OK;
}

/* Where a row of the box begins, in the raster and in the window. */
typedef struct row_place {
  size_t raster, window;
} row_place;

static row_place row_at(const fg__place_window *window, int y, int z)
{
  const int *cells = window->reader->raster.cells, *low = window->box.low;
  return (row_place){((size_t)(low[2] + z) * (size_t)cells[1] + (size_t)(low[1] + y)) *
                             (size_t)cells[0] +
                         (size_t)low[0],
                     window->origin + (size_t)z * window->stride[1] +
                         (size_t)y * window->stride[0]};
}

static bool has_row(const fg__place_raster *raster, int y, int z)
{
  return y >= 0 && y < raster->cells[1] && z >= 0 && z < raster->cells[2];
}

/* Copies the reader's field into the window, with the cells around it, which stay. */
static void copy_values(const fg__place_window *window)
{
  const fg__place_diffusion *reader = window->reader;
  const fg__place_raster *raster = &reader->raster;
  const fg__place_box *box = &window->box;
  int before = box->low[0] > 0 ? 1 : 0;
  int behind = box->low[0] + box->size[0] < raster->cells[0] ? 1 : 0;
  int deep = raster->dimension == 3 ? 1 : 0;
  size_t bytes = (size_t)(before + box->size[0] + behind) * sizeof(float);
  for (int z = -deep; z < box->size[2] + deep; ++z)
    for (int y = -1; y <= box->size[1]; ++y) {
      if (!has_row(raster, box->low[1] + y, box->low[2] + z))
        continue;
      size_t from = ((size_t)(box->low[2] + z) * (size_t)raster->cells[1] +
                     (size_t)(box->low[1] + y)) *
                        (size_t)raster->cells[0] +
                    (size_t)(box->low[0] - before);
      size_t to = (size_t)(z + deep) * window->stride[1] +
                  (size_t)(y + 1) * window->stride[0] + (size_t)(1 - before);
      for (int k = 0; k < raster->dimension; ++k) {
        memcpy(window->value[k] + to, reader->value[k] + from, bytes);
        memcpy(window->last[k] + to, reader->value[k] + from, bytes);
      }
    }
}

static void copy_lines(const fg__place_window *window)
{
  const fg__place_diffusion *reader = window->reader;
  const fg__place_box *box = &window->box;
  size_t bytes = (size_t)box->size[0] * sizeof(float);
  for (int z = 0; z < box->size[2]; ++z)
    for (int y = 0; y < box->size[1]; ++y) {
      row_place at = row_at(window, y, z);
      memcpy(window->strength + at.window, reader->strength + at.raster, bytes);
      for (int k = 0; k < reader->raster.dimension; ++k)
        memcpy(window->source[k] + at.window, reader->source[k] + at.raster, bytes);
    }
}

static fg__place_window_rows rows_of(const fg__place_window *window)
{
  fg__place_window_rows rows = {.dimension = window->reader->raster.dimension,
                                .stride = {window->stride[0], window->stride[1]},
                                .origin = window->origin,
                                .inverse = window->inverse,
                                .run = window->run,
                                .run_count = window->run_count};
  memcpy(rows.size, window->box.size, sizeof rows.size);
  for (int k = 0; k < 3; ++k) {
    rows.value[k] = window->value[k];
    rows.last[k] = window->last[k];
    rows.source[k] = window->source[k];
  }
  return rows;
}

static bool is_of_domain(const float *inverse, int count)
{
  float sum = 0.0F;
  for (int n = 0; n < count; ++n)
    sum += inverse[n];
  return sum > 0.0F;
}

/* Adds the runs of a row, in whole vectors. */
static void add_runs(fg__place_window *window, size_t row)
{
  const int length = window->box.size[0];
  bool before = false;
  for (int first = 0; first < length; first += PAD) {
    const int count = length - first < PAD ? length - first : PAD;
    const bool active = is_of_domain(window->inverse + row + first, count);
    if (active && before)
      window->run[window->run_count - 1].count += count;
    else if (active)
      window->run[window->run_count++] = (fg__place_run){row + (size_t)first, count};
    before = active;
  }
}

/* Chebyshev's semi-iteration on Jacobi's (Golub and Varga 1961). */
static void iterate(fg__place_window *window, int steps)
{
  const float square = RADIUS * RADIUS;
  float omega = 1.0F;
  for (int step = 0; step < steps; ++step) {
    const fg__place_window_rows rows = rows_of(window);
    fg__place_diffuse_rows(&rows, omega);
    for (int k = 0; k < 3; ++k) {
      window->last[k] = rows.value[k];
      window->value[k] = rows.last[k];
    }
    omega = 1.0F / (1.0F - (step == 0 ? 0.5F : 0.25F * omega) * square);
  }
}

/* Solves in the window; the growth of its errors' sum. */
static double solve_window(fg__place_window *window, int steps)
{
  const fg__place_diffusion *reader = window->reader;
  const fg__place_raster *raster = &reader->raster;
  const size_t row = (size_t)raster->cells[0], plane = row * (size_t)raster->cells[1];
  const fg__place_raster_rows at = {{row, plane}, row_at(window, 0, 0).raster};
  fg__place_window_rows rows = rows_of(window);
  fg__place_inverse_rows(&rows, window->strength, &at, reader->faces);
  window->run_count = 0;
  for (int z = 0; z < window->box.size[2]; ++z)
    for (int y = 0; y < window->box.size[1]; ++y)
      add_runs(window, row_at(window, y, z).window);
  iterate(window, steps);
  rows = rows_of(window);
  return fg__place_angle_rows(window->error, &rows, &at, raster, reader->error);
}

/* Takes the window's solution over. */
static void copy_back(const fg__place_window *window)
{
  const fg__place_diffusion *reader = window->reader;
  const fg__place_box *box = &window->box;
  size_t bytes = (size_t)box->size[0] * sizeof(float);
  for (int z = 0; z < box->size[2]; ++z)
    for (int y = 0; y < box->size[1]; ++y) {
      row_place at = row_at(window, y, z);
      memcpy(reader->error + at.raster, window->error + at.window, bytes);
      for (int k = 0; k < reader->raster.dimension; ++k)
        memcpy(reader->value[k] + at.raster, window->value[k] + at.window, bytes);
    }
}

fg_status fg__place_diffusion_solve(fg__place_diffusion *reader, fg_context *context,
                                    bool near)
{
  fg__place_window *window = &reader->window;
  memset(window->box.low, 0, sizeof window->box.low);
  memcpy(window->box.size, reader->raster.cells, sizeof window->box.size);
  fg_status status = open_window(window, context, reader);
  if (status != FG_STATUS_OK)
    return status;
  copy_values(window);
  copy_lines(window);
  solve_window(window, near ? NEAR_STEPS : WHOLE_STEPS);
  copy_back(window);
  return FG_STATUS_OK;
}

fg_status fg__place_diffusion_try(double *growth, fg__place_window *window,
                                  const fg__place_diffusion *reader, fg_context *context,
                                  const fg__place_line *from, const fg__place_line *to)
{
  const int dimension = reader->raster.dimension;
  const fg__place_line *const lines[2] = {from, to};
  window->box = (fg__place_box){{0}, {0}};
  for (int n = 0; n < 2; ++n)
    if (lines[n]) {
      fg__place_box box = fg__place_box_around(&reader->raster, lines[n], MARGIN);
      fg__place_box_widen(&window->box, &box);
    }
  *growth = 0.0;
  fg_status status = open_window(window, context, reader);
  if (status != FG_STATUS_OK || fg__place_box_count(&window->box) == 0)
    return status;
  copy_values(window);
  copy_lines(window);
  held room = {.box = window->box,
               .stride = {window->stride[0], window->stride[1]},
               .strength = window->strength + window->origin};
  for (int k = 0; k < dimension; ++k)
    room.source[k] = window->source[k] + window->origin;
  if (from)
    hold_line(&room, &reader->raster, from, -reader->hold);
  if (to)
    hold_line(&room, &reader->raster, to, reader->hold);
  *growth = solve_window(window, STEPS);
  return FG_STATUS_OK;
}

void fg__place_diffusion_keep(fg__place_diffusion *reader, const fg__place_window *window,
                              const fg__place_line *from, const fg__place_line *to)
{
  held all = whole_of(reader);
  copy_back(window);
  if (from)
    hold_line(&all, &reader->raster, from, -reader->hold);
  if (to)
    hold_line(&all, &reader->raster, to, reader->hold);
}
