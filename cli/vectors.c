#include "vectors.h"

#include <stdlib.h>
#include <string.h>

#include "program.h"

/* fg_vectors of the word, -1 of another. */
static int place_of(const char *word)
{
  static const char *const words[] = {"", "generic", "avx2", "avx512"};
  for (int n = 0; n < (int)(sizeof words / sizeof *words); ++n)
    if (strcmp(word, words[n]) == 0)
      return n;
  return -1;
}

static const char *word(void)
{
  const char *found = getenv("FLOWGRAIN_KERNEL");
  return found ? found : "";
}

int vectors_check(void)
{
  if (place_of(word()) >= 0)
    return EXIT_DONE;
  complain("FLOWGRAIN_KERNEL=%.100s: generic, avx2 and avx512 are known", word());
  return EXIT_FAILED;
}

fg_vectors vectors_wanted(void)
{
  int place = place_of(word());
  return place < 0 ? FG_VECTORS_WIDEST : (fg_vectors)place;
}
