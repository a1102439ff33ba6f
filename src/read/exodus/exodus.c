/* Exodus II as a format. */
#include "decode/exodus/exodus.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "Exodus",
                                          .is_mine = fg__is_exodus,
                                          .open_chosen = fg__exodus_open,
                                          .alone = "Exodus files"};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_exodus = {.name = "Exodus",
                                      .files = "Exodus II (.exo, .e)",
                                      .is_mine = fg__is_exodus,
                                      .inventory = inventory_hook,
                                      .sphere = sphere_hook,
                                      .read = read_hook};
