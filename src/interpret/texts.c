/* Texts along a dimension, strings or rows of letters: dates, as Times of WRF,
 * "2010-07-16_12:00:00", and of FVCOM, xtime of MPAS, time as strings; and names of
 * samples. */
#include "base/memory.h"
#include "interpret/interpret.h"
#include "terms/dates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A date has 19 characters; more may follow. */
enum { MOST_LETTERS = 64, MOST_LABELS = 10000 };

static bool has_texts(const fg__dataset *data, const fg__variable *v, int dimension,
                      size_t letters)
{
  return (v->type == FG__TYPE_LETTERS
              ? v->rank == 2 && data->dimensions[v->dimension[1]].length <= letters
              : v->type == FG__TYPE_TEXTS && v->rank == 1) &&
         v->dimension[0] == dimension;
}

const fg__variable *fg__date_texts(const fg__dataset *data, int dimension)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const fg__term term = fg__term_of(v);
    if (has_texts(data, v, dimension, MOST_LETTERS) &&
        (fg__role_of_attributes(&term, "", false) == FG__ROLE_TIME ||
         fg__role_of_name(v->plain_name) == FG__ROLE_TIME))
      return v;
  }
  return NULL;
}

/* The variable with the labels: the one of the dimension's name, or else the first. */
static const fg__variable *find_labels(const fg__dataset *data, int dimension)
{
  const fg__variable *first = NULL;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!has_texts(data, v, dimension, FG__TEXT_BYTES - 1))
      continue;
    if (strcmp(v->plain_name, data->dimensions[dimension].name) == 0)
      return v;
    first = first ? first : v;
  }
  return first;
}

/* Makes a text what is shown of it; false: it is no date. */
typedef bool converter(char text[FG__TEXT_BYTES]);

static bool to_label(char text[FG__TEXT_BYTES])
{
  for (size_t n = strlen(text); n > 0 && text[n - 1] == ' '; --n)
    text[n - 1] = '\0';
  return true;
}

static bool to_date(char text[FG__TEXT_BYTES])
{
  char letters[MOST_LETTERS + 1] = "";
  strncpy(letters, text, MOST_LETTERS);
  return fg__date_of_text(letters, text, FG__TEXT_BYTES);
}

static fg_status read_texts(char *out, const fg__variable *v, size_t first, size_t count)
{
  first += v->owner->dimensions[v->dimension[0]].chosen;
  return fg__variable_fetch_texts(v, first, count, out, FG__TEXT_BYTES);
}

static fg_status read_values(fg_axis_value **out, char **text, const fg__variable *v,
                             size_t count, converter *convert)
{
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(1 + count * FG__TEXT_BYTES, 1); /* first "", as units */
  bool known = *out && *text;
  const fg_status status =
      known ? read_texts(*text + 1, v, 0, count)
            : fg__fail_memory(v->owner->context, "texts", count * FG__TEXT_BYTES);
  for (size_t n = 0; n < count && known && status == FG_STATUS_OK; ++n) {
    char *one = *text + 1 + n * FG__TEXT_BYTES;
    known = convert(one);
    (*out)[n] = (fg_axis_value){(double)NAN, *text, one};
  }
  if (!known || status != FG_STATUS_OK) {
    free(*out);
    *out = NULL;
  }
  return status;
}

fg_status fg__date_text(char *out, size_t size, const fg__variable *texts, size_t index)
{
  char letters[MOST_LETTERS + 1];
  const fg_status status = fg__variable_fetch_texts(
      texts, index + texts->owner->dimensions[texts->dimension[0]].chosen, 1, letters,
      sizeof letters);
  if (status != FG_STATUS_OK || !fg__date_of_text(letters, out, size))
    out[0] = '\0';
  return status;
}

fg_status fg__date_values(fg_axis_value **out, char **text, const fg__variable *texts,
                          size_t count)
{
  return read_values(out, text, texts, count, to_date);
}

fg_status fg__dimension_label(char out[FG__TEXT_BYTES], const fg__dataset *data,
                              int dimension)
{
  const fg__variable *labels = find_labels(data, dimension);
  out[0] = '\0';
  const fg_status status = labels ? read_texts(out, labels, 0, 1) : FG_STATUS_OK;
  if (status == FG_STATUS_OK)
    to_label(out);
  return status;
}

fg_status fg__dimension_labels(fg_axis_value **out, char **text, const fg__dataset *data,
                               int dimension)
{
  const fg__variable *labels = find_labels(data, dimension);
  const size_t count = data->dimensions[dimension].length;
  *out = NULL;
  *text = NULL;
  return labels && count > 0 && count <= MOST_LABELS
             ? read_values(out, text, labels, count, to_label)
             : FG_STATUS_OK;
}
