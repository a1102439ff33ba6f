/* Names that a file has for the samples of a dimension: strings, or rows of characters.
 */
#include "base/memory.h"
#include "interpret/interpret.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LABELS = 10000 };

static bool has_labels(const fg__dataset *data, const fg__variable *v, int dimension)
{
  if (v->rank < 1 || v->rank > 2 || v->dimension[0] != dimension)
    return false;
  return v->rank == 1 ? v->type == FG__TYPE_TEXTS
                      : v->type == FG__TYPE_LETTERS &&
                            data->dimensions[v->dimension[1]].length < FG__TEXT_BYTES;
}

/* The variable with the labels: the one of the dimension's name, or else the first. */
static const fg__variable *find_labels(const fg__dataset *data, int dimension)
{
  const fg__variable *first = NULL;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!has_labels(data, v, dimension))
      continue;
    if (strcmp(v->plain_name, data->dimensions[dimension].name) == 0)
      return v;
    first = first ? first : v;
  }
  return first;
}

static fg_status read_label(char out[FG__TEXT_BYTES], const fg__variable *v, size_t index)
{
  const fg_status status = fg__variable_fetch_texts(v, index, 1, out, FG__TEXT_BYTES);
  if (status != FG_STATUS_OK)
    return status;
  for (size_t n = strlen(out); n > 0 && out[n - 1] == ' '; --n)
    out[n - 1] = '\0';
  return FG_STATUS_OK;
}

fg_status fg__dimension_label(char out[FG__TEXT_BYTES], const fg__dataset *data,
                              int dimension, size_t index)
{
  const fg__variable *labels = find_labels(data, dimension);
  out[0] = '\0';
  return labels ? read_label(out, labels, index) : FG_STATUS_OK;
}

fg_status fg__dimension_labels(fg_axis_value **out, char **text, const fg__dataset *data,
                               int dimension)
{
  const fg__variable *labels = find_labels(data, dimension);
  const size_t count = data->dimensions[dimension].length;
  fg_status status = FG_STATUS_OK;
  *out = NULL;
  *text = NULL;
  if (!labels || count < 1 || count > MOST_LABELS)
    return FG_STATUS_OK;
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(1 + count * FG__TEXT_BYTES, 1);
  if (!*out || !*text)
    return fg__fail_memory(data->context, "labels", count * FG__TEXT_BYTES);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    char *label = *text + 1 + n * FG__TEXT_BYTES;
    status = read_label(label, labels, n);
    (*out)[n] = (fg_axis_value){(double)NAN, *text, label};
  }
  return status;
}
