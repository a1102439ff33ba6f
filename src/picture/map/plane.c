#include "picture/map/plane.h"

#include <math.h>

#include "base/feature.h"
#include "base/memory.h"
#include "field/mask.h"
#include "picture/polygons.h"
#include "sphere/sphere.h"

/* The frame is sampled at so many places a side to find what of the Earth it shows. */
enum { SAMPLES = 49, OUTLINE = 360 };

/* What is found so is wider by this share of it, and again, by so many degrees at most.
 */
static const double margin_share = 0.04, margin_degrees = 0.5;

/* Farther from the centre than this, azimuthal maps of the world are stretched to
 * infinity, or along their rim. */
static const double most_reach = 175.0;

/* Mercator's plane has no poles. */
static const double most_latitude = 89.5;

/* A map of the world shows at least so many degrees of longitude, and no less than this
 * share of the outline's area is in its box. */
static const double world_arc = 350.0;
static const double rectangle_share = 0.985;

/* What is less high than this share of the world has a frame of its own. */
static const double band_share = 0.5;

/* Lengths on the map, over those on the ground, that one key may stand for. */
static const double most_distortion = 1.35;

void fg__plane_forward(const fg__plane *plane, size_t n, const double *longitude,
                       const double *latitude, double *x, double *y)
{
  if (plane->map) {
    fg__map_forward(plane->map, n, longitude, latitude, x, y);
    return;
  }
  for (size_t i = 0; i < n; ++i) {
    x[i] = longitude[i];
    y[i] = latitude[i];
  }
}

void fg__plane_inverse(const fg__plane *plane, size_t n, const double *x, const double *y,
                       double *longitude, double *latitude)
{
  if (plane->map) {
    fg__map_inverse(plane->map, n, x, y, longitude, latitude);
    return;
  }
  for (size_t i = 0; i < n; ++i) {
    longitude[i] = x[i];
    latitude[i] = y[i];
  }
}

/* The place of sample n of the frame's in the field's coordinates. */
static void sample_place(const fg__plane *plane, int n, double at[2])
{
  const int place[2] = {n % SAMPLES, n / SAMPLES};
  for (int k = 0; k < 2; ++k)
    at[k] = plane->low[k] + (plane->high[k] - plane->low[k]) * place[k] / (SAMPLES - 1.0);
}

/* How far from the centre anything has an image: half way round at most. */
static double farthest_image(const fg__plane *plane)
{
  double near = 0.0, far = most_reach;
  const double up = plane->center[1] > 0.0 ? -1.0 : 1.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = k == 0 ? far : 0.5 * (near + far);
    const double turned = plane->center[1] + up * middle; /* over a pole it may go */
    const bool over = fabs(turned) > 90.0;
    const double latitude = over ? copysign(180.0, turned) - turned : turned;
    const double longitude = plane->center[0] + (over ? 180.0 : 0.0);
    double x, y;
    fg__map_forward(plane->map, 1, &longitude, &latitude, &x, &y);
    const bool has_image = isfinite(x) && isfinite(y);
    if (has_image && k == 0)
      return far;
    if (has_image)
      near = middle;
    else
      far = middle;
  }
  return near;
}

static void widen(double *low, double *high, double least, double most)
{
  const double share = margin_share * (*high - *low);
  const double more = share + fmin(share, margin_degrees);
  *low = fmax(*low - more, least);
  *high = fmin(*high + more, most);
}

/* Longitudes and latitudes that the frame shows, and how far they are from the centre. */
static void find_window(fg__plane *plane)
{
  double most = 0.0;
  bool beyond = false; /* the frame reaches beyond the plane's outline */
  plane->west = plane->south = HUGE_VAL;
  plane->east = plane->north = -HUGE_VAL;
  for (int n = 0; n < SAMPLES * SAMPLES; ++n) {
    double at[2], place[2];
    sample_place(plane, n, at);
    fg__map_inverse(plane->map, 1, &at[0], &at[1], &place[0], &place[1]);
    if (!isfinite(place[0]) || !isfinite(place[1])) {
      beyond = true;
      continue;
    }
    plane->west = fmin(plane->west, place[0]);
    plane->east = fmax(plane->east, place[0]);
    plane->south = fmin(plane->south, place[1]);
    plane->north = fmax(plane->north, place[1]);
    most = fmax(most, fg__sphere_distance(plane->center, place));
  }
  if (plane->west > plane->east) { /* nothing of the Earth */
    plane->west = plane->east = plane->center[0];
    plane->south = plane->north = plane->center[1];
  }
  const double pole =
      fg__map_kind_of(plane->map) == FG__MAP_CYLINDRICAL && !fg__map_is_world(plane->map)
          ? most_latitude
          : 90.0;
  widen(&plane->west, &plane->east, plane->center[0] - 180.0, plane->center[0] + 180.0);
  widen(&plane->south, &plane->north, -pole, pole);
  plane->reach = farthest_image(plane);
  if (!beyond)
    plane->reach = fmin(plane->reach, (1.0 + margin_share) * most + margin_degrees);
}

static bool add_outline_point(fg__plane *plane, double x, double y)
{
  const double at[2] = {x, y};
  return !isfinite(x) || !isfinite(y) || fg__polygons_add(&plane->outline, at);
}

/* The rim of the longitudes from lon0 - 180 to lon0 + 180, anticlockwise. */
static bool trace_cut(fg__plane *plane)
{
  const double half = 180.0 - 1e-9;
  bool good = fg__polygons_begin(&plane->outline);
  for (int n = 0; good && n < 4 * OUTLINE; ++n) {
    const double share = (double)(n % OUTLINE) / OUTLINE;
    double longitude, latitude, x, y;
    switch (n / OUTLINE) {
    case 0:
      longitude = -half + 2.0 * half * share, latitude = -90.0;
      break;
    case 1:
      longitude = half, latitude = -90.0 + 180.0 * share;
      break;
    case 2:
      longitude = half - 2.0 * half * share, latitude = 90.0;
      break;
    default:
      longitude = -half, latitude = 90.0 - 180.0 * share;
    }
    longitude += plane->center[0];
    fg__map_forward(plane->map, 1, &longitude, &latitude, &x, &y);
    good = add_outline_point(plane, x, y);
  }
  return good;
}

static bool trace_circle(fg__plane *plane, const double middle[2], double radius)
{
  bool good = fg__polygons_begin(&plane->outline);
  for (int n = 0; good && n < OUTLINE; ++n) {
    const double angle = 2.0 * acos(-1.0) * n / OUTLINE;
    good = add_outline_point(plane, middle[0] + radius * cos(angle),
                             middle[1] + radius * sin(angle));
  }
  return good;
}

static void outline_box(double low[2], double high[2], const fg__polygons *outline)
{
  low[0] = low[1] = HUGE_VAL;
  high[0] = high[1] = -HUGE_VAL;
  for (size_t n = 0; n < outline->point_count; ++n)
    for (int k = 0; k < 2; ++k) {
      low[k] = fmin(low[k], outline->point[n][k]);
      high[k] = fmax(high[k], outline->point[n][k]);
    }
}

/* Whether the field has no sample in the box's corners, outside of the circle in it. */
static bool corners_are_missing(const fg__plane *plane, const fg_field *field,
                                const double middle[2], double radius)
{
  const fg_field_arrays *grid = fg_field_contents(field);
  for (int j = 0; j < grid->size[1]; ++j)
    for (int i = 0; i < grid->size[0]; ++i) {
      const double x = grid->axis[0][i], y = grid->axis[1][j];
      const bool shown = x >= plane->low[0] && x <= plane->high[0] &&
                         y >= plane->low[1] && y <= plane->high[1];
      if (shown && hypot(x - middle[0], y - middle[1]) > 1.03 * radius &&
          fg__field_sample_is_valid(field, i, j))
        return false;
    }
  return true;
}

/* A cap or hemisphere: the frame is a square round the centre, in which a circle lies. */
static fg_status find_disc(fg__plane *plane, fg_context *context, const fg_field *field)
{
  double middle[2], wide = plane->high[0] - plane->low[0];
  fg__map_forward(plane->map, 1, &plane->center[0], &plane->center[1], &middle[0],
                  &middle[1]);
  for (int k = 0; k < 2; ++k) {
    const double side = plane->high[k] - plane->low[k];
    if (!(fabs(0.5 * (plane->low[k] + plane->high[k]) - middle[k]) < 0.02 * wide) ||
        fabs(side - wide) > 0.02 * wide)
      return FG_STATUS_OK;
  }
  if (!corners_are_missing(plane, field, middle, 0.5 * wide))
    return FG_STATUS_OK;
  const double east = middle[0] + 0.5 * wide;
  double rim[2];
  fg__map_inverse(plane->map, 1, &east, &middle[1], &rim[0], &rim[1]);
  plane->whole = plane->disc = true;
  plane->radius =
      isfinite(rim[0]) ? fg__sphere_distance(plane->center, rim) : plane->reach;
  return trace_circle(plane, middle, 0.5 * wide)
             ? FG_STATUS_OK
             : fg__fail_memory(context, "a map's outline", OUTLINE);
}

/* The whole Earth, within an outline that is no rectangle. */
static fg_status find_world(fg__plane *plane, fg_context *context)
{
  double low[2], high[2];
  if (!fg__map_is_world(plane->map) || plane->east - plane->west < world_arc)
    return FG_STATUS_OK;
  if (!trace_cut(plane))
    return fg__fail_memory(context, "a map's outline", OUTLINE);
  outline_box(low, high, &plane->outline);
  const double box = (high[0] - low[0]) * (high[1] - low[1]);
  const bool is_band = plane->high[1] - plane->low[1] < band_share * (high[1] - low[1]);
  if (is_band || fabs(fg__polygon_area(&plane->outline, 0)) > rectangle_share * box) {
    fg__polygons_clear(&plane->outline);
    return FG_STATUS_OK;
  }
  plane->whole = true;
  for (int k = 0; k < 2; ++k) {
    plane->low[k] = low[k];
    plane->high[k] = high[k];
  }
  plane->west = plane->center[0] - 180.0;
  plane->east = plane->center[0] + 180.0;
  plane->south = -90.0;
  plane->north = 90.0;
  return FG_STATUS_OK;
}

static void describe_degrees(fg__plane *out)
{
  out->kind = FG__PLANE_DEGREES;
  out->metres = FG__DEGREE_METRES;
  out->west = out->low[0];
  out->east = out->high[0];
  out->south = fmax(out->low[1], -90.0);
  out->north = fmin(out->high[1], 90.0);
  for (int k = 0; k < 2; ++k)
    out->center[k] = 0.5 * (out->low[k] + out->high[k]);
}

static fg_status describe_map(fg__plane *out, fg_context *context, const fg_field *field)
{
  fg_status status =
      fg__map_create(&out->map, context, fg_field_contents(field)->projection);
  if (status)
    return status;
  out->kind = fg__map_kind_of(out->map) == FG__MAP_AZIMUTHAL ? FG__PLANE_AZIMUTHAL
                                                             : FG__PLANE_CUT;
  out->center[0] = fg__map_center(out->map);
  out->center[1] = fg__map_center_latitude(out->map);
  out->metres = fg__map_unit(out->map);
  find_window(out);
  return out->kind == FG__PLANE_AZIMUTHAL ? find_disc(out, context, field)
                                          : find_world(out, context);
}

fg_status fg__plane_create(fg__plane *out, fg_context *context, const fg_field *field,
                           double low[2], double high[2])
{
  const fg_field_arrays *grid = fg_field_contents(field);
  fg_status status = FG_STATUS_OK;
  *out = (fg__plane){.kind = FG__PLANE_NONE};
  for (int k = 0; k < 2; ++k) {
    out->low[k] = low[k];
    out->high[k] = high[k];
  }
  if (grid->scale == FG_SCALE_GEO)
    describe_degrees(out);
  else if (grid->projection && fg_has_feature(FG_FEATURE_MAPS))
    status = describe_map(out, context, field);
  if (status) {
    fg__plane_clear(out);
    return status;
  }
  for (int k = 0; k < 2; ++k) {
    low[k] = out->low[k];
    high[k] = out->high[k];
  }
  return FG_STATUS_OK;
}

void fg__plane_clear(fg__plane *plane)
{
  fg__map_destroy(plane->map);
  fg__polygons_clear(&plane->outline);
  *plane = (fg__plane){.kind = FG__PLANE_NONE};
}

/* Metres on the ground in a unit along x at a place; NaN where there is none. */
static double metres_at(const fg__plane *plane, const double share[2])
{
  double x[2], y[2], place[2][2];
  const double step = 1e-3 * (plane->high[0] - plane->low[0]);
  for (int k = 0; k < 2; ++k) {
    x[k] = plane->low[0] + (plane->high[0] - plane->low[0]) * share[0] +
           (k == 0 ? -0.5 : 0.5) * step;
    y[k] = plane->low[1] + (plane->high[1] - plane->low[1]) * share[1];
    fg__plane_inverse(plane, 1, &x[k], &y[k], &place[k][0], &place[k][1]);
  }
  return FG__DEGREE_METRES * fg__sphere_distance(place[0], place[1]) / step;
}

double fg__plane_true_metres(const fg__plane *plane)
{
  static const double places[][2] = {{0.5, 0.5}, {0.1, 0.1}, {0.9, 0.1},
                                     {0.1, 0.9}, {0.9, 0.9}, {0.5, 0.1},
                                     {0.5, 0.9}, {0.1, 0.5}, {0.9, 0.5}};
  const double middle = metres_at(plane, places[0]);
  if (plane->whole || !isfinite(middle))
    return 0.0;
  for (size_t k = 1; k < sizeof places / sizeof *places; ++k) {
    const double there = metres_at(plane, places[k]);
    if (!(there < most_distortion * middle && middle < most_distortion * there))
      return 0.0;
  }
  return middle;
}
