#include "rival/cluster/bisect.h"
#include "rival/fields_test.h"

#include <stdlib.h>

typedef struct bench {
  fg_field *field;
  fg__domain domain;
  fg__bisection bisection;
  int *part_of; /* [raster cells] -1: none */
} bench;

static void set_up(bench *b, fg_context *context, velocity_of velocity, int count)
{
  b->field = field_of(context, velocity, false);
  assert_int_equal(fg__domain_create(&b->domain, context, b->field, 73), FG_STATUS_OK);
  assert_int_equal(fg__bisect(&b->bisection, context, &b->domain, count), FG_STATUS_OK);
  int cells = b->domain.cells[0] * b->domain.cells[1];
  b->part_of = malloc((size_t)cells * sizeof *b->part_of);
  assert_non_null(b->part_of);
  for (int i = 0; i < cells; i++)
    b->part_of[i] = -1;
  for (int n = 0; n < b->bisection.parts; n++)
    for (int i = 0; i < b->bisection.part[n].count; i++) {
      int cell = b->bisection.cell[b->bisection.part[n].first + i];
      assert_int_equal(b->part_of[cell], -1);
      b->part_of[cell] = n;
    }
}

static void tear_down(bench *b)
{
  free(b->part_of);
  fg__bisection_clear(&b->bisection);
  fg__domain_clear(&b->domain);
  fg_field_destroy(b->field);
}

static double largest_error(const bench *b, int *worst)
{
  double largest = -1;
  for (int n = 0; n < b->bisection.parts; n++) {
    const fg__part *part = &b->bisection.part[n];
    double error =
        fg__part_error(&b->domain, b->bisection.cell + part->first, part->count);
    if (error > largest) {
      largest = error;
      *worst = n;
    }
  }
  return largest;
}

/* From one number to the next only the worst cluster changes. */
static void the_worst_is_divided(void **state)
{
  for (int count = 1; count < 40; count += 3) {
    bench before, after;
    set_up(&before, *state, coast, count);
    set_up(&after, *state, coast, count + 1);
    assert_int_equal(before.bisection.parts, count);
    assert_int_equal(after.bisection.parts, count + 1);
    int worst = -1, kept = 0, gone = 0;
    largest_error(&before, &worst);
    for (int i = 0; i < before.domain.cells[0] * before.domain.cells[1]; i++) {
      if (before.part_of[i] != worst)
        assert_int_equal(after.part_of[i], before.part_of[i]);
      else if (after.part_of[i] == worst)
        kept++;
      else {
        assert_int_equal(after.part_of[i], count);
        gone++;
      }
    }
    assert_true(kept > 0 && gone > 0);
    tear_down(&before);
    tear_down(&after);
  }
}

static void the_largest_error_shrinks(void **state)
{
  static const int counts[] = {1, 4, 16, 64, 256};
  double before = HUGE_VAL;
  for (int k = 0; k < 5; k++) {
    bench b;
    int worst;
    set_up(&b, *state, swirl, counts[k]);
    double largest = largest_error(&b, &worst);
    assert_true(largest < 0.8 * before);
    before = largest;
    tear_down(&b);
  }
}

/* The first cut goes through the mean, across the direction of largest variance. */
static void the_cut_is_across_the_principal_axis(void **state)
{
  bench b;
  set_up(&b, *state, coast, 2);
  double mean[2] = {0, 0}, best = -1, axis[2] = {0, 0};
  int cells = b.domain.cells[0] * b.domain.cells[1];
  for (int i = 0; i < cells; i++)
    for (int k = 0; k < 2 && b.domain.valid[i]; k++) {
      double center[2];
      fg__domain_center(&b.domain, i, center);
      mean[k] += center[k] / b.domain.valid_count;
    }
  for (int degree = 0; degree < 1800; degree++) {
    double c = cos(degree * 3.14159265358979 / 1800),
           s = sin(degree * 3.14159265358979 / 1800);
    double variance = 0;
    for (int i = 0; i < cells; i++) {
      double center[2];
      fg__domain_center(&b.domain, i, center);
      double along = (center[0] - mean[0]) * c + (center[1] - mean[1]) * s;
      variance += b.domain.valid[i] ? along * along : 0;
    }
    if (variance > best) {
      best = variance;
      axis[0] = c;
      axis[1] = s;
    }
  }
  int side[2] = {0, 0};
  for (int i = 0; i < cells; i++) {
    double center[2];
    fg__domain_center(&b.domain, i, center);
    double along = (center[0] - mean[0]) * axis[0] + (center[1] - mean[1]) * axis[1];
    if (!b.domain.valid[i] || fabs(along) < 0.3) /* a tenth of a degree is 0.03 away */
      continue;
    int sign = (along > 0) == (b.part_of[i] == 1) ? 1 : 0;
    side[sign]++;
  }
  assert_true(side[0] == 0 || side[1] == 0);
  tear_down(&b);
}

/* A cell in a triangle of cells of one cluster belongs to it, unless masked. */
static void clusters_are_convex(void **state)
{
  bench b;
  set_up(&b, *state, coast, 37);
  unsigned random = 12345;
  int looked_at = 0;
  for (int n = 0; n < b.bisection.parts; n++) {
    const fg__part *part = &b.bisection.part[n];
    for (int tries = 0; tries < 40; tries++) {
      double inside[2] = {0, 0}, share[3] = {0.2, 0.35, 0.45};
      for (int corner = 0; corner < 3; corner++) {
        random = random * 1103515245U + 12345U;
        int cell =
            b.bisection
                .cell[part->first + (int)(random / 65536U % (unsigned)part->count)];
        double center[2];
        fg__domain_center(&b.domain, cell, center);
        for (int k = 0; k < 2; k++)
          inside[k] += share[corner] * center[k];
      }
      /* the centre of the cell that the point is in may lie outside of the triangle by
         half a cell: look only where all round it is in */
      int at = fg__domain_cell(&b.domain, inside), w = b.domain.cells[0];
      bool all = true, any = false;
      for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
          int next = at + dy * w + dx;
          bool there = next >= 0 && next < w * b.domain.cells[1];
          any = any || (there && b.part_of[next] == n);
          all = all && there && b.domain.valid[next];
        }
      assert_true(any || !all);
      looked_at += all;
    }
  }
  assert_true(looked_at > 500);
  tear_down(&b);
}

static void a_uniform_flow_has_no_error(void **state)
{
  bench b;
  int worst;
  set_up(&b, *state, slant, 9);
  assert_true(largest_error(&b, &worst) <= 0);
  /* then the largest is divided: sizes stay alike */
  int least = b.domain.valid_count, most = 0;
  for (int n = 0; n < 9; n++) {
    least = b.bisection.part[n].count < least ? b.bisection.part[n].count : least;
    most = b.bisection.part[n].count > most ? b.bisection.part[n].count : most;
  }
  assert_true(most < 2.3 * least);
  tear_down(&b);
}

/* A linear field v = M x from its mean: the stray of short lines grows with their square,
 * and not with the speed. */
static void shear(double x, double y, double v[2])
{
  (void)x;
  v[0] = 3;
  v[1] = 0.02 * (y - 11);
}

static void faster_shear(double x, double y, double v[2])
{
  shear(x, y, v);
  v[0] *= 7;
  v[1] *= 7;
}

static void error_grows_with_the_square_of_size(void **state)
{
  bench b, faster;
  set_up(&b, *state, shear, 1);
  set_up(&faster, *state, faster_shear, 1);
  int w = b.domain.cells[0], cell[400], used = 0;
  double error[2];
  for (int side = 10; side <= 20; side += 10) {
    used = 0;
    for (int y = 0; y < side; y++)
      for (int x = 0; x < side; x++)
        cell[used++] = (y + 21 - side / 2) * w + x + 5;
    error[side / 10 - 1] = fg__part_error(&b.domain, cell, used);
  }
  assert_true(error[1] > 3.5 * error[0] && error[1] < 4.5 * error[0]);
  assert_true(fabs(fg__part_error(&faster.domain, cell, used) / error[1] - 1) < 1e-4);
  tear_down(&b);
  tear_down(&faster);
}

static void as_many_icons_as_wanted(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, coast, false);
  fg_rival *rival = rival_of(context, field, FG_RIVAL_TOP_DOWN, 97);
  for (int count = 1; count < 90; count += 11) {
    fg_icons *icons = curved_icons(rival, field, count);
    assert_int_equal(fg_icons_clusters(icons), count);
    assert_int_equal(fg_icons_count(icons) + fg_icons_dropped(icons), count);
    assert_true(fg_icons_dropped(icons) <= count / 20);
    fg_icons_destroy(icons);
  }
  fg_rival_destroy(rival);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(the_worst_is_divided),
      CASE(the_largest_error_shrinks),
      CASE(the_cut_is_across_the_principal_axis),
      CASE(clusters_are_convex),
      CASE(a_uniform_flow_has_no_error),
      CASE(error_grows_with_the_square_of_size),
      CASE(as_many_icons_as_wanted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
