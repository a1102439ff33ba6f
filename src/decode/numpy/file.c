/* The arrays of a file, and views of them as variables. */
#include "decode/numpy/numpy.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { HEADER = 1 << 16, MOST_VIEWS = 4 * FG__NPY_ARRAYS + 6 };

/* What a variable has of an array: all of it, a component or a column. */
typedef struct view {
  fg__npy_array *array;
  size_t offset; /* of its first number */
  int rank;
  size_t shape[FG__NPY_RANK], stride[FG__NPY_RANK];
} view;

typedef struct numpy_state {
  fg_context *context;
  const char *path; /* the dataset's */
  fg__zip zip;
  size_t count, views;
  fg__npy_array array[FG__NPY_ARRAYS];
  view view[MOST_VIEWS]; /* a variable's `id` is the number of its view */
} numpy_state;

bool fg__is_npz(const unsigned char *bytes, size_t size)
{
  /* the first entry's name is an array's */
  if (size < 30 || memcmp(bytes, "PK\003\004", 4) != 0)
    return false;
  const size_t name = (size_t)bytes[26] | (size_t)bytes[27] << 8;
  return name > 4 && name <= size - 30 && memcmp(bytes + 30 + name - 4, ".npy", 4) == 0;
}

/* Texts and records are passed over beside numbers. */
static fg_status open_entry(numpy_state *file, size_t i, unsigned char *header)
{
  const fg__zip_entry *entry = &file->zip.entry[i];
  fg__npy_array *array = &file->array[i];
  size_t got = 0;
  memcpy(array->name, entry->name, sizeof array->name);
  array->entry = i;
  file->count = i + 1;
  fg_status status =
      fg__zip_extract(header, HEADER, &got, file->context, file->path, entry);
  if (status == FG_STATUS_OK)
    status = fg__npy_header(array, file->context, file->path, header, got, entry->size);
  if (status == FG_STATUS_UNSUPPORTED) {
    fg_context_clear(file->context);
    *array = (fg__npy_array){0};
    return FG_STATUS_OK;
  }
  if (status == FG_STATUS_OK && !entry->deflated)
    array->data = entry->bytes + array->header;
  return status;
}

static fg_status open_archive(numpy_state *file, const fg__source *source)
{
  fg_status status = fg__zip_list(&file->zip, file->context, source);
  unsigned char *header = fg__allocate(HEADER, 1);
  if (status == FG_STATUS_OK && !header)
    status = fg__fail_memory(file->context, "a header", HEADER);
  for (size_t i = 0; status == FG_STATUS_OK && i < file->zip.count; ++i)
    status = open_entry(file, i, header);
  free(header);
  return status;
}

static fg_status open_arrays(numpy_state *file, const fg__source *source)
{
  fg__npy_array *array = &file->array[0];
  if (fg__is_npz(source->bytes, source->size))
    return open_archive(file, source);
  file->count = 1;
  strcpy(array->name, "array");
  const fg_status status = fg__npy_header(array, file->context, file->path, source->bytes,
                                          source->size, source->size);
  if (status == FG_STATUS_OK)
    array->data = source->bytes + array->header;
  return status;
}

/* Makes an array's numbers ready. */
static fg_status load(numpy_state *file, fg__npy_array *array)
{
  if (array->data)
    return FG_STATUS_OK;
  const fg__zip_entry *entry = &file->zip.entry[array->entry];
  size_t got;
  free(array->owned);
  array->owned = fg__allocate(entry->size, 1);
  if (!array->owned)
    return fg__fail_memory(file->context, "an array", entry->size);
  const fg_status status =
      fg__zip_extract(array->owned, entry->size, &got, file->context, file->path, entry);
  if (status == FG_STATUS_OK)
    array->data = array->owned + array->header;
  return status;
}

/* IEEE 754's binary16: a sign, 5 bits of exponent, 10 of the fraction. */
static double half_value(uint16_t bits)
{
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double size = exponent == 31  ? fraction ? (double)NAN : HUGE_VAL
                      : exponent == 0 ? ldexp(fraction, -24)
                                      : ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

static double value_at(const fg__npy_array *array, size_t index)
{
  const unsigned char *at = array->data + index * array->item;
  return array->type == FG__TYPE_FLOAT32 && array->item == sizeof(uint16_t)
             ? half_value(
                   (uint16_t)fg__number_of_bytes(FG__TYPE_UINT16, at, array->swapped))
             : fg__number_of_bytes(array->type, at, array->swapped);
}

/* Numbers of a box of a view, the last axis fastest. */
static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  numpy_state *file = v->owner->file[v->file].state;
  const view *w = &file->view[v->id];
  const fg_status status = load(file, w->array);
  size_t from = w->offset, all = 1, step[FG__NPY_RANK] = {0};
  for (int k = 0; k < w->rank; ++k) {
    from += start[k] * w->stride[k];
    all *= count[k];
  }
  for (size_t n = 0; n < all && status == FG_STATUS_OK; ++n) {
    size_t at = from;
    for (int k = 0; k < w->rank; ++k)
      at += step[k] * w->stride[k];
    out[n] = value_at(w->array, at);
    for (int k = w->rank - 1; k >= 0 && ++step[k] == count[k]; --k)
      step[k] = 0;
  }
  return status;
}

static void close_state(void *state)
{
  numpy_state *file = state;
  for (size_t i = 0; i < file->count; ++i)
    free(file->array[i].owned);
}

static const fg__decoder DECODER = {.fetch = fetch,
                                    .state_bytes = sizeof(numpy_state),
                                    .close = close_state,
                                    .has_no_titles = true};

/* The dimension without a name of a length; several of one length in one array are told
 * apart by their number there. -1: no memory. */
static int find_dimension(fg__dataset *dataset, size_t length, int which)
{
  const int file = dataset->files - 1;
  int own = 0;
  for (size_t i = 0; i < dataset->dimension_count; ++i) {
    const fg__dimension *d = &dataset->dimensions[i];
    if (d->file == file && d->length == length && d->id == which)
      return (int)i;
    own += d->file == file;
  }
  char name[32];
  snprintf(name, sizeof name, "dim_%d", own);
  fg__dimension *d = fg__dataset_add_dimension(dataset, name, length);
  if (!d)
    return -1;
  d->id = which;
  d->is_nameless = true;
  return (int)dataset->dimension_count - 1;
}

static fg_status add_view(fg__dataset *dataset, numpy_state *file, const view *w,
                          const char *name, int element)
{
  fg__variable *v = fg__dataset_add_variable(dataset, "", name);
  if (!v)
    return FG_STATUS_MEMORY;
  v->type = w->array->type;
  v->rank = w->rank;
  v->element = element;
  v->in_one_run = true;
  v->id = (int)file->views;
  file->view[file->views++] = *w;
  for (int k = 0; k < w->rank; ++k) {
    int which = 0;
    for (int n = 0; n < k; ++n)
      which += w->shape[n] == w->shape[k];
    v->dimension[k] = find_dimension(dataset, w->shape[k], which);
    if (v->dimension[k] < 0)
      return FG_STATUS_MEMORY;
  }
  return w->array->is_bool ? fg__variable_add_text(v, "dtype", "bool", strlen("bool"))
                           : FG_STATUS_OK;
}

static view whole_view(fg__npy_array *a)
{
  view w = {.array = a, .rank = a->rank};
  memcpy(w.shape, a->shape, sizeof w.shape);
  memcpy(w.stride, a->stride, sizeof w.stride);
  return w;
}

/* A view at one number of an axis. */
static view across(view w, int axis, size_t number)
{
  w.offset += number * w.stride[axis];
  --w.rank;
  for (int k = axis; k < w.rank; ++k) {
    w.shape[k] = w.shape[k + 1];
    w.stride[k] = w.stride[k + 1];
  }
  return w;
}

/* The axis that counts an array's components; -1: none. */
static int component_axis(const fg__npy_array *a)
{
  if ((a->rank != 3 && a->rank != 4) || a->is_bool)
    return -1;
  const size_t components = (size_t)a->rank - 1;
  const bool first = a->shape[0] == components,
             last = a->shape[a->rank - 1] == components;
  return first == last ? -1 : first ? 0 : a->rank - 1;
}

/* Elements of a vector variable have the first one's name. */
static void share_name(fg__dataset *dataset, size_t component)
{
  fg__variable *v = &dataset->variables[dataset->variable_count - 1];
  if (component == 0)
    return;
  free(v->name);
  v->name = v[-1].name;
  v->plain_name = v[-1].plain_name;
}

static fg_status add_array(fg__dataset *dataset, numpy_state *file, fg__npy_array *a)
{
  const view whole = whole_view(a);
  const bool complex = a->is_complex;
  const int axis = component_axis(a);
  const size_t components = complex ? 2 : axis < 0 ? 0 : a->shape[axis];
  fg_status status = complex ? FG_STATUS_OK : add_view(dataset, file, &whole, a->name, 0);
  for (size_t c = 0; c < components && status == FG_STATUS_OK; ++c) {
    view w = complex ? whole : across(whole, axis, c);
    w.offset += complex ? c : 0;
    status = add_view(dataset, file, &w, a->name, (int)c + 1);
    share_name(dataset, c);
  }
  return status;
}

static bool is_table(const fg__npy_array *a)
{
  return a->name[0] && a->rank == 2 && !a->is_complex && !a->is_bool &&
         (a->shape[1] == 4 || a->shape[1] == 6);
}

static fg_status add_columns(fg__dataset *dataset, numpy_state *file)
{
  fg__npy_array *table = NULL;
  int tables = 0;
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < file->count; ++i)
    if (is_table(&file->array[i]) && ++tables == 1)
      table = &file->array[i];
  for (size_t c = 0; tables == 1 && c < table->shape[1] && status == FG_STATUS_OK; ++c) {
    char name[2] = {(char)('1' + c), '\0'};
    const view column = across(whole_view(table), 1, c);
    status = add_view(dataset, file, &column, name, 0);
  }
  return status;
}

fg_status fg__numpy_open(fg__dataset *dataset, fg_context *context,
                         const fg__source *source, const fg_read_options *options)
{
  (void)options;
  if (dataset->files > 0)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a second file cannot be used with NumPy's arrays", source->path);
  fg_status status =
      fg__dataset_begin(dataset, context, source->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  numpy_state *file = dataset->file[0].state;
  file->context = context;
  file->path = dataset->file[0].path;
  status = open_arrays(file, source);
  if (status == FG_STATUS_OK && !fg__dataset_add_group(dataset))
    status = FG_STATUS_MEMORY;
  for (size_t i = 0; i < file->count && status == FG_STATUS_OK; ++i)
    if (file->array[i].name[0])
      status = add_array(dataset, file, &file->array[i]);
  return status == FG_STATUS_OK ? add_columns(dataset, file) : status;
}
