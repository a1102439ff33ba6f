/* HDF5 files and others whose arrays are named. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "decode/composite/names.h"
#include "decode/hdf/hdf.h"
#include "decode/netcdf/netcdf.h"

enum {
  MOST_TIMES_LARGER = 4096, /* numbers than bytes of their file */
  MOST_FILES = 4096
};

static void close_all(void *held)
{
  fg__hdf *hdf = held;
  for (size_t i = 0; i < hdf->count; ++i) {
    fg__hdf_file *file = hdf->file[i];
    fg__dataset_close(&file->data);
    if (file->path)
      (void)fg__source_close(&file->source, NULL, FG_STATUS_OK);
    free(file->path);
    free(file);
  }
  free(hdf->file);
  free(hdf);
}

fg_status fg__hdf_begin(fg__hdf **out, fg__vtk *vtk)
{
  *out = vtk->held = fg__allocate(1, sizeof **out);
  vtk->close_held = close_all;
  if (!*out)
    return fg__fail_memory(vtk->context, "files of arrays", sizeof **out);
  return FG_STATUS_OK;
}

static fg__hdf_file *add_file(fg__hdf *hdf)
{
  void *grown = hdf->file;
  if (!fg__grow(&grown, &hdf->capacity, hdf->count + 1, sizeof *hdf->file))
    return NULL;
  hdf->file = grown;
  fg__hdf_file *file = fg__allocate(1, sizeof *file);
  if (file)
    hdf->file[hdf->count++] = file;
  return file;
}

fg_status fg__hdf_open(fg__hdf_file **out, fg__vtk *vtk, const char *name,
                       const fg__source *source)
{
  fg__hdf *hdf = vtk->held;
  char *path = NULL;
  fg_status status =
      name ? fg__vtk_names_path(&path, vtk->context, vtk->path, name) : FG_STATUS_OK;
  for (size_t i = 0; path && i < hdf->count && status == FG_STATUS_OK; ++i)
    if (hdf->file[i]->path && strcmp(hdf->file[i]->path, path) == 0) {
      *out = hdf->file[i];
      free(path);
      return FG_STATUS_OK;
    }
  if (status == FG_STATUS_OK && hdf->count == MOST_FILES)
    status = fg__fail(vtk->context, FG_STATUS_UNSUPPORTED, "%s: names more than %d files",
                      vtk->path, MOST_FILES);
  fg__hdf_file *file = *out = status == FG_STATUS_OK ? add_file(hdf) : NULL;
  if (status == FG_STATUS_OK && !file)
    status = fg__fail_memory(vtk->context, "a file", sizeof *file);
  if (status != FG_STATUS_OK) {
    free(path);
    return status;
  }
  file->path = path;
  if (path)
    status = fg__source_open(&file->source, vtk->context, path);
  const fg__source *opened = path ? &file->source : source;
  hdf->room += MOST_TIMES_LARGER * (double)opened->size;
  if (status == FG_STATUS_OK &&
      fg__nc_kind_of(opened->bytes, opened->size) == FG__NC_HDF5)
    status = fg__nc_open(&file->data, vtk->context, opened, NULL);
  return status;
}

const fg__variable *fg__hdf_find(const fg__dataset *data, const char *name)
{
  for (size_t i = 0; i < data->variable_count; ++i)
    if (strcmp(data->variables[i].name, name) == 0)
      return &data->variables[i];
  return NULL;
}

static size_t length_of(const fg__variable *v, int k)
{
  return v->owner->dimensions[v->dimension[k]].length;
}

fg_status fg__hdf_count(size_t *out, const fg__variable *v)
{
  const size_t size = v->owner->file[v->file].size;
  double all = 1.0;
  if (!fg__is_number(v) || v->rank > FG__RANK)
    return fg__fail(v->owner->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%.100s' holds no numbers, or has more than %d dimensions",
                    v->path, v->name, FG__RANK);
  for (int k = 0; k < v->rank; ++k)
    all *= (double)length_of(v, k);
  if (all / MOST_TIMES_LARGER > (double)size)
    return fg__fail(v->owner->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%.100s' has %.0f numbers, but the file has only %zu bytes",
                    v->path, v->name, all, size);
  *out = (size_t)all;
  return FG_STATUS_OK;
}

/* In boxes: each is as much of the outermost dimension as the numbers fill. */
fg_status fg__hdf_read(double *out, const fg__variable *v, size_t first, size_t count)
{
  size_t step[FG__RANK], start[FG__RANK] = {0}, part[FG__RANK] = {1}, all = 1;
  if (v->rank == 0)
    return fg__variable_fetch(v, start, part, out);
  for (int k = FG__RANK; k-- > 0; all *= k < v->rank ? length_of(v, k) : 1)
    step[k] = all;
  while (count > 0) {
    int along = 0;
    size_t rest = first;
    while (along + 1 < v->rank && (first % step[along] != 0 || count < step[along]))
      ++along;
    for (int k = 0; k < v->rank; rest %= step[k++]) {
      start[k] = rest / step[k];
      part[k] = k < along ? 1 : length_of(v, k);
    }
    const size_t room = length_of(v, along) - start[along], wanted = count / step[along];
    part[along] = wanted < room ? wanted : room;
    const fg_status status = fg__variable_fetch(v, start, part, out);
    if (status != FG_STATUS_OK)
      return status;
    const size_t done = part[along] * step[along];
    first += done;
    count -= done;
    out += done;
  }
  return FG_STATUS_OK;
}

static fg_status read_part(double *out, const fg__vtk *vtk, const fg__vtk_array *array,
                           size_t first, size_t count)
{
  (void)vtk;
  return fg__hdf_read(out, array->item, array->offset + first, count);
}

fg_status fg__hdf_add_array(fg__vtk *vtk, const fg__variable *variable, const char *name,
                            fg__vtk_place place, int components, size_t first)
{
  fg__vtk_array *array;
  size_t count = 0;
  fg_status status = fg__hdf_count(&count, variable);
  if (status == FG_STATUS_OK)
    status = fg__vtk_add_array(&array, vtk, name, place);
  if (status != FG_STATUS_OK)
    return status;
  array->type = variable->type;
  array->components = components;
  array->storage = FG__VTK_HELD;
  array->item = variable;
  array->offset = first;
  array->text_size = first < count ? count - first : 0;
  array->read = read_part;
  return FG_STATUS_OK;
}
