/* What a variable, column or array is called, and what it says of itself. */
#ifndef FG__TERMS_TERM_H
#define FG__TERMS_TERM_H

#include <stdbool.h>

typedef struct fg__term {
  const char *name;
  const char *standard_name, *long_name, *units, *comment; /* NULL: it has none */
  int place; /* equal for variables whose samples are at the same points */
  int group; /* components of one vector are of one group, such as points or cells */
  int file;  /* the one that has it, of two; -1: either */
  int frame; /* of components, by GRIB's flag: 1 east and north, -1 along the grid, 0
                unknown */
} fg__term;

#endif
