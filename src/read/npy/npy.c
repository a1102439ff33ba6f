/* NumPy's files as formats. */
#include "decode/numpy/numpy.h"

#include "read/dataset.h"

static bool is_either(const unsigned char *bytes, size_t size)
{
  return fg__is_npy(bytes, size) || fg__is_npz(bytes, size);
}

static const fg__dataset_format FORMAT = {
    .name = "NumPy", .is_mine = is_either, .open = fg__numpy_open};

FG__DATASET_HOOKS(FORMAT)

#define HOOKS .inventory = inventory_hook, .read = read_hook, .sphere = sphere_hook

const fg__format fg__format_npy = {.name = "NumPy array",
                                   .files = "NumPy's arrays (.npy, .npz)",
                                   .is_mine = fg__is_npy,
                                   HOOKS};
const fg__format fg__format_npz = {.name = "NumPy archive", .is_mine = fg__is_npz, HOOKS};
