/* What legacy VTK files of the tests are made of. */
#ifndef FG__VTK_LEGACY_EXAMPLE_H
#define FG__VTK_LEGACY_EXAMPLE_H

#include "read/vtk/vti_example.h"

/* `count` numbers of a type as text or big-endian bytes, then a new line. */
static inline void example_legacy_numbers(example_text *file, bool binary, int type,
                                          const double *numbers, size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    unsigned char bytes[8];
    char word[40];
    if (binary) {
      example_bytes(file, bytes, example_number(bytes, numbers[i], type, true));
      continue;
    }
    snprintf(word, sizeof word, "%.17g%s", numbers[i], i % 9 == 8 ? "\n" : " ");
    example_words(file, word);
  }
  example_words(file, "\n");
}

#endif
