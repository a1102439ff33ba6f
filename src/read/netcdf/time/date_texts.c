/* Dates that files have as text, one for each index of a dimension: Times of WRF,
 * "2010-07-16_12:00:00", and of FVCOM, xtime of MPAS. */
#include "base/memory.h"
#include "read/netcdf/time/dates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A date has 19 characters; more may follow. */
enum { MOST_LETTERS = 64, DATE_BYTES = 40 };

const fg__nc_variable *fg__nc_date_texts(const fg__nc_file *file, int dimension)
{
  static const char *const names[] = {"Times", "xtime"};
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->type != NC_CHAR || v->rank != 2 || v->dimension[0] != dimension ||
        file->dimensions[v->dimension[1]].length > MOST_LETTERS)
      continue;
    for (size_t n = 0; n < sizeof names / sizeof *names; ++n)
      if (strcasecmp(v->plain_name, names[n]) == 0)
        return v;
  }
  return NULL;
}

static size_t letters_of(const fg__nc_variable *texts)
{
  return texts->owner->dimensions[texts->dimension[1]].length;
}

/* Reads the texts into out[count][letters_of]. */
static fg_status read_letters(char *out, const fg__nc_variable *texts, size_t first,
                              size_t count)
{
  const fg__nc_dimension *dates = &texts->owner->dimensions[texts->dimension[0]];
  const size_t start[2] = {first + dates->chosen, 0},
               counts[2] = {count, letters_of(texts)};
  int error = fg__nc_check_chunks(texts, start, counts);
  if (!error)
    error = nc_get_vara_text(texts->group, texts->id, start, counts, out);
  return error ? fg__nc_fail(texts->owner->context, texts->path, texts->name, error)
               : FG_STATUS_OK;
}

static bool write_date(char out[DATE_BYTES], const char *letters, size_t length)
{
  char text[MOST_LETTERS + 1];
  memcpy(text, letters, length);
  text[length] = '\0';
  return fg__nc_date_of_text(text, out, DATE_BYTES);
}

fg_status fg__nc_date_text(char *out, size_t size, const fg__nc_variable *texts,
                           size_t index)
{
  char letters[MOST_LETTERS], date[DATE_BYTES] = "";
  const fg_status status = read_letters(letters, texts, index, 1);
  if (status == FG_STATUS_OK && write_date(date, letters, letters_of(texts)))
    snprintf(out, size, "%s", date);
  else
    out[0] = '\0';
  return status;
}

static bool write_dates(fg_axis_value *out, char *text, const char *letters,
                        size_t length, size_t count)
{
  text[0] = '\0'; /* dates have no units */
  for (size_t n = 0; n < count; ++n) {
    char *date = text + 1 + n * DATE_BYTES;
    if (!write_date(date, letters + n * length, length))
      return false;
    out[n] = (fg_axis_value){(double)NAN, text, date};
  }
  return true;
}

fg_status fg__nc_date_values(fg_axis_value **out, char **text,
                             const fg__nc_variable *texts, size_t count)
{
  const size_t length = letters_of(texts);
  char *letters = fg__allocate(count * length, 1);
  *out = fg__allocate(count, sizeof **out);
  *text = fg__allocate(1 + count * DATE_BYTES, 1);
  fg_status status =
      letters && *out && *text
          ? read_letters(letters, texts, 0, count)
          : fg__fail_memory(texts->owner->context, "dates", count * sizeof **out);
  if (status != FG_STATUS_OK || !write_dates(*out, *text, letters, length, count)) {
    free(*out);
    *out = NULL;
  }
  free(letters);
  return status;
}
