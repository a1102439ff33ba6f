/* Which names are those of a vector's components. A pattern is a name with a hole in
 * place of what denotes a component: "U_GRD_6_ISBL" is "#_GRD_6_ISBL" of component 0. A
 * name can have several. Names with one pattern and different components are a vector's.
 */
#ifndef FG__TERMS_NAMES_H
#define FG__TERMS_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "terms/term.h"

enum { FG__MOST_HOLES = 4 };

typedef struct fg__hole {
  size_t start, length;
  int words; /* which words denote components there */
} fg__hole;

typedef struct fg__pattern {
  size_t term;
  const char *text; /* `length` bytes of a name or standard name */
  size_t length;
  int component; /* 0, 1, 2; above: of no vector */
  int holes;
  fg__hole hole[FG__MOST_HOLES];
  bool standard; /* of a standard name */
  bool velocity;
} fg__pattern;

typedef struct fg__patterns {
  fg__pattern *entry;
  size_t count, capacity;
} fg__patterns;

/* Adds the patterns of a term among others; none where it is no component. `at_points`: a
 * length may be a displacement, which on a grid is the size of a cell. False: no memory.
 */
bool fg__patterns_add(fg__patterns *list, const fg__term *terms, size_t count,
                      size_t which, bool at_points);

/* Orders patterns: equal names one after the other, then by component and term. */
int fg__compare_patterns(const void *left, const void *right);

/* Whether what surrounds the holes is equal; `exactly`: in case, too. */
bool fg__is_same_pattern(const fg__pattern *a, const fg__pattern *b, bool exactly);

/* Whether the component is an index: "U:0", "Velocity[1]". */
bool fg__is_index(const fg__pattern *pattern);

/* How plain a vector's names are: 0 for "u" and "v", then "vx" and "vy", ...; -1: they
 * have more words. */
int fg__plainness(const char *first, const char *second);

/* The one component, 0 or 1, that words name by a direction: "eastward", "meridional";
 * -1: none, or both. */
int fg__component_in_words(const char *words);

/* Whether words count a component to the west or south, and not also to the opposite. */
bool fg__counts_backwards(const char *words);

/* Whether they say "positive to the west" or "positive southward", in prose too. */
bool fg__is_positive_backwards(const char *words);

/* 1 for a flux that is counted downward, -1 for one counted upward, 0 where words say
 * neither. */
int fg__counts_downward(const char *words);

/* As fg__component_in_words, of a name: "u" or "v_wind". False: no memory. */
bool fg__component_of_name(int *out, const char *name);

/* Whether a standard name is of a velocity upwards. */
bool fg__is_upward_velocity(const char *standard_name);

/* Whether a component is along the vertical by its standard name, name or long name: a
 * velocity upwards, or the tendency of pressure. */
bool fg__is_vertical(const fg__term *term);

#endif
