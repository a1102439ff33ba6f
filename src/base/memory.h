/* Allocation with the sizes checked. */
#ifndef FG__MEMORY_H
#define FG__MEMORY_H

#include <stddef.h>

/* Returns count * size bytes, zeroed, or NULL when that overflows or is not to be had.
 * A request for nothing returns a pointer that can be freed. End with free. */
void *fg__allocate(size_t count, size_t size);

/* The same on a 64-byte boundary, for vector code, in large pages where there are such.
 * End with free. */
void *fg__allocate_aligned(size_t count, size_t size);

/* The same without touching large pieces: a page comes in with whoever first uses it, so
 * that threads can share that work. End with free of *base. */
void *fg__allocate_untouched(void **base, size_t count, size_t size);

/* Makes *array at least `needed` elements long, growing by half; *capacity follows.
 * Returns 0 when there is no memory: *array then stays as it was. */
int fg__grow(void **array, size_t *capacity, size_t needed, size_t size);

/* Copies a text; NULL for NULL or when there is no memory. End with free. */
char *fg__copy_text(const char *text);

#endif
