/* Samples of dimensions that are neither in space, time nor level: one member of an
 * ensemble. */
#include "base/memory.h"
#include "flowgrain/inventory.h"
#include "read/netcdf/netcdf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Makes a dimension one of a single sample. */
static fg_status choose_sample(fg__nc_file *file, int dimension, const char *which)
{
  fg__nc_dimension *d = &file->dimensions[dimension];
  fg_axis_value *values = NULL;
  char *text = NULL;
  fg_selection selection = {0};
  fg_status status =
      fg__nc_axis_values(&values, &text, file, coordinate_of(file, dimension), d->length);
  if (status == FG_STATUS_OK)
    status = fg_selection_find(&selection, file->context, d->name, which, values,
                               (int)d->length);
  if (status == FG_STATUS_OK && selection.count != 1)
    status = fail_not_one(file, d->name, which, selection.count);
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
  bool found = false;
  for (size_t i = 0; i < file->dimension_count; ++i) {
    const fg__nc_dimension *d = &file->dimensions[i];
    if (strcmp(d->name, name) != 0 || d->is_chosen || d->length > INT32_MAX)
      continue;
    const fg_status status = choose_sample(file, (int)i, which);
    if (status != FG_STATUS_OK)
      return status;
    found = true;
  }
  if (found)
    return FG_STATUS_OK;
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
    status = choose_named(file, one, equals + 1);
    one = comma ? comma + 1 : NULL;
  }
  free(copy);
  return status;
}

fg_status fg__nc_chosen_words(const fg__nc_file *file, const fg__nc_variable *variable,
                              char *words, size_t size)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < variable->rank && status == FG_STATUS_OK; ++k) {
    const fg__nc_dimension *d = &file->dimensions[variable->dimension[k]];
    const size_t used = strlen(words);
    const char *between = used ? ", " : "";
    if (!d->is_chosen || used + strlen(between) + 1 >= size)
      continue;
    const fg__nc_variable *coordinate = coordinate_of(file, variable->dimension[k]);
    strcpy(words + used, between);
    status =
        fg__nc_index_words(file, coordinate, d->name, coordinate ? 0 : d->chosen,
                           words + used + strlen(between), size - used - strlen(between));
  }
  return status;
}
