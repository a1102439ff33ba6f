/* Dates that files have as text, one for each index of a dimension: Times of WRF,
 * "2010-07-16_12:00:00", and of FVCOM, xtime of MPAS, time as strings. */
#include "base/memory.h"
#include "interpret/interpret.h"
#include "terms/dates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A date has 19 characters; more may follow. */
enum { MOST_LETTERS = 64, DATE_BYTES = 40 };

static bool has_texts(const fg__dataset *data, const fg__variable *v)
{
  return v->type == FG__TYPE_LETTERS
             ? v->rank == 2 && data->dimensions[v->dimension[1]].length <= MOST_LETTERS
             : v->type == FG__TYPE_TEXTS && v->rank == 1;
}

const fg__variable *fg__date_texts(const fg__dataset *data, int dimension)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const fg__term term = fg__term_of(v);
    if (has_texts(data, v) && v->dimension[0] == dimension &&
        (fg__role_of_attributes(&term, "", false) == FG__ROLE_TIME ||
         fg__role_of_name(v->plain_name) == FG__ROLE_TIME))
      return v;
  }
  return NULL;
}

/* Reads texts of MOST_LETTERS + 1 bytes each. */
static fg_status read_dates(char *out, const fg__variable *texts, size_t first,
                            size_t count)
{
  first += texts->owner->dimensions[texts->dimension[0]].chosen;
  return fg__variable_fetch_texts(texts, first, count, out, MOST_LETTERS + 1);
}

fg_status fg__date_text(char *out, size_t size, const fg__variable *texts, size_t index)
{
  char letters[MOST_LETTERS + 1];
  const fg_status status = read_dates(letters, texts, index, 1);
  if (status != FG_STATUS_OK || !fg__date_of_text(letters, out, size))
    out[0] = '\0';
  return status;
}

static bool write_dates(fg_axis_value *out, char *text, const char *letters, size_t count)
{
  text[0] = '\0'; /* dates have no units */
  for (size_t n = 0; n < count; ++n) {
    char *date = text + 1 + n * DATE_BYTES;
    if (!fg__date_of_text(letters + n * (MOST_LETTERS + 1), date, DATE_BYTES))
      return false;
    out[n] = (fg_axis_value){(double)NAN, text, date};
  }
  return true;
}

fg_status fg__date_values(fg_axis_value **out, char **text, const fg__variable *texts,
                          size_t count)
{
  char *letters = fg__allocate(count, MOST_LETTERS + 1);
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(1 + count * DATE_BYTES, 1);
  fg_status status =
      letters && *out && *text
          ? read_dates(letters, texts, 0, count)
          : fg__fail_memory(texts->owner->context, "dates", count * sizeof **out);
  if (status != FG_STATUS_OK || !write_dates(*out, *text, letters, count)) {
    free(*out);
    *out = NULL;
  }
  free(letters);
  return status;
}
