/* Where on a streamline an arrow ends. */
#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "icon/arrow.h"

enum { STRAIGHT = 160, HOOK = 24, SIDE = 4, SAMPLES = SIDE * SIDE * SIDE };
static const double step = 0.01;

/* Along x for 1.6, then up on an arc of 0.24 that turns by `hook` radians in all. */
static void make_line(fg__streamline_node node[STRAIGHT + HOOK + 1], double hook)
{
  double turned = 0.0, position[3] = {0.2, 0.5, 0.4};
  for (int n = 0; n <= STRAIGHT + HOOK; ++n) {
    node[n] = (fg__streamline_node){.s = step * n,
                                    .position = {position[0], position[1], position[2]},
                                    .tangent = {cos(turned), 0.0, sin(turned)},
                                    .turning = turned};
    double turn = n < STRAIGHT ? 0.0 : hook / HOOK;
    position[0] += step * cos(turned + turn / 2.0);
    position[2] += step * sin(turned + turn / 2.0);
    turned += turn;
  }
}

/* In a cluster whose boundary is nowhere near. */
static fg__arrow fit(fg__streamline_node node[], double free)
{
  double distance[SAMPLES];
  for (int n = 0; n < SAMPLES; ++n)
    distance[n] = free;
  const fg__window window = {
      .dimension = 3, .nodes = {SIDE, SIDE, SIDE}, .spacing = {1.0, 1.0, 1.0}};
  const fg__interior interior = {&window, distance, 0.03, 0.0, NULL};
  const fg__streamline line = {
      .dimension = 3, .node = node, .count = STRAIGHT + HOOK + 1};
  fg__arc_samples samples = {0};
  fg__arrow arrow;
  assert_int_equal(fg__arrow_fit(&arrow, NULL, &line, &interior, &samples), FG_STATUS_OK);
  fg__arc_samples_clear(&samples);
  assert_true(arrow.width > 0.0);
  return arrow;
}

static void a_straight_line_is_taken_whole(void **state)
{
  (void)state;
  fg__streamline_node node[STRAIGHT + HOOK + 1];
  make_line(node, 0.0);
  fg__arrow arrow = fit(node, 0.2);
  assert_true(arrow.tail < 0.02 && arrow.tip > 1.82);
}

static void a_head_is_nearly_straight(void **state)
{
  (void)state;
  fg__streamline_node node[STRAIGHT + HOOK + 1];
  for (double hook = 0.8; hook < 4.0; hook += 0.4) {
    make_line(node, hook);
    const fg__streamline line = {
        .dimension = 3, .node = node, .count = STRAIGHT + HOOK + 1};
    fg__arrow arrow = fit(node, 0.2);
    double position[3], tangent[3];
    double base = arrow.tip - FG__SOLID_HEAD_LENGTH * arrow.width;
    double turning = fg__streamline_at(&line, arrow.tip, NULL, position, tangent) -
                     fg__streamline_at(&line, base, NULL, position, tangent);
    assert_true(turning < 0.61);
    /* nothing is given away for it but the hook */
    assert_true(arrow.tip > 1.5);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_line_is_taken_whole),
      cmocka_unit_test(a_head_is_nearly_straight),
  };
  return cmocka_run_group_tests_name("icon/arrow_solid", tests, NULL, NULL);
}
