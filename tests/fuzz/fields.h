/* Any bytes as a file with a field: what is described can be told, and what is read has
 * the promised shape. */
#ifndef FG__FUZZ_FIELDS_H
#define FG__FUZZ_FIELDS_H

#include <assert.h>

#include "read/format.h"

static void describe(const fg__format *format, fg_context *context,
                     const fg__source *source)
{
  fg_inventory *inventory = NULL;
  if (fg__inventory_create(&inventory, context, format->name))
    return;
  const fg_status status =
      fg__dataset_inventory(inventory, context, format, source, NULL);
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  fg_inventory_destroy(inventory);
  fg_context_clear(context);
}

static bool read_part(const fg__format *format, fg_context *context,
                      const fg__source *source, const fg_read_options *options,
                      fg__slab_index slab)
{
  fg_field *field = NULL;
  const fg_status status =
      fg__dataset_read(&field, context, format, source, options, slab);
  assert((status == FG_STATUS_OK) == (field != NULL));
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  if (field) {
    const fg_field_arrays *a = fg_field_contents(field);
    assert(a->dimension == 2 || a->dimension == 3);
    for (int k = 0; k < a->dimension; ++k)
      for (int i = 1; i < a->size[k]; ++i)
        assert(a->axis[k][i - 1] < a->axis[k][i]);
  }
  fg_field_destroy(field);
  fg_context_clear(context);
  return status == FG_STATUS_OK;
}

/* Whether all of it could be read. */
static bool try_format(const fg__format *format, const char *name, const uint8_t *bytes,
                       size_t size)
{
  fg_context *context;
  if (!format->is_mine(bytes, size) || fg_context_create(&context))
    return false;
  const fg__source source = {.path = name, .bytes = bytes, .size = size};
  describe(format, context, &source);
  static const fg_read_options usual = {0};
  const bool was_read =
      read_part(format, context, &source, &usual, (fg__slab_index){0, 1});
  read_part(format, context, &source, &usual, (fg__slab_index){1, 3});
  fg_context_destroy(context);
  return was_read;
}

#endif
