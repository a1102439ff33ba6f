/* Patches of a density on the ranks that need them. */
#ifndef FG__PATCHES_H
#define FG__PATCHES_H

#include "cluster/raster.h"
#include "density/density.h"

/* A patch and who wants it. */
typedef struct fg__wanted_patch {
  fg__patch patch;
  int rank;
} fg__wanted_patch;

/* Gives u, label and active to the patches that this rank wants; all say the same places
 * and ranks. A process alone has them already: its patches become the whole grid,
 * borrowed. fg__patch_clear ends each. Collective. MEMORY. */
fg_status fg__patches_fill(fg_context *context, const fg_density *density,
                           fg__wanted_patch *wanted, int count);
void fg__patch_clear(fg__patch *patch);

#endif
