#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "grid/mesh.h"

/* Exact but for the rounding of a few products. */
static const double ROUNDING = 1e-12;

static const double SIDES[][2] = {{1.0, 1.0},     {360.0, 180.0}, {1.0, 0.31},
                                  {0.07, 1.9},    {3.7, 2.9},     {1e-3, 4e-3},
                                  {2.5e6, 1.1e6}, {1.0, 0.13},    {17.0, 100.0}};
static const int NODES[] = {9, 10, 17, 33, 65, 100, 129, 257, 300, 1000};

/* In 3D: the longest side first, second, last; slabs, rods and cubes. */
static const double BRICKS[][3] = {
    {1.0, 1.0, 1.0}, {360.0, 180.0, 70.0}, {0.31, 1.0, 0.7},  {0.2, 0.07, 1.9},
    {3.7, 2.9, 3.7}, {1e-3, 4e-3, 2e-3},   {1.0, 0.13, 0.13}, {17.0, 100.0, 90.0}};
static const int BRICK_NODES[] = {9, 10, 17, 33, 65, 100};

enum {
  SIDE_COUNT = sizeof SIDES / sizeof *SIDES,
  NODE_COUNT = sizeof NODES / sizeof *NODES,
  BRICK_COUNT = sizeof BRICKS / sizeof *BRICKS,
  BRICK_NODE_COUNT = sizeof BRICK_NODES / sizeof *BRICK_NODES
};

/* A mesh of sides that are no powers of two can be halved down to the coarsest asked for,
 * with cells that are nearly squares. */
static void sides_can_be_halved_as_often_as_is_asked(void **state)
{
  static const struct {
    int dimension, nodes, coarsest, halvings;
    double side[3];
  } rows[] = {
      {2, 1025, 256, 2, {2.065, 1.0}},  {2, 1025, 256, 2, {1.0, 0.4765}},
      {2, 2049, 256, 3, {1.0, 0.87}},   {2, 1000, 256, 2, {1.0, 0.93}},
      {2, 257, 256, 0, {1.0, 0.93}},    {3, 129, 64, 1, {1.0, 0.57, 0.71}},
      {2, 1025, 256, 1, {1.0, 0.0114}},
  };
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    fg__mesh_description description = {.dimension = rows[n].dimension,
                                        .nodes = rows[n].nodes,
                                        .coarsest = rows[n].coarsest};
    memcpy(description.side, rows[n].side, sizeof description.side);
    fg__mesh mesh;
    for (int halvings = 0; halvings <= rows[n].halvings; ++halvings) {
      assert_int_equal(fg__mesh_create(&mesh, *state, &description), FG_STATUS_OK);
      description.nodes = fg__mesh_most_cells(&mesh) / 2 + 1;
      for (int k = 0; k < mesh.dimension; ++k)
        if (rows[n].side[k] > 0.1)
          assert_true(fabs(mesh.spacing[k] * fg__mesh_most_cells(&mesh) - 1.0) < 0.1);
      if (halvings < rows[n].halvings)
        assert_true(fg__mesh_can_coarsen(&mesh));
      fg__mesh_clear(&mesh);
    }
  }
}

typedef void check(const fg__mesh *mesh, const fg__mesh_description *description);

static void check_mesh(fg_context *context, check *holds, int dimension,
                       const double side[], int nodes, int boundaries)
{
  fg__mesh_description description = {
      .dimension = dimension, .origin = {-12.25, 3.5, 0.125}, .nodes = nodes};
  for (int k = 0; k < dimension; ++k) {
    description.side[k] = side[k];
    description.periodic[k] = (boundaries >> k & 1) != 0;
  }
  fg__mesh mesh;
  assert_int_equal(fg__mesh_create(&mesh, context, &description), FG_STATUS_OK);
  holds(&mesh, &description);
  fg__mesh_clear(&mesh);
  fg__mesh_clear(&mesh);
}

/* Meshes of all shapes, sizes and kinds of boundaries. */
static void for_all_meshes(fg_context *context, check *holds)
{
  for (int s = 0; s < SIDE_COUNT; ++s)
    for (int n = 0; n < NODE_COUNT; ++n)
      for (int boundaries = 0; boundaries < 4; ++boundaries)
        check_mesh(context, holds, 2, SIDES[s], NODES[n], boundaries);
  for (int s = 0; s < BRICK_COUNT; ++s)
    for (int n = 0; n < BRICK_NODE_COUNT; ++n)
      for (int boundaries = 0; boundaries < 8; ++boundaries)
        check_mesh(context, holds, 3, BRICKS[s], BRICK_NODES[n], boundaries);
}

static int longest_axis(const fg__mesh_description *description)
{
  int longest = 0;
  for (int k = 1; k < description->dimension; ++k)
    if (description->side[k] > description->side[longest])
      longest = k;
  return longest;
}

static void fits_its_box(const fg__mesh *mesh, const fg__mesh_description *description)
{
  assert_int_equal(mesh->dimension, description->dimension);
  for (int k = 0; k < mesh->dimension; ++k) {
    double side = mesh->spacing[k] * mesh->length * mesh->cells[k];
    assert_true(fabs(side / description->side[k] - 1.0) < ROUNDING);
    assert_true(mesh->origin[k] == description->origin[k]);
    assert_int_equal(mesh->periodic[k], description->periodic[k]);
  }
  assert_true(mesh->length == description->side[longest_axis(description)]);
  for (int k = mesh->dimension; k < 3; ++k) {
    assert_int_equal(mesh->cells[k], 1);
    assert_true(mesh->spacing[k] == 1.0 && !mesh->periodic[k]);
  }
  for (int k = 0; k < mesh->dimension; ++k) {
    double ratio = mesh->spacing[k] / mesh->spacing[longest_axis(description)];
    assert_true(ratio < 2.0 + ROUNDING && ratio > 0.5 - ROUNDING);
  }
}

static void the_mesh_covers_the_box(void **state)
{
  for_all_meshes(*state, fits_its_box);
}

static void is_as_fine_as_asked(const fg__mesh *mesh,
                                const fg__mesh_description *description)
{
  int longest = longest_axis(description), cells = mesh->cells[longest];
  assert_true(cells >= description->nodes - 1);
  /* a thin box gets as many more as keep its cells from being twice as wide as long */
  double least = description->nodes - 1;
  for (int k = 0; k < mesh->dimension; ++k)
    if (k != longest)
      least = fmax(least, mesh->length / description->side[k] * mesh->cells[k] / 2.0);
  assert_true(cells < least + 16);
}

static void the_longest_side_has_the_cells_asked_for(void **state)
{
  for_all_meshes(*state, is_as_fine_as_asked);
}

/* Three coarser grids at least; a periodic axis must stay even to be coloured. */
static void halves_three_times(const fg__mesh *mesh,
                               const fg__mesh_description *description)
{
  for (int k = 0; k < description->dimension; ++k) {
    assert_true(mesh->cells[k] >= 8);
    assert_int_equal(mesh->cells[k] % 8, 0);
    if (mesh->periodic[k])
      assert_int_equal(mesh->cells[k] % 16, 0);
  }
}

static void every_mesh_can_be_coarsened(void **state)
{
  for_all_meshes(*state, halves_three_times);
}

/* A short side's cells come in steps; where it has room for one step the cells are as
 * square as the steps allow, and a box that divides evenly gets squares. */
static void is_nearly_square(const fg__mesh *mesh,
                             const fg__mesh_description *description)
{
  int longest = longest_axis(description);
  for (int k = 0; k < mesh->dimension; ++k) {
    if (k == longest)
      continue;
    double ideal = description->side[k] / mesh->length * mesh->cells[longest];
    int step = mesh->periodic[k] ? 16 : 8;
    double aspect = mesh->spacing[k] / mesh->spacing[longest];
    if (ideal < step) {
      assert_int_equal(mesh->cells[k], step);
      continue;
    }
    assert_true(aspect > 0.74 && aspect < 1.51);
    assert_true(fabs(mesh->cells[k] - ideal) <= 0.5 * step + 1e-9);
  }
}

static void cells_are_as_square_as_can_be(void **state)
{
  for_all_meshes(*state, is_nearly_square);
}

static void squares_stay_squares(void **state)
{
  for (int n = 0; n < NODE_COUNT; ++n) {
    fg__mesh_description description = {
        .dimension = 2, .side = {0.3, 0.3}, .nodes = NODES[n]};
    fg__mesh mesh;
    assert_int_equal(fg__mesh_create(&mesh, *state, &description), FG_STATUS_OK);
    assert_int_equal(mesh.cells[0], mesh.cells[1]);
    assert_true(mesh.spacing[0] == mesh.spacing[1]);
    fg__mesh_clear(&mesh);
  }
}

static void cubes_have_as_many_cells_along_each_side(void **state)
{
  fg__mesh_description description = {
      .dimension = 3, .side = {0.3, 0.3, 0.3}, .nodes = 65};
  fg__mesh mesh;
  assert_int_equal(fg__mesh_create(&mesh, *state, &description), FG_STATUS_OK);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(mesh.cells[k], 64);
    assert_true(mesh.spacing[k] == 1.0 / 64);
  }
  fg__mesh_clear(&mesh);
}

static void has_one_block(const fg__mesh *mesh, const fg__mesh_description *description)
{
  const fg__box *block = fg__own_block(&mesh->partition);
  for (int k = 0; k < 3; ++k) {
    bool natural = k < mesh->dimension && !description->periodic[k];
    assert_int_equal(block->first[k], 0);
    assert_int_equal(block->nodes[k], mesh->cells[k] + natural);
  }
}

static void a_process_alone_has_all_in_one_block(void **state)
{
  for_all_meshes(*state, has_one_block);
}

static void assert_refused(fg_context *context, const fg__mesh_description *description)
{
  fg__mesh mesh;
  assert_int_equal(fg__mesh_create(&mesh, context, description), FG_STATUS_ARGUMENT);
  assert_string_not_equal(fg_context_message(context), "");
  fg_context_clear(context);
  fg__mesh_clear(&mesh);
}

static void impossible_numbers_of_nodes_are_refused(void **state)
{
  const int nodes[] = {8, 1, 0, -1, INT32_MIN, 16386, INT32_MAX};
  for (size_t n = 0; n < sizeof nodes / sizeof *nodes; ++n)
    assert_refused(*state, &(fg__mesh_description){
                               .dimension = 2, .side = {1.0, 2.0}, .nodes = nodes[n]});
  assert_refused(*state, &(fg__mesh_description){
                             .dimension = 3, .side = {1.0, 2.0, 1.0}, .nodes = 2050});
}

static void impossible_boxes_are_refused(void **state)
{
  const double side[] = {0.0, -1.0, (double)NAN, (double)INFINITY, (double)-INFINITY};
  for (size_t n = 0; n < sizeof side / sizeof *side; ++n) {
    fg__mesh_description description = {.dimension = 2, .side = {1.0, 1.0}, .nodes = 33};
    for (int k = 0; k < 2; ++k) {
      description.side[k] = side[n];
      assert_refused(*state, &description);
      description.side[k] = 1.0;
    }
    description.dimension = 3;
    description.side[2] = side[n];
    assert_refused(*state, &description);
  }
  for (int dimension = -1; dimension < 5; ++dimension)
    if (dimension != 2 && dimension != 3)
      assert_refused(*state, &(fg__mesh_description){.dimension = dimension,
                                                     .side = {1.0, 1.0, 1.0},
                                                     .nodes = 33});
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(sides_can_be_halved_as_often_as_is_asked,
                                      context_set_up, context_tear_down),
      CASE(the_mesh_covers_the_box),
      CASE(the_longest_side_has_the_cells_asked_for),
      CASE(every_mesh_can_be_coarsened),
      CASE(cells_are_as_square_as_can_be),
      CASE(squares_stay_squares),
      CASE(cubes_have_as_many_cells_along_each_side),
      CASE(a_process_alone_has_all_in_one_block),
      CASE(impossible_numbers_of_nodes_are_refused),
      CASE(impossible_boxes_are_refused),
  };
  return cmocka_run_group_tests_name("grid/mesh", tests, NULL, NULL);
}
