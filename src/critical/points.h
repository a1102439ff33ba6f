/* Critical points, and which of two sets are the same. */
#ifndef FG__CRITICAL_POINTS_H
#define FG__CRITICAL_POINTS_H

#include <stddef.h>

#include "base/context.h"

typedef struct fg__point {
  double at[2];
  int index;             /* Poincare's: 1 or -1 */
  double gradient[2][2]; /* of component i along axis k; added up by merging, but 0
                             where two turn or flow in opposite senses */
  bool gone;             /* merged or cancelled */
  size_t next;           /* in its bucket; SIZE_MAX: none */
} fg__point;

/* Points in square buckets of the distance that matters. */
typedef struct fg__points {
  fg__point *point;
  size_t count, capacity;
  double reach, low[2];
  int size[2];
  size_t *bucket; /* its last point; SIZE_MAX: none */
} fg__points;

/* None yet, in the box from `low` to `high`. Ends with fg__points_clear, also after a
 * failure. MEMORY. */
fg_status fg__points_create(fg__points *out, fg_context *context, const double low[2],
                            const double high[2], double reach);
void fg__points_clear(fg__points *points);

/* Adds a copy of a point that is not gone. MEMORY. */
fg_status fg__points_add(fg__points *points, fg_context *context, const fg__point *point);

/* The closest pair nearer than the reach becomes one point, in its middle, or none where
 * their indices cancel; then the closest that is left, and so on. MEMORY. */
fg_status fg__points_merge(fg__points *points, fg_context *context);

/* Points that are not gone. */
size_t fg__points_left(const fg__points *points);

/* How many pairs there are of points of like index nearer than the reach, one of each
 * set: the closest first, each point in one. MEMORY. */
fg_status fg__points_match(size_t *pairs, fg_context *context, const fg__points *a,
                           const fg__points *b);

#endif
