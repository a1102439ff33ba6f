/* This rank's slab of a field that every rank has whole, joined. */
#ifndef FG__SLABS_TEST_H
#define FG__SLABS_TEST_H

#include <string.h>

#include "grid/field_slabs.h"
#include "grid/together_test.h"

/* Rows n .. of the whole go round its periodic axis. The caller joins the slabs. */
static inline fg_status slab_of_arrays(fg_field **out, const fg_field_arrays *whole)
{
  fg_field_arrays arrays = *whole;
  const int last = arrays.dimension - 1, rows = arrays.size[last];
  size_t row = 1;
  for (int k = 0; k < last; ++k)
    row *= (size_t)arrays.size[k];
  int first, own;
  fg__slab_rows(&first, &own, rows, us.ranks->rank, us.ranks->count);
  const int held = fg__slab_rows_held(rows, first, own, arrays.period[last] > 0.0);
  unsigned char *valid = arrays.valid ? allocate_or_end(row * (size_t)held, 1) : NULL;
  float *velocity[3] = {NULL};
  for (int k = 0; k <= last; ++k)
    arrays.velocity[k] = velocity[k] = allocate_or_end(row * (size_t)held, sizeof(float));
  for (int n = 0; n < held; ++n) {
    size_t from = row * (size_t)((first + n) % rows), to = row * (size_t)n;
    if (valid)
      memcpy(valid + to, whole->valid + from, row);
    for (int k = 0; k <= last; ++k)
      memcpy(velocity[k] + to, whole->velocity[k] + from, row * sizeof(float));
  }
  arrays.valid = valid;
  fg_status status = fg__field_create_slab(out, us.context, &arrays, NULL, us.ranks->rank,
                                           us.ranks->count);
  for (int k = 0; k <= last; ++k)
    free(velocity[k]);
  free(valid);
  return status;
}

/* NULL with one rank. */
static inline fg_field *joined_slab_of(const fg_field *whole)
{
  fg_field *part = NULL;
  if (us.ranks->count == 1)
    return NULL;
  expect(slab_of_arrays(&part, fg_field_contents(whole)) == FG_STATUS_OK);
  expect(fg__field_join(us.context, us.ranks, part) == FG_STATUS_OK);
  return part;
}

#endif
