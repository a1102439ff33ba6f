#include "icon/shapes_test.h"

#include "flowgrain/flowgrain.h"

#include <string.h>

enum { MOST_POINTS = 200 };

typedef struct test_drawing {
  double point[MOST_POINTS][3];
  fg_icon icon;
  double (*vertex)[2];
  int count;
} test_drawing;

static void set_numbers(test_drawing *drawing, int count, double width)
{
  drawing->icon = (fg_icon){.point_count = count,
                            .points = (const double(*)[3])drawing->point,
                            .width = width,
                            .tail_width = 0.4 * width,
                            .head_length = 3.1 * width,
                            .head_width = 2.7 * width};
}

static void outline(test_drawing *drawing)
{
  assert_int_equal(fg_icon_outline(&drawing->icon, &drawing->vertex, &drawing->count),
                   FG_STATUS_OK);
}

static double area_of(const test_drawing *drawing)
{
  double area = 0;
  for (int i = 0; i < drawing->count; i++) {
    const double *a = drawing->vertex[i], *b = drawing->vertex[(i + 1) % drawing->count];
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return area;
}

static bool contains(const test_drawing *drawing, double x, double y)
{
  bool inside = false;
  for (int i = 0; i < drawing->count; i++) {
    const double *a = drawing->vertex[i], *b = drawing->vertex[(i + 1) % drawing->count];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
  }
  return inside;
}

/* An arc of a circle about (3, -7), from an angle on, anticlockwise. */
static void set_arc(test_drawing *drawing, double radius, double from, double turning,
                    int count, double width)
{
  for (int i = 0; i < count; i++) {
    double angle = from + turning * i / (count - 1);
    drawing->point[i][0] = 3 + radius * cos(angle);
    drawing->point[i][1] = -7 + radius * sin(angle);
  }
  set_numbers(drawing, count, width);
}

static void has_the_sizes_it_says(void **state)
{
  (void)state;
  test_drawing drawing = {0};
  /* along (0.8, 0.6), 20 long */
  for (int i = 0; i < 5; i++) {
    drawing.point[i][0] = 2 + 0.8 * 5 * i;
    drawing.point[i][1] = 1 + 0.6 * 5 * i;
  }
  set_numbers(&drawing, 5, 1.5);
  outline(&drawing);
  assert_true(is_simple((const double(*)[2])drawing.vertex, drawing.count));
  double along_max = -1, along_min = 1e9, across_max = 0, head_across = 0;
  for (int i = 0; i < drawing.count; i++) {
    double dx = drawing.vertex[i][0] - 2, dy = drawing.vertex[i][1] - 1;
    double along = 0.8 * dx + 0.6 * dy, across = fabs(-0.6 * dx + 0.8 * dy);
    along_max = fmax(along_max, along);
    along_min = fmin(along_min, along);
    head_across = fmax(head_across, across);
    if (along < 20 - 3.1 * 1.5 * 1.3)
      across_max = fmax(across_max, across);
  }
  assert_true(fabs(along_max - 20) < 1e-12 && fabs(along_min) < 1e-12);
  assert_true(fabs(head_across - 2.7 * 1.5 / 2) < 1e-12);
  assert_true(across_max < 1.5 / 2);
  /* just inside and just outside the body where the head begins */
  double notch = 20 - 3.1 * 1.5 - 0.7;
  double half = 1.5 / 2 * (0.4 + 0.6 * notch / (20 - 3.1 * 1.5));
  for (int side = -1; side <= 1; side += 2) {
    double in = side * 0.98 * half, out = side * 1.02 * half;
    assert_true(
        contains(&drawing, 2 + 0.8 * notch - 0.6 * in, 1 + 0.6 * notch + 0.8 * in));
    assert_false(
        contains(&drawing, 2 + 0.8 * notch - 0.6 * out, 1 + 0.6 * notch + 0.8 * out));
  }
  free(drawing.vertex);
}

static void bends_with_the_line(void **state)
{
  (void)state;
  static const struct {
    double radius, turning, width;
  } cases[] = {
      {30, 0.4, 1.1}, {9, 2.2, 1.1}, {4, 5.2, 0.9}, {4, -5.2, 0.9}, {2.5, 3, 1.4}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    test_drawing drawing = {0};
    set_arc(&drawing, cases[k].radius, 0.3, cases[k].turning, 120, cases[k].width);
    outline(&drawing);
    assert_true(is_simple((const double(*)[2])drawing.vertex, drawing.count));
    /* every vertex is at most half the head's width from the circle, the barbs of a
     * straight head a little more */
    for (int i = 0; i < drawing.count; i++) {
      double away = hypot(drawing.vertex[i][0] - 3, drawing.vertex[i][1] + 7);
      assert_true(fabs(away - cases[k].radius) < 2.7 * cases[k].width / 2 * 1.2);
    }
    const double body =
        1 - 3.1 * cases[k].width / fabs(cases[k].radius * cases[k].turning);
    for (int i = 2; i < 119 * body; i++)
      assert_true(contains(&drawing, drawing.point[i][0], drawing.point[i][1]));
    free(drawing.vertex);
  }
}

static void heads_are_straight_in_bends(void **state)
{
  (void)state;
  /* radii of the line in lengths of a head, 3.1 widths: bends of 29 to 90 degrees */
  for (double radius = 2.0; radius > 0.63; radius -= 0.03) {
    test_drawing drawing = {0};
    set_arc(&drawing, radius * 3.1, 0.3, 3.2 / radius, 160, 1.0);
    outline(&drawing);
    assert_true(is_simple((const double(*)[2])drawing.vertex, drawing.count));
    int tip = 0;
    for (int i = 1; i < drawing.count; i++)
      if (hypot(drawing.vertex[i][0] - drawing.point[159][0],
                drawing.vertex[i][1] - drawing.point[159][1]) < 1e-12)
        tip = i;
    const double *a = drawing.vertex[tip - 1], *b = drawing.vertex[tip + 1];
    assert_true(fabs(hypot(a[0] - b[0], a[1] - b[1]) - 2.7) < 1e-9);
    free(drawing.vertex);
  }
}

static void turns_and_mirrors_with_its_points(void **state)
{
  (void)state;
  test_drawing plain = {0}, turned = {0};
  set_arc(&plain, 6, 0.3, 1.9, 40, 0.8);
  set_numbers(&turned, 40, 0.8);
  for (int i = 0; i < 40; i++) { /* (x, y) to (y, x): a mirror image */
    turned.point[i][0] = plain.point[i][1];
    turned.point[i][1] = plain.point[i][0];
  }
  outline(&plain);
  outline(&turned);
  assert_int_equal(plain.count, turned.count);
  assert_true(fabs(fabs(area_of(&plain)) - fabs(area_of(&turned))) < 1e-12);
  assert_true(area_of(&plain) * area_of(&turned) > 0); /* left side first, always */
  for (int i = 0; i < plain.count; i++) {
    const double *a = plain.vertex[i];
    const double *b = turned.vertex[(plain.count - i) % plain.count];
    assert_true(hypot(a[0] - b[1], a[1] - b[0]) < 1e-12);
  }
  free(plain.vertex);
  free(turned.vertex);
}

/* Icons of other programs: corners, two points, heads longer than the line. */
static void stays_simple_on_foreign_icons(void **state)
{
  (void)state;
  test_drawing drawing = {.point = {{0, 0, 0}, {10, 0, 0}, {12, 7, 0}, {20, 6, 0}}};
  set_numbers(&drawing, 4, 1.2);
  outline(&drawing);
  assert_true(is_simple((const double(*)[2])drawing.vertex, drawing.count));
  free(drawing.vertex);

  drawing.point[1][0] = 2.5;
  drawing.point[1][1] = 1;
  set_numbers(&drawing, 2, 1.2); /* its head is 3.7 long, the line 2.7 */
  outline(&drawing);
  assert_true(is_simple((const double(*)[2])drawing.vertex, drawing.count));
  assert_true(fabs(area_of(&drawing)) > 0.5);
  free(drawing.vertex);
}

/* The sharpest turn of the outline's left side, all but the tail and the head. */
static double sharpest_turn(const test_drawing *drawing)
{
  double most = 0;
  for (int i = 1; i + 1 < drawing->count; i++) {
    const double *a = drawing->vertex[i - 1], *b = drawing->vertex[i],
                 *c = drawing->vertex[i + 1];
    if (a[0] < 0.5 || c[0] > 2.0)
      continue;
    double turn = atan2((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]),
                        (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]));
    most = fmax(most, fabs(turn));
  }
  return most;
}

static void placed_ones_have_no_kinks(void **state)
{
  (void)state;
  test_drawing drawing;
  for (int i = 0; i < 101; i++) {
    double x = 0.03 * i;
    drawing.point[i][0] = x;
    drawing.point[i][1] = x < 1.2 ? 0.1 * x : 0.12 + 1.5 * (x - 1.2);
    drawing.point[i][2] = 0;
  }
  set_numbers(&drawing, 101, 0.06);
  outline(&drawing); /* a cluster's */
  assert_true(sharpest_turn(&drawing) > 0.2);
  free(drawing.vertex);
  drawing.icon.id = 7;
  outline(&drawing);
  assert_true(sharpest_turn(&drawing) < 0.15);
  free(drawing.vertex);
}

static void refuses_what_is_no_arrow(void **state)
{
  (void)state;
  test_drawing drawing = {.point = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}};
  set_numbers(&drawing, 3, 0.1); /* a point twice */
  assert_int_equal(fg_icon_outline(&drawing.icon, &drawing.vertex, &drawing.count),
                   FG_STATUS_ARGUMENT);
  set_numbers(&drawing, 1, 0.1);
  assert_int_equal(fg_icon_outline(&drawing.icon, &drawing.vertex, &drawing.count),
                   FG_STATUS_ARGUMENT);
  set_numbers(&drawing, 2, 0.1);
  drawing.icon.head_width = -1;
  assert_int_equal(fg_icon_outline(&drawing.icon, &drawing.vertex, &drawing.count),
                   FG_STATUS_ARGUMENT);
  set_numbers(&drawing, 2, 0.1);
  drawing.point[1][1] = (double)NAN;
  assert_int_equal(fg_icon_outline(&drawing.icon, &drawing.vertex, &drawing.count),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(fg_icon_outline(NULL, &drawing.vertex, &drawing.count),
                   FG_STATUS_ARGUMENT);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(has_the_sizes_it_says),
      cmocka_unit_test(bends_with_the_line),
      cmocka_unit_test(heads_are_straight_in_bends),
      cmocka_unit_test(turns_and_mirrors_with_its_points),
      cmocka_unit_test(stays_simple_on_foreign_icons),
      cmocka_unit_test(placed_ones_have_no_kinks),
      cmocka_unit_test(refuses_what_is_no_arrow),
  };
  return cmocka_run_group_tests_name("icon/outline", tests, NULL, NULL);
}
