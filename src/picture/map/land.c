#include "picture/map/land.h"

#include <math.h>
#include <stdlib.h>

#include "picture/map/tracer.h"

/* Straight in longitude and latitude is not straight on the plane: a place at least every
 * degree, and many in a frame. */
static const double longest_step = 1.0, steps_in_frame = 60.0;

static fg__coast_part part_of(const fg__coast_lines *lines, size_t k, bool closed)
{
  fg__coast_part p = {.point = (const double(*)[2])(lines->point + lines->start[k]),
                      .count = lines->start[k + 1] - lines->start[k],
                      .closed = closed,
                      .low = {HUGE_VAL, HUGE_VAL},
                      .high = {-HUGE_VAL, -HUGE_VAL}};
  for (size_t n = 0; n < p.count; ++n)
    for (int i = 0; i < 2; ++i) {
      p.low[i] = fmin(p.low[i], p.point[n][i]);
      p.high[i] = fmax(p.high[i], p.point[n][i]);
    }
  if (closed && p.count)
    p.turn = 360.0 * nearbyint((p.point[p.count - 1][0] - p.point[0][0]) / 360.0);
  return p;
}

fg_status fg__land_trace(fg__polygons *areas, fg__polygons *lines, fg_context *context,
                         const fg__plane *plane, fg__coast_layer layer,
                         fg__coast_detail detail)
{
  fg__coast_lines data;
  fg_status status = fg__coast_read(&data, context, layer, detail);
  if (status)
    return status;
  const double frame = fmin(plane->east - plane->west, plane->north - plane->south);
  fg__tracer tracer = {.plane = plane,
                       .areas = areas,
                       .lines = lines,
                       .step = fmin(longest_step, frame / steps_in_frame)};
  for (size_t k = 0; k < data.count && !tracer.failed; ++k) {
    const fg__coast_part p = part_of(&data, k, layer != FG__COAST_BORDERS);
    if (plane->kind == FG__PLANE_AZIMUTHAL)
      fg__trace_round(&tracer, &p);
    else
      fg__trace_flat(&tracer, &p);
    tracer.failed = tracer.failed || tracer.stroke.failed;
  }
  if (tracer.failed)
    status =
        fg__fail_memory(context, "coasts", data.start[data.count] * sizeof *data.point);
  free(tracer.clipped);
  free(tracer.next);
  fg__stroke_clear(&tracer.stroke);
  fg__coast_clear(&data);
  return status;
}
