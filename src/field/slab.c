#include "field/slab.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "field/mask.h"

void fg__slab_rows(int *first, int *own, int rows, int number, int count)
{
  *first = (int)((int64_t)rows * number / count);
  *own = (int)((int64_t)rows * (number + 1) / count) - *first;
}

int fg__slab_rows_held(int rows, int first, int own, bool periodic)
{
  return own + (periodic || first + own < rows);
}

fg_status fg__field_create_window(fg_field **out, fg_context *context, const fg_field *of,
                                  const int first[3], const int held[3],
                                  float *const velocity[3])
{
  fg_field *window = *out = fg__allocate(1, sizeof *window);
  if (!window) {
    for (int k = 0; k < of->contents.dimension; ++k)
      free(velocity[k]);
    return fg__fail_memory(context, "a window of the field", sizeof *window);
  }
  *window = *of;
  window->of = of;
  window->slab = NULL;
  window->words = 0;
  window->valid = window->valid_cell = NULL;
  window->contents.valid = NULL;
  for (int k = 0; k < 3; ++k) {
    window->first[k] = first[k];
    window->held[k] = held[k];
    window->velocity[k] = k < of->contents.dimension ? velocity[k] : NULL;
    window->contents.velocity[k] = window->velocity[k];
  }
  return FG_STATUS_OK;
}

static size_t mask_row(const fg_field *field)
{
  return ((size_t)field->contents.size[0] + CHAR_BIT - 1) / CHAR_BIT;
}

bool fg__field_sample_is_valid(const fg_field *field, int i, int j)
{
  const fg__field_slab *slab = field->slab;
  if (slab) {
    if (!slab->valid)
      return true;
    const size_t at = (size_t)j * mask_row(field) + (size_t)i / CHAR_BIT;
    return slab->valid[at] >> (i % CHAR_BIT) & 1;
  }
  const size_t at = (size_t)j * (size_t)field->contents.size[0] + (size_t)i;
  return !isnan(field->velocity[0][at]);
}

bool fg_field_is_slab(const fg_field *field, int *first, int *count)
{
  const int last = fg__field_last_axis(field);
  if (first)
    *first = field->first[last];
  if (count)
    *count = field->slab ? field->slab->own : field->held[last];
  return field->slab != NULL;
}
