/* Speed and direction as components to east and north. */
#ifndef FG__POLAR_H
#define FG__POLAR_H

#include <stddef.h>

/* Directions are angles clockwise from north. */
typedef struct fg__polar {
  int sense;   /* 1: to where it goes; -1: from where it comes; 0: these are components */
  double unit; /* radians in the direction's unit; 0: the unit is not known */
} fg__polar;

/* A speed and its direction become components to east and north: NaN where either is
 * missing or a code for that, as a speed below 0 or a direction beyond two turns. */
void fg__polar_turn(double vector[2], const fg__polar *polar);

/* The same of whole arrays; components are left as they are. */
void fg__polar_turn_all(float *const vector[2], size_t count, const fg__polar *polar);

/* What a speed and its direction are, and which rule says so. */
void fg__polar_words(char *out, size_t size, const fg__polar *polar, const char *rule);

/* The sense of a direction by its name and its description ("": nothing): by the
 * words "from" and "to"; else wind is named after the place from where it comes. */
int fg__polar_sense(const char *name, const char *more);

/* Radians in a unit of angles, "degrees", "deg true" or "rad"; 0: it is none. */
double fg__polar_unit(const char *units);

#endif
