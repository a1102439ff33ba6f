/* NumPy's files as formats. */
#include "read/npy/npy.h"

static fg_status read_either(fg_field **field, fg__sphere **sphere, fg_context *context,
                             const fg__source *source, const fg_read_options *options,
                             fg__slab_index slab)
{
  fg__npy_file *file = NULL;
  fg__npy_choice choice = {0};
  fg__scatter_between between;
  fg_status status = fg__check_one_file(context, source, options, "NumPy's files");
  if (status == FG_STATUS_OK)
    status = fg__npy_open(&file, context, source);
  if (status == FG_STATUS_OK)
    status = fg__npy_choose(&choice, file, options);
  if (status == FG_STATUS_OK)
    status = fg__npy_field(field, &between, sphere, file, &choice, options, slab);
  fg__npy_close(file);
  return status;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  *out = NULL;
  return read_either(out, NULL, context, source, options, slab);
}

static fg_status read_sphere(fg__sphere **out, fg_context *context,
                             const fg__source *source, const fg_read_options *options)
{
  *out = NULL;
  return read_either(NULL, out, context, source, options, (fg__slab_index){0, 1});
}

/* Of arrays with a first axis more than the field's: how many times that is. */
static int count_times(const fg__npy_choice *choice)
{
  const fg__npy_array *u = choice->velocity[0];
  return u && choice->velocity[1] && u->rank > choice->dimension && u->shape[0] < 1 << 30
             ? (int)u->shape[0]
             : 1;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  static const fg_read_options defaults = {0};
  fg__npy_file *file = NULL;
  fg__npy_choice choice = {0};
  fg_field *field = NULL;
  fg__scatter_between between = {0};
  fg_inventory_vector entry = {.units = ""};
  fg_status status = fg__npy_open(&file, context, source);
  if (status == FG_STATUS_OK)
    status = fg__npy_choose(&choice, file, &defaults);
  if (status == FG_STATUS_OK)
    status = fg__npy_field(&field, &between, NULL, file, &choice, &defaults,
                           (fg__slab_index){0, 1});
  if (status == FG_STATUS_OK) {
    for (int k = 0; k < 3 && choice.velocity[k]; ++k)
      entry.name[k] = choice.velocity[k]->name;
    entry.cells = between.cells;
    entry.points = between.points;
    entry.found_by = choice.found_by;
    entry.times = count_times(&choice);
    status = fg__scatter_describe(inventory, context, field, entry);
  }
  fg_field_destroy(field);
  fg__npy_close(file);
  return status;
}

const fg__format fg__format_npy = {.name = "NumPy array",
                                   .files = "NumPy's arrays (.npy, .npz)",
                                   .is_mine = fg__is_npy,
                                   .inventory = describe,
                                   .read = read_field,
                                   .sphere = read_sphere};
const fg__format fg__format_npz = {.name = "NumPy archive",
                                   .is_mine = fg__is_npz,
                                   .inventory = describe,
                                   .read = read_field,
                                   .sphere = read_sphere};
