#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "tensor/eigenvalues.h"
#include "tensor/tensor.h"

static const double ANISOTROPY = 0.17;
static const double PI = 3.14159265358979323846;

enum { ENTRIES = 6, SIDE = 24 };

typedef struct grid {
  fg__cells cells;
  size_t count;
  fg__tensor tensor;
} grid;

typedef void direction_of(int i, int j, int k, double direction[3]);

static size_t at(const grid *g, int i, int j, int k)
{
  const int *count = g->cells.count;
  return ((size_t)k * (size_t)count[1] + (size_t)j) * (size_t)count[0] + (size_t)i;
}

static void entries_at(const grid *g, size_t n, double a[ENTRIES])
{
  const fg__tensor *t = &g->tensor;
  const float entry[] = {t->xx[n], t->xy[n], t->yy[n], t->zz[n], t->xz[n], t->yz[n]};
  for (int m = 0; m < ENTRIES; ++m)
    a[m] = (double)entry[m];
}

static void set_direction(grid *g, size_t n, const double direction[3])
{
  double a[ENTRIES];
  fg__tensor *t = &g->tensor;
  fg__tensor_along(a, direction, ANISOTROPY);
  float *const entry[] = {t->xx, t->xy, t->yy, t->zz, t->xz, t->yz};
  for (int m = 0; m < ENTRIES; ++m)
    entry[m][n] = (float)a[m];
  t->active[n] = 1;
}

static grid *grid_of(int nx, int ny, int nz, direction_of *direction)
{
  grid *g = calloc(1, sizeof *g);
  assert_non_null(g);
  g->cells = (fg__cells){.dimension = 3,
                         .count = {nx, ny, nz},
                         .origin = {2.0, -1.0, 7.0},
                         .spacing = {0.5, 0.4, 0.6}};
  g->count = fg__cell_count(&g->cells);
  float *memory = calloc(g->count, ENTRIES * sizeof *memory);
  unsigned char *active = calloc(g->count, 1);
  assert_true(memory && active);
  float **const entry[] = {&g->tensor.xx, &g->tensor.xy, &g->tensor.yy,
                           &g->tensor.zz, &g->tensor.xz, &g->tensor.yz};
  for (size_t m = 0; m < ENTRIES; ++m)
    *entry[m] = memory + m * g->count;
  g->tensor.active = active;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        double e[3];
        direction(i, j, k, e);
        set_direction(g, at(g, i, j, k), e);
      }
  return g;
}

static void grid_free(grid *g)
{
  free(g->tensor.xx);
  free(g->tensor.active);
  free(g);
}

static void smooth(grid *g, const bool periodic[3], double width)
{
  assert_int_equal(
      fg__tensor_smooth(&g->tensor, NULL, ANISOTROPY, &g->cells, periodic, width, NULL),
      0);
}

static const bool open_box[3] = {false, false, false};

static void constant(int i, int j, int k, double e[3])
{
  (void)i, (void)j;
  double sign = k % 2 ? -1.0 : 1.0; /* an axis has no arrow */
  e[0] = sign * 0.3;
  e[1] = sign * -1.1;
  e[2] = sign * 0.8;
}

static void one_direction_stays(void **state)
{
  (void)state;
  grid *g = grid_of(13, 11, 9, constant);
  double before[ENTRIES], e[3];
  constant(0, 0, 0, e);
  fg__tensor_along(before, e, ANISOTROPY);
  smooth(g, open_box, 1.1);
  for (size_t n = 0; n < g->count; ++n) {
    double a[ENTRIES];
    entries_at(g, n, a);
    for (int m = 0; m < ENTRIES; ++m)
      assert_true(fabs(a[m] - before[m]) < 1e-6);
  }
  grid_free(g);
}

/* Directions towards the twenty corners of a dodecahedron: their mean axis is none. */
static void dodecahedron(int i, int j, int k, double e[3])
{
  double golden = 0.5 * (1.0 + sqrt(5.0));
  int n = (i + 2 * j + 4 * k) % 10;
  if (n < 4) {
    e[0] = 1.0;
    e[1] = n % 2 ? -1.0 : 1.0;
    e[2] = n / 2 ? -1.0 : 1.0;
  } else {
    int axis = (n - 4) / 2;
    e[axis] = 0.0;
    e[(axis + 1) % 3] = 1.0 / golden;
    e[(axis + 2) % 3] = n % 2 ? golden : -golden;
  }
}

static void directions_that_cancel_leave_no_preference(void **state)
{
  (void)state;
  grid *g = grid_of(SIDE, SIDE, SIDE, dodecahedron);
  smooth(g, open_box, 1.6);
  for (int k = 9; k < SIDE - 9; ++k)
    for (int j = 9; j < SIDE - 9; ++j)
      for (int i = 9; i < SIDE - 9; ++i) {
        double a[ENTRIES], e[3];
        entries_at(g, at(g, i, j, k), a);
        fg__eigenvalues(e, a);
        assert_true(e[2] > 0.97 && e[0] < 1.0 + 1e-6);
      }
  grid_free(g);
}

static uint64_t random_state;

static void random_direction(int i, int j, int k, double e[3])
{
  (void)i, (void)j, (void)k;
  for (int m = 0; m < 3; ++m) {
    random_state = random_state * 6364136223846793005U + 1442695040888963407U;
    e[m] = (double)(int64_t)random_state * 0x1p-63 + (m == 1 ? 0.4 : 0.0);
  }
}

static void tensors_stay_between_the_two_costs(void **state)
{
  (void)state;
  const double width[] = {0.2, 0.5, 1.0, 2.5};
  for (size_t n = 0; n < sizeof width / sizeof *width; ++n) {
    random_state = 12;
    grid *g = grid_of(17, 12, 14, random_direction);
    smooth(g, open_box, width[n]);
    for (size_t cell = 0; cell < g->count; ++cell) {
      double a[ENTRIES], e[3];
      entries_at(g, cell, a);
      fg__eigenvalues(e, a);
      assert_true(fabs(e[0] - 1.0) < 1e-6 && e[2] > ANISOTROPY - 1e-6);
    }
    grid_free(g);
  }
}

static double planar_angle(int i, int j)
{
  return 0.07 * i * i - 0.9 * j + (i + 2 * j) % 3;
}

static void planar(int i, int j, int k, double e[3])
{
  (void)k;
  e[0] = cos(planar_angle(i, j));
  e[1] = sin(planar_angle(i, j));
  e[2] = 0.0;
}

/* A flow in planes that does not change from plane to plane is a flow in 2D. */
static void a_planar_flow_is_that_of_2d(void **state)
{
  (void)state;
  enum { NX = 21, NY = 16, NZ = 10 };
  const double width[] = {0.3, 0.7, 2.0};
  for (size_t w = 0; w < sizeof width / sizeof *width; ++w) {
    grid *g = grid_of(NX, NY, NZ, planar), *flat = grid_of(NX, NY, 1, planar);
    const bool periodic[3] = {true, false, true};
    smooth(g, periodic, width[w]);
    flat->cells.dimension = 2;
    smooth(flat, periodic, width[w]);
    int turned_down = 0;
    for (int k = 0; k < NZ; ++k)
      for (int n = 0; n < NX * NY; ++n) {
        double a[ENTRIES], b[ENTRIES];
        entries_at(g, (size_t)(k * NX * NY + n), a);
        entries_at(flat, (size_t)n, b);
        for (int m = 0; m < 3; ++m)
          assert_true(fabs(a[m] - b[m]) < 2e-6);
        assert_true(fabs(a[3] - ANISOTROPY) < 2e-6);
        assert_true(fabs(a[4]) < 1e-6 && fabs(a[5]) < 1e-6);
        turned_down += b[0] + b[2] > 1.0 + ANISOTROPY + 0.01;
      }
    assert_true(width[w] < 0.5 || turned_down > 0);
    grid_free(g);
    grid_free(flat);
  }
}

static void field_of_three_waves(int i, int j, int k, double e[3])
{
  e[0] = sin(0.5 * i) + 0.3;
  e[1] = cos(0.4 * j + 0.1 * i) - 0.2;
  e[2] = 0.8 * sin(0.3 * k - 0.6 * j);
}

/* Axes in the order y, z, x. */
static void turned_waves(int i, int j, int k, double e[3])
{
  double waves[3];
  field_of_three_waves(k, i, j, waves);
  e[0] = waves[1];
  e[1] = waves[2];
  e[2] = waves[0];
}

static void axes_may_change_places(void **state)
{
  (void)state;
  enum { NX = 11, NY = 15, NZ = 8 };
  grid *g = grid_of(NX, NY, NZ, field_of_three_waves);
  grid *turned = grid_of(NY, NZ, NX, turned_waves);
  memcpy(turned->cells.spacing, (double[3]){0.4, 0.6, 0.5}, sizeof(double[3]));
  g->tensor.active[at(g, 4, 7, 3)] = turned->tensor.active[at(turned, 7, 3, 4)] = 0;
  smooth(g, (const bool[3]){true, false, false}, 0.7);
  smooth(turned, (const bool[3]){false, false, true}, 0.7);
  for (int k = 0; k < NZ; ++k)
    for (int j = 0; j < NY; ++j)
      for (int i = 0; i < NX; ++i) {
        double a[ENTRIES], b[ENTRIES];
        entries_at(g, at(g, i, j, k), a);
        entries_at(turned, at(turned, j, k, i), b);
        /* xx, xy, yy, zz, xz, yz of g are zz, xz, xx, yy, yz, xy of the other */
        const int place[ENTRIES] = {3, 4, 0, 2, 5, 1};
        for (int m = 0; m < ENTRIES; ++m)
          assert_true(fabs(a[m] - b[place[m]]) < 3e-6);
      }
  grid_free(g);
  grid_free(turned);
}

static void left_and_right(int i, int j, int k, double e[3])
{
  (void)j, (void)k;
  double angle = i < SIDE / 2 ? 0.3 : 1.2;
  e[0] = cos(angle);
  e[1] = 0.6 * sin(angle);
  e[2] = 0.8 * sin(angle);
}

static double xx_at(const grid *g, int i, int j, int k)
{
  return (double)g->tensor.xx[at(g, i, j, k)];
}

static void a_mask_separates(void **state)
{
  (void)state;
  grid *g = grid_of(SIDE, 6, 5, left_and_right);
  double left = xx_at(g, 0, 2, 2), right = xx_at(g, SIDE - 1, 2, 2);
  /* a wall as wide as the Gaussian reaches, with nonsense in it */
  for (size_t n = 0; n < g->count; ++n)
    if (n % SIDE >= SIDE / 2 - 3 && n % SIDE < SIDE / 2 + 3) {
      set_direction(g, n, (const double[3]){0.1, 0.9, -2.0});
      g->tensor.active[n] = 0;
    }
  smooth(g, open_box, 1.0);
  for (int i = 0; i < SIDE; ++i) {
    double value = xx_at(g, i, 1, 3);
    if (g->tensor.active[at(g, i, 1, 3)])
      assert_true(fabs(value - (i < SIDE / 2 ? left : right)) < 1e-6);
    else
      assert_true(value == 0.0);
  }
  grid_free(g);
}

static void a_periodic_seam_is_no_boundary(void **state)
{
  (void)state;
  grid *open = grid_of(SIDE, 6, 5, left_and_right);
  grid *closed = grid_of(SIDE, 6, 5, left_and_right);
  smooth(open, open_box, 1.5);
  smooth(closed, (const bool[3]){true, false, false}, 1.5);
  /* by symmetry the seam of the closed grid looks like its middle */
  double seam = xx_at(closed, 0, 2, 2), middle = xx_at(closed, SIDE / 2 - 1, 2, 2);
  double boundary = xx_at(open, 0, 2, 2);
  double e[3], alone[ENTRIES];
  left_and_right(0, 0, 0, e);
  fg__tensor_along(alone, e, ANISOTROPY);
  assert_true(fabs(seam - middle) < 1e-5);
  assert_true(fabs(boundary - alone[0]) < 1e-5);
  assert_true(fabs(seam - boundary) > 0.05);
  grid_free(open);
  grid_free(closed);
}

/* A direction that turns slowly is followed, with the full anisotropy. */
static void helix(int i, int j, int k, double e[3])
{
  (void)i, (void)j;
  e[0] = cos(PI * k / 60.0);
  e[1] = sin(PI * k / 60.0);
  e[2] = 0.7;
}

static void slow_turns_are_followed(void **state)
{
  (void)state;
  grid *g = grid_of(5, 6, SIDE, helix);
  smooth(g, open_box, 0.9);
  for (int k = 6; k < SIDE - 6; ++k) {
    double a[ENTRIES], b[ENTRIES], e[3];
    helix(2, 2, k, e);
    fg__tensor_along(b, e, ANISOTROPY);
    entries_at(g, at(g, 2, 2, k), a);
    for (int m = 0; m < ENTRIES; ++m)
      assert_true(fabs(a[m] - b[m]) < 5e-3);
    fg__eigenvalues(e, a);
    assert_true(fabs(e[0] - 1.0) < 1e-6 && fabs(e[1] - ANISOTROPY) < 1e-6 &&
                fabs(e[2] - ANISOTROPY) < 1e-6);
  }
  grid_free(g);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_direction_stays),
      cmocka_unit_test(directions_that_cancel_leave_no_preference),
      cmocka_unit_test(tensors_stay_between_the_two_costs),
      cmocka_unit_test(a_planar_flow_is_that_of_2d),
      cmocka_unit_test(axes_may_change_places),
      cmocka_unit_test(a_mask_separates),
      cmocka_unit_test(a_periodic_seam_is_no_boundary),
      cmocka_unit_test(slow_turns_are_followed),
  };
  return cmocka_run_group_tests_name("tensor/smooth_3d", tests, NULL, NULL);
}
