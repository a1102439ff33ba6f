#include "rival/fields_test.h"
#include "rival/lattice.h"

#include <string.h>

static fg_icons *draw(fg_context *context, const fg_field *field,
                      const fg_rival_options *options, int count)
{
  fg_rival *rival = NULL;
  fg_icons *icons = NULL;
  assert_int_equal(fg_rival_create(&rival, context, field, options), FG_STATUS_OK);
  assert_int_equal(fg_rival_icons(&icons, rival, count), FG_STATUS_OK);
  fg_rival_destroy(rival);
  return icons;
}

/* Middle between tail and tip. */
static void middle_of(const fg_icon *icon, double middle[2])
{
  const double *tail = icon->points[0], *tip = icon->points[icon->point_count - 1];
  middle[0] = (tail[0] + tip[0]) / 2;
  middle[1] = (tail[1] + tip[1]) / 2;
}

static void hedgehog_is_straight_along_the_flow(void **state)
{
  fg_field *field = field_of(*state, swirl, false);
  fg_rival_options options = {.method = FG_RIVAL_HEDGEHOG};
  fg_icons *icons = draw(*state, field, &options, 37);
  assert_true(fg_icons_count(icons) >= 30 && fg_icons_count(icons) <= 44);
  double length = fg__icon_length(fg_icons_at(icons, 0));
  for (int n = 0; n < fg_icons_count(icons); n++) {
    const fg_icon *icon = fg_icons_at(icons, n);
    const double *tail = icon->points[0], *tip = icon->points[icon->point_count - 1];
    double middle[2], along[2] = {tip[0] - tail[0], tip[1] - tail[1]}, velocity[2];
    middle_of(icon, middle);
    assert_true(fg_field_velocity(field, middle, velocity));
    assert_true(fabs(angle_between(along, velocity)) < 1e-9);
    assert_true(fabs(hypot(along[0], along[1]) - length) < 1e-9);
    assert_true(fabs(fg__icon_length(icon) - length) < 1e-9);
    assert_true(icon->speed > 0 && icon->width > 0);
  }
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void hedgehog_points_are_a_grid(void **state)
{
  fg_field *field = field_of(*state, swirl, false);
  fg_icons *icons = draw(*state, field, NULL, 48);
  double first[2], second[2];
  middle_of(fg_icons_at(icons, 0), first);
  middle_of(fg_icons_at(icons, 1), second);
  double spacing = second[0] - first[0];
  for (int n = 0; n < fg_icons_count(icons); n++) {
    double middle[2];
    middle_of(fg_icons_at(icons, n), middle);
    double column = (middle[0] - first[0]) / spacing;
    assert_true(fabs(column - round(column)) < 1e-9);
    for (int m = 0; m < n; m++) {
      double other[2];
      middle_of(fg_icons_at(icons, m), other);
      assert_true(hypot(middle[0] - other[0], middle[1] - other[1]) > 0.79 * spacing);
    }
  }
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void lengths_follow_the_speed(void **state)
{
  fg_field *field = field_of(*state, swirl, false);
  fg_rival_options options = {.length_by_speed = true};
  fg_icons *icons = draw(*state, field, &options, 40);
  double ratio = 0;
  for (int n = 0; n < fg_icons_count(icons); n++) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double middle[2], velocity[2];
    middle_of(icon, middle);
    assert_true(fg_field_velocity(field, middle, velocity));
    double here = fg__icon_length(icon) / hypot(velocity[0], velocity[1]);
    assert_true(n == 0 || fabs(here / ratio - 1) < 1e-6);
    ratio = here;
  }
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void curved_ones_follow_the_flow(void **state)
{
  fg_field *field = field_of(*state, coast, false);
  fg_rival_options options = {.method = FG_RIVAL_GRID_CURVED};
  fg_icons *icons = draw(*state, field, &options, 60);
  assert_true(fg_icons_count(icons) > 50);
  assert_int_equal(fg_icons_clusters(icons),
                   fg_icons_count(icons) + fg_icons_dropped(icons));
  assert_along_flow(icons, field, 0.02);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void straight_ones_stay_in_the_domain(void **state)
{
  fg_field *field = field_of(*state, coast, false);
  fg_icons *icons = draw(*state, field, NULL, 90);
  for (int n = 0; n < fg_icons_count(icons); n++) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double velocity[2];
    for (int i = 0; i < icon->point_count; i++)
      assert_true(fg_field_velocity(field, icon->points[i], velocity));
  }
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* On a domain with holes, too, the number is nearly met by a regular grid. */
static void the_number_is_nearly_met(void **state)
{
  fg_field *field = field_of(*state, coast, false);
  fg__domain domain;
  assert_int_equal(fg__domain_create(&domain, *state, field, 97), FG_STATUS_OK);
  for (int count = 3; count < 90; count += 7) {
    fg__lattice lattice;
    assert_int_equal(fg__lattice_choose(&lattice, *state, &domain, count), FG_STATUS_OK);
    assert_true(lattice.spacing[0] < 1.26 * lattice.spacing[1]);
    assert_true(lattice.spacing[1] < 1.26 * lattice.spacing[0]);
    assert_true(lattice.inside >= 0.8 * count - 2 && lattice.inside <= 1.2 * count + 2);
  }
  fg__domain_clear(&domain);
  fg_field_destroy(field);
}

static void assert_refused(fg_context *context, fg_status found, fg_status expected,
                           const char *part)
{
  assert_int_equal(found, expected);
  assert_non_null(strstr(fg_context_message(context), part));
  fg_context_clear(context);
}

static void what_cannot_be_is_refused(void **state)
{
  fg_context *context = *state;
  fg_rival *rival = NULL;
  fg_icons *icons = NULL;
  fg_field *space = NULL, *field = field_of(context, swirl, false);
  assert_int_equal(fg_field_create_analytic(&space, context, "abc", 5), FG_STATUS_OK);
  fg_rival_options options = {.method = FG_RIVAL_DISCRETE};
  assert_refused(context, fg_rival_create(&rival, context, space, &options),
                 FG_STATUS_UNSUPPORTED, "3 dimensions");
  options = (fg_rival_options){.method = FG_RIVAL_TOP_DOWN};
  assert_refused(context, fg_rival_create(&rival, context, space, &options),
                 FG_STATUS_UNSUPPORTED, "top-down");
  assert_null(rival);
  options = (fg_rival_options){.length = -0.5};
  assert_refused(context, fg_rival_create(&rival, context, field, &options),
                 FG_STATUS_ARGUMENT, "-0.5");
  options = (fg_rival_options){.nodes = 2000};
  assert_refused(context, fg_rival_create(&rival, context, space, &options),
                 FG_STATUS_ARGUMENT, "2000 nodes");
  options = (fg_rival_options){.method = (fg_rival_method)99};
  assert_refused(context, fg_rival_create(&rival, context, field, &options),
                 FG_STATUS_ARGUMENT, "99");
  options = (fg_rival_options){.nodes = 2};
  assert_refused(context, fg_rival_create(&rival, context, field, &options),
                 FG_STATUS_ARGUMENT, "2 nodes");
  assert_int_equal(fg_rival_create(&rival, context, field, NULL), FG_STATUS_OK);
  assert_refused(context, fg_rival_icons(&icons, rival, 0), FG_STATUS_ARGUMENT,
                 "0 icons");
  fg_context_stop(context);
  assert_int_equal(fg_rival_icons(&icons, rival, 9), FG_STATUS_STOPPED);
  assert_null(icons);
  fg_rival_destroy(rival);
  fg_field_destroy(space);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(hedgehog_is_straight_along_the_flow),
      CASE(hedgehog_points_are_a_grid),
      CASE(lengths_follow_the_speed),
      CASE(curved_ones_follow_the_flow),
      CASE(straight_ones_stay_in_the_domain),
      CASE(the_number_is_nearly_met),
      CASE(what_cannot_be_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
