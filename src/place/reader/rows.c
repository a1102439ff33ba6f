#include "place/reader/rows.h"

#include "base/clones.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Square of epsilon in lambda: of the inverse distance, as the score has it. */
#define PULL_EPSILON 0.0025F

#define INLINE static inline __attribute__((always_inline))

/* Where the array of the sum begins. */
INLINE int pull_array(const int dimension)
{
  return FG__PLACE_NEAR + dimension;
}

/* Sixteen cells at once; narrower instructions take them in pieces. */
enum { WIDTH = FG__PLACE_PAD };
typedef float vector __attribute__((vector_size(64)));
typedef double wide __attribute__((vector_size(128)));
typedef int32_t mask __attribute__((vector_size(64)));

INLINE vector load(const float *from)
{
  vector out;
  memcpy(&out, from, sizeof out);
  return out;
}

INLINE void store(float *to, vector from)
{
  memcpy(to, &from, sizeof from);
}

INLINE vector choose(mask which, vector yes, vector no)
{
  return (vector)((which & (mask)yes) | (~which & (mask)no));
}

/* The first `count` lanes, from a table: GCC compiles a comparison whose result is not
 * used in a choice lane by lane. */
INLINE mask lanes_below(int count)
{
  static const int32_t table[2 * WIDTH] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                           -1, -1, -1, -1, -1, -1, -1, -1};
  mask lanes;
  count = count < 0 ? 0 : count < WIDTH ? count : WIDTH;
  memcpy(&lanes, table + WIDTH - count, sizeof lanes);
  return lanes;
}

INLINE vector root(vector of)
{
  float lane[WIDTH];
  store(lane, of);
  for (int k = 0; k < WIDTH; ++k)
    lane[k] = sqrtf(lane[k]);
  return load(lane);
}

INLINE double sum_of(wide sums)
{
  double sum = 0.0;
  for (int k = 0; k < WIDTH; ++k)
    sum += sums[k];
  return sum;
}

/* Where row (y, z) of the raster begins in a contribution, which has it. */
INLINE size_t row_in(const fg__place_contribution *in, int y, int z)
{
  const fg__place_box *box = &in->box;
  return ((size_t)(z - box->low[2]) * (size_t)box->size[1] + (size_t)(y - box->low[1])) *
         (size_t)box->size[0];
}

INLINE size_t row_of_raster(const fg__place_raster *raster, int y, int z)
{
  return ((size_t)z * (size_t)raster->cells[1] + (size_t)y) * (size_t)raster->cells[0];
}

/* The position of a row of cells, in lambda. */
typedef struct row_place {
  float x, y, z; /* its low end, its middle */
  float cell, reach;
} row_place;

/* For some cells the square of the distance to the line's nearest sample, and its
 * tangent. */
typedef struct line_values {
  vector near, tangent[3];
} line_values;

/* `x` of the cells from the row's low end; `aside` is the square of the sample's distance
 * to the row. */
INLINE void take_sample(const int dimension, line_values *out, vector x,
                        const fg__place_line *line, int n, float aside,
                        const row_place *row)
{
  const vector zero = {0};
  vector dx = x - (line->position[0][n] - row->x);
  vector square = dx * dx + aside;
  mask nearer = square < out->near;
  out->near = choose(nearer, square, out->near);
  for (int k = 0; k < dimension; ++k)
    out->tangent[k] = choose(nearer, zero + line->tangent[k][n], out->tangent[k]);
}

/* The contribution of a line to WIDTH cells of a row: the nearest sample's square and
 * tangent, and that tangent weighted by the inverse distance. */
INLINE void contribute_cells(const int dimension, float *value, size_t stride, int first,
                             const fg__place_line *line, const row_place *row)
{
  static const float steps[WIDTH] = {0, 1, 2,  3,  4,  5,  6,  7,
                                     8, 9, 10, 11, 12, 13, 14, 15};
  const float reach_square = row->reach * row->reach;
  line_values out = {.near = (vector){0} + reach_square};
  vector x = (load(steps) + ((float)first + 0.5F)) * row->cell;
  for (int n = 0; n < line->count; ++n) {
    float dy = row->y - line->position[1][n];
    float dz = dimension == 3 ? row->z - line->position[2][n] : 0.0F;
    float aside = dy * dy + dz * dz;
    if (aside < reach_square)
      take_sample(dimension, &out, x, line, n, aside, row);
  }
  vector q = out.near + PULL_EPSILON;
  vector power = dimension == 2 ? q * root(q) : q * q;
  vector f = 1.0F - out.near * (1.0F / reach_square); /* (1 - d^2 / R^2)^2, 0 beyond R */
  f = choose(f > 0.0F, f, (vector){0});
  vector weight = f * f / power;
  store(value + first, out.near);
  for (int k = 0; k < dimension; ++k) {
    store(value + (size_t)(FG__PLACE_NEAR + k) * stride + first, out.tangent[k]);
    store(value + (size_t)(pull_array(dimension) + k) * stride + first,
          weight * out.tangent[k]);
  }
}

INLINE void contribute_rows(const int dimension, fg__place_contribution *to,
                            const fg__place_raster *raster, const fg__place_line *line,
                            float reach)
{
  const fg__place_box *box = &to->box;
  row_place row = {
      .x = (float)box->low[0] * raster->cell, .cell = raster->cell, .reach = reach};
  float *value = to->value;
  for (int z = 0; z < box->size[2]; ++z)
    for (int y = 0; y < box->size[1]; ++y, value += box->size[0]) {
      row.y = ((float)(box->low[1] + y) + 0.5F) * raster->cell;
      row.z = ((float)(box->low[2] + z) + 0.5F) * raster->cell;
      /* what is written beyond a row's end, the next row overwrites */
      for (int first = 0; first < box->size[0]; first += WIDTH)
        contribute_cells(dimension, value, to->capacity, first, line, &row);
    }
}

FG__CLONES static void contribute_2d(fg__place_contribution *to,
                                     const fg__place_raster *raster,
                                     const fg__place_line *line, float reach)
{
  contribute_rows(2, to, raster, line, reach);
}

FG__CLONES static void contribute_3d(fg__place_contribution *to,
                                     const fg__place_raster *raster,
                                     const fg__place_line *line, float reach)
{
  contribute_rows(3, to, raster, line, reach);
}

void fg__place_contribute_rows(fg__place_contribution *to, const fg__place_raster *raster,
                               const fg__place_line *line, float reach)
{
  (raster->dimension == 2 ? contribute_2d : contribute_3d)(to, raster, line, reach);
}

/* The sum of contributions in some cells. */
typedef struct cell_values {
  vector value[FG__PLACE_ARRAYS(3)];
} cell_values;

/* Adds a contribution's values, in the cells of `have`. */
INLINE void join(const int dimension, cell_values *to, const float *value, size_t stride,
                 mask have)
{
  vector square = choose(have, load(value), to->value[0]);
  mask nearer = square < to->value[0];
  to->value[0] = choose(nearer, square, to->value[0]);
  for (int k = FG__PLACE_NEAR; k < pull_array(dimension); ++k)
    to->value[k] = choose(nearer, load(value + (size_t)k * stride), to->value[k]);
  for (int k = pull_array(dimension); k < FG__PLACE_ARRAYS(dimension); ++k)
    to->value[k] += (vector)(have & (mask)load(value + (size_t)k * stride));
}

INLINE void add_rows(const int dimension, fg__place_contribution *to,
                     const fg__place_contribution *from, const fg__place_box *box)
{
  for (int z = box->low[2]; z < box->low[2] + box->size[2]; ++z)
    for (int y = box->low[1]; y < box->low[1] + box->size[1]; ++y) {
      float *mine = to->value + row_in(to, y, z) + (box->low[0] - to->box.low[0]);
      const float *other =
          from->value + row_in(from, y, z) + (box->low[0] - from->box.low[0]);
      for (int i = 0; i < box->size[0]; i += WIDTH) {
        cell_values all = {{{0}}};
        for (int k = 0; k < FG__PLACE_ARRAYS(dimension); ++k)
          all.value[k] = load(mine + (size_t)k * to->capacity + i);
        join(dimension, &all, other + i, from->capacity, lanes_below(box->size[0] - i));
        for (int k = 0; k < FG__PLACE_ARRAYS(dimension); ++k)
          store(mine + (size_t)k * to->capacity + i, all.value[k]);
      }
    }
}

FG__CLONES static void add_2d(fg__place_contribution *to,
                              const fg__place_contribution *from,
                              const fg__place_box *box)
{
  add_rows(2, to, from, box);
}

FG__CLONES static void add_3d(fg__place_contribution *to,
                              const fg__place_contribution *from,
                              const fg__place_box *box)
{
  add_rows(3, to, from, box);
}

void fg__place_add_rows(fg__place_contribution *to, const fg__place_contribution *from,
                        const fg__place_box *box)
{
  (to->dimension == 2 ? add_2d : add_3d)(to, from, box);
}

/* Degrees between a vector and a unit one; 90 for no vector. arccos by Abramowitz and
 * Stegun 4.4.45, in degrees, to 0.004. */
INLINE vector angle_to(const int dimension, const vector value[3],
                       const vector direction[3])
{
  vector square = value[0] * value[0] + value[1] * value[1];
  vector dot = value[0] * direction[0] + value[1] * direction[1];
  if (dimension == 3) {
    square += value[2] * value[2];
    dot += value[2] * direction[2];
  }
  vector cosine = dot / root(square + 1e-30F);
  vector a = choose(cosine < 0.0F, -cosine, cosine);
  a = choose(a < 1.0F, a, (vector){0} + 1.0F);
  vector angle = root(1.0F - a) *
                 (89.996090F + a * (-12.153260F + a * (4.2548420F + a * -1.0731100F)));
  return choose(cosine < 0.0F, 180.0F - angle, angle);
}

/* A contribution's cells in a row, from cell `first` on. */
typedef struct contribution_row {
  const float *value; /* NULL: none */
  size_t stride;
  int first, end;
} contribution_row;

INLINE contribution_row row_of(const fg__place_contribution *part, int low, int y, int z)
{
  contribution_row row = {0};
  if (!part || part->box.size[0] == 0 || y < part->box.low[1] ||
      y >= part->box.low[1] + part->box.size[1] || z < part->box.low[2] ||
      z >= part->box.low[2] + part->box.size[2])
    return row;
  row.first = part->box.low[0] - low;
  row.end = row.first + part->box.size[0];
  row.stride = part->capacity;
  row.value = part->value + row_in(part, y, z);
  return row;
}

/* Weighted errors of cells i to i + WIDTH of a row of a box. */
INLINE vector cost_cells(const int dimension, int i, const fg__place_raster *raster,
                         size_t cell, const contribution_row rows[2],
                         const fg__place_weights *weights)
{
  cell_values all = {{{0}}};
  vector direction[3] = {{0}};
  all.value[0] += weights->reach * weights->reach;
  for (int n = 0; n < 2; ++n)
    if (rows[n].value && rows[n].first < i + WIDTH && rows[n].end > i)
      join(dimension, &all, rows[n].value + (i - rows[n].first), rows[n].stride,
           lanes_below(rows[n].end - i) & ~lanes_below(rows[n].first - i));
  for (int k = 0; k < dimension; ++k)
    direction[k] = load(raster->direction[k] + cell);
  vector angles = angle_to(dimension, all.value + FG__PLACE_NEAR, direction) +
                  angle_to(dimension, all.value + pull_array(dimension), direction);
  return load(raster->weight + cell) *
         (angles * weights->inverse_error + weights->far * all.value[0]);
}

INLINE double cost_rows(const int dimension, float *cost, const fg__place_raster *raster,
                        const fg__place_box *box,
                        const fg__place_contribution *const parts[2],
                        const fg__place_weights *weights)
{
  wide sums = {0};
  for (int z = box->low[2]; z < box->low[2] + box->size[2]; ++z)
    for (int y = box->low[1]; y < box->low[1] + box->size[1]; ++y) {
      const contribution_row rows[2] = {row_of(parts[0], box->low[0], y, z),
                                        row_of(parts[1], box->low[0], y, z)};
      size_t cell = row_of_raster(raster, y, z) + (size_t)box->low[0];
      for (int i = 0; i < box->size[0]; i += WIDTH) {
        int count = box->size[0] - i < WIDTH ? box->size[0] - i : WIDTH;
        vector cells = cost_cells(dimension, i, raster, cell + (size_t)i, rows, weights);
        cells = (vector)(lanes_below(count) & (mask)cells);
        sums += __builtin_convertvector(cells, wide);
        if (cost) {
          memcpy(cost, &cells, (size_t)count * sizeof *cost);
          cost += count;
        }
      }
    }
  return sum_of(sums);
}

FG__CLONES static double cost_2d(float *cost, const fg__place_raster *raster,
                                 const fg__place_box *box,
                                 const fg__place_contribution *const parts[2],
                                 const fg__place_weights *weights)
{
  return cost_rows(2, cost, raster, box, parts, weights);
}

FG__CLONES static double cost_3d(float *cost, const fg__place_raster *raster,
                                 const fg__place_box *box,
                                 const fg__place_contribution *const parts[2],
                                 const fg__place_weights *weights)
{
  return cost_rows(3, cost, raster, box, parts, weights);
}

double fg__place_cost_rows(float *cost, const fg__place_raster *raster,
                           const fg__place_box *box,
                           const fg__place_contribution *const parts[2],
                           const fg__place_weights *weights)
{
  return (raster->dimension == 2 ? cost_2d : cost_3d)(cost, raster, box, parts, weights);
}

INLINE size_t row_of_window(const fg__place_window_rows *window, int y, int z)
{
  return window->origin + (size_t)z * window->stride[1] + (size_t)y * window->stride[0];
}

INLINE void diffuse_rows(const int dimension, const fg__place_window_rows *window,
                         float omega)
{
  const size_t row = window->stride[0], plane = window->stride[1];
  for (size_t n = 0; n < window->run_count; ++n)
    for (int i = 0; i < window->run[n].count; i += WIDTH) {
      size_t cell = window->run[n].first + (size_t)i;
      mask inside = lanes_below(window->run[n].count - i);
      vector inverse = load(window->inverse + cell);
      for (int k = 0; k < dimension; ++k) {
        const float *at = window->value[k] + cell;
        float *out = window->last[k] + cell;
        vector sum = load(at - 1) + load(at + 1) + load(at - row) + load(at + row);
        if (dimension == 3)
          sum += load(at - plane) + load(at + plane);
        vector before = load(out);
        vector change = (sum + load(window->source[k] + cell)) * inverse - before;
        store(out, choose(inside, before + omega * change, before));
      }
    }
}

FG__CLONES static void diffuse_2d(const fg__place_window_rows *window, float omega)
{
  diffuse_rows(2, window, omega);
}

FG__CLONES static void diffuse_3d(const fg__place_window_rows *window, float omega)
{
  diffuse_rows(3, window, omega);
}

void fg__place_diffuse_rows(const fg__place_window_rows *window, float omega)
{
  (window->dimension == 2 ? diffuse_2d : diffuse_3d)(window, omega);
}

FG__CLONES void fg__place_inverse_rows(const fg__place_window_rows *window,
                                       const float *strength,
                                       const fg__place_raster_rows *at,
                                       const float *faces)
{
  for (int z = 0; z < window->size[2]; ++z)
    for (int y = 0; y < window->size[1]; ++y) {
      size_t to = row_of_window(window, y, z);
      size_t from = at->origin + (size_t)z * at->stride[1] + (size_t)y * at->stride[0];
      for (size_t i = 0; i < (size_t)window->size[0]; i += WIDTH) {
        vector sides = load(faces + from + i);
        vector inverse = 1.0F / (sides + load(strength + to + i));
        store(window->inverse + to + i, choose(sides > 0.0F, inverse, (vector){0}));
      }
    }
}

INLINE double angle_rows(const int dimension, float *error,
                         const fg__place_window_rows *window,
                         const fg__place_raster_rows *at, const fg__place_raster *raster,
                         const float *before)
{
  wide sums = {0};
  for (int z = 0; z < window->size[2]; ++z)
    for (int y = 0; y < window->size[1]; ++y) {
      size_t row = row_of_window(window, y, z);
      size_t from = at->origin + (size_t)z * at->stride[1] + (size_t)y * at->stride[0];
      for (int i = 0; i < window->size[0]; i += WIDTH) {
        vector value[3] = {{0}}, direction[3] = {{0}};
        size_t cell = from + (size_t)i, in = row + (size_t)i;
        for (int k = 0; k < dimension; ++k) {
          value[k] = load(window->value[k] + in);
          direction[k] = load(raster->direction[k] + cell);
        }
        vector angles =
            load(raster->weight + cell) * angle_to(dimension, value, direction);
        vector growth = angles - load(before + cell);
        store(error + in, angles);
        growth = (vector)(lanes_below(window->size[0] - i) & (mask)growth);
        sums += __builtin_convertvector(growth, wide);
      }
    }
  return sum_of(sums);
}

FG__CLONES static double angle_2d(float *error, const fg__place_window_rows *window,
                                  const fg__place_raster_rows *at,
                                  const fg__place_raster *raster, const float *before)
{
  return angle_rows(2, error, window, at, raster, before);
}

FG__CLONES static double angle_3d(float *error, const fg__place_window_rows *window,
                                  const fg__place_raster_rows *at,
                                  const fg__place_raster *raster, const float *before)
{
  return angle_rows(3, error, window, at, raster, before);
}

double fg__place_angle_rows(float *error, const fg__place_window_rows *window,
                            const fg__place_raster_rows *at,
                            const fg__place_raster *raster, const float *before)
{
  return (window->dimension == 2 ? angle_2d : angle_3d)(error, window, at, raster,
                                                        before);
}

INLINE void nearest_points(const int dimension, float *square, const fg__place_line *line,
                           const float *position, size_t stride, int count)
{
  for (int n = 0; n < line->count; ++n) {
    vector least = (vector){0} + 1e18F;
    for (int i = 0; i < count; i += WIDTH) {
      vector sum = {0};
      for (int k = 0; k < dimension; ++k) {
        vector way = load(position + (size_t)k * stride + i) - line->position[k][n];
        sum += way * way;
      }
      least = choose(sum < least, sum, least);
    }
    square[n] = least[0];
    for (int k = 1; k < WIDTH; ++k)
      square[n] = least[k] < square[n] ? least[k] : square[n];
  }
}

FG__CLONES static void nearest_2d(float *square, const fg__place_line *line,
                                  const float *position, size_t stride, int count)
{
  nearest_points(2, square, line, position, stride, count);
}

FG__CLONES static void nearest_3d(float *square, const fg__place_line *line,
                                  const float *position, size_t stride, int count)
{
  nearest_points(3, square, line, position, stride, count);
}

void fg__place_nearest_points(int dimension, float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count)
{
  (dimension == 2 ? nearest_2d : nearest_3d)(square, line, position, stride, count);
}
