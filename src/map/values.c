/* Whether a map has anything to show. */
#include "map/values.h"

#include <math.h>

/* Whether all of an area is covered, by what may be missing in parts. */
static bool is_covered(const fg__map_area *area, const fg__sphere_extent *extent)
{
  const double west = remainder(area->west - extent->west, 360.0);
  const double from = west < 0.0 ? west + 360.0 : west;
  return area->south >= extent->south && area->north <= extent->north &&
         (extent->east - extent->west >= 360.0 ||
          from + area->east - area->west <= extent->east - extent->west);
}

static fg_status fail_empty(fg_context *context, const fg__map_area *area,
                            const fg__sphere_extent *extent)
{
  if (is_covered(area, extent))
    return fg__fail(
        context, FG_STATUS_ARGUMENT,
        "field: the velocity is missing everywhere from longitude %g to %g and "
        "latitude %g to %g",
        area->west, area->east, area->south, area->north);
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "field: the map of longitudes %g to %g and latitudes %g to %g has no "
                  "values; there are some from %g to %g and from %g to %g",
                  area->west, area->east, area->south, area->north, extent->west,
                  extent->east, extent->south, extent->north);
}

fg_status fg__map_check_values(fg_context *context, const fg__map_area *area,
                               const fg__sphere *sphere, float *const velocity[2],
                               size_t count, bool all)
{
  bool has_value = false;
  for (size_t i = 0; i < count; ++i) {
    const float east = velocity[0][i], north = velocity[1][i];
    if (!all && !isnan(east))
      return FG_STATUS_OK;
    if (fabsf(east) > 0.0f || fabsf(north) > 0.0f) /* false for NaN */
      return FG_STATUS_OK;
    has_value = has_value || !isnan(east);
  }
  if (!all)
    return FG_STATUS_OK;
  fg__sphere_extent extent;
  fg__sphere_extent_of(&extent, sphere);
  if (!has_value)
    return fail_empty(context, area, &extent);
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "field: the velocity is zero everywhere from longitude %g to %g and "
                  "latitude %g to %g (%zu points of the field are not missing)",
                  area->west, area->east, area->south, area->north, extent.points);
}
