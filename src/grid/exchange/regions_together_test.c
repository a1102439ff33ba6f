#include "grid/exchange/regions.h"

#include "grid/grids_test.h"

enum { SEEDS = 10, REGIONS = 20, PAD = 3 };

/* A whole number for each node, in 8 bytes or in 1. */
static uint64_t number_at(const int node[3])
{
  return (uint64_t)(node[0] + 1000 * (node[1] + 1000 * node[2]));
}

static void set_element(unsigned char *to, size_t size, const int node[3])
{
  uint64_t number = number_at(node);
  if (size == sizeof number)
    *(uint64_t *)(void *)to = number;
  else
    *to = (unsigned char)(number % 251);
}

static bool is_element(const unsigned char *at, size_t size, const int node[3])
{
  uint64_t number = number_at(node);
  return size == sizeof number ? *(const uint64_t *)(const void *)at == number
                               : *at == (unsigned char)(number % 251);
}

/* The own block with a pad round it, so that rows and planes are longer than the block.
 */
typedef struct padded {
  void *memory;
  fg__region_source source;
} padded;

static padded padded_block(const fg__partition *partition, size_t size)
{
  const fg__box *own = fg__own_block(partition);
  const int *nodes = own->nodes;
  padded out = {.source = {.size = size, .row = nodes[0] + PAD}};
  ptrdiff_t row = out.source.row, plane = out.source.plane = row * (nodes[1] + PAD);
  unsigned char *memory = out.memory =
      allocate_or_end((size_t)plane * (size_t)(nodes[2] + 1), size);
  unsigned char *first = memory + (size_t)(row + 1) * size;
  out.source.first = first;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        set_element(first + (size_t)(i + j * row + k * plane) * size, size,
                    (int[3]){own->first[0] + i, own->first[1] + j, own->first[2] + k});
  return out;
}

/* Along a periodic axis it may begin before the grid and end behind it. */
static fg__region region_at_random(const grid *g, uint64_t *seed)
{
  fg__region out = {.rank = (int)random_below(seed, (unsigned)us.ranks->count)};
  for (int k = 0; k < 3; ++k) {
    unsigned nodes = (unsigned)nodes_along(g, k);
    unsigned width = 1 + random_below(seed, nodes);
    bool periodic = k < g->dimension && g->periodic[k];
    unsigned room = periodic ? 2 * nodes : nodes - width + 1;
    out.nodes.nodes[k] = (int)width;
    out.nodes.first[k] = (int)random_below(seed, room) - (periodic ? (int)width - 1 : 0);
    if (periodic && out.nodes.first[k] + (int)width > 2 * (int)nodes)
      out.nodes.first[k] = 0;
  }
  return out;
}

static void check_region(const grid *g, const fg__region *region,
                         const unsigned char *array, size_t size)
{
  const fg__box *box = &region->nodes;
  for (int k = 0; k < box->nodes[2]; ++k)
    for (int j = 0; j < box->nodes[1]; ++j)
      for (int i = 0; i < box->nodes[0]; ++i, array += size) {
        const int at[3] = {i, j, k};
        int node[3];
        for (int axis = 0; axis < 3; ++axis) {
          int nodes = nodes_along(g, axis);
          node[axis] = (box->first[axis] + at[axis] + 2 * nodes) % nodes;
        }
        expect(is_element(array, size, node));
      }
}

static void check_grid(const grid *g, uint64_t seed, size_t size)
{
  fg__partition partition = divide_at_random(g, seed, 1);
  padded own = padded_block(&partition, size);
  fg__region region[REGIONS];
  void *out[REGIONS] = {0};
  for (int n = 0; n < REGIONS; ++n) {
    region[n] = region_at_random(g, &seed);
    if (region[n].rank == us.ranks->rank)
      out[n] = allocate_or_end((size_t)fg__box_count(&region[n].nodes), size);
  }
  expect(fg__regions_fill(us.context, &partition, region, REGIONS, &own.source, out) ==
         FG_STATUS_OK);
  for (int n = 0; n < REGIONS; ++n)
    if (out[n])
      check_region(g, &region[n], out[n], size);
  for (int n = 0; n < REGIONS; ++n)
    free(out[n]);
  free(own.memory);
  fg__partition_clear(&partition);
}

static void regions_hold_the_grid(void **state)
{
  (void)state;
  for (int n = 0; n < GRID_COUNT; ++n)
    for (uint64_t seed = 0; seed < SEEDS; ++seed)
      check_grid(&GRIDS[n], 97 * seed + (uint64_t)n, seed % 2 ? 1 : sizeof(uint64_t));
  end_together();
}

/* A rank that sends and gets nothing takes part. */
static void no_regions_are_none(void **state)
{
  (void)state;
  fg__partition partition = divide_at_random(&GRIDS[1], 5, 2);
  padded own = padded_block(&partition, 1);
  expect(fg__regions_fill(us.context, &partition, NULL, 0, &own.source, NULL) ==
         FG_STATUS_OK);
  free(own.memory);
  fg__partition_clear(&partition);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(regions_hold_the_grid),
      TOGETHER(no_regions_are_none),
  };
  return cmocka_run_group_tests_name("grid/exchange/regions", tests, NULL, NULL);
}
