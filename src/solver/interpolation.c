#include "solver/interpolation.h"

/* Couplings of a node to its 26 (in 2D 8) neighbours, by offset + 1 along each axis. */
typedef struct star {
  float to[3][3][3];
} star;

static star star_at(const fg__level *level, int i, int j, int k)
{
  star s = {{{{0.0F}}}};
  const fg__layout *at = &level->layout;
  for (int n = 0; n < fg__coupling_count(at->dimension); ++n) {
    int d[3] = {n == 0 ? 1 : (n - 1) % 3 - 1, 0, 0};
    if (n > 0)
      fg__upper_row((n - 1) / 3, &d[1], &d[2]);
    const float *to = level->laplacian.to[n];
    s.to[1 + d[2]][1 + d[1]][1 + d[0]] = to[fg__node_at(at, i, j, k)];
    s.to[1 - d[2]][1 - d[1]][1 - d[0]] =
        to[fg__node_at(at, i - d[0], j - d[1], k - d[2])];
  }
  return s;
}

/* What a node follows through one of its neighbours: `odd` are its odd axes, of which the
 * neighbour, as far away as d says, has one less or more; along even axes d is left out.
 * Weights of the wrong sign, which cells of unequal sides have, do not count. */
static void follow_neighbour(const fg__level *level, const int node[3], int odd,
                             const int d[3], float weight, float share[FG__MOST_CORNERS])
{
  int at[3], own = 0, others = odd;
  for (int k = 0; k < 3; ++k) {
    at[k] = node[k];
    if (!(odd >> k & 1) || d[k] == 0)
      continue;
    at[k] += d[k];
    own |= (d[k] > 0) << k;
    others &= ~(1 << k);
  }
  if (others == odd || !(weight > 0.0F))
    return;
  ptrdiff_t neighbour = fg__node_at(&level->layout, at[0], at[1], at[2]);
  for (int side = 0; side <= others; ++side)
    if ((side & ~others) == 0)
      share[side | own] += weight * level->interpolation[side][neighbour];
}

/* A coarse node for one that none of its couplings leads to: in a corridor of odd nodes.
 * Best is one in the mask, which nothing else follows. */
static int adopt(const fg__level *level, const int node[3], int odd)
{
  for (int side = 0; side <= odd; ++side) {
    int at[3];
    for (int k = 0; k < 3; ++k)
      at[k] = node[k] + (odd >> k & 1 ? (side >> k & 1 ? 1 : -1) : 0);
    if ((side & ~odd) == 0 &&
        !(level->mass[fg__node_at(&level->layout, at[0], at[1], at[2])] > 0.0F))
      return side;
  }
  return 0;
}

static void find_node(const fg__level *level, const int node[3], int odd)
{
  int sides = 1 << level->layout.dimension;
  ptrdiff_t here = fg__node_at(&level->layout, node[0], node[1], node[2]);
  float share[FG__MOST_CORNERS] = {0.0F}, sum = 0.0F;
  int solid = level->layout.dimension == 3;
  star s;
  if (odd != 0)
    s = star_at(level, node[0], node[1], node[2]);
  for (int z = -solid; z <= solid && odd != 0; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        follow_neighbour(level, node, odd, (int[]){x, y, z}, -s.to[1 + z][1 + y][1 + x],
                         share);
  for (int side = 0; side < sides; ++side)
    sum += share[side];
  /* nodes that are coupled to nothing solve their own equations */
  if (odd == 0 || (!(sum > 0.0F) && level->laplacian.center[here] > 0.0F))
    share[odd == 0 ? 0 : adopt(level, node, odd)] = sum = 1.0F;
  for (int side = 0; side < sides; ++side)
    level->interpolation[side][here] = sum > 0.0F ? share[side] / sum : 0.0F;
}

void fg__interpolation_find(const fg__level *level, int stage)
{
  const int *nodes = level->layout.nodes;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i) {
        int odd = (i & 1) | (j & 1) << 1 | (k & 1) << 2;
        if ((i & 1) + (j & 1) + (k & 1) == stage)
          find_node(level, (int[]){i, j, k}, odd);
      }
}

static void swap_ghosts(const fg__level *level, int axis, int ghost)
{
  const fg__layout *at = &level->layout;
  int low[3] = {-1, -1, -1}, high[3];
  for (int k = 0; k < 3; ++k)
    high[k] = at->nodes[k];
  if (at->dimension == 2)
    low[2] = high[2] = 0;
  low[axis] = high[axis] = ghost;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) {
        ptrdiff_t n = fg__node_at(at, i, j, k);
        for (int side = 0; side < 1 << at->dimension; ++side)
          if (side >> axis & 1) {
            float *a = &level->interpolation[side][n];
            float *b = &level->interpolation[side ^ 1 << axis][n];
            float kept = *a;
            *a = *b;
            *b = kept;
          }
      }
}

void fg__interpolation_mirror(const fg__level *level)
{
  for (int axis = 0; axis < level->layout.dimension; ++axis) {
    if (level->boundary[axis][0])
      swap_ghosts(level, axis, -1);
    if (level->boundary[axis][1])
      swap_ghosts(level, axis, level->layout.nodes[axis]);
  }
}
