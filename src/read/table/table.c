/* Tables as a format. */
#include "decode/table/table.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {
    .name = "table", .is_mine = fg__is_table, .open = fg__table_open};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_table = {
    .name = "table",
    .files = "tables of points in text (.csv, .txt, .dat, .vec)",
    .is_mine = fg__is_table,
    .inventory = inventory_hook,
    .read = read_hook,
    .sphere = sphere_hook};
