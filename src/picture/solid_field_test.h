/* Fields in 3D for tests of pictures: boxes of 2 x 1 x 1.5, off the origin. */
#ifndef FG__SOLID_FIELD_TEST_H
#define FG__SOLID_FIELD_TEST_H

#include "base/context_test.h"

enum { FIELD_SIZE = 41, FIELD_SAMPLES = FIELD_SIZE * FIELD_SIZE * FIELD_SIZE };

static const double field_low[3] = {3.0, -1.0, 10.0}, field_side[3] = {2.0, 1.0, 1.5};

/* Velocity at a place; false: missing. */
typedef bool field_rule(const double place[3], double velocity[3]);

static inline fg_field *field_of(field_rule *rule)
{
  static float velocity[3][FIELD_SAMPLES];
  static unsigned char valid[FIELD_SAMPLES];
  static double axis[3][FIELD_SIZE];
  bool all = true;
  for (int k = 0; k < 3; ++k)
    for (int n = 0; n < FIELD_SIZE; ++n)
      axis[k][n] = field_low[k] + field_side[k] * n / (FIELD_SIZE - 1);
  for (int n = 0; n < FIELD_SAMPLES; ++n) {
    const double place[3] = {axis[0][n % FIELD_SIZE],
                             axis[1][n / FIELD_SIZE % FIELD_SIZE],
                             axis[2][n / (FIELD_SIZE * FIELD_SIZE)]};
    double v[3] = {0.0, 0.0, 0.0};
    valid[n] = rule(place, v);
    all = all && valid[n];
    for (int k = 0; k < 3; ++k)
      velocity[k][n] = (float)v[k];
  }
  const fg_field_arrays arrays = {.dimension = 3,
                                  .size = {FIELD_SIZE, FIELD_SIZE, FIELD_SIZE},
                                  .axis = {axis[0], axis[1], axis[2]},
                                  .velocity = {velocity[0], velocity[1], velocity[2]},
                                  .valid = all ? NULL : valid};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  return field;
}

#endif
