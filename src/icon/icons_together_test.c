/* Icons that ranks make of their blocks are those of the plain arrays, to the bit. */
#include "cluster/divided_density_test.h"
#include "grid/slabs_test.h"

#include <string.h>

typedef struct tally {
  int icons, divided; /* divided: clusters across a seam with two icons or more */
} tally;

static void compare_icon(const fg_icon *got, const fg_icon *want, tally *sum)
{
  expect(got->cluster == want->cluster && got->kind == want->kind);
  expect(got->point_count == want->point_count);
  if (got->point_count != want->point_count)
    return;
  expect(memcmp(got->points, want->points,
                (size_t)want->point_count * sizeof *want->points) == 0);
  expect(got->width == want->width && got->tail_width == want->tail_width);
  expect(got->head_length == want->head_length && got->head_width == want->head_width);
  expect(memcmp(got->center, want->center, sizeof want->center) == 0);
  expect(got->area == want->area && got->speed == want->speed);
  sum->icons++;
}

static void compare(const fg_icons *got, const subject *s, tally *sum)
{
  fg_icons *want;
  expect(fg_icons_create(&want, us.context, s->field, s->whole, NULL) == FG_STATUS_OK);
  expect(fg_icons_clusters(got) == fg_icons_clusters(want));
  expect(fg_icons_dropped(got) == fg_icons_dropped(want));
  expect(fg_icons_count(got) == fg_icons_count(want));
  for (int n = 0, cluster = 0; n < fg_icons_count(want) && fg_icons_at(got, n); ++n) {
    compare_icon(fg_icons_at(got, n), fg_icons_at(want, n), sum);
    sum->divided += fg_icons_at(want, n)->cluster == cluster;
    cluster = fg_icons_at(want, n)->cluster;
  }
  fg_icons_destroy(want);
}

static void parts_give_the_icons_of_the_whole(void **state)
{
  (void)state;
  tally sum = {0};
  for (int n = 0; n < SHAPE_COUNT; ++n)
    for (int way = 0; way < 4; ++way) {
      if (!is_taken(n, way))
        continue;
      bool periodic[2];
      set_periods(periodic, way);
      subject s = subject_of(&SHAPES[n], periodic, (n + way) % 3 == 0);
      fg_icons *icons;
      fg_icon_options options = {.threads = 1 + way};
      fg_field *part = (n + way) % 4 < 2 ? joined_slab_of(s.field) : NULL;
      expect(fg_icons_create(&icons, us.context, part ? part : s.field, s.shared,
                             &options) == FG_STATUS_OK);
      fg_field_destroy(part);
      expect(!icons == (us.ranks->rank > 0));
      if (icons)
        compare(icons, &s, &sum);
      fg_icons_destroy(icons);
      subject_clear(&s);
    }
  /* the shapes are what they are meant to be */
  if (us.ranks->rank == 0)
    expect(sum.icons > 60 && sum.divided > 7);
  end_together();
}

/* A domain without a cluster, and one of which most ranks have none. */
static double nothing(double x, double y, const bool periodic[2], int seed)
{
  (void)periodic;
  double x0 = x - 0.21, y0 = y - 0.3;
  return seed ? 1.0 - (x0 * x0 + 3.0 * y0 * y0) / 0.008 : -1.0;
}

static void ranks_without_a_cluster_take_part(void **state)
{
  (void)state;
  const bool periodic[2] = {false, true};
  for (int seed = 0; seed < 2; ++seed) {
    const shape s = {"nothing", nothing, seed};
    subject made = subject_of(&s, periodic, false);
    fg_icons *icons;
    expect(fg_icons_create(&icons, us.context, made.field, made.shared, NULL) ==
           FG_STATUS_OK);
    if (us.ranks->rank == 0)
      expect(icons && fg_icons_clusters(icons) == seed);
    fg_icons_destroy(icons);
    subject_clear(&made);
  }
  end_together();
}

/* A stop that one rank alone hears of ends the work of all. */
static void a_stop_of_one_rank_stops_all(void **state)
{
  (void)state;
  const bool periodic[2] = {true, false};
  subject s = subject_of(&SHAPES[0], periodic, false);
  if (us.ranks->rank == us.ranks->count - 1)
    fg_context_stop(us.context);
  fg_icons *icons;
  expect(fg_icons_create(&icons, us.context, s.field, s.shared, NULL) ==
         FG_STATUS_STOPPED);
  expect(!icons);
  subject_clear(&s);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(parts_give_the_icons_of_the_whole),
      TOGETHER(ranks_without_a_cluster_take_part),
      TOGETHER(a_stop_of_one_rank_stops_all),
  };
  return cmocka_run_group_tests_name("icon/icons", tests, NULL, NULL);
}
