/* A heap of grid nodes, the smallest key on top. A node may be in it several times:
 * whoever pops it skips the entries that have been overtaken. */
#ifndef FG__HEAP_H
#define FG__HEAP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct fg__heap_entry {
  double key;
  int index;
} fg__heap_entry;

typedef struct fg__heap {
  fg__heap_entry *entry;
  size_t count, capacity;
} fg__heap;

/* False when there is no memory. */
bool fg__heap_push(fg__heap *heap, double key, int index);

/* Takes the entry with the smallest key; the heap must not be empty. */
fg__heap_entry fg__heap_pop(fg__heap *heap);

void fg__heap_clear(fg__heap *heap);

#endif
