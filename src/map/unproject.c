/* A field on the plane of a projection as one on the sphere: its samples are the corners
 * of cells there. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "field/field.h"
#include "map/map.h"
#include "map/project.h"

/* Of a sample, until the sphere has taken it over: its place, vector and cell. */
static const double SAMPLE_BYTES =
    2 * sizeof(double) + 2 * sizeof(float) + 4 * sizeof(int);

/* The sample after n, round a periodic axis. */
static int next_of(const fg__axis *axis, int n)
{
  return n + 1 == axis->samples ? 0 : n + 1;
}

static void join_corners(int *corner, const fg_field *field)
{
  const fg__axis *x = &field->axis[0], *y = &field->axis[1];
  for (int j = 0; j < y->cells; ++j)
    for (int i = 0; i < x->cells; ++i, corner += 4) {
      const int lower = j * x->samples, upper = next_of(y, j) * x->samples;
      corner[0] = lower + i;
      corner[1] = lower + next_of(x, i);
      corner[2] = upper + next_of(x, i);
      corner[3] = upper + i;
    }
}

/* Places and vectors of a row; `place` has room for a coordinate of each sample. */
static void lift_row(fg__sphere_cells *out, const fg__map *map, const fg_field *field,
                     int j, double *place)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  const size_t n = (size_t)arrays->size[0], row = (size_t)j * n;
  for (size_t i = 0; i < n; ++i) {
    place[i] = arrays->axis[1][j];
    out->east[row + i] = arrays->velocity[0][row + i];
    out->north[row + i] = arrays->velocity[1][row + i];
  }
  fg__map_inverse(map, n, arrays->axis[0], place, out->longitude + row,
                  out->latitude + row);
  fg__map_turn_back(map, n, out->longitude + row, out->latitude + row, out->east + row,
                    out->north + row);
}

fg_status fg__sphere_of_plane(fg__sphere **out, fg_context *context,
                              const fg_field *field)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  *out = NULL;
  if (arrays->dimension != 2 || arrays->scale != FG_SCALE_MAP || !arrays->projection ||
      !fg__field_is_whole(field))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: a whole field in 2D on the plane of a projection is needed");
  const size_t samples = (size_t)arrays->size[0] * (size_t)arrays->size[1];
  const size_t count = (size_t)field->axis[0].cells * (size_t)field->axis[1].cells;
  fg__sphere_cells cells = {.count = count, .words = arrays};
  fg__map *map = NULL;
  double *place = NULL;
  fg_status status = fg__check_memory(context, "field", (double)samples, SAMPLE_BYTES);
  if (status == FG_STATUS_OK)
    status = fg__map_create(&map, context, arrays->projection);
  if (status != FG_STATUS_OK)
    return status;
  place = fg__allocate((size_t)arrays->size[0], sizeof *place);
  if (!place || !fg__sphere_cells_allocate(&cells, samples, count)) {
    status =
        fg__fail_memory(context, "the globe's samples", samples * (size_t)SAMPLE_BYTES);
    goto cleanup;
  }
  for (int j = 0; j < arrays->size[1] && status == FG_STATUS_OK; ++j) {
    lift_row(&cells, map, field, j, place);
    status = fg__check_stop(context);
  }
  join_corners(cells.corner, field);
  if (status == FG_STATUS_OK)
    status = fg__sphere_of_cells(out, context, &cells);

cleanup:
  fg__sphere_cells_clear(&cells);
  fg__map_destroy(map);
  free(place);
  return status;
}
