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

/* Steps of an area's length and height at which its image is searched for gaps: where a
 * step's image is so many times longer than the ground, it is halved so often. */
enum { TEAR_ACROSS = 120, TEAR_ALONG = 60, HALVINGS = 30 };
static const double STRETCHED = 3.0;

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

/* The image of a position, if it is to be seen. */
static bool find_image(double at[2], const fg__map *map, double reach, double longitude,
                       double latitude)
{
  const double center = fg__map_center(map);
  const double largest =
      fg__map_kind_of(map) == FG__MAP_CYLINDRICAL ? LARGEST_CYLINDRICAL : LARGEST;
  if (fabs(longitude - center) > 180.0)
    longitude -= 360.0 * nearbyint((longitude - center) / 360.0);
  fg__map_forward(map, 1, &longitude, &latitude, &at[0], &at[1]);
  if (!isfinite(at[0]) || !isfinite(at[1]) ||
      (reach > 0.0 && distance(map, longitude, latitude) > reach))
    return false;
  return fg__map_is_world(map) || reach > 0.0 ||
         fg__map_length_scale(map, longitude, latitude) <= largest;
}

static void include(box *out, const fg__map *map, double reach, double longitude,
                    double latitude)
{
  double at[2];
  if (!find_image(at, map, reach, longitude, latitude))
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

/* Whether the image of a short line has a gap: halves of it, ever shorter, have images
 * ever nearer to each other, or do not. Lengths at a gap, by differences across it, say
 * nothing of what is shown there. */
static bool has_gap(const fg__map *map, double reach, const double from[2],
                    const double to[2])
{
  double a[2] = {from[0], from[1]}, b[2] = {to[0], to[1]}, image[3][2];
  if (!find_image(image[0], map, reach, a[0], a[1]) ||
      !find_image(image[1], map, reach, b[0], b[1]))
    return false;
  const double first = hypot(image[1][0] - image[0][0], image[1][1] - image[0][1]);
  const double ground = fg__sphere_distance(from, to) * FG__DEGREE_METRES;
  double left = first;
  if (!(first * fg__map_unit(map) > STRETCHED * ground))
    return false;
  for (int k = 0; k < HALVINGS && left > 0.25 * first; ++k) {
    const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    fg__map_forward(map, 1, &middle[0], &middle[1], &image[2][0], &image[2][1]);
    if (!isfinite(image[2][0]) || !isfinite(image[2][1]))
      return false;
    const double before = hypot(image[2][0] - image[0][0], image[2][1] - image[0][1]);
    const double after = hypot(image[1][0] - image[2][0], image[1][1] - image[2][1]);
    const bool earlier = before > after;
    memcpy(earlier ? b : a, middle, sizeof middle);
    memcpy(image[earlier ? 1 : 0], image[2], sizeof image[2]);
    left = earlier ? before : after;
  }
  return left > 0.25 * first;
}

/* Looks for gaps of the image along parallels and meridians, but for the cut. Projections
 * about a centre have none. */
static fg_status check_whole(fg_context *context, const fg__map *map, double reach,
                             const fg__map_area *area)
{
  if (fg__map_kind_of(map) == FG__MAP_AZIMUTHAL)
    return FG_STATUS_OK;
  const double center = fg__map_center(map);
  const double step[2] = {(area->east - area->west) / TEAR_ACROSS,
                          (area->north - area->south) / TEAR_ALONG};
  for (int j = 0; j < TEAR_ALONG; ++j)
    for (int i = 0; i < TEAR_ACROSS; ++i) {
      /* within half a turn of the centre, and off the grid's own lines and the poles */
      double longitude = area->west + (i + 0.37) * step[0];
      longitude -= 360.0 * nearbyint((longitude - center) / 360.0);
      const double at[2] = {longitude, area->south + (j + 0.37) * step[1]};
      const double east[2] = {fmin(at[0] + step[0], center + 180.0 - 1e-6), at[1]};
      const double north[2] = {at[0], fmin(at[1] + step[1], 90.0)};
      if (has_gap(map, reach, at, east) || has_gap(map, reach, at, north)) {
        fg_status status = fg__fail(
            context, FG_STATUS_ARGUMENT,
            "projection \"%s\": it is torn near longitude %.4g, latitude %.4g; a map can "
            "be cut along the meridian opposite its centre alone",
            fg__map_projection(map), at[0], at[1]);
        fg__hint(context,
                 "take one that is not interrupted, as equal-earth, or a --region "
                 "between the cuts");
        return status;
      }
    }
  return FG_STATUS_OK;
}

fg_status fg__map_plane_find(fg__map_plane *out, fg_context *context, const fg__map *map,
                             const fg__map_area *area, const fg__map_places *places,
                             bool is_region, int samples)
{
  const bool all_round = area->east - area->west >= FG__MAP_ALL_ROUND;
  box found = NOTHING;
  *out = (fg__map_plane){.area = *area, .bounded = is_region && all_round};
  out->reach = reach_of(map, is_region);
  for (size_t n = 0; !is_region && places && n < places->count; ++n)
    include(&found, map, out->reach, places->longitude[n], places->latitude[n]);
  if (!(found.low[0] < found.high[0]))
    include_area(&found, map, out->reach, area);
  const double width = found.high[0] - found.low[0],
               height = found.high[1] - found.low[1];
  if (!(width > 0.0 && height > 0.0 && isfinite(width) && isfinite(height)))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%s\": longitudes %g to %g, latitudes %g to %g have no "
                    "image to show",
                    fg__map_projection(map), area->west, area->east, area->south,
                    area->north);
  const fg_status status = check_whole(context, map, out->reach, area);
  if (status != FG_STATUS_OK)
    return status;
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
