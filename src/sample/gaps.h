/* Where a grid was not sampled: intervals that are wide beside their neighbours. */
#ifndef FG__GAPS_H
#define FG__GAPS_H

#include <stdbool.h>
#include <stddef.h>

/* Which of the n intervals of a line go over a gap: those more than 4.5 times as long as
 * the median of the intervals at most 3 away, itself included, the larger one of two in
 * the middle. Lengths that are 0 or not known do not count. So up to three lines of an
 * even grid may be left out, and spacings may change anywhere. Returns how many. */
size_t fg__gaps_find(bool *gap, const double *length, size_t n);

/* The same of the intervals between ascending coordinates, if they are 7 or more. *gap is
 * to be freed; NULL: there are fewer. False: memory ran out. */
bool fg__gaps_along(bool **gap, size_t *count, const double *axis, size_t size);

#endif
