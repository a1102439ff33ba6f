/* Opens a NetCDF file and lists its dimensions, variables and attributes, also those in
 * groups. */
#include "base/memory.h"
#include "decode/netcdf/netcdf.h"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST_GROUP = 8 }; /* in practice groups are nested two or three deep */

/* A group that is being listed. */
typedef struct listing {
  fg__dataset *dataset;
  const char *path;     /* of the file */
  int group;            /* ncid */
  const char *name;     /* of the group, with a slash at its end, or "" */
  fg__variable *target; /* whose attributes are added */
  int id;               /* the target's, or NC_GLOBAL */
} listing;

static fg_status fail(fg_context *context, const char *path, const char *what, int error)
{
  if (error == NC_ENOMEM)
    return fg__fail(context, FG_STATUS_MEMORY, "%s: out of memory while reading %s", path,
                    what);
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: damaged: reading %s failed (%s)",
                  path, what, nc_strerror(error));
}

static fg_status fail_listing(const listing *l, const char *what, int error)
{
  return error ? fail(l->dataset->context, l->path, what, error)
               : fg__fail_memory(l->dataset->context, what, 0);
}

static fg_status list_dimensions(const listing *l)
{
  int count = 0, unlimited_count = 0;
  int error = nc_inq_dimids(l->group, &count, NULL, 0);
  if (!error)
    error = nc_inq_unlimdims(l->group, &unlimited_count, NULL);
  int *ids = fg__allocate((size_t)(error ? 0 : count), sizeof *ids);
  int *unlimited = fg__allocate((size_t)(error ? 0 : unlimited_count), sizeof *unlimited);
  bool memory = ids && unlimited;
  if (!error && memory)
    error = nc_inq_dimids(l->group, &count, ids, 0);
  if (!error && memory)
    error = nc_inq_unlimdims(l->group, &unlimited_count, unlimited);
  for (int i = 0; i < count && !error && memory; ++i) {
    char name[NC_MAX_NAME + 1] = "";
    size_t length = 0;
    error = nc_inq_dim(l->group, ids[i], name, &length);
    fg__dimension *d = error ? NULL : fg__dataset_add_dimension(l->dataset, name, length);
    memory = error || d;
    if (!d)
      continue;
    d->id = ids[i];
    d->is_nameless = strncmp(name, "phony_dim_", 10) == 0;
    for (int k = 0; k < unlimited_count; ++k)
      d->unlimited = d->unlimited || unlimited[k] == ids[i];
  }
  free(ids);
  free(unlimited);
  return error || !memory ? fail_listing(l, "its dimensions", error) : FG_STATUS_OK;
}

static int dimension_index(const fg__dataset *dataset, int id)
{
  for (size_t i = 0; i < dataset->dimension_count; ++i)
    if (dataset->dimensions[i].file == dataset->files - 1 &&
        dataset->dimensions[i].id == id)
      return (int)i;
  return -1;
}

static fg_status add_text(const listing *l, const char *name, size_t length)
{
  char *text = fg__allocate(length + 1, 1);
  const int error = text ? nc_get_att_text(l->group, l->id, name, text) : NC_ENOMEM;
  fg_status status = FG_STATUS_OK;
  if (!error) {
    text[length] = '\0';
    status = fg__variable_add_text(l->target, name, text, strlen(text));
  }
  free(text);
  return error == NC_ENOMEM ? fail_listing(l, "an attribute", 0) : status;
}

/* Of several strings the first. */
static fg_status add_strings(const listing *l, const char *name, size_t length)
{
  char **strings = fg__allocate(length, sizeof *strings);
  const int error =
      strings ? nc_get_att_string(l->group, l->id, name, strings) : NC_ENOMEM;
  fg_status status = FG_STATUS_OK;
  if (!error) {
    const char *first = strings[0] ? strings[0] : "";
    status = fg__variable_add_text(l->target, name, first, strlen(first));
    nc_free_string(length, strings);
  }
  free(strings);
  return error == NC_ENOMEM ? fail_listing(l, "an attribute", 0) : status;
}

static fg_status add_numbers(const listing *l, const char *name, nc_type type,
                             size_t length)
{
  double *number = fg__allocate(length, sizeof *number);
  const int error = number ? nc_get_att_double(l->group, l->id, name, number) : NC_ENOMEM;
  fg_status status = FG_STATUS_OK;
  if (!error)
    status = fg__variable_add_numbers(l->target, name, number, length,
                                      type == NC_FLOAT || type == NC_DOUBLE);
  free(number);
  return error == NC_ENOMEM ? fail_listing(l, "an attribute", 0) : status;
}

/* A damaged attribute, or one of a type made by its author, counts as not given. */
static fg_status list_attributes(const listing *l)
{
  int count = 0;
  fg_status status = FG_STATUS_OK;
  if (nc_inq_varnatts(l->group, l->id, &count) != NC_NOERR)
    return FG_STATUS_OK;
  for (int n = 0; n < count && status == FG_STATUS_OK; ++n) {
    char name[NC_MAX_NAME + 1] = "";
    nc_type type;
    size_t length;
    if (nc_inq_attname(l->group, l->id, n, name) != NC_NOERR ||
        nc_inq_att(l->group, l->id, name, &type, &length) != NC_NOERR)
      continue;
    if (type == NC_CHAR)
      status = add_text(l, name, length);
    else if (type == NC_STRING && length > 0)
      status = add_strings(l, name, length);
    else if (type >= NC_BYTE && type <= NC_UINT64 && length > 0)
      status = add_numbers(l, name, type, length);
  }
  return status;
}

/* Types as libnetcdf numbers them, with the values of samples that were never written;
 * types of one byte have none. */
static const struct {
  fg__type type;
  double fill;
} TYPES[] = {
    [NC_BYTE] = {FG__TYPE_INT8, (double)NAN},
    [NC_CHAR] = {FG__TYPE_LETTERS, (double)NAN},
    [NC_SHORT] = {FG__TYPE_INT16, NC_FILL_SHORT},
    [NC_INT] = {FG__TYPE_INT32, NC_FILL_INT},
    [NC_FLOAT] = {FG__TYPE_FLOAT32, (double)NC_FILL_FLOAT},
    [NC_DOUBLE] = {FG__TYPE_FLOAT64, NC_FILL_DOUBLE},
    [NC_UBYTE] = {FG__TYPE_UINT8, (double)NAN},
    [NC_USHORT] = {FG__TYPE_UINT16, NC_FILL_USHORT},
    [NC_UINT] = {FG__TYPE_UINT32, NC_FILL_UINT},
    [NC_INT64] = {FG__TYPE_INT64, (double)NC_FILL_INT64},
    [NC_UINT64] = {FG__TYPE_UINT64, (double)NC_FILL_UINT64},
    [NC_STRING] = {FG__TYPE_TEXTS, (double)NAN},
};

static int describe_variable(fg__variable *v, int group, int id, int rank)
{
  int ids[NC_MAX_VAR_DIMS], storage = NC_CHUNKED;
  nc_type type = NC_NAT;
  v->place = group;
  v->id = id;
  v->rank = rank <= FG__RANK ? rank : FG__RANK + 1;
  int error = nc_inq_vartype(group, id, &type);
  if (!error)
    error = nc_inq_vardimid(group, id, ids);
  if (error)
    return error;
  if (type >= NC_BYTE && type <= NC_STRING) {
    v->type = TYPES[type].type;
    v->fill = TYPES[type].fill;
  }
  v->in_one_run = nc_inq_var_chunking(group, id, &storage, NULL) == NC_NOERR &&
                  storage == NC_CONTIGUOUS;
  for (int k = 0; k < rank && k < FG__RANK; ++k) {
    v->dimension[k] = dimension_index(v->owner, ids[k]);
    if (v->dimension[k] < 0)
      return NC_EBADDIM;
  }
  return NC_NOERR;
}

/* Vector variables (hvel of SCHISM) are listed as two variables of one name. */
static bool is_vector(const fg__dataset *dataset, const fg__variable *v)
{
  if (v->rank < 2 || v->rank > FG__RANK || !fg__is_floating(v))
    return false;
  const fg__dimension *last = &dataset->dimensions[v->dimension[v->rank - 1]];
  return last->length == 2 && strcmp(last->name, "two") == 0;
}

static fg_status split_vector(fg__dataset *dataset)
{
  fg__variable *v = &dataset->variables[dataset->variable_count - 1];
  if (!is_vector(dataset, v))
    return FG_STATUS_OK;
  --v->rank;
  return fg__dataset_split(dataset, 2);
}

static fg_status list_variable(const listing *l, int id)
{
  char name[NC_MAX_NAME + 1] = "";
  int rank = 0;
  int error = nc_inq_varname(l->group, id, name);
  if (!error)
    error = nc_inq_varndims(l->group, id, &rank);
  if (!error && rank > NC_MAX_VAR_DIMS)
    error = NC_EMAXDIMS;
  if (error)
    return fail_listing(l, "its variables", error);
  fg__variable *v = fg__dataset_add_variable(l->dataset, l->name, name);
  if (!v)
    return FG_STATUS_MEMORY;
  error = describe_variable(v, l->group, id, rank);
  if (error)
    return fail_listing(l, "its variables", error);
  listing of = *l;
  of.target = v;
  of.id = id;
  const fg_status status = list_attributes(&of);
  return status == FG_STATUS_OK ? split_vector(l->dataset) : status;
}

static fg_status list_variables(const listing *l)
{
  int count = 0;
  int error = nc_inq_varids(l->group, &count, NULL);
  int *ids = fg__allocate((size_t)(error ? 0 : count), sizeof *ids);
  if (ids && !error)
    error = nc_inq_varids(l->group, &count, ids);
  fg_status status =
      ids && !error ? FG_STATUS_OK : fail_listing(l, "its variables", error);
  for (int i = 0; ids && i < count && status == FG_STATUS_OK; ++i)
    status = list_variable(l, ids[i]);
  free(ids);
  return status;
}

static fg_status list_group(const listing *l, int depth)
{
  listing own = *l;
  own.target = fg__dataset_add_group(l->dataset);
  own.id = NC_GLOBAL;
  fg_status status = own.target ? list_attributes(&own) : FG_STATUS_MEMORY;
  if (status == FG_STATUS_OK)
    status = list_dimensions(l);
  if (status == FG_STATUS_OK)
    status = list_variables(l);
  int count = 0;
  if (status != FG_STATUS_OK || depth >= DEEPEST_GROUP ||
      nc_inq_grps(l->group, &count, NULL) != NC_NOERR || count <= 0)
    return status;
  int *ids = fg__allocate((size_t)count, sizeof *ids);
  if (!ids)
    return fail_listing(l, "groups", 0);
  int error = nc_inq_grps(l->group, &count, ids);
  for (int i = 0; i < count && !error && status == FG_STATUS_OK; ++i) {
    char name[NC_MAX_NAME + 1] = "";
    char whole[FG__NAME_BYTES];
    error = nc_inq_grpname(ids[i], name);
    snprintf(whole, sizeof whole, "%.*s%.*s/", NC_MAX_NAME - 1, l->name, NC_MAX_NAME,
             name);
    const listing below = {l->dataset, l->path, ids[i], whole, NULL, NC_GLOBAL};
    if (!error)
      status = list_group(&below, depth + 1);
  }
  free(ids);
  return error ? fail_listing(l, "its groups", error) : status;
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

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  const fg_status status = fg__nc_check_chunks(v, start, count);
  if (status != FG_STATUS_OK)
    return status;
  const int error = fg__nc_get_numbers(v, start, count, out);
  return error ? fail(v->owner->context, v->path, v->name, error) : FG_STATUS_OK;
}

static int fetch_letters(const fg__variable *v, const size_t *start, const size_t *count,
                         char *out, size_t size)
{
  const size_t length = count[v->rank - 1];
  char *letters = fg__allocate(count[0] * length, 1);
  const int error =
      letters ? nc_get_vara_text(v->place, v->id, start, count, letters) : NC_ENOMEM;
  const size_t kept = length < size ? length : size - 1;
  for (size_t n = 0; n < count[0] && !error; ++n) {
    memcpy(out + n * size, letters + n * length, kept);
    out[n * size + kept] = '\0';
  }
  free(letters);
  return error;
}

static int fetch_strings(const fg__variable *v, const size_t *start, const size_t *count,
                         char *out, size_t size)
{
  char **strings = fg__allocate(count[0], sizeof *strings);
  const int error =
      strings ? nc_get_vara_string(v->place, v->id, start, count, strings) : NC_ENOMEM;
  for (size_t n = 0; n < count[0] && !error; ++n)
    snprintf(out + n * size, size, "%s", strings[n] ? strings[n] : "");
  if (!error)
    nc_free_string(count[0], strings);
  free(strings);
  return error;
}

static fg_status fetch_texts(const fg__variable *v, size_t first, size_t count, char *out,
                             size_t size)
{
  const bool letters = v->type == FG__TYPE_LETTERS;
  const size_t start[2] = {first, 0};
  size_t counts[2] = {count, 0};
  if (letters)
    counts[1] = v->owner->dimensions[v->dimension[1]].length;
  const fg_status status = fg__nc_check_chunks(v, start, counts);
  if (status != FG_STATUS_OK)
    return status;
  const int error =
      (letters ? fetch_letters : fetch_strings)(v, start, counts, out, size);
  return error ? fail(v->owner->context, v->path, v->name, error) : FG_STATUS_OK;
}

static void close_state(void *state)
{
  fg__nc_state *nc = state;
  if (nc->is_open)
    nc_close(nc->root);
  fg__nc_storage_close(&nc->storage);
}

static const fg__decoder DECODER = {.fetch = fetch,
                                    .fetch_texts = fetch_texts,
                                    .state_bytes = sizeof(fg__nc_state),
                                    .close = close_state};

fg_status fg__nc_open(fg__dataset *dataset, fg_context *context, const fg__source *source,
                      const fg_read_options *options)
{
  (void)options;
  fg_status status =
      fg__dataset_begin(dataset, context, source->path, source->size, &DECODER);
  if (status == FG_STATUS_OK)
    status = fg__nc_check_size(context, source);
  if (status != FG_STATUS_OK)
    return status;
  fg__nc_state *state = dataset->file[dataset->files - 1].state;
  if (fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5)
    status = fg__nc_check_objects(&state->storage, context, source);
  if (status != FG_STATUS_OK)
    return status;
  const int error = open_source(source, &state->root);
  state->is_open = !error;
  if (error)
    return error == NC_ENOMEM ? fail(context, source->path, "its header", error)
                              : fg__fail(context, FG_STATUS_FILE_FORMAT,
                                         "%s: not a NetCDF file, or a damaged one (%s)",
                                         source->path, nc_strerror(error));
  const listing root = {dataset, source->path, state->root, "", NULL, NC_GLOBAL};
  return list_group(&root, 0);
}
