#include <math.h>

#include "icon/icons.h"
#include "icon/slender.h"
#include "picture/solid_field_test.h"

static const double degree = 0.017453292519943295;

static bool everywhere(const double place[3], double velocity[3])
{
  (void)place;
  velocity[0] = 1.0;
  return true;
}

static fg_icons *create_icons(void)
{
  fg_icons *icons;
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  return icons;
}

/* A straight arrow. */
static void add(fg_icons *icons, const double from[3], const double along[3],
                double lambda)
{
  double points[2][3];
  for (int k = 0; k < 3; ++k) {
    points[0][k] = from[k];
    points[1][k] = from[k] + along[k];
  }
  fg_icon icon = {
      .cluster = 1, .point_count = 2, .points = (const double(*)[3])points, .speed = 1.0};
  fg__solid_set_slender(&icon, lambda);
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
}

/* A lattice of thin arrows, all alike. */
static fg_icons *lattice(double x, double y, double z)
{
  fg_icons *icons = create_icons();
  for (int n = 0; n < 27; ++n) {
    const double from[3] = {field_low[0] + 0.5 + 0.41 * (n % 3),
                            field_low[1] + 0.3 + 0.13 * (n / 3 % 3),
                            field_low[2] + 0.4 + 0.23 * (n / 9)};
    const double along[3] = {x, y, z};
    add(icons, from, along, 0.05);
  }
  return icons;
}

static void find(double view[2], const fg_icons *icons)
{
  fg_field *field = field_of(everywhere);
  assert_int_equal(fg_solid_best_view(&view[0], &view[1], NULL, field, icons),
                   FG_STATUS_OK);
  fg_field_destroy(field);
}

/* Of the angle between the line of sight and a direction. */
static double sine_of(const double view[2], double x, double y, double z)
{
  const double a = view[0] * degree, e = view[1] * degree;
  const double along = x * sin(a) * cos(e) - y * cos(a) * cos(e) + z * sin(e);
  return sqrt(1.0 - along * along / (x * x + y * y + z * z));
}

/* 0.95 of what is read of arrows across the view is read of such. */
static const double well_seen = 0.776;

/* The viewer stands across the arrows, on the side of the usual view. */
static void arrows_are_seen_from_the_side(void **state)
{
  (void)state;
  const double way[][2] = {{0.3, 0.3}, {-0.3, 0.3}, {0.0, 0.3}, {0.3, -0.1}};
  for (int n = 0; n < 4; ++n) {
    double view[2];
    fg_icons *icons = lattice(way[n][0], way[n][1], 0.0);
    find(view, icons);
    assert_true(sine_of(view, way[n][0], way[n][1], 0.0) > well_seen);
    assert_true(cos((view[0] - 30.0) * degree) > -0.1);
    fg_icons_destroy(icons);
  }
}

static void upright_arrows_are_seen_from_the_usual_place(void **state)
{
  (void)state;
  double view[2];
  fg_icons *icons = lattice(0.0, 0.0, 0.3);
  find(view, icons);
  assert_true(fabs(view[0] - 30.0) < 1e-9 && fabs(view[1] - 22.0) < 1e-9);
  fg_icons_destroy(icons);
}

/* Of few arrows across the others, too, something is read. */
static void no_arrows_point_at_the_viewer(void **state)
{
  (void)state;
  static const double across[3] = {0.3, 0.0, 0.0}, deep[3] = {0.0, 0.3, 0.0};
  fg_icons *icons = create_icons();
  for (int n = 0; n < 27; ++n) {
    const double from[3] = {field_low[0] + 0.5 + 0.41 * (n % 3),
                            field_low[1] + 0.3 + 0.13 * (n / 3 % 3),
                            field_low[2] + 0.4 + 0.23 * (n / 9)};
    add(icons, from, n % 7 ? across : deep, 0.05);
  }
  double view[2];
  find(view, icons);
  assert_true(sine_of(view, 1.0, 0.0, 0.0) > well_seen);
  assert_true(sine_of(view, 0.0, 1.0, 0.0) > 0.55);
  fg_icons_destroy(icons);
}

/* Thin arrows behind a fence of thick ones are seen from behind it. */
static void what_is_hidden_does_not_count(void **state)
{
  (void)state;
  fg_icons *icons = create_icons();
  for (int n = 0; n < 16; ++n) {
    const double from[3] = {field_low[0] + 0.1, field_low[1] + 0.03,
                            field_low[2] + 0.05 + 0.09 * n};
    const double along[3] = {1.8, 0.0, 0.0};
    add(icons, from, along, 2.6);
  }
  double view[2];
  find(view, icons);
  assert_true(cos((view[0] - 30.0) * degree) > 0.8);
  for (int n = 0; n < 60; ++n) {
    const double from[3] = {field_low[0] + 0.3 + 0.25 * (n % 5), field_low[1] + 0.25,
                            field_low[2] + 0.1 + 0.02 * n};
    const double along[3] = {0.5, 0.0, 0.0};
    add(icons, from, along, 0.05);
  }
  find(view, icons);
  assert_true(cos((view[0] - 180.0) * degree) > 0.8);
  fg_icons_destroy(icons);
}

static void without_icons_it_is_the_usual_one(void **state)
{
  (void)state;
  double view[2] = {0.0, 0.0};
  fg_icons *icons = create_icons();
  find(view, icons);
  assert_true(fabs(view[0] - 30.0) < 1e-9 && fabs(view[1] - 22.0) < 1e-9);
  assert_int_equal(fg_solid_best_view(&view[0], &view[1], NULL, NULL, icons),
                   FG_STATUS_ARGUMENT);
  fg_field *flat;
  assert_int_equal(fg_field_create_analytic(&flat, NULL, "vortex", 9), FG_STATUS_OK);
  assert_int_equal(fg_solid_best_view(&view[0], &view[1], NULL, flat, icons),
                   FG_STATUS_ARGUMENT);
  fg_field_destroy(flat);
  fg_icons_destroy(icons);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arrows_are_seen_from_the_side),
      cmocka_unit_test(upright_arrows_are_seen_from_the_usual_place),
      cmocka_unit_test(no_arrows_point_at_the_viewer),
      cmocka_unit_test(what_is_hidden_does_not_count),
      cmocka_unit_test(without_icons_it_is_the_usual_one),
  };
  return cmocka_run_group_tests_name("picture/viewpoint", tests, NULL, NULL);
}
