/* The files that pictures become, or do not. */
#include "picture/page/picture_example.h"

static void writing_twice_gives_the_same_bytes(void **state)
{
  const example *e = *state;
  static const char *const names[][2] = {{"a.png", "b.png"}, {"a.pdf", "b.pdf"}};
  for (int k = 0; k < 2; ++k) {
    char *bytes[2];
    size_t size[2];
    for (int n = 0; n < 2; ++n) {
      write_picture(e, names[k][n], NULL);
      bytes[n] = read_file(e, names[k][n], &size[n]);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    assert_int_equal(memcmp(bytes[0], k ? "%PDF" : "\x89PNG", 4), 0);
    free(bytes[0]);
    free(bytes[1]);
  }
  assert_int_equal(files_in(e->folder), 4);
}

static unsigned long number_at(const char *bytes)
{
  const unsigned char *at = (const unsigned char *)bytes;
  return ((unsigned long)at[0] << 24) + ((unsigned long)at[1] << 16) +
         ((unsigned long)at[2] << 8) + at[3];
}

/* The chunk pHYs, before the pixels. */
static void a_png_says_how_large_it_is(void **state)
{
  const example *e = *state;
  fg_picture_options options = {.pixels_per_point = 300.0 / 72.0};
  write_picture(e, "a.png", &options);
  size_t size;
  char *bytes = read_file(e, "a.png", &size);
  assert_memory_equal(bytes + 33 + 4, "pHYs", 4);
  assert_int_equal(number_at(bytes + 33), 9);
  assert_int_equal(number_at(bytes + 33 + 8), 11811); /* 300 an inch of 0.0254 m */
  assert_int_equal(number_at(bytes + 33 + 12), 11811);
  assert_int_equal(bytes[33 + 16], 1);
  free(bytes);
}

static void expect_failure(const example *e, const char *path, fg_status expected,
                           const char *words, const fg_picture_options *options)
{
  fg_status status =
      fg_picture_write(e->context, path, e->field, NULL, e->icons, options);
  assert_int_equal(status, expected);
  assert_non_null(strstr(fg_context_message(e->context), words));
  fg_context_clear(e->context);
  assert_int_equal(files_in(e->folder), 0);
}

static void bad_options_are_refused(void **state)
{
  const example *e = *state;
  char path[160];
  path_in(path, e, "a.png");
  static const struct {
    fg_picture_options options;
    const char *words;
  } cases[] = {{{.width = -3.0}, "-3"},
               {{.width = 20001.0}, "20001"},
               {{.height = (double)NAN}, "nan"},
               {{.pixels_per_point = -1.0}, "-1 pixels"},
               {{.pixels_per_point = HUGE_VAL}, "inf pixels"},
               {{.pixels_per_point = 1e5}, "pixels, at most"},
               {{.palette = "jet"}, "'jet'"},
               {{.tint_color = "blue"}, "'blue'"},
               {{.mask_color = "#12"}, "'#12'"},
               {{.speed_min = 4.0, .speed_max = 1.5}, "from 4 to 1.5"},
               {{.speed_max = HUGE_VAL}, "inf"},
               {{.font_size = -9.0}, "-9"},
               {{.tint = true}, "density"}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    expect_failure(e, path, FG_STATUS_ARGUMENT, cases[k].words, &cases[k].options);
}

static void a_place_that_cannot_be_written_is_reported(void **state)
{
  const example *e = *state;
  char path[160];
  path_in(path, e, "a.jpg");
  expect_failure(e, path, FG_STATUS_UNSUPPORTED, "a.jpg", NULL);
  path_in(path, e, "png");
  expect_failure(e, path, FG_STATUS_UNSUPPORTED, "png", NULL);
  path_in(path, e, "missing/a.png");
  expect_failure(e, path, FG_STATUS_FILE_ACCESS, "missing/a.png", NULL);
}

static void a_full_disk_is_reported(void **state)
{
  const example *e = *state;
  static const char *const names[] = {"a.svg", "a.pdf", "a.png"};
  for (int k = 0; k < 3; ++k) {
    char path[160];
    path_in(path, e, names[k]);
    assert_int_equal(symlink("/dev/full", path), 0);
    fg_status status = fg_picture_write(e->context, path, e->field, NULL, e->icons, NULL);
    assert_int_equal(status, FG_STATUS_FILE_ACCESS);
    assert_non_null(strstr(fg_context_message(e->context), "No space left"));
    fg_context_clear(e->context);
    unlink(path);
  }
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, example_set_up, example_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(writing_twice_gives_the_same_bytes),
      TEST(a_png_says_how_large_it_is),
      TEST(bad_options_are_refused),
      TEST(a_place_that_cannot_be_written_is_reported),
      TEST(a_full_disk_is_reported),
  };
  return cmocka_run_group_tests_name("picture/page/picture_file", tests, NULL, NULL);
}
