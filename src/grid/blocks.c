#include "grid/blocks.h"

/* In the time that a node of the finest level takes a cycle: a node of the first whole
 * level (docs/design/distribution.md). */
static const double whole_cost_2d = 0.8, whole_cost_3d = 1.7;

/* And a node of pencils in the time of one of slabs; a ghost, whose 42 bytes a cycle take
 * as long as a node where some nine ranks share a network card (the same page). */
static const double pencil_cost = 1.3, ghost_cost = 1.0;

enum { THICK_CELLS = 8 /* three halvings */ };

static int greatest_divisor_below(int number, int most)
{
  int divisor = most;
  while (divisor > 0 && number % divisor != 0)
    --divisor;
  return divisor;
}

/* The greatest divisor up to the square root. */
static int divisor_near_root(int number)
{
  int root = 1;
  while ((root + 1) <= number / (root + 1))
    ++root;
  return greatest_divisor_below(number, root);
}

/* As many blocks as ranks, at least `thickness` cells thick; false when they do not fit.
 * Slabs along the last axis; or pencils, in 3D, as near to a square as can be, or where
 * one axis is too short for that, more of them along the other. Fewer along y than along
 * z: what is not cut along y is exchanged in whole slices. */
static bool arrange(int count[3], int ranks, int dimension, const int cells[3],
                    int thickness, bool pencils)
{
  int room[3] = {1, 1, 1};
  for (int k = 1; k < dimension; ++k)
    room[k] = cells[k] / thickness;
  count[0] = count[1] = count[2] = 1;
  if (!pencils) {
    count[dimension - 1] = ranks;
    return ranks <= room[dimension - 1];
  }
  count[1] = divisor_near_root(ranks);
  count[2] = ranks / count[1];
  for (int k = 2; k > 0; --k)
    if (count[k] > room[k]) {
      count[k] = greatest_divisor_below(ranks, room[k]);
      count[3 - k] = count[k] > 0 ? ranks / count[k] : 0;
      break;
    }
  return count[1] > 0 && count[1] <= room[1] && count[2] > 0 && count[2] <= room[2];
}

static bool can_be_halved_again(const fg__blocks *blocks, int dimension,
                                const int cells[3], int halvings)
{
  for (int k = 0; k < dimension; ++k) {
    int left = cells[k] >> halvings, unit = blocks->unit >> halvings;
    int thinnest = cells[k] / blocks->unit / blocks->count[k] * blocks->unit;
    if (left % 2 != 0 || left < FG__LEAST_BLOCK_CELLS)
      return false;
    if (blocks->count[k] > 1 &&
        (unit % 2 != 0 || thinnest >> halvings < FG__LEAST_BLOCK_CELLS))
      return false;
  }
  return true;
}

/* Nodes of the first level that is not distributed. */
static double whole_nodes(const fg__blocks *blocks, int dimension, const int cells[3])
{
  int halvings = 0;
  while (can_be_halved_again(blocks, dimension, cells, halvings))
    ++halvings;
  double nodes = 1.0;
  for (int k = 0; k < dimension; ++k)
    nodes *= (cells[k] >> halvings) + 1;
  return nodes;
}

/* Of the rank with most to do, in nodes of the finest level. */
static double cost_of(const fg__blocks *blocks, int dimension, const int cells[3])
{
  double block = 1.0, ghosts = 0.0;
  for (int k = 0; k < dimension; ++k) {
    int count = blocks->count[k], units = cells[k] / blocks->unit;
    int side = count == 1 ? cells[k] : (units + count - 1) / count * blocks->unit;
    block *= side;
    ghosts += count == 1 ? 0.0 : 2.0 / side;
  }
  double whole = dimension == 3 ? whole_cost_3d : whole_cost_2d;
  double node = dimension == 3 && blocks->count[1] > 1 ? pencil_cost : 1.0;
  return (node + ghost_cost * ghosts) * block +
         whole * whole_nodes(blocks, dimension, cells);
}

static bool fits(const fg__blocks *blocks, int dimension, const int cells[3])
{
  for (int k = 0; k < dimension; ++k)
    if (blocks->count[k] > 1 &&
        (cells[k] % blocks->unit != 0 || cells[k] / blocks->unit < blocks->count[k]))
      return false;
  return true;
}

/* The best unit for one arrangement, if it is better than `out` (unit 0: nothing yet). */
static void try_arrangement(fg__blocks *out, double *least, int ranks, int dimension,
                            const int cells[3], bool pencils)
{
  fg__blocks tried = {.unit = THICK_CELLS};
  while (!arrange(tried.count, ranks, dimension, cells, tried.unit, pencils)) {
    tried.unit /= 2;
    if (tried.unit < FG__LEAST_BLOCK_CELLS)
      return;
  }
  do {
    double cost = cost_of(&tried, dimension, cells);
    if (out->unit == 0 || cost < *least) {
      *least = cost;
      *out = tried;
    }
    tried.unit *= 2;
  } while (ranks > 1 && fits(&tried, dimension, cells));
}

static bool choose(fg__blocks *out, int ranks, int dimension, const int cells[3])
{
  double least = 0.0;
  *out = (fg__blocks){.unit = 0};
  try_arrangement(out, &least, ranks, dimension, cells, false);
  if (dimension == 3 && ranks > 1)
    try_arrangement(out, &least, ranks, dimension, cells, true);
  return out->unit > 0;
}

static fg_status refuse(fg_context *context, int ranks, int fitting, int dimension,
                        const int cells[3])
{
  if (dimension == 3)
    return fg__fail(
        context, FG_STATUS_ARGUMENT,
        "%d ranks are too many for a mesh of %d x %d x %d cells: each needs a "
        "block of %d cells along y and z; %d ranks fit",
        ranks, cells[0], cells[1], cells[2], FG__LEAST_BLOCK_CELLS, fitting);
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "%d ranks are too many for a mesh of %d x %d cells: each needs a block "
                  "of %d cells along y; %d ranks fit",
                  ranks, cells[0], cells[1], FG__LEAST_BLOCK_CELLS, fitting);
}

fg_status fg__blocks_choose(fg__blocks *out, fg_context *context, const fg__ranks *ranks,
                            int dimension, const int cells[3], bool may_idle)
{
  int fitting = ranks->count;
  while (!choose(out, fitting, dimension, cells) && fitting > 1)
    --fitting;
  return fitting == ranks->count || may_idle
             ? FG_STATUS_OK
             : refuse(context, ranks->count, fitting, dimension, cells);
}
