#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "solver/multigrid_test.h"
#include "solver/subdomain/mass.h"

/* Rooms in a box that is periodic along x: a wall, a layer of cells along z, has a room
 * below; what is above is L-shaped, and its foot goes on round the period. */
enum { W = 16, H = 8, D = 12, CELLS = W * H * D };
enum { NODES = W * (H + 1) * (D + 1) };

typedef bool mask(int x, int y, int z);

static bool rooms(int x, int y, int z)
{
  (void)y;
  return z != 3 && !(z > 5 && x > 4 && x < 14);
}

/* A hole in the wall, as wide as an edge: the cells that face it touch at two nodes. */
static bool joined(int x, int y, int z)
{
  return z > 4 || (z == 4 && x == 1 && y == 2) || (z == 3 && x == 2 && y == 2) || z < 3;
}

static bool one_room(int x, int y, int z)
{
  return z != 3 || (x == 7 && y == 0);
}

typedef struct subject {
  fg__multigrid multigrid;
  float *u;
  double mass[NODES];
} subject;

static size_t node_of(int i, int j, int k)
{
  return ((size_t)k * (H + 1) + (size_t)j) * W + (size_t)i;
}

static void create(subject *s, mask *inside)
{
  const fg__mesh mesh = {.dimension = 3,
                         .cells = {W, H, D},
                         .periodic = {true, false, false},
                         .spacing = {0.0625, 0.07, 0.08}};
  float *values = calloc(6 * CELLS, sizeof *values);
  unsigned char *active = calloc(CELLS, 1);
  assert_non_null(values);
  assert_non_null(active);
  fg__tensor tensor = {values,
                       values + CELLS,
                       values + 2 * CELLS,
                       values + 3 * CELLS,
                       values + 4 * CELLS,
                       values + 5 * CELLS,
                       active};
  memset(s->mass, 0, sizeof s->mass);
  for (int n = 0; n < CELLS; ++n) {
    int x = n % W, y = n / W % H, z = n / (W * H);
    active[n] = inside(x, y, z);
    tensor.xx[n] = tensor.yy[n] = tensor.zz[n] = active[n];
    for (int corner = 0; corner < 8 && active[n]; ++corner)
      s->mass[node_of((x + corner % 2) % W, y + corner / 2 % 2, z + corner / 4)] += 0.125;
  }
  assert_int_equal(multigrid_of_tensor(&s->multigrid, NULL, &mesh, &tensor, 1.0, NULL),
                   FG_STATUS_OK);
  free(values);
  free(active);
  float plain[NODES];
  srand(4);
  for (int n = 0; n < NODES; ++n)
    plain[n] = s->mass[n] > 0.0 ? (float)(rand() % 2000 - 1100) / 1000.0F : 0.0F;
  s->u = fg__multigrid_u(&s->multigrid);
  fg__level_import(&s->multigrid.level[0], s->u, plain);
  fg__fill_ghosts(&s->multigrid.level[0], s->u);
}

static double mean_of(const subject *s, int first_plane, int planes)
{
  float plain[NODES];
  double sum = 0.0, mass = 0.0;
  fg__level_export(&s->multigrid.level[0], s->u, plain);
  for (size_t n = node_of(0, 0, first_plane); n < node_of(0, 0, first_plane + planes);
       ++n) {
    sum += s->mass[n] * (double)plain[n];
    mass += s->mass[n];
  }
  return sum / mass;
}

static void parts_weigh_what_their_cells_do(void **state)
{
  (void)state;
  static subject s;
  fg__mass_constraint masses;
  create(&s, rooms);
  assert_int_equal(fg__mass_constraint_create(&masses, NULL, &s.multigrid, s.u),
                   FG_STATUS_OK);
  assert_int_equal(masses.count, 2);
  assert_true(masses.mass[0] == W * H * 3);
  assert_true(masses.mass[1] == W * H * 2 + 7 * H * 6);
  fg__mass_constraint_clear(&masses);
  fg__multigrid_clear(&s.multigrid);
}

static void what_touches_is_one_part(void **state)
{
  (void)state;
  static subject s;
  mask *const masks[] = {joined, one_room};
  for (int n = 0; n < 2; ++n) {
    fg__mass_constraint masses;
    create(&s, masks[n]);
    assert_int_equal(fg__mass_constraint_create(&masses, NULL, &s.multigrid, s.u),
                     FG_STATUS_OK);
    assert_true(masses.count <= 1);
    float disturbed = s.u[0] += 0.5F;
    fg__mass_constraint_restore(&masses, &s.multigrid,
                                s.u); /* is left to the mean of all */
    assert_true(s.u[0] == disturbed);
    fg__mass_constraint_clear(&masses);
    fg__multigrid_clear(&s.multigrid);
  }
}

/* Both subdomains are disturbed, one unevenly. */
static void each_part_gets_its_mean_back(void **state)
{
  (void)state;
  static subject s;
  fg__mass_constraint masses;
  create(&s, rooms);
  const fg__level *level = &s.multigrid.level[0];
  assert_int_equal(fg__mass_constraint_create(&masses, NULL, &s.multigrid, s.u),
                   FG_STATUS_OK);
  const double before[2] = {mean_of(&s, 0, 4), mean_of(&s, 4, D - 3)};
  float plain[NODES], after[NODES];
  fg__level_export(level, s.u, plain);
  for (int n = 0; n < NODES; ++n)
    plain[n] += n < (int)node_of(0, 0, 4) ? 0.07F : (float)(n % 3) * -0.05F;
  fg__level_import(level, s.u, plain);
  fg__fill_ghosts(level, s.u);
  assert_true(fabs(mean_of(&s, 0, 4) - before[0]) > 0.01);
  fg__mass_constraint_restore(&masses, &s.multigrid, s.u);
  assert_true(fabs(mean_of(&s, 0, 4) - before[0]) < 1e-7);
  assert_true(fabs(mean_of(&s, 4, D - 3) - before[1]) < 1e-7);
  fg__level_export(level, s.u, after);
  float shift[2] = {after[0] - plain[0], after[NODES - 1] - plain[NODES - 1]};
  for (int n = 0; n < NODES; ++n) {
    float expected = s.mass[n] > 0.0 ? shift[n >= (int)node_of(0, 0, 4)] : 0.0F;
    assert_true(fabsf(after[n] - plain[n] - expected) < 1e-6F);
  }
  /* ghosts are those of what is there now */
  assert_true(*fg__node(level, s.u, -1, 2, 1) == *fg__node(level, s.u, W - 1, 2, 1));
  assert_true(*fg__node(level, s.u, 3, 2, -1) == *fg__node(level, s.u, 3, 2, 1));
  fg__mass_constraint_clear(&masses);
  fg__multigrid_clear(&s.multigrid);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(parts_weigh_what_their_cells_do),
      cmocka_unit_test(what_touches_is_one_part),
      cmocka_unit_test(each_part_gets_its_mean_back),
  };
  return cmocka_run_group_tests_name("solver/subdomain/mass", tests, NULL, NULL);
}
