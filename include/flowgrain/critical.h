/* Critical points: what a field turns round, starts from, ends at or parts at. Included
 * by flowgrain.h. */
#ifndef FLOWGRAIN_CRITICAL_H
#define FLOWGRAIN_CRITICAL_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fg_critical_kind {
  FG_CRITICAL_SADDLE = 0,
  FG_CRITICAL_CENTRE,
  FG_CRITICAL_SPIRAL,
  FG_CRITICAL_SOURCE,
  FG_CRITICAL_SINK
} fg_critical_kind;
enum { FG_CRITICAL_KINDS = 5 };

/* Directions are those of the plane, x to the right and y upwards, as a picture has it.
 */
typedef struct fg_critical_point {
  double at[2]; /* in the coordinates of the field's axes */
  int index;    /* Poincare's: -1 of a saddle, else 1 */
  fg_critical_kind kind;
  int sense;   /* of a centre or spiral: 1 anticlockwise, -1 clockwise; else 0 */
  int outward; /* of a spiral or source 1 where it flows outwards, of a spiral or sink -1
                  where inwards; else 0 */
  double axis[2][2]; /* of a saddle: unit vectors along which it flows out, and in */
} fg_critical_point;

/* A zero field means its default, in brackets. */
typedef struct fg_critical_options {
  int count;     /* N of lambda = sqrt(|domain| / N), the scale of N arrows [40] */
  double length; /* lambda, in the coordinates' unit [from count] */
  int threads;   /* the result does not depend on it [1] */
} fg_critical_options;

typedef struct fg_critical_points fg_critical_points;

/* Finds the critical points of a field in 2D at the scale of a length lambda: those of
 * its directions, smoothed by a Gaussian of lambda / 4, by the index of Poincare; closest
 * first, pairs nearer than lambda / 2 are merged or, of opposite index, cancelled, as for
 * fg_score.critical_f1. None lies where less than 84 % of the Gaussian is inside of the
 * domain: nearer than lambda / 4 to a straight boundary; two vortices nearer than lambda
 * / 2 that turn in opposite senses are none. Periodic sides are boundaries. `options` may
 * be NULL. ARGUMENT (options out of range), UNSUPPORTED (a field in 3D, a slab of one, a
 * domain that fills less than 1/256 of its box), MEMORY, STOPPED. Definitions:
 * docs/method/features.md; after Helman and Hesselink 1989 (kinds) and Tricoche,
 * Scheuermann and Hagen 2000 (merging). */
FG_API fg_status fg_critical_points_find(fg_critical_points **out, fg_context *context,
                                         const fg_field *field,
                                         const fg_critical_options *options);
FG_API void fg_critical_points_destroy(fg_critical_points *points);

/* How many points there are; 0 for NULL. */
FG_API int fg_critical_points_count(const fg_critical_points *points);

/* Point `index`, from 0 to count - 1, borrowed; NULL for others. */
FG_API const fg_critical_point *fg_critical_points_at(const fg_critical_points *points,
                                                      int index);

/* The word of a kind: "saddle", "centre", "spiral", "source" or "sink"; NULL for
 * others. */
FG_API const char *fg_critical_kind_word(fg_critical_kind kind);

/* The length lambda of the scale. */
FG_API double fg_critical_points_length(const fg_critical_points *points);

#ifdef __cplusplus
}
#endif

#endif
