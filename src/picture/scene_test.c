/* What of a field's box a framed picture shows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "picture/scene.h"

enum { N = 21, M = 11 };

/* Samples on [-3, 37] x [50, 70], spaced 2, valid where first <= index <= last along each
 * axis; the shown box. */
static void show(double low[2], double high[2], const int first[2], const int last[2],
                 double period)
{
  double axis[2][N];
  float velocity[2][N * M];
  unsigned char valid[N * M];
  for (int i = 0; i < N; i++)
    axis[0][i] = -3 + 2 * i;
  for (int j = 0; j < M; j++)
    axis[1][j] = 50 + 2 * j;
  for (int j = 0; j < M; j++)
    for (int i = 0; i < N; i++) {
      velocity[0][j * N + i] = 3;
      velocity[1][j * N + i] = -0.5F;
      valid[j * N + i] = i >= first[0] && i <= last[0] && j >= first[1] && j <= last[1];
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {N, M, 1},
                            .axis = {axis[0], axis[1]},
                            .period = {period, 0, 0},
                            .velocity = {velocity[0], velocity[1]},
                            .valid = valid};
  fg_context *context;
  fg_field *field;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  fg__scene_shown(low, high, field);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void a_small_part_is_shown_with_a_margin(void **state)
{
  (void)state;
  double low[2], high[2];
  show(low, high, (int[]){4, 3}, (int[]){9, 10}, 0);
  assert_true(low[0] < 5 && low[0] > 3 && high[0] > 15 && high[0] < 17);
  assert_true(low[1] < 56 && low[1] > 54);
  assert_true(high[1] == 70); /* not beyond the domain */
  assert_true(fabs((5 - low[0]) - (56 - low[1])) < 1e-9);
}

static void nearly_all_is_shown_as_all(void **state)
{
  (void)state;
  double low[2], high[2];
  show(low, high, (int[]){1, 1}, (int[]){19, 10}, 0);
  assert_true(low[0] == -3 && high[0] == 37 && low[1] == 50 && high[1] == 70);
}

static void a_side_with_a_period_stays_whole(void **state)
{
  (void)state;
  double low[2], high[2];
  show(low, high, (int[]){4, 6}, (int[]){9, 8}, 42);
  assert_true(low[0] == -3 && high[0] == 39);
  assert_true(low[1] > 58 && low[1] < 62 && high[1] > 66 && high[1] < 70);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_small_part_is_shown_with_a_margin),
      cmocka_unit_test(nearly_all_is_shown_as_all),
      cmocka_unit_test(a_side_with_a_period_stays_whole),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
