/* Cuts through fields in 3D. */
#include <math.h>

#include "field/made_test.h"
#include "field/plane.h"

enum { NX = 7, NY = 5, NZ = 4, COUNT = NX * NY * NZ };

typedef struct volume {
  fg_context *context;
  double axis[3][NX];
  float velocity[3][COUNT];
  fg_field_arrays arrays;
} volume;

/* Linear in space, so that interpolation is exact, and no two components alike. */
static double component_at(int c, const double x[3])
{
  static const double a[3][4] = {
      {0.5, 1.0, -2.0, 0.25}, {-1.0, 0.5, 0.75, 2.0}, {2.0, -0.25, 1.5, -1.0}};
  return a[c][0] + a[c][1] * x[0] + a[c][2] * x[1] + a[c][3] * x[2];
}

static int set_up(void **state)
{
  static volume v;
  static const int size[3] = {NX, NY, NZ};
  memset(&v, 0, sizeof v);
  for (int i = 0; i < NX; ++i) {
    v.axis[0][i] = -1.0 + 0.5 * i;
    v.axis[1][i] = 10.0 + 0.25 * i * (i + 1);
    v.axis[2][i] = 3.0 + i;
  }
  v.arrays = (fg_field_arrays){.dimension = 3,
                               .velocity_name = {"U", "V", "W"},
                               .axis_name = {"east", "y", "height"},
                               .axis_units = {"m", "m", "m"}};
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c) {
      const double at[3] = {v.axis[0][n % NX], v.axis[1][n / NX % NY],
                            v.axis[2][n / NX / NY]};
      v.velocity[c][n] = (float)component_at(c, at);
    }
  for (int k = 0; k < 3; ++k) {
    v.arrays.size[k] = size[k];
    v.arrays.axis[k] = v.axis[k];
    v.arrays.velocity[k] = v.velocity[k];
  }
  *state = &v;
  return fg_context_create(&v.context) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  fg_context_destroy(((volume *)*state)->context);
  return 0;
}

static fg_field *cut(volume *v, const fg_plane *plane)
{
  fg_field *whole = field_made(v->context, &v->arrays), *out = NULL;
  if (fg_field_slice(&out, v->context, whole, plane))
    fail_msg("%s", fg_context_message(v->context));
  fg_field_destroy(whole);
  return out;
}

static void cut_refused(volume *v, const fg_plane *plane, const char *part)
{
  fg_field *whole = field_made(v->context, &v->arrays), *out = NULL;
  assert_int_equal(fg_field_slice(&out, v->context, whole, plane), FG_STATUS_ARGUMENT);
  assert_null(out);
  if (!strstr(fg_context_message(v->context), part))
    fail_msg("\"%s\" lacks \"%s\"", fg_context_message(v->context), part);
  fg_context_clear(v->context);
  fg_field_destroy(whole);
}

static void a_plane_of_samples_is_itself(void **state)
{
  volume *v = *state;
  const fg_plane plane = {{0.0, -2.0, 0.0}, {99.0, v->axis[1][3], 0.0}};
  v->velocity[0][(2 * NY + 3) * NX + 1] = NAN;
  v->velocity[0][(2 * NY + 2) * NX + 4] = NAN; /* beside the plane */
  fg_field *field = cut(v, &plane);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->dimension, 2);
  assert_int_equal(a->size[0], NX);
  assert_int_equal(a->size[1], NZ);
  assert_string_equal(a->axis_name[0], "east");
  assert_string_equal(a->axis_name[1], "height");
  assert_string_equal(a->velocity_name[1], "W");
  assert_string_equal(a->level, "y = 13 m");
  for (int k = 0; k < NZ; ++k)
    for (int i = 0; i < NX; ++i) {
      const int from = (k * NY + 3) * NX + i, to = k * NX + i;
      assert_true(a->axis[0][i] == v->axis[0][i] && a->axis[1][k] == v->axis[2][k]);
      if (k == 2 && i == 1)
        assert_true(isnan(a->velocity[0][to]) && isnan(a->velocity[1][to]));
      else
        assert_true(a->velocity[0][to] == v->velocity[0][from] &&
                    a->velocity[1][to] == v->velocity[2][from]);
    }
  fg_field_destroy(field);
}

static void between_samples_it_is_linear(void **state)
{
  volume *v = *state;
  const fg_plane plane = {{1.0, 0.0, 0.0}, {0.125, 0.0, 0.0}};
  fg_field *field = cut(v, &plane);
  const fg_field_arrays *a = fg_field_contents(field);
  double normal = 0.0, all = 0.0;
  for (int n = 0; n < NY * NZ; ++n) {
    const double at[3] = {0.125, v->axis[1][n % NY], v->axis[2][n / NY]};
    for (int c = 0; c < 3; ++c) {
      const double u = component_at(c, at);
      all += u * u;
      normal += c == 0 ? u * u : 0.0;
      if (c > 0)
        assert_true(fabs((double)a->velocity[c - 1][n] - u) < 1e-5);
    }
  }
  assert_true(fabs(fg_field_normal_share(field) - normal / all) < 1e-6);
  fg_field_destroy(field);
}

static void a_plane_without_vectors_in_it_is_refused(void **state)
{
  volume *v = *state;
  const fg_plane across = {{0.0, 0.0, 1.0}, {0.5, 11.0, 4.5}};
  for (int n = 0; n < COUNT; ++n) {
    v->velocity[0][n] = v->velocity[1][n] = 0.0f;
    v->velocity[2][n] = 1.0f + (float)n;
  }
  cut_refused(v, &across, "normal to the plane of east and y");
}

/* Whatever the plane: its points are where its coordinates say, and have the components
 * of the velocity there. */
static void a_tilted_plane_has_its_components(void **state)
{
  volume *v = *state;
  static const fg_plane planes[] = {{{1.0, 0.0, 1.0}, {0.5, 11.0, 4.5}},
                                    {{0.2, -0.3, 0.9}, {0.5, 12.0, 4.5}},
                                    {{-3.0, 5.0, 0.1}, {0.5, 12.0, 4.5}}};
  for (int p = 0; p < 3; ++p) {
    fg__plane_basis basis;
    assert_true(fg__plane_basis_of(&basis, planes[p].normal));
    fg_field *field = cut(v, &planes[p]);
    const fg_field_arrays *a = fg_field_contents(field);
    const double offset = fg__dot(planes[p].point, basis.normal);
    int inside = 0;
    for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
      double at[3], u[3];
      bool in = true;
      for (int k = 0; k < 3; ++k) {
        at[k] = offset * basis.normal[k] +
                a->axis[0][n % a->size[0]] * basis.direction[0][k] +
                a->axis[1][n / a->size[0]] * basis.direction[1][k];
        in = in && at[k] > v->axis[k][0] && at[k] < v->axis[k][v->arrays.size[k] - 1];
      }
      if (!in)
        continue;
      ++inside;
      for (int c = 0; c < 3; ++c)
        u[c] = component_at(c, at);
      for (int d = 0; d < 2; ++d)
        assert_true(fabs((double)a->velocity[d][n] - fg__dot(u, basis.direction[d])) <
                    2e-5);
    }
    assert_true(inside > 15 && inside < a->size[0] * a->size[1]);
    if (p == 0) { /* y lies in the plane */
      assert_string_equal(a->axis_name[1], "y");
      assert_string_equal(a->axis_name[0], "east'");
      assert_true(fabs(a->axis[1][0] - 10.0) < 1e-12);
      assert_true(fabs(a->axis[1][a->size[1] - 1] - 15.0) < 1e-12);
    }
    fg_field_destroy(field);
  }
}

/* Whether a point of a plane lies in the volume. */
static bool is_in(const volume *v, const fg__plane_basis *basis, double offset, double x,
                  double y)
{
  for (int k = 0; k < 3; ++k) {
    const double at = offset * basis->normal[k] + x * basis->direction[0][k] +
                      y * basis->direction[1][k];
    if (!(at >= v->axis[k][0] && at <= v->axis[k][v->arrays.size[k] - 1]))
      return false;
  }
  return true;
}

/* Though the volume has few samples: where the plane leaves its box aslant, hardly any of
 * what they have in common is lost between a sample inside and one outside. */
static void a_tilted_plane_reaches_the_box(void **state)
{
  enum { FINE = 2000 };
  volume *v = *state;
  static const fg_plane plane = {{0.2, -0.3, 0.9}, {0.5, 12.0, 4.5}};
  fg__plane_basis basis;
  assert_true(fg__plane_basis_of(&basis, plane.normal));
  fg_field *field = cut(v, &plane);
  const fg_field_arrays *a = fg_field_contents(field);
  const double offset = fg__dot(plane.point, basis.normal);
  const int nx = a->size[0], ny = a->size[1];
  const double *x = a->axis[0], *y = a->axis[1];
  int cells = 0, inside = 0;
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const float *u = a->velocity[0] + (size_t)j * (size_t)nx + i;
      cells += isfinite(u[0]) && isfinite(u[1]) && isfinite(u[nx]) && isfinite(u[nx + 1]);
    }
  for (int j = 0; j < FINE; ++j)
    for (int i = 0; i < FINE; ++i)
      inside += is_in(v, &basis, offset, x[0] + (x[nx - 1] - x[0]) * (i + 0.5) / FINE,
                      y[0] + (y[ny - 1] - y[0]) * (j + 0.5) / FINE);
  const double covered = (double)cells / ((nx - 1) * (ny - 1));
  const double all = (double)inside / FINE / FINE;
  assert_true(covered > 0.95 * all && covered <= 1.001 * all);
  fg_field_destroy(field);
}

static void directions_are_natural(void **state)
{
  (void)state;
  static const double normals[][3] = {{0, 0, 1}, {0, -1, 0},   {3, 0, 0},
                                      {1, 1, 1}, {-1, 0.5, 0}, {0.1, 0.2, -0.3}};
  static const int axes[][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 1}, {1, 2}, {0, 1}};
  for (int n = 0; n < 6; ++n) {
    fg__plane_basis b;
    assert_true(fg__plane_basis_of(&b, normals[n]));
    assert_true(fabs(fg__dot(b.direction[0], b.direction[1])) < 1e-15);
    for (int k = 0; k < 2; ++k) {
      assert_int_equal(b.axis[k], axes[n][k]);
      assert_true(b.direction[k][b.axis[k]] > 0.0);
      assert_true(fabs(fg__dot(b.direction[k], b.normal)) < 1e-15);
      assert_true(fabs(fg__dot(b.direction[k], b.direction[k]) - 1.0) < 1e-15);
    }
    assert_int_equal(fg__plane_is_axis(&b, 0) && fg__plane_is_axis(&b, 1), n < 3);
  }
  fg__plane_basis b;
  assert_false(fg__plane_basis_of(&b, (double[]){0, 0, 0}));
  assert_false(fg__plane_basis_of(&b, (double[]){1, (double)NAN, 0}));
}

static void round_a_period_it_goes_on(void **state)
{
  volume *v = *state;
  v->arrays.period[0] = 3.5;
  const fg_plane plane = {{1.0, 0.0, 0.0}, {2.25 + 7.0, 0.0, 0.0}}; /* last to first */
  fg_field *field = cut(v, &plane);
  const fg_field_arrays *a = fg_field_contents(field);
  for (int n = 0; n < NY * NZ; ++n) {
    const double mean =
        0.5 * ((double)v->velocity[1][n * NX] + (double)v->velocity[1][n * NX + NX - 1]);
    assert_true(fabs((double)a->velocity[0][n] - mean) < 1e-5);
  }
  fg_field_destroy(field);
}

static void what_cannot_be_cut_is_refused(void **state)
{
  volume *v = *state;
  cut_refused(v, &(fg_plane){{0, 0, 1}, {0, 0, 7.5}}, "height = 7.5");
  cut_refused(v, &(fg_plane){{1, 1, 1}, {0, 0, 99}}, "misses");
  cut_refused(v, &(fg_plane){{0, 0, 0}, {0, 11, 4}}, "normal (0, 0, 0)");
  cut_refused(v, &(fg_plane){{0, 1, 0}, {0, (double)INFINITY, 0}}, "through");
  v->arrays.axis_units[2] = "hPa";
  cut_refused(v, &(fg_plane){{1, 0, 1}, {0, 11, 4}}, "same units");
  v->arrays.dimension = 2;
  cut_refused(v, &(fg_plane){{0, 0, 1}, {0, 0, 4}}, "2 dimensions");
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      TEST(a_plane_of_samples_is_itself),
      TEST(between_samples_it_is_linear),
      TEST(a_plane_without_vectors_in_it_is_refused),
      TEST(a_tilted_plane_has_its_components),
      TEST(a_tilted_plane_reaches_the_box),
      TEST(directions_are_natural),
      TEST(round_a_period_it_goes_on),
      TEST(what_cannot_be_cut_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
