/* The way in which levels, borders and exchanges make one operator on the whole adaptive
 * mesh: residuals of each level's leaves; those of border nodes passed on to the coarser
 * level by the transpose of interpolation. With integer stiffness all of it is exact. */
#include <stdbool.h>

#include "mesh/refinement.h"
#include "mesh/together_test.h"

enum { MOST_LEVELS = 4, ARRAYS = 1 };

/* One array over the boxes of a partition. */
typedef struct values {
  float **node;
  float *const *array[1];
  fg__layout *layout;
  const fg__box *own;
  int boxes;
} values;

static values values_of(const fg__partition *partition)
{
  values out;
  out.own = fg__own_boxes(partition, &out.boxes);
  out.node = allocate_or_end((size_t)out.boxes, sizeof *out.node);
  out.layout = allocate_or_end((size_t)out.boxes, sizeof *out.layout);
  out.array[0] = out.node;
  for (int b = 0; b < out.boxes; ++b) {
    out.layout[b] = fg__layout_of(partition->dimension, out.own[b].nodes);
    float *memory = allocate_or_end(out.layout[b].array_size, sizeof *memory);
    out.node[b] = memory + out.layout[b].first;
  }
  return out;
}

static void values_clear(values *v)
{
  for (int b = 0; b < v->boxes; ++b)
    free(v->node[b] - v->layout[b].first);
  free(v->node);
  free(v->layout);
}

typedef struct level {
  values u, residual, half;
  fg__partition half_partition;
  fg__exchange *ghosts, *from_coarser, *to_coarser;
  fg__border *border;
  unsigned char **kind;   /* of cells, by own box */
  unsigned char **inside; /* 1 for nodes that are not on the border, by own box */
  unsigned char **leaf;   /* 1 for those with a leaf's cell beside them */
} level;

static size_t node_number(const fg__box *box, int i, int j, int k)
{
  return ((size_t)k * (size_t)box->nodes[1] + (size_t)j) * (size_t)box->nodes[0] +
         (size_t)i;
}

#define FOR_NODES(box)                                                                   \
  for (int k = 0; k < (box)->nodes[2]; ++k)                                              \
    for (int j = 0; j < (box)->nodes[1]; ++j)                                            \
      for (int i = 0; i < (box)->nodes[0]; ++i)

/* Kinds of cells, and which nodes have none outside beside them. */
static void find_cells(level *l, const fg__mesh *mesh, int n)
{
  l->kind = allocate_or_end((size_t)l->u.boxes, sizeof *l->kind);
  l->inside = allocate_or_end((size_t)l->u.boxes, sizeof *l->inside);
  l->leaf = allocate_or_end((size_t)l->u.boxes, sizeof *l->leaf);
  for (int b = 0; b < l->u.boxes; ++b) {
    const fg__box *box = &l->u.own[b];
    size_t width = (size_t)box->nodes[0] + 1, height = (size_t)box->nodes[1] + 1;
    l->kind[b] = allocate_or_end(width * height * ((size_t)box->nodes[2] + 1), 1);
    l->inside[b] = allocate_or_end((size_t)fg__box_count(box), 1);
    l->leaf[b] = allocate_or_end((size_t)fg__box_count(box), 1);
    fg__cell_kinds(l->kind[b], mesh, n, box);
    FOR_NODES(box)
    {
      bool inside = true, leaf = false;
      for (int corner = 0; corner < 1 << mesh->dimension; ++corner) {
        size_t x = (size_t)i + (corner & 1), y = (size_t)j + (corner >> 1 & 1);
        size_t z = (size_t)k + (corner >> 2 & 1);
        int kind = l->kind[b][(z * height + y) * width + x];
        inside = inside && kind != FG__CELL_OUTSIDE;
        leaf = leaf || kind == FG__CELL_LEAF;
      }
      l->leaf[b][node_number(box, i, j, k)] = leaf;
      l->inside[b][node_number(box, i, j, k)] = inside;
    }
  }
}

static void level_create(level *l, const fg__mesh *mesh, int n)
{
  l->u = values_of(&mesh->level[n]);
  l->residual = values_of(&mesh->level[n]);
  find_cells(l, mesh, n);
  expect(fg__exchange_create(&l->ghosts, us.context, &mesh->level[n], ARRAYS) ==
         FG_STATUS_OK);
  expect(fg__border_create(&l->border, us.context, mesh, n, ARRAYS) == FG_STATUS_OK);
  expect(fg__partition_coarsen(&l->half_partition, us.context, &mesh->level[n]) ==
         FG_STATUS_OK);
  l->half = values_of(&l->half_partition);
  if (n + 1 == mesh->level_count)
    return;
  const fg__partition *coarser = &mesh->level[n + 1];
  expect(fg__exchange_create_between(&l->from_coarser, us.context, coarser,
                                     &l->half_partition, FG__NODES_AND_GHOSTS,
                                     ARRAYS) == FG_STATUS_OK);
  expect(fg__exchange_create_between(&l->to_coarser, us.context, &l->half_partition,
                                     coarser, FG__NODES, ARRAYS) == FG_STATUS_OK);
}

static void level_clear(level *l)
{
  for (int b = 0; b < l->u.boxes; ++b) {
    free(l->kind[b]);
    free(l->inside[b]);
    free(l->leaf[b]);
  }
  free(l->kind);
  free(l->inside);
  free(l->leaf);
  values_clear(&l->u);
  values_clear(&l->residual);
  values_clear(&l->half);
  fg__partition_clear(&l->half_partition);
  fg__exchange_destroy(l->ghosts);
  fg__exchange_destroy(l->from_coarser);
  fg__exchange_destroy(l->to_coarser);
  fg__border_destroy(l->border);
}

/* The Laplacian's stiffness of a cell between corners that differ along `axes` axes,
 * times 6 in 2D and 12 in 3D, where it grows with the width of the cells. */
static float stiffness(int dimension, int n, int axes)
{
  static const float SQUARE[4] = {4.0F, -1.0F, -2.0F, 0.0F};
  static const float CUBE[4] = {4.0F, 0.0F, -1.0F, -1.0F};
  return dimension == 2 ? SQUARE[axes] : CUBE[axes] * (float)(1 << n);
}

/* Residual of the leaves' cells round a node. Cells that are images (beyond the domain's
 * natural borders) count like others: what is tested lies inside. */
static float residual_at(const level *l, const fg__mesh *mesh, int n, int b, int i, int j,
                         int k)
{
  const fg__box *box = &l->u.own[b];
  size_t width = (size_t)box->nodes[0] + 1, height = (size_t)box->nodes[1] + 1;
  int corners = 1 << mesh->dimension;
  float sum = 0.0F;
  for (int cell = 0; cell < corners; ++cell) {
    int x = i - (cell & 1), y = j - (cell >> 1 & 1), z = k - (cell >> 2 & 1);
    size_t at =
        ((size_t)(z + (mesh->dimension == 3)) * height + (size_t)(y + 1)) * width +
        (size_t)(x + 1);
    if (l->kind[b][at] != FG__CELL_LEAF)
      continue;
    for (int other = 0; other < corners; ++other) {
      int differing = cell ^ other;
      int axes = (differing & 1) + (differing >> 1 & 1) + (differing >> 2 & 1);
      ptrdiff_t node = fg__node_at(&l->u.layout[b], x + (other & 1), y + (other >> 1 & 1),
                                   z + (other >> 2 & 1));
      sum += stiffness(mesh->dimension, n, axes) * l->u.node[b][node];
    }
  }
  return sum;
}

/* The transpose of interpolation at a node of a half: what the box's nodes and ghosts
 * round node 2 i hand on to it. */
static float restricted(const values *fine, int b, int dimension, int i, int j, int k)
{
  float sum = 0.0F;
  int depth = dimension == 3;
  for (int z = -depth; z <= depth; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        sum += fine->node[b][fg__node_at(&fine->layout[b], 2 * i + x, 2 * j + y,
                                         2 * k + z)] /
               (float)(1 << (x * x + y * y + z * z));
  return sum;
}

/* Takes from each border node its residual and hands it on to the coarser level. */
static void hand_on(level *fine, level *coarse, const fg__mesh *mesh,
                    const fg__partition *coarser)
{
  values handed = values_of(coarser);
  float *const *const *residual = fine->residual.array;
  values only_border = fine->residual; /* in place: inner nodes are done with */
  for (int b = 0; b < only_border.boxes; ++b)
    FOR_NODES(&only_border.own[b])
    {
      if (fine->inside[b][node_number(&only_border.own[b], i, j, k)])
        only_border.node[b][fg__node_at(&only_border.layout[b], i, j, k)] = 0.0F;
    }
  fg__exchange_fill(fine->ghosts, 1, residual, FG__ALL_COLOURS);
  for (int b = 0; b < fine->half.boxes; ++b)
    FOR_NODES(&fine->half.own[b])
    {
      fine->half.node[b][fg__node_at(&fine->half.layout[b], i, j, k)] =
          restricted(&fine->residual, b, mesh->dimension, i, j, k);
    }
  fg__exchange_fill_between(fine->to_coarser, 1, fine->half.array, handed.array,
                            FG__ALL_COLOURS);
  for (int b = 0; b < handed.boxes; ++b)
    FOR_NODES(&handed.own[b])
    {
      ptrdiff_t at = fg__node_at(&handed.layout[b], i, j, k);
      coarse->residual.node[b][at] += handed.node[b][at];
    }
  values_clear(&handed);
}

typedef float function(const fg__mesh *mesh, int n, const int node[3]);

/* Linear along natural axes, in units of the finest cells. */
static float linear(const fg__mesh *mesh, int n, const int node[3])
{
  static const float SLOPE[3] = {1.0F, -3.0F, 2.0F};
  float value = 5.0F;
  for (int k = 0; k < 3; ++k) /* node[2] is 0 in 2D */
    value += mesh->periodic[k] ? 0.0F : SLOPE[k] * (float)(node[k] << n);
  return value;
}

/* Small whole numbers without a pattern; the same place has others on other levels. */
static float rough(const fg__mesh *mesh, int n, const int node[3])
{
  (void)mesh;
  unsigned x = (unsigned)(node[0] + 131 * node[1] + 17161 * node[2] + 7 * n);
  x = (x ^ (x >> 7)) * 2654435761U;
  return (float)(int)(x >> 26) - 32.0F;
}

/* Only independent nodes get values: what follows from others, or lies below finer
 * leaves, must not matter. */
static void set_values(level *l, const fg__mesh *mesh, int n, function *value)
{
  for (int b = 0; b < l->u.boxes; ++b) {
    const int *first = l->u.own[b].first;
    FOR_NODES(&l->u.own[b])
    {
      size_t number = node_number(&l->u.own[b], i, j, k);
      int node[3] = {first[0] + i, first[1] + j, first[2] + k};
      bool independent = l->inside[b][number] && l->leaf[b][number];
      l->u.node[b][fg__node_at(&l->u.layout[b], i, j, k)] =
          independent ? value(mesh, n, node) : 999.0F;
    }
  }
}

/* Values on all levels, borders interpolated from the coarsest down; residuals from the
 * finest up. `inner` sees each level when its inner nodes have all that they get. */
typedef void on_inner(const level *l, const fg__mesh *mesh, int n, void *data);

static void compose(const fg__mesh *mesh, function *value, on_inner *inner, void *data)
{
  level l[MOST_LEVELS] = {0};
  int last = mesh->level_count - 1;
  for (int n = last; n >= 0; --n) {
    level_create(&l[n], mesh, n);
    set_values(&l[n], mesh, n, value);
    if (n < last) {
      fg__exchange_fill_between(l[n].from_coarser, 1, l[n + 1].u.array, l[n].half.array,
                                FG__ALL_COLOURS);
      fg__border_interpolate(l[n].border, 1, l[n].half.array, l[n].u.array);
    }
    fg__exchange_fill(l[n].ghosts, 1, l[n].u.array, FG__ALL_COLOURS);
    for (int b = 0; b < l[n].u.boxes; ++b)
      FOR_NODES(&l[n].u.own[b])
      {
        l[n].residual.node[b][fg__node_at(&l[n].u.layout[b], i, j, k)] =
            residual_at(&l[n], mesh, n, b, i, j, k);
      }
  }
  for (int n = 0; n <= last; ++n) {
    inner(&l[n], mesh, n, data);
    if (n < last)
      hand_on(&l[n], &l[n + 1], mesh, &mesh->level[n + 1]);
  }
  for (int n = 0; n <= last; ++n)
    level_clear(&l[n]);
}

static bool is_at_natural_border(const fg__mesh *mesh, int n, const int node[3])
{
  for (int k = 0; k < 3; ++k)
    if (k < mesh->dimension && !mesh->periodic[k] &&
        (node[k] == 0 || node[k] == mesh->cells[k] >> n))
      return true;
  return false;
}

static void is_zero_inside(const level *l, const fg__mesh *mesh, int n, void *data)
{
  (void)data;
  for (int b = 0; b < l->u.boxes; ++b)
    FOR_NODES(&l->u.own[b])
    {
      const int *first = l->u.own[b].first;
      int node[3] = {first[0] + i, first[1] + j, first[2] + k};
      if (l->inside[b][node_number(&l->u.own[b], i, j, k)] &&
          !is_at_natural_border(mesh, n, node))
        expect(l->residual.node[b][fg__node_at(&l->u.layout[b], i, j, k)] == 0.0F);
    }
}

/* Twice the domain's cells lie beyond a natural border, so a node there counts half. */
static void add_up(const level *l, const fg__mesh *mesh, int n, void *data)
{
  for (int b = 0; b < l->u.boxes; ++b)
    FOR_NODES(&l->u.own[b])
    {
      double share = 1.0;
      for (int axis = 0; axis < mesh->dimension; ++axis) {
        int node = l->u.own[b].first[axis] + (axis == 0 ? i : axis == 1 ? j : k);
        if (!mesh->periodic[axis] && (node == 0 || node == mesh->cells[axis] >> n))
          share *= 0.5;
      }
      if (l->inside[b][node_number(&l->u.own[b], i, j, k)])
        *(double *)data +=
            share * (double)l->residual.node[b][fg__node_at(&l->u.layout[b], i, j, k)];
    }
}

/* A mesh with small leaves about a ball. */
static fg__mesh mesh_about(int dimension, const bool periodic[3], const double center[3],
                           double radius)
{
  fg__mesh_description description = {.dimension = dimension,
                                      .side = {1.0, 1.0, 1.0},
                                      .nodes = dimension == 2 ? 65 : 33,
                                      .patch_cells = 4,
                                      .refinements = dimension == 2 ? 3 : 2};
  for (int k = 0; k < 3; ++k)
    description.periodic[k] = periodic[k];
  fg__mesh mesh;
  if (fg__mesh_create(&mesh, us.context, &description) != FG_STATUS_OK)
    abort();
  for (int round = 0; round < 3; ++round) {
    signed char *wanted = allocate_or_end((size_t)mesh.leaf_count, 1);
    for (int n = 0; n < mesh.leaf_count; ++n) {
      double square = 0.0, half = 0.5 * mesh.leaf[n].side * mesh.patch_cells;
      for (int k = 0; k < dimension; ++k) {
        double d = mesh.leaf[n].first[k] * mesh.patch_cells + half - center[k];
        square += d * d;
      }
      wanted[n] = square < (radius + half) * (radius + half)
                      ? 0
                      : (signed char)(mesh.level_count - 1);
    }
    fg__mesh adapted;
    if (fg__mesh_adapt(&adapted, us.context, &mesh, wanted) != FG_STATUS_OK)
      abort();
    free(wanted);
    fg__mesh_clear(&mesh);
    mesh = adapted;
  }
  return mesh;
}

typedef void check(const fg__mesh *mesh);

static void for_all_meshes(check *holds)
{
  static const struct {
    int dimension;
    bool periodic[3];
    double center[3], radius;
  } cases[] = {
      {2, {false, false, false}, {20.0, 37.0, 0.0}, 9.0},
      {2, {true, false, false}, {1.0, 60.0, 0.0}, 13.0},
      {2, {false, true, false}, {64.0, 33.0, 0.0}, 5.0},
      {3, {false, false, false}, {13.0, 22.0, 9.0}, 3.0},
      {3, {true, false, true}, {31.0, 10.0, 2.0}, 6.0},
  };
  for (int n = 0; n < 5; ++n) {
    fg__mesh mesh = mesh_about(cases[n].dimension, cases[n].periodic, cases[n].center,
                               cases[n].radius);
    uint64_t leaves[2] = {0};
    for (int l = 0; l < mesh.leaf_count; ++l)
      ++leaves[mesh.leaf[l].side > 1];
    fg__ranks_add(us.ranks, leaves, 2);
    expect(leaves[0] > 0 && leaves[1] > 0);
    holds(&mesh);
    fg__mesh_clear(&mesh);
  }
}

static void passes_the_patch_test(const fg__mesh *mesh)
{
  compose(mesh, linear, is_zero_inside, NULL);
}

static void a_linear_function_has_no_residual(void **state)
{
  (void)state;
  for_all_meshes(passes_the_patch_test);
  end_together();
}

static void conserves(const fg__mesh *mesh)
{
  double sum = 0.0;
  compose(mesh, rough, add_up, &sum);
  /* whole multiples of 1/64: exact in any order */
  uint64_t whole = (uint64_t)(int64_t)(64.0 * sum);
  fg__ranks_add(us.ranks, &whole, 1);
  expect(whole == 0);
}

/* Whatever the function: no flux is lost between levels. */
static void residuals_add_up_to_nothing(void **state)
{
  (void)state;
  for_all_meshes(conserves);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(a_linear_function_has_no_residual),
      TOGETHER(residuals_add_up_to_nothing),
  };
  return cmocka_run_group_tests_name("mesh/composite", tests, NULL, NULL);
}
