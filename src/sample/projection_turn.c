/* Components of fields in a projection, turned to its axes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/memory.h"
#include "interpret/projector.h"
#include "sample/velocity.h"

/* Scales components from degrees to lengths: about a rotated pole a degree of longitude
 * is shorter than one of latitude. */
static void stretch(float *u, float *v, size_t n, double latitude)
{
  const double cosine = fmax(cos(latitude * FG__RADIANS), 1e-6);
  for (size_t i = 0; i < n; ++i) {
    const double x = (double)u[i] / cosine, y = (double)v[i];
    const double length = hypot(x, y);
    const double factor = length > 0.0 ? hypot((double)u[i], y) / length : 1.0;
    u[i] = (float)(x * factor);
    v[i] = (float)(y * factor);
  }
}

fg_status fg__projection_turn(float *const velocity[2], const fg__dataset *data,
                              const fg__grid *grid, const fg__rows *rows)
{
  const bool angular = strstr(grid->projection, "ob_tran") != NULL;
  if (!grid->projection[0] || (!grid->points_east && !angular))
    return FG_STATUS_OK;
  const size_t columns = grid->axis[0].size;
  double *place = fg__allocate(columns, 3 * sizeof *place);
  const fg__projector *by = data->projector;
  fg__map *map = NULL;
  fg_status status = place ? by->create(&map, data->context, grid->projection)
                           : fg__fail_memory(data->context, "a row", columns);
  for (int j = 0; j < rows->held && status == FG_STATUS_OK; ++j) {
    const double y =
        grid->axis[1].coordinate[(rows->first + j) % (int)grid->axis[1].size];
    float *u = velocity[0] + (size_t)j * columns, *v = velocity[1] + (size_t)j * columns;
    if (!grid->points_east) {
      stretch(u, v, columns, y);
      continue;
    }
    double *longitude = place + columns, *latitude = longitude + columns;
    for (size_t i = 0; i < columns; ++i)
      place[i] = y;
    by->inverse(map, columns, grid->axis[0].coordinate, place, longitude, latitude);
    by->turn(map, columns, longitude, latitude, u, v);
  }
  by->destroy(map);
  free(place);
  return status;
}
