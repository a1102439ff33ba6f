#include "map/plane.h"

#include <math.h>
#include <string.h>

#include "sphere/sphere.h"

/* Positions in a direction at which the area's image is looked at. */
enum { ACROSS = 241, ALONG = 121, FEWEST = 3 };

/* Lengths may be enlarged so many times before the map ends. */
static const double LARGEST = 3.0, LARGEST_CYLINDRICAL = 5.76; /* 1 / cos 80 degrees */

/* Of projections about a centre half the globe is shown, of the gnomonic 60 degrees. */
static const double REACH = 90.0, GNOMONIC_REACH = 60.0;

typedef struct box {
  double low[2], high[2];
} box;

static const box NOTHING = {{(double)INFINITY, (double)INFINITY},
                            {-(double)INFINITY, -(double)INFINITY}};

static double distance(const fg__map *map, double longitude, double latitude)
{
  const double center[2] = {fg__map_center(map), fg__map_center_latitude(map)};
  return fg__sphere_distance(center, (const double[2]){longitude, latitude});
}

/* Longitude in some turn, within the area's. */
static double in_area(const fg__map_area *area, double longitude)
{
  const double slack = 1e-9;
  return longitude - 360.0 * floor((longitude - area->west + slack) / 360.0);
}

bool fg__map_plane_shows(const fg__map_plane *plane, const fg__map *map, double longitude,
                         double latitude)
{
  const fg__map_area *area = &plane->area;
  if (plane->reach > 0.0 && !(distance(map, longitude, latitude) <= plane->reach + 1e-9))
    return false;
  if (!plane->bounded)
    return true;
  return latitude >= area->south && latitude <= area->north &&
         in_area(area, longitude) <= area->east + 1e-9;
}

static void include(box *out, const fg__map *map, double reach, double longitude,
                    double latitude)
{
  const double center = fg__map_center(map);
  const double largest =
      fg__map_kind_of(map) == FG__MAP_CYLINDRICAL ? LARGEST_CYLINDRICAL : LARGEST;
  if (fabs(longitude - center) > 180.0)
    longitude -= 360.0 * nearbyint((longitude - center) / 360.0);
  double at[2];
  fg__map_forward(map, 1, &longitude, &latitude, &at[0], &at[1]);
  if (!isfinite(at[0]) || !isfinite(at[1]) ||
      (reach > 0.0 && distance(map, longitude, latitude) > reach))
    return;
  if (!fg__map_is_world(map) && reach <= 0.0 &&
      !(fg__map_length_scale(map, longitude, latitude) <= largest))
    return;
  for (int k = 0; k < 2; ++k) {
    out->low[k] = fmin(out->low[k], at[k]);
    out->high[k] = fmax(out->high[k], at[k]);
  }
}

/* The cut's two sides, where it is in the area, are looked at, too. */
static void include_area(box *out, const fg__map *map, double reach,
                         const fg__map_area *area)
{
  const double center = fg__map_center(map);
  const double cut = in_area(area, center + 180.0);
  for (int j = 0; j < ALONG; ++j) {
    const double latitude = area->south + (area->north - area->south) * j / (ALONG - 1);
    for (int i = 0; i < ACROSS; ++i)
      include(out, map, reach, area->west + (area->east - area->west) * i / (ACROSS - 1),
              latitude);
    if (cut > area->east)
      continue;
    include(out, map, reach, center - 180.0, latitude);
    include(out, map, reach, center + 180.0, latitude);
  }
}

/* The length of the image of a line of positions, as far as it is to be seen. */
static double length_of(const fg__map *map, double reach, const double from[2],
                        const double to[2])
{
  double length = 0.0, last[2] = {(double)NAN, (double)NAN};
  for (int i = 0; i < ACROSS; ++i) {
    box one = NOTHING;
    const double share = (double)i / (ACROSS - 1);
    include(&one, map, reach, from[0] + (to[0] - from[0]) * share,
            from[1] + (to[1] - from[1]) * share);
    const double piece = hypot(one.low[0] - last[0], one.low[1] - last[1]);
    length += isfinite(piece) ? piece : 0.0;
    memcpy(last, one.low, sizeof last);
  }
  return length;
}

/* As long as the middle parallel, as high as the middle meridian. */
static void include_middle(box *out, const fg__map *map, double reach,
                           const fg__map_area *area)
{
  const double longitude = 0.5 * (area->west + area->east);
  const double latitude = 0.5 * (area->south + area->north);
  const double length[] = {length_of(map, reach, (double[2]){area->west, latitude},
                                     (double[2]){area->east, latitude}),
                           length_of(map, reach, (double[2]){longitude, area->south},
                                     (double[2]){longitude, area->north})};
  include(out, map, reach, longitude, latitude);
  for (int k = 0; k < 2; ++k) {
    out->low[k] -= 0.5 * length[k];
    out->high[k] += 0.5 * length[k];
  }
}

static double reach_of(const fg__map *map, bool is_region)
{
  if (fg__map_kind_of(map) != FG__MAP_AZIMUTHAL)
    return 0.0;
  if (strstr(fg__map_projection(map), "+proj=gnom"))
    return GNOMONIC_REACH;
  const bool has_area = strstr(fg__map_projection(map), "+proj=laea") ||
                        strstr(fg__map_projection(map), "+proj=aeqd");
  return has_area && is_region ? 179.0 : REACH;
}

fg_status fg__map_plane_find(fg__map_plane *out, fg_context *context, const fg__map *map,
                             const fg__map_area *area, bool is_region, int samples)
{
  const bool all_round = area->east - area->west >= FG__MAP_ALL_ROUND;
  box found = NOTHING;
  *out = (fg__map_plane){.area = *area, .bounded = is_region && all_round};
  out->reach = reach_of(map, is_region);
  if (is_region && !all_round)
    include_middle(&found, map, out->reach, area);
  else
    include_area(&found, map, out->reach, area);
  const double width = found.high[0] - found.low[0],
               height = found.high[1] - found.low[1];
  if (!(width > 0.0 && height > 0.0 && isfinite(width) && isfinite(height)))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%s\": longitudes %g to %g, latitudes %g to %g have no "
                    "image to show",
                    fg__map_projection(map), area->west, area->east, area->south,
                    area->north);
  const double longer = fmax(width, height);
  out->spacing = longer / (samples - 1);
  for (int k = 0; k < 2; ++k) {
    const double length = found.high[k] - found.low[k];
    const int intervals = (int)nearbyint(length / out->spacing);
    out->size[k] = (intervals < FEWEST ? FEWEST : intervals) + 1;
    out->first[k] = found.low[k] + 0.5 * (length - (out->size[k] - 1) * out->spacing);
  }
  return FG_STATUS_OK;
}
