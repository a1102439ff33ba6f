#include "rival/fields_test.h"
#include "rival/streamline/evenly.h"

#include <stdlib.h>

/* One field's lines, each as a list of points as close as `spacing`. */
typedef struct bench {
  fg_field *field;
  fg__domain domain;
  fg__lines evenly;
  double (*point)[3];
  int *first; /* [lines + 1] */
} bench;

static void sample_lines(bench *b, fg_context *context, double spacing)
{
  fg__line line = {0};
  int capacity = 0, used = 0;
  b->first = calloc((size_t)b->evenly.count + 1, sizeof *b->first);
  assert_non_null(b->first);
  for (int n = 0; n < b->evenly.count; n++) {
    const fg__lines_part *part = &b->evenly.part[n];
    assert_int_equal(fg__lines_trace(&line, context, &b->domain, &b->evenly, part->seed,
                                     fmax(-part->from, part->to)),
                     FG_STATUS_OK);
    int pieces = (int)ceil((part->to - part->from) / spacing);
    if (used + pieces + 1 > capacity) {
      capacity = 2 * (used + pieces + 1);
      b->point = realloc(b->point, (size_t)capacity * sizeof *b->point);
      assert_non_null(b->point);
    }
    for (int i = 0; i <= pieces; i++) {
      double tangent[3];
      fg__line_at(&line, line.start + part->from + (part->to - part->from) * i / pieces,
                  NULL, b->point[used++], tangent);
    }
    b->first[n + 1] = used;
  }
  fg__line_clear(&line);
}

static void set_up(bench *b, fg_context *context, velocity_of velocity, bool round,
                   double separation)
{
  *b = (bench){.field = field_of(context, velocity, round)};
  assert_int_equal(fg__domain_create(&b->domain, context, b->field, 121), FG_STATUS_OK);
  assert_int_equal(fg__evenly_place(&b->evenly, context, &b->domain, separation),
                   FG_STATUS_OK);
  sample_lines(b, context, separation / 11);
}

static void tear_down(bench *b)
{
  free(b->point);
  free(b->first);
  fg__lines_clear(&b->evenly);
  fg__domain_clear(&b->domain);
  fg_field_destroy(b->field);
}

static double distance_between(const bench *b, const double p[2], const double q[2])
{
  double way[2] = {p[0] - q[0], p[1] - q[1]};
  fg__domain_shortest(&b->domain, way);
  return hypot(way[0], way[1]);
}

static double distance_to_line(const bench *b, const double p[2], int line)
{
  double least = HUGE_VAL;
  for (int i = b->first[line]; i < b->first[line + 1]; i++)
    least = fmin(least, distance_between(b, p, b->point[i]));
  return least;
}

/* Points of lines stand a sixteenth of a separation apart in the method, an eleventh
 * here: between them a line can be nearer by a hundredth. */
static void assert_distances(const bench *b)
{
  double separation = b->evenly.separation;
  for (int n = 0; n < b->evenly.count; n++)
    for (int m = 0; m < n; m++) {
      double seed_way = distance_to_line(b, b->evenly.part[n].seed, m);
      assert_true(seed_way > 0.99 * separation);
      for (int i = b->first[n]; i < b->first[n + 1]; i++)
        assert_true(distance_to_line(b, b->point[i], m) >
                    0.99 * FG__EVENLY_TEST * separation);
    }
}

static void lines_keep_their_distance(void **state)
{
  static const double separation[] = {3.1, 1.7, 0.9};
  for (int k = 0; k < 3; k++) {
    bench b;
    set_up(&b, *state, k == 1 ? coast : swirl, false, separation[k]);
    assert_true(b.evenly.count > 5);
    assert_distances(&b);
    tear_down(&b);
  }
}

static void also_across_a_periodic_boundary(void **state)
{
  bench b;
  set_up(&b, *state, swirl, true, 1.9);
  int across = 0;
  for (int i = 0; i < b.first[b.evenly.count]; i++)
    across +=
        b.point[i][0] < CORNER[0] || b.point[i][0] > CORNER[0] + COLUMNS * SAMPLING[0];
  assert_true(across > 0);
  assert_distances(&b);
  tear_down(&b);
}

/* Closed orbits: a line must not run over itself. */
static void turning(double x, double y, double v[2])
{
  v[0] = -(y - 11.3);
  v[1] = 1.3 * (x - 7.2);
}

static void lines_stay_away_from_themselves(void **state)
{
  bench b;
  set_up(&b, *state, turning, false, 1.4);
  double test = FG__EVENLY_TEST * b.evenly.separation;
  int round = 0;
  for (int n = 0; n < b.evenly.count; n++) {
    double length = b.evenly.part[n].to - b.evenly.part[n].from;
    int first = b.first[n], last = b.first[n + 1] - 1;
    double step = length / (last - first);
    for (int i = first; i <= last; i++)
      for (int j = i + 1; j <= last; j++)
        assert_true((j - i) * step < 1.7 * test ||
                    distance_between(&b, b.point[i], b.point[j]) > 0.98 * test);
    round += distance_between(&b, b.point[first], b.point[last]) < 2 * test &&
             length > 8 * test;
  }
  assert_true(round > 2); /* orbits that are whole but for a gap */
  tear_down(&b);
}

/* A uniform flow: parallel lines, each a separation from the next, none left out. */
static void a_uniform_flow_is_covered(void **state)
{
  bench b;
  set_up(&b, *state, slant, false, 1.3);
  double place[64];
  assert_true(b.evenly.count < 64);
  for (int n = 0; n < b.evenly.count; n++) {
    const double *seed = b.evenly.part[n].seed;
    place[n] = seed[1] * cos(SLANT) - seed[0] * sin(SLANT);
  }
  for (int n = 0; n < b.evenly.count; n++) {
    double nearest = HUGE_VAL;
    for (int m = 0; m < b.evenly.count; m++)
      if (m != n)
        nearest = fmin(nearest, fabs(place[n] - place[m]));
    assert_true(fabs(nearest / 1.3 - 1) < 1e-6);
  }
  /* the box is so wide across the flow; corners hold only lines that are too short */
  double across = 30 * sin(SLANT) + 17.6 * cos(SLANT);
  assert_true(b.evenly.count <= across / 1.3 + 1);
  assert_true(b.evenly.count >= across / 1.3 - 3);
  tear_down(&b);
}

static void the_number_is_nearly_met(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, coast, false);
  fg_rival *rival = rival_of(context, field, FG_RIVAL_STREAMLINES, 121);
  for (int count = 8; count < 100; count += 23) {
    fg_icons *icons = curved_icons(rival, field, count);
    assert_true(abs(fg_icons_count(icons) - count) <= 1 + count / 20);
    fg_icons_destroy(icons);
  }
  fg_rival_destroy(rival);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(lines_keep_their_distance),       CASE(also_across_a_periodic_boundary),
      CASE(lines_stay_away_from_themselves), CASE(a_uniform_flow_is_covered),
      CASE(the_number_is_nearly_met),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
