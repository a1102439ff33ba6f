/* A pair of variables along uneven axes x and y. */
#ifndef FG__NETCDF_PLAIN_TEST_H
#define FG__NETCDF_PLAIN_TEST_H

#include <math.h>

#include "read/netcdf/sample_example.h"

enum { NX = 5, NY = 4, COUNT = NX * NY };

static const double X[NX] = {1.5, 2.0, 4.0, 4.5, 7.0};
static const double Y[NY] = {-3.0, -1.0, 0.5, 0.75};

/* Different for every index, so that swapped indices show. */
static inline double u_of(double x, double y, int t, int z)
{
  return 1.0 + 0.5 * x - 0.25 * y + 10.0 * t + 100.0 * z;
}

static inline double v_of(double x, double y, int t, int z)
{
  return -2.0 + 0.125 * x + 2.0 * y - 16.0 * t + 200.0 * z;
}

/* A file with the pair u, v along x, y. Returns the dimensions y, x. */
static inline void make_plain(sample_file *f, int mode, nc_type type, int id[2])
{
  double values[2][COUNT];
  sample_begin(f, mode);
  const int y = sample_axis(f, "y", NY, Y, "km");
  const int x = sample_axis(f, "x", NX, X, "km");
  const int all[2] = {y, x};
  for (int k = 0; k < 2; ++k)
    id[k] = sample_variable(f, k == 0 ? "u" : "v", type, 2, all);
  for (int i = 0; i < COUNT; ++i) {
    values[0][i] = u_of(X[i % NX], Y[i / NX], 0, 0);
    values[1][i] = v_of(X[i % NX], Y[i / NX], 0, 0);
  }
  for (int k = 0; k < 2; ++k)
    sample_put(f, id[k], values[k]);
}

static inline void assert_samples(const fg_field *field, int t, int z)
{
  const fg_field_arrays *a = fg_field_contents(field);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const double x = a->axis[0][i];
      const double y = a->axis[1][j];
      assert_true(fabs((double)a->velocity[0][j * a->size[0] + i] - u_of(x, y, t, z)) <
                  1e-4);
      assert_true(fabs((double)a->velocity[1][j * a->size[0] + i] - v_of(x, y, t, z)) <
                  1e-4);
    }
}

#endif
