#include "inputs.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "option/value.h"
#include "program.h"

static fg_input_options given;
static unsigned char *bytes;

enum { FIRST_BYTES = 1 << 20 };

/* Of standard input, which is kept in memory and may have no end; unless --max-memory
 * says another number. */
static const double MOST_BYTES = 1073741824.0;

/* Three quarters of the machine's memory. */
static double default_memory(void)
{
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? 0.75 * (double)pages * (double)size : 0.0;
}

/* Enlarges the buffer when it is full. */
static bool grow(size_t *capacity, size_t used)
{
  if (used < *capacity)
    return true;
  const size_t more = *capacity ? *capacity + *capacity / 2 : FIRST_BYTES;
  unsigned char *grown = more > *capacity ? realloc(bytes, more) : NULL;
  if (!grown)
    return false;
  bytes = grown;
  *capacity = more;
  return true;
}

/* At most `most` bytes. */
static int read_all(double most)
{
  size_t capacity = 0, used = 0;
  for (;;) {
    if (!grow(&capacity, used))
      return complain_of_memory("standard input");
    const ssize_t got = read(STDIN_FILENO, bytes + used, capacity - used);
    if (got == 0)
      break;
    if (got < 0 && errno != EINTR)
      return complain_of_file("standard input", "cannot be read");
    used += got > 0 ? (size_t)got : 0;
    if ((double)used > most) {
      complain("standard input: more than %.0f bytes", most);
      advise("--max-memory SIZE allows more.");
      return EXIT_FAILED;
    }
  }
  given.bytes = bytes;
  given.size = used;
  return EXIT_DONE;
}

static int read_standard_input(const input_settings *settings, int ranks)
{
  if (ranks > 1) {
    complain("standard input: cannot be an input of several processes");
    advise("Name a file, which each of them reads.");
    return EXIT_FAILED;
  }
  if (isatty(STDIN_FILENO)) {
    complain("standard input: is a terminal");
    advise("Say which file, as in: flowgrain info - <FILE");
    return EXIT_FAILED;
  }
  return read_all(settings->max_memory ? given.most_memory : MOST_BYTES);
}

int inputs_prepare(const input_settings *settings, const char *const *inputs, int count,
                   int ranks)
{
  given = (fg_input_options){
      .format = settings->format, .most_memory = default_memory(), .isolate = true};
  if (settings->max_memory)
    value_read_size(&given.most_memory, settings->max_memory);
  for (int k = 0; k < count; ++k)
    if (input_is_standard(inputs[k]))
      return read_standard_input(settings, ranks);
  return EXIT_DONE;
}

void inputs_give(fg_context *context)
{
  fg_context_set_input(context, &given);
}

int create_context(fg_context **out)
{
  if (fg_context_create(out) == FG_STATUS_OK) {
    inputs_give(*out);
    return EXIT_DONE;
  }
  complain("out of memory");
  return EXIT_FAILED;
}
