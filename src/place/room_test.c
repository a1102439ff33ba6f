/* Where arrows have room: all over singular fields, not in what is still, and in volumes
 * that are thin. */
#include "base/vector.h"
#include "place/placed_test.h"

/* Points of the box in a regular pattern, of which some are far from all arrows. */
enum { PROBES_2D = 40, PROBES_3D = 16 };

static double off(const double position[3], double x, double y, double z, double out[3])
{
  out[0] = position[0] - x;
  out[1] = position[1] - y;
  out[2] = position[2] - z;
  return fg__length(out);
}

static void add_charge(double v[3], const double position[3], double charge, double x,
                       double y)
{
  double way[3];
  const double r = off(position, x, y, 0, way);
  v[0] += charge * way[0] / (r * r * r);
  v[1] += charge * way[1] / (r * r * r);
}

static void charges(const double position[3], double v[3])
{
  v[0] = v[1] = 0;
  add_charge(v, position, 1, -0.4, 0.1);
  add_charge(v, position, -1, 0.4, -0.1);
  add_charge(v, position, 1, 0.1, 0.55);
  add_charge(v, position, -1, -0.2, -0.6);
}

static void dipole_2d(const double position[3], double v[3])
{
  double w[3];
  const double r = off(position, 0.013, -0.21, 0, w);
  v[0] = (w[0] * w[0] - w[1] * w[1]) / pow(r, 4);
  v[1] = 2 * w[0] * w[1] / pow(r, 4);
}

static void wire(const double position[3], double v[3])
{
  const double x = position[0] - 0.2, y = position[1] + 0.11, square = x * x + y * y;
  v[0] = -y / square;
  v[1] = x / square;
  v[2] = 0;
}

static void mass(const double position[3], double v[3])
{
  const double r = off(position, 0.31, -0.17, 0.05, v);
  for (int k = 0; k < 3; ++k)
    v[k] *= -1 / (r * r * r);
}

static void dipole_3d(const double position[3], double v[3])
{
  double w[3];
  const double r = off(position, 0.01, 0.01, 0.01, w);
  for (int k = 0; k < 3; ++k)
    v[k] = (3 * w[2] * w[k] / (r * r) - (k == 2)) / pow(r, 3);
}

static const sampling SQUARE = {
    .dimension = 2, .nodes = {100, 100}, .low = {-1, -1}, .high = {1, 1}};
static const sampling CUBE = {
    .dimension = 3, .nodes = {40, 40, 40}, .low = {-1, -1, -1}, .high = {1, 1, 1}};

static double distance_to_arrows(const fg_icons *icons, const double position[3])
{
  double least = HUGE_VAL;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 1; i < icon->point_count; ++i)
      for (int t = 0; t < 4; ++t) {
        double at[3];
        fg__lerp(icon->points[i - 1], t / 3.0, icon->points[i], at);
        least = fmin(least, fg__distance(at, position));
      }
  }
  return least;
}

/* The share of a box of side 2 that is farther than that from all arrows. */
static double share_beyond(const fg_icons *icons, int dimension, double distance)
{
  const int side = dimension == 2 ? PROBES_2D : PROBES_3D;
  int beyond = 0, all = 0;
  for (int z = 0; z < (dimension == 2 ? 1 : side); ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x, ++all) {
        const double position[3] = {(2 * x + 1.0) / side - 1, (2 * y + 1.0) / side - 1,
                                    dimension == 2 ? 0 : (2 * z + 1.0) / side - 1};
        beyond += distance_to_arrows(icons, position) > distance;
      }
  return (double)beyond / all;
}

static void singular_fields_have_arrows_all_over(void **state)
{
  static const struct {
    const sampling *box;
    velocity_of velocity;
    int count;
  } cases[] = {{&SQUARE, charges, 50}, {&SQUARE, dipole_2d, 30}, {&SQUARE, wire, 30},
               {&CUBE, wire, 30},      {&CUBE, mass, 30},        {&CUBE, dipole_3d, 40}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
    fg_icons *icons = place(*state, placement, cases[n].count);
    const fg__place_domain *domain = fg__placement_search(placement)->domain;
    assert_false(domain->dead);
    assert_close(domain->measure, domain->whole, 1e-9 * domain->whole);
    const double beyond =
        share_beyond(icons, domain->dimension, 1.2 * lambda_of(placement));
    if (beyond > 0.01)
      fail_msg("case %zu: %.3f of the box is farther than 1.2 lambda from all arrows", n,
               beyond);
    fg_icons_destroy(icons);
    fg_placement_destroy(placement);
    fg_field_destroy(field);
  }
}

static void cup(const double position[3], double v[3])
{
  const bool inside = hypot(position[0] - 0.2, position[1] + 0.11) < 0.6;
  wire(position, v);
  for (int k = 0; k < 3; ++k)
    v[k] *= inside;
}

static void jet(const double position[3], double v[3])
{
  v[0] = exp(-pow(position[1] / 0.08, 2));
  v[1] = 1e-9 * sin(9 * position[0]);
}

/* Parabolic flow in a round pipe. */
static double pipe_speed(const double position[3])
{
  return fmax(0.0, 1 - (pow(position[0], 2) + pow(position[1], 2)) / pow(0.3, 2));
}

static void pipe(const double position[3], double v[3])
{
  v[0] = v[1] = 0;
  v[2] = pipe_speed(position);
}

static void cut_pipe(const double position[3], double v[3])
{
  const double at[3] = {position[0], 0, 0};
  v[0] = 0;
  v[1] = pipe_speed(at);
}

/* What is still stays blank, beside singularities, too. */
static void still_surroundings_are_left_blank(void **state)
{
  static const struct {
    const sampling *box;
    velocity_of velocity;
    double measure;
  } cases[] = {{&SQUARE, cup, 3.14159 * 0.36}, {&SQUARE, jet, 2 * 2 * 0.08 * 2.63}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
    fg_icons *icons = place(*state, placement, 25);
    const fg__place_domain *domain = fg__placement_search(placement)->domain;
    assert_close(domain->measure, cases[n].measure, 0.08 * cases[n].measure);
    for (int i = 0; i < 25; ++i)
      assert_true(fg__place_moves(
          domain, fg__place_speed(domain, fg_icons_at(icons, i)->center)));
    fg_icons_destroy(icons);
    fg_placement_destroy(placement);
    fg_field_destroy(field);
  }
}

static int compare(const void *a, const void *b)
{
  const double *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

static double mean_along(const fg_field *field, const fg_icon *icon)
{
  double sum = 0.0, length = 0.0;
  for (int i = 1; i < icon->point_count; ++i) {
    double middle[3], v[3] = {0};
    const double piece = fg__distance(icon->points[i - 1], icon->points[i]);
    fg__lerp(icon->points[i - 1], 0.5, icon->points[i], middle);
    assert_true(fg_field_velocity(field, middle, v));
    sum += piece * fg__length(v);
    length += piece;
  }
  return sum / length;
}

/* An arrow's speed is that of what moves, not of the zeros round a pipe. */
static void speeds_are_of_what_moves(void **state)
{
  enum { COUNT = 25 };
  static const struct {
    const sampling *box;
    velocity_of velocity;
  } cases[] = {{&CUBE, pipe}, {&SQUARE, cut_pipe}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
    fg_icons *icons = place(*state, placement, COUNT);
    double ratio[COUNT];
    for (int i = 0; i < COUNT; ++i) {
      const fg_icon *icon = fg_icons_at(icons, i);
      assert_true(icon->speed > 0.2 && icon->speed <= 1);
      ratio[i] = icon->speed / mean_along(field, icon);
    }
    qsort(ratio, COUNT, sizeof *ratio, compare);
    assert_close(ratio[COUNT / 2], 1, 0.2);
    fg_icons_destroy(icons);
    fg_placement_destroy(placement);
    fg_field_destroy(field);
  }
}

/* Eddies in a plane. */
static void film(const double position[3], double v[3])
{
  v[0] = 1 + 0.8 * sin(6.2832 * position[1]) - 0.9 * position[0];
  v[1] = 0.9 * cos(6.2832 * position[0]) + 0.1;
  v[2] = 0;
}

static void sheet(const double position[3], double v[3])
{
  v[0] = 0;
  v[1] = 1 + 0.8 * sin(6.2832 * position[2]);
  v[2] = 0.5 * cos(6.2832 * position[1]);
}

static void thread(const double position[3], double v[3])
{
  v[0] = 1;
  v[1] = 0.002 * sin(6.2832 * position[0]);
  v[2] = 0;
}

static void membrane(const double position[3], double v[3])
{
  v[0] = 0.1 * sin(6.2832 * position[1]);
  v[1] = 0;
  v[2] = 1;
}

static void any_number_fits_into_a_thin_volume(void **state)
{
  static const struct {
    sampling box;
    velocity_of velocity;
  } cases[] = {{{.dimension = 3, .nodes = {41, 41, 3}, .high = {1, 1, 0.01}}, film},
               {{.dimension = 3, .nodes = {3, 51, 51}, .high = {0.0005, 1, 1}}, sheet},
               {{.dimension = 3, .nodes = {31, 3, 3}, .high = {1, 0.02, 0.01}}, thread},
               {{.dimension = 3, .nodes = {21, 21, 5}, .high = {1, 1, 0.05}}, membrane}};
  static const int counts[] = {1, 2, 12, 25, 39, 40, 41, 60, 140};
  for (size_t b = 0; b < sizeof cases / sizeof *cases; ++b) {
    fg_field *field = field_of(*state, &cases[b].box, cases[b].velocity);
    for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
      fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
      fg_icons *icons = place(*state, placement, counts[n]);
      assert_int_equal(fg_icons_count(icons), counts[n]);
      fg_icons_destroy(icons);
      fg_placement_destroy(placement);
    }
    fg_field_destroy(field);
  }
}

/* The fair length of a film is that of the plane, and of a thread that of the line. */
static void thin_volumes_have_the_length_of_their_plane(void **state)
{
  static const struct {
    sampling box;
    double lambda;
  } cases[] = {{{.dimension = 3, .nodes = {41, 41, 3}, .high = {1, 1, 0.01}}, 0.2},
               {{.dimension = 3, .nodes = {41, 5, 5}, .high = {1, 0.01, 0.02}}, 0.04},
               {{.dimension = 3, .nodes = {21, 21, 21}, .high = {1, 1, 1}}, 0.342}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, &cases[n].box, film);
    fg__place_domain domain;
    assert_int_equal(fg__place_domain_create(&domain, *state, field), FG_STATUS_OK);
    const fg__place_scale scale = fg__place_scale_of(&domain, 25, true, FG__PLACE_FINE);
    assert_close(scale.lambda, cases[n].lambda, 0.12 * cases[n].lambda);
    fg__place_domain_clear(&domain);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(singular_fields_have_arrows_all_over),
      CASE(still_surroundings_are_left_blank),
      CASE(speeds_are_of_what_moves),
      CASE(any_number_fits_into_a_thin_volume),
      CASE(thin_volumes_have_the_length_of_their_plane),
  };
  return cmocka_run_group_tests_name("place/room", tests, NULL, NULL);
}
