#include "field/field.h"

#include <math.h>

/* Adds a row of data cells; `from` and `to` are its ends along y and z. */
static void add_row(fg__field_box *sum, const fg_field *field, const unsigned char *valid,
                    const double from[3], const double to[3])
{
  const double *x = field->axis[0].coordinate;
  double width = 0.0, left = HUGE_VAL, right = -HUGE_VAL;
  for (int i = 0; i < field->axis[0].cells; ++i)
    if (!valid || valid[i]) {
      width += x[i + 1] - x[i];
      left = fmin(left, x[i]);
      right = fmax(right, x[i + 1]);
    }
  if (!(width > 0.0))
    return;
  double measure = width;
  for (int k = 1; k < field->contents.dimension; ++k) {
    measure *= to[k] - from[k];
    sum->low[k] = fmin(sum->low[k], from[k]);
    sum->high[k] = fmax(sum->high[k], to[k]);
  }
  sum->low[0] = fmin(sum->low[0], left);
  sum->high[0] = fmax(sum->high[0], right);
  sum->measure += measure;
}

fg__field_box fg__field_box_of(const fg_field *field)
{
  fg__field_box out = {.measure = 0.0};
  const int dimension = field->contents.dimension;
  const int layers = dimension == 3 ? field->axis[2].cells : 1;
  const unsigned char *valid = field->valid_cell;
  for (int k = 0; k < dimension; ++k) {
    out.low[k] = HUGE_VAL;
    out.high[k] = -HUGE_VAL;
  }
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < field->axis[1].cells; ++j) {
      const double *y = field->axis[1].coordinate + j;
      double from[3] = {0.0, y[0]}, to[3] = {0.0, y[1]};
      if (dimension == 3) {
        from[2] = field->axis[2].coordinate[k];
        to[2] = field->axis[2].coordinate[k + 1];
      }
      add_row(&out, field, valid, from, to);
      if (valid)
        valid += field->axis[0].cells;
    }
  return out;
}
