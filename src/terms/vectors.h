/* The vectors that variables, columns or arrays form: by standard names, by names, and as
 * a speed with its direction. */
#ifndef FG__TERMS_VECTORS_H
#define FG__TERMS_VECTORS_H

#include "terms/polar.h"

/* How a vector was found: the smallest is the best; one more where plainer names are at
 * the same points. */
typedef enum fg__evidence {
  FG__BY_STANDARD_VELOCITY = 0,
  FG__BY_VELOCITY_NAMES = 2,
  FG__BY_SPEED_AND_DIRECTION = 4, /* where there are no components of a velocity */
  FG__BY_STANDARD_OTHER = 6,
  FG__BY_OTHER_NAMES = 8,
  FG__BY_UPRIGHT_NAMES = 10,
  FG__BY_SHAPE = 12,     /* of an array alone */
  FG__BY_LONG_NAMES = 14 /* and by what they say */
} fg__evidence;

typedef struct fg__vector {
  int component[3]; /* indices of terms; -1: there is none */
  bool is_upright; /* components 0 and 2, or 1 and 2: of a plane across the missing one */
  bool is_indexed; /* the names differ in an index */
  fg__polar polar; /* 0 and 1 are a speed and a direction */
  const char *found_by;
  int rank;         /* of fg__evidence */
  bool is_velocity; /* units of a speed, or none, unlike a stress or a flux */
} fg__vector;

typedef struct fg__vector_rules {
  bool apart;     /* components are in two files, one in each */
  bool at_points; /* not on a grid: a length may be a displacement */
} fg__vector_rules;

/* Lists vectors, the best first, then in the order of the terms. *out is for free().
 * False: no memory. */
bool fg__vectors_find(fg__vector **out, size_t *count, const fg__term *terms,
                      size_t term_count, const fg__vector_rules *rules);

#endif
