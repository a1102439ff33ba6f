/* One input answers several questions. */
#include "read/netcdf/sample_example.h"

enum { TIMES = 3, LEVELS = 2, NY = 4, NX = 5, COUNT = TIMES * LEVELS * NY * NX };

static void make_levels(sample_file *f, int mode)
{
  static const double time[] = {0.0, 6.0, 12.0}, level[] = {500.0, 850.0};
  static const double y[] = {0.0, 1.0, 2.0, 3.0}, x[] = {0.0, 1.0, 2.0, 3.0, 4.0};
  double sample[COUNT];
  sample_begin(f, mode);
  const int all[] = {sample_axis(f, "time", TIMES, time, "hours since 1982-07-16"),
                     sample_axis(f, "lev", LEVELS, level, "hPa"),
                     sample_axis(f, "y", NY, y, "km"), sample_axis(f, "x", NX, x, "km")};
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "u" : "v", NC_FLOAT, 4, all);
    for (int i = 0; i < COUNT; ++i)
      sample[i] = 1.0 + i + 100.0 * k;
    sample_text(f, id, "units", "m/s");
    sample_put(f, id, sample);
  }
  sample_end(f);
}

static void assert_first_sample(const fg_field *field, int time, int level)
{
  assert_non_null(field);
  const double first = 1.0 + (time * LEVELS + level) * NY * NX;
  const fg_field_arrays *arrays = fg_field_contents(field);
  assert_true(arrays->velocity[0][0] == (float)first);
  assert_true(arrays->velocity[1][0] == (float)(100.0 + first));
}

static fg_status read_at(fg_field **out, sample_file *f, fg_input *input, int time,
                         int level)
{
  fg_context_clear(f->context);
  return fg_input_field(out, f->context, input, time, level, 0, 1);
}

/* The file is gone after the first answer: no later one opens it. */
static void the_file_of_an_input_is_opened_once(void **state)
{
  static const int modes[] = {0, NC_NETCDF4};
  sample_file *f = *state;
  for (int m = 0; m < 2; ++m) {
    fg_input *input;
    fg_read_defaults defaults;
    const fg_inventory *inventory, *again;
    make_levels(f, modes[m]);
    const fg_read_options options = {.vars = "u,v", .time = 99, .level = 99};
    assert_int_equal(fg_input_open(&input, f->context, f->path, &options), 0);
    assert_int_equal(fg_input_defaults(&defaults, f->context, input), 0);
    unlink(f->path);
    assert_int_equal(fg_input_inventory(&inventory, f->context, input), 0);
    const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
    assert_int_equal(vector->times, TIMES);
    assert_string_equal(vector->level_value[1].words, "850 hPa");
    for (int time = 0; time < TIMES; ++time)
      for (int level = 0; level < LEVELS; ++level) {
        fg_field *field;
        assert_int_equal(read_at(&field, f, input, time, level), 0);
        assert_first_sample(field, time, level);
        fg_field_destroy(field);
      }
    assert_int_equal(fg_input_inventory(&again, f->context, input), 0);
    assert_ptr_equal(again, inventory);
    fg_input_close(input);
  }
}

static void an_answer_that_fails_ends_no_input(void **state)
{
  sample_file *f = *state;
  fg_input *input;
  fg_field *field = NULL;
  make_levels(f, 0);
  assert_int_equal(fg_input_open(&input, f->context, f->path, NULL), 0);
  assert_int_equal(read_at(&field, f, input, TIMES, 0), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), "time 3 asked for"));
  assert_null(field);
  assert_int_equal(fg_input_field(&field, f->context, input, 0, 0, 2, 2),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(read_at(&field, f, input, 2, 1), 0);
  assert_first_sample(field, 2, 1);
  fg_field_destroy(field);
  fg_input_close(input);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(the_file_of_an_input_is_opened_once),
      CASE(an_answer_that_fails_ends_no_input),
  };
  return cmocka_run_group_tests_name("read/netcdf/input", tests, NULL, NULL);
}
