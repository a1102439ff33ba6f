/* Labels and windows of a density that several ranks share: every rank knows where each
 * cluster lies, and gets the patches it asks for. */
#ifndef FG__SHARED_H
#define FG__SHARED_H

#include "cluster/raster.h"
#include "density/share.h"

/* What fg__labels_create finds in the whole density, alike on all ranks, but for `label`:
 * each rank's share has those of its own nodes. Collective. MEMORY. */
fg_status fg__labels_create_shared(fg__labels *out, fg_context *context,
                                   const fg_density *density);

/* A patch and who wants it. */
typedef struct fg__wanted_patch {
  fg__patch patch;
  int rank;
} fg__wanted_patch;

/* Gives u, label and active to the patches that this rank wants; all say the same places
 * and ranks. fg__patch_clear ends each. Collective. MEMORY. */
fg_status fg__patches_fill(fg_context *context, const fg_density *density,
                           fg__wanted_patch *wanted, int count);
void fg__patch_clear(fg__patch *patch);

#endif
