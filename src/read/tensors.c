/* Tensor variables: rows of the matrix as fields. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "read/format.h"
#include "sample/space/space.h"

/* Components of nine beside their mirror images may differ by so much of the largest. */
static const double MOST_ASYMMETRY = 1e-4;

enum { AT_ONCE = 1 << 16, ENTRIES = 9 };

/* The first variable of nine components, or of six: xx, yy, zz, xy, yz, xz. */
static const fg__variable *find_variable(const fg__dataset *data)
{
  for (size_t n = 0; n < data->variable_count; ++n) {
    const fg__variable *v = &data->variables[n];
    if (v->location == FG__AT_POINTS && fg__is_number(v) && v->element == 1 &&
        (v->components == 9 || v->components == 6))
      return v;
  }
  return NULL;
}

/* The element with an entry of the matrix. */
static const fg__variable *entry(const fg__variable *v, int row, int column)
{
  static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  return v + (v->components == 9 ? 3 * row + column : place[row][column]);
}

static fg_status check_tensor(const fg__variable *v, const double *value, size_t count,
                              size_t n, size_t first)
{
  double largest = 0.0;
  for (size_t k = 0; k < ENTRIES; ++k)
    largest = fmax(largest, fabs(value[k * count + n]));
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < i; ++j) {
      const double one = value[(3 * i + j) * count + n],
                   other = value[(3 * j + i) * count + n];
      if (!(fabs(one - other) <= MOST_ASYMMETRY * largest))
        return fg__fail(v->owner->context, FG_STATUS_ARGUMENT,
                        "%s: array \"%.100s\": tensor %zu is not symmetric: %c%c is %g, "
                        "%c%c is %g",
                        v->path, v->name, first + n + 1, "xyz"[j], "xyz"[i], other,
                        "xyz"[i], "xyz"[j], one);
    }
  return FG_STATUS_OK;
}

/* Whether nine components are a symmetric matrix. */
static fg_status check_symmetry(const fg__dataset *data, const fg__variable *v)
{
  const size_t *points = data->space.points, row = points[0];
  const size_t once = row < AT_ONCE ? AT_ONCE / row : 1;
  fg_status status = FG_STATUS_OK;
  if (v->components != ENTRIES)
    return status;
  double *value = fg__allocate(ENTRIES * row * once, sizeof *value);
  if (!value)
    return fg__fail_memory(data->context, "tensors", ENTRIES * row * once * 8);
  for (size_t z = 0; z < points[2] && status == FG_STATUS_OK; ++z)
    for (size_t y = 0; y < points[1] && status == FG_STATUS_OK; y += once) {
      const size_t start[3] = {z, y, 0}, left = points[1] - y;
      const size_t count[3] = {1, left < once ? left : once, row}, all = count[1] * row;
      for (size_t k = 0; k < ENTRIES && status == FG_STATUS_OK; ++k)
        status = fg__variable_fetch(v + k, start, count, value + k * all);
      for (size_t n = 0; n < all && status == FG_STATUS_OK; ++n)
        status = check_tensor(v, value, all, n, (z * points[1] + y) * row);
    }
  free(value);
  return status;
}

static fg_status make_rows(fg_field *row[2], const fg__dataset *data,
                           const fg__variable *v)
{
  static const int plane[2][3][2] = {{{0, 0}, {0, 1}}, {{0, 1}, {1, 1}}};
  static const int space[2][3][2] = {{{0, 0}, {0, 1}, {0, 2}}, {{1, 1}, {1, 2}, {2, 2}}};
  static const fg_read_options plain = {.scale = FG_SCALE_PLAIN};
  const fg__space_domain *domain = data->space.domain;
  const int *axis = domain->axis;
  /* two layers of points are a plane for fields, but tensors of two layers may differ */
  if (domain->cells || (domain->flat >= 0 && data->space.points[domain->flat] > 1))
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    "%s: tensors on cells that are not along the axes, or on two layers, "
                    "cannot be read",
                    v->path);
  fg_status status = check_symmetry(data, v);
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    fg__grid grid;
    fg__pair pair = {.found_by = "tensors"};
    for (int d = 0; d < domain->dimension; ++d) {
      const int *at = (domain->dimension == 2 ? plane : space)[k][d];
      pair.component[d] = entry(v, axis[at[0]], axis[at[1]]);
    }
    status = fg__grid_find(&grid, data, &pair, &plain);
    for (int d = 0; d < domain->dimension; ++d)
      grid.component[d] = d;
    if (status == FG_STATUS_OK)
      status =
          fg__space_field(&row[k], data, &pair, &grid, &plain, (fg__slab_index){0, 1});
    fg__grid_clear(&grid);
  }
  return status;
}

fg_status fg__dataset_tensors(fg_field *row[2], bool *found, fg_context *context,
                              const fg__format *format, const fg__source *source)
{
  fg__dataset data = {0};
  fg_status status = fg__dataset_open(&data, context, format, source, NULL);
  const fg__variable *v = status == FG_STATUS_OK ? find_variable(&data) : NULL;
  *found = v != NULL;
  if (v)
    status = make_rows(row, &data, v);
  return fg__dataset_end(&data, status);
}
