#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "file/folder_test.h"
#include "flowgrain/energy.h"

/* Samples and eigenvalues are kept in float. */
static const double ROUNDING = 3e-6;

enum { NX = 4, NY = 3, NZ = 3 };

/* Linear in the place, diagonally dominant, so positive definite; xx, xy, yy, zz, xz, yz.
 * zz at the upper corner is the greatest entry; its row's others are 0 there. */
static void tensor_of(double a[6], double x, double y, double z)
{
  a[0] = 2.0 + 0.3 * x - 0.1 * z;
  a[1] = 0.2 * y - 0.4 + 0.1 * x;
  a[2] = 3.0 - 0.5 * y + 0.2 * z;
  a[3] = 2.5 + 0.25 * x + 0.1 * y;
  a[4] = 0.3 - 0.2 * x;
  a[5] = 0.1 * z - 0.2 * y;
}

static fg_field *box(fg_context *context, int dimension)
{
  static const double axis[3][2] = {{0.0, 3.0}, {0.0, 2.0}, {0.0, 2.0}};
  static const float ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  fg_field_arrays arrays = {.dimension = dimension,
                            .size = {2, 2, 2},
                            .axis = {axis[0], axis[1], axis[2]},
                            .velocity = {ones, ones, ones}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* The law gives the tensor between samples, over one number. */
static void assert_law(folder *f, int dimension)
{
  fg_field *field = box(f->context, dimension);
  fg_tensors *tensors = NULL;
  fg_status status = fg_tensors_read(&tensors, f->context, f->path, field);
  if (status)
    print_error("%s\n", fg_context_message(f->context));
  assert_int_equal(status, FG_STATUS_OK);
  const fg_energy_law *law = fg_tensors_law(tensors);
  assert_true(law->anisotropy > 0.0 && law->anisotropy < 1.0);
  assert_false(law->axes);
  double ratio = 0.0;
  for (int n = 0; n < 20; ++n) {
    fg_energy_place place = {
        .field = field,
        .position = {0.15 * n, 2.0 - 0.1 * n, dimension == 3 ? 0.5 + 0.07 * n : 0.0},
        .anisotropy = law->anisotropy};
    double wanted[6], got[6];
    tensor_of(wanted, place.position[0], place.position[1], place.position[2]);
    law->tensor(got, &place, law->data);
    if (n == 0)
      ratio = wanted[0] / got[0];
    for (int k = 0; k < (dimension == 3 ? 6 : 3); ++k)
      assert_true(fabs(got[k] * ratio - wanted[k]) < 3.0 * ROUNDING);
  }
  assert_true(ratio > 1.0);
  fg_tensors_destroy(tensors);
  fg_field_destroy(field);
}

static void write_vtk(folder *f, const char *keyword, int layers)
{
  snprintf(f->path, sizeof f->path, "%s/tensors.vtk", f->name);
  FILE *file = fopen(f->path, "w");
  assert_non_null(file);
  fprintf(file,
          "# vtk DataFile Version 3.0\na title\nASCII\nDATASET STRUCTURED_POINTS\n"
          "DIMENSIONS %d %d %d\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA %d\n"
          "SCALARS other float\nLOOKUP_TABLE default\n",
          NX, NY, layers, NX * NY * layers);
  for (int n = 0; n < NX * NY * layers; ++n)
    fprintf(file, "%d\n", n);
  fprintf(file, "%s a double\n", keyword);
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < NY; ++j)
      for (int i = 0; i < NX; ++i) {
        double a[6];
        tensor_of(a, i, j, k);
        if (strcmp(keyword, "TENSORS6") == 0)
          fprintf(file, "%.9g %.9g %.9g %.9g %.9g %.9g\n", a[0], a[2], a[3], a[1], a[5],
                  a[4]);
        else
          fprintf(file, "%.9g %.9g %.9g  %.9g %.9g %.9g  %.9g %.9g %.9g\n", a[0], a[1],
                  a[4], a[1], a[2], a[5], a[4], a[5], a[3]);
      }
  assert_int_equal(fclose(file), 0);
}

static void vtk_tensors_of_nine_and_six_components_are_read(void **state)
{
  folder *f = *state;
  for (int layers = 1; layers <= NZ; layers += NZ - 1) {
    write_vtk(f, "TENSORS", layers);
    assert_law(f, layers > 1 ? 3 : 2);
    write_vtk(f, "TENSORS6", layers);
    assert_law(f, layers > 1 ? 3 : 2);
  }
}

static void axes_that_descend_are_reversed(void **state)
{
  folder *f = *state;
  snprintf(f->path, sizeof f->path, "%s/tensors.vtk", f->name);
  FILE *file = fopen(f->path, "w");
  assert_non_null(file);
  fprintf(file,
          "# vtk DataFile Version 3.0\na title\nASCII\nDATASET RECTILINEAR_GRID\n"
          "DIMENSIONS 4 3 1\nX_COORDINATES 4 float\n3 2 1 0\nY_COORDINATES 3 float\n"
          "2 1 0\nZ_COORDINATES 1 float\n0\nPOINT_DATA 12\nTENSORS a double\n");
  for (int j = NY - 1; j >= 0; --j)
    for (int i = NX - 1; i >= 0; --i) {
      double a[6];
      tensor_of(a, i, j, 0.0);
      fprintf(file, "%.9g %.9g 0  %.9g %.9g 0  0 0 1\n", a[0], a[1], a[1], a[2]);
    }
  assert_int_equal(fclose(file), 0);
  assert_law(f, 2);
}

static void netcdf_variables_are_read(void **state)
{
  folder *f = *state;
  static const char *const name[6] = {"xx", "xy", "yy", "zz", "xz", "yz"};
  static const char *const axes[3] = {"z", "y", "x"};
  for (int dimension = 2; dimension <= 3; ++dimension) {
    int file, dim[3], axis[3], variable[6], skip = 3 - dimension;
    int variables = dimension == 3 ? 6 : 3;
    const size_t size[3] = {NZ, NY, NX};
    snprintf(f->path, sizeof f->path, "%s/tensors.nc", f->name);
    assert_int_equal(nc_create(f->path, NC_CLOBBER, &file), NC_NOERR);
    for (int k = skip; k < 3; ++k) {
      assert_int_equal(nc_def_dim(file, axes[k], size[k], &dim[k]), NC_NOERR);
      assert_int_equal(nc_def_var(file, axes[k], NC_DOUBLE, 1, &dim[k], &axis[k]),
                       NC_NOERR);
      nc_put_att_text(file, axis[k], "units", 1, "m");
    }
    for (int k = 0; k < variables; ++k)
      assert_int_equal(
          nc_def_var(file, name[k], NC_FLOAT, dimension, dim + skip, &variable[k]),
          NC_NOERR);
    assert_int_equal(nc_enddef(file), NC_NOERR);
    const double places[4] = {0.0, 1.0, 2.0, 3.0};
    for (int k = skip; k < 3; ++k)
      nc_put_var_double(file, axis[k], places);
    float values[6][NX * NY * NZ];
    for (int n = 0; n < NX * NY * (dimension == 3 ? NZ : 1); ++n) {
      double a[6];
      tensor_of(a, n % NX, n / NX % NY, (double)(n / (NX * NY)));
      for (int k = 0; k < 6; ++k)
        values[k][n] = (float)a[k];
    }
    for (int k = 0; k < variables; ++k)
      assert_int_equal(nc_put_var_float(file, variable[k], values[k]), NC_NOERR);
    assert_int_equal(nc_close(file), NC_NOERR);
    assert_law(f, dimension);
  }
}

static void tensors_of_another_dimension_are_refused(void **state)
{
  folder *f = *state;
  write_vtk(f, "TENSORS", NZ);
  fg_field *field = box(f->context, 2);
  fg_tensors *tensors = NULL;
  assert_int_equal(fg_tensors_read(&tensors, f->context, f->path, field),
                   FG_STATUS_ARGUMENT);
  assert_null(tensors);
  assert_non_null(strstr(fg_context_message(f->context), "in 3 dimensions"));
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, folder_set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(vtk_tensors_of_nine_and_six_components_are_read),
      CASE(axes_that_descend_are_reversed),
      CASE(netcdf_variables_are_read),
      CASE(tensors_of_another_dimension_are_refused),
  };
  return cmocka_run_group_tests_name("load/tensors", tests, NULL, NULL);
}
