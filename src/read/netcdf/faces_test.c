/* Staggered components in a plane, and walls between them. */
#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

/* Columns and rows of a plane in metres, x of index i, y of index j. */
static double plane_at(int k, double n)
{
  return k == 0 ? 1000.0 + 200.0 * n : 9000.0 - 500.0 * n;
}

/* Linear, so that the mean of two faces is exact. */
static double plane_flow(int k, double x, double y)
{
  return k == 0 ? 2e-4 * x + 1e-4 * y : 3e-4 * y - 1e-4 * x;
}

typedef struct plane_model {
  const char *along[2], *across[2]; /* dimensions of the faces, of the centres */
  int more;                         /* number of faces less number of centres */
  double shift;                     /* of face 0 from centre 0, in cells */
  bool lines; /* the dimensions have coordinates, else there are x_rho, y_rho */
} plane_model;

enum { PLANE_COLUMNS = 7, PLANE_ROWS = 5 };

static void write_component(sample_file *f, const plane_model *model, int k,
                            const int centre[2])
{
  double values[(PLANE_COLUMNS + 1) * (PLANE_ROWS + 1)], line[PLANE_COLUMNS + 1];
  size_t size[2] = {PLANE_COLUMNS, PLANE_ROWS};
  size[k] += (size_t)model->more;
  for (size_t n = 0; n < size[k]; ++n)
    line[n] = plane_at(k, (double)n + model->shift);
  int dimension[2] = {centre[1], centre[0]};
  dimension[1 - k] = model->lines ? sample_axis(f, model->along[k], size[k], line, "m")
                                  : sample_dimension(f, model->along[k], size[k]);
  for (size_t n = 0; n < size[0] * size[1]; ++n) {
    const double i = (double)(n % size[0]) + (k == 0 ? model->shift : 0.0);
    const double j = (double)(n / size[0]) + (k == 1 ? model->shift : 0.0);
    values[n] = plane_flow(k, plane_at(0, i), plane_at(1, j));
  }
  const int id = sample_variable(f, k == 0 ? "u" : "v", NC_DOUBLE, 2, dimension);
  sample_text(f, id, "units", "m s-1");
  sample_put(f, id, values);
}

static void write_plane_model(sample_file *f, const plane_model *model)
{
  static const char *const names[] = {"x_rho", "y_rho"};
  double line[2][PLANE_COLUMNS], plane[PLANE_COLUMNS * PLANE_ROWS];
  int centre[2];
  sample_begin(f, 0);
  for (int k = 0; k < 2; ++k) {
    const size_t size = k == 0 ? PLANE_COLUMNS : PLANE_ROWS;
    for (size_t n = 0; n < size; ++n)
      line[k][n] = plane_at(k, (double)n);
    centre[k] = model->lines ? sample_axis(f, model->across[k], size, line[k], "m")
                             : sample_dimension(f, model->across[k], size);
  }
  for (int k = 0; k < 2 && !model->lines; ++k) {
    const int id =
        sample_variable(f, names[k], NC_DOUBLE, 2, (int[]){centre[1], centre[0]});
    sample_text(f, id, "units", "meter");
    for (int n = 0; n < PLANE_COLUMNS * PLANE_ROWS; ++n)
      plane[n] = line[k][k == 0 ? n % PLANE_COLUMNS : n / PLANE_COLUMNS];
    sample_put(f, id, plane);
  }
  for (int k = 0; k < 2; ++k)
    write_component(f, model, k, centre);
  sample_end(f);
}

/* Grids in metres: faces and centres are placed by coordinates, or by the dimensions'
 * names. Rows descend. */
static void planes_have_faces(void **state)
{
  static const plane_model models[] = {
      {{"Xp1", "Yp1"}, {"X", "Y"}, 1, -0.5, true},
      {{"XG", "YG"}, {"XC", "YC"}, 0, -0.5, true},
      {{"xq", "yq"}, {"xh", "yh"}, 0, 0.5, true},
      {{"xi_u", "eta_v"}, {"xi_rho", "eta_rho"}, -1, 0.5, false}};
  static const int columns[] = {7, 6, 6, 5}, rows[] = {5, 4, 4, 3};
  sample_file *f = *state;
  for (size_t m = 0; m < sizeof models / sizeof *models; ++m) {
    write_plane_model(f, &models[m]);
    fg_field *field = read_with(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->scale, FG_SCALE_MAP);
    assert_int_equal(a->size[0], columns[m]);
    assert_int_equal(a->size[1], rows[m]);
    for (int j = 0; j < a->size[1]; ++j)
      for (int i = 0; i < a->size[0]; ++i)
        for (int k = 0; k < 2; ++k)
          assert_float_equal((double)a->velocity[k][j * a->size[0] + i],
                             plane_flow(k, a->axis[0][i], a->axis[1][j]), 1e-5);
    fg_field_destroy(field);
    fg_inventory *inventory;
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    assert_string_equal(fg_inventory_vector_at(inventory, 0)->frame,
                        "along the axes (a staggered grid)");
    fg_inventory_destroy(inventory);
  }
}

/* A missing face beside a present one is a wall; a centre is missing where all faces of
 * either component are. */
static void walls_are_zero(void **state)
{
  static const double x[] = {0.0, 1.0, 2.0, 3.0}, xf[] = {-0.5, 0.5, 1.5, 2.5, 3.5};
  static const double y[] = {0.0, 1.0}, yf[] = {-0.5, 0.5, 1.5};
  const double w = NC_FILL_DOUBLE;
  const double u[] = {w, w, 4.0, 6.0, w, w, w, w, w, w};
  const double v[] = {w, 1.0, 2.0, w, w, 3.0, 4.0, w, w, w, 2.0, w};
  sample_file *f = *state;
  sample_begin(f, 0);
  const int at[2][2] = {
      {sample_axis(f, "y", 2, y, "m"), sample_axis(f, "xf", 5, xf, "m")},
      {sample_axis(f, "yf", 3, yf, "m"), sample_axis(f, "x", 4, x, "m")}};
  sample_put(f, sample_variable(f, "u", NC_DOUBLE, 2, at[0]), u);
  sample_put(f, sample_variable(f, "v", NC_DOUBLE, 2, at[1]), v);
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  static const float expected[2][8] = {{NAN, 2.0F, 5.0F, 3.0F, NAN, 0.0F, 0.0F, NAN},
                                       {NAN, 2.0F, 3.0F, 0.0F, NAN, 1.5F, 3.0F, NAN}};
  for (int k = 0; k < 2; ++k)
    for (int n = 0; n < 8; ++n)
      if (isnan(expected[k][n]) ? !isnan(a->velocity[k][n])
                                : !(a->velocity[k][n] == expected[k][n]))
        fail_msg("%d, %d: %g", k, n, (double)a->velocity[k][n]);
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(planes_have_faces),
      CASE(walls_are_zero),
  };
  return cmocka_run_group_tests_name("read/netcdf/faces", tests, NULL, NULL);
}
