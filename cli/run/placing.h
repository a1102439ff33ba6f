/* Placing the arrows of a run's scales, one after the other, in the drawing's thread. */
#ifndef RUN_PLACING_H
#define RUN_PLACING_H

#include "option/settings.h"

/* A snapshot to be drawn. It owns its parts (snapshot_clear). */
typedef struct scale_snapshot {
  fg_density *density; /* NULL: what needs it has been done */
  fg_icons *icons;     /* NULL: to be made, unless the density is missing, too */
  double time, energy, area_fraction;
  int clusters;
  double icon_seconds, file_seconds; /* spent on it so far */
} scale_snapshot;

void snapshot_clear(scale_snapshot *snapshot);

typedef struct cli_placing {
  const run_settings *settings;
  const fg_field *field; /* whole */
  fg_context *context;
  fg_placement *placement; /* NULL: not begun */
} cli_placing;

/* Makes the icons of a scale of exactly `count` arrows; it goes on from `finer`, those of
 * the scale before, whose parents it sets, or starts from the clusters of the snapshot's
 * density when that is NULL. */
fg_status placing_make(fg_icons **out, cli_placing *placing, int count,
                       const scale_snapshot *snapshot, fg_icons *finer);

/* What the picture's --tint shows of them; NULL in 3D or without --tint. */
fg_status placing_regions(fg_density **out, const cli_placing *placing);

/* Stores the readers' errors with icons; nothing where the field cannot be scored. */
fg_status placing_score(fg_context *context, const fg_field *field, fg_icons *icons);

/* Finds the fewest arrows that reach --tolerance. Returns an exit code. */
int placing_find_count(int *count, fg_context *context, const run_settings *settings,
                       const fg_field *field);

void placing_clear(cli_placing *placing);

#endif
