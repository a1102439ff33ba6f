/* Vectors in space, on a grid along axes or between points: the plane or volume that
 * their points fill, and which components lie in it. */
#ifndef FG__INTERPRET_SPACE_H
#define FG__INTERPRET_SPACE_H

#include "field/plane.h"
#include "interpret/interpret.h"

/* The plane or volume that points fill. */
typedef struct fg__space_domain {
  int dimension;    /* 2 or 3; 1: a line, which is no field */
  int axis[3];      /* those of space that span it, ascending; of a tilted plane 0, 1 */
  int flat;         /* in 2D the remaining one, one or two points thick; else -1 */
  size_t size[3];   /* points along them */
  bool descends[3]; /* the file's order along them is reversed */
  bool is_tilted;   /* a plane that is along no two axes of space */
  fg__plane_basis basis;      /* of it */
  struct fg__cell_set *cells; /* sample/'s; NULL: along axes */
} fg__space_domain;

/* The axis of space that axis k of a domain is, or is nearest to, and its name. */
int fg__space_domain_along(const fg__space_domain *domain, int k);
const char *fg__space_domain_axis_name(const fg__space_domain *domain, int k);

/* Fills in the grid of a pair but for its coordinates, with what prevents its reading in
 * `unusable`. grid->component tells which components lie along its axes. MEMORY. */
fg_status fg__space_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                         const fg_read_options *options);

/* The time in words, the chosen or the file's; "": there is none. MEMORY. */
fg_status fg__space_time(char out[FG__TEXT_BYTES], const fg__dataset *data, int time);

/* The times to choose from, for free() with their texts; NULL: they are not known. */
fg_status fg__space_times(fg_axis_value **out, char **text, const fg__dataset *data);

/* Whether a variable in space may be one of several components. */
bool fg__may_be_in_space(const fg__variable *v);

/* Drops pairs of names that others have: a name at points and of cells is one quantity.
 */
void fg__drop_repeated(fg__pair *pairs, size_t *count);

/* How many components the pair has, 2 or 3. */
int fg__pair_components(const fg__pair *pair);

#endif
