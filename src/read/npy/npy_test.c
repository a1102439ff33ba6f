/* Files that NumPy has written: tests/fuzz/corpus/points. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "read/format.h"

static const char FOLDER[] = FLOWGRAIN_SOURCE_DIR "/tests/fuzz/corpus/points/";

/* u is i + 10 j and v is i - 2.5 j + 1 at sample (i, j) of 4 x 3, where i and j count
 * along x = 1, 2, 4, 7 and y = -1, 0.5, 3 when the file has these. */
static void check(fg_field *field, bool has_axes, int missing)
{
  static const double x[] = {1.0, 2.0, 4.0, 7.0}, y[] = {-1.0, 0.5, 3.0};
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->dimension, 2);
  assert_int_equal(f->size[0], 4);
  assert_int_equal(f->size[1], 3);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      const int n = 4 * j + i;
      assert_true(f->axis[0][i] == (has_axes ? x[i] : i));
      assert_true(f->axis[1][j] == (has_axes ? y[j] : j));
      assert_int_equal(!f->valid || f->valid[n], n != missing);
      if (n == missing)
        continue;
      assert_true((double)f->velocity[0][n] == i + 10.0 * j);
      assert_true((double)f->velocity[1][n] == i - 2.5 * j + 1.0);
    }
  fg_field_destroy(field);
}

typedef struct example {
  const char *name;
  bool has_axes;
  int missing;
  fg_read_options options;
} example;

static const example EXAMPLES[] = {
    {"seed-first.npy", false, -1, {0}},
    {"seed-last-fortran-big.npy", false, -1, {0}},
    {"seed-complex.npy", false, -1, {0}},
    {"seed-half-big.npy", false, -1, {0}},
    {"seed-without-names.npz", true, -1, {0}},
    {"seed-rows.npy", true, -1, {0}},
    {"seed-axes.npz", true, -1, {0}},
    {"seed-meshgrid.npz", true, -1, {0}},
    {"seed-transposed-times.npz", true, -1, {.time = 1}},
    {"seed-mask.npz", true, 3, {.vars = "u,v"}},
};
enum { EXAMPLE_COUNT = sizeof EXAMPLES / sizeof *EXAMPLES };

static void what_numpy_writes_is_read(void **state)
{
  for (int i = 0; i < EXAMPLE_COUNT; ++i) {
    char path[512];
    fg_field *field = NULL;
    snprintf(path, sizeof path, "%s%s", FOLDER, EXAMPLES[i].name);
    if (fg_field_read(&field, *state, path, &EXAMPLES[i].options))
      fail_msg("%s", fg_context_message(*state));
    check(field, EXAMPLES[i].has_axes, EXAMPLES[i].missing);
  }
}

static void choices_that_do_not_fit_are_refused(void **state)
{
  static const struct {
    const char *name, *words;
    fg_read_options options;
  } refused[] = {
      {"seed-axes.npz", "has no variable 'w'", {.vars = "u,w"}},
      {"seed-axes.npz", "'x' has 1 dimension", {.vars = "u,x"}},
      {"seed-axes.npz", "'x' is one variable", {.vars = "x"}},
      {"fault-five-without-names.npz", "no vectors found among its 5 variables: ", {0}},
      {"seed-transposed-times.npz", "time 2 asked for, but 'time' has 2", {.time = 2}},
      {"seed-first.npy", "has no variable 'sea' for the mask", {.mask = "sea"}},
      {"fault-bomb.npz", "claims to become 1073741952 bytes of 101", {0}},
      {"fault-overlap.npz", "entries overlap", {0}},
      {"fault-checksum.npz", "its checksum is not", {0}},
      {"fault-more.npy",
       "after the 24 numbers of array \"array\" come 4 bytes more",
       {0}},
      {"fault-overflow.npy", "claims more numbers than the 24", {0}},
  };
  for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
    char path[512];
    fg_field *field = NULL;
    snprintf(path, sizeof path, "%s%s", FOLDER, refused[i].name);
    assert_int_not_equal(fg_field_read(&field, *state, path, &refused[i].options),
                         FG_STATUS_OK);
    assert_null(field);
    if (!strstr(fg_context_message(*state), refused[i].words))
      fail_msg("\"%s\" lacks \"%s\"", fg_context_message(*state), refused[i].words);
    fg_context_clear(*state);
  }
}

/* Wind from the east. */
static void speeds_and_directions_are_turned(void **state)
{
  char path[512];
  fg_field *field = NULL;
  snprintf(path, sizeof path, "%sseed-speed-direction.npz", FOLDER);
  assert_int_equal(fg_field_read(&field, *state, path, NULL), FG_STATUS_OK);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->size[0] == 3 && f->size[1] == 2 && f->scale == FG_SCALE_GEO);
  for (int n = 0; n < 6; ++n) {
    assert_true(f->velocity[0][n] == -2.0f);
    assert_true(fabsf(f->velocity[1][n]) < 1e-6f);
  }
  fg_field_destroy(field);
}

static fg_status try_bytes(fg_context *context, const unsigned char *bytes, size_t size)
{
  static const fg_read_options options = {0};
  const fg__source source = {.path = "bytes", .bytes = bytes, .size = size};
  const fg__format *format = fg__format_find(bytes, size);
  fg_field *field = NULL;
  if (!format)
    return FG_STATUS_FILE_FORMAT;
  const fg_status status = fg__dataset_read(&field, context, format, &source, &options,
                                            (fg__slab_index){0, 1});
  assert_int_equal(status == FG_STATUS_OK, field != NULL);
  assert_true(status == FG_STATUS_OK || fg_context_message(context)[0]);
  fg_field_destroy(field);
  fg_context_clear(context);
  return status;
}

/* Cut off at each byte, a file is refused; with a byte changed it may be another. */
static void damaged_files_do_no_harm(void **state)
{
  for (int i = 0; i < EXAMPLE_COUNT; ++i) {
    char path[512];
    unsigned char bytes[2048];
    snprintf(path, sizeof path, "%s%s", FOLDER, EXAMPLES[i].name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t n = 0; n < size; ++n) {
      unsigned char *copy = malloc(n + 1);
      assert_non_null(copy);
      memcpy(copy, bytes, n);
      assert_int_not_equal(try_bytes(*state, copy, n), FG_STATUS_OK);
      free(copy);
      const unsigned char kept = bytes[n];
      bytes[n] ^= (unsigned char)(1U << n % 8);
      try_bytes(*state, bytes, size);
      bytes[n] = 0xff;
      try_bytes(*state, bytes, size);
      bytes[n] = kept;
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_numpy_writes_is_read),
      cmocka_unit_test(speeds_and_directions_are_turned),
      cmocka_unit_test(choices_that_do_not_fit_are_refused),
      cmocka_unit_test(damaged_files_do_no_harm),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
