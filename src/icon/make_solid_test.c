#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/vector.h"
#include "icon/make.h"

/* Fields and clusters by formula on [-1, 1]^3, turned about an axis by quarters. */
typedef struct turn {
  int axis, quarters;
} turn;

static void turn_back(const turn *t, const double from[3], double to[3])
{
  int a = (t->axis + 1) % 3, b = (t->axis + 2) % 3;
  memcpy(to, from, 3 * sizeof *to);
  for (int n = 0; n < t->quarters; ++n) {
    double swap = to[a];
    to[a] = to[b];
    to[b] = -swap;
  }
}

static void turn_on(const turn *t, const double from[3], double to[3])
{
  const turn rest = {t->axis, (4 - t->quarters) % 4};
  turn_back(&rest, from, to);
}

/* Round an upright axis, on surfaces that rise with the angle and are slanted. */
static void velocity_at(const double p[3], double v[3])
{
  v[0] = -(p[1] + 0.05);
  v[1] = p[0] - 0.08;
  v[2] = 0.24 + 0.3 * v[0] + 0.2 * v[1];
}

/* Depth of a bent and tapering bar along such a helix. */
static double depth_at(const double p[3])
{
  double x = p[0] - 0.08, y = p[1] + 0.05, z = p[2];
  double radius = sqrt(x * x + y * y), angle = atan2(y, x - 0.03);
  double rise = z - 0.24 * angle - 0.3 * x - 0.2 * y;
  double away = radius - 0.52 - 0.03 * angle;
  double round = sqrt(away * away + 0.6 * rise * rise);
  return fmin(0.17 + 0.015 * angle - round, 0.35 * (2.3 - fabs(angle - 0.2)));
}

enum { DATA = 33, NODES = 49 };

static fg_field *field_of(const turn *t)
{
  static float sample[3][DATA * DATA * DATA];
  double axis[DATA];
  for (int n = 0; n < DATA; ++n)
    axis[n] = -1.0 + 2.0 * n / (DATA - 1);
  for (int n = 0; n < DATA * DATA * DATA; ++n) {
    const double at[3] = {axis[n % DATA], axis[n / DATA % DATA], axis[n / DATA / DATA]};
    double from[3], v[3], turned[3];
    turn_back(t, at, from);
    velocity_at(from, v);
    turn_on(t, v, turned);
    for (int k = 0; k < 3; ++k)
      sample[k][n] = (float)turned[k];
  }
  fg_field_arrays arrays = {.dimension = 3,
                            .size = {DATA, DATA, DATA},
                            .axis = {axis, axis, axis},
                            .velocity = {sample[0], sample[1], sample[2]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  return field;
}

static void window_of(fg__window *out, const turn *t)
{
  static float level[NODES * NODES * NODES];
  static unsigned char active[NODES * NODES * NODES];
  double spacing = 2.0 / (NODES - 1);
  *out = (fg__window){.cluster = 3,
                      .dimension = 3,
                      .nodes = {NODES, NODES, NODES},
                      .origin = {-1.0, -1.0, -1.0},
                      .spacing = {spacing, spacing, spacing},
                      .level = level,
                      .active = active};
  memset(active, 1, sizeof active);
  for (int n = 0; n < NODES * NODES * NODES; ++n) {
    const double at[3] = {-1.0 + spacing * (n % NODES),
                          -1.0 + spacing * (n / NODES % NODES),
                          -1.0 + spacing * (n / NODES / NODES)};
    double from[3];
    turn_back(t, at, from);
    level[n] = (float)fmax(fmin(depth_at(from) / spacing, 1.0), -1.0);
  }
}

static fg_icon make(const turn *t, fg_surface **solid)
{
  fg__chooser chooser = {0};
  fg__window window;
  fg_icon icon;
  fg_field *field = field_of(t);
  window_of(&window, t);
  assert_int_equal(fg__icon_make(&icon, NULL, &chooser, field, &window), FG_STATUS_OK);
  assert_true(icon.point_count > 8);
  assert_int_equal(fg_icon_solid(solid, NULL, &icon), FG_STATUS_OK);
  fg_field_destroy(field);
  fg__chooser_clear(&chooser);
  return icon;
}

static double length_of(const double (*points)[3], int count)
{
  double length = 0.0;
  for (int n = 1; n < count; ++n)
    length += fg__distance(points[n], points[n - 1]);
  return length;
}

static void an_arrow_lies_in_its_cluster_along_the_flow(void **state)
{
  (void)state;
  const turn none = {0, 0};
  fg_surface *solid;
  fg_icon icon = make(&none, &solid);
  fg__window window;
  window_of(&window, &none);
  for (int n = 0; n < solid->vertex_count; ++n)
    assert_true(fg__window_level(&window, solid->vertex[n]) > 0.0);
  double length = length_of(icon.points, icon.point_count), angle = 0.0;
  for (int n = 1; n < icon.point_count; ++n) {
    double middle[3], along[3], v[3], across[3];
    for (int k = 0; k < 3; ++k)
      middle[k] = (icon.points[n][k] + icon.points[n - 1][k]) / 2.0;
    fg__subtract(icon.points[n], icon.points[n - 1], along);
    velocity_at(middle, v);
    fg__cross(along, v, across);
    angle = fmax(angle, atan2(fg__length(across), fg__dot(along, v)));
  }
  assert_true(angle < 0.01);
  /* most of the slab, which is 0.52 * 4.4 long, and as bold as the rules allow */
  assert_true(length > 1.2 && icon.width > 0.028 * length);
  assert_true(icon.head_width > 2 * icon.width);
  /* the lines: the streamline holds the arrow's, the spine ends where the cluster does */
  assert_true(length_of(icon.streamline, icon.streamline_count) > length);
  assert_true(length_of(icon.spine, icon.spine_count) > 1.6);
  for (int n = 1; n + 1 < icon.spine_count; ++n) {
    double depth = depth_at(icon.spine[n]);
    assert_true(depth > 0.0);
    if (n > icon.spine_count / 4 && n < icon.spine_count * 3 / 4)
      assert_true(depth > 0.1); /* of some 0.17: the ridge */
  }
  double nearest = 1.0;
  for (int n = 0; n < icon.point_count; ++n)
    nearest = fmin(nearest, fg__distance(icon.center, icon.points[n]));
  assert_true(nearest < 2.0 / (NODES - 1));
  fg_surface_destroy(solid);
  fg__icon_free(&icon);
}

/* The grid's samples of the cluster are its own again after a quarter turn, but for
 * rounding. */
static void a_turned_field_has_turned_icons(void **state)
{
  (void)state;
  const turn none = {0, 0};
  fg_surface *first, *other;
  fg_icon before = make(&none, &first);
  for (int axis = 0; axis < 3; ++axis)
    for (int quarters = 1; quarters <= 3; ++quarters) {
      const turn t = {axis, quarters};
      fg_icon after = make(&t, &other);
      assert_int_equal(after.point_count, before.point_count);
      double worst = fabs(after.width - before.width);
      for (int n = 0; n < before.point_count; ++n) {
        double turned[3];
        turn_on(&t, before.points[n], turned);
        worst = fmax(worst, fg__distance(turned, after.points[n]));
      }
      assert_true(worst < 1e-6);
      assert_true(fabs(after.speed - before.speed) < 1e-6);
      fg_surface_destroy(other);
      fg__icon_free(&after);
    }
  fg_surface_destroy(first);
  fg__icon_free(&before);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_arrow_lies_in_its_cluster_along_the_flow),
      cmocka_unit_test(a_turned_field_has_turned_icons),
  };
  return cmocka_run_group_tests_name("icon/make_solid", tests, NULL, NULL);
}
