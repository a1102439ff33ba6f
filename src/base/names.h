/* A list of names in a message: a dozen, and how many there are besides. */
#ifndef FG__NAME_LIST_H
#define FG__NAME_LIST_H

#include <stddef.h>

enum { FG__NAMES_BYTES = 1024 };

typedef struct fg__names {
  char text[FG__NAMES_BYTES]; /* "u, v, temp and 9 more"; "" for no name */
  size_t count;               /* of all names */
  size_t shown, used;         /* names in the text, and their bytes */
} fg__names;

/* Adds a name to a list that begins as {0}; `between` stands before all but the first. */
void fg__names_add(fg__names *names, const char *between, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
