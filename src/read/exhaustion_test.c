/* Every allocation of reading a file fails once: it is told as a lack of memory, not as
 * something that the file lacks, and nothing is left behind. */
#include "base/context_test.h"
#include "base/refusal_test.h"
#include "read/netcdf/sample_example.h"
#include "read/vtk/cells_example.h"

typedef fg_status use(const sample_file *f, const fg_read_options *options);

static fg_status read_it(const sample_file *f, const fg_read_options *options)
{
  fg_field *field = NULL;
  const fg_status status = fg_field_read(&field, f->context, f->path, options);
  assert_int_equal(status == FG_STATUS_OK, field != NULL);
  fg_field_destroy(field);
  return status;
}

static fg_status list_it(const sample_file *f, const fg_read_options *options)
{
  (void)options;
  fg_inventory *inventory = NULL;
  const fg_status status = fg_inventory_read(&inventory, f->context, f->path);
  assert_int_equal(status == FG_STATUS_OK, inventory != NULL);
  fg_inventory_destroy(inventory);
  return status;
}

static void fail_in_turn_of(use *of, const sample_file *f, const fg_read_options *options)
{
  static const char words[] = "out of memory";
  failing = -1;
  asked = unfreed = 0;
  if (of(f, options) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  assert_int_equal(unfreed, 0);
  const long all = asked;
  assert_true(all > 10);
  for (long n = 0; n < all; ++n) {
    fg_context_clear(f->context);
    asked = unfreed = 0;
    failing = n;
    const fg_status status = of(f, options);
    failing = -1;
    const char *message = fg_context_message(f->context);
    if (status != FG_STATUS_MEMORY || !strstr(message, words))
      fail_msg("allocation %ld of %ld: status %d, \"%s\"", n, all, status, message);
    assert_int_equal(unfreed, 0);
  }
}

static void fail_in_turn(const sample_file *f, const fg_read_options *options)
{
  fail_in_turn_of(read_it, f, options);
  fail_in_turn_of(list_it, f, options);
}

static void fail_in_turn_at(const sample_file *f, example_text *text)
{
  FILE *stream = fopen(f->path, "wb");
  assert_non_null(stream);
  assert_int_equal(fwrite(text->bytes, 1, text->size, stream), text->size);
  assert_int_equal(fclose(stream), 0);
  example_free(text);
  fail_in_turn(f, NULL);
}

enum { COLUMNS = 5, ROWS = 4, TIMES = 2 };

static void put_words(const sample_file *f, int variable, const char *name,
                      const char *words)
{
  sample_define(f);
  nc_must(nc_put_att_string(f->id, variable, name, 1, &words));
}

/* Packed components along time, latitude and longitude, and a mask; all that is said of
 * them in attributes, in texts or in strings. */
static void make_packed(sample_file *f, int mode)
{
  static const char *const names[] = {"eastward_wind", "northward_wind"};
  static const double lon[COLUMNS] = {10, 20, 30, 45, 50}, lat[ROWS] = {-10, 0, 5, 20},
                      time[TIMES] = {3, 9};
  double values[TIMES * ROWS * COLUMNS];
  int id[3], all[3];
  void (*say)(const sample_file *, int, const char *, const char *) =
      mode == NC_NETCDF4 ? put_words : sample_text;
  sample_begin(f, mode);
  all[0] = sample_axis(f, "time", TIMES, time, "hours since 2001-02-03");
  all[1] = sample_axis(f, "lat", ROWS, lat, "degrees_north");
  all[2] = sample_axis(f, "lon", COLUMNS, lon, "degrees_east");
  say(f, 0, "calendar", "noleap");
  say(f, NC_GLOBAL, "title", "small");
  for (int k = 0; k < 2; ++k) {
    id[k] = sample_variable(f, k == 0 ? "u" : "v", NC_SHORT, 3, all);
    say(f, id[k], "units", "m s-1");
    say(f, id[k], "standard_name", names[k]);
    say(f, id[k], "grid_mapping", "globe");
    sample_number(f, id[k], "scale_factor", NC_FLOAT, 0.5);
    sample_number(f, id[k], "add_offset", NC_FLOAT, 2.0);
    sample_number(f, id[k], "missing_value", NC_SHORT, -999);
    sample_number(f, id[k], "valid_min", NC_SHORT, -500);
  }
  id[2] = sample_variable(f, "sea", NC_SHORT, 2, all + 1);
  say(f, sample_variable(f, "globe", NC_INT, 0, NULL), "grid_mapping_name",
      "latitude_longitude");
  for (int k = 0; k < 3; ++k) {
    for (int n = 0; n < TIMES * ROWS * COLUMNS; ++n)
      values[n] = k == 2 ? n % 7 > 0 : (3 + k) * n % 11 - 4;
    sample_put(f, id[k], values);
  }
  sample_end(f);
}

static void a_classic_file(void **state)
{
  make_packed(*state, 0);
  fail_in_turn(*state, &(fg_read_options){.time = 1, .mask = "sea"});
}

static void a_file_of_strings(void **state)
{
  make_packed(*state, NC_NETCDF4);
  fail_in_turn(*state, &(fg_read_options){.vars = "u,v"});
}

static void an_image(void **state)
{
  static const double numbers[12] = {1, 2, 0, 3, -1, 0, 2, 2, 0, 5, 1, 0};
  const example_encoding ascii = {.storage = EXAMPLE_ASCII, .type = EXAMPLE_FLOAT64};
  example_text file = {0}, appended = {0};
  example_begin(&file, &ascii,
                "WholeExtent=\"0 1 0 1 0 0\" Origin=\"1 2 0\" Spacing=\"0.5 2 1\" "
                "Direction=\"1 0 0 0 1 0 0 0 1\"");
  example_words(&file, "<FieldData>");
  example_array(&file, &appended, &ascii, "TimeValue", 1, numbers, 1);
  example_words(&file, "</FieldData><Piece Extent=\"0 1 0 1 0 0\">"
                       "<PointData Vectors=\"wind\">"
                       "<DataArray type=\"Float32\" Name=\"wind\" format=\"ascii\" "
                       "NumberOfComponents=\"3\"><InformationKey name=\"UNITS_LABEL\"> "
                       "m/s </InformationKey>1 2 0 3 -1 0<!-- and --> 2 2 0 5 1 0"
                       "</DataArray></PointData></Piece>");
  example_end(&file, &appended, &ascii);
  fail_in_turn_at(*state, &file);
}

static void a_packed_image(void **state)
{
  static const double numbers[12] = {1, 2, 0, 3, -1, 0, 2, 2, 0, 5, 1, 0};
  const example_encoding packed = {.storage = EXAMPLE_APPENDED_BASE64,
                                   .zlib = true,
                                   .block = 40,
                                   .type = EXAMPLE_FLOAT64};
  example_text file = {0}, appended = {0};
  example_begin(&file, &packed, "WholeExtent=\"0 1 0 1 0 0\"");
  example_words(&file, "<Piece Extent=\"0 1 0 1 0 0\"><PointData>");
  example_array(&file, &appended, &packed, "wind", 3, numbers, 12);
  example_words(&file, "</PointData></Piece>");
  example_end(&file, &appended, &packed);
  fail_in_turn_at(*state, &file);
}

static void cells_in_markup(void **state)
{
  example_text file = vtu(&RAW, "");
  fail_in_turn_at(*state, &file);
}

static void a_curvilinear_grid(void **state)
{
  example_text file = vts(&RAW, 0.1);
  fail_in_turn_at(*state, &file);
}

static void a_grid_along_the_axes(void **state)
{
  example_text file = vts(&RAW, 0.0);
  fail_in_turn_at(*state, &file);
}

static void a_legacy_file(void **state)
{
  for (int offsets = 0; offsets < 2; ++offsets) {
    example_text file = legacy(offsets == 0, offsets == 1);
    fail_in_turn_at(*state, &file);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_classic_file),        CASE(a_file_of_strings), CASE(an_image),
      CASE(a_packed_image),        CASE(cells_in_markup),   CASE(a_curvilinear_grid),
      CASE(a_grid_along_the_axes), CASE(a_legacy_file),
  };
  return cmocka_run_group_tests_name("read/exhaustion", tests, NULL, NULL);
}
