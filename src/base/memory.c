#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(__linux__)
#include <sys/mman.h>
#endif

enum { VECTOR_BYTES = 64, FIRST_CAPACITY = 16 };

enum { LARGE_PAGE = 1 << 21 };

/* From here on calloc takes untouched pages from the system (glibc's largest
 * M_MMAP_THRESHOLD); that they came in one by one, by 4 kB, was a fifth of the time to
 * read a grid of 9 million points. */
static const size_t LARGE_ARRAY = (size_t)1 << 25;

/* A sweep reads rows of many arrays at once; with small pages it waits for address
 * translation (docs/design/evolution.md). A hint, where the system takes it. */
static void prefer_large_pages(unsigned char *memory, size_t bytes)
{
#if defined(MADV_HUGEPAGE)
  size_t skipped = (LARGE_PAGE - (uintptr_t)memory % LARGE_PAGE) % LARGE_PAGE;
  if (bytes >= skipped + LARGE_PAGE)
    (void)madvise(memory + skipped, (bytes - skipped) / LARGE_PAGE * LARGE_PAGE,
                  MADV_HUGEPAGE);
#else
  (void)memory;
  (void)bytes;
#endif
}

void *fg__allocate(size_t count, size_t size)
{
  if (count == 0 || size == 0)
    return calloc(1, 1);
  void *memory = calloc(count, size); /* refuses a product that overflows */
  if (memory && count * size >= LARGE_ARRAY)
    prefer_large_pages(memory, count * size);
  return memory;
}

void *fg__allocate_aligned(size_t count, size_t size)
{
  if (size != 0 && count > (SIZE_MAX - VECTOR_BYTES) / size)
    return NULL;
  size_t bytes = count * size;
  bytes = (bytes / VECTOR_BYTES + 1) * VECTOR_BYTES;
  void *memory = aligned_alloc(VECTOR_BYTES, bytes);
  if (memory) {
    prefer_large_pages(memory, bytes);
    memset(memory, 0, bytes);
  }
  return memory;
}

void *fg__allocate_untouched(void **base, size_t count, size_t size)
{
  *base = NULL;
  if (size == 0 || count > (SIZE_MAX - VECTOR_BYTES) / size)
    return NULL;
  size_t bytes = count * size + VECTOR_BYTES;
  unsigned char *memory = *base = calloc(bytes, 1);
  if (memory)
    prefer_large_pages(memory, bytes);
  return memory ? memory + VECTOR_BYTES - (uintptr_t)memory % VECTOR_BYTES : NULL;
}

int fg__grow(void **array, size_t *capacity, size_t needed, size_t size)
{
  if (needed <= *capacity)
    return 1;
  size_t wanted = *capacity + *capacity / 2;
  if (wanted < FIRST_CAPACITY)
    wanted = FIRST_CAPACITY;
  if (wanted < needed)
    wanted = needed;
  if (size == 0 || wanted > SIZE_MAX / size)
    return 0;
  void *grown = realloc(*array, wanted * size);
  if (!grown)
    return 0;
  *array = grown;
  *capacity = wanted;
  return 1;
}

char *fg__copy_text(const char *text)
{
  return text ? strdup(text) : NULL;
}
