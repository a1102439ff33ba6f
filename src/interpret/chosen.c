/* Single samples of dimensions, as of one that is neither time nor level: one member of
 * an ensemble. */
#include "base/memory.h"
#include "base/names.h"
#include "flowgrain/inventory.h"
#include "interpret/interpret.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file of a few bytes may declare a dimension of 2^31 samples. */
enum { MOST_SAMPLES = 1000000 };

/* The coordinate of a dimension, or its dates as text, or NULL. */
static const fg__variable *coordinate_of(const fg__dataset *data, int dimension)
{
  const fg__variable *coordinate = fg__coordinate_along(data, dimension, NULL);
  return coordinate ? coordinate : fg__date_texts(data, dimension);
}

static const char *path_of(const fg__dataset *data, const fg__dimension *d)
{
  return data->file[d->file].path;
}

/* The sample whose value is a whole number, as expver = 5; -1: none. */
static int find_value(const fg_axis_value *values, size_t count, const char *which)
{
  const size_t digits = strspn(which, "0123456789");
  for (size_t n = 0; values && digits > 0 && !which[digits] && n < count; ++n)
    if (fabs(values[n].value - strtod(which, NULL)) <= 0.0)
      return (int)n;
  return -1;
}

/* Which sample is meant: a value or name that is there, else an index. Errors name the
 * file. */
static fg_status select_sample(size_t *out, const fg__dataset *data,
                               const fg__dimension *d, const char *which,
                               const fg_axis_value *values)
{
  fg_context *own = NULL;
  fg_selection found = {0};
  const int value = find_value(values, d->length, which);
  if (value >= 0) {
    *out = (size_t)value;
    return FG_STATUS_OK;
  }
  fg_status status = fg_context_create(&own);
  if (status == FG_STATUS_OK)
    status = fg_selection_find(&found, own, d->name, which, values, (int)d->length);
  if (status != FG_STATUS_OK) {
    fg__fail(data->context, status, "%s: %s", path_of(data, d), fg_context_message(own));
    fg__hint(data->context,
             "a whole number is a value, or else an index, from 0; another value has a "
             "point or its unit");
  } else if (found.count != 1) {
    status = fg__fail(data->context, FG_STATUS_ARGUMENT,
                      "%s: '%.100s=%.100s' are %d samples, and one is read at a time",
                      path_of(data, d), d->name, which, found.count);
    fg__hint(data->context,
             "read each by itself; flowgrain draw shows the folders of several runs as "
             "panels of one figure");
  } else if (found.nearest) {
    status = fg__fail(data->context, FG_STATUS_ARGUMENT,
                      "%s: '%.100s=%.100s' is not there; the nearest is %s",
                      path_of(data, d), d->name, which, values[found.index[0]].words);
  } else {
    *out = (size_t)found.index[0];
  }
  fg_selection_clear(&found);
  fg_context_destroy(own);
  return status;
}

/* The values or names of a dimension's samples; NULL: none. *values and *text are for
 * free(), also after a failure. */
static fg_status read_values(fg_axis_value **values, char **text, const fg__dataset *data,
                             int dimension)
{
  const size_t count = data->dimensions[dimension].length;
  fg_status status =
      fg__grid_axis_values(values, text, data, coordinate_of(data, dimension), count);
  if (status == FG_STATUS_OK && !*values) {
    free(*text);
    *text = NULL;
    status = fg__dimension_labels(values, text, data, dimension);
  }
  return status;
}

/* "2" of "number 2". */
static const char *without_name(const char *words, const char *name)
{
  const size_t length = strlen(name);
  return strncmp(words, name, length) == 0 && words[length] == ' ' ? words + length + 1
                                                                   : words;
}

fg_status fg__offer_samples(char *out, size_t size, const fg__dataset *data,
                            int dimension)
{
  enum { FIRST = 4 };
  const fg__dimension *d = &data->dimensions[dimension];
  fg_axis_value *values = NULL;
  char *text = NULL;
  fg_status status = d->length > 0 && d->length <= MOST_SAMPLES
                         ? read_values(&values, &text, data, dimension)
                         : FG_STATUS_OK;
  if (status == FG_STATUS_OK && values) {
    int used = snprintf(out, size, "--at %.80s=WHICH reads one of them:", d->name);
    for (size_t n = 0; n < d->length && (size_t)used < size; ++n) {
      if (n == FIRST && d->length > FIRST + 1)
        n = d->length - 1;
      const char *between = n == 0 ? "" : n > FIRST ? ", ...," : ",";
      used += snprintf(out + used, size - (size_t)used, "%s %.40s", between,
                       without_name(values[n].words, d->name));
    }
  } else if (status == FG_STATUS_OK) {
    snprintf(out, size, "--at %.80s=0 reads the first of them", d->name);
  }
  free(values);
  free(text);
  return status;
}

/* Makes a dimension one of a single sample. */
static fg_status choose_sample(fg__dataset *data, int dimension, const char *which)
{
  fg__dimension *d = &data->dimensions[dimension];
  fg_axis_value *values = NULL;
  char *text = NULL;
  if (d->length == 0 || d->length > MOST_SAMPLES)
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    d->length ? "%s: '%.100s' has %zu samples; one can be chosen of %d"
                              : "%s: dimension '%.100s' is empty",
                    path_of(data, d), d->name, d->length, MOST_SAMPLES);
  fg_status status = read_values(&values, &text, data, dimension);
  if (status == FG_STATUS_OK)
    status = select_sample(&d->chosen, data, d, which, values);
  if (status == FG_STATUS_OK) {
    d->is_chosen = true;
    d->length = 1;
  }
  free(values);
  free(text);
  return status;
}

/* The same of all dimensions of a name: each group and file may have its own, and one of
 * a single sample beside them has that for all. */
static fg_status choose_named(fg__dataset *data, const char *name, const char *which)
{
  fg__names known = {0};
  bool found = false, is_given = false;
  for (size_t i = 0; i < data->dimension_count; ++i) {
    const fg__dimension *d = &data->dimensions[i];
    fg__names_add(&known, ", ", "%s (%zu)", d->name, d->length);
    if (strcmp(d->name, name) != 0)
      continue;
    if (d->is_chosen) {
      is_given = true;
      continue;
    }
    if (d->length == 1 && d->file != 0)
      continue;
    const fg_status status = choose_sample(data, (int)i, which);
    if (status != FG_STATUS_OK)
      return status;
    found = true;
  }
  if (found)
    return FG_STATUS_OK;
  if (is_given)
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: of '%.100s' two samples are chosen, and one is read",
                    data->file[0].path, name);
  fg__fail(data->context, FG_STATUS_ARGUMENT,
           "%s: has no dimension '%.100s' to choose by", data->file[0].path, name);
  if (known.count > 0)
    fg__hint(data->context, "dimensions in it: %s", known.text);
  return FG_STATUS_ARGUMENT;
}

static bool has_dimension(const fg__dataset *data, int file, const char *name)
{
  for (size_t i = 0; i < data->dimension_count; ++i)
    if (data->dimensions[i].file == file && strcmp(data->dimensions[i].name, name) == 0)
      return true;
  return false;
}

/* The same in files without a dimension of the name, of the other component's ("depthv"
 * of "depthu") that nothing is chosen of. */
static fg_status choose_alike(fg__dataset *data, const char *name, const char *which)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < data->dimension_count && status == FG_STATUS_OK; ++i) {
    const fg__dimension *d = &data->dimensions[i];
    const bool alike = fg__named_alike(name, d->name) || fg__named_alike(d->name, name);
    if (alike && !d->is_chosen && !has_dimension(data, d->file, name))
      status = choose_sample(data, (int)i, which);
  }
  return status;
}

typedef fg_status chooser(fg__dataset *data, const char *name, const char *which);

static fg_status choose_each(fg__dataset *data, const char *text, chooser *choose)
{
  char *copy = fg__copy_text(text);
  fg_status status =
      copy ? FG_STATUS_OK : fg__fail_memory(data->context, "a choice", strlen(text) + 1);
  for (char *one = copy; one && status == FG_STATUS_OK;) {
    char *comma = strchr(one, ','), *equals = strchr(one, '=');
    if (comma)
      *comma = '\0';
    if (!equals || equals == one || !equals[1] || (comma && equals > comma)) {
      status =
          fg__fail(data->context, FG_STATUS_ARGUMENT,
                   "'%.200s' is no choice of a dimension's sample, as number=2", one);
      break;
    }
    *equals = '\0';
    status = choose(data, one + strspn(one, " "), equals + 1);
    one = comma ? comma + 1 : NULL;
  }
  free(copy);
  return status;
}

fg_status fg__choose_samples(fg__dataset *data, const char *text)
{
  fg_status status = choose_each(data, text, choose_named);
  if (status == FG_STATUS_OK)
    status = choose_each(data, text, choose_alike);
  for (int n = 0; n < data->files; ++n)
    data->file[n].was_read = false;
  return status;
}

/* "member 2", by its coordinate; "scenario ssp585", by its label. */
static fg_status write_words(char *out, size_t size, const fg__dataset *data,
                             int dimension)
{
  const fg__dimension *d = &data->dimensions[dimension];
  const fg__variable *coordinate = coordinate_of(data, dimension);
  char label[FG__TEXT_BYTES] = "";
  fg_status status =
      coordinate ? FG_STATUS_OK : fg__dimension_label(label, data, dimension);
  if (status == FG_STATUS_OK && label[0])
    snprintf(out, size, "%s %s", d->name, label);
  else if (status == FG_STATUS_OK)
    status = fg__index_words(coordinate, d->name, coordinate ? 0 : d->chosen, out, size);
  return status;
}

fg_status fg__chosen_words(const fg__dataset *data, const fg__variable *variable,
                           bool of_time, char *words, size_t size)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < variable->rank && status == FG_STATUS_OK; ++k) {
    const size_t used = strlen(words);
    const char *between = used ? ", " : "";
    if (!data->dimensions[variable->dimension[k]].is_chosen ||
        fg__is_time(data, variable, k) != of_time || used + strlen(between) + 1 >= size)
      continue;
    strcpy(words + used, between);
    status = write_words(words + used + strlen(between), size - used - strlen(between),
                         data, variable->dimension[k]);
  }
  return status;
}

fg_status fg__check_choices(const fg__dataset *data, const fg__pair *pair)
{
  for (size_t i = 0; i < data->dimension_count; ++i) {
    const fg__dimension *d = &data->dimensions[i];
    bool used = !d->is_chosen;
    for (int n = 0; n < 2; ++n)
      for (int k = 0; k < pair->component[n]->rank; ++k)
        used = used || strcmp(data->dimensions[pair->component[n]->dimension[k]].name,
                              d->name) == 0;
    if (!used)
      return fg__fail(data->context, FG_STATUS_ARGUMENT,
                      "%s: '%.100s' and '%.100s' have no dimension '%.100s' to choose by",
                      data->file[0].path, pair->component[0]->plain_name,
                      pair->component[1]->plain_name, d->name);
  }
  return FG_STATUS_OK;
}
