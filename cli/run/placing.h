/* Places the arrows of a run's scales, in the drawing's thread. */
#ifndef RUN_PLACING_H
#define RUN_PLACING_H

#include "option/settings.h"

/* A snapshot to draw; it owns its parts (snapshot_clear). */
typedef struct scale_snapshot {
  fg_density *density; /* NULL: no longer needed */
  fg_icons *icons;     /* NULL: to be made from the density, if there is one */
  double time, energy, area_fraction;
  int clusters;
  double icon_seconds, file_seconds; /* spent on it so far */
} scale_snapshot;

void snapshot_clear(scale_snapshot *snapshot);

typedef struct cli_placing {
  const run_settings *settings;
  const fg_field *field; /* whole */
  fg_context *context;
  fg_placement *placement; /* NULL: not yet created */
} cli_placing;

/* Makes the icons of a scale of exactly `count` arrows. It continues from `finer`, the
 * icons of the scale before, and sets their parents; where `finer` is NULL it starts from
 * the clusters of the snapshot's density. */
fg_status placing_make(fg_icons **out, cli_placing *placing, int count,
                       const scale_snapshot *snapshot, fg_icons *finer);

/* The regions of the arrows for --tint; NULL in 3D or without --tint. */
fg_status placing_regions(fg_density **out, const cli_placing *placing);

/* Stores errors (score.h) with icons; nothing where the field cannot be scored. */
fg_status placing_score(fg_context *context, const run_settings *settings,
                        const fg_field *field, fg_icons *icons);

/* Finds the smallest number of arrows that satisfies --tolerance. Returns an exit
 * code. */
int placing_find_count(int *count, fg_context *context, const run_settings *settings,
                       const fg_field *field);

void placing_clear(cli_placing *placing);

#endif
