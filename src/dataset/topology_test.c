/* Lists of cells: what is kept of them, and what is refused. */
#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "dataset/dataset.h"

static const fg__decoder NO_DECODER = {.fetch = NULL};

static void begin(fg__dataset *data, fg_context *context)
{
  fg_context_clear(context);
  assert_int_equal(fg__dataset_begin(data, context, "cells", 0, &NO_DECODER),
                   FG_STATUS_OK);
}

static void points_count_from_their_piece(void **state)
{
  fg__dataset data = {0};
  const double triangle[] = {2, 0, 1}, quad[] = {3, 4, 5, 0};
  begin(&data, *state);
  assert_int_equal(
      fg__topology_add(&data, 5, triangle, 3, NULL, 0, &(fg__piece_points){0, 3}),
      FG_STATUS_OK);
  assert_int_equal(
      fg__topology_add(&data, 9, quad, 4, NULL, 0, &(fg__piece_points){3, 6}),
      FG_STATUS_OK);
  const fg__topology *t = &data.space.cells;
  assert_int_equal(t->cells, 2);
  assert_int_equal(t->type[1], 9);
  assert_int_equal(t->first[1], 3);
  assert_memory_equal(t->corner, ((int[]){2, 0, 1, 6, 7, 8, 3}), 7 * sizeof(int));
  fg__dataset_close(&data);
}

static void corners_that_are_no_points_are_refused(void **state)
{
  static const double wrong[] = {-1.0, 5.0, 1e20, (double)NAN};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    fg__dataset data = {0};
    const double good[] = {0, 1, 4}, corner[] = {0, 1, wrong[i]};
    const fg__piece_points all = {7, 5};
    begin(&data, *state);
    assert_int_equal(fg__topology_add(&data, 5, good, 3, NULL, 0, &all), FG_STATUS_OK);
    assert_int_equal(fg__topology_add(&data, 5, corner, 3, NULL, 0, &all),
                     FG_STATUS_FILE_FORMAT);
    assert_non_null(strstr(fg_context_message(*state), "corner 2 of cell 1"));
    fg__dataset_close(&data);
  }
}

/* A tetrahedron as a polyhedron, cut off anywhere, or with a face that is none. */
static void faces_are_checked(void **state)
{
  enum { NUMBERS = 17 };
  static const double node[] = {1, 2, 3, 4};
  static const int kept[] = {4, 1, 2, 3, 4, 4, 3, 1, 2, 3, 3,
                             1, 2, 4, 3, 2, 3, 4, 3, 3, 1, 4};
  double face[NUMBERS];
  const fg__piece_points all = {0, 5};
  for (size_t numbers = 0; numbers <= NUMBERS; ++numbers) {
    fg__dataset data = {0};
    for (int i = 0; i < NUMBERS; ++i)
      face[i] = kept[5 + i];
    begin(&data, *state);
    const fg_status status =
        fg__topology_add(&data, FG__POLYHEDRON, node, 4, face, numbers, &all);
    if (numbers == 0 || numbers == NUMBERS) {
      assert_int_equal(status, FG_STATUS_OK);
      assert_memory_equal(data.space.cells.corner, kept,
                          data.space.cells.corners * sizeof *kept);
    } else {
      assert_int_equal(status, FG_STATUS_FILE_FORMAT);
      assert_non_null(strstr(fg_context_message(*state), "the faces of cell 0"));
    }
    fg__dataset_close(&data);
  }
  for (int i = 0; i < NUMBERS; ++i) {
    fg__dataset data = {0};
    const double was = face[i];
    face[i] = i % 2 ? (double)NAN : 9.0;
    begin(&data, *state);
    const fg_status status =
        fg__topology_add(&data, FG__POLYHEDRON, node, 4, face, NUMBERS, &all);
    /* no number of faces is none of them */
    assert_true(status == FG_STATUS_FILE_FORMAT || (i == 0 && isnan(face[0])));
    face[i] = was;
    fg__dataset_close(&data);
  }
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, context_set_up, context_tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(points_count_from_their_piece),
      CASE(corners_that_are_no_points_are_refused),
      CASE(faces_are_checked),
  };
  return cmocka_run_group_tests_name("dataset/topology", tests, NULL, NULL);
}
