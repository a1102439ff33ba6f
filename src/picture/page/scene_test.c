/* What of a field's box a framed picture shows. */
#include <math.h>

#include "base/context_test.h"
#include "icon/icons.h"
#include "picture/page/scene.h"

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

/* Samples spaced 1 from (LEFT, LOW) on, valid in a disc that is small in their box. */
enum { WIDE = 700, HIGH = 420, LEFT = 30, LOW = -8 };
static const double DISC[3] = {371.2, 95.7, 12.0}; /* centre and radius */

static double from_rim(double x, double y)
{
  return hypot(x - DISC[0], y - DISC[1]) - DISC[2];
}

static fg_field *disc_of(fg_context *context)
{
  static double axis[2][WIDE];
  static float velocity[WIDE * HIGH];
  static unsigned char valid[WIDE * HIGH];
  for (int n = 0; n < WIDE; n++) {
    axis[0][n] = LEFT + n;
    axis[1][n] = LOW + n;
  }
  for (int n = 0; n < WIDE * HIGH; n++) {
    velocity[n] = 2;
    valid[n] = from_rim(axis[0][n % WIDE], axis[1][n / WIDE]) < 0;
  }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {WIDE, HIGH, 1},
                            .axis = {axis[0], axis[1]},
                            .velocity = {velocity, velocity},
                            .valid = valid};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* Whether a point of the page lies in an odd number of loops. */
static bool is_masked(const fg__polygons *mask, double x, double y)
{
  bool odd = false;
  for (size_t loop = 0; loop < mask->count; loop++) {
    size_t first = mask->start[loop], beyond = mask->start[loop + 1];
    for (size_t n = first; n < beyond; n++) {
      const double *a = mask->point[n], *b = mask->point[n + 1 < beyond ? n + 1 : first];
      if ((a[1] > y) != (b[1] > y) &&
          x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
        odd = !odd;
    }
  }
  return odd;
}

/* However small a part of the box the frame shows, its mask has the data's own cells. */
static void the_mask_of_a_small_part_is_fine(void **state)
{
  (void)state;
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = disc_of(context);
  fg__polygons mask = {0};
  double low[2], high[2];
  fg__scene_shown(low, high, field);
  assert_true(high[0] - low[0] < 2.5 * DISC[2]);
  fg__page page = {.scale = 2.0};
  page.frame.x1 = page.scale * (high[0] - low[0]);
  page.frame.y1 = page.scale * (high[1] - low[1]);
  assert_int_equal(fg__scene_mask(&mask, context, &page, field, low, NULL), FG_STATUS_OK);
  for (double y = low[1]; y < high[1]; y += 0.37)
    for (double x = low[0]; x < high[0]; x += 0.37)
      if (fabs(from_rim(x, y) + 0.7) > 1.5)
        assert_int_equal(is_masked(&mask, page.scale * (x - low[0]),
                                   page.frame.y1 - page.scale * (y - low[1])),
                         from_rim(x, y) > 0);
  fg__polygons_clear(&mask);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

/* The disc is a map's: what is beyond its outline is not missing on it. */
static void cells_at_an_outline_are_not_masked(void **state)
{
  (void)state;
  enum { CORNERS = 180, EVERY = 90 };
  double corner[CORNERS][2];
  size_t start[] = {0, CORNERS};
  const fg__polygons outline = {
      .point = corner, .point_count = CORNERS, .start = start, .count = 1};
  for (int n = 0; n < CORNERS; n++) {
    const double angle = n * acos(-1.0) / EVERY;
    corner[n][0] = DISC[0] + DISC[2] * cos(angle);
    corner[n][1] = DISC[1] + DISC[2] * sin(angle);
  }
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = disc_of(context);
  double low[2], high[2];
  fg__scene_shown(low, high, field);
  fg__page page = {.scale = 2.0};
  page.frame.y1 = page.scale * (high[1] - low[1]);
  for (int mapped = 0; mapped < 2; mapped++) {
    fg__polygons mask = {0};
    int masked = 0;
    assert_int_equal(
        fg__scene_mask(&mask, context, &page, field, low, mapped ? &outline : NULL),
        FG_STATUS_OK);
    for (double y = low[1]; y < high[1]; y += 0.37)
      for (double x = low[0]; x < high[0]; x += 0.37)
        masked +=
            from_rim(x, y) < -0.3 && is_masked(&mask, page.scale * (x - low[0]),
                                               page.frame.y1 - page.scale * (y - low[1]));
    assert_int_equal(masked > 0, !mapped);
    fg__polygons_clear(&mask);
  }
  fg_field_destroy(field);
  fg_context_destroy(context);
}

/* The texture of a domain hundreds of times as large as the frame stays affordable. */
static void a_background_of_a_small_part_is_coarser(void **state)
{
  (void)state;
  fg_context *context;
  fg_icons *icons;
  int framed[2], whole[2];
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = disc_of(context);
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  fg_picture_options options = {.width = 300.0, .no_frame = true};
  assert_int_equal(fg_picture_frame(whole, context, field, icons, &options),
                   FG_STATUS_OK);
  assert_int_equal(whole[0], 600);
  options.no_frame = false;
  assert_int_equal(fg_picture_frame(framed, context, field, icons, &options),
                   FG_STATUS_OK);
  double shape = (double)(WIDE - 1) / (HIGH - 1);
  assert_true(fabs((double)framed[0] / framed[1] - shape) < 0.01);
  assert_true(framed[0] > 600 && (double)framed[0] * framed[1] < 16.0 * 600 * 600);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_small_part_is_shown_with_a_margin),
      cmocka_unit_test(nearly_all_is_shown_as_all),
      cmocka_unit_test(a_side_with_a_period_stays_whole),
      cmocka_unit_test(the_mask_of_a_small_part_is_fine),
      cmocka_unit_test(cells_at_an_outline_are_not_masked),
      cmocka_unit_test(a_background_of_a_small_part_is_coarser),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
