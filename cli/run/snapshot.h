/* Takes the snapshots of an evolution that are drawn. */
#ifndef RUN_SNAPSHOT_H
#define RUN_SNAPSHOT_H

#include "run/run.h"

/* Takes a snapshot. One rank gets the density and leaves the rest to the drawing. Several
 * make the icons and write the density together, none having it whole (but for --tint
 * and --background); what there is to draw then is rank 0's. Collective. Returns an exit
 * code; the parts are the caller's. */
int snapshot_take(scale_snapshot *out, cli_run *run);

#endif
