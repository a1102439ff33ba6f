#include "place/reader/rows.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Square of epsilon in lambda: of the inverse distance, as the score has it. */
#define PULL_EPSILON 0.0025F

enum { LANES = 8, MOST_CELLS = 64 };

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && defined(__GNUC__) &&        \
    !defined(__clang__)
#define CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define CLONES
#endif
#define INLINE static inline __attribute__((always_inline))

/* Where the array of the sum begins. */
INLINE int pull_array(const int dimension)
{
  return FG__PLACE_NEAR + dimension;
}

/* (1 - d^2 / R^2)^2, 0 beyond R. */
INLINE float taper(float square, float inverse_square)
{
  float f = 1.0F - square * inverse_square;
  f = f > 0.0F ? f : 0.0F;
  return f * f;
}

/* Sixteen cells at once; narrower instructions take them in pieces. */
typedef float vector __attribute__((vector_size(64)));
typedef int32_t mask __attribute__((vector_size(64)));
enum { WIDTH = 16 };

INLINE vector load(const float *from)
{
  vector out;
  memcpy(&out, from, sizeof out);
  return out;
}

/* The first `count` of a vector. */
INLINE void store(float *to, vector from, int count)
{
  memcpy(to, &from, (size_t)count * sizeof *to);
}

INLINE vector choose(mask which, vector yes, vector no)
{
  return (vector)((which & (mask)yes) | (~which & (mask)no));
}

/* What a line tells some cells: the nearest sample's tangent. */
typedef struct line_told {
  vector near, tangent[3];
} line_told;

/* `x` of the cells from the row's low end; `aside` is the square of the sample's distance
 * to the row. */
INLINE void tell_sample(const int dimension, line_told *out, vector x,
                        const fg__place_line *line, int n, float aside,
                        const fg__place_row_place *row)
{
  const vector zero = {0};
  vector dx = x - (line->position[0][n] - row->x);
  vector square = dx * dx + aside;
  mask nearer = square < out->near;
  out->near = choose(nearer, square, out->near);
  for (int k = 0; k < dimension; ++k)
    out->tangent[k] = choose(nearer, zero + line->tangent[k][n], out->tangent[k]);
}

INLINE void tell_cells(const int dimension, float *value, size_t stride, int first,
                       int count, const fg__place_line *line,
                       const fg__place_row_place *row)
{
  static const float steps[WIDTH] = {0, 1, 2,  3,  4,  5,  6,  7,
                                     8, 9, 10, 11, 12, 13, 14, 15};
  line_told out = {.near = (vector){0} + row->reach * row->reach};
  vector x = (load(steps) + ((float)first + 0.5F)) * row->cell;
  for (int n = 0; n < line->count; ++n) {
    float dy = row->y - line->position[1][n];
    float dz = dimension == 3 ? row->z - line->position[2][n] : 0.0F;
    float aside = dy * dy + dz * dz;
    if (aside < row->reach * row->reach)
      tell_sample(dimension, &out, x, line, n, aside, row);
  }
  int cells = count - first < WIDTH ? count - first : WIDTH;
  store(value + first, out.near, cells);
  for (int k = 0; k < dimension; ++k)
    store(value + (size_t)(FG__PLACE_NEAR + k) * stride + first, out.tangent[k], cells);
}

/* Each sample tells the cells of the row that lie within its reach. */
INLINE void tell_row(const int dimension, float *restrict value, size_t stride, int count,
                     const fg__place_line *line, const fg__place_row_place *row)
{
  for (int first = 0; first < count; first += WIDTH)
    tell_cells(dimension, value, stride, first, count, line, row);
  for (int i = 0; i < count; ++i) { /* the pull of the icon as a whole */
    float square = value[i], q = square + PULL_EPSILON;
    float power = dimension == 2 ? q * sqrtf(q) : q * q;
    float weight = taper(square, row->inverse_square) / power;
    for (int k = 0; k < dimension; ++k)
      value[(size_t)(pull_array(dimension) + k) * stride + (size_t)i] =
          weight * value[(size_t)(FG__PLACE_NEAR + k) * stride + (size_t)i];
  }
}

CLONES static void tell_2d(float *value, size_t stride, int count,
                           const fg__place_line *line, const fg__place_row_place *row)
{
  tell_row(2, value, stride, count, line, row);
}

CLONES static void tell_3d(float *value, size_t stride, int count,
                           const fg__place_line *line, const fg__place_row_place *row)
{
  tell_row(3, value, stride, count, line, row);
}

void fg__place_tell_row(int dimension, float *value, size_t stride, int count,
                        const fg__place_line *line, const fg__place_row_place *row)
{
  (dimension == 2 ? tell_2d : tell_3d)(value, stride, count, line, row);
}

INLINE void add_row(const int dimension, float *restrict to, size_t to_stride,
                    const float *restrict from, size_t from_stride, int count)
{
  for (int k = 0; k < dimension; ++k) {
    float *restrict mine = to + (size_t)(FG__PLACE_NEAR + k) * to_stride;
    const float *restrict other = from + (size_t)(FG__PLACE_NEAR + k) * from_stride;
    for (int i = 0; i < count; ++i)
      mine[i] = from[i] < to[i] ? other[i] : mine[i];
  }
  for (int i = 0; i < count; ++i)
    to[i] = from[i] < to[i] ? from[i] : to[i];
  for (int k = pull_array(dimension); k < FG__PLACE_ARRAYS(dimension); ++k) {
    float *restrict mine = to + (size_t)k * to_stride;
    const float *restrict other = from + (size_t)k * from_stride;
    for (int i = 0; i < count; ++i)
      mine[i] += other[i];
  }
}

CLONES static void add_2d(float *to, size_t to_stride, const float *from,
                          size_t from_stride, int count)
{
  add_row(2, to, to_stride, from, from_stride, count);
}

CLONES static void add_3d(float *to, size_t to_stride, const float *from,
                          size_t from_stride, int count)
{
  add_row(3, to, to_stride, from, from_stride, count);
}

void fg__place_add_row(int dimension, float *to, size_t to_stride, const float *from,
                       size_t from_stride, int count)
{
  (dimension == 2 ? add_2d : add_3d)(to, to_stride, from, from_stride, count);
}

/* Degrees between a vector and a unit one; 90 for no vector. arccos by Abramowitz and
 * Stegun 4.4.45, in degrees, to 0.004. */
INLINE float angle_to(const int dimension, float x, float y, float z, float vx, float vy,
                      float vz)
{
  float square = x * x + y * y, dot = x * vx + y * vy;
  if (dimension == 3) {
    square += z * z;
    dot += z * vz;
  }
  float cosine = dot / sqrtf(square + 1e-30F);
  float a = cosine < 0.0F ? -cosine : cosine;
  a = a < 1.0F ? a : 1.0F;
  float angle = sqrtf(1.0F - a) *
                (89.996090F + a * (-12.153260F + a * (4.2548420F + a * -1.0731100F)));
  return cosine < 0.0F ? 180.0F - angle : angle;
}

/* Cells as a row is priced: what is told there, gathered from both parts. */
typedef struct gathered {
  float value[FG__PLACE_ARRAYS(3)][MOST_CELLS];
} gathered;

INLINE void gather(const int dimension, gathered *out, int first, int count,
                   float reach_square, const fg__place_told_row parts[2])
{
  for (int i = 0; i < count; ++i)
    out->value[0][i] = reach_square;
  for (int k = 1; k < FG__PLACE_ARRAYS(dimension); ++k)
    for (int i = 0; i < count; ++i)
      out->value[k][i] = 0.0F;
  for (int n = 0; n < 2; ++n) {
    const fg__place_told_row *part = &parts[n];
    int from = part->first > first ? part->first : first;
    int end = part->first + part->count;
    end = end < first + count ? end : first + count;
    if (!part->value || from >= end)
      continue;
    const float *restrict value = part->value + (from - part->first);
    int shift = from - first, cells = end - from;
    float *restrict near = out->value[0] + shift;
    for (int k = FG__PLACE_NEAR; k < pull_array(dimension); ++k) {
      const float *restrict other = value + (size_t)k * part->stride;
      float *restrict mine = out->value[k] + shift;
      for (int i = 0; i < cells; ++i)
        mine[i] = value[i] < near[i] ? other[i] : mine[i];
    }
    for (int i = 0; i < cells; ++i)
      near[i] = value[i] < near[i] ? value[i] : near[i];
    for (int k = pull_array(dimension); k < FG__PLACE_ARRAYS(dimension); ++k) {
      const float *restrict other = value + (size_t)k * part->stride;
      float *restrict mine = out->value[k] + shift;
      for (int i = 0; i < cells; ++i)
        mine[i] += other[i];
    }
  }
}

INLINE double price_cells(const int dimension, float *cost, int first, int count,
                          const fg__place_row *row, const gathered *told)
{
  const float(*value)[MOST_CELLS] = told->value;
  const float *weight = row->weight + first;
  const float *vx = row->direction[0] + first, *vy = row->direction[1] + first;
  const float *vz = dimension == 3 ? row->direction[2] + first : vx;
  float price[MOST_CELLS], lane[LANES] = {0};
  for (int i = 0; i < count; ++i) {
    float angles = 0.0F;
    for (int reader = 0; reader < 2; ++reader) {
      int at = FG__PLACE_NEAR + reader * dimension;
      angles += angle_to(dimension, value[at][i], value[at + 1][i],
                         dimension == 3 ? value[at + 2][i] : 0.0F, vx[i], vy[i], vz[i]);
    }
    price[i] =
        weight[i] * (angles * row->price.inverse_error + row->price.far * value[0][i]);
  }
  if (cost)
    for (int i = 0; i < count; ++i)
      cost[first + i] = price[i];
  int i = 0;
  for (; i + LANES <= count; i += LANES)
    for (int k = 0; k < LANES; ++k)
      lane[k] += price[i + k];
  for (int k = 0; i < count; ++i, ++k)
    lane[k] += price[i]; /* cppcheck-suppress uninitvar */
  double sum = 0.0;
  for (int k = 0; k < LANES; ++k)
    sum += (double)lane[k];
  return sum;
}

INLINE double cost_row(const int dimension, float *cost, int count,
                       const fg__place_row *row, const fg__place_told_row parts[2])
{
  double sum = 0.0;
  gathered told;
  for (int first = 0; first < count; first += MOST_CELLS) {
    int cells = count - first < MOST_CELLS ? count - first : MOST_CELLS;
    gather(dimension, &told, first, cells, row->price.reach * row->price.reach, parts);
    sum += price_cells(dimension, cost, first, cells, row, &told);
  }
  return sum;
}

CLONES static double cost_2d(float *cost, int count, const fg__place_row *row,
                             const fg__place_told_row parts[2])
{
  return cost_row(2, cost, count, row, parts);
}

CLONES static double cost_3d(float *cost, int count, const fg__place_row *row,
                             const fg__place_told_row parts[2])
{
  return cost_row(3, cost, count, row, parts);
}

double fg__place_cost_row(int dimension, float *cost, int count, const fg__place_row *row,
                          const fg__place_told_row parts[2])
{
  return (dimension == 2 ? cost_2d : cost_3d)(cost, count, row, parts);
}

INLINE void diffuse_row(const int dimension, float *out, const float *in,
                        const size_t stride[2], const float *source, const float *inverse,
                        int count, float omega)
{
  for (int i = 0; i < count; i += WIDTH) {
    const float *at = in + i;
    vector sum =
        load(at - 1) + load(at + 1) + load(at - stride[0]) + load(at + stride[0]);
    if (dimension == 3)
      sum += load(at - stride[1]) + load(at + stride[1]);
    vector before = load(out + i);
    vector change = (sum + load(source + i)) * load(inverse + i) - before;
    store(out + i, before + omega * change, count - i < WIDTH ? count - i : WIDTH);
  }
}

CLONES static void diffuse_2d(float *out, const float *in, const size_t stride[2],
                              const float *source, const float *inverse, int count,
                              float omega)
{
  diffuse_row(2, out, in, stride, source, inverse, count, omega);
}

CLONES static void diffuse_3d(float *out, const float *in, const size_t stride[2],
                              const float *source, const float *inverse, int count,
                              float omega)
{
  diffuse_row(3, out, in, stride, source, inverse, count, omega);
}

void fg__place_diffuse_row(int dimension, float *out, const float *in,
                           const size_t stride[2], const float *source,
                           const float *inverse, int count, float omega)
{
  (dimension == 2 ? diffuse_2d : diffuse_3d)(out, in, stride, source, inverse, count,
                                             omega);
}

CLONES void fg__place_inverse_row(float *restrict out, const float *restrict faces,
                                  const float *restrict strength, int count)
{
  for (int i = 0; i < count; ++i)
    out[i] = faces[i] > 0.0F ? 1.0F / (faces[i] + strength[i]) : 0.0F;
}

INLINE double angle_row(const int dimension, float *restrict out,
                        const fg__place_angle_cells *cells, int count)
{
  const float *const *value = cells->value, *const *direction = cells->direction;
  const float *z = dimension == 3 ? value[2] : value[0];
  const float *dz = dimension == 3 ? direction[2] : direction[0];
  float lane[LANES] = {0};
  for (int i = 0; i < count; ++i)
    out[i] = cells->weight[i] * angle_to(dimension, value[0][i], value[1][i], z[i],
                                         direction[0][i], direction[1][i], dz[i]);
  int i = 0;
  for (; i + LANES <= count; i += LANES)
    for (int k = 0; k < LANES; ++k)
      lane[k] += out[i + k] - cells->before[i + k];
  for (int k = 0; i < count; ++i, ++k)
    lane[k] += out[i] - cells->before[i]; /* cppcheck-suppress uninitvar */
  double sum = 0.0;
  for (int k = 0; k < LANES; ++k)
    sum += (double)lane[k];
  return sum;
}

CLONES static double angle_2d(float *out, const fg__place_angle_cells *cells, int count)
{
  return angle_row(2, out, cells, count);
}

CLONES static double angle_3d(float *out, const fg__place_angle_cells *cells, int count)
{
  return angle_row(3, out, cells, count);
}

double fg__place_angle_row(int dimension, float *out, const fg__place_angle_cells *cells,
                           int count)
{
  return (dimension == 2 ? angle_2d : angle_3d)(out, cells, count);
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

CLONES static void nearest_2d(float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count)
{
  nearest_points(2, square, line, position, stride, count);
}

CLONES static void nearest_3d(float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count)
{
  nearest_points(3, square, line, position, stride, count);
}

void fg__place_nearest_points(int dimension, float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count)
{
  (dimension == 2 ? nearest_2d : nearest_3d)(square, line, position, stride, count);
}
