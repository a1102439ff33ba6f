/* Cells of all types in linear parts, and planes that are tilted. */
#include "sample/cells/set_example.h"

enum { MOST = 27 };

/* Points between the corners of a cell, and in the middle of faces and of all, each of so
 * many corners; VTK's numbering. */
typedef struct quadratic {
  int type, corners, nodes;
  double corner[8][3];
  int round[19][8], of[19]; /* the nodes from `corners` on */
  double size;              /* area or volume */
} quadratic;

#define CUBE                                                                             \
  {                                                                                      \
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},         \
    {                                                                                    \
      0, 1, 1                                                                            \
    }                                                                                    \
  }
#define CUBE_EDGES                                                                       \
  {0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5},        \
      {2, 6},                                                                            \
  {                                                                                      \
    3, 7                                                                                 \
  }
#define CUBE_FACES                                                                       \
  {0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 1, 2, 3}, {4, 5, 6, 7},    \
  {                                                                                      \
    0, 1, 2, 3, 4, 5, 6, 7                                                               \
  }
#define PRISM                                                                            \
  {                                                                                      \
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},                               \
    {                                                                                    \
      0, 1, 1                                                                            \
    }                                                                                    \
  }

static const quadratic CELLS[] = {
    {22,
     3,
     6,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
     {{0, 1}, {1, 2}, {2, 0}},
     {2, 2, 2},
     0.5},
    {34,
     3,
     7,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
     {{0, 1}, {1, 2}, {2, 0}, {0, 1, 2}},
     {2, 2, 2, 3},
     0.5},
    {23,
     4,
     8,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
     {2, 2, 2, 2},
     1.0},
    {28,
     4,
     9,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}},
     {2, 2, 2, 2, 4},
     1.0},
    {30,
     4,
     6,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
     {{0, 1}, {2, 3}},
     {2, 2},
     1.0},
    {24,
     4,
     10,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
     {2, 2, 2, 2, 2, 2},
     1.0 / 6.0},
    {25, 8, 20, CUBE, {CUBE_EDGES}, {2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2}, 1.0},
    {29,
     8,
     27,
     CUBE,
     {CUBE_EDGES, CUBE_FACES},
     {2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 4, 4, 4, 4, 4, 4, 8},
     1.0},
    {26,
     6,
     15,
     PRISM,
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
     {2, 2, 2, 2, 2, 2, 2, 2, 2},
     0.5},
    {32,
     6,
     18,
     PRISM,
     {{0, 1},
      {1, 2},
      {2, 0},
      {3, 4},
      {4, 5},
      {5, 3},
      {0, 3},
      {1, 4},
      {2, 5},
      {0, 1, 4, 3},
      {1, 2, 5, 4},
      {2, 0, 3, 5}},
     {2, 2, 2, 2, 2, 2, 2, 2, 2, 4, 4, 4},
     0.5},
    {31,
     6,
     12,
     PRISM,
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}},
     {2, 2, 2, 2, 2, 2},
     0.5},
    {27,
     5,
     13,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
     {2, 2, 2, 2, 2, 2, 2, 2},
     1.0 / 3.0},
};

static void place_nodes(double position[3 * MOST], const quadratic *cell)
{
  for (int n = 0; n < cell->nodes; ++n)
    for (int k = 0; k < 3; ++k) {
      double sum = n < cell->corners ? cell->corner[n][k] : 0.0;
      const int between = n - cell->corners;
      for (int i = 0; between >= 0 && i < cell->of[between]; ++i)
        sum += cell->corner[cell->round[between][i]][k] / cell->of[between];
      position[3 * n + k] = sum;
    }
}

static void add_nodes(fg__cell_set *set, int type, int nodes)
{
  int node[MOST];
  for (int i = 0; i < nodes; ++i)
    node[i] = i;
  if (fg__cell_set_add_as(set, type, node, (size_t)nodes, 0))
    fail_msg("%d: %s", type, fg_context_message(set->context));
  set->numbers = 1;
}

/* x y z of the points, and a product of two of them, which the points between corners
 * tell: the square of a linear function is quadratic. */
static double square(const double p[3])
{
  const double l = 0.5 + p[0] + 0.5 * p[1] - 0.25 * p[2];
  return l * l;
}

/* Parts leave no gap and nothing out, whichever corners are given first: their share of
 * the box is the cell's. */
static void parts_fill_their_cell(void **state)
{
  for (size_t c = 0; c < sizeof CELLS / sizeof CELLS[0]; ++c) {
    const quadratic *cell = &CELLS[c];
    double position[3 * MOST];
    place_nodes(position, cell);
    fg__cell_set set = set_of(*state, position, (size_t)cell->nodes);
    add_nodes(&set, cell->type, cell->nodes);
    locate(&set);
    float *of_point = malloc(set.points * sizeof *of_point);
    float *value = malloc(samples_of(&set) * sizeof *value);
    assert_true(of_point && value);
    for (size_t p = 0; p < set.file_points; ++p)
      of_point[p] = (float)square(set.position + 3 * p);
    fg__cell_set_fill_middles(of_point, &set);
    fg__cell_set_sample(value, &set, of_point, 0, samples_of(&set));
    double inside = 0.0, worst = 0.0;
    for (size_t n = 0; n < samples_of(&set); ++n) {
      double at[3];
      position_of(at, &set, n);
      inside += !isnan(value[n]);
      if (!isnan(value[n])) /* linear in cells half as wide: h^2 / 8 of the curvature */
        worst = fmax(worst, fabs((double)value[n] - square(at)));
    }
    const double share = inside / (double)samples_of(&set);
    /* a raster's samples on slanting sides count whole */
    if (share < cell->size - 1e-9 || share > cell->size + 0.25 || worst > 0.2)
      fail_msg("type %d: share %g of %g, off by %g", cell->type, share, cell->size,
               worst);
    for (size_t p = 0; of_point && p < set.points;
         ++p) /* the middles are in their places */
      assert_true(fabs((double)of_point[p] - square(set.position + 3 * p)) < 1e-6);
    free(of_point);
    free(value);
    fg__cell_set_clear(&set);
  }
}

static void polygons_and_strips_are_triangles(void **state)
{
  static const double hexagon[] = {2, 0, 0, 4, 0, 0, 5, 2, 0, 4, 4, 0, 2, 4, 0, 1, 2, 0};
  static const double strip[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0};
  double dent[18];
  memcpy(dent, hexagon, sizeof dent);
  dent[6] = 3.0; /* (5, 2) comes in, past the line between its neighbours */
  fg__cell_set set = set_of(*state, hexagon, 6);
  add_nodes(&set, 7, 6);
  assert_int_equal(set.count, 4);
  assert_int_equal(fg__cell_set_count(&set), 1);
  fg__cell_set_clear(&set);
  set = set_of(*state, strip, 5);
  add_nodes(&set, 6, 5);
  assert_int_equal(set.count, 3);
  fg__cell_set_clear(&set);
  static const int node[] = {0, 1, 2, 3, 4, 5};
  set = set_of(*state, dent, 6);
  assert_int_equal(fg__cell_set_add_as(&set, 7, node, 6, 3), FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(*state), "cell 3 is a polygon of 6"));
  assert_int_equal(fg__cell_set_add_as(&set, 68, node, 3, 3), FG_STATUS_OK);
  assert_int_equal(set.count, 0);
  fg__cell_set_clear(&set);
}

/* A rectangle however it is turned keeps its lengths, and linear fields on it. */
static void tilted_planes_are_turned(void **state)
{
  static const double normals[][3] = {{1, 2, 3}, {1, 0, 1}, {-3, 0.5, 0.25}};
  static const int corner[] = {0, 1, 2, 3};
  for (int n = 0; n < 3; ++n) {
    fg__plane_basis basis;
    assert_true(fg__plane_basis_of(&basis, normals[n]));
    double position[12];
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k)
        position[3 * i + k] = 7.0 * basis.normal[k] +
                              (i == 1 || i == 2 ? 5.0 : 1.0) * basis.direction[0][k] +
                              (i >= 2 ? 4.0 : 2.0) * basis.direction[1][k];
    fg__cell_set set = set_of(*state, position, 4);
    add(&set, FG__CELL_QUAD, corner);
    float of_point[4];
    for (int p = 0; p < 4; ++p)
      of_point[p] = (float)linear(position + 3 * p);
    locate(&set);
    assert_true(set.tilted && set.dimension == 2 && set.flat == 2);
    assert_true(fabs(set.origin[0] - 1.0) < 1e-9 && fabs(set.origin[1] - 2.0) < 1e-9);
    float *out = malloc(samples_of(&set) * sizeof *out);
    assert_non_null(out);
    fg__cell_set_sample(out, &set, of_point, 0, samples_of(&set));
    for (size_t s = 0; s < samples_of(&set); ++s) {
      double at[3], in_space[3];
      position_of(at, &set, s);
      for (int k = 0; k < 3; ++k)
        in_space[k] = 7.0 * basis.normal[k] + at[0] * basis.direction[0][k] +
                      at[1] * basis.direction[1][k];
      assert_true(fabs((double)out[s] - linear(in_space)) < 1e-4);
    }
    free(out);
    fg__cell_set_clear(&set);
  }
}

/* A prism over a hexagon: its points in any order, and its faces, each begun at another.
 */
static const int PRISM_CELL[] = {12, 0,  5, 10, 3,  8,  1, 6, 11, 4,  9,  2, 7, 8, 6,
                                 5,  4,  3, 2,  1,  0,  6, 8, 9,  10, 11, 6, 7, 4, 1,
                                 7,  6,  0, 4,  1,  2,  8, 7, 4,  9,  8,  2, 3, 4, 3,
                                 4,  10, 9, 4,  11, 10, 4, 5, 4,  5,  0,  6, 11};

static fg_status add_prism(fg__cell_set *set)
{
  set->numbers = 1;
  return fg__cell_set_add_as(set, FG__POLYHEDRON, PRISM_CELL,
                             sizeof PRISM_CELL / sizeof *PRISM_CELL, 0);
}

static void a_polyhedron_is_filled(void **state)
{
  static const double hexagon[6][2] = {{2, 0}, {4, 0}, {5, 2}, {4, 4}, {2, 4}, {1, 2}};
  double position[3 * 12];
  for (int n = 0; n < 12; ++n) {
    position[3 * n] = hexagon[n % 6][0];
    position[3 * n + 1] = hexagon[n % 6][1];
    position[3 * n + 2] = n < 6 ? 1.0 : 4.0;
  }
  fg__cell_set set = set_of(*state, position, 12);
  assert_int_equal(add_prism(&set), FG_STATUS_OK);
  assert_int_equal(fg__cell_set_count(&set), 1);
  locate(&set);
  assert_int_equal(set.points, 13);
  float of_point[13], *value = malloc(samples_of(&set) * sizeof *value);
  assert_non_null(value);
  for (size_t p = 0; p < 12; ++p)
    of_point[p] = (float)linear(position + 3 * p);
  fg__cell_set_fill_middles(of_point, &set);
  fg__cell_set_sample(value, &set, of_point, 0, samples_of(&set));
  for (size_t n = 0; n < samples_of(&set); ++n) {
    double at[3];
    position_of(at, &set, n);
    const double off = fmax(0.0, fabs(at[1] - 2.0) / 2.0 + fabs(at[0] - 3.0) - 2.0);
    assert_true(isnan(value[n]) ? off > 0.0 : off < 1e-3);
    if (!isnan(value[n]))
      assert_true(fabs((double)value[n] - linear(at)) < 1e-4);
  }
  free(value);
  fg__cell_set_clear(&set);
  set = set_of(*state, position, 12);
  assert_int_equal(
      fg__cell_set_add_as(&set, FG__POLYHEDRON, (const int[]){2, 0, 1, 0}, 4, 0),
      FG_STATUS_FILE_FORMAT);
  fg_context_clear(*state);
  assert_int_equal(fg__cell_set_add_as(&set, FG__POLYHEDRON, PRISM_CELL, 13, 0),
                   FG_STATUS_UNSUPPORTED); /* without faces */
  assert_non_null(strstr(fg_context_message(*state), "cell 0 is a polyhedron"));
  fg__cell_set_clear(&set);
}

/* A layer of polyhedra is a plane, as one of hexahedra. */
static void a_polyhedron_is_a_layer(void **state)
{
  double position[3 * 12];
  for (int n = 0; n < 12; ++n) {
    position[3 * n] = n % 6 < 3 ? 5.0 * (n % 6 % 3) : 5.0 * (5 - n % 6);
    position[3 * n + 1] = n % 6 < 3 ? 0.5 * (n % 6) : 8.0;
    position[3 * n + 2] = n < 6 ? 1.0 : 4.0;
  }
  fg__cell_set set = set_of(*state, position, 12);
  assert_int_equal(add_prism(&set), FG_STATUS_OK);
  locate(&set);
  assert_int_equal(set.flat, 2);
  float *value = sample(&set, linear);
  int inside = 0;
  for (size_t n = 0; n < samples_of(&set); ++n) {
    double at[3];
    position_of(at, &set, n);
    assert_true(fabs(at[2] - 2.5) < 1e-12);
    inside += !isnan(value[n]);
    assert_true(!isnan(value[n]) || at[1] < 1.01);
    assert_true(isnan(value[n]) || fabs((double)value[n] - linear(at)) < 1e-4);
  }
  assert_true(inside > 10);
  free(value);
  fg__cell_set_clear(&set);
}

/* However many of a cell's parts meet in a point: it is one cell of those round it. */
static void parts_count_once_in_means(void **state)
{
  double position[3 * 13];
  for (int n = 0; n < 39; ++n)
    position[n] = sin(n);
  fg__cell_set set = set_of(*state, position, 13);
  assert_int_equal(add_prism(&set), FG_STATUS_OK);
  add(&set, FG__CELL_TETRAHEDRON, (const int[]){0, 1, 7, 12});
  set.file_points = set.points;
  for (size_t i = 0; i < set.corners; ++i) /* the middle is not placed */
    set.corner[i] = set.corner[i] < 0 ? 5 : set.corner[i];
  const float of_cell[] = {1.0f, 4.0f};
  float of_point[13];
  assert_int_equal(fg__cell_set_to_points(of_point, &set, of_cell), FG_STATUS_OK);
  for (int n = 0; n < 13; ++n) {
    const bool shared = n == 0 || n == 1 || n == 7;
    const double mean = n == 12 ? 4.0 : shared ? 2.5 : 1.0;
    assert_true(fabs((double)of_point[n] - mean) < 1e-6);
  }
  fg__cell_set_clear(&set);
}

/* Adds nodes 0, 1, ... of the cells of CELLS that has as many of another type. */
static fg__cell_set set_of_type(void *state, int type, const double *position, int nodes)
{
  fg__cell_set set = set_of(state, position, (size_t)nodes);
  add_nodes(&set, type, nodes);
  return set;
}

static void lagrange_cells_are_those_of_their_order(void **state)
{
  static const struct {
    int lagrange, type, nodes, like; /* the type of CELLS whose nodes are taken */
  } alike[] = {{69, 5, 3, 22},  {69, 22, 6, 22},  {70, 9, 4, 28},  {70, 28, 9, 28},
               {71, 10, 4, 24}, {71, 24, 10, 24}, {72, 12, 8, 29}, {72, 29, 27, 29},
               {73, 13, 6, 32}, {73, 32, 18, 32}, {74, 14, 5, 27}};
  for (size_t i = 0; i < sizeof alike / sizeof *alike; ++i) {
    const quadratic *cell = CELLS;
    double position[3 * MOST];
    while (cell->type != alike[i].like)
      ++cell;
    place_nodes(position, cell);
    fg__cell_set set = set_of_type(*state, alike[i].lagrange, position, alike[i].nodes);
    fg__cell_set other = set_of_type(*state, alike[i].type, position, alike[i].nodes);
    assert_true(set.count > 0 && set.count == other.count);
    assert_memory_equal(set.shape, other.shape, set.count);
    assert_memory_equal(set.corner, other.corner, set.corners * sizeof *set.corner);
    fg__cell_set_clear(&set);
    fg__cell_set_clear(&other);
  }
  const int node[MOST] = {0};
  fg__cell_set set = {.context = *state, .path = "cells"};
  for (int type = 69; type <= 74; ++type) { /* of order 3, or of another order along z */
    assert_int_equal(fg__cell_set_add_as(&set, type, node, 16, 7), FG_STATUS_UNSUPPORTED);
    assert_non_null(strstr(fg_context_message(*state), "of 16 points"));
    fg_context_clear(*state);
  }
  fg__cell_set_clear(&set);
}

/* Nodes 18 and 19 lie between corners 3 and 7, and 2 and 6, in files of VTK before 9. */
static void edges_of_a_lagrange_hexahedron_come_in_either_order(void **state)
{
  const quadratic *cell = CELLS;
  double now[3 * MOST], before[3 * MOST];
  while (cell->type != 29)
    ++cell;
  place_nodes(now, cell);
  memcpy(before, now, sizeof now);
  memcpy(before + 3 * 18, now + 3 * 19, 3 * sizeof *now);
  memcpy(before + 3 * 19, now + 3 * 18, 3 * sizeof *now);
  fg__cell_set set = set_of_type(*state, 72, now, MOST);
  fg__cell_set other = set_of_type(*state, 72, before, MOST);
  for (size_t i = 0; i < set.corners; ++i)
    for (int k = 0; k < 3; ++k)
      assert_true(now[3 * set.corner[i] + k] == before[3 * other.corner[i] + k]);
  fg__cell_set_clear(&set);
  fg__cell_set_clear(&other);
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, context_set_up, context_tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(parts_fill_their_cell),
      CASE(polygons_and_strips_are_triangles),
      CASE(a_polyhedron_is_filled),
      CASE(a_polyhedron_is_a_layer),
      CASE(parts_count_once_in_means),
      CASE(tilted_planes_are_turned),
      CASE(lagrange_cells_are_those_of_their_order),
      CASE(edges_of_a_lagrange_hexahedron_come_in_either_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
