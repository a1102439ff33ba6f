/* Plain HDF5 files, whose dimensions have no names: coordinates are found by theirs and
 * by their lengths. */
#define H5_USE_110_API
#include <hdf5.h>
#include <stdlib.h>

#include "flowgrain/inventory.h"
#include "read/netcdf/sample_example.h"

enum { NX = 5, NY = 4, NT = 3, MOST = 6, MOST_NUMBERS = 100 };

typedef enum quantity { X, Y, Z, T, U, V, W, WRONG } quantity;

/* An array along axes by their letters, the last fastest. */
typedef struct array {
  const char *name, *axes;
  quantity what;
} array;

static int length_of(char axis, bool square)
{
  return axis == 'l'   ? 2
         : axis == 'x' ? NX
         : axis == 'y' ? (square ? NX : NY)
         : axis == 't' ? NT
                       : NX + 1;
}

static double x_at(int i)
{
  return 10.0 + 2.0 * i + 0.25 * i * i;
}

static double y_at(int j)
{
  return 3.0 + 0.5 * j;
}

/* `n`: of time, and of layer. */
static double value_of(quantity what, double x, double y, int n)
{
  const double values[] = {[X] = x,
                           [Y] = y,
                           [Z] = 0.25 * n,
                           [T] = 10.0 * n,
                           [U] = x + 8.0 * y + 64.0 * n,
                           [V] = x - y,
                           [W] = 0.0,
                           [WRONG] = 0.0};
  return values[what];
}

static void write_array(hid_t file, const array *a, bool square)
{
  double out[MOST_NUMBERS];
  hsize_t length[3];
  const int rank = (int)strlen(a->axes);
  int all = 1;
  for (int k = 0; k < rank; ++k) {
    length[k] = (hsize_t)length_of(a->axes[k], square);
    all *= (int)length[k];
  }
  for (int n = 0; n < all; ++n) {
    int at[128] = {0}, rest = n;
    for (int k = rank - 1; k >= 0; --k) {
      at[(int)a->axes[k]] = rest % (int)length[k];
      rest /= (int)length[k];
    }
    out[n] = value_of(a->what, x_at(at['x']), y_at(at['y']), at['t'] + at['l']);
  }
  const hid_t space = H5Screate_simple(rank, length, NULL);
  const hid_t set = H5Dcreate2(file, a->name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
  assert_true(set >= 0 &&
              H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0);
  H5Dclose(set);
  H5Sclose(space);
}

static void write_file(const sample_file *f, const array *arrays, bool square)
{
  const hid_t file = H5Fcreate(f->path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  assert_true(file >= 0);
  for (int k = 0; k < MOST && arrays[k].name; ++k)
    write_array(file, &arrays[k], square);
  H5Fclose(file);
}

static void coordinates_name_dimensions(void **state)
{
  static const struct {
    array arrays[MOST];
    bool square;
    int time;
    fg_scale scale;
  } cases[] = {
      {{{"u", "yx", U}, {"v", "yx", V}, {"x", "x", X}, {"y", "y", Y}},
       .scale = FG_SCALE_PLAIN},
      {{{"x", "x", X}, {"y", "y", Y}, {"u", "xy", U}, {"v", "xy", V}},
       .scale = FG_SCALE_PLAIN},
      {{{"u", "yx", U}, {"v", "yx", V}, {"x", "x", X}, {"y", "y", Y}},
       .square = true,
       .scale = FG_SCALE_PLAIN},
      {{{"vx", "yx", U}, {"vy", "yx", V}, {"lon", "x", X}, {"lat", "y", Y}},
       .scale = FG_SCALE_GEO},
      {{{"u", "tyx", U},
        {"v", "tyx", V},
        {"xc", "x", X},
        {"yc", "y", Y},
        {"time", "t", T}},
       .time = 2,
       .scale = FG_SCALE_PLAIN},
      {{{"u", "tyx", U}, {"v", "tyx", V}, {"x", "x", X}, {"y", "y", Y}},
       .time = 1,
       .scale = FG_SCALE_PLAIN},
      {{{"u", "yx", U}, {"v", "yx", V}, {"x", "yx", X}, {"y", "yx", Y}},
       .scale = FG_SCALE_PLAIN},
  };
  sample_file *f = *state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    fg_field *field = NULL;
    write_file(f, cases[i].arrays, cases[i].square);
    if (fg_field_read(&field, f->context, f->path,
                      &(fg_read_options){.time = cases[i].time}))
      fail_msg("%zu: %s", i, fg_context_message(f->context));
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], NX);
    assert_int_equal(a->size[1], cases[i].square ? NX : NY);
    assert_int_equal(a->scale, cases[i].scale);
    for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
      const int at[2] = {n % NX, n / NX};
      const double x = x_at(at[0]), y = y_at(at[1]);
      assert_true(a->axis[0][at[0]] == x && a->axis[1][at[1]] == y);
      assert_true(a->velocity[0][n] == (float)value_of(U, x, y, cases[i].time));
      assert_true(a->velocity[1][n] == (float)value_of(V, x, y, 0));
    }
    fg_field_destroy(field);
  }
}

static void coordinates_that_do_not_fit_are_refused(void **state)
{
  static const array cases[][MOST] = {
      {{"u", "yx", U}, {"v", "yx", V}, {"x", "z", WRONG}, {"y", "y", Y}},
      {{"u", "yx", U}, {"v", "yx", V}, {"lon", "x", X}, {"lat", "z", WRONG}}};
  sample_file *f = *state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    write_file(f, cases[i], false);
    refuse_with(f, NULL, FG_STATUS_UNSUPPORTED,
                "which do not fit the 5 x 4 samples of 'u'");
  }
}

/* Two levels of one flow are a plane, of another a volume. */
static void two_layers_of_one_flow_are_a_plane(void **state)
{
  static const struct {
    array arrays[MOST];
    int dimension;
    const char *level;
  } cases[] = {
      {{{"u", "lyx", V},
        {"v", "lyx", X},
        {"w", "lyx", W},
        {"x", "x", X},
        {"y", "y", Y},
        {"z", "l", Z}},
       2,
       "z = 0 and 0.25"},
      {{{"u", "xly", W},
        {"v", "xly", V},
        {"w", "xly", X},
        {"x", "y", Y},
        {"y", "l", Z},
        {"z", "x", X}},
       2,
       "y = 0 and 0.25"},
      {{{"u", "lyx", U},
        {"v", "lyx", X},
        {"w", "lyx", W},
        {"x", "x", X},
        {"y", "y", Y},
        {"z", "l", Z}},
       3,
       NULL},
  };
  sample_file *f = *state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    fg_field *field = NULL;
    fg_inventory *inventory = NULL;
    write_file(f, cases[i].arrays, false);
    if (fg_field_read(&field, f->context, f->path, NULL))
      fail_msg("%zu: %s", i, fg_context_message(f->context));
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->dimension, cases[i].dimension);
    assert_true(!cases[i].level || strcmp(a->level, cases[i].level) == 0);
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    assert_int_equal(fg_inventory_vector_at(inventory, 0)->dimension, cases[i].dimension);
    fg_inventory_destroy(inventory);
    for (int n = 0; n < NX * NY && i == 0; ++n) {
      assert_true(a->velocity[0][n] == (float)(x_at(n % NX) - y_at(n / NX)));
      assert_true(a->velocity[1][n] == (float)x_at(n % NX));
    }
    for (int n = 0; n < NX * NY && i == 1; ++n) { /* x and z of the file */
      assert_true(a->velocity[0][n] == 0.0f);
      assert_true(a->velocity[1][n] == (float)x_at(n / NY));
    }
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(coordinates_name_dimensions, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(two_layers_of_one_flow_are_a_plane, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(coordinates_that_do_not_fit_are_refused,
                                      sample_set_up, sample_tear_down),
  };
  return cmocka_run_group_tests_name("read/netcdf/nameless", tests, NULL, NULL);
}
