/* What placed icons have in their file beyond those of clusters. */
#include "file/folder_test.h"
#include "icon/icons.h"
#include "place/placed_test.h"

static int set_up(void **state)
{
  int failed = folder_set_up(state);
  if (!failed)
    path_of(*state, "icons.geojson");
  return failed;
}

static fg_icons *written_and_read(folder *f, const fg_icons *icons)
{
  fg_icons *back = NULL;
  assert_int_equal(fg_icons_write(f->context, f->path, icons), FG_STATUS_OK);
  if (fg_icons_read(&back, f->context, f->path) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  return back;
}

static fg_icons *read_as(folder *f, const char *text, fg_status expected)
{
  fg_icons *icons = NULL;
  FILE *file = fopen(f->path, "wb");
  assert_non_null(file);
  assert_true(fputs(text, file) >= 0);
  assert_int_equal(fclose(file), 0);
  if (fg_icons_read(&icons, f->context, f->path) != expected)
    fail_msg("%s: %s", text, fg_context_message(f->context));
  fg_context_clear(f->context);
  return icons;
}

static const double LINE[2][3] = {{0.25, 1.0 / 3.0, 0}, {0.5, 2.0 / 7.0, 0}};

static void placed_icons_come_back_bit_for_bit(void **state)
{
  folder *f = *state;
  const double deep[2][3] = {{1, 2, 3}, {1, 2, 1.0 / 3.0}};
  for (int solid = 0; solid < 2; ++solid) {
    fg_icons *icons = no_icons(f->context);
    const fg_icon placed = {.cluster = 3,
                            .point_count = 2,
                            .points = solid ? deep : LINE,
                            .id = 12,
                            .parent = 7,
                            .seed = {1.0 / 7.0, -2e-9, solid ? 1.0 / 11.0 : 0.0},
                            .way = {0.1 + 0.2, 1e-17}};
    const fg_icon last = {.cluster = 4,
                          .point_count = 2,
                          .points = solid ? deep : LINE,
                          .id = 2147483646,
                          .seed = {3, 4, 0},
                          .way = {0, 5}};
    assert_int_equal(fg__icons_add(icons, f->context, &placed), FG_STATUS_OK);
    assert_int_equal(fg__icons_add(icons, f->context, &last), FG_STATUS_OK);
    fg__icons_set_next_id(icons, 2147483647);
    fg_icons *back = written_and_read(f, icons);
    assert_int_equal(fg__icons_next_id(back), 2147483647);
    for (int n = 0; n < 2; ++n) {
      const fg_icon *one = fg_icons_at(icons, n), *other = fg_icons_at(back, n);
      assert_int_equal(one->id, other->id);
      assert_int_equal(one->parent, other->parent);
      assert_memory_equal(one->seed, other->seed, sizeof one->seed);
      assert_memory_equal(one->way, other->way, sizeof one->way);
    }
    assert_null(fg_icons_kept_score(back));
    fg_icons_destroy(icons);
    fg_icons_destroy(back);
  }
}

static fg_icons *one_line(folder *f)
{
  fg_icons *icons = no_icons(f->context);
  add_line(icons, f->context, LINE, 2);
  return icons;
}

static void icons_keep_their_score(void **state)
{
  folder *f = *state;
  const fg_score score = {.icons = 1,
                          .mean = 17.0 / 3.0,
                          .percentile_95 = 61.25,
                          .diffusion = {1.5, 2.5, 1.0 / 3.0},
                          .nearest = {4, 5, 6.125},
                          .inverse_distance = {7, 8.5, 9},
                          .ink = 1.25,
                          .tangency = 0.5};
  fg_icons *icons = one_line(f);
  fg_icons_keep_score(icons, &score);
  fg_icons *back = written_and_read(f, icons);
  const fg_score *kept = fg_icons_kept_score(back);
  assert_non_null(kept);
  assert_int_equal(kept->icons, 1);
  assert_true(kept->mean == score.mean && kept->percentile_95 == score.percentile_95);
  assert_memory_equal(&kept->diffusion, &score.diffusion, sizeof score.diffusion);
  assert_memory_equal(&kept->nearest, &score.nearest, sizeof score.nearest);
  assert_memory_equal(&kept->inverse_distance, &score.inverse_distance,
                      sizeof score.inverse_distance);
  /* the file says no more */
  assert_true(isnan(kept->ink) && isnan(kept->tangency) && isnan(kept->advection));
  assert_true(isnan(kept->void_max) && isnan(kept->longest) && isnan(kept->clutter));
  fg_icons_destroy(back);
  fg_icons_keep_score(icons, NULL);
  assert_null(fg_icons_kept_score(icons));
  back = written_and_read(f, icons);
  assert_null(fg_icons_kept_score(back));
  assert_null(fg_icons_kept_score(NULL));
  fg_icons_destroy(back);
  fg_icons_destroy(icons);
}

#define COLLECTION(members, properties)                                                  \
  "{\"type\":\"FeatureCollection\"," members "\"features\":[{\"type\":\"Feature\","      \
  "\"properties\":{" properties "},\"geometry\":{\"type\":\"LineString\","               \
  "\"coordinates\":[[1,2],[3,5]]}}]}"

static void members_of_other_programs_mean_something_else(void **state)
{
  folder *f = *state;
  static const char *const texts[] = {
      COLLECTION("", "\"id\":\"road 7\",\"parent\":\"N12\""),
      COLLECTION("", "\"id\":-4.5,\"parent\":null"),
      COLLECTION("", "\"id\":3,\"seed\":5,\"way\":\"north\""),
      COLLECTION("", "\"id\":3,\"seed\":[1,2]"),
      COLLECTION("\"error\":\"none\",", "\"way\":[1,2]"),
      COLLECTION("\"error\":{},", ""),
  };
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n) {
    fg_icons *icons = read_as(f, texts[n], FG_STATUS_OK);
    assert_int_equal(fg_icons_count(icons), 1);
    const fg_icon *icon = fg_icons_at(icons, 0);
    assert_true(icon->id == 0 && icon->parent == 0);
    assert_true(icon->way[0] == 0 && icon->way[1] == 0 && icon->seed[0] == 0);
    assert_null(fg_icons_kept_score(icons));
    fg_icons_destroy(icons);
  }
}

static void wrong_placements_are_refused(void **state)
{
  folder *f = *state;
#define OURS ",\"seed\":[1,2],\"way\":[3,4]"
  static const char *const texts[] = {
      COLLECTION("", "\"id\":\"7\"" OURS),
      COLLECTION("", "\"id\":0" OURS),
      COLLECTION("", "\"id\":1.5" OURS),
      COLLECTION("", "\"id\":1,\"parent\":0" OURS),
      COLLECTION("", "\"id\":1,\"seed\":[1],\"way\":[3,4]"),
      COLLECTION("", "\"id\":1,\"seed\":[1,2],\"way\":[3]"),
      COLLECTION("", "\"id\":1,\"seed\":[1,2],\"way\":[3,\"4\"]"),
      COLLECTION("", "\"id\":1,\"seed\":[1,2],\"way\":[-3,4]"),
      COLLECTION("", "\"id\":1,\"seed\":[1,2],\"way\":[3,4,5]"),
      COLLECTION("\"next_id\":0,", ""),
      COLLECTION("\"next_id\":\"a\",", ""),
      COLLECTION("\"error\":{\"mean\":-1},", ""),
      COLLECTION("\"error\":{\"mean\":1,\"nearest\":{\"mean\":\"x\"}},", ""),
  };
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n)
    assert_null(read_as(f, texts[n], FG_STATUS_FILE_FORMAT));
  fg_icons *icons = read_as(f, COLLECTION("", "\"id\":1" OURS), FG_STATUS_OK);
  assert_int_equal(fg_icons_at(icons, 0)->id, 1);
  fg_icons_destroy(icons);
}

/* Down to a third of the arrows, in 2D and in space, and where lines have to be short. */
static void a_chain_goes_on_from_a_file(void **state)
{
  folder *f = *state;
  static const struct {
    const sampling *box;
    velocity_of velocity;
    int counts[2];
  } cases[] = {
      {&PLAIN, coast, {36, 12}}, {&SOLID, hall, {9, 6}}, {&STRIP, swirl, {3, 2}}};
  for (int n = 0; n < 3; ++n) {
    fg_field *field = field_of(f->context, cases[n].box, cases[n].velocity);
    fg_placement *one = placement_of(f->context, field, FG_EFFORT_NORMAL),
                 *other = placement_of(f->context, field, FG_EFFORT_NORMAL);
    fg_icons *fine = place(f->context, one, cases[n].counts[0]);
    fg_icons *back = written_and_read(f, fine);
    assert_same_icons(fine, back);
    if (fg_placement_resume(other, back) != FG_STATUS_OK)
      fail_msg("%s", fg_context_message(f->context));
    fg_icons *there = place(f->context, one, cases[n].counts[1]),
             *here = place(f->context, other, cases[n].counts[1]);
    assert_same_icons(there, here);
    fg_icons_destroy(fine);
    fg_icons_destroy(back);
    fg_icons_destroy(there);
    fg_icons_destroy(here);
    fg_placement_destroy(one);
    fg_placement_destroy(other);
    fg_field_destroy(field);
  }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(placed_icons_come_back_bit_for_bit),
      TEST(icons_keep_their_score),
      TEST(members_of_other_programs_mean_something_else),
      TEST(wrong_placements_are_refused),
      TEST(a_chain_goes_on_from_a_file),
  };
  return cmocka_run_group_tests_name("write/geojson_placed", tests, NULL, NULL);
}
