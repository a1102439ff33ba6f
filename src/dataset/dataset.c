#include "dataset/dataset.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "base/memory.h"
#include "base/utf8.h"

static fg_status fail_memory(const fg__dataset *dataset)
{
  return fg__fail_memory(dataset->context, "what a file holds", 0);
}

fg_status fg__dataset_begin(fg__dataset *dataset, fg_context *context, const char *path,
                            size_t size, const fg__decoder *decoder)
{
  dataset->context = context;
  if (dataset->files == FG__DATASET_FILES)
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: one file too many", path);
  fg__dataset_file *file = &dataset->file[dataset->files++];
  *file =
      (fg__dataset_file){.path = fg__copy_text(path), .size = size, .decoder = decoder};
  if (decoder->state_bytes > 0)
    file->state = fg__allocate(1, decoder->state_bytes);
  if (!file->path || (decoder->state_bytes > 0 && !file->state))
    return fail_memory(dataset);
  if (dataset->files == 1)
    dataset->component_files = 1;
  return FG_STATUS_OK;
}

fg__dimension *fg__dataset_add_dimension(fg__dataset *dataset, const char *name,
                                         size_t length)
{
  void *grown = dataset->dimensions;
  if (!fg__grow(&grown, &dataset->dimension_capacity, dataset->dimension_count + 1,
                sizeof *dataset->dimensions)) {
    fail_memory(dataset);
    return NULL;
  }
  dataset->dimensions = grown;
  fg__dimension *d = &dataset->dimensions[dataset->dimension_count++];
  *d = (fg__dimension){.file = dataset->files - 1, .length = length};
  fg__utf8_take(d->name, sizeof d->name, name, strlen(name));
  return d;
}

static fg__variable *add(fg__variable **list, size_t *count, size_t *capacity,
                         fg__dataset *dataset)
{
  void *grown = *list;
  if (!fg__grow(&grown, capacity, *count + 1, sizeof **list)) {
    fail_memory(dataset);
    return NULL;
  }
  *list = grown;
  fg__variable *v = &(*list)[(*count)++];
  *v = (fg__variable){.owner = dataset,
                      .file = dataset->files - 1,
                      .path = dataset->file[dataset->files - 1].path,
                      .fill = (double)NAN,
                      .geographic = FG__NO_ROLE};
  return v;
}

fg__variable *fg__dataset_add_variable(fg__dataset *dataset, const char *group,
                                       const char *name)
{
  fg__variable *v = add(&dataset->variables, &dataset->variable_count,
                        &dataset->variable_capacity, dataset);
  if (!v)
    return NULL;
  const size_t size = 2 * (strlen(group) + strlen(name)) + 1;
  v->group = (int)dataset->group_count - 1;
  v->name = fg__allocate(size, 1);
  if (!v->name) {
    fail_memory(dataset);
    return NULL;
  }
  fg__utf8_take(v->name, size, group, strlen(group));
  const size_t used = strlen(v->name);
  fg__utf8_take(v->name + used, size - used, name, strlen(name));
  const char *slash = strrchr(v->name, '/');
  v->plain_name = slash && slash[1] ? slash + 1 : v->name;
  return v;
}

fg__variable *fg__dataset_add_group(fg__dataset *dataset)
{
  return add(&dataset->groups, &dataset->group_count, &dataset->group_capacity, dataset);
}

fg_status fg__dataset_split(fg__dataset *dataset, int components)
{
  enum { MOST = 9 };
  const size_t number = dataset->variable_count - 1;
  dataset->variables[number].components = components;
  dataset->variables[number].element = 1;
  for (int k = 2; k <= components && k <= MOST; ++k) {
    fg__variable *next = add(&dataset->variables, &dataset->variable_count,
                             &dataset->variable_capacity, dataset);
    if (!next)
      return FG_STATUS_MEMORY;
    *next = dataset->variables[number];
    next->element = k;
  }
  return FG_STATUS_OK;
}

static fg__attribute *add_attribute(fg__variable *v, const char *name)
{
  const size_t count = v->attributes;
  /* doubled whenever the count is a power of two */
  if ((count & (count - 1)) == 0) {
    fg__attribute *grown = realloc(v->attribute, (count ? 2 * count : 1) * sizeof *grown);
    if (!grown)
      return NULL;
    v->attribute = grown;
  }
  fg__attribute *a = &v->attribute[count];
  *a = (fg__attribute){.name = fg__copy_text(name)};
  if (!a->name)
    return NULL;
  ++v->attributes;
  return a;
}

fg_status fg__variable_add_text(fg__variable *variable, const char *name,
                                const char *text, size_t length)
{
  fg__attribute *a = add_attribute(variable, name);
  while (length > 0 && isspace((unsigned char)text[length - 1]))
    --length;
  while (length > 0 && isspace((unsigned char)*text)) {
    ++text;
    --length;
  }
  if (a)
    a->text = fg__allocate(2 * length + 1, 1);
  if (!a || !a->text)
    return fail_memory(variable->owner);
  fg__utf8_take(a->text, 2 * length + 1, text, length);
  return FG_STATUS_OK;
}

fg_status fg__variable_add_numbers(fg__variable *variable, const char *name,
                                   const double *number, size_t count, bool is_floating)
{
  fg__attribute *a = add_attribute(variable, name);
  if (a)
    a->number = fg__allocate(count, sizeof *a->number);
  if (!a || !a->number)
    return fail_memory(variable->owner);
  memcpy(a->number, number, count * sizeof *number);
  a->count = count;
  a->is_floating = is_floating;
  return FG_STATUS_OK;
}

static void clear(fg__variable *variables, size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    fg__variable *v = &variables[i];
    /* the elements of a vector variable have the attributes of the first */
    for (size_t n = 0; n < v->attributes && v->element < 2; ++n) {
      free(v->attribute[n].name);
      free(v->attribute[n].text);
      free(v->attribute[n].number);
    }
    if (v->element < 2) {
      free(v->attribute);
      free(v->name);
    }
  }
  free(variables);
}

fg_status fg__dataset_choose_time(fg__dataset *dataset, const char *path, double *time,
                                  size_t times, int wanted)
{
  dataset->time = time;
  dataset->times = (int)times;
  if (times == 0 || (wanted >= 0 && (size_t)wanted < times))
    return FG_STATUS_OK;
  return fg__fail(dataset->context, FG_STATUS_ARGUMENT,
                  "%s: time %d is asked for; there are %zu, from 0 on", path, wanted,
                  times);
}

void fg__dataset_close(fg__dataset *dataset)
{
  for (int i = 0; i < dataset->files; ++i) {
    fg__dataset_file *file = &dataset->file[i];
    if (file->state && file->decoder->close)
      file->decoder->close(file->state);
    if (file->decoder->state_bytes > 0)
      free(file->state);
    free(file->path);
  }
  clear(dataset->variables, dataset->variable_count);
  clear(dataset->groups, dataset->group_count);
  free(dataset->dimensions);
  free(dataset->space.cells.position);
  free(dataset->space.cells.type);
  free(dataset->space.cells.first);
  free(dataset->space.cells.corner);
  free(dataset->time);
  *dataset = (fg__dataset){0};
}

const fg__variable *fg__dataset_find(const fg__dataset *dataset, const char *name)
{
  for (size_t i = 0; i < dataset->variable_count; ++i)
    if (strcmp(dataset->variables[i].name, name) == 0)
      return &dataset->variables[i];
  for (size_t i = 0; i < dataset->variable_count; ++i)
    if (strcmp(dataset->variables[i].plain_name, name) == 0)
      return &dataset->variables[i];
  return NULL;
}

const fg__variable *fg__group_of(const fg__variable *variable)
{
  return &variable->owner->groups[variable->group];
}

const fg__variable *fg__file_of(const fg__variable *variable)
{
  const fg__variable *group = variable->owner->groups;
  while (group->file != variable->file)
    ++group;
  return group;
}

bool fg__is_number(const fg__variable *variable)
{
  return variable->type >= FG__TYPE_INT8;
}

bool fg__is_floating(const fg__variable *variable)
{
  return variable->type >= FG__TYPE_FLOAT32;
}

size_t fg__type_bytes(fg__type type)
{
  static const unsigned char bytes[] = {
      [FG__TYPE_INT8] = 1,   [FG__TYPE_UINT8] = 1,  [FG__TYPE_INT16] = 2,
      [FG__TYPE_UINT16] = 2, [FG__TYPE_INT32] = 4,  [FG__TYPE_UINT32] = 4,
      [FG__TYPE_INT64] = 8,  [FG__TYPE_UINT64] = 8, [FG__TYPE_FLOAT32] = 4,
      [FG__TYPE_FLOAT64] = 8};
  return bytes[type] ? bytes[type] : 1;
}

double fg__number_of_bytes(fg__type type, const unsigned char *bytes, bool swapped)
{
  union {
    unsigned char byte[8];
    int8_t i1;
    int16_t i2;
    int32_t i4;
    int64_t i8;
    uint8_t u1;
    uint16_t u2;
    uint32_t u4;
    uint64_t u8;
    float f4;
    double f8;
  } n = {.u8 = 0};
  const size_t size = fg__type_bytes(type);
  for (size_t i = 0; i < size; ++i)
    n.byte[i] = bytes[swapped ? size - 1 - i : i];
  switch (type) {
  case FG__TYPE_INT8:
    return n.i1;
  case FG__TYPE_UINT8:
    return n.u1;
  case FG__TYPE_INT16:
    return n.i2;
  case FG__TYPE_UINT16:
    return n.u2;
  case FG__TYPE_INT32:
    return n.i4;
  case FG__TYPE_UINT32:
    return n.u4;
  case FG__TYPE_INT64:
    return (double)n.i8;
  case FG__TYPE_UINT64:
    return (double)n.u8;
  case FG__TYPE_FLOAT32:
    return (double)n.f4;
  case FG__TYPE_FLOAT64:
    return n.f8;
  default:
    return 0.0;
  }
}

const fg__attribute *fg__attribute_find(const fg__variable *variable,
                                        const char *attribute)
{
  for (size_t n = 0; n < variable->attributes; ++n)
    if (strcmp(variable->attribute[n].name, attribute) == 0)
      return &variable->attribute[n];
  return NULL;
}

bool fg__attribute_text(const fg__variable *variable, const char *attribute, char *out,
                        size_t size)
{
  const fg__attribute *a = fg__attribute_find(variable, attribute);
  const bool found = a && a->text;
  fg__utf8_take(out, size, found ? a->text : "", found ? strlen(a->text) : 0);
  return found;
}

/* Numbers that are written as a text: "0.001", "-20, 20"; 0: the text has others, or more
 * than the capacity. */
static int read_numbers(double *out, int capacity, const char *text)
{
  int count = 0;
  for (const char *end; *(text += strspn(text, ", ")); text = end) {
    const double number = fg__number_read(text, &end);
    if (end == text || (*end && !strchr(", ", *end)) || !isfinite(number) ||
        count == capacity)
      return 0;
    out[count++] = number;
  }
  return count;
}

int fg__attribute_numbers(const fg__variable *variable, const char *attribute,
                          double *out, int capacity)
{
  const fg__attribute *a = fg__attribute_find(variable, attribute);
  int count = 0;
  if (a && a->text)
    return read_numbers(out, capacity, a->text);
  for (; a && count < capacity && (size_t)count < a->count; ++count)
    out[count] = a->number[count];
  return count;
}

bool fg__variable_has(const fg__variable *variable, const size_t *index)
{
  const fg__dataset *dataset = variable->owner;
  const fg__decoder *decoder = dataset->file[variable->file].decoder;
  size_t at[FG__RANK] = {0};
  for (int k = 0; k < variable->rank && k < FG__RANK; ++k)
    at[k] = index[k] + dataset->dimensions[variable->dimension[k]].chosen;
  return !decoder->has || decoder->has(variable, at);
}

fg_status fg__variable_fetch(const fg__variable *variable, const size_t *start,
                             const size_t *count, double *out)
{
  fg__dataset *dataset = variable->owner;
  fg__dataset_file *file = &dataset->file[variable->file];
  size_t first[FG__RANK + 1] = {0}, counts[FG__RANK + 1] = {0};
  for (int k = 0; k < variable->rank && k < FG__RANK; ++k) {
    first[k] = start[k] + dataset->dimensions[variable->dimension[k]].chosen;
    counts[k] = count[k];
  }
  if (variable->element > 0) {
    first[variable->rank] = (size_t)variable->element - 1;
    counts[variable->rank] = 1;
  }
  file->was_read = true;
  return file->decoder->fetch(variable, first, counts, out);
}

fg_status fg__variable_fetch_one(const fg__variable *variable, const size_t *index,
                                 double *out)
{
  size_t one[FG__RANK];
  for (int k = 0; k < FG__RANK; ++k)
    one[k] = 1;
  return fg__variable_fetch(variable, index, one, out);
}

fg_status fg__variable_fetch_texts(const fg__variable *variable, size_t first,
                                   size_t count, char *out, size_t size)
{
  const fg__dataset_file *file = &variable->owner->file[variable->file];
  if (!file->decoder->fetch_texts)
    return fg__fail(variable->owner->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%s' is of numbers", variable->path, variable->name);
  char *raw = fg__allocate(size, 1);
  fg_status status = raw ? file->decoder->fetch_texts(variable, first, count, out, size)
                         : fg__fail_memory(variable->owner->context, "a text", size);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    memcpy(raw, out + n * size, size);
    fg__utf8_take(out + n * size, size, raw, size);
  }
  free(raw);
  return status;
}

size_t fg__variable_record(const fg__variable *variable, size_t n)
{
  const fg__decoder *decoder = variable->owner->file[variable->file].decoder;
  return decoder->record ? decoder->record(variable, n) : n;
}

bool fg__has_no_titles(const fg__variable *variable)
{
  return variable->owner->file[variable->file].decoder->has_no_titles;
}
