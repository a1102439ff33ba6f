/* The rivals in 3D. */
#include "base/vector.h"
#include "rival/cluster/lloyd.h"
#include "rival/fields_test.h"
#include "rival/lattice.h"
#include "rival/streamline/evenly.h"
#include "rival/streamline/farthest.h"
#include "rival/streamline/lines_test.h"

#include <stdlib.h>
#include <string.h>

/* Samples and place of a box that is nothing special; `turn` of its axes go round: axis k
 * here is axis (k + turn) % 3 there. */
enum { MOST_SAMPLES = 27 };
static const int SAMPLES[3] = {27, 21, 17};
static const double FIRST[3] = {-3, 2, 10};
static const double STEP[3] = {0.5, 0.4, 0.6};

typedef void (*velocity_in)(const double x[3], double v[3]);

static fg_field *volume_of(fg_context *context, velocity_in velocity, bool round,
                           int turn)
{
  static float sample[3][27 * 21 * 17];
  double axis[3][MOST_SAMPLES];
  fg_field_arrays arrays = {.dimension = 3};
  for (int k = 0; k < 3; k++) {
    int to = (k + turn) % 3;
    for (int i = 0; i < SAMPLES[k]; i++)
      axis[to][i] = FIRST[k] + STEP[k] * i;
    arrays.size[to] = SAMPLES[k];
    arrays.axis[to] = axis[to];
    arrays.velocity[to] = sample[to];
    arrays.period[to] = round && k == 1 ? SAMPLES[k] * STEP[k] : 0;
  }
  int at[3];
  size_t n = 0;
  for (at[2] = 0; at[2] < arrays.size[2]; at[2]++)
    for (at[1] = 0; at[1] < arrays.size[1]; at[1]++)
      for (at[0] = 0; at[0] < arrays.size[0]; at[0]++, n++) {
        double x[3], v[3];
        for (int k = 0; k < 3; k++)
          x[k] = axis[(k + turn) % 3][at[(k + turn) % 3]];
        velocity(x, v);
        for (int k = 0; k < 3; k++)
          sample[(k + turn) % 3][n] = (float)v[k];
      }
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static void whirl(const double x[3], double v[3])
{
  v[0] = 1.3 * sin(0.5 * x[1] + 0.2) + 0.2;
  v[1] = cos(0.4 * x[2]) + 0.3 * sin(0.6 * x[0]);
  v[2] = 0.8 * cos(0.5 * x[0]) - 0.1 * x[1];
}

/* The same round a ball and off one edge of the box. */
static void vessel(const double x[3], double v[3])
{
  const double center[3] = {3, 6, 15};
  whirl(x, v);
  if (fg__distance(x, center) < 2 || x[0] + x[2] < 9)
    v[0] = (double)NAN;
}

static const fg_rival_method every_method[] = {
    FG_RIVAL_HEDGEHOG, FG_RIVAL_GRID_CURVED, FG_RIVAL_STREAMLINES, FG_RIVAL_FARTHEST,
    FG_RIVAL_RANDOM,   FG_RIVAL_K_MEANS,     FG_RIVAL_VORONOI};
enum { EVERY = sizeof every_method / sizeof *every_method };

static bool is_exact(fg_rival_method method)
{
  return method == FG_RIVAL_FARTHEST || method == FG_RIVAL_RANDOM ||
         method == FG_RIVAL_K_MEANS || method == FG_RIVAL_VORONOI;
}

static fg_icons *icons_of(fg_context *context, const fg_field *field,
                          fg_rival_method method, double length, int count)
{
  /* cells for all of them */
  const int nodes = count < 100 ? 19 : 27;
  const fg_rival_options options = {.method = method, .nodes = nodes, .length = length};
  fg_rival *rival = NULL;
  fg_icons *icons = NULL;
  assert_int_equal(fg_rival_create(&rival, context, field, &options), FG_STATUS_OK);
  assert_int_equal(fg_rival_icons(&icons, rival, count), FG_STATUS_OK);
  fg_rival_destroy(rival);
  return icons;
}

static bool is_in_box(const fg_field *field, const double point[3])
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  bool inside = true;
  for (int k = 0; k < 3; k++) {
    double first = arrays->axis[k][0], last = arrays->axis[k][arrays->size[k] - 1];
    last = arrays->period[k] > 0 ? first + arrays->period[k] : last;
    inside = inside && point[k] > first - 1e-9 && point[k] < last + 1e-9;
  }
  return inside;
}

/* All along an icon the domain is not left; curved ones follow the flow. */
static void assert_fits(const fg_icon *icon, const fg_field *field, bool curved)
{
  for (int i = 1; i < icon->point_count; i++) {
    const double *p = icon->points[i - 1], *q = icon->points[i];
    for (int n = 0; n <= 4; n++) {
      double point[3], tangent[3], piece[3];
      fg__subtract(q, p, piece);
      fg__add_scaled(p, n / 4.0, piece, point);
      assert_true(is_in_box(field, point));
      assert_true(fg_field_tangent(field, point, tangent) || n % 2);
      if (n != 2 || !curved)
        continue;
      double along = fg__dot(piece, tangent) / fg__length(piece) / fg__length(tangent);
      assert_true(along > cos(0.06));
    }
  }
  assert_true(icon->speed > 0 && icon->width > 0 && icon->area > 0);
  assert_true(is_in_box(field, icon->center));
}

static void arrows_stay_in_the_domain(void **state)
{
  for (int kind = 0; kind < 3; kind++) {
    fg_field *field = volume_of(*state, kind == 1 ? vessel : whirl, kind == 2, 0);
    for (int m = 0; m < EVERY; m++) {
      fg_icons *icons = icons_of(*state, field, every_method[m], 0, 40);
      int count = fg_icons_count(icons);
      assert_true(count > 25 && count < 55);
      if (is_exact(every_method[m]))
        assert_int_equal(count, 40);
      for (int n = 0; n < count; n++)
        assert_fits(fg_icons_at(icons, n), field, every_method[m] != FG_RIVAL_HEDGEHOG);
      fg_icons_destroy(icons);
    }
    fg_field_destroy(field);
  }
}

static void exactly_so_many(void **state)
{
  fg_field *field = volume_of(*state, vessel, false, 0);
  for (int m = 0; m < EVERY; m++)
    for (int count = 1; count < 60 && is_exact(every_method[m]); count += 29) {
      fg_icons *icons = icons_of(*state, field, every_method[m], 0, count);
      assert_int_equal(fg_icons_count(icons), count);
      fg_icons_destroy(icons);
    }
  fg_field_destroy(field);
}

static void a_second_time_is_the_same(void **state)
{
  fg_field *field = volume_of(*state, vessel, false, 0);
  for (int m = 0; m < EVERY; m++) {
    fg_icons *a = icons_of(*state, field, every_method[m], 0, 21);
    fg_icons *b = icons_of(*state, field, every_method[m], 0, 21);
    assert_int_equal(fg_icons_count(a), fg_icons_count(b));
    for (int n = 0; n < fg_icons_count(a); n++) {
      const fg_icon *one = fg_icons_at(a, n), *two = fg_icons_at(b, n);
      assert_int_equal(one->point_count, two->point_count);
      assert_memory_equal(one->points, two->points,
                          (size_t)one->point_count * sizeof *one->points);
    }
    fg_icons_destroy(a);
    fg_icons_destroy(b);
  }
  fg_field_destroy(field);
}

/* Arrows are as long as was said, in sides of their share of the volume, but for those
 * that the domain cuts or that turn too far. */
static void lengths_are_fair_shares(void **state)
{
  static const fg_rival_method method[] = {FG_RIVAL_HEDGEHOG, FG_RIVAL_GRID_CURVED,
                                           FG_RIVAL_RANDOM, FG_RIVAL_K_MEANS,
                                           FG_RIVAL_VORONOI};
  fg_field *field = volume_of(*state, whirl, false, 0);
  double share = cbrt(26 * 0.5 * 20 * 0.4 * 16 * 0.6 / 50);
  for (int m = 0; m < 5; m++)
    for (double length = 0.4; length < 1; length += 0.5) {
      fg_icons *icons = icons_of(*state, field, method[m], length, 50);
      int whole = 0;
      for (int n = 0; n < fg_icons_count(icons); n++) {
        double found = fg__icon_length(fg_icons_at(icons, n)) / (length * share);
        assert_true(found < 1 + 1e-9);
        whole += found > 0.99;
      }
      assert_true(whole > 0.5 * fg_icons_count(icons));
      fg_icons_destroy(icons);
    }
  fg_field_destroy(field);
}

static double distance_to(const fg__domain *domain, const double place[3],
                          double (*points)[3], int count)
{
  double least = HUGE_VAL;
  for (int i = 0; i < count; i++) {
    double way[3];
    fg__subtract(place, points[i], way);
    fg__domain_shortest(domain, way);
    least = fmin(least, fg__length(way));
  }
  return least;
}

/* Points of lines are an eighth of a separation apart in the method: between them a line
 * can be nearer by a fiftieth. */
static void assert_apart(fg_context *context, const fg__domain *domain,
                         const fg__lines *lines, double test)
{
  assert_true(lines->count > 7);
  for (int n = 0; n < lines->count; n++)
    for (int m = 0; m < n; m++) {
      double(*a)[3], (*b)[3];
      int of_a = sample_line(&a, context, domain, lines, n, lines->separation / 7);
      int of_b = sample_line(&b, context, domain, lines, m, lines->separation / 7);
      for (int i = 0; i < of_a; i++)
        assert_true(distance_to(domain, a[i], b, of_b) > 0.97 * test);
      assert_true(distance_to(domain, lines->part[n].seed, b, of_b) >
                  0.97 * lines->separation);
      free(a);
      free(b);
    }
}

static void lines_keep_their_distance(void **state)
{
  for (int kind = 0; kind < 3; kind++) {
    fg_field *field = volume_of(*state, kind == 1 ? vessel : whirl, kind == 2, 0);
    fg__domain domain;
    fg__lines lines = {0};
    assert_int_equal(fg__domain_create(&domain, *state, field, 31), FG_STATUS_OK);
    assert_int_equal(fg__evenly_place(&lines, *state, &domain, 2.3), FG_STATUS_OK);
    assert_apart(*state, &domain, &lines, FG__EVENLY_TEST * 2.3);
    assert_int_equal(fg__farthest_place(&lines, *state, &domain, 2.1, 1000),
                     FG_STATUS_OK);
    assert_apart(*state, &domain, &lines, FG__FARTHEST_TEST * 2.1);
    fg__lines_clear(&lines);
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
}

/* Axes that change their places take the seeds with them. */
static void turned_axes_turn_the_seeds(void **state)
{
  enum { COUNT = 8 };
  fg__lloyd lloyd[3];
  for (int turn = 0; turn < 3; turn++) {
    fg_field *field = volume_of(*state, whirl, false, turn);
    fg__domain domain;
    assert_int_equal(fg__domain_create(&domain, *state, field, 25), FG_STATUS_OK);
    assert_int_equal(fg__lloyd_create(&lloyd[turn], *state, &domain, COUNT, 1),
                     FG_STATUS_OK);
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
  for (int turn = 1; turn < 3; turn++)
    for (int n = 0; n < COUNT; n++) {
      double nearest = HUGE_VAL;
      for (int m = 0; m < COUNT; m++) {
        double back[3];
        for (int k = 0; k < 3; k++)
          back[k] = lloyd[turn].center[m][(k + turn) % 3];
        nearest = fmin(nearest, fg__distance(back, lloyd[0].center[n]));
      }
      assert_true(nearest < 0.05);
    }
  for (int turn = 0; turn < 3; turn++)
    fg__lloyd_clear(&lloyd[turn]);
}

static void grids_nearly_meet_the_number(void **state)
{
  for (int turn = 0; turn < 3; turn++) {
    fg_field *field = volume_of(*state, vessel, false, turn);
    fg__domain domain;
    assert_int_equal(fg__domain_create(&domain, *state, field, 33), FG_STATUS_OK);
    for (int count = 19; count < 160; count += 31) {
      fg__lattice lattice;
      assert_int_equal(fg__lattice_choose(&lattice, *state, &domain, count),
                       FG_STATUS_OK);
      for (int k = 0; k < 3; k++)
        assert_true(lattice.spacing[k] < 1.41 * lattice.spacing[(k + 1) % 3] &&
                    lattice.spacing[(k + 1) % 3] < 1.41 * lattice.spacing[k]);
      assert_true(lattice.inside >= 0.9 * count - 2 && lattice.inside <= 1.1 * count + 2);
    }
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
}

/* Random points fill the box evenly: about as many on either side of the middle of each
 * axis. */
static void lots_are_even(void **state)
{
  enum { COUNT = 400 };
  fg_field *field = volume_of(*state, whirl, false, 0);
  fg_icons *icons = icons_of(*state, field, FG_RIVAL_RANDOM, 0.5, COUNT);
  int low[3] = {0, 0, 0};
  assert_int_equal(fg_icons_count(icons), COUNT);
  for (int n = 0; n < COUNT; n++)
    for (int k = 0; k < 3; k++)
      low[k] +=
          fg_icons_at(icons, n)->center[k] < FIRST[k] + STEP[k] * (SAMPLES[k] - 1) / 2;
  for (int k = 0; k < 3; k++) /* four standard deviations */
    assert_true(abs(low[k] - COUNT / 2) < 4 * sqrt(COUNT) / 2);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(arrows_stay_in_the_domain),    CASE(exactly_so_many),
      CASE(a_second_time_is_the_same),    CASE(lengths_are_fair_shares),
      CASE(lines_keep_their_distance),    CASE(turned_axes_turn_the_seeds),
      CASE(grids_nearly_meet_the_number), CASE(lots_are_even),
  };
  return cmocka_run_group_tests_name("rival/space", tests, NULL, NULL);
}
