/* Densities that all ranks divide, of shapes that cross the boundaries between blocks and
 * the seams of periodic axes in every way, beside the same made of plain arrays. */
#ifndef FG__SHARED_DENSITY_TEST_H
#define FG__SHARED_DENSITY_TEST_H

#include "grid/together_test.h"

#include <math.h>
#include <string.h>

#include "density/density.h"

typedef struct shape {
  const char *name;
  double (*u)(double x, double y, const bool periodic[2], int seed);
  int seed;
} shape;

static inline double hash01(int i, int j, int seed)
{
  uint32_t h =
      (uint32_t)i * 374761393U + (uint32_t)j * 668265263U + (uint32_t)seed * 2246822519U;
  h = (h ^ (h >> 13)) * 1274126177U;
  return (double)(h ^ (h >> 16)) / 4294967295.0;
}

/* Smooth noise on a lattice of 9 x 7 over the unit square. */
static inline double noise_at(double x, double y, const bool periodic[2], int seed)
{
  enum { COLUMNS = 9, ROWS = 7 };
  double a = x * COLUMNS, b = y * ROWS;
  int i = (int)floor(a), j = (int)floor(b);
  double s = a - i, t = b - j;
  s = s * s * (3.0 - 2.0 * s);
  t = t * t * (3.0 - 2.0 * t);
  double corner[2][2];
  for (int m = 0; m < 2; ++m)
    for (int n = 0; n < 2; ++n)
      corner[m][n] = hash01(periodic[0] ? (i + n) % COLUMNS : i + n,
                            periodic[1] ? (j + m) % ROWS : j + m, seed);
  return (1.0 - t) * ((1.0 - s) * corner[0][0] + s * corner[0][1]) +
         t * ((1.0 - s) * corner[1][0] + s * corner[1][1]);
}

/* From droplets by seed % 4 to one labyrinth that goes round the torus. */
static inline double noise_shape(double x, double y, const bool periodic[2], int seed)
{
  static const double level[] = {0.68, 0.6, 0.5, 0.4};
  return 4.0 * (noise_at(x, y, periodic, seed) - level[seed % 4]);
}

/* Distance from the nearest copy of a segment, in units of its half width. */
static inline double segment_shape(double x, double y, const bool periodic[2],
                                   const double from[2], const double to[2], double width)
{
  double nearest = 1e300;
  for (int m = -2; m <= 2; ++m)
    for (int n = -2; n <= 2; ++n) {
      if ((m && !periodic[0]) || (n && !periodic[1]))
        continue;
      double px = x + m - from[0], py = y + n - from[1];
      double dx = to[0] - from[0], dy = to[1] - from[1];
      double t = fmin(fmax((px * dx + py * dy) / (dx * dx + dy * dy), 0.0), 1.0);
      nearest = fmin(nearest, hypot(px - t * dx, py - t * dy));
    }
  return 1.0 - nearest / width;
}

/* Goes half a period over its own beginning without meeting it, like a spring. */
static inline double spring_shape(double x, double y, const bool periodic[2], int seed)
{
  const double across[2] = {1.55, 0.62}, up[2] = {0.43, 1.7}, from[2] = {0.1, 0.2};
  return segment_shape(x, y, periodic, from, seed ? up : across, 0.06);
}

/* Across the corner of the torus, and a band round it with a bite at the seam. */
static inline double corner_shape(double x, double y, const bool periodic[2], int seed)
{
  const double from[2] = {-0.12, -0.07}, to[2] = {0.13, 0.1};
  double drop = segment_shape(x, y, periodic, from, to, 0.07);
  const double left[2] = {0.01, 0.52}, right[2] = {seed ? 0.97 : 1.01, 0.55};
  return fmax(drop, segment_shape(x, y, periodic, left, right, 0.08));
}

/* Round both axes at once. */
static inline double diagonal_shape(double x, double y, const bool periodic[2], int seed)
{
  (void)periodic;
  return sin(2.0 * 3.141592653589793 * (x + (seed ? 2.0 : -1.0) * y)) - 0.4;
}

static const shape SHAPES[] = {
    {"droplets", noise_shape, 4},       {"patches", noise_shape, 1},
    {"fingers", noise_shape, 2},        {"labyrinth", noise_shape, 3},
    {"more droplets", noise_shape, 12}, {"more fingers", noise_shape, 6},
    {"spring", spring_shape, 0},        {"spring up", spring_shape, 1},
    {"corner", corner_shape, 0},        {"corner, open band", corner_shape, 1},
    {"diagonal", diagonal_shape, 0},    {"steep diagonals", diagonal_shape, 1},
};
enum { SHAPE_COUNT = sizeof SHAPES / sizeof *SHAPES, COLUMNS = 144, ROWS = 96 };

typedef struct subject {
  fg_field *field;
  fg_density *shared; /* of all ranks */
  fg_density *whole;  /* the same of arrays; NULL but on rank 0 */
} subject;

/* A flow with a turning direction on [0, 3] x [1, 3], of 48 x 40 samples; a mask takes
 * some out, at the seam, too. */
static inline fg_field *field_with_periods(const bool periodic[2], bool masked)
{
  enum { FINE = 4, WIDE = 12 * FINE, HIGH = 10 * FINE };
  float u[WIDE * HIGH], v[WIDE * HIGH];
  double x[WIDE], y[HIGH];
  for (int i = 0; i < WIDE; ++i)
    x[i] = 3.0 * i / (periodic[0] ? WIDE : WIDE - 1);
  for (int j = 0; j < HIGH; ++j)
    y[j] = 1.0 + 2.0 * j / (periodic[1] ? HIGH : HIGH - 1);
  for (int j = 0; j < HIGH; ++j)
    for (int i = 0; i < WIDE; ++i) {
      u[j * WIDE + i] = (float)(1.2 + sin(2.0 * i / FINE));
      v[j * WIDE + i] = (float)cos(1.5 * j / FINE + 0.4);
      int column = i / FINE, row = j / FINE;
      bool hole = (column == 5 && row > 2 && row < 6) || (column == 0 && row == 7);
      if (masked && hole)
        u[j * WIDE + i] = NAN;
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {WIDE, HIGH},
                            .axis = {x, y},
                            .period = {periodic[0] ? 3.0 : 0.0, periodic[1] ? 2.0 : 0.0},
                            .velocity = {u, v}};
  fg_field *out = NULL;
  expect(fg_field_create(&out, us.context, &arrays) == FG_STATUS_OK);
  return out;
}

/* On rank 0 the density made of the arrays of all ranks, whose labels are the same. */
static inline fg_density *whole_of(const fg_density *divided)
{
  fg_density *gathered = NULL, *whole = NULL;
  if (us.ranks->count > 1)
    expect(fg_density_gather(&gathered, us.context, divided) == FG_STATUS_OK);
  expect(us.ranks->count == 1 || !gathered == (us.ranks->rank > 0));
  const fg_density *all = us.ranks->count > 1 ? gathered : divided;
  if (us.ranks->rank > 0 || !all)
    return NULL;
  expect(fg_density_create_from_arrays(&whole, us.context, fg_density_contents(all)) ==
         FG_STATUS_OK);
  const fg__density_block *got = fg__density_block_of(all);
  const fg__density_block *want = fg__density_block_of(whole);
  size_t nodes = (size_t)fg__box_count(fg__own_block(&want->partition));
  expect(got->count == want->count && got->debris == want->debris);
  expect(memcmp(got->label, want->label, nodes * sizeof *want->label) == 0);
  fg_density_destroy(gathered);
  return whole;
}

/* An evolution that has not begun holds what it is given. */
static inline subject subject_of(const shape *s, const bool periodic[2], bool masked)
{
  subject out = {.field = field_with_periods(periodic, masked)};
  int nodes[2] = {COLUMNS + !periodic[0], ROWS + !periodic[1]};
  float *u = allocate_or_end((size_t)nodes[0] * (size_t)nodes[1], sizeof *u);
  for (int j = 0; j < nodes[1]; ++j)
    for (int i = 0; i < nodes[0]; ++i)
      u[j * nodes[0] + i] = (float)fmin(
          fmax(s->u((double)i / COLUMNS, (double)j / ROWS, periodic, s->seed), -1.0),
          1.0);
  fg_evolution_options options = {.nodes = COLUMNS + 1, .threads = 1, .initial = u};
  fg_evolution *evolution = NULL;
  expect(fg_evolution_create(&evolution, us.context, out.field, &options) ==
         FG_STATUS_OK);
  const fg_mesh_info *mesh = fg_evolution_mesh(evolution);
  expect(mesh->cells[0] == COLUMNS && mesh->cells[1] == ROWS);
  expect(fg_density_create(&out.shared, evolution) == FG_STATUS_OK);
  expect(fg_density_is_distributed(out.shared) == (us.ranks->count > 1));
  fg_evolution_destroy(evolution);
  out.whole = whole_of(out.shared);
  const fg_density_arrays *got = out.whole ? fg_density_contents(out.whole) : NULL;
  int differ = 0;
  for (int n = 0; n < nodes[0] * nodes[1] && got; ++n)
    differ += !(got->u[n] >= u[n] && got->u[n] <= u[n]);
  expect(masked || differ == 0); /* a dead node holds 0 */
  expect(!got || !got->active == !masked);
  free(u);
  return out;
}

static inline void subject_clear(subject *s)
{
  fg_field_destroy(s->field);
  fg_density_destroy(s->shared);
  fg_density_destroy(s->whole);
}

/* Half of the shapes and ways for an even number of ranks, the others for an odd one; of
 * the two shapes of a pair each has what the other lacks. */
static inline bool is_taken(int shape_index, int way)
{
  return (shape_index / 2 + shape_index + way + us.ranks->count) % 2 == 0;
}

/* The four ways to be periodic. */
static inline void set_periods(bool periodic[2], int way)
{
  periodic[0] = way & 1;
  periodic[1] = way & 2;
}

#endif
