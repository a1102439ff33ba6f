#include "picture/surface/svg_ids.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const char *const words[] = {"surface", "image"};
enum { WORDS = sizeof words / sizeof *words, MOST_DIGITS = 18 };

/* A name, as `"surface7"` or `#surface7)`: the word's number, and Cairo's. */
typedef struct name {
  int word;
  unsigned long number;
} name;

/* Whether a name begins at `at`, after a quotation mark or a hash; *end: after it. */
static int find_name(const char *svg, size_t length, size_t at, name *out, size_t *end)
{
  if (at == 0 || (svg[at - 1] != '"' && svg[at - 1] != '#'))
    return 0;
  for (int word = 0; word < WORDS; ++word) {
    size_t letters = strlen(words[word]), digits = 0;
    if (length - at <= letters || memcmp(svg + at, words[word], letters) != 0)
      continue;
    *out = (name){.word = word};
    *end = at + letters;
    for (; *end < length && svg[*end] >= '0' && svg[*end] <= '9'; ++*end, ++digits)
      out->number = 10 * out->number + (unsigned long)(svg[*end] - '0');
    return digits > 0 && digits <= MOST_DIGITS && *end < length &&
           (svg[*end] == '"' || svg[*end] == ')');
  }
  return 0;
}

/* Names in the order of their first mention. */
typedef struct names {
  name *name;
  size_t count, capacity;
} names;

/* A name's place among those of its word, from 1; 0: no memory. */
static size_t place_of(names *known, const name *one)
{
  size_t place = 1;
  for (size_t n = 0; n < known->count; ++n) {
    if (known->name[n].word != one->word)
      continue;
    if (known->name[n].number == one->number)
      return place;
    ++place;
  }
  if (!fg__grow((void **)&known->name, &known->capacity, known->count + 1,
                sizeof *known->name))
    return 0;
  known->name[known->count++] = *one;
  return place;
}

int fg__svg_ids_write(FILE *stream, const char *svg, size_t length)
{
  names known = {.name = NULL};
  size_t written = 0, end, place = 1;
  name one;
  for (size_t at = 0; at < length && place > 0; ++at) {
    if ((svg[at] != 's' && svg[at] != 'i') || !find_name(svg, length, at, &one, &end))
      continue;
    place = place_of(&known, &one);
    fwrite(svg + written, 1, at - written, stream);
    fprintf(stream, "%s%zu", words[one.word], place);
    written = at = end;
  }
  fwrite(svg + written, 1, length - written, stream);
  free(known.name);
  return place > 0;
}
