/* Corners of cells as nodes: a hash table of places. */
#include "base/memory.h"
#include "sample/unstructured/mesh.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places nearer than this part of the sphere's radius are one: 6 cm of the Earth's. */
static const double SAME_PLACE = 1e-8;

enum { FIRST_SLOTS = 1 << 10 };

void fg__node_table_clear(fg__node_table *table)
{
  free(table->at[0]);
  free(table->at[1]);
  free(table->key);
  free(table->slot);
  *table = (fg__node_table){0};
}

static size_t hash_of(const long long key[3])
{
  unsigned long long h = 1469598103934665603ULL;
  for (int k = 0; k < 3; ++k) {
    h ^= (unsigned long long)key[k];
    h *= 1099511628211ULL;
    h ^= h >> 29;
  }
  return (size_t)(h ^ h >> 32);
}

static bool is_same(const long long a[3], const long long b[3])
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* The slot of a key: the node's number + 1, or 0 where it is free. */
static size_t find_slot(const fg__node_table *table, const long long key[3])
{
  size_t n = hash_of(key) & (table->slots - 1);
  while (table->slot[n] > 0 && !is_same(table->key[table->slot[n] - 1], key))
    n = (n + 1) & (table->slots - 1);
  return n;
}

static bool grow_slots(fg__node_table *table)
{
  const size_t slots = table->slots > 0 ? 2 * table->slots : FIRST_SLOTS;
  int *slot = fg__allocate(slots, sizeof *slot);
  if (!slot)
    return false;
  free(table->slot);
  table->slot = slot;
  table->slots = slots;
  for (size_t n = 0; n < table->nodes; ++n)
    table->slot[find_slot(table, table->key[n])] = (int)n + 1;
  return true;
}

static bool grow_nodes(fg__node_table *table)
{
  if (table->nodes < table->capacity)
    return true;
  size_t capacity[3] = {table->capacity, table->capacity, table->capacity};
  void *all[3] = {table->at[0], table->at[1], table->key};
  const size_t size[3] = {sizeof(double), sizeof(double), sizeof *table->key};
  bool grown = table->nodes < INT_MAX - 1;
  for (int k = 0; k < 3 && grown; ++k)
    grown = fg__grow(&all[k], &capacity[k], table->nodes + 1, size[k]);
  table->at[0] = all[0];
  table->at[1] = all[1];
  table->key = all[2];
  if (grown)
    table->capacity = capacity[0];
  return grown;
}

int fg__node_table_at(fg__node_table *table, double longitude, double latitude)
{
  double at[3];
  long long key[3];
  fg__sphere_unit_vector(at, longitude, latitude);
  for (int k = 0; k < 3; ++k)
    key[k] = llround(at[k] / SAME_PLACE);
  if (2 * (table->nodes + 1) > table->slots && !grow_slots(table))
    return -1;
  const size_t n = find_slot(table, key);
  if (table->slot[n] > 0)
    return table->slot[n] - 1;
  if (!grow_nodes(table))
    return -1;
  table->at[0][table->nodes] = longitude;
  table->at[1][table->nodes] = latitude;
  memcpy(table->key[table->nodes], key, sizeof key);
  table->slot[n] = (int)++table->nodes;
  return table->slot[n] - 1;
}
