#include "field/still.h"

#include "base/context_test.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 96, CELLS = SIDE * SIDE };

/* Speeds on a square of side 2, of the distance from a point near its middle. */
static double top_of(double (*law)(double distance))
{
  float *speed = malloc(CELLS * sizeof *speed);
  for (int n = 0; n < CELLS; ++n) {
    const double x = 2.0 * (n % SIDE + 0.5) / SIDE - 1.013;
    const double y = 2.0 * (n / SIDE) / SIDE - 0.97;
    speed[n] = (float)law(hypot(x, y));
  }
  const double top = fg__top_speed(speed, CELLS);
  free(speed);
  return top;
}

static double line_vortex(double r)
{
  return 1.0 / r;
}

static double dipole(double r)
{
  return pow(r, -3.0);
}

static double quadrupole(double r)
{
  return pow(r, -4.0);
}

/* Walls at 0.6, and nothing beyond. */
static double wire_in_a_cup(double r)
{
  return r < 0.6 ? pow(r, -3.0) : 0.0;
}

static double jet(double r)
{
  return exp(-r * r / 0.02);
}

static double pipe(double r)
{
  return fmax(0.0, 1.0 - r * r / 0.01);
}

static double vessel_in_noise(double r)
{
  return r < 0.1 ? 1.0 : 0.02 + 0.01 * sin(1e5 * r);
}

/* Half of a square of side 2 lies within 0.8 of its middle: of singular fields the
 * typical speed is that there, and the top 30 times as much. */
static void the_top_is_that_of_the_flow_and_not_of_a_singularity(void **state)
{
  static const struct {
    double (*law)(double distance);
    double least, most;
  } cases[] = {
      {line_vortex, 33, 43},       {dipole, 39, 87}, {quadrupole, 37, 125},
      {wire_in_a_cup, 160, 700},   {jet, 0.98, 1.0}, {pipe, 0.95, 1.0},
      {vessel_in_noise, 1.0, 1.0},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const double top = top_of(cases[n].law);
    if (!(top >= cases[n].least && top <= cases[n].most))
      fail_msg("case %zu: %g, not from %g to %g", n, top, cases[n].least, cases[n].most);
  }
}

static void what_is_no_speed_does_not_count(void **state)
{
  static const float speed[] = {-1, 0, 3, 4, -1, 0}, still[] = {0, -1};
  (void)state;
  const double usual = fg__usual_speed(speed, 6, 4.0);
  assert_true(fabs(fg__top_speed(speed, 6) - 4.0) < 1e-12);
  assert_true(fabs(usual - 2.5) < 1e-12);
  assert_true(fabs(fg__usual_speed(speed, 6, 3.0) - sqrt(4.5)) < 1e-12);
  assert_true(fabs(fg__slow_share(speed, 6, usual) - 0.5) < 1e-12);
  assert_true(fg__top_speed(still, 2) <= 0.0 && !fg__moves(0.0, 0.0));
  assert_true(fg__usual_speed(still + 1, 1, 0.0) <= 0.0);
  assert_true(fg__moves(0.0041, 4.0) && !fg__moves(0.0039, 4.0));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_top_is_that_of_the_flow_and_not_of_a_singularity),
      cmocka_unit_test(what_is_no_speed_does_not_count),
  };
  return cmocka_run_group_tests_name("field/still", tests, NULL, NULL);
}
