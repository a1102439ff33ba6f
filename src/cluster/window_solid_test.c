#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "cluster/labels_test.h"
#include "cluster/window.h"

enum { W = 14, H = 10, D = 9 };

static float u[W * H * D];
static unsigned char active[W * H * D];

static fg_density_arrays empty(bool x, bool y, bool z)
{
  for (int n = 0; n < W * H * D; ++n) {
    u[n] = -1.0F;
    active[n] = 1;
  }
  return (fg_density_arrays){.dimension = 3,
                             .nodes = {W, H, D},
                             .origin = {10.0, -3.0, 2.0},
                             .spacing = {0.5, 0.25, 2.0},
                             .periodic = {x, y, z},
                             .u = u};
}

/* A block, wrapped round the periods. */
static void fill(const int low[3], const int high[3], float value)
{
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x)
        u[(z % D * H + y % H) * W + x % W] = value;
}

static int positive_nodes(const fg__window *window)
{
  int count = 0;
  for (size_t n = 0; n < fg__window_count(window); ++n)
    count += window->level[n] > 0.0F;
  return count;
}

static void cut(fg__window *out, fg__labels *labels, const fg_density_arrays *density,
                int cluster)
{
  fg__patch whole = fg__patch_of(density, labels);
  assert_int_equal(fg__window_cut(out, NULL, density, labels, &whole, cluster),
                   FG_STATUS_OK);
}

static void a_window_holds_its_cluster_and_a_rim(void **state)
{
  (void)state;
  fg_density_arrays density = empty(false, false, false);
  fill((int[]){7, 4, 3}, (int[]){9, 5, 6}, 0.5F);
  fill((int[]){2, 1, 0}, (int[]){3, 3, 2}, 0.25F);
  fill((int[]){10, 6, 7}, (int[]){12, 8, 8}, 0.75F); /* touches the first at a corner */
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 3);
  const int expected[6] = {7, 9, 4, 5, 3, 6};
  assert_memory_equal(labels.bounds[1], expected, sizeof expected);
  fg__window window;
  cut(&window, &labels, &density, 2);
  assert_int_equal(window.nodes[0], 7);
  assert_int_equal(window.nodes[1], 6);
  assert_int_equal(window.nodes[2], 8); /* 1 ... 8, the domain's end */
  assert_true(fabs(window.origin[0] - 12.5) < 1e-12);
  assert_true(fabs(window.origin[2] - 4.0) < 1e-12);
  const bool at_boundary[6] = {false, false, false, false, false, true};
  assert_memory_equal(window.at_boundary, at_boundary, sizeof at_boundary);
  assert_int_equal(positive_nodes(&window), 3 * 2 * 4);
  /* a quarter, a half and an eighth of the way between eight nodes, one outside */
  const double place[3] = {10.0 + 0.5 * 9.25, -3.0 + 0.25 * 4.5, 2.0 + 2.0 * 4.125};
  assert_true(fabs(fg__window_level(&window, place) - (0.75 * 0.5 - 0.25)) < 1e-6);
  const double beyond[3] = {10.0, -3.0, 2.0};
  assert_true(fg__window_level(&window, beyond) < 0.0);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

static void masked_cells_are_outside(void **state)
{
  (void)state;
  fg_density_arrays density = empty(false, false, false);
  density.active = active;
  fill((int[]){4, 3, 2}, (int[]){8, 6, 6}, 0.5F);
  active[(4 * (H - 1) + 4) * (W - 1) + 6] = 0;
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 1);
  fg__window window;
  cut(&window, &labels, &density, 1);
  const double inside[3] = {10.0 + 0.5 * 6.5, -3.0 + 0.25 * 4.5, 2.0 + 2.0 * 4.5};
  assert_true(fg__window_level(&window, inside) < 0.0);
  const double beside[3] = {inside[0] - 0.5, inside[1], inside[2]};
  assert_true(fg__window_level(&window, beside) > 0.0);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

/* A block across the seam of each axis in turn keeps its shape, and one that goes round
 * is cut where it is thinnest. */
static void clusters_are_followed_across_periods(void **state)
{
  (void)state;
  const int nodes[3] = {W, H, D};
  for (int axis = 0; axis < 3; ++axis) {
    fg_density_arrays density = empty(axis == 0, axis == 1, axis == 2);
    int low[3] = {4, 3, 2}, high[3] = {6, 4, 5};
    low[axis] = nodes[axis] - 2;
    high[axis] = nodes[axis] + 2;
    fill(low, high, 0.5F);
    fg__labels labels;
    label_arrays(&labels, &density);
    assert_int_equal(labels.count, 1);
    assert_int_equal(labels.bounds[0][2 * axis], nodes[axis] - 2);
    assert_int_equal(labels.bounds[0][2 * axis + 1], nodes[axis] + 2);
    assert_false(labels.closed[0][axis]);
    fg__window window;
    cut(&window, &labels, &density, 1);
    assert_int_equal(window.nodes[axis], 5 + 4);
    int count = 1;
    for (int k = 0; k < 3; ++k)
      count *= high[k] - low[k] + 1;
    assert_int_equal(positive_nodes(&window), count);
    fg__window_clear(&window);
    fg__labels_clear(&labels);

    low[axis] = 0;
    high[axis] = nodes[axis] - 1;
    fill(low, high, 0.5F);
    int other = (axis + 1) % 3, thin[3] = {low[0], low[1], low[2]};
    int thin_end[3] = {high[0], high[1], high[2]};
    thin[axis] = thin_end[axis] = 5;
    thin_end[other] = thin[other];
    fill(thin, thin_end, -0.5F);
    label_arrays(&labels, &density);
    assert_int_equal(labels.count, 1);
    assert_true(labels.closed[0][axis]);
    assert_int_equal(labels.bounds[0][2 * axis], 5);
    assert_int_equal(labels.bounds[0][2 * axis + 1], 5 + nodes[axis]);
    cut(&window, &labels, &density, 1);
    assert_int_equal(window.nodes[axis], nodes[axis] + 1);
    assert_true(window.at_boundary[2 * axis] && window.at_boundary[2 * axis + 1]);
    fg__window_clear(&window);
    fg__labels_clear(&labels);
  }
}

static void divide(fg__window_piece part[FG__WINDOW_PIECES], int *count,
                   fg__labels *labels, const fg_density_arrays *density)
{
  fg__window window;
  label_arrays(labels, density);
  cut(&window, labels, density, 1);
  assert_int_equal(fg__window_divide(part, count, NULL, density, labels, &window),
                   FG_STATUS_OK);
  assert_null(window.level);
}

/* A block across the seams of x and z: a part in each corner that is large enough, where
 * it lies in the domain, with a boundary at the seam. */
static void clusters_are_cut_at_periodic_boundaries(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true, false, true);
  density.active = active;
  fill((int[]){W - 3, 3, D - 3}, (int[]){W + 3, 6, D + 1}, 0.5F);
  active[(3 * (H - 1) + 4) * W + 2] = 0; /* in the part that begins at x = 0, z = 0 */
  fg__labels labels;
  fg__window_piece part[FG__WINDOW_PIECES];
  int count;
  divide(part, &count, &labels, &density);
  assert_int_equal(count, 2);
  for (int n = 0; n < count; ++n) {
    const fg__window *v = &part[n].window;
    assert_int_equal(v->cluster, 1);
    assert_int_equal(positive_nodes(v), 4 * 4 * 4); /* the seam's are in both */
    assert_true(fabs(v->origin[2] - (2.0 + 2.0 * 4)) < 1e-12);
    assert_true(fabs(v->origin[0] - (10.0 + (n == 0 ? 0.5 * (W - 5) : 0.0))) < 1e-12);
    assert_int_equal(v->at_boundary[0], n == 1);
    assert_int_equal(v->at_boundary[1], n == 0);
    assert_false(v->at_boundary[4]);
    assert_true(v->at_boundary[5]);
    assert_true(fabs(part[n].share - 0.5) < 1e-12);
    fg__window_clear(&part[n].window);
  }
  fg__labels_clear(&labels);
}

static void a_cluster_within_the_boundaries_is_one_part(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true, true, true);
  fill((int[]){3, 3, 2}, (int[]){6, 5, 5}, 0.5F);
  fg__labels labels;
  fg__window_piece part[FG__WINDOW_PIECES];
  int count;
  divide(part, &count, &labels, &density);
  assert_int_equal(count, 1);
  assert_true(fabs(part[0].share - 1.0) < 1e-12);
  assert_int_equal(positive_nodes(&part[0].window), 4 * 3 * 4);
  fg__window_clear(&part[0].window);
  fg__labels_clear(&labels);
}

/* What lies beyond the boundary is too small for an icon: the other part stands for all.
 */
static void a_small_rest_is_left_out(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true, false, false);
  fill((int[]){W - 5, 3, 2}, (int[]){W, 5, 5}, 0.5F);
  fg__labels labels;
  fg__window_piece part[FG__WINDOW_PIECES];
  int count;
  divide(part, &count, &labels, &density);
  assert_int_equal(count, 1);
  assert_true(fabs(part[0].share - 1.0) < 1e-12);
  assert_int_equal(positive_nodes(&part[0].window), 6 * 3 * 4);
  assert_true(part[0].window.at_boundary[1]);
  fg__window_clear(&part[0].window);
  fg__labels_clear(&labels);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_window_holds_its_cluster_and_a_rim),
      cmocka_unit_test(masked_cells_are_outside),
      cmocka_unit_test(clusters_are_followed_across_periods),
      cmocka_unit_test(clusters_are_cut_at_periodic_boundaries),
      cmocka_unit_test(a_cluster_within_the_boundaries_is_one_part),
      cmocka_unit_test(a_small_rest_is_left_out),
  };
  return cmocka_run_group_tests_name("cluster/window_solid", tests, NULL, NULL);
}
