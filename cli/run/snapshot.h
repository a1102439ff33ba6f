/* Takes the snapshots of an evolution that become scales. */
#ifndef RUN_SNAPSHOT_H
#define RUN_SNAPSHOT_H

#include "run/run.h"

/* Takes a snapshot. A single rank gets the density, and the drawing does the rest.
 * Several ranks make icons and write the density together, without gathering it (except
 * for --tint and --background); rank 0 draws. Collective. Returns an exit code; the
 * caller owns the parts. */
int snapshot_take(scale_snapshot *out, cli_run *run);

#endif
