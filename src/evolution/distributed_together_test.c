/* Steps taken by several ranks together are those of one rank, to the bit. */
#include "grid/together_test.h"

#include <math.h>
#include <string.h>

#include "component/clusters.h"
#include "evolution/stepper.h"
#include "field/noise.h"
#include "solver/cells/field_boxes.h"
#include "solver/multigrid_test.h"

enum {
  STEPS = 5,
  THETA_STEPS = 3 /* of three substeps */,
  CYCLES = 2,
  SAMPLES = 33,
  MOST_PARTS = 256
};

typedef struct subject {
  const char *field;
  int dimension, nodes;
  fg__splitting splitting; /* its alpha 0: implicit */
  double residual;
  bool (*missing)(double x, double y, double z); /* on the unit square or cube, or NULL */
  int parts;                                     /* of what is left */
} subject;

/* What is compared, of the whole grid on every rank. */
typedef struct outcome {
  size_t nodes;
  float *u;
  double energy[STEPS], tau[STEPS], mass[STEPS];
  int clusters;
  double covered;
  int parts, subdomains, solved; /* nodes of subdomains */
  double mean[MOST_PARTS];       /* of u in each part, held */
} outcome;

typedef struct run {
  fg_field *field;
  fg__mesh mesh;
  fg__tensor_recipe recipe;
  fg__stepper stepper;
  double gamma;
  unsigned char *active; /* of the whole */
} run;

/* A wall across the domain, thinner than a coarse cell, and a moat round an island. */
static bool wall_and_moat(double x, double y, double z)
{
  (void)z;
  double r = hypot(x - 0.7, y - 0.45);
  return fabs(x - 0.4 - 0.1 * y) < 0.025 || (r > 0.1 && r < 0.16) || y > 0.94;
}

/* Columns: most ranks' boundaries are crossed by each part. */
static bool slats(double x, double y, double z)
{
  (void)y;
  (void)z;
  return fmod(x, 0.25) > 0.19;
}

/* A floor with a wall on it that is open at no side. */
static bool rooms(double x, double y, double z)
{
  return fabs(z - 0.46) < 0.04 || (z > 0.46 && fabs(x - 0.55) < 0.04) ||
         hypot(x - 0.2, y - 0.3) < 0.1;
}

/* Round the corner of a periodic cube, and so in eight pieces. */
static bool shell(double x, double y, double z)
{
  double r = sqrt(pow(fmin(x, 1.0 - x), 2.0) + pow(fmin(y, 1.0 - y), 2.0) +
                  pow(fmin(z, 1.0 - z), 2.0));
  return r > 0.27 && r < 0.36;
}

/* Many parts of few nodes, also across a period; in 2D too many to take them all. */
static bool bars(double x, double y, double z)
{
  return fmod(x + 0.07, 0.2) > 0.13 || fmod(y + 0.1 + 0.2 * x, 0.25) > 0.18 || z > 2.0;
}

static bool cages(double x, double y, double z)
{
  return fmod(x + 0.07, 0.2) > 0.07 || fmod(y + 0.02, 0.25) > 0.09 ||
         fmod(z + 0.11, 0.25) > 0.09;
}

static fg_field *field_of(const subject *s)
{
  fg_field *whole, *field;
  expect(fg_field_create_analytic(&whole, us.context, s->field, SAMPLES) == FG_STATUS_OK);
  if (!s->missing)
    return whole;
  fg_field_arrays arrays = *fg_field_contents(whole);
  size_t count = (size_t)arrays.size[0] * (size_t)arrays.size[1];
  if (s->dimension == 3)
    count *= (size_t)arrays.size[2];
  unsigned char *valid = allocate_or_end(count, 1);
  for (size_t n = 0; n < count; ++n) {
    size_t row = n / (size_t)arrays.size[0];
    size_t i = n % (size_t)arrays.size[0], j = row % (size_t)arrays.size[1];
    double z = s->dimension == 3 ? arrays.axis[2][row / (size_t)arrays.size[1]] : 0.0;
    valid[n] = !s->missing(arrays.axis[0][i], arrays.axis[1][j], z);
  }
  arrays.valid = valid;
  expect(fg_field_create(&field, us.context, &arrays) == FG_STATUS_OK);
  fg_field_destroy(whole);
  free(valid);
  return field;
}

static double volume_of(const fg__mesh *mesh)
{
  double volume = 1.0;
  for (int k = 0; k < mesh->dimension; ++k)
    volume *= mesh->spacing[k];
  return volume;
}

static void describe(run *r, const subject *s, const fg__ranks *ranks)
{
  r->field = field_of(s);
  fg__mesh_description description = {
      .dimension = s->dimension, .nodes = s->nodes, .ranks = ranks};
  const fg_field_arrays *arrays = fg_field_contents(r->field);
  for (int k = 0; k < s->dimension; ++k) {
    description.side[k] = 1.0;
    description.periodic[k] = arrays->period[k] > 0.0;
  }
  expect(fg__mesh_create(&r->mesh, us.context, &description) == FG_STATUS_OK);
  double h = r->mesh.spacing[0];
  r->gamma = 1.21 * h * h / 0.15 * fg__theta_held(s->splitting);
  r->recipe = (fg__tensor_recipe){.field = r->field,
                                  .law = &fg__law_flow,
                                  .anisotropy = 0.15,
                                  .width = 2.0 * h,
                                  .dimension = s->dimension,
                                  .cells = {1, 1, 1}};
  for (int k = 0; k < s->dimension; ++k) {
    r->recipe.cells[k] = r->mesh.cells[k];
    r->recipe.periodic[k] = r->mesh.periodic[k];
    r->recipe.spacing[k] = r->mesh.spacing[k];
  }
}

static void fill(run *r, fg__multigrid *multigrid)
{
  fg__noise noise = fg__noise_of(r->mesh.dimension, r->mesh.cells, r->mesh.spacing,
                                 r->mesh.periodic, -0.4, 1.5, r->mesh.spacing[0], 3);
  const fg__layout *at = &fg__multigrid_finest(multigrid)->layout;
  const fg__box *place = fg__own_block(&r->mesh.partition);
  float *u = fg__multigrid_u(multigrid);
  float *row = allocate_or_end((size_t)at->nodes[0], sizeof *row);
  for (int k = 0; k < at->nodes[2]; ++k)
    for (int j = 0; j < at->nodes[1]; ++j) {
      fg__noise_row(&noise, place->first[1] + j, place->first[2] + k, place->first[0],
                    at->nodes[0], row);
      for (int i = 0; i < at->nodes[0]; ++i)
        u[fg__node_at(at, i, j, k)] = row[i];
    }
  free(row);
  fg__pass_shift(multigrid, u, 0.0); /* 0 where there is no mass */
  fg__pass_fill_ghosts(multigrid, u);
}

/* One block: everything by the plain engine. */
static void create_whole(run *r, fg__multigrid *multigrid)
{
  size_t cells = 1;
  fg__cells all = {.dimension = r->mesh.dimension};
  for (int k = 0; k < r->mesh.dimension; ++k) {
    cells *= (size_t)r->mesh.cells[k];
    all.count[k] = r->mesh.cells[k];
    all.spacing[k] = r->mesh.spacing[k];
  }
  fg__tensor t = {.active = allocate_or_end(cells, 1)};
  float **components[] = {&t.xx, &t.xy, &t.yy, &t.zz, &t.xz, &t.yz};
  for (int n = 0; n < (r->mesh.dimension == 3 ? 6 : 3); ++n)
    *components[n] = allocate_or_end(cells, sizeof(float));
  expect(fg__tensor_fill(&t, us.context, r->field, &fg__law_flow, 0.15, &all, NULL) ==
         FG_STATUS_OK);
  expect(fg__tensor_smooth(&t, us.context, 0.15, &all, r->mesh.periodic, r->recipe.width,
                           NULL) == FG_STATUS_OK);
  expect(multigrid_of_tensor(multigrid, us.context, &r->mesh, &t, r->gamma, NULL) ==
         FG_STATUS_OK);
  for (int n = 0; n < 6; ++n)
    free(*components[n]);
  r->active = t.active;
}

/* A block a rank, each from the recipe. */
static void create_blocks(const run *r, fg__multigrid *multigrid, bool masked)
{
  fg__wide_tensor wide = {0};
  fg__cells_of_box cells;
  expect(fg__cells_for_box(&cells, us.context, &r->recipe,
                           fg__own_block(&r->mesh.partition), &wide,
                           NULL) == FG_STATUS_OK);
  expect(fg__multigrid_create(multigrid, us.context, &r->mesh, &cells, masked, r->gamma,
                              NULL) == FG_STATUS_OK);
}

static void gather(const run *r, outcome *out)
{
  const fg__multigrid *m = &r->stepper.multigrid;
  float *plain = allocate_or_end(out->nodes, sizeof *plain);
  out->u = plain;
  if (m->distributed_count == 0) {
    fg__level_export(&m->level[0], r->stepper.current, plain);
    return;
  }
  fg__layout layout = fg__layout_of(r->mesh.dimension, r->mesh.partition.nodes);
  float *whole = allocate_or_end(layout.array_size, sizeof *whole);
  fg__gather *plan;
  expect(fg__gather_create(&plan, us.context, &m->distributed[0].partition, 1) ==
         FG_STATUS_OK);
  float *const from = r->stepper.current, *const to = whole + layout.first;
  fg__gather_fill(plan, 1, &from, &to);
  for (int k = 0; k < layout.nodes[2]; ++k)
    for (int j = 0; j < layout.nodes[1]; ++j)
      for (int i = 0; i < layout.nodes[0]; ++i)
        *plain++ = to[fg__node_at(&layout, i, j, k)];
  fg__gather_destroy(plan);
  free(whole);
}

static void count(const run *r, outcome *out)
{
  const fg__multigrid *m = &r->stepper.multigrid;
  ptrdiff_t origin;
  const fg__level *block = fg__multigrid_finest(m);
  unsigned char *active = block->mass ? fg__cells_mask(&block->tensor, &origin) : NULL;
  const fg__cluster_grid grid = {.partition = &m->partition,
                                 .layout = &block->layout,
                                 .active = active ? active + origin : NULL,
                                 .cell_row = block->tensor.row,
                                 .cell_plane = block->tensor.plane};
  const fg__cluster_request request = {.counting = true, .debris_area = 3.0};
  fg__clusters c = {0};
  expect(fg__clusters_find(&c, us.context, &grid, r->stepper.current, &request) ==
         FG_STATUS_OK);
  out->clusters = c.found.count;
  out->covered = c.covered;
  fg__clusters_clear(&c);
  free(active);
}

/* A step of the subdomains alone, long enough to be worth it. */
static int step_subdomains(fg__stepper *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  int solved = 0;
  fg__pass_copy(m, s->current, fg__multigrid_u(m));
  fg__pass_copy(m, s->current, fg__multigrid_p(m));
  fg__subdomains_solve(&s->subdomains, m, tau, tau, s->current, true);
  fg__subdomains_apply(&s->subdomains, m, s->first_iterate);
  fg__pass_copy(m, fg__multigrid_u(m), s->current);
  for (int n = 0; n < s->subdomains.nodes; ++n)
    solved += s->subdomains.done[n];
  return solved;
}

static outcome outcome_of(const subject *s, const fg__ranks *ranks)
{
  run r = {0};
  outcome out = {.nodes = 1};
  fg__multigrid multigrid;
  describe(&r, s, ranks);
  for (int k = 0; k < 3; ++k)
    out.nodes *= (size_t)r.mesh.partition.nodes[k];
  if (r.mesh.ranks->count == 1)
    create_whole(&r, &multigrid);
  else
    create_blocks(&r, &multigrid, s->missing);
  fill(&r, &multigrid);
  double h = r.mesh.spacing[0];
  fg__stepper_description description = {.cell_volume = volume_of(&r.mesh),
                                         .first_tau = 0.05 * h * h,
                                         .most_tau = 1e3 * h * h,
                                         .accuracy = 0.05,
                                         .cycles = CYCLES,
                                         .residual = s->residual,
                                         .splitting = s->splitting};
  expect(fg__stepper_create(&r.stepper, us.context, &multigrid, &description) ==
         FG_STATUS_OK);
  const fg__mass_constraint *masses = &r.stepper.masses;
  out.parts = masses->count;
  out.subdomains = r.stepper.subdomains.count;
  expect(out.parts <= MOST_PARTS);
  for (int n = 0; n < MOST_PARTS && out.parts > 1 && n < out.parts; ++n)
    out.mean[n] = masses->mean[n];
  for (int n = 0; n < (s->splitting.alpha > 0.0 ? THETA_STEPS : STEPS); ++n) {
    expect(fg__stepper_advance(&r.stepper, us.context) == FG_STATUS_OK);
    out.energy[n] = r.stepper.energy;
    out.tau[n] = r.stepper.last_tau;
    out.mass[n] = r.stepper.mass;
  }
  out.solved = step_subdomains(&r.stepper, 1e4 * h * h);
  gather(&r, &out);
  count(&r, &out);
  fg__stepper_clear(&r.stepper);
  fg__mesh_clear(&r.mesh);
  fg_field_destroy(r.field);
  free(r.active);
  return out;
}

/* Four ranks share a cube of 33 nodes as slabs, of 17 as pencils. */
#define IMPLICIT                                                                         \
  {                                                                                      \
    0.0, 0.0                                                                             \
  }
#define THETA                                                                            \
  {                                                                                      \
    0.2928932188, 0.5857864376                                                           \
  }
static const subject SUBJECTS[] = {{"vortex3", 2, 65, IMPLICIT, 0.0, NULL, 1},
                                   {"benard", 2, 129, IMPLICIT, 1e-3, NULL, 1},
                                   {"vortex3d", 3, 33, IMPLICIT, 0.0, NULL, 1},
                                   {"abc", 3, 17, IMPLICIT, 1e-4, NULL, 1},
                                   {"benard", 2, 65, THETA, 0.0, NULL, 1},
                                   {"abc", 3, 33, THETA, 0.0, NULL, 1},
                                   {"vortex3", 2, 65, IMPLICIT, 0.0, wall_and_moat, 3},
                                   {"vortex", 2, 129, IMPLICIT, 1e-2, slats, 4},
                                   {"vortex3", 2, 65, {0.4, 1.0}, 0.0, slats, 4},
                                   {"vortex3d", 3, 33, IMPLICIT, 0.0, rooms, 3},
                                   {"abc", 3, 33, IMPLICIT, 0.0, shell, 2},
                                   {"vortex3d", 3, 17, IMPLICIT, 0.0, rooms, 3},
                                   {"vortex3d", 3, 17, {0.2, 1.0}, 1e-2, NULL, 1},
                                   {"benard", 2, 65, IMPLICIT, 0.0, bars, 27},
                                   {"abc", 3, 33, IMPLICIT, 0.0, cages, 80}};

static void compare(const subject *s, const outcome *one, const outcome *all)
{
  expect(memcmp(one->energy, all->energy, sizeof one->energy) == 0);
  expect(memcmp(one->tau, all->tau, sizeof one->tau) == 0);
  expect(memcmp(one->mass, all->mass, sizeof one->mass) == 0);
  expect(memcmp(one->u, all->u, one->nodes * sizeof *one->u) == 0);
  expect(one->clusters > 0 && one->clusters == all->clusters);
  expect(one->covered == all->covered);
  expect(one->parts == s->parts && all->parts == s->parts);
  expect(all->subdomains == one->subdomains);
  expect(one->parts < 20 || (one->subdomains > 10 && one->solved > 50));
  expect(one->solved == all->solved);
  expect(memcmp(one->mean, all->mean, sizeof one->mean) == 0);
  expect(one->energy[THETA_STEPS - 1] < one->energy[0]);
}

/* Every rank has the whole of it then. */
static bool same_on_all(const outcome *all)
{
  const unsigned char *byte = (const unsigned char *)all->u;
  uint64_t sum = 0;
  for (size_t n = 0; n < all->nodes * sizeof *all->u; ++n)
    sum = (sum ^ byte[n]) * 0x100000001b3U; /* Fowler, Noll, Vo (1991) */
  double numbers[] = {all->covered, all->energy[THETA_STEPS - 1], all->tau[1],
                      all->mass[1]};
  for (size_t n = 0; n < sizeof numbers / sizeof *numbers; ++n) {
    uint64_t bits;
    memcpy(&bits, &numbers[n], sizeof bits);
    sum = (sum ^ bits) * 0x100000001b3U;
  }
  return fg__ranks_alike(us.ranks, sum + (uint64_t)all->clusters);
}

/* Each subject is taken alone by one of the ranks, while others take others. One rank has
 * nothing but itself to be compared with: it takes few. */
static void many_ranks_do_what_one_does(void **state)
{
  (void)state;
  enum { COUNT = sizeof SUBJECTS / sizeof *SUBJECTS, FEW = 2 };
  static outcome one[COUNT];
  const int count = us.ranks->count > 1 ? COUNT : FEW;
  for (int n = us.ranks->rank; n < count; n += us.ranks->count)
    one[n] = outcome_of(&SUBJECTS[n], &fg__single_rank);
  for (int n = 0; n < count; ++n) {
    outcome all = outcome_of(&SUBJECTS[n], us.ranks);
    expect(same_on_all(&all));
    if (one[n].u)
      compare(&SUBJECTS[n], &one[n], &all);
    free(one[n].u);
    free(all.u);
  }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(many_ranks_do_what_one_does),
  };
  return cmocka_run_group_tests_name("evolution/distributed", tests, NULL, NULL);
}
