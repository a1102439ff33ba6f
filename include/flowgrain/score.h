/* How well icons represent a field: the errors of readers that reconstruct it from them.
 * Included by flowgrain.h. */
#ifndef FLOWGRAIN_SCORE_H
#define FLOWGRAIN_SCORE_H

#include "flowgrain/icons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The fair-share length of N icons is lambda = sqrt(|domain| / N), in 3D
 * (|domain| / N)^(1/3); |domain| is the area (volume) of the data cells that have a value
 * at every corner. Lengths and distances are Euclidean in the field's own coordinates,
 * without continuation across periodic sides: the domain is one period. */

typedef enum fg_score_class {
  FG_SCORE_ARROWS = 0, /* lines longer than lambda count for their middle lambda */
  FG_SCORE_FREE        /* lines count as long as they are */
} fg_score_class;

/* A zero field means its default, in brackets. */
typedef struct fg_score_options {
  fg_score_class lengths; /* [arrows] */
  int count;              /* the nominal N [the number of icons] */
  double ink;             /* upper bound of fg_score.ink: lines are cut, about their
                             middles, to one greatest length [no limit] */
  bool readers_only;      /* only the readers, ink and lengths: the rest becomes NaN */
  int threads;            /* the result does not depend on it [all cores] */
} fg_score_options;

/* A reader's angle to the field, degrees: of every cell of a raster where the field moves
 * at more than a thousandth of its greatest speed, that beside singularities left out. */
typedef struct fg_reader_error {
  double mean;           /* by area */
  double percentile_95;  /* 95 % of the area have at most so much */
  double speed_weighted; /* mean by |v| and area */
} fg_reader_error;

typedef struct fg_score {
  int icons;
  double count_length;       /* lambda */
  fg_reader_error diffusion; /* harmonic extension of the tangents: mean is E_ang */
  fg_reader_error nearest;   /* the nearest tangent */
  fg_reader_error inverse_distance; /* nearest tangent of each icon, by distance^-3; in 3D
                                       ^-4 */
  double mean;                      /* of the three means */
  double percentile_95;             /* mean of the three */
  double advection;   /* E_adv: mean distance between ends of streamlines of the field and
                         of the diffusion reader, in units of the radius to which they are
                         followed */
  double critical_f1; /* critical points of the field found in the diffusion reader, F1
                         measure (1 without any in both); NaN in 3D */
  double void_mean, void_max; /* distance to the nearest icon / lambda; infinite without
                                 icons in the domain */
  double ink;                 /* sum of lengths / (N lambda) */
  double clutter;  /* share of the lines nearer than lambda / 10 to another icon */
  double tangency; /* mean angle between lines and field, degrees; NaN without any */
  double outside;  /* share of the lines outside the domain */
  double shortest, longest; /* icon, as cut / lambda */
} fg_score;

/* Scores icons as a picture of a field; `options` may be NULL. The readers see the lines
 * inside the domain on a raster of sqrt(|domain|) / 256, in 3D cbrt(|domain|) / 64. A
 * part of the domain that no icon enters counts 90 degrees for the diffusion reader, and
 * without icons all do. ARGUMENT (options out of range), UNSUPPORTED (a slab of a field,
 * a domain that fills less than 1/256 of its box), MEMORY, STOPPED. Definitions:
 * docs/method/score.md; after Laidlaw et al. 2005 (advection) and Xu, Lee and Shen 2010
 * (reconstruct, then compare). */
FG_API fg_status fg_icons_score(fg_score *out, fg_context *context, const fg_field *field,
                                const fg_icons *icons, const fg_score_options *options);

/* Stores a score with icons; their file and picture then show it. NULL: none. */
FG_API void fg_icons_keep_score(fg_icons *icons, const fg_score *score);

/* The score stored with icons, borrowed; NULL: none. From a file it has the readers'
 * errors, the rest is NaN. */
FG_API const fg_score *fg_icons_kept_score(const fg_icons *icons);

#ifdef __cplusplus
}
#endif

#endif
