/* Opens a NetCDF file and lists its dimensions and variables, also those in groups. */
#include "base/memory.h"
#include "read/netcdf/netcdf.h"

#include <netcdf_mem.h>

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { DEEPEST_GROUP = 8 }; /* in practice groups are nested two or three deep */

fg_status fg__nc_fail(fg_context *context, const char *path, const char *what, int error)
{
  if (error == NC_ENOMEM)
    return fg__fail(context, FG_STATUS_MEMORY, "%s: out of memory while reading %s", path,
                    what);
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: damaged: reading %s failed (%s)",
                  path, what, nc_strerror(error));
}

static fg_status list_dimensions(fg__nc_file *file, int root, int group, const char *path)
{
  int count = 0;
  int error = nc_inq_dimids(group, &count, NULL, 0);
  int *ids = fg__allocate((size_t)(count > 0 ? count : 0), sizeof *ids);
  int *unlimited = NULL;
  int unlimited_count = 0;
  if (!ids)
    return fg__fail_memory(file->context, "dimensions", (size_t)count * sizeof *ids);
  if (!error)
    error = nc_inq_dimids(group, &count, ids, 0);
  if (!error)
    error = nc_inq_unlimdims(group, &unlimited_count, NULL);
  unlimited = fg__allocate((size_t)unlimited_count, sizeof *unlimited);
  if (!error && unlimited)
    error = nc_inq_unlimdims(group, &unlimited_count, unlimited);
  void *grown = file->dimensions;
  const bool memory = unlimited && fg__grow(&grown, &file->dimension_capacity,
                                            file->dimension_count + (size_t)count,
                                            sizeof *file->dimensions);
  file->dimensions = grown;
  for (int i = 0; i < count && !error && memory; ++i) {
    fg__nc_dimension *d = &file->dimensions[file->dimension_count];
    *d = (fg__nc_dimension){.id = ids[i], .root = root};
    error = nc_inq_dim(group, ids[i], d->name, &d->length);
    for (int k = 0; k < unlimited_count; ++k)
      d->unlimited = d->unlimited || unlimited[k] == ids[i];
    ++file->dimension_count;
  }
  free(ids);
  free(unlimited);
  if (error)
    return fg__nc_fail(file->context, path, "its dimensions", error);
  return memory ? FG_STATUS_OK : fg__fail_memory(file->context, "dimensions", 0);
}

static int dimension_index(const fg__nc_file *file, int root, int id)
{
  for (size_t i = 0; i < file->dimension_count; ++i)
    if (file->dimensions[i].root == root && file->dimensions[i].id == id)
      return (int)i;
  return -1;
}

static int describe_variable(fg__nc_variable *v, const fg__nc_file *file, int root,
                             int group, int id, const char *group_name)
{
  char name[NC_MAX_NAME + 1] = "";
  int ids[NC_MAX_VAR_DIMS];
  v->group = group;
  v->id = id;
  int error = nc_inq_varndims(group, id, &v->rank);
  if (error || v->rank > NC_MAX_VAR_DIMS)
    return error ? error : NC_EMAXDIMS;
  error = nc_inq_var(group, id, name, &v->type, NULL, ids, NULL);
  if (error)
    return error;
  snprintf(v->name, sizeof v->name, "%.*s%.*s", NC_MAX_NAME, group_name, NC_MAX_NAME,
           name);
  if (v->rank > FG__NC_RANK)
    v->rank = FG__NC_RANK + 1;
  for (int k = 0; k < v->rank && k < FG__NC_RANK; ++k) {
    v->dimension[k] = dimension_index(file, root, ids[k]);
    if (v->dimension[k] < 0)
      return NC_EBADDIM;
  }
  return NC_NOERR;
}

/* Vector variables (hvel of SCHISM) are listed as two variables of one name. */
static bool is_vector(const fg__nc_file *file, const fg__nc_variable *v)
{
  if (v->rank < 2 || v->rank > FG__NC_RANK ||
      (v->type != NC_FLOAT && v->type != NC_DOUBLE))
    return false;
  const fg__nc_dimension *last = &file->dimensions[v->dimension[v->rank - 1]];
  return last->length == 2 && strcmp(last->name, "two") == 0;
}

static void split_vector(fg__nc_file *file)
{
  fg__nc_variable *v = &file->variables[file->variable_count - 1];
  if (!is_vector(file, v))
    return;
  --v->rank;
  v->element = 1;
  file->variables[file->variable_count] = *v;
  file->variables[file->variable_count++].element = 2;
}

static fg_status list_variables(fg__nc_file *file, int root, int group,
                                const char *group_name, const char *path)
{
  int count = 0;
  int error = nc_inq_varids(group, &count, NULL);
  int *ids = fg__allocate((size_t)(count > 0 ? count : 0), sizeof *ids);
  void *grown = file->variables;
  if (!ids ||
      !fg__grow(&grown, &file->variable_capacity,
                file->variable_count + 2 * (size_t)count, sizeof *file->variables)) {
    free(ids);
    return fg__fail_memory(file->context, "variables",
                           (size_t)count * sizeof *file->variables);
  }
  file->variables = grown;
  if (!error)
    error = nc_inq_varids(group, &count, ids);
  for (int i = 0; i < count && !error; ++i) {
    fg__nc_variable *v = &file->variables[file->variable_count];
    *v = (fg__nc_variable){.owner = file, .path = path, .file = file->root_count - 1};
    error = describe_variable(v, file, root, group, ids[i], group_name);
    ++file->variable_count;
    if (!error)
      split_vector(file);
  }
  free(ids);
  return error ? fg__nc_fail(file->context, path, "its variables", error) : FG_STATUS_OK;
}

static fg_status list_group(fg__nc_file *file, int root, int group, const char *name,
                            const char *path, int depth)
{
  fg_status status = list_dimensions(file, root, group, path);
  if (status == FG_STATUS_OK)
    status = list_variables(file, root, group, name, path);
  int count = 0;
  if (status != FG_STATUS_OK || depth >= DEEPEST_GROUP ||
      nc_inq_grps(group, &count, NULL) != NC_NOERR || count <= 0)
    return status;
  int *ids = fg__allocate((size_t)count, sizeof *ids);
  if (!ids)
    return fg__fail_memory(file->context, "groups", (size_t)count * sizeof *ids);
  int error = nc_inq_grps(group, &count, ids);
  for (int i = 0; i < count && !error && status == FG_STATUS_OK; ++i) {
    char own[NC_MAX_NAME + 1] = "";
    char whole[FG__NC_NAME];
    error = nc_inq_grpname(ids[i], own);
    snprintf(whole, sizeof whole, "%.*s%.*s/", NC_MAX_NAME - 1, name, NC_MAX_NAME, own);
    if (!error)
      status = list_group(file, root, ids[i], whole, path, depth + 1);
  }
  free(ids);
  return error ? fg__nc_fail(file->context, path, "its groups", error) : status;
}

/* libnetcdf takes a name like "http:..." for a URL; a path that starts with a directory
 * is always a file. */
static char *local_path(const char *path)
{
  const size_t length = strlen(path);
  const char *directory = path[0] == '/' ? "" : "./";
  char *local = length < SIZE_MAX - 3 ? fg__allocate(length + 3, 1) : NULL;
  if (local)
    snprintf(local, length + 3, "%s%s", directory, path);
  return local;
}

static int open_source(const fg__source *source, int *root)
{
  if (!source->on_disk)
    return nc_open_mem("memory", NC_NOWRITE, source->size,
                       (void *)(uintptr_t)source->bytes, root);
  char *path = local_path(source->path);
  if (!path)
    return NC_ENOMEM;
  const int error = nc_open(path, NC_NOWRITE, root);
  free(path);
  return error;
}

fg_status fg__nc_file_open(fg__nc_file *file, fg_context *context,
                           const fg__source *source)
{
  file->context = context;
  if (file->root_count == FG__NC_FILES)
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: one file too many", source->path);
  fg__nc_storage *storage = &file->storage[file->root_count];
  fg_status status = fg__nc_check_size(context, source);
  if (status == FG_STATUS_OK &&
      fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5)
    status = fg__nc_check_objects(storage, context, source);
  if (status != FG_STATUS_OK)
    return status;
  char *path = fg__copy_text(source->path);
  if (!path)
    return fg__fail_memory(context, "a file's name", 0);
  int root = 0;
  const int error = open_source(source, &root);
  if (error) {
    status = error == NC_ENOMEM ? fg__nc_fail(context, source->path, "its header", error)
                                : fg__fail(context, FG_STATUS_FILE_FORMAT,
                                           "%s: not a NetCDF file, or a damaged one (%s)",
                                           source->path, nc_strerror(error));
    free(path);
    return status;
  }
  file->paths[file->root_count] = path;
  file->sizes[file->root_count] = source->size;
  file->roots[file->root_count++] = root;
  if (file->root_count == 1)
    file->component_files = 1;
  status = list_group(file, root, root, "", path, 0);
  /* the array may have moved as it grew */
  for (size_t i = 0; i < file->variable_count; ++i) {
    fg__nc_variable *v = &file->variables[i];
    const char *slash = strrchr(v->name, '/');
    v->plain_name = slash && slash[1] ? slash + 1 : v->name;
    fg__nc_classify(v);
  }
  return status;
}

/* Whether two paths lead to one file. */
static bool is_one_file(const char *path, const char *other)
{
  struct stat a, b;
  return stat(path, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

fg_status fg__nc_file_add(fg__nc_file *file, const char *path)
{
  fg__source source;
  for (int n = 0; n < file->root_count; ++n)
    if (is_one_file(path, file->paths[n]))
      return fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: is given twice", path);
  fg_status status = fg__source_open(&source, file->context, path);
  if (status == FG_STATUS_OK && fg__nc_kind_of(source.bytes, source.size) == FG__NC_NONE)
    status = fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                      "%s: is no NetCDF file like the first one", path);
  if (status == FG_STATUS_OK)
    status = fg__nc_file_open(file, file->context, &source);
  fg__source_close(&source);
  return status;
}

void fg__nc_file_close(fg__nc_file *file)
{
  for (int i = 0; i < file->root_count; ++i) {
    nc_close(file->roots[i]);
    free(file->paths[i]);
  }
  for (int i = 0; i < FG__NC_FILES; ++i)
    fg__nc_storage_close(&file->storage[i]);
  free(file->dimensions);
  free(file->variables);
  *file = (fg__nc_file){0};
}

const fg__nc_variable *fg__nc_find(const fg__nc_file *file, const char *name)
{
  for (size_t i = 0; i < file->variable_count; ++i)
    if (strcmp(file->variables[i].name, name) == 0)
      return &file->variables[i];
  for (size_t i = 0; i < file->variable_count; ++i)
    if (strcmp(file->variables[i].plain_name, name) == 0)
      return &file->variables[i];
  return NULL;
}

static void trim(char *text)
{
  size_t start = 0;
  size_t end = strlen(text);
  while (end > 0 && isspace((unsigned char)text[end - 1]))
    --end;
  while (start < end && isspace((unsigned char)text[start]))
    ++start;
  memmove(text, text + start, end - start);
  text[end - start] = '\0';
}

fg_status fg__nc_status(const fg__nc_file *file, fg_status status)
{
  return file->exhausted ? FG_STATUS_MEMORY : status;
}

/* A missing or damaged attribute counts as not given. */
static bool is_read(const fg__nc_variable *v, int error, size_t bytes)
{
  if (error == NC_ENOMEM) {
    v->owner->exhausted = true;
    fg__fail_memory(v->owner->context, "an attribute", bytes);
  }
  return error == NC_NOERR;
}

static bool read_text(const fg__nc_variable *v, const char *attribute, size_t length,
                      char *out, size_t size)
{
  char *all = fg__allocate(length + 1, 1);
  const int error = all ? nc_get_att_text(v->group, v->id, attribute, all) : NC_ENOMEM;
  if (!error) {
    all[length] = '\0';
    snprintf(out, size, "%s", all);
  }
  free(all);
  return is_read(v, error, length + 1);
}

static bool read_strings(const fg__nc_variable *v, const char *attribute, size_t length,
                         char *out, size_t size)
{
  if (length == 0)
    return false;
  char **strings = fg__allocate(length, sizeof *strings);
  const int error =
      strings ? nc_get_att_string(v->group, v->id, attribute, strings) : NC_ENOMEM;
  if (!error) {
    snprintf(out, size, "%s", strings[0] ? strings[0] : "");
    nc_free_string(length, strings);
  }
  free(strings);
  return is_read(v, error, length * sizeof *strings);
}

bool fg__nc_text(const fg__nc_variable *variable, const char *attribute, char *out,
                 size_t size)
{
  nc_type type;
  size_t length;
  bool read = false;
  out[0] = '\0';
  if (!is_read(variable,
               nc_inq_att(variable->group, variable->id, attribute, &type, &length), 0))
    return false;
  if (type == NC_CHAR)
    read = read_text(variable, attribute, length, out, size);
  else if (type == NC_STRING)
    read = read_strings(variable, attribute, length, out, size);
  trim(out);
  return read;
}

int fg__nc_numbers(const fg__nc_variable *variable, const char *attribute, double *out,
                   int capacity, nc_type *type)
{
  size_t length;
  if (!is_read(variable,
               nc_inq_att(variable->group, variable->id, attribute, type, &length), 0) ||
      *type == NC_CHAR || *type > NC_UINT64 || *type < NC_BYTE || length == 0)
    return 0;
  double *all = fg__allocate(length, sizeof *all);
  const int error =
      all ? nc_get_att_double(variable->group, variable->id, attribute, all) : NC_ENOMEM;
  int count = 0;
  if (!error)
    for (; count < capacity && (size_t)count < length; ++count)
      out[count] = all[count];
  free(all);
  return is_read(variable, error, length * sizeof *all) ? count : 0;
}
