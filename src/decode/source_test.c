/* Files that change while they are open. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_test.h"
#include "decode/source.h"

static char path[] = "/tmp/flowgrain-source-XXXXXX";

static int set_up(void **state)
{
  const int file = mkstemp(path);
  if (file < 0 || fg_context_create((fg_context **)state) != FG_STATUS_OK)
    return -1;
  return close(file);
}

static int tear_down(void **state)
{
  fg_context_destroy(*state);
  return unlink(path);
}

/* A file of 1000 bytes becomes another length, and its reading ends with `status`. */
static fg_status read_as(fg_context *context, long length, fg_status status)
{
  fg__source source;
  fg_context_clear(context);
  assert_int_equal(truncate(path, 1000), 0);
  assert_int_equal(fg__source_open(&source, context, path), FG_STATUS_OK);
  assert_int_equal(source.size, 1000);
  assert_int_equal(truncate(path, length), 0);
  if (status != FG_STATUS_OK)
    fg__fail(context, status, "its zeros are wrong");
  return fg__source_close(&source, context, status);
}

static void a_file_that_became_shorter_was_not_read(void **state)
{
  static const struct {
    long length;
    fg_status status, expected;
  } rows[] = {{1000, FG_STATUS_OK, FG_STATUS_OK},
              {5000, FG_STATUS_OK, FG_STATUS_OK}, /* one that grows is whole so far */
              {999, FG_STATUS_OK, FG_STATUS_FILE_ACCESS},
              {0, FG_STATUS_OK, FG_STATUS_FILE_ACCESS},
              {999, FG_STATUS_FILE_FORMAT, FG_STATUS_FILE_ACCESS},
              {999, FG_STATUS_UNSUPPORTED, FG_STATUS_FILE_ACCESS},
              {1000, FG_STATUS_FILE_FORMAT, FG_STATUS_FILE_FORMAT},
              {999, FG_STATUS_MEMORY, FG_STATUS_MEMORY},
              {999, FG_STATUS_STOPPED, FG_STATUS_STOPPED}};
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    char words[128];
    assert_int_equal(read_as(*state, rows[k].length, rows[k].status), rows[k].expected);
    snprintf(words, sizeof words,
             "%s: became shorter while it was read (1000 bytes, then %ld)", path,
             rows[k].length);
    if (rows[k].expected == FG_STATUS_FILE_ACCESS)
      assert_string_equal(fg_context_message(*state), words);
    else
      assert_string_equal(fg_context_message(*state),
                          rows[k].status ? "its zeros are wrong" : "");
  }
}

static void a_file_that_is_removed_is_there_until_it_is_closed(void **state)
{
  fg__source source;
  assert_int_equal(truncate(path, 1000), 0);
  assert_int_equal(fg__source_open(&source, *state, path), FG_STATUS_OK);
  assert_int_equal(unlink(path), 0);
  assert_int_equal(fg__source_close(&source, *state, FG_STATUS_OK), FG_STATUS_OK);
  FILE *again = fopen(path, "w");
  assert_non_null(again);
  fclose(again);
}

static void an_empty_file_is_called_what_it_is(void **state)
{
  static const char *const rows[][2] = {{"", "is empty (0 bytes)"},
                                        {".foam", "marks a case of OpenFOAM"},
                                        {".foam.csv", "is empty (0 bytes)"}};
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    char name[64];
    fg__source source;
    snprintf(name, sizeof name, "%s%s", path, rows[k][0]);
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fclose(file);
    fg_context_clear(*state);
    assert_int_equal(fg__source_open(&source, *state, name), FG_STATUS_FILE_FORMAT);
    assert_non_null(strstr(fg_context_message(*state), rows[k][1]));
    assert_true((strstr(fg_context_hint(*state), "foamToVTK") != NULL) == (k == 1));
    if (rows[k][0][0])
      unlink(name);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_file_that_became_shorter_was_not_read),
      cmocka_unit_test(a_file_that_is_removed_is_there_until_it_is_closed),
      cmocka_unit_test(an_empty_file_is_called_what_it_is),
  };
  return cmocka_run_group_tests_name("decode/source", tests, set_up, tear_down);
}
