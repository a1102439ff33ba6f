/* Meaning of stored numbers: packed, missing, masked, out of range. */
#include <math.h>

#include "read/netcdf/plain_example.h"

static void packed_values_are_unpacked(void **state)
{
  sample_file *f = *state;
  static const nc_type type[] = {NC_SHORT, NC_FLOAT, NC_DOUBLE, NC_INT, NC_BYTE};
  for (size_t k = 0; k < sizeof type / sizeof *type; ++k) {
    int id[2];
    make_plain(f, 0, type[k], id);
    double stored[COUNT];
    for (int i = 0; i < COUNT; ++i)
      stored[i] = 3 * i - 20;
    sample_number(f, id[0], "scale_factor", NC_FLOAT, 0.5);
    sample_number(f, id[0], "add_offset", NC_DOUBLE, -7.0);
    sample_put(f, id[0], stored);
    sample_end(f);
    fg_field *field = read_with(f, NULL);
    for (int i = 0; i < COUNT; ++i)
      assert_true(fg_field_contents(field)->velocity[0][i] ==
                  (float)(0.5 * stored[i] - 7.0));
    fg_field_destroy(field);
  }
}

static void assert_missing(sample_file *f, const int *where, int count)
{
  fg_field *field = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  for (int i = 0; i < COUNT; ++i) {
    bool wanted = false;
    for (int k = 0; k < count; ++k)
      wanted = wanted || where[k] == i;
    const bool missing = a->valid && !a->valid[i];
    if (missing != wanted)
      fail_msg("sample %d is %s", i, missing ? "missing" : "there");
  }
  fg_field_destroy(field);
}

static void missing_values_are_found(void **state)
{
  sample_file *f = *state;
  static const nc_type type[] = {NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE};
  for (size_t k = 0; k < sizeof type / sizeof *type; ++k) {
    const double fill = type[k] == NC_SHORT   ? NC_FILL_SHORT
                        : type[k] == NC_INT   ? NC_FILL_INT
                        : type[k] == NC_FLOAT ? (double)NC_FILL_FLOAT
                                              : NC_FILL_DOUBLE;
    double stored[COUNT];
    int id[2];
    for (int i = 0; i < COUNT; ++i)
      stored[i] = i + 1;

    make_plain(f, 0, type[k], id); /* values that were never written */
    stored[3] = fill;
    sample_put(f, id[1], stored);
    sample_end(f);
    assert_missing(f, (int[]){3}, 1);

    make_plain(f, 0, type[k], id); /* two reasons; the range is of stored values */
    stored[3] = -999.0;
    stored[4] = -777.0;
    stored[19] = 300.0;
    nc_must(nc_redef(f->id));
    nc_must(nc_put_att_double(f->id, id[0], "_FillValue", type[k], 1, &stored[3]));
    sample_number(f, id[0], "missing_value", type[k], -777.0);
    sample_number(f, id[0], "valid_max", type[k], 299.0);
    sample_number(f, id[0], "scale_factor", NC_DOUBLE, 0.01);
    sample_put(f, id[0], stored);
    sample_end(f);
    assert_missing(f, (int[]){3, 4, 19}, 3);
    stored[19] = 20.0;
  }
}

static void not_a_number_is_missing(void **state)
{
  sample_file *f = *state;
  int id[2];
  double stored[COUNT] = {1.0, 2.0, 3.0};
  stored[2] = (double)NAN;
  stored[17] = -1e34;
  make_plain(f, 0, NC_FLOAT, id);
  sample_number(f, id[0], "missing_value", NC_DOUBLE, -1e34); /* not exact in float */
  sample_put(f, id[0], stored);
  sample_end(f);
  assert_missing(f, (int[]){2, 17}, 2);
}

/* A range of the unpacked type applies to unpacked values. */
static void unpacked_ranges_are_understood(void **state)
{
  sample_file *f = *state;
  int id[2];
  double stored[COUNT];
  const double range[2] = {-1.0, 1.5};
  for (int i = 0; i < COUNT; ++i)
    stored[i] = i < 2 ? 400.0 * i - 200.0 : i;
  make_plain(f, 0, NC_SHORT, id);
  sample_number(f, id[0], "scale_factor", NC_DOUBLE, 0.01);
  sample_define(f);
  nc_must(nc_put_att_double(f->id, id[0], "valid_range", NC_DOUBLE, 2, range));
  sample_put(f, id[0], stored);
  sample_end(f);
  assert_missing(f, (int[]){0, 1}, 2);
}

static void unsigned_bytes_are_understood(void **state)
{
  sample_file *f = *state;
  int id[2];
  double stored[COUNT] = {5.0, -1.0, -128.0, 127.0};
  make_plain(f, 0, NC_BYTE, id);
  sample_text(f, id[0], "_Unsigned", "true");
  sample_put(f, id[0], stored);
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  const float *u = fg_field_contents(field)->velocity[0];
  assert_true(u[0] == 5.0f && u[1] == 255.0f && u[2] == 128.0f && u[3] == 127.0f);
  fg_field_destroy(field);
}

static void bad_values_are_refused(void **state)
{
  sample_file *f = *state;
  int id[2];
  double stored[COUNT] = {1.0};
  make_plain(f, 0, NC_DOUBLE, id);
  stored[7] = HUGE_VAL;
  sample_put(f, id[1], stored);
  sample_end(f);
  assert_missing(f, (int[]){7}, 1);
  fg_field *field = read_with(f, NULL);
  assert_int_equal(fg_field_infinite(field), 1);
  fg_field_destroy(field);
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_true(fabs(fg_inventory_vector_at(inventory, 0)->missing_share - 1.0 / COUNT) <
              1e-12);
  fg_inventory_destroy(inventory);

  make_plain(f, 0, NC_DOUBLE, id);
  stored[7] = 1e300;
  sample_put(f, id[1], stored);
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_FILE_FORMAT, "sample (2, 1)");

  make_plain(f, 0, NC_DOUBLE, id);
  memset(stored, 0, sizeof stored);
  sample_put(f, id[0], stored);
  sample_put(f, id[1], stored);
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_FILE_FORMAT, "zero everywhere");

  make_plain(f, 0, NC_DOUBLE, id);
  for (int i = 0; i < COUNT; ++i)
    stored[i] = i < 5 ? NC_FILL_DOUBLE : (double)NAN;
  sample_put(f, id[1], stored);
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_FILE_FORMAT,
              "all 20 samples of 'v' are missing (5 fill values, 0 outside the valid "
              "range, 15 not a number)");
}

static void masks_cut_the_domain(void **state)
{
  sample_file *f = *state;
  int id[2];
  int dimension[2];
  double stored[COUNT];
  make_plain(f, 0, NC_FLOAT, id);
  nc_must(nc_inq_dimid(f->id, "x", &dimension[0]));
  nc_must(nc_inq_dimid(f->id, "y", &dimension[1]));
  const int mask = sample_variable(f, "sea", NC_BYTE, 2, dimension); /* (x, y)! */
  for (int i = 0; i < COUNT; ++i)
    stored[i] = i == 2 * NY + 3 ? 0.0 : 1.0; /* x 2, y 3 */
  sample_put(f, mask, stored);
  const int line = sample_variable(f, "line", NC_BYTE, 1, dimension);
  sample_put(f, line, stored);
  sample_end(f);
  const fg_read_options options = {.mask = "sea"};
  fg_field *field = read_with(f, &options);
  const fg_field_arrays *a = fg_field_contents(field);
  for (int i = 0; i < COUNT; ++i)
    assert_int_equal(a->valid[i], i != 3 * NX + 2);
  fg_field_destroy(field);
  refuse_with(f, &(fg_read_options){.mask = "land"}, FG_STATUS_ARGUMENT, "'land'");
  refuse_with(f, &(fg_read_options){.mask = "line"}, FG_STATUS_ARGUMENT, "'line'");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(packed_values_are_unpacked),    CASE(missing_values_are_found),
      CASE(not_a_number_is_missing),       CASE(unpacked_ranges_are_understood),
      CASE(unsigned_bytes_are_understood), CASE(bad_values_are_refused),
      CASE(masks_cut_the_domain),
  };
  return cmocka_run_group_tests_name("read/netcdf/stored", tests, NULL, NULL);
}
