/* Lengths and directions of vectors in place of components: speeds with the directions of
 * winds, heights with those of waves. */
#ifndef FG__TERMS_POLAR_H
#define FG__TERMS_POLAR_H

#include "base/context.h"
#include "terms/term.h"

typedef struct fg__polar {
  int sense;   /* 1: to where it goes; -1: from where it comes; 0: these are components */
  double unit; /* radians in the direction's unit; 0: the unit is not known */
  bool from_east; /* counter-clockwise from east, else clockwise from north */
} fg__polar;

/* Whether a term is a direction, by its standard name, its name or units of an angle, and
 * how it is counted: by the words "from" and "to"; else wind and waves are named after
 * the place from where they come (WMO, CF's sea_surface_wave_from_direction). */
bool fg__direction_read(fg__polar *out, const fg__term *term);

/* The long name or comment of a direction that names the convention opposite to the sense
 * that fg__direction_read gives it; NULL: neither does. */
const char *fg__opposite_sense(const fg__term *direction);

/* The speed that belongs to a direction, by their standard names or their names alone;
 * -1: none, or no direction. */
int fg__speed_of(fg__polar *out, const fg__term *terms, size_t count, size_t direction);

/* Which of two terms that the options name is the direction of the other, and how it is
 * counted; -1: these are components. */
int fg__direction_among(fg__polar *out, const fg__term *a, const fg__term *b);

/* Whether a name is that of a speed. */
bool fg__names_speed(const char *name);

/* A length and its direction become components to east and north: NaN where either is
 * missing or a code for that, as a length below 0 or a direction beyond two turns. */
void fg__polar_turn(double vector[2], const fg__polar *polar);

/* The numbers of directions, but codes beyond two turns of degrees. */
typedef struct fg__angles {
  double least, most;
  size_t known, beyond; /* a turn of radians */
} fg__angles;

void fg__angles_add(fg__angles *angles, double angle);

/* ARGUMENT: the numbers are not in the unit that direction `name` of the file has, or
 * more than a turn and a half apart, as two-byte numbers beyond their range are. */
fg_status fg__angles_check(const fg__angles *angles, fg_context *context,
                           const fg__polar *polar, const char *path, const char *name);

/* fg__polar_turn and fg__angles_check of whole arrays; components are left as they are.
 */
fg_status fg__polar_turn_all(fg_context *context, float *const vector[2], size_t count,
                             const fg__polar *polar, const char *path, const char *name);

/* What says that a term is a direction: "standard_name wind_from_direction". */
void fg__direction_rule(char *out, size_t size, const fg__term *term);

/* What a length and its direction are, and which rule says so. */
void fg__polar_words(char *out, size_t size, const fg__polar *polar, const char *rule);

#endif
