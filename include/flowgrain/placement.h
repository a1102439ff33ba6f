/* Exactly N arrows, placed so that readers can reconstruct the field from them. Included
 * by flowgrain.h. */
#ifndef FLOWGRAIN_PLACEMENT_H
#define FLOWGRAIN_PLACEMENT_H

#include "flowgrain/icons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lengths are given in fair-share lengths lambda: the root (2D) or cube root (3D) of
 * (area or volume of the domain / number of arrows). */
typedef enum fg_lengths {
  FG_LENGTHS_FREE = 0, /* each as long as readers gain most from, 0.35 to 2 lambda */
  FG_LENGTHS_FAIR      /* lambda at most */
} fg_lengths;

typedef enum fg_effort {
  FG_EFFORT_NORMAL = 0,
  FG_EFFORT_QUICK,   /* descent alone: some per cent more error, half the time */
  FG_EFFORT_THOROUGH /* the best of five placements, of few arrows of nine: up to five
                        times the time */
} fg_effort;

/* A zero field means its default, in brackets. */
typedef struct fg_placement_options {
  fg_lengths lengths; /* [free] */
  fg_effort effort;   /* [normal] */
  int threads;        /* at most 9 are used; the result does not depend on it; where
                         several placements are compared, of few arrows or with
                         FG_EFFORT_THOROUGH, each takes the memory of a placement [all
                         cores; one, beside other ranks] */
} fg_placement_options;

/* A zero field means its default, in brackets. */
typedef struct fg_arrows_options {
  int count;          /* how many [40] */
  fg_lengths lengths; /* [free] */
  fg_effort effort;   /* [normal] */
  int threads;        /* as of a placement [all cores] */
} fg_arrows_options;

/* Places exactly options->count arrows on a field, 2D or 3D, in one call, from evenly
 * distributed points; `options` may be NULL. An icon's points run from tail to head in
 * the field's coordinates; all members of icons are set (fg_placement_icons). The same on
 * any machine and any number of threads. ARGUMENT (so many have no room: the message says
 * how many have), MEMORY, STOPPED. */
FG_API fg_status fg_arrows_create(fg_icons **out, fg_context *context,
                                  const fg_field *field,
                                  const fg_arrows_options *options);

/* Arrows on a field: one scale after another, from many arrows to few. */
typedef struct fg_placement fg_placement;

/* Prepares a field, which must outlive it, in 2D or 3D. The method is descent on the
 * error of readers who reconstruct the field from its arrows (docs/method/placement.md).
 * ARGUMENT, MEMORY, STOPPED. */
FG_API fg_status fg_placement_create(fg_placement **out, fg_context *context,
                                     const fg_field *field,
                                     const fg_placement_options *options);
FG_API void fg_placement_destroy(fg_placement *placement);

/* Places exactly `count` arrows. A first scale starts from `clusters`, one arrow for each
 * of these icons, of which some are removed or others added until there are `count`;
 * NULL: from evenly distributed points. `clusters` may also be icons of another
 * placement, as of an earlier frame of an animation: then arrows stay near them. A scale
 * of fewer arrows than the present one starts from that, and `clusters` is ignored; one
 * of more is a first scale again. The same on any machine and any number of threads.
 * ARGUMENT (count below 1; so many have no room: the message says how many have), MEMORY,
 * STOPPED. */
FG_API fg_status fg_placement_place(fg_placement *placement, int count,
                                    const fg_icons *clusters);

/* Places the fewest arrows, from an even start, whose readers' mean error
 * (fg_icons_score, lengths as they are) is at most `degrees`; *count is how many.
 * ARGUMENT (degrees; `most` arrows, or as many as have room, do not reach it: the message
 * says what they do), MEMORY, STOPPED. */
FG_API fg_status fg_placement_within(fg_placement *placement, double degrees, int most,
                                     int *count);

/* The arrows of the present scale: an arrow has the same `id` in all scales; `area`
 * (volume) and `speed` (mean) are of the points that are nearest to it, width follows
 * that speed, and `cluster` is the id until fg_placement_find_clusters. MEMORY. */
FG_API fg_status fg_placement_icons(fg_icons **out, const fg_placement *placement);

/* The regions of the arrows, each point in that of the arrow nearest to it, as a density
 * to be drawn behind the arrows: u > 0 inside each region, below 0 between two. 2D.
 * MEMORY, UNSUPPORTED (3D). */
FG_API fg_status fg_placement_regions(fg_density **out, const fg_placement *placement);

/* Sets each icon's `cluster` to the cluster of a density, not distributed, that is
 * nearest to its middle; fg_icons_clusters is then their number. MEMORY, ARGUMENT. */
FG_API fg_status fg_placement_find_clusters(fg_context *context, fg_icons *icons,
                                            const fg_density *density);

/* Sets each finer icon's `parent`: its own id where it is still there, else that of the
 * present arrow nearest to it. */
FG_API void fg_placement_find_parents(const fg_placement *placement, fg_icons *finer);

/* Goes on from the icons of a scale, as fg_placement_icons gave them or fg_icons_read
 * read them: the scales that follow are the same. ARGUMENT (not icons of a placement),
 * MEMORY.
 */
FG_API fg_status fg_placement_resume(fg_placement *placement, const fg_icons *icons);

#ifdef __cplusplus
}
#endif

#endif
