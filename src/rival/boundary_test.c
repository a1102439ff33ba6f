/* No rival's arrow crosses a periodic boundary. */
#include "rival/cluster/pieces.h"
#include "rival/fields_test.h"
#include "rival/streamline/evenly.h"

#include <stdlib.h>

static double box_end(void)
{
  return CORNER[0] + COLUMNS * SAMPLING[0];
}

/* Centrelines lie in the box, outlines so too, but for `slack` widths. */
static void assert_inside(const fg_icons *icons, double slack)
{
  for (int n = 0; n < fg_icons_count(icons); n++) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double(*vertex)[2];
    int count;
    for (int i = 0; i < icon->point_count; i++)
      assert_true(icon->points[i][0] >= CORNER[0] - 1e-9 &&
                  icon->points[i][0] <= box_end() + 1e-9);
    assert_true(icon->center[0] >= CORNER[0] && icon->center[0] <= box_end());
    assert_int_equal(fg_icon_outline(icon, &vertex, &count), FG_STATUS_OK);
    for (int i = 0; i < count; i++)
      assert_true(vertex[i][0] > CORNER[0] - slack * icon->width &&
                  vertex[i][0] < box_end() + slack * icon->width);
    free(vertex);
  }
}

/* Icons of a method on a field that goes round; slack: what its outlines may be out, in
 * widths. */
static double length_inside(fg_context *context, fg_rival_method method,
                            velocity_of velocity, int count, double slack)
{
  fg_field *field = field_of(context, velocity, true);
  fg_rival *rival = rival_of(context, field, method, 121);
  fg_icons *icons = NULL;
  double length = 0;
  assert_int_equal(fg_rival_icons(&icons, rival, count), FG_STATUS_OK);
  assert_along_flow(icons, field, 0.03);
  assert_inside(icons, slack);
  assert_true(fg_icons_dropped(icons) >= 0);
  assert_true(fg_icons_count(icons) >=
              fg_icons_clusters(icons) - fg_icons_dropped(icons));
  for (int n = 0; n < fg_icons_count(icons); n++)
    length += fg__icon_length(fg_icons_at(icons, n));
  fg_icons_destroy(icons);
  fg_rival_destroy(rival);
  fg_field_destroy(field);
  return length;
}

static void arrows_end_at_a_periodic_boundary(void **state)
{
  static const velocity_of flows[] = {slant, swirl};
  for (int k = 0; k < 2; k++)
    for (int count = 5; count < 90; count += 17) {
      length_inside(*state, FG_RIVAL_GRID_CURVED, flows[k], count, 0);
      length_inside(*state, FG_RIVAL_DISCRETE, flows[k], count, 0);
      length_inside(*state, FG_RIVAL_TOP_DOWN, flows[k], count, 0);
    }
}

/* Lines are cut, not left out: the ink is that of the lines before the cut. */
static void lines_are_cut_there(void **state)
{
  fg_context *context = *state;
  for (int count = 10; count < 60; count += 20) {
    double length = length_inside(context, FG_RIVAL_STREAMLINES, slant, count, 1.3);
    fg_field *field = field_of(context, slant, true);
    fg__domain domain;
    fg__lines evenly = {0};
    double before = 0;
    int across = 0;
    assert_int_equal(fg__domain_create(&domain, context, field, 121), FG_STATUS_OK);
    assert_int_equal(fg__evenly_search(&evenly, context, &domain, count), FG_STATUS_OK);
    for (int n = 0; n < evenly.count; n++) {
      const fg__lines_part *line = &evenly.part[n];
      double ends[2] = {line->seed[0] + line->from * cos(SLANT),
                        line->seed[0] + line->to * cos(SLANT)};
      double turns[2];
      for (int k = 0; k < 2; k++)
        turns[k] = floor((ends[k] - CORNER[0]) / domain.period[0]);
      across += turns[0] < turns[1];
      before += line->to - line->from;
    }
    assert_true(across > 2);
    assert_true(length <= before * (1 + 1e-9));
    assert_true(length > before - across * evenly.separation);
    fg__lines_clear(&evenly);
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
}

enum { WIDE = 12, HIGH = 5 };

/* Along a closed axis a cluster on both sides of the seam is parted, one that goes all
 * round is not, and small rests are left out. */
static void clusters_are_parted(void **state)
{
  static const char *map[2][HIGH] = {
      {"AA.....bb.AA", /* in two, 4 and 4 cells */
       "AA.....bbccA", /* c: not across */
       "DDDDDDDDDDDD", /* all round */
       "E......eeeee", /* 1 and 5: too little */
       "ff........ff"},
      {"AA.....BB.CC", "AA.....BBDDC", "EEEEEEEEEEEE", ".......FFFFF", "GG........HH"}};
  int label[WIDE * HIGH], wanted[WIDE * HIGH];
  for (int i = 0; i < WIDE * HIGH; i++) {
    char from = map[0][i / WIDE][i % WIDE], to = map[1][i / WIDE][i % WIDE];
    label[i] = from == '.' ? 0 : 1 + (from | 32) - 'a';
    wanted[i] = to == '.' ? 0 : to;
  }
  fg__domain domain = {.dimension = 2,
                       .cells = {WIDE, HIGH, 1},
                       .spacing = {1, 1},
                       .period = {WIDE, 0},
                       .valid_count = WIDE * HIGH};
  fg__rival_pieces parts;
  assert_int_equal(fg__rival_pieces_create(&parts, *state, &domain, label, 6),
                   FG_STATUS_OK);
  assert_int_equal(parts.count, 8);
  int name[9] = {0}, cells[9] = {0};
  for (int i = 0; i < WIDE * HIGH; i++) {
    int part = parts.label[i];
    assert_int_equal(part > 0, wanted[i] > 0);
    if (part == 0)
      continue;
    assert_int_equal(parts.cluster[part - 1], label[i]);
    assert_true(name[part] == 0 || name[part] == wanted[i]);
    name[part] = wanted[i];
    cells[part]++;
  }
  for (int n = 1; n <= parts.count; n++) {
    assert_int_equal(cells[n], parts.cells[n - 1]);
    if (n > 1)
      assert_true(parts.cluster[n - 1] >= parts.cluster[n - 2]);
    for (int m = 1; m < n; m++)
      assert_true(name[m] != name[n]);
  }
  fg__rival_pieces_clear(&parts);
  domain.period[0] = 0; /* an open axis parts nothing */
  assert_int_equal(fg__rival_pieces_create(&parts, *state, &domain, label, 6),
                   FG_STATUS_OK);
  assert_int_equal(parts.count, 6);
  fg__rival_pieces_clear(&parts);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(arrows_end_at_a_periodic_boundary),
      CASE(lines_are_cut_there),
      CASE(clusters_are_parted),
  };
  return cmocka_run_group_tests_name("rival/boundary", tests, NULL, NULL);
}
