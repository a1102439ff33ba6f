/* Names that a file has for the samples of a dimension: strings, or rows of characters.
 */
#include "base/memory.h"
#include "base/utf8.h"
#include "read/netcdf/netcdf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LABELS = 10000 };

static bool has_labels(const fg__nc_file *file, const fg__nc_variable *v, int dimension)
{
  if (v->rank < 1 || v->rank > 2 || v->dimension[0] != dimension)
    return false;
  return v->rank == 1 ? v->type == NC_STRING
                      : v->type == NC_CHAR &&
                            file->dimensions[v->dimension[1]].length < FG__NC_TEXT;
}

/* The variable with the labels: the one of the dimension's name, or else the first. */
static const fg__nc_variable *find_labels(const fg__nc_file *file, int dimension)
{
  const fg__nc_variable *first = NULL;
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (!has_labels(file, v, dimension))
      continue;
    if (strcmp(v->plain_name, file->dimensions[dimension].name) == 0)
      return v;
    first = first ? first : v;
  }
  return first;
}

static fg_status read_label(char out[FG__NC_TEXT], const fg__nc_file *file,
                            const fg__nc_variable *v, size_t index)
{
  const size_t start[2] = {index, 0};
  const size_t count[2] = {1,
                           v->rank == 2 ? file->dimensions[v->dimension[1]].length : 1};
  char *string = NULL;
  memset(out, 0, FG__NC_TEXT);
  int error = fg__nc_check_chunks(v, start, count);
  if (!error && v->type == NC_CHAR)
    error = nc_get_vara_text(v->group, v->id, start, count, out);
  else if (!error)
    error = nc_get_vara_string(v->group, v->id, start, count, &string);
  char raw[FG__NC_TEXT];
  snprintf(raw, sizeof raw, "%s", string ? string : out);
  if (string)
    nc_free_string(1, &string);
  fg__utf8_take(out, FG__NC_TEXT, raw, sizeof raw);
  for (size_t n = strlen(out); n > 0 && out[n - 1] == ' '; --n)
    out[n - 1] = '\0';
  return error ? fg__nc_fail(file->context, v->path, v->name, error) : FG_STATUS_OK;
}

fg_status fg__nc_label(char out[FG__NC_TEXT], const fg__nc_file *file, int dimension,
                       size_t index)
{
  const fg__nc_variable *labels = find_labels(file, dimension);
  out[0] = '\0';
  return labels ? read_label(out, file, labels, index) : FG_STATUS_OK;
}

fg_status fg__nc_labels(fg_axis_value **out, char **text, const fg__nc_file *file,
                        int dimension)
{
  const fg__nc_variable *labels = find_labels(file, dimension);
  const size_t count = file->dimensions[dimension].length;
  fg_status status = FG_STATUS_OK;
  *out = NULL;
  *text = NULL;
  if (!labels || count < 1 || count > MOST_LABELS)
    return FG_STATUS_OK;
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(1 + count * FG__NC_TEXT, 1);
  if (!*out || !*text)
    return fg__fail_memory(file->context, "labels", count * FG__NC_TEXT);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    char *label = *text + 1 + n * FG__NC_TEXT;
    status = read_label(label, file, labels, n);
    (*out)[n] = (fg_axis_value){(double)NAN, *text, label};
  }
  return status;
}
