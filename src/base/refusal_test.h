/* For tests in which every allocation fails once: the linker puts these functions in
 * place of the C library's in all of the test's own objects (CMakeLists.txt). */
#ifndef FG__REFUSAL_TEST_H
#define FG__REFUSAL_TEST_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* How many were asked for, the number from 0 of the one that fails, and how many are not
 * freed yet. */
static long asked, failing = -1, unfreed;

static bool refuses(void)
{
  return asked++ == failing;
}

static void *count(void *memory)
{
  unfreed += memory != NULL;
  return memory;
}

#define DECLARE(result, name, parameters)                                                \
  result __real_##name parameters;                                                       \
  result __wrap_##name parameters;

/* clang-format off */
DECLARE(void *, malloc, (size_t))
DECLARE(void *, calloc, (size_t, size_t))
DECLARE(void *, aligned_alloc, (size_t, size_t))
DECLARE(void *, realloc, (void *, size_t))
DECLARE(char *, strdup, (const char *))
DECLARE(FILE *, open_memstream, (char **, size_t *))
DECLARE(void, free, (void *))
/* clang-format on */

void *__wrap_malloc(size_t bytes)
{
  return refuses() ? NULL : count(__real_malloc(bytes));
}

void *__wrap_calloc(size_t number, size_t size)
{
  return refuses() ? NULL : count(__real_calloc(number, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t bytes)
{
  return refuses() ? NULL : count(__real_aligned_alloc(alignment, bytes));
}

void *__wrap_realloc(void *memory, size_t bytes)
{
  if (refuses())
    return NULL;
  bool first = !memory;
  void *grown = __real_realloc(memory, bytes);
  unfreed += first && grown;
  return grown;
}

char *__wrap_strdup(const char *text)
{
  return refuses() ? NULL : count(__real_strdup(text));
}

/* Its text is freed by whoever opened it. */
FILE *__wrap_open_memstream(char **text, size_t *bytes)
{
  return refuses() ? NULL : count(__real_open_memstream(text, bytes));
}

void __wrap_free(void *memory)
{
  unfreed -= memory != NULL;
  __real_free(memory);
}

#endif
