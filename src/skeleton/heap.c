#include "skeleton/heap.h"

#include <stdlib.h>

#include "base/memory.h"

bool fg__heap_push(fg__heap *heap, double key, int index)
{
  if (!fg__grow((void **)&heap->entry, &heap->capacity, heap->count + 1,
                sizeof *heap->entry))
    return false;
  size_t hole = heap->count++;
  while (hole > 0) {
    size_t parent = (hole - 1) / 2;
    if (heap->entry[parent].key <= key)
      break;
    heap->entry[hole] = heap->entry[parent];
    hole = parent;
  }
  heap->entry[hole] = (fg__heap_entry){key, index};
  return true;
}

fg__heap_entry fg__heap_pop(fg__heap *heap)
{
  fg__heap_entry top = heap->entry[0];
  fg__heap_entry last = heap->entry[--heap->count];
  size_t hole = 0;
  for (;;) {
    size_t child = 2 * hole + 1;
    if (child >= heap->count)
      break;
    if (child + 1 < heap->count && heap->entry[child + 1].key < heap->entry[child].key)
      ++child;
    if (last.key <= heap->entry[child].key)
      break;
    heap->entry[hole] = heap->entry[child];
    hole = child;
  }
  if (heap->count > 0)
    heap->entry[hole] = last;
  return top;
}

void fg__heap_clear(fg__heap *heap)
{
  free(heap->entry);
  *heap = (fg__heap){0};
}
