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

/* Nothing is left of a value that the field does not have, nor of what would part it. */
static void names_without_a_value_leave_nothing(void **state)
{
  static const char *const cases[][2] = {
      {"Wind, {time}", "Wind"},
      {"{time}: wind", "wind"},
      {"Wind, {time}, {level}", "Wind, 10 m"},
      {"Wind ({time}), {level}", "Wind, 10 m"},
      {"Wind \xE2\x80\x93 {time} \xC2\xB7 {level}", "Wind \xC2\xB7 10 m"},
      {"{time}", ""},
      {"\xC3\xB7{time}", "\xC3\xB7"}, /* ends in the middle dot's last byte */
      {"{level}, ", "10 m, "},
  };
  fg_icons *icons = lines(*state, 2);
  const fg_field_arrays field = {
      .dimension = 2, .velocity_name = {"U10", "V10"}, .title = "Field", .level = "10 m"};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
    const char *const wanted[2] = {cases[n][0], NULL};
    fg__caption_write(title, subtitle, &field, icons, wanted, 0.0);
    assert_string_equal(title, cases[n][1]);
  }
  fg_icons_destroy(icons);
}

/* They say what the quantity is only where nothing else does. */
static void components_are_named_without_a_title(void **state)
{
  fg_icons *icons = lines(*state, 2);
  fg_field_arrays field = {
      .dimension = 2, .velocity_name = {"vel_x", "vel_z"}, .title = "Pipe flow"};
  const char *const wanted[2] = {NULL, NULL};
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
  fg__caption_write(title, subtitle, &field, icons, wanted, 0.0);
  assert_string_equal(title, "Pipe flow");
  assert_string_equal(subtitle, "2 arrows");
  field.title = "";
  fg__caption_write(title, subtitle, &field, icons, wanted, 0.0);
  assert_string_equal(title, "vel_x, vel_z");
  field.velocity_name[1] = "vel_y";
  fg__caption_write(title, subtitle, &field, icons, wanted, 0.0);
  assert_string_equal(title, "vel");
  fg_icons_destroy(icons);
}

/* A name that is no word stays, and a title that was asked for. */
static void a_title_in_words_begins_with_a_capital(void **state)
{
  static const struct {
    const char *title, *wanted, *expected;
  } cases[] = {
      {"wind at 10 m", NULL, "Wind at 10 m"},
      {"velocity", NULL, "Velocity"},
      {"wind at 10 m", "{title}", "wind at 10 m"},
      {"vortex (analytic)", NULL, "vortex (analytic)"},
      {"u10, v10", NULL, "u10, v10"},
      {"ua_850", NULL, "ua_850"},
      {"ua, va", NULL, "ua, va"},
      {"cavity.old", NULL, "cavity.old"},
      {"sea-surface wind", NULL, "Sea-surface wind"},
      {"horizontalVelX, horizontalVelY", NULL, "horizontalVelX, horizontalVelY"},
  };
  fg_icons *icons = lines(*state, 2);
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg_field_arrays field = {
        .dimension = 2, .velocity_name = {"u", "v"}, .title = cases[n].title};
    char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
    const char *const wanted[2] = {cases[n].wanted, NULL};
    fg__caption_write(title, subtitle, &field, icons, wanted, 0.0);
    assert_string_equal(title, cases[n].expected);
  }
  fg_icons_destroy(icons);
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
    double mean, weighted; /* by speed; 0: not known */
    const char *wanted;
  } cases[] = {
      {16.2, 0.0, "2 arrows \xC2\xB7 mean direction error 17\xC2\xB0"},
      {16.0, 0.0, "2 arrows \xC2\xB7 mean direction error 16\xC2\xB0"},
      {3.0, 0.0, "2 arrows \xC2\xB7 mean direction error 3\xC2\xB0"},
      {2.99, 0.0, "2 arrows \xC2\xB7 mean direction error 3\xC2\xB0"},
      {2.31, 0.0, "2 arrows \xC2\xB7 mean direction error 2.4\xC2\xB0"},
      {0.02, 0.0, "2 arrows \xC2\xB7 mean direction error 0.1\xC2\xB0"},
      {89.5, 0.0, "2 arrows \xC2\xB7 mean direction error 90\xC2\xB0"},
      {66.2, 23.0, "2 arrows \xC2\xB7 mean direction error 67\xC2\xB0"},
      {66.2, 13.4,
       "2 arrows \xC2\xB7 mean direction error 67\xC2\xB0, weighted by speed 14\xC2\xB0"},
  };
  fg_icons *icons = lines(*state, 2);
  expect(icons, "2 arrows");
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const double weighted = cases[n].weighted; /* mean of the three readers' */
    const fg_score score = {.mean = cases[n].mean,
                            .diffusion.speed_weighted = weighted + 1.0 * (weighted > 0.0),
                            .nearest.speed_weighted = weighted,
                            .inverse_distance.speed_weighted =
                                weighted - 1.0 * (weighted > 0.0)};
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

/* The caption tells what panels have in common, their labels what tells them apart. */
static void panels_are_told_apart(void **state)
{
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES], label[FG__CAPTION_BYTES];
  static const char *const none[2] = {NULL, NULL}, *const wanted[2] = {"{level}{time}",
                                                                       ""};
  fg_icons *few = lines(*state, 1), *more = lines(*state, 2);
  fg_field_arrays field[2];
  for (int k = 0; k < 2; ++k)
    field[k] = (fg_field_arrays){.dimension = 2,
                                 .velocity_name = {"U10", "V10"},
                                 .title = "Wind",
                                 .time = k ? "1982-07-16" : "1982-01-16",
                                 .level = "10 m"};
  fg__caption_panel panel[2] = {{&field[0], more, 0.0}, {&field[1], more, 0.0}};
  fg__caption_write_common(title, subtitle, panel, 2, none);
  assert_string_equal(title, "Wind");
  assert_string_equal(subtitle, "10 m \xC2\xB7 2 arrows each");
  fg__caption_write_common(title, subtitle, panel, 2, wanted);
  assert_string_equal(title, "10 m");
  fg__caption_write_label(label, panel, 2, 1, NULL);
  assert_string_equal(label, "(b) 1982-07-16");
  fg__caption_write_label(label, panel, 2, 0, "{letter}: {level}");
  assert_string_equal(label, "a: 10 m");
  panel[0].icons = few;
  field[0].time = field[1].time;
  fg__caption_write_label(label, panel, 2, 0, NULL);
  assert_string_equal(label, "(a) 1 arrow");
  panel[1] = panel[0];
  fg__caption_write_label(label, panel, 2, 1, NULL);
  assert_string_equal(label, "(b)");
  fg_icons_destroy(few);
  fg_icons_destroy(more);
}

/* Where one date has an hour, all have; what all share is in the subtitle alone. */
static void times_of_panels_are_told_in_one_way(void **state)
{
  (void)state;
  static const struct {
    const char *time[3], *label[3], *shared;
  } cases[] = {
      {{"2016-01-14", "2016-01-14 01:00", "2016-01-15"},
       {"(a) 2016-01-14 00:00", "(b) 2016-01-14 01:00", "(c) 2016-01-15 00:00"},
       ""},
      {{"2016-01-14 06:00", "2016-01-14", "2016-01-14 06:00:30"},
       {"(a) 06:00:00", "(b) 00:00:00", "(c) 06:00:30"},
       "2016-01-14"},
      {{"16 May (climatology)", "16 June (climatology)", "16 July (climatology)"},
       {"(a) 16 May", "(b) 16 June", "(c) 16 July"},
       "climatology"},
      {{"16 May (climatology)", "16 June (climatology)", "16 July (mean)"},
       {"(a) 16 May (climatology)", "(b) 16 June (climatology)", "(c) 16 July (mean)"},
       ""},
      {{"2016-01-14", "2016-01-15", "t = 2.5"},
       {"(a) 2016-01-14", "(b) 2016-01-15", "(c) t = 2.5"},
       ""},
      {{"January", "2016-01-14 01:00", NULL},
       {"(a) January", "(b) 2016-01-14 01:00", "(c)"},
       ""},
  };
  char label[FG__CAPTION_BYTES], title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
  const char *const given[2] = {NULL, NULL};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field_arrays field[3];
    fg__caption_panel panel[3];
    for (int k = 0; k < 3; ++k) {
      field[k] = (fg_field_arrays){.dimension = 2,
                                   .velocity_name = {"u", "v"},
                                   .title = "",
                                   .time = cases[n].time[k]};
      panel[k] = (fg__caption_panel){&field[k], NULL, 0.0};
    }
    for (int k = 0; k < 3; ++k) {
      fg__caption_write_label(label, panel, 3, k, NULL);
      assert_string_equal(label, cases[n].label[k]);
    }
    fg__caption_write_common(title, subtitle, panel, 3, given);
    assert_string_equal(subtitle, cases[n].shared);
  }
}

static void a_level_below_zero_has_a_minus_sign(void **state)
{
  (void)state;
  static const char *const cases[][2] = {
      {"s_rho -0.921875", "s_rho \xE2\x88\x92"
                          "0.921875"},
      {"z = -.5", "z = \xE2\x88\x92.5"},
      {"model -b 2-3", "model -b 2-3"},
      {"z -", "z -"},
  };
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg_field_arrays field = {
        .dimension = 2, .velocity_name = {"u", "v"}, .title = "", .level = cases[n][0]};
    fg__caption_write(title, subtitle, &field, NULL, (const char *[2]){NULL, NULL}, 0.0);
    assert_string_equal(subtitle, cases[n][1]);
  }
}

static void letters_go_on_after_z(void **state)
{
  (void)state;
  char label[FG__CAPTION_BYTES];
  const fg_field_arrays field = {
      .dimension = 2, .velocity_name = {"u", "v"}, .title = ""};
  fg__caption_panel panel[54];
  for (int k = 0; k < 54; ++k)
    panel[k] = (fg__caption_panel){&field, NULL, 0.0};
  static const struct {
    int k;
    const char *label;
  } cases[] = {{0, "(a)"}, {25, "(z)"}, {26, "(aa)"}, {51, "(az)"}, {52, "(ba)"}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg__caption_write_label(label, panel, 54, cases[n].k, NULL);
    assert_string_equal(label, cases[n].label);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_caption_tells_the_error_and_never_less,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(components_are_named_without_a_title,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(a_title_in_words_begins_with_a_capital,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(names_in_braces_are_what_the_field_says,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(names_without_a_value_leave_nothing, context_set_up,
                                      context_tear_down),
      cmocka_unit_test(times_of_panels_are_told_in_one_way),
      cmocka_unit_test_setup_teardown(panels_are_told_apart, context_set_up,
                                      context_tear_down),
      cmocka_unit_test(a_level_below_zero_has_a_minus_sign),
      cmocka_unit_test(letters_go_on_after_z),
  };
  return cmocka_run_group_tests_name("picture/caption", tests, NULL, NULL);
}
