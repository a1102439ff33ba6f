/* The parameters of a PROJ string. */
#ifndef FG__MAP_WORDS_H
#define FG__MAP_WORDS_H

#include "base/context.h"

enum {
  FG__MAP_STRING_BYTES = 1000,
  FG__MAP_PARAMETERS = 48,
  FG__MAP_PARAMETER_BYTES = 128
};

/* "+key=value" or "+key", without the plus. */
typedef struct fg__map_words {
  char parameter[FG__MAP_PARAMETERS][FG__MAP_PARAMETER_BYTES];
  int count;
} fg__map_words;

/* Takes a string apart; leaves out what says nothing about the plane (no_defs, type,
 * over, ...). ARGUMENT: it is too long, has control characters, has no or several
 * "+proj=", or a parameter that names a file or a chain of operations. */
fg_status fg__map_words_read(fg__map_words *out, fg_context *context, const char *string);

/* The value of a key, "" for a key alone; NULL: it is not there. */
const char *fg__map_words_find(const fg__map_words *words, const char *key);

/* Drops a key; sets it to a value (NULL: the key alone). False: there is no room. */
void fg__map_words_drop(fg__map_words *words, const char *key);
bool fg__map_words_set(fg__map_words *words, const char *key, const char *value);

/* Whether the plane's coordinates are degrees, of the globe or about a pole of their own.
 */
bool fg__map_words_are_degrees(const fg__map_words *words);

/* "+proj=laea +lat_0=90". False: it does not fit. */
bool fg__map_words_write(char out[FG__MAP_STRING_BYTES], const fg__map_words *words);

#endif
