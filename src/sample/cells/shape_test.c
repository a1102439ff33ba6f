/* Each shape of cell by itself. */
#include "sample/cells/set_example.h"

/* Reference cells: the origin and the ends of three edges that its other corners follow
 * from, for shapes that an affine map leaves what they are. */
static const struct {
  fg__cell_shape shape;
  double corner[FG__CELL_CORNERS][3];
  double measure; /* its area or volume */
} REFERENCE[] = {
    {FG__CELL_TRIANGLE, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1.0 / 2},
    {FG__CELL_QUAD, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0},
    {FG__CELL_TETRAHEDRON, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 6},
    {FG__CELL_PYRAMID, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 3},
    {FG__CELL_WEDGE,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
     1.0 / 2},
    {FG__CELL_HEXAHEDRON,
     {{0, 0, 0},
      {1, 0, 0},
      {1, 1, 0},
      {0, 1, 0},
      {0, 0, 1},
      {1, 0, 1},
      {1, 1, 1},
      {0, 1, 1}},
     1.0}};
enum { SHAPES = sizeof REFERENCE / sizeof REFERENCE[0] };

/* Skew, and with a negative determinant in space. */
static const double EDGE[3][3] = {{2.0, 0.4, -0.3}, {0.7, -1.1, 0.2}, {0.3, 0.5, 3.0}};
static const double ZERO[3] = {-10.0, 3.0, 0.5};

static void map_affine(double out[3], const double at[3], int dimension)
{
  for (int k = 0; k < 3; ++k) {
    out[k] = k < dimension ? ZERO[k] : 7.0;
    for (int j = 0; j < 3; ++j)
      out[k] += j < dimension && k < dimension ? EDGE[j][k] * at[j] : 0.0;
  }
}

static double determinant_of_edges(int dimension)
{
  const double plane = EDGE[0][0] * EDGE[1][1] - EDGE[0][1] * EDGE[1][0];
  if (dimension == 2)
    return plane;
  return plane * EDGE[2][2] +
         (EDGE[0][1] * EDGE[1][2] - EDGE[0][2] * EDGE[1][1]) * EDGE[2][0] +
         (EDGE[0][2] * EDGE[1][0] - EDGE[0][0] * EDGE[1][2]) * EDGE[2][1];
}

/* A linear field is found at each sample inside; which these are, the inverse of the
 * affine map says by Cramer's rule. */
static void each_shape_has_its_samples(void **state)
{
  static const int corners[] = {0, 1, 2, 3, 4, 5, 6, 7};
  for (size_t s = 0; s < SHAPES; ++s) {
    const int dimension = fg__cell_dimension(REFERENCE[s].shape);
    double position[FG__CELL_CORNERS][3];
    for (int i = 0; i < fg__cell_corners(REFERENCE[s].shape); ++i)
      map_affine(position[i], REFERENCE[s].corner[i], dimension);
    fg__cell_set set =
        set_of(*state, position[0], (size_t)fg__cell_corners(REFERENCE[s].shape));
    add(&set, REFERENCE[s].shape, corners);
    set.dimension = 0;
    /* a lone cell of this kind would be a layer: choose the raster by hand */
    set.flat = dimension == 2 ? 2 : -1;
    for (int k = 0; k < 3; ++k) {
      set.size[k] = k < dimension ? 41 : 1;
      set.origin[k] = k < dimension ? ZERO[k] - 4.0 : 7.0;
      set.spacing[k] = k < dimension ? 0.2 : 1.0;
    }
    assert_int_equal(fg__cell_set_find_places(&set), FG_STATUS_OK);
    float *value = sample(&set, linear);
    size_t inside = 0;
    for (size_t n = 0; n < samples_of(&set); ++n) {
      double p[3];
      position_of(p, &set, n);
      if (isnan(value[n]))
        continue;
      assert_true(fabs((double)value[n] - linear(p)) < 2e-5);
      ++inside;
    }
    const double found = (double)inside * pow(0.2, dimension);
    const double measure = REFERENCE[s].measure * fabs(determinant_of_edges(dimension));
    assert_true(fabs(found - measure) < 0.15 * measure);
    free(value);
    fg__cell_set_clear(&set);
  }
}

/* Places go to points and back, in cells whose corners were moved. */
static void places_are_found_again(void **state)
{
  (void)state;
  uint64_t random = 3;
  int tried = 0;
  for (size_t s = 0; s < SHAPES; ++s)
    for (int round = 0; round < 500; ++round) {
      const fg__cell_shape shape = REFERENCE[s].shape;
      double corner[FG__CELL_CORNERS][3], weight[FG__CELL_CORNERS], at[3], found[3];
      double point[3] = {0.0, 0.0, 0.0};
      for (int i = 0; i < FG__CELL_CORNERS; ++i)
        for (int k = 0; k < 3; ++k) {
          random = random * 6364136223846793005U + 1442695040888963407U;
          corner[i][k] = REFERENCE[s].corner[i][k] +
                         0.3 * ((double)(random >> 40) / 16777216.0 - 0.5);
        }
      for (int k = 0; k < 3; ++k) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        at[k] = 0.9 * (double)(random >> 40) / 16777216.0;
        found[k] = 0.5;
      }
      if (fg__cell_excess(shape, at) > 0.0)
        continue;
      fg__cell_weights(shape, at, weight, NULL);
      for (int i = 0; i < fg__cell_corners(shape); ++i)
        for (int k = 0; k < fg__cell_dimension(shape); ++k)
          point[k] += weight[i] * corner[i][k];
      assert_true(fg__cell_invert(found, shape, corner, point, 1.0));
      for (int k = 0; k < fg__cell_dimension(shape); ++k)
        assert_true(fabs(found[k] - at[k]) < 1e-8);
      ++tried;
    }
  assert_true(tried > 1000);
}

/* Slopes are those of the weights, and weights of a corner are one there. */
static void slopes_are_those_of_weights(void **state)
{
  (void)state;
  for (size_t s = 0; s < SHAPES; ++s) {
    const fg__cell_shape shape = REFERENCE[s].shape;
    const double at[3] = {0.3, 0.2, 0.4}, step = 1e-6;
    double weight[FG__CELL_CORNERS], slope[FG__CELL_CORNERS][3];
    fg__cell_weights(shape, at, weight, slope);
    for (int k = 0; k < 3 && k < fg__cell_dimension(shape); ++k) {
      double before[3] = {at[0], at[1], at[2]}, after[3] = {at[0], at[1], at[2]};
      double low[FG__CELL_CORNERS], high[FG__CELL_CORNERS];
      before[k] -= step;
      after[k] += step;
      fg__cell_weights(shape, before, low, NULL);
      fg__cell_weights(shape, after, high, NULL);
      for (int i = 0; i < fg__cell_corners(shape); ++i)
        assert_true(fabs((high[i] - low[i]) / (2.0 * step) - slope[i][k]) < 1e-8);
    }
    for (int i = 0; i < fg__cell_corners(shape); ++i) {
      fg__cell_weights(shape, REFERENCE[s].corner[i], weight, NULL);
      for (int j = 0; j < fg__cell_corners(shape); ++j)
        assert_true(weight[j] == (i == j ? 1.0 : 0.0));
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_shape_has_its_samples),
      cmocka_unit_test(places_are_found_again),
      cmocka_unit_test(slopes_are_those_of_weights),
  };
  return cmocka_run_group_tests_name("sample/cells/shape", tests, context_set_up,
                                     context_tear_down);
}
