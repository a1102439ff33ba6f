/* Samples of dimensions that are neither in space, time nor level: one member of an
 * ensemble. */
#include "base/memory.h"
#include "flowgrain/inventory.h"
#include "read/netcdf/netcdf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file of a few bytes may declare a dimension of 2^31 samples. */
enum { MOST_SAMPLES = 1000000 };

/* The coordinate of a dimension, or NULL. */
static const fg__nc_variable *coordinate_of(const fg__nc_file *file, int dimension)
{
  const fg__nc_variable along = {.rank = 1, .dimension = {dimension}};
  return fg__nc_coordinate(file, &along, 0);
}

static fg_status fail_not_one(const fg__nc_file *file, const char *name,
                              const char *which, int count)
{
  return fg__fail(file->context, FG_STATUS_ARGUMENT,
                  "%s: '%.100s=%.100s' are %d samples, and one is read at a time",
                  file->paths[0], name, which, count);
}

/* Which sample is meant; what is wrong is said of the file. */
static fg_status select_sample(fg_selection *out, const fg__nc_file *file,
                               const fg__nc_dimension *d, const char *which,
                               const fg_axis_value *values)
{
  fg_context *own = NULL;
  fg_status status = fg_context_create(&own);
  if (status == FG_STATUS_OK)
    status = fg_selection_find(out, own, d->name, which, values, (int)d->length);
  if (status != FG_STATUS_OK) {
    fg__fail(file->context, status, "%s: %s", file->paths[0], fg_context_message(own));
    fg__hint(file->context,
             "a whole number is an index, from 0; a value has a point or its unit");
  } else if (out->count != 1) {
    status = fail_not_one(file, d->name, which, out->count);
  }
  fg_context_destroy(own);
  return status;
}

/* Makes a dimension one of a single sample. */
static fg_status choose_sample(fg__nc_file *file, int dimension, const char *which)
{
  fg__nc_dimension *d = &file->dimensions[dimension];
  fg_axis_value *values = NULL;
  char *text = NULL;
  fg_selection selection = {0};
  if (d->length > MOST_SAMPLES)
    return fg__fail(file->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%.100s' has %zu samples; one can be chosen of %d at most",
                    file->paths[0], d->name, d->length, MOST_SAMPLES);
  fg_status status =
      fg__nc_axis_values(&values, &text, file, coordinate_of(file, dimension), d->length);
  if (status == FG_STATUS_OK && !values) {
    free(text);
    status = fg__nc_labels(&values, &text, file, dimension);
  }
  if (status == FG_STATUS_OK)
    status = select_sample(&selection, file, d, which, values);
  if (status == FG_STATUS_OK) {
    d->chosen = (size_t)selection.index[0];
    d->is_chosen = true;
    d->length = 1;
  }
  fg_selection_clear(&selection);
  free(values);
  free(text);
  return status;
}

/* Lists dimensions as "time (12), number (3)", as many as fit. */
static void list_dimensions(char *out, size_t size, const fg__nc_file *file)
{
  size_t used = 0;
  out[0] = '\0';
  for (size_t i = 0; i < file->dimension_count; ++i) {
    const fg__nc_dimension *d = &file->dimensions[i];
    if (used + strlen(d->name) + 32 < size)
      used += (size_t)snprintf(out + used, size - used, "%s%s (%zu)", used ? ", " : "",
                               d->name, d->length);
  }
}

/* The same of all dimensions of a name: each group and file may have its own. */
static fg_status choose_named(fg__nc_file *file, const char *name, const char *which)
{
  char known[1024];
  bool found = false, is_given = false;
  for (size_t i = 0; i < file->dimension_count; ++i) {
    const fg__nc_dimension *d = &file->dimensions[i];
    if (strcmp(d->name, name) != 0)
      continue;
    if (d->is_chosen) {
      is_given = true;
      continue;
    }
    const fg_status status = choose_sample(file, (int)i, which);
    if (status != FG_STATUS_OK)
      return status;
    found = true;
  }
  if (found)
    return FG_STATUS_OK;
  if (is_given)
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: of '%.100s' two samples are chosen, and one is read",
                    file->paths[0], name);
  list_dimensions(known, sizeof known, file);
  fg__fail(file->context, FG_STATUS_ARGUMENT,
           "%s: has no dimension '%.100s' to choose by", file->paths[0], name);
  if (known[0])
    fg__hint(file->context, "dimensions in it: %s", known);
  return FG_STATUS_ARGUMENT;
}

fg_status fg__nc_choose_samples(fg__nc_file *file, const char *text)
{
  char *copy = fg__copy_text(text);
  fg_status status =
      copy ? FG_STATUS_OK : fg__fail_memory(file->context, "a choice", strlen(text) + 1);
  for (char *one = copy; one && status == FG_STATUS_OK;) {
    char *comma = strchr(one, ','), *equals = strchr(one, '=');
    if (comma)
      *comma = '\0';
    if (!equals || equals == one || !equals[1] || (comma && equals > comma)) {
      status =
          fg__fail(file->context, FG_STATUS_ARGUMENT,
                   "'%.200s' is no choice of a dimension's sample, as number=2", one);
      break;
    }
    *equals = '\0';
    status = choose_named(file, one + strspn(one, " "), equals + 1);
    one = comma ? comma + 1 : NULL;
  }
  free(copy);
  return status;
}

/* "member 2", by its coordinate; "scenario ssp585", by its label. */
static fg_status write_words(char *out, size_t size, const fg__nc_file *file,
                             int dimension)
{
  const fg__nc_dimension *d = &file->dimensions[dimension];
  const fg__nc_variable *coordinate = coordinate_of(file, dimension);
  char label[FG__NC_TEXT] = "";
  fg_status status =
      coordinate ? FG_STATUS_OK : fg__nc_label(label, file, dimension, d->chosen);
  if (status == FG_STATUS_OK && label[0])
    snprintf(out, size, "%s %s", d->name, label);
  else if (status == FG_STATUS_OK)
    status = fg__nc_index_words(file, coordinate, d->name, coordinate ? 0 : d->chosen,
                                out, size);
  return status;
}

fg_status fg__nc_chosen_words(const fg__nc_file *file, const fg__nc_variable *variable,
                              char *words, size_t size)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < variable->rank && status == FG_STATUS_OK; ++k) {
    const size_t used = strlen(words);
    const char *between = used ? ", " : "";
    if (!file->dimensions[variable->dimension[k]].is_chosen ||
        used + strlen(between) + 1 >= size)
      continue;
    strcpy(words + used, between);
    status = write_words(words + used + strlen(between), size - used - strlen(between),
                         file, variable->dimension[k]);
  }
  return status;
}

fg_status fg__nc_check_choices(const fg__nc_file *file, const fg__nc_pair *pair)
{
  for (size_t i = 0; i < file->dimension_count; ++i) {
    const fg__nc_dimension *d = &file->dimensions[i];
    bool used = !d->is_chosen;
    for (int n = 0; n < 2; ++n)
      for (int k = 0; k < pair->component[n]->rank; ++k)
        used = used || strcmp(file->dimensions[pair->component[n]->dimension[k]].name,
                              d->name) == 0;
    if (!used)
      return fg__fail(file->context, FG_STATUS_ARGUMENT,
                      "%s: '%.100s' and '%.100s' have no dimension '%.100s' to choose by",
                      file->paths[0], pair->component[0]->plain_name,
                      pair->component[1]->plain_name, d->name);
  }
  return FG_STATUS_OK;
}
