/* Variables that another program has read. */
#include "flowgrain/dataset.h"
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/interpret.h"

#include <string.h>

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  const fg_variables *all = v->owner->file[0].state;
  return all->fetch(all->user, (size_t)v->id, start, count, out)
             ? FG_STATUS_OK
             : fg__fail(v->owner->context, FG_STATUS_FILE_ACCESS,
                        "%s: '%s' cannot be read", v->path, v->name);
}

static const fg__decoder DECODER = {.fetch = fetch};

/* The number of a dimension, which is added where it is new; -1: no memory. */
static int dimension_of(fg__dataset *data, const char *name, size_t length)
{
  for (size_t k = 0; k < data->dimension_count; ++k)
    if (strcmp(data->dimensions[k].name, name) == 0)
      return (int)k;
  return fg__dataset_add_dimension(data, name, length) ? (int)data->dimension_count - 1
                                                       : -1;
}

static fg_status add_variable(fg__dataset *data, const fg_variable *from, int number)
{
  fg__variable *v = fg__dataset_add_variable(data, "", from->name);
  fg_status status = v ? FG_STATUS_OK : FG_STATUS_MEMORY;
  if (!v)
    return status;
  v->id = number;
  v->fits_file = true;
  v->type = from->is_number ? FG__TYPE_FLOAT64 : FG__TYPE_OTHER;
  for (; v->rank < from->rank && status == FG_STATUS_OK; ++v->rank) {
    const int k = dimension_of(data, from->dimension[v->rank], from->length[v->rank]);
    if (k < 0)
      return FG_STATUS_MEMORY;
    v->dimension[v->rank] = k;
    if (data->dimensions[k].length != from->length[v->rank])
      status = fg__fail(data->context, FG_STATUS_ARGUMENT,
                        "%s: '%.100s' has %zu samples along '%.100s', another variable "
                        "has %zu",
                        v->path, v->name, from->length[v->rank], data->dimensions[k].name,
                        data->dimensions[k].length);
  }
  for (size_t n = 0; n < from->attributes && status == FG_STATUS_OK; ++n) {
    const fg_attribute *a = &from->attribute[n];
    status = a->text ? fg__variable_add_text(v, a->name, a->text, strlen(a->text))
                     : fg__variable_add_numbers(v, a->name, a->number, a->count, true);
  }
  return status;
}

static int number_of(const fg__variable *v)
{
  return v ? v->id : -1;
}

static void describe(fg_vector_meaning *out, const fg__pair *pair, const fg__grid *grid)
{
  const fg__curvilinear *mesh = grid->mesh;
  for (int k = 0; k < 3; ++k)
    out->component[k] = k < grid->dimension ? number_of(pair->component[k]) : -1;
  out->is_polar = pair->polar.sense != 0;
  out->mask = mesh ? number_of(mesh->mask) : -1;
  out->is_geographic = mesh || grid->scale == FG_SCALE_GEO;
  out->is_along_grid = mesh && mesh->turn != FG__TURN_NONE;
  if (mesh) {
    const fg__curvilinear_part *at = mesh->centre.variable ? &mesh->centre : mesh->part;
    out->coordinate[0] = number_of(at->longitude);
    out->coordinate[1] = number_of(at->latitude);
  }
  for (int k = 0; k < 2; ++k) {
    if (!mesh)
      out->coordinate[k] = number_of(grid->axis[k].read_from);
    out->side[k] = mesh ? mesh->shift[k] : 0;
    if (grid->faces.used)
      out->side[k] = grid->faces.before[k] > 0 ? 1 : -1;
  }
  _Static_assert(sizeof out->doubts == sizeof grid->doubts, "lines of doubt");
  memcpy(out->doubts, grid->doubts, sizeof out->doubts);
}

fg_status fg_vector_find(fg_vector_meaning *out, fg_context *context,
                         const fg_variables *variables, const fg_read_options *options)
{
  static const fg_read_options none = {0};
  fg__dataset data = {0};
  fg__pair pair = {0};
  fg__grid grid = {0};
  fg_variables own;
  if (!out || !variables || !variables->fetch)
    return fg__fail(context, FG_STATUS_ARGUMENT, "variables: a NULL argument");
  own = *variables;
  *out = (fg_vector_meaning){.mask = -1};
  fg_status status = fg__dataset_begin(
      &data, context, variables->name ? variables->name : "variables", 0, &DECODER);
  if (status == FG_STATUS_OK) {
    data.file[0].state = &own;
    data.takes_all_samples = true;
    status = fg__dataset_add_group(&data) ? FG_STATUS_OK : FG_STATUS_MEMORY;
  }
  for (size_t n = 0; n < variables->count && status == FG_STATUS_OK; ++n)
    status = add_variable(&data, &variables->variable[n], (int)n);
  if (status == FG_STATUS_OK)
    status = fg__settle_names(&data);
  if (status == FG_STATUS_OK)
    status = fg__choose_vector(&pair, &grid, &data, options ? options : &none);
  if (status == FG_STATUS_OK && grid.unstructured)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: '%.100s' lies at points or on an unstructured mesh",
                      data.file[0].path, pair.component[0]->name);
  else if (status == FG_STATUS_OK && grid.rate)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: '%.100s' lies in a vertical section, which is read from its "
                      "file",
                      data.file[0].path, pair.component[0]->name);
  else if (status == FG_STATUS_OK)
    describe(out, &pair, &grid);
  fg__grid_clear(&grid);
  fg__dataset_close(&data);
  return status;
}
