#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "tensor/tensor.h"

/* Velocities and tensor entries are stored in float, and the entries are at most 1. */
static const double FLOAT_ROUNDING = 4e-7;

enum { NX = 7, NY = 6, CELLS_X = 9, CELLS_Y = 11, CELL_COUNT = CELLS_X * CELLS_Y };

static const double X[NX] = {-30.0, -21.0, -16.0, 0.5, 3.0, 11.0, 20.0};
static const double Y[NY] = {20.0, 27.0, 40.0, 48.0, 59.0, 70.0};

typedef struct fixture {
  fg_context *context;
  float u[NX * NY], v[NX * NY];
  fg_field_arrays arrays;
  fg_field *field;
  float xx[CELL_COUNT], xy[CELL_COUNT], yy[CELL_COUNT];
  unsigned char active[CELL_COUNT];
  fg__tensor tensor;
  fg__cells cells;
} fixture;

/* Linear, so that bilinear interpolation between the samples is exact. */
static void velocity_at(double x, double y, double v[2])
{
  v[0] = 0.3 + 0.031 * x - 0.044 * (y - 42.0);
  v[1] = -0.9 + 0.027 * x + 0.063 * (y - 42.0);
}

static int set_up(void **state)
{
  static fixture f;
  memset(&f, 0, sizeof f);
  for (int j = 0; j < NY; ++j)
    for (int i = 0; i < NX; ++i) {
      double v[2];
      velocity_at(X[i], Y[j], v);
      f.u[j * NX + i] = (float)v[0];
      f.v[j * NX + i] = (float)v[1];
    }
  f.arrays = (fg_field_arrays){
      .dimension = 2, .size = {NX, NY, 1}, .axis = {X, Y}, .velocity = {f.u, f.v}};
  f.tensor = (fg__tensor){.xx = f.xx, .xy = f.xy, .yy = f.yy, .active = f.active};
  f.cells = (fg__cells){
      .dimension = 2,
      .count = {CELLS_X, CELLS_Y},
      .origin = {X[0], Y[0]},
      .spacing = {(X[NX - 1] - X[0]) / CELLS_X, (Y[NY - 1] - Y[0]) / CELLS_Y}};
  *state = &f;
  return fg_context_create(&f.context) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  fixture *f = *state;
  fg_field_destroy(f->field);
  fg_context_destroy(f->context);
  return 0;
}

static fg_status fill(fixture *f, fg_energy energy, double anisotropy)
{
  if (!f->field)
    assert_int_equal(fg_field_create(&f->field, f->context, &f->arrays), FG_STATUS_OK);
  return fg__tensor_fill(&f->tensor, f->context, f->field, fg__energy(energy), anisotropy,
                         &f->cells, NULL);
}

static void center_of(int i, int j, double center[2])
{
  center[0] = X[0] + (X[NX - 1] - X[0]) * (2 * i + 1) / (2.0 * CELLS_X);
  center[1] = Y[0] + (Y[NY - 1] - Y[0]) * (2 * j + 1) / (2.0 * CELLS_Y);
}

/* A d = factor d for a direction d of any length. */
static void assert_eigenvector(const fixture *f, int cell, double dx, double dy,
                               double factor)
{
  double xx = (double)f->xx[cell], xy = (double)f->xy[cell], yy = (double)f->yy[cell];
  double length = hypot(dx, dy);
  assert_true(fabs(xx * dx + xy * dy - factor * dx) < FLOAT_ROUNDING * length);
  assert_true(fabs(xy * dx + yy * dy - factor * dy) < FLOAT_ROUNDING * length);
}

/* Gradients along the stream, that is interfaces across it, cost 1, gradients across it
 * cost a. */
static void eigenvectors_follow_the_flow(void **state)
{
  fixture *f = *state;
  const double anisotropy[] = {0.15, 0.37, 1.0, 0.001};
  for (size_t n = 0; n < sizeof anisotropy / sizeof *anisotropy; ++n) {
    assert_int_equal(fill(f, FG_ENERGY_FLOW, anisotropy[n]), FG_STATUS_OK);
    for (int j = 0; j < CELLS_Y; ++j)
      for (int i = 0; i < CELLS_X; ++i) {
        double center[2], v[2];
        center_of(i, j, center);
        velocity_at(center[0], center[1], v);
        assert_int_equal(f->active[j * CELLS_X + i], 1);
        assert_eigenvector(f, j * CELLS_X + i, v[0], v[1], 1.0);
        assert_eigenvector(f, j * CELLS_X + i, -v[1], v[0], anisotropy[n]);
      }
  }
}

/* A degree of longitude is shorter than one of latitude, so the same wind crosses more.
 */
static void on_the_sphere_streamlines_are_those_of_the_map(void **state)
{
  fixture *f = *state;
  f->arrays.scale = FG_SCALE_GEO;
  assert_int_equal(fill(f, FG_ENERGY_FLOW, 0.2), FG_STATUS_OK);
  for (int j = 0; j < CELLS_Y; ++j)
    for (int i = 0; i < CELLS_X; ++i) {
      double center[2], v[2];
      center_of(i, j, center);
      velocity_at(center[0], center[1], v);
      double degrees_x = v[0] / cos(center[1] * acos(-1.0) / 180.0);
      assert_eigenvector(f, j * CELLS_X + i, degrees_x, v[1], 1.0);
      assert_eigenvector(f, j * CELLS_X + i, v[1], -degrees_x, 0.2);
    }
}

static void the_isotropic_energy_knows_no_direction(void **state)
{
  fixture *f = *state;
  assert_int_equal(fill(f, FG_ENERGY_ISOTROPIC, 0.4), FG_STATUS_OK);
  for (int cell = 0; cell < CELL_COUNT; ++cell) {
    assert_eigenvector(f, cell, 1.0, 0.0, 1.0);
    assert_eigenvector(f, cell, 0.0, 1.0, 1.0);
  }
}

static bool in_cell(const double center[2], int i, int j)
{
  return center[0] > X[i] && center[0] < X[i + 1] && center[1] > Y[j] &&
         center[1] < Y[j + 1];
}

static void still_places_have_no_direction(void **state)
{
  fixture *f = *state;
  for (int j = 2; j < 4; ++j)
    for (int i = 1; i < 3; ++i)
      f->u[j * NX + i] = f->v[j * NX + i] = 0.0F;
  assert_int_equal(fill(f, FG_ENERGY_FLOW, 0.2), FG_STATUS_OK);
  int still = 0;
  for (int j = 0; j < CELLS_Y; ++j)
    for (int i = 0; i < CELLS_X; ++i) {
      double center[2];
      center_of(i, j, center);
      if (!in_cell(center, 1, 2))
        continue;
      ++still;
      assert_eigenvector(f, j * CELLS_X + i, 1.0, 0.0, 1.0);
      assert_eigenvector(f, j * CELLS_X + i, 0.0, 1.0, 1.0);
    }
  assert_true(still > 0 && still < CELL_COUNT);
}

static void missing_places_have_no_cell(void **state)
{
  fixture *f = *state;
  f->u[3 * NX + 2] = NAN; /* spoils the four data cells round it */
  assert_int_equal(fill(f, FG_ENERGY_FLOW, 0.2), FG_STATUS_OK);
  int missing = 0;
  for (int j = 0; j < CELLS_Y; ++j)
    for (int i = 0; i < CELLS_X; ++i) {
      double center[2];
      center_of(i, j, center);
      int cell = j * CELLS_X + i;
      bool hole = in_cell(center, 1, 2) || in_cell(center, 2, 2) ||
                  in_cell(center, 1, 3) || in_cell(center, 2, 3);
      missing += hole;
      assert_int_equal(f->active[cell], !hole);
      assert_true(isfinite(f->xx[cell]) && isfinite(f->xy[cell]) &&
                  isfinite(f->yy[cell]));
    }
  assert_true(missing > 0 && missing < CELL_COUNT);
}

/* Speeds of any size, down to the smallest floats, give a direction of full length. */
static void only_the_direction_counts(void **state)
{
  (void)state;
  const double speed[] = {1e-40, 1e-30, 1e-8, 1.0, 3e7, 1e38};
  double reference[6];
  fg__tensor_along(reference, (double[3]){-0.8, 0.6}, 0.3);
  for (size_t n = 0; n < sizeof speed / sizeof *speed; ++n)
    for (int sign = -1; sign <= 1; sign += 2) {
      double a[6], v[3] = {sign * speed[n] * -0.8, sign * speed[n] * 0.6};
      fg__tensor_along(a, v, 0.3);
      for (int k = 0; k < 3; ++k)
        assert_true(fabs(a[k] - reference[k]) < 1e-14);
    }
}

static void assert_refused(fixture *f, fg_energy energy, double anisotropy,
                           const char *part_of_message)
{
  assert_int_equal(fill(f, energy, anisotropy), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), part_of_message));
  fg_context_clear(f->context);
}

static void impossible_energies_are_refused(void **state)
{
  fixture *f = *state;
  assert_refused(f, FG_ENERGY_FLOW, 0.0, "anisotropy 0 ");
  assert_refused(f, FG_ENERGY_FLOW, -0.25, "anisotropy -0.25 ");
  assert_refused(f, FG_ENERGY_FLOW, 1.0625, "anisotropy 1.0625 ");
  assert_refused(f, FG_ENERGY_FLOW, (double)NAN, "anisotropy");
  assert_refused(f, (fg_energy)77, 0.5, "no such energy");
}

/* The only data cell lies between the centres of a coarse mesh. */
static void a_domain_that_slips_through_the_mesh_is_refused(void **state)
{
  fixture *f = *state;
  unsigned char valid[NX * NY] = {0};
  const int corner[] = {2 * NX + 3, 2 * NX + 4, 3 * NX + 3, 3 * NX + 4};
  for (size_t n = 0; n < 4; ++n)
    valid[corner[n]] = 1;
  f->arrays.valid = valid;
  f->cells.count[0] = f->cells.count[1] = 1;
  f->cells.spacing[0] *= CELLS_X;
  f->cells.spacing[1] *= CELLS_Y;
  assert_refused(f, FG_ENERGY_FLOW, 0.5, "1 x 1");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(eigenvectors_follow_the_flow),
      CASE(on_the_sphere_streamlines_are_those_of_the_map),
      CASE(the_isotropic_energy_knows_no_direction),
      CASE(still_places_have_no_direction),
      CASE(missing_places_have_no_cell),
      CASE(only_the_direction_counts),
      CASE(impossible_energies_are_refused),
      CASE(a_domain_that_slips_through_the_mesh_is_refused),
  };
  return cmocka_run_group_tests_name("tensor/tensor", tests, NULL, NULL);
}
