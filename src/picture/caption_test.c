#include "picture/caption.h"

#include "base/context_test.h"
#include "icon/icons.h"

#include <stdio.h>
#include <string.h>

static const double LINE[2][3] = {{0.2, 0.3, 0}, {0.5, 0.6, 0}};

static fg_icons *lines(fg_context *context, int count)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  const fg_icon icon = {.cluster = 1, .point_count = 2, .points = LINE};
  for (int n = 0; n < count; ++n)
    assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
  return icons;
}

static void expect(const fg_icons *icons, const char *wanted)
{
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
  const fg_field_arrays field = {
      .dimension = 2, .velocity_name = {"u", "v"}, .title = ""};
  fg__caption_write(title, subtitle, &field, icons, (const char *[2]){NULL, NULL}, 0.0);
  assert_string_equal(subtitle, wanted);
  fg__caption_write(title, subtitle, &field, icons, (const char *[2]){"Harbour", NULL},
                    0.0);
  assert_string_equal(title, "Harbour");
  assert_string_equal(subtitle, "");
}

/* What stands for a name may hold what looks like one. */
static void names_in_braces_are_what_the_field_says(void **state)
{
  static const struct {
    const char *title, *subtitle, *expected[2];
  } cases[] = {
      {NULL, "", {"Wind {time} & waves", ""}},
      {NULL, "N = {arrows}", {"Wind {time} & waves", "N = 2"}},
      {"{title}, {level}", NULL, {"Wind {time} & waves, 10 m", ""}},
      {"{time}{no}{", "{names}", {"1982-07-16 12:00{no}{", "U10, V10"}},
      {"", NULL, {"", ""}},
      {"a\nb\xFF", NULL, {"a b?", ""}},
  };
  fg_icons *icons = lines(*state, 2);
  const fg_field_arrays field = {.dimension = 2,
                                 .velocity_name = {"U10", "V10"},
                                 .title = "Wind {time} & waves",
                                 .time = "1982-07-16 12:00",
                                 .level = "10 m"};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    char text[2][FG__CAPTION_BYTES];
    const char *const wanted[2] = {cases[n].title, cases[n].subtitle};
    fg__caption_write(text[0], text[1], &field, icons, wanted, 0.0);
    assert_string_equal(text[0], cases[n].expected[0]);
    assert_string_equal(text[1], cases[n].expected[1]);
  }
  /* cut before a whole character */
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES], wish[100], long_time[300];
  memset(long_time, 'x', sizeof long_time);
  memcpy(long_time + 296, "\xC3\xA9\xC3", 4);
  long_time[298] = '\0';
  fg_field_arrays wordy = field;
  wordy.time = long_time;
  snprintf(wish, sizeof wish, "{time}%.21s\xC3\xA9", "yyyyyyyyyyyyyyyyyyyyyyyyy");
  fg__caption_write(title, subtitle, &wordy, icons, (const char *[2]){wish, NULL}, 0.0);
  assert_int_equal(strlen(title), 319);
  assert_int_equal(title[318], 'y');
  fg_icons_destroy(icons);
}

static void a_caption_tells_the_error_and_never_less(void **state)
{
  static const struct {
    double mean;
    const char *wanted;
  } cases[] = {
      {16.2, "2 arrows \xC2\xB7 read within 17\xC2\xB0"},
      {16.0, "2 arrows \xC2\xB7 read within 16\xC2\xB0"},
      {3.0, "2 arrows \xC2\xB7 read within 3\xC2\xB0"},
      {2.99, "2 arrows \xC2\xB7 read within 3\xC2\xB0"},
      {2.31, "2 arrows \xC2\xB7 read within 2.4\xC2\xB0"},
      {0.02, "2 arrows \xC2\xB7 read within 0.1\xC2\xB0"},
      {89.5, "2 arrows \xC2\xB7 read within 90\xC2\xB0"},
  };
  fg_icons *icons = lines(*state, 2);
  expect(icons, "2 arrows");
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg_score score = {.mean = cases[n].mean};
    fg_icons_keep_score(icons, &score);
    expect(icons, cases[n].wanted);
  }
  fg_icons_keep_score(icons, NULL);
  expect(icons, "2 arrows");
  fg_icons_destroy(icons);
  icons = lines(*state, 1);
  expect(icons, "1 arrow");
  fg_icons_destroy(icons);
  expect(NULL, "");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_caption_tells_the_error_and_never_less,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(names_in_braces_are_what_the_field_says,
                                      context_set_up, context_tear_down),
  };
  return cmocka_run_group_tests_name("picture/caption", tests, NULL, NULL);
}
