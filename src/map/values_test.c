/* What a map without values says: where, and of how many points. */
#include "base/context_test.h"

#include <math.h>
#include <string.h>

#include "flowgrain/map.h"

enum { WIDE = 41, HIGH = 21 };

/* From 0 to 40 E and 0 to 20 N, a degree apart: nothing from 10 to 20 E, still beyond. */
static fg_field *make(fg_context *context)
{
  static double x[WIDE], y[HIGH];
  static float u[HIGH][WIDE], v[HIGH][WIDE];
  for (int j = 0; j < HIGH; ++j)
    for (int i = 0; i < WIDE; ++i) {
      x[i] = i;
      y[j] = j;
      u[j][i] = i < 10 ? 1.0f : i <= 20 ? NAN : 0.0f;
    }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {WIDE, HIGH},
                                  .scale = FG_SCALE_GEO,
                                  .axis = {x, y},
                                  .velocity = {u[0], v[0]}};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static void empty_maps_say_what_they_lack(void **state)
{
  static const struct {
    double region[4];
    const char *words; /* NULL: there is something */
  } cases[] = {
      {{0, 30, 0, 20}, NULL},
      {{12, 17, 5, 15},
       "velocity is missing everywhere from longitude 12 to 17 and latitude 5 to 15"},
      {{-30, -20, 0, 20}, "has no values; there are some from "},
      {{25, 35, 5, 15},
       "zero everywhere from longitude 25 to 35 and latitude 5 to 15 (630 "},
  };
  fg_field *field = make(*state), *out;
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    fg_map_options options = {.has_region = true};
    memcpy(options.region, cases[k].region, sizeof cases[k].region);
    const fg_status status = fg_field_project(&out, *state, field, &options);
    assert_int_equal(status, cases[k].words ? FG_STATUS_ARGUMENT : FG_STATUS_OK);
    if (cases[k].words && !strstr(fg_context_message(*state), cases[k].words))
      fail_msg("%s", fg_context_message(*state));
    fg_field_destroy(out);
    fg_context_clear(*state);
  }
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(empty_maps_say_what_they_lack)};
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
