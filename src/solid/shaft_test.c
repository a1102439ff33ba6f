/* Where on a streamline an arrow ends. */
#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "solid/shaft.h"

enum { STRAIGHT = 160, HOOK = 24, SIDE = 4, SAMPLES = SIDE * SIDE * SIDE };
static const double step = 0.01;

/* Along x for 1.6, then up on an arc of 0.24 that turns by `hook` radians in all. */
static void make_path(fg__path_node node[STRAIGHT + HOOK + 1], double hook)
{
  double turned = 0.0, position[3] = {0.2, 0.5, 0.4};
  for (int n = 0; n <= STRAIGHT + HOOK; ++n) {
    node[n] = (fg__path_node){.s = step * n,
                              .position = {position[0], position[1], position[2]},
                              .tangent = {cos(turned), 0.0, sin(turned)},
                              .turning = turned};
    double turn = n < STRAIGHT ? 0.0 : hook / HOOK;
    position[0] += step * cos(turned + turn / 2.0);
    position[2] += step * sin(turned + turn / 2.0);
    turned += turn;
  }
}

/* In a cluster whose border is nowhere near. */
static fg__shaft fit(fg__path_node node[], double free)
{
  double distance[SAMPLES];
  for (int n = 0; n < SAMPLES; ++n)
    distance[n] = free;
  const fg__volume volume = {.nodes = {SIDE, SIDE, SIDE}, .spacing = {1.0, 1.0, 1.0}};
  const fg__solid_room room = {&volume, distance, 0.03};
  const fg__path path = {.node = node, .count = STRAIGHT + HOOK + 1};
  fg__shaft_stations stations = {0};
  fg__shaft shaft;
  assert_int_equal(fg__shaft_fit(&shaft, NULL, &path, &room, &stations), FG_STATUS_OK);
  fg__shaft_stations_clear(&stations);
  assert_true(shaft.width > 0.0);
  return shaft;
}

static void a_straight_line_is_taken_whole(void **state)
{
  (void)state;
  fg__path_node node[STRAIGHT + HOOK + 1];
  make_path(node, 0.0);
  fg__shaft shaft = fit(node, 0.2);
  assert_true(shaft.tail < 0.02 && shaft.tip > 1.82);
}

static void a_head_is_nearly_straight(void **state)
{
  (void)state;
  fg__path_node node[STRAIGHT + HOOK + 1];
  for (double hook = 0.8; hook < 4.0; hook += 0.4) {
    make_path(node, hook);
    const fg__path path = {.node = node, .count = STRAIGHT + HOOK + 1};
    fg__shaft shaft = fit(node, 0.2);
    double position[3], tangent[3];
    double base = shaft.tip - FG__SOLID_HEAD_LENGTH * shaft.width;
    double turning = fg__path_at(&path, shaft.tip, NULL, position, tangent) -
                     fg__path_at(&path, base, NULL, position, tangent);
    assert_true(turning < 0.61);
    /* nothing is given away for it but the hook */
    assert_true(shaft.tip > 1.5);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_line_is_taken_whole),
      cmocka_unit_test(a_head_is_nearly_straight),
  };
  return cmocka_run_group_tests_name("solid/shaft", tests, NULL, NULL);
}
