#include "place/reader_rows.h"

#include <math.h>

/* epsilon of the inverse distance and of the smooth reader, in lambda, squared */
#define EPSILON_SQUARE 0.0025F

enum { LANES = 8, MOST_CELLS = 64 };

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && defined(__GNUC__) &&        \
    !defined(__clang__)
#define CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define CLONES
#endif
#define INLINE static inline __attribute__((always_inline))

/* Where the arrays of the two sums begin. */
INLINE int pull_array(const int dimension)
{
  return FG__PLACE_NEAR + dimension;
}

INLINE int smooth_array(const int dimension)
{
  return FG__PLACE_NEAR + 2 * dimension;
}

/* (1 - d^2 / R^2)^2, 0 beyond R. */
INLINE float taper(float square, float inverse_square)
{
  float f = 1.0F - square * inverse_square;
  f = f > 0.0F ? f : 0.0F;
  return f * f;
}

/* Adds a sample to cells: with `dimension` known, a loop without branches. `aside` is the
 * square of its distance to the row, `offset` the first cell's place along the row from
 * it. */
INLINE void tell(const int dimension, float *restrict value, size_t stride, int count,
                 const fg__place_line *line, int n, float aside, float offset,
                 const fg__place_row_place *row)
{
  const float share = line->share[n], cell = row->cell;
  const float inverse_square = row->inverse_square;
  const float tx = line->tangent[0][n], ty = line->tangent[1][n],
              tz = line->tangent[2][n];
  float *restrict nx = value + FG__PLACE_NEAR * stride, *restrict ny = nx + stride;
  float *restrict nz = dimension == 3 ? ny + stride : NULL;
  float *restrict sx = value + (size_t)smooth_array(dimension) * stride, *restrict sy =
                                                                             sx + stride;
  float *restrict sz = dimension == 3 ? sy + stride : NULL;
  for (int i = 0; i < count; ++i) {
    float dx = offset + cell * (float)i;
    float square = dx * dx + aside;
    float near = value[i];
    int nearer = square < near;
    value[i] = nearer ? square : near;
    nx[i] = nearer ? tx : nx[i];
    ny[i] = nearer ? ty : ny[i];
    float q = square + EPSILON_SQUARE;
    float power = dimension == 2 ? q * q : q * q * sqrtf(q);
    float weight = share * taper(square, inverse_square) / power;
    sx[i] += weight * tx;
    sy[i] += weight * ty;
    if (dimension == 3) {
      nz[i] = nearer ? tz : nz[i];
      sz[i] += weight * tz;
    }
  }
}

/* Each sample tells the cells of the row that lie within its reach. */
INLINE void tell_row(const int dimension, float *restrict value, size_t stride, int count,
                     const fg__place_line *line, const fg__place_row_place *row)
{
  for (int n = 0; n < line->count; ++n) {
    float dy = row->y - line->position[1][n];
    float dz = dimension == 3 ? row->z - line->position[2][n] : 0.0F;
    float aside = dy * dy + dz * dz, left = row->reach * row->reach - aside;
    if (!(left > 0.0F))
      continue;
    float half = sqrtf(left), middle = line->position[0][n] - row->x;
    int first = (int)((middle - half) / row->cell),
        last = (int)((middle + half) / row->cell) + 1;
    first = first > 0 ? first : 0;
    last = last < count ? last : count;
    if (first < last)
      tell(dimension, value + first, stride, last - first, line, n, aside,
           ((float)first + 0.5F) * row->cell - middle, row);
  }
  for (int i = 0; i < count; ++i) { /* the pull of the icon as a whole */
    float square = value[i], q = square + EPSILON_SQUARE;
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
                   float reach_square, const fg__place_part_row parts[2])
{
  for (int i = 0; i < count; ++i)
    out->value[0][i] = reach_square;
  for (int k = 1; k < FG__PLACE_ARRAYS(dimension); ++k)
    for (int i = 0; i < count; ++i)
      out->value[k][i] = 0.0F;
  for (int n = 0; n < 2; ++n) {
    const fg__place_part_row *part = &parts[n];
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
    for (int reader = 0; reader < 3; ++reader) {
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
                       const fg__place_row *row, const fg__place_part_row parts[2])
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
                             const fg__place_part_row parts[2])
{
  return cost_row(2, cost, count, row, parts);
}

CLONES static double cost_3d(float *cost, int count, const fg__place_row *row,
                             const fg__place_part_row parts[2])
{
  return cost_row(3, cost, count, row, parts);
}

double fg__place_cost_row(int dimension, float *cost, int count, const fg__place_row *row,
                          const fg__place_part_row parts[2])
{
  return (dimension == 2 ? cost_2d : cost_3d)(cost, count, row, parts);
}
