/* The parts of make_corpus. */
#ifndef FG__MAKE_CORPUS_H
#define FG__MAKE_CORPUS_H

#include <stdio.h>
#include <stdlib.h>

/* Writes a file of the corpus, or ends the program. */
static inline void store(const char *name, const void *bytes, size_t size)
{
  FILE *file = fopen(name, "wb");
  if (!file || fwrite(bytes, 1, size, file) != size || fclose(file))
    abort();
}

/* The files in grib. */
void make_gribs(void);

#endif
