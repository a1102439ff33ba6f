/* Which arrays are velocities and places. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "read/npy/npy.h"
#include "read/table/table.h"

/* Whether the arrays have the names that numpy.savez gives those without: arr_0, arr_1.
 */
static bool is_nameless(const fg__npy_file *file)
{
  bool nameless = true;
  for (size_t i = 0; i < file->count && nameless; ++i) {
    char name[FG__NPY_NAME];
    snprintf(name, sizeof name, "arr_%zu", i);
    nameless = strcmp(file->array[i].name, name) == 0;
  }
  return nameless;
}

/* Names of arrays are chosen from as those of a table's columns are: four or six without
 * names are places and velocity. */
static fg_status make_table(fg__table *out, fg__npy_file *file)
{
  *out = (fg__table){.context = file->context,
                     .path = file->path,
                     .named = !is_nameless(file) || file->count < 4,
                     .placeless = true,
                     .columns = (int)file->count};
  out->column = fg__allocate(file->count, sizeof *out->column);
  if (!out->column)
    return fg__fail_memory(file->context, "names of arrays", file->count * 200);
  for (size_t i = 0; i < file->count; ++i)
    fg__table_name(&out->column[i], file->array[i].name, strlen(file->array[i].name));
  return FG_STATUS_OK;
}

static fg__npy_array *array_at(fg__npy_file *file, int index)
{
  return index < 0 ? NULL : &file->array[index];
}

static bool take_first_axis(const fg__npy_array *a, size_t components)
{
  return a->shape[0] == components;
}

static bool take_last_axis(const fg__npy_array *a, size_t components)
{
  return a->shape[a->rank - 1] == components;
}

/* Whether one array may be all of a vector field, and how. */
static bool is_vector(fg__npy_choice *out, fg__npy_array *a)
{
  *out = (fg__npy_choice){.velocity = {a}, .component_axis = -1, .dimension = 2};
  if (a->kind == FG__NPY_COMPLEX)
    return a->rank == 2;
  if (a->kind == FG__NPY_BOOL)
    return false;
  if (a->rank == 2 && (a->shape[1] == 4 || a->shape[1] == 6)) {
    out->table = true;
    out->dimension = a->shape[1] == 4 ? 2 : 3;
    return true;
  }
  if (a->rank != 3 && a->rank != 4)
    return false;
  const size_t components = (size_t)a->rank - 1;
  out->dimension = a->rank - 1;
  if (take_first_axis(a, components) == take_last_axis(a, components))
    return false;
  out->component_axis = take_first_axis(a, components) ? 0 : a->rank - 1;
  return true;
}

static void describe(char *out, size_t size, const fg__npy_file *file)
{
  size_t used = 0;
  out[0] = '\0';
  for (size_t i = 0; i < file->count && used + 200 < size; ++i) {
    const fg__npy_array *a = &file->array[i];
    if (!a->name[0])
      continue;
    used +=
        (size_t)snprintf(out + used, size - used, "%s%s (", used ? ", " : "", a->name);
    for (int k = 0; k < a->rank && k < FG__NPY_RANK; ++k)
      used +=
          (size_t)snprintf(out + used, size - used, "%s%zu", k ? " x " : "", a->shape[k]);
    used += (size_t)snprintf(out + used, size - used, "%s)",
                             a->kind == FG__NPY_COMPLEX ? " complex" : "");
  }
}

static fg_status fail_none(const fg__npy_file *file)
{
  char arrays[1024];
  describe(arrays, sizeof arrays, file);
  fg__fail(file->context, FG_STATUS_UNSUPPORTED, "%s: no vectors among its arrays: %s",
           file->path, arrays);
  fg__hint(file->context, "u and v by name; or one array of 2 x ny x nx, ny x nx x 2, ny "
                          "x nx complex, or points x 4 (x, y, u, v)");
  return FG_STATUS_UNSUPPORTED;
}

/* The only array that may be a vector field by itself. */
static fg_status find_vector(fg__npy_choice *out, fg__npy_file *file)
{
  fg__npy_choice found;
  int count = 0;
  for (size_t i = 0; i < file->count; ++i)
    if (file->array[i].name[0] && is_vector(&found, &file->array[i]) && ++count == 1)
      *out = found;
  if (count == 1)
    return FG_STATUS_OK;
  if (count == 0)
    return fail_none(file);
  fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: %d arrays could be the vectors",
           file->path, count);
  fg__hint(file->context, "choose one: --vars %s", out->velocity[0]->name);
  return FG_STATUS_ARGUMENT;
}

static void take_places(fg__npy_choice *out, fg__npy_file *file,
                        const fg__table_vector *named)
{
  out->geographic = named->geographic;
  for (int k = 0; k < 3; ++k)
    out->position[k] = array_at(file, named->position[k]);
}

static fg_status fail_polar(const fg__npy_file *file, const fg__table_vector *named)
{
  fg__fail(
      file->context, FG_STATUS_UNSUPPORTED,
      "%s: %s and %s are a speed and a direction, which are not read from NumPy files",
      file->path, file->array[named->velocity[0]].name,
      file->array[named->velocity[1]].name);
  fg__hint(file->context,
           "save u = %sspeed * sin(direction) and v = %sspeed * "
           "cos(direction)",
           named->polar.sense < 0 ? "-" : "", named->polar.sense < 0 ? "-" : "");
  return FG_STATUS_UNSUPPORTED;
}

static fg_status choose_pair(fg__npy_choice *out, fg__npy_file *file,
                             const fg__table_vector *named)
{
  if (named->polar.sense != 0)
    return fail_polar(file, named);
  *out = (fg__npy_choice){
      .component_axis = -1, .dimension = named->dimension, .found_by = named->found_by};
  for (int k = 0; k < named->dimension && k < 3; ++k) {
    out->velocity[k] = array_at(file, named->velocity[k]);
    const fg__npy_array *a = out->velocity[k];
    if (!a->name[0] || a->kind == FG__NPY_COMPLEX)
      return fail_none(file);
  }
  take_places(out, file, named);
  return FG_STATUS_OK;
}

static fg_status choose(fg__npy_choice *out, fg__npy_file *file, const fg__table *table,
                        const fg_read_options *options)
{
  fg__table_vector named[FG__TABLE_VECTORS];
  const bool one = options->vars && !strchr(options->vars, ',');
  if (!options->vars && !table->named && file->count != 4 && file->count != 6)
    return fail_none(file);
  int count = 0;
  fg_status status = FG_STATUS_OK;
  if (!options->vars)
    status = fg__table_vectors(named, &count, table);
  if (status == FG_STATUS_OK && !one && (options->vars || count > 0)) {
    status = fg__table_choose(named, table, options);
    return status == FG_STATUS_OK ? choose_pair(out, file, named) : status;
  }
  if (status != FG_STATUS_OK)
    return status;
  const int index = one ? fg__table_find(table, options->vars) : -1;
  if (one && (index < 0 || !is_vector(out, &file->array[index])))
    status = fail_none(file);
  else if (!one)
    status = find_vector(out, file);
  if (status == FG_STATUS_OK && !out->table) {
    fg__table_places(named, table);
    if (options->scale != FG_SCALE_AUTO)
      named->geographic = options->scale == FG_SCALE_GEO;
    take_places(out, file, named);
  }
  if (status == FG_STATUS_OK)
    out->found_by = one ? "vars" : "shape";
  return status;
}

fg_status fg__npy_choose(fg__npy_choice *out, fg__npy_file *file,
                         const fg_read_options *options)
{
  fg__table table;
  fg_status status = make_table(&table, file);
  if (status == FG_STATUS_OK)
    status = choose(out, file, &table, options);
  if (status == FG_STATUS_OK) {
    /* numpy.ma's masks are True where a value is not to be used */
    const int mask = fg__table_find(&table, options->mask ? options->mask : "mask");
    if (options->mask && mask < 0)
      status = fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: no array \"%.100s\"",
                        file->path, options->mask);
    else if (mask >= 0 && (options->mask || file->array[mask].kind == FG__NPY_BOOL))
      out->mask = &file->array[mask];
    out->mask_hides = !options->mask;
  }
  free(table.column);
  return status;
}
