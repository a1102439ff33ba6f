/* Icons in 3D that ranks make of their blocks are those of the plain arrays. */
#include <math.h>
#include <string.h>

#include "grid/slabs_test.h"

enum { CELLS = 32, FINE = 2, DATA = 12 * FINE };

static double wave(double x, double y, double z, int kind)
{
  const double turn = 6.283185307179586;
  switch (kind) {
  case 0: /* droplets, across every seam */
    return sin(2 * turn * x + 1) * sin(turn * y) * sin(2 * turn * z + 2) - 0.3;
  case 1: /* rods round the period along z and x */
    return sin(2 * turn * x + turn * z + 0.4) * cos(2 * turn * y) - 0.35;
  default: /* one net */
    return sin(turn * x) + sin(turn * y + 1) + sin(turn * z + 2) - 0.2;
  }
}

typedef struct subject {
  fg_field *field;
  fg_density *shared, *whole; /* whole: of plain arrays, NULL but on rank 0 */
} subject;

static fg_field *make_field(const bool periodic[3], bool masked)
{
  static float sample[3][DATA * DATA * DATA];
  double axis[DATA];
  for (int n = 0; n < DATA; ++n)
    axis[n] = 1.0 + 2.0 * n / DATA;
  for (int n = 0; n < DATA * DATA * DATA; ++n) {
    double x = (double)(n % DATA) / FINE, y = (double)(n / DATA % DATA) / FINE;
    double z = (double)(n / DATA / DATA) / FINE;
    sample[0][n] = (float)(1.0 + 0.5 * sin(0.5 * y));
    sample[1][n] = (float)(0.4 * cos(0.5 * z));
    sample[2][n] = (float)(0.3 + 0.6 * sin(0.5 * x + 1));
    if (masked && fabs(x - 5) < 1 && y > 3 && y < 8 && z < 1)
      sample[1][n] = NAN;
  }
  fg_field_arrays arrays = {.dimension = 3,
                            .size = {DATA, DATA, DATA},
                            .axis = {axis, axis, axis},
                            .velocity = {sample[0], sample[1], sample[2]}};
  for (int k = 0; k < 3; ++k)
    arrays.period[k] = periodic[k] ? 2.0 : 0.0;
  fg_field *out = NULL;
  expect(fg_field_create(&out, us.context, &arrays) == FG_STATUS_OK);
  return out;
}

static subject subject_of(int kind, const bool periodic[3], bool masked)
{
  subject out = {.field = make_field(periodic, masked)};
  int nodes[3], count = 1;
  for (int k = 0; k < 3; ++k) {
    nodes[k] = CELLS + !periodic[k];
    count *= nodes[k];
  }
  float *u = allocate_or_end((size_t)count, sizeof *u);
  for (int n = 0; n < count; ++n)
    u[n] = (float)fmin(fmax(3.0 * wave((double)(n % nodes[0]) / CELLS,
                                       (double)(n / nodes[0] % nodes[1]) / CELLS,
                                       (double)(n / nodes[0] / nodes[1]) / CELLS, kind),
                            -1.0),
                       1.0);
  fg_evolution_options options = {.nodes = CELLS + 1, .threads = 1, .initial = u};
  fg_evolution *evolution = NULL;
  expect(fg_evolution_create(&evolution, us.context, out.field, &options) ==
         FG_STATUS_OK);
  expect(fg_density_create(&out.shared, evolution) == FG_STATUS_OK);
  fg_evolution_destroy(evolution);
  fg_density *gathered = NULL;
  if (us.ranks->count > 1)
    expect(fg_density_gather(&gathered, us.context, out.shared) == FG_STATUS_OK);
  const fg_density *all = us.ranks->count > 1 ? gathered : out.shared;
  if (us.ranks->rank == 0 && all)
    expect(fg_density_create_from_arrays(&out.whole, us.context,
                                         fg_density_contents(all)) == FG_STATUS_OK);
  fg_density_destroy(gathered);
  free(u);
  return out;
}

static bool same_line(const double (*a)[3], int a_count, const double (*b)[3],
                      int b_count)
{
  return a_count == b_count && a_count > 0 &&
         memcmp(a, b, (size_t)a_count * sizeof *a) == 0;
}

static int compare(const fg_icons *got, const subject *s)
{
  fg_icons *want;
  fg_icon_options options = {.threads = 3};
  expect(fg_icons_create(&want, us.context, s->field, s->whole, &options) ==
         FG_STATUS_OK);
  int count = fg_icons_count(want);
  expect(fg_icons_clusters(got) == fg_icons_clusters(want));
  expect(fg_icons_count(got) == count);
  for (int n = 0; n < count && fg_icons_count(got) == count; ++n) {
    const fg_icon *a = fg_icons_at(got, n), *b = fg_icons_at(want, n);
    expect(a->cluster == b->cluster && a->area == b->area && a->width == b->width);
    expect(a->speed == b->speed && a->kind == b->kind);
    expect(same_line(a->points, a->point_count, b->points, b->point_count));
    expect(same_line(a->spine, a->spine_count, b->spine, b->spine_count));
    expect(same_line(a->streamline, a->streamline_count, b->streamline,
                     b->streamline_count));
  }
  fg_icons_destroy(want);
  return count;
}

static void parts_give_the_icons_of_the_whole(void **state)
{
  (void)state;
  int icons_seen = 0;
  for (int kind = 0; kind < 3; ++kind)
    for (int way = 0; way < 8; way += kind == 0 ? 1 : 3) {
      const bool periodic[3] = {way & 1, way & 2, way & 4};
      /* of droplets half for an even number of ranks, the others for an odd one */
      if (kind == 0 && (periodic[0] + periodic[1] + periodic[2] + us.ranks->count) % 2)
        continue;
      subject s = subject_of(kind, periodic, way % 3 == 1 || way == 6);
      fg_icons *icons;
      fg_field *part = way % 2 == kind % 2 ? joined_slab_of(s.field) : NULL;
      expect(fg_icons_create(&icons, us.context, part ? part : s.field, s.shared, NULL) ==
             FG_STATUS_OK);
      fg_field_destroy(part);
      expect(!icons == (us.ranks->rank > 0));
      if (icons)
        icons_seen += compare(icons, &s);
      fg_icons_destroy(icons);
      fg_field_destroy(s.field);
      fg_density_destroy(s.shared);
      fg_density_destroy(s.whole);
    }
  if (us.ranks->rank == 0)
    expect(icons_seen > 20);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {TOGETHER(parts_give_the_icons_of_the_whole)};
  return cmocka_run_group_tests_name("icon/solids", tests, NULL, NULL);
}
