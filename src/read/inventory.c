#include "base/memory.h"
#include "read/format.h"

#include <stdlib.h>

typedef struct entry {
  fg_inventory_vector vector;
  char *name[3];
  char *units;
  char *found_by;
  char *unusable;
} entry;

struct fg_inventory {
  char *format;
  entry *entries;
  size_t count;
  size_t capacity;
};

fg_status fg__inventory_create(fg_inventory **out, fg_context *context,
                               const char *format)
{
  fg_inventory *inventory = fg__allocate(1, sizeof *inventory);
  if (inventory)
    inventory->format = fg__copy_text(format);
  if (!inventory || !inventory->format) {
    fg_inventory_destroy(inventory);
    return fg__fail_memory(context, "an inventory", sizeof *inventory);
  }
  *out = inventory;
  return FG_STATUS_OK;
}

static void clear_entry(entry *e)
{
  for (int k = 0; k < 3; ++k)
    free(e->name[k]);
  free(e->units);
  free(e->found_by);
  free(e->unusable);
}

fg_status fg__inventory_add(fg_inventory *inventory, fg_context *context,
                            const fg_inventory_vector *vector)
{
  entry e = {.vector = *vector};
  bool copied = true;
  for (int k = 0; k < 3; ++k) {
    e.name[k] = fg__copy_text(vector->name[k]);
    copied = copied && (e.name[k] || !vector->name[k]);
    e.vector.name[k] = e.name[k];
  }
  e.units = fg__copy_text(vector->units ? vector->units : "");
  e.found_by = fg__copy_text(vector->found_by ? vector->found_by : "");
  e.unusable = fg__copy_text(vector->unusable);
  copied = copied && e.units && e.found_by && (e.unusable || !vector->unusable);
  e.vector.units = e.units;
  e.vector.found_by = e.found_by;
  e.vector.unusable = e.unusable;
  void *entries = inventory->entries;
  if (!copied ||
      !fg__grow(&entries, &inventory->capacity, inventory->count + 1, sizeof e)) {
    clear_entry(&e);
    return fg__fail_memory(context, "an inventory's entry", sizeof e);
  }
  inventory->entries = entries;
  inventory->entries[inventory->count++] = e;
  return FG_STATUS_OK;
}

void fg_inventory_destroy(fg_inventory *inventory)
{
  if (!inventory)
    return;
  for (size_t i = 0; i < inventory->count; ++i)
    clear_entry(&inventory->entries[i]);
  free(inventory->entries);
  free(inventory->format);
  free(inventory);
}

const char *fg_inventory_format(const fg_inventory *inventory)
{
  return inventory ? inventory->format : "";
}

int fg_inventory_vector_count(const fg_inventory *inventory)
{
  return inventory ? (int)inventory->count : 0;
}

const fg_inventory_vector *fg_inventory_vector_at(const fg_inventory *inventory,
                                                  int index)
{
  if (!inventory || index < 0 || (size_t)index >= inventory->count)
    return NULL;
  return &inventory->entries[index].vector;
}
