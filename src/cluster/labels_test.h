/* Labels of plain arrays, for tests that have no density. */
#ifndef FG__LABELS_TEST_H
#define FG__LABELS_TEST_H

#include "base/context_test.h"
#include "cluster/raster.h"

/* The labels' density stays until the next call. */
static inline void label_arrays(fg__labels *out, const fg_density_arrays *arrays)
{
  static fg_density *density;
  fg_density_destroy(density);
  assert_int_equal(fg_density_create_from_arrays(&density, NULL, arrays), FG_STATUS_OK);
  assert_int_equal(fg__labels_create(out, NULL, density), FG_STATUS_OK);
}

#endif
