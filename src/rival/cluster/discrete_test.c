#include "rival/cluster/merge_tree.h"
#include "rival/fields_test.h"

#include <stdlib.h>
#include <string.h>

static const fg__merge_weights defaults = {.position = 0.95, .elongation = 2};

/* A domain, its hierarchy and one cut. */
typedef struct bench {
  fg_context *context;
  fg_field *field;
  fg__domain domain;
  fg__merge_tree tree;
} bench;

static void set_up(bench *b, fg_context *context, velocity_of velocity, bool round,
                   int nodes, const fg__merge_weights *weights)
{
  b->context = context;
  b->field = field_of(context, velocity, round);
  assert_int_equal(fg__domain_create(&b->domain, context, b->field, nodes), FG_STATUS_OK);
  assert_int_equal(fg__merge_tree_create(&b->tree, context, &b->domain, weights),
                   FG_STATUS_OK);
}

static void tear_down(bench *b)
{
  fg__merge_tree_clear(&b->tree);
  fg__domain_clear(&b->domain);
  fg_field_destroy(b->field);
}

static int raster_count(const bench *b)
{
  return b->domain.cells[0] * b->domain.cells[1];
}

/* Labels of a cut; free them. */
static int *cut(const bench *b, int count, int *found, int *left_out)
{
  int *label = calloc((size_t)raster_count(b), sizeof *label);
  assert_non_null(label);
  assert_int_equal(
      fg__merge_tree_cut(&b->tree, b->context, count, label, found, left_out),
      FG_STATUS_OK);
  return label;
}

/* Sum over cells of the squared distance between direction and its cluster's mean. */
static double deviation(const bench *b, const int *label, int count)
{
  double(*sum)[3] = calloc((size_t)count + 1, sizeof *sum), total = 0;
  assert_non_null(sum);
  for (int i = 0; i < raster_count(b); i++) {
    sum[label[i]][0] += fg__domain_direction(&b->domain, i)[0];
    sum[label[i]][1] += fg__domain_direction(&b->domain, i)[1];
    sum[label[i]][2] += 1;
  }
  for (int i = 0; i < raster_count(b); i++)
    for (int k = 0; label[i] > 0 && k < 2; k++) {
      double d =
          fg__domain_direction(&b->domain, i)[k] - sum[label[i]][k] / sum[label[i]][2];
      total += d * d;
    }
  free(sum);
  return total;
}

static void clusters_are_nested_and_as_many_as_wanted(void **state)
{
  static const int counts[] = {150, 77, 60, 25, 7, 2, 1};
  bench b;
  set_up(&b, *state, swirl, false, 61, &defaults);
  int *finer = NULL, finer_count = 0;
  double before = -1;
  for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
    int found, left_out;
    int *label = cut(&b, counts[c], &found, &left_out);
    assert_int_equal(found, counts[c]);
    assert_int_equal(left_out, 0);
    int *inside = calloc((size_t)finer_count + 1, sizeof *inside);
    assert_non_null(inside);
    for (int i = 0; i < raster_count(&b); i++) {
      assert_true(label[i] >= 1 && label[i] <= found);
      if (!finer)
        continue;
      assert_true(inside[finer[i]] == 0 || inside[finer[i]] == label[i]);
      inside[finer[i]] = label[i];
    }
    free(inside);
    /* what a mean leaves over can not become less by merging */
    double now = deviation(&b, label, found);
    assert_true(now >= before);
    before = now;
    free(finer);
    finer = label;
    finer_count = found;
  }
  free(finer);
  tear_down(&b);
}

static void numbers_are_in_the_order_of_first_cells(void **state)
{
  bench b;
  set_up(&b, *state, coast, false, 61, &defaults);
  int found, left_out, highest = 0;
  int *label = cut(&b, 40, &found, &left_out);
  for (int i = 0; i < raster_count(&b); i++) {
    assert_true(label[i] <= highest + 1);
    highest = label[i] > highest ? label[i] : highest;
    assert_true(b.domain.valid[i] || label[i] == 0);
  }
  assert_int_equal(highest, 40);
  free(label);
  tear_down(&b);
}

/* Marks the cells reached from one within its cluster; returns how many. */
static int flood(const bench *b, const int *label, int from, unsigned char *reached)
{
  int *stack = malloc((size_t)raster_count(b) * sizeof *stack), depth = 0, cells = 0;
  assert_non_null(stack);
  stack[depth++] = from;
  reached[from] = 1;
  while (depth > 0) {
    int at = stack[--depth], w = b->domain.cells[0], x = at % w, y = at / w;
    cells++;
    const int to[4][2] = {{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}};
    for (int d = 0; d < 4; d++) {
      if (to[d][0] < 0 || to[d][0] >= w || to[d][1] < 0 || to[d][1] >= b->domain.cells[1])
        continue;
      int next = to[d][1] * w + to[d][0];
      if (!reached[next] && label[next] == label[from]) {
        reached[next] = 1;
        stack[depth++] = next;
      }
    }
  }
  free(stack);
  return cells;
}

static void clusters_are_connected(void **state)
{
  bench b;
  set_up(&b, *state, coast, false, 61, &defaults);
  int found, left_out;
  int *label = cut(&b, 33, &found, &left_out);
  unsigned char *reached = calloc((size_t)raster_count(&b), 1);
  assert_non_null(reached);
  int floods = 0;
  for (int i = 0; i < raster_count(&b); i++)
    if (label[i] > 0 && !reached[i]) {
      flood(&b, label, i, reached);
      floods++;
    }
  assert_int_equal(floods, 33);
  free(reached);
  free(label);
  tear_down(&b);
}

/* Four regions, each of one direction, with boundaries on the raster's lines. */
static int region_of(double x, double y)
{
  return x < 8 ? y < 10 ? 0 : 1 : y < 7 ? 2 : 3;
}

static void regions(double x, double y, double v[2])
{
  static const double angle[4] = {0.3, 1.4, 3.9, 5.5}, speed[4] = {1, 7, 0.2, 3};
  int r = region_of(x, y);
  v[0] = speed[r] * cos(angle[r]);
  v[1] = speed[r] * sin(angle[r]);
}

static void a_piecewise_constant_field_is_recovered(void **state)
{
  const fg__merge_weights direction = {.position = 0, .elongation = 1};
  bench b;
  set_up(&b, *state, regions, false, 121, &direction);
  int found, left_out, label_of[4] = {0};
  int *label = cut(&b, 4, &found, &left_out);
  for (int i = 0; i < raster_count(&b); i++) {
    double center[2], beside[2];
    fg__domain_center(&b.domain, i, center);
    /* between samples of two regions the field turns from one to the other */
    bool pure = true;
    for (int k = 0; k < 4; k++) {
      beside[0] = center[0] + (k < 2 ? 0.5 : -0.5);
      beside[1] = center[1] + (k % 2 ? 0.4 : -0.4);
      pure = pure && region_of(beside[0], beside[1]) == region_of(center[0], center[1]);
    }
    int *mine = &label_of[region_of(center[0], center[1])];
    if (pure && !*mine)
      *mine = label[i];
    if (pure)
      assert_int_equal(label[i], *mine);
  }
  for (int r = 0; r < 4; r++)
    for (int q = 0; q < r; q++)
      assert_true(label_of[r] != label_of[q]);
  free(label);
  tear_down(&b);
}

/* Every merge was that of the two neighbours most alike, found the slow way. */
static void the_most_alike_are_merged(void **state)
{
  bench b;
  set_up(&b, *state, coast, true, 15, &defaults);
  int cells = raster_count(&b), w = b.domain.cells[0];
  int *at = malloc((size_t)cells * sizeof *at);
  assert_non_null(at);
  for (int i = 0; i < cells; i++)
    at[i] = -1;
  for (int leaf = 0; leaf < b.tree.cells; leaf++)
    at[b.tree.raster[leaf]] = leaf;
  for (int made = b.tree.cells; made < b.tree.nodes; made++) {
    double least = HUGE_VAL;
    for (int i = 0; i < cells; i++) {
      int right = i / w * w + (i % w + 1) % w, up = i + w;
      const int others[2] = {at[right], up < cells ? at[up] : -1};
      for (int d = 0; d < 2; d++)
        if (at[i] >= 0 && others[d] >= 0 && at[i] != others[d])
          least =
              fmin(least, fg__merge_error(&b.tree.node[at[i]], &b.tree.node[others[d]],
                                          &b.domain, &defaults));
    }
    assert_true(fabs(b.tree.node[made].error - least) < 1e-12);
    for (int i = 0; i < cells; i++)
      for (int k = 0; k < 2; k++)
        if (at[i] == b.tree.node[made].child[k])
          at[i] = made;
  }
  free(at);
  tear_down(&b);
}

/* Mean over clusters of the variance along the flow over that across it. */
static double drawn_out(fg_context *context, double elongation)
{
  const fg__merge_weights weights = {.position = 1, .elongation = elongation};
  bench b;
  set_up(&b, context, slant, false, 91, &weights);
  int found, left_out;
  int *label = cut(&b, 24, &found, &left_out);
  double sum[25][6] = {{0}}, ratio = 0;
  for (int i = 0; i < raster_count(&b); i++) {
    double p[2];
    fg__domain_center(&b.domain, i, p);
    double s = p[0] * cos(SLANT) + p[1] * sin(SLANT),
           t = p[1] * cos(SLANT) - p[0] * sin(SLANT);
    const double terms[5] = {1, s, s * s, t, t * t};
    for (int k = 0; k < 5; k++)
      sum[label[i]][k] += terms[k];
  }
  for (int n = 1; n <= found; n++) {
    double mean_s = sum[n][1] / sum[n][0], mean_t = sum[n][3] / sum[n][0];
    ratio += (sum[n][2] / sum[n][0] - mean_s * mean_s) /
             (sum[n][4] / sum[n][0] - mean_t * mean_t) / found;
  }
  free(label);
  tear_down(&b);
  return ratio;
}

static void elongation_draws_clusters_out(void **state)
{
  double circles = drawn_out(*state, 1), ellipses = drawn_out(*state, 3);
  assert_true(circles > 0.5 && circles < 2);
  assert_true(ellipses > 2 * circles);
}

static void clusters_go_across_a_periodic_boundary(void **state)
{
  bench b;
  set_up(&b, *state, slant, true, 62, &defaults);
  int found, left_out, across = 0, w = b.domain.cells[0];
  int *label = cut(&b, 12, &found, &left_out);
  for (int y = 0; y < b.domain.cells[1]; y++)
    across += label[y * w] == label[y * w + w - 1];
  assert_true(across > b.domain.cells[1] / 2);
  free(label);
  tear_down(&b);
}

/* A sea, a lake a third as large, and a pond. */
static void waters(double x, double y, double v[2])
{
  swirl(x, y, v);
  if ((x > 12.2 && x < 14.2) || (x >= 14.2 && y > 17 && y < 18.1) ||
      (x >= 14.2 && x < 20.6 && y >= 18.1))
    v[0] = (double)NAN;
}

static void small_lines_take_no_place(void **state)
{
  bench b;
  set_up(&b, *state, waters, false, 61, &defaults);
  int found, left_out, roots = 0;
  for (int n = 0; n < b.tree.nodes; n++)
    roots += b.tree.node[n].parent < 0;
  assert_int_equal(roots, 3);
  /* the pond is too small to be one of 2, the lake has to go for one */
  int *label = cut(&b, 2, &found, &left_out);
  assert_int_equal(found, 2);
  assert_int_equal(left_out, 1);
  free(label);
  label = cut(&b, 1, &found, &left_out);
  assert_int_equal(found, 1);
  assert_int_equal(left_out, 2);
  free(label);
  /* of many it is one */
  label = cut(&b, 120, &found, &left_out);
  assert_int_equal(found, 120);
  assert_int_equal(left_out, 0);
  free(label);
  tear_down(&b);
}

static void icons_and_clusters_of_the_public_calls(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, coast, false);
  fg_rival *rival = rival_of(context, field, FG_RIVAL_DISCRETE, 97);
  for (int count = 64; count > 2; count /= 4) {
    fg_icons *icons = curved_icons(rival, field, count);
    fg_density *clusters = NULL;
    assert_int_equal(fg_icons_count(icons), count);
    double area = 0;
    for (int n = 0; n < count; n++) {
      const fg_icon *icon = fg_icons_at(icons, n);
      assert_true(fg__icon_length(icon) <= 1.001 * sqrt(icon->area));
      area += icon->area;
    }
    assert_int_equal(fg_rival_clusters(&clusters, rival, count), FG_STATUS_OK);
    const fg_density_arrays *arrays = fg_density_contents(clusters);
    /* a cell is four of the density's, of which the lines between clusters take some */
    double inside = 0;
    for (int i = 0; i < arrays->nodes[0] * arrays->nodes[1]; i++)
      inside += arrays->u[i] > 0 ? arrays->spacing[0] * arrays->spacing[1] : 0;
    assert_true(inside < area && inside > 0.6 * area);
    fg_density_destroy(clusters);
    fg_icons_destroy(icons);
  }
  fg_rival_destroy(rival);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(clusters_are_nested_and_as_many_as_wanted),
      CASE(numbers_are_in_the_order_of_first_cells),
      CASE(clusters_are_connected),
      CASE(a_piecewise_constant_field_is_recovered),
      CASE(the_most_alike_are_merged),
      CASE(elongation_draws_clusters_out),
      CASE(clusters_go_across_a_periodic_boundary),
      CASE(small_lines_take_no_place),
      CASE(icons_and_clusters_of_the_public_calls),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
