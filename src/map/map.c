#include "map/map.h"

#include <math.h>
#include <proj.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "map/choose.h"
#include "map/words.h"
#include "sphere/sphere.h"

/* A way there and back may be so many metres off; libproj answers outside the outline of
 * several projections, far off. */
static const double ROUND_TRIP = 1000.0;

enum { CHUNK = 256 };

struct fg__map {
  PJ_CONTEXT *context;
  PJ *over; /* with "+over": longitudes are not wrapped */
  char *projection;
  double unit;
  double center[2];
  double radius, flatness; /* a in metres and e squared of the ellipsoid */
  bool degrees; /* the plane's coordinates are longitude and latitude, in any turn */
  bool angular; /* the plane's coordinates are angles */
  bool is_world;
  fg__map_kind kind;
};

/* PROJ looks for its own files in places that the environment names: none is needed. */
static PROJ_FILE_HANDLE *open_nothing(PJ_CONTEXT *context, const char *name,
                                      PROJ_OPEN_ACCESS access, void *data)
{
  (void)context;
  (void)name;
  (void)access;
  (void)data;
  return NULL;
}

static int nothing_exists(PJ_CONTEXT *context, const char *name, void *data)
{
  (void)context;
  (void)name;
  (void)data;
  return 0;
}

static PJ_CONTEXT *create_context(void)
{
  const PROJ_FILE_API none = {
      .version = 1, .open_cbk = open_nothing, .exists_cbk = nothing_exists};
  PJ_CONTEXT *context = proj_context_create();
  if (!context)
    return NULL;
  proj_log_level(context, PJ_LOG_NONE);
  proj_context_set_enable_network(context, 0);
  proj_context_set_fileapi(context, &none, NULL);
  return context;
}

static fg_status fail(const fg__map *map, fg_context *context, const char *string)
{
  const int error = proj_context_errno(map->context);
  fg_status status = fg__fail(
      context, FG_STATUS_ARGUMENT, "projection \"%.200s\": PROJ refuses it: %s", string,
      error ? proj_context_errno_string(map->context, error) : "it is no projection");
  const char *near = fg__map_name_near(string);
  if (near)
    fg__hint(context, "is %s meant?", near);
  else
    fg__hint(context, "`proj -l` lists PROJ's projections, proj.org their parameters");
  return status;
}

/* Angles to the plane and back, or NaN. */
static PJ_COORD transform(const fg__map *map, PJ_DIRECTION direction, double x, double y)
{
  const PJ_COORD nowhere = {.xy = {(double)NAN, (double)NAN}};
  if (!isfinite(x) || !isfinite(y))
    return nowhere;
  const PJ_COORD out = proj_trans(map->over, direction, proj_coord(x, y, 0.0, 0.0));
  if (isfinite(out.xy.x) && isfinite(out.xy.y) && out.xy.x < 1e30 && out.xy.y < 1e30)
    return out;
  proj_errno_reset(map->over);
  return nowhere;
}

static void forward(const fg__map *map, double longitude, double latitude, double out[2])
{
  const double factor = map->angular ? 1.0 / FG__RADIANS : 1.0;
  const PJ_COORD to =
      transform(map, PJ_FWD, longitude * FG__RADIANS, latitude * FG__RADIANS);
  out[0] = to.xy.x * factor;
  out[1] = to.xy.y * factor;
}

void fg__map_forward(const fg__map *map, size_t n, const double *longitude,
                     const double *latitude, double *x, double *y)
{
  for (size_t i = 0; i < n; ++i) {
    double out[2];
    forward(map, longitude[i], latitude[i], out);
    x[i] = out[0];
    y[i] = out[1];
  }
}

/* A longitude within half a turn of the centre. */
static double turned(const fg__map *map, double longitude)
{
  return longitude - 360.0 * nearbyint((longitude - map->center[0]) / 360.0);
}

static void inverse(const fg__map *map, double x, double y, double out[2])
{
  const double factor = map->angular ? FG__RADIANS : 1.0;
  const double slack = 1e-7; /* degrees: the cut itself is inside */
  PJ_COORD to = transform(map, PJ_INV, x * factor, y * factor);
  double longitude = to.xy.x / FG__RADIANS, latitude = to.xy.y / FG__RADIANS, back[2];
  out[0] = out[1] = (double)NAN;
  if (map->degrees && fabs(x) <= 1e4 && fabs(y) <= 90.0 + slack) {
    out[0] = turned(map, x);
    out[1] = fmin(fmax(y, -90.0), 90.0);
    return;
  }
  if (!(fabs(latitude) <= 90.0 + slack))
    return;
  if (fabs(longitude - map->center[0]) > 180.0 + slack)
    longitude = turned(map, longitude);
  forward(map, longitude, latitude, back);
  if (!(hypot(back[0] - x, back[1] - y) * map->unit <= ROUND_TRIP))
    return;
  out[0] = fmin(fmax(longitude, map->center[0] - 180.0), map->center[0] + 180.0);
  out[1] = fmin(fmax(latitude, -90.0), 90.0);
}

void fg__map_inverse(const fg__map *map, size_t n, const double *x, const double *y,
                     double *longitude, double *latitude)
{
  for (size_t i = 0; i < n; ++i) {
    double out[2];
    inverse(map, x[i], y[i], out);
    longitude[i] = out[0];
    latitude[i] = out[1];
  }
}

/* Metres in a unit of the plane, from the same projection in metres. */
static double find_unit(const fg__map *map, const fg__map_words *given)
{
  fg__map_words words = *given;
  char string[FG__MAP_STRING_BYTES];
  if (map->angular)
    return FG__DEGREE_METRES;
  fg__map_words_drop(&words, "units");
  fg__map_words_drop(&words, "to_meter");
  if (words.count == given->count || !fg__map_words_write(string, &words))
    return 1.0;
  fg__map metres = {.context = map->context};
  metres.over = proj_create(map->context, string);
  double unit = 1.0, x[2][2], y[2][2];
  const double longitude[2] = {map->center[0] + 2.0, map->center[0] + 3.0};
  const double latitude[2] = {map->center[1] * 0.9 + 1.0, map->center[1] * 0.9 + 2.0};
  if (metres.over) {
    fg__map_forward(&metres, 2, longitude, latitude, x[0], y[0]);
    fg__map_forward(map, 2, longitude, latitude, x[1], y[1]);
    unit = hypot(x[0][1] - x[0][0], y[0][1] - y[0][0]) /
           hypot(x[1][1] - x[1][0], y[1][1] - y[1][0]);
  }
  proj_destroy(metres.over);
  /* 1000 and 0.3048 have few digits, the quotient of differences has rounding errors */
  const double rounded = nearbyint(unit * 1e6) / 1e6;
  return isfinite(unit) && unit > 0.0
             ? (fabs(rounded - unit) < 1e-8 * unit ? rounded : unit)
             : 1.0;
}

/* From the lengths of short arcs on the equator. */
static void find_ellipsoid(fg__map *map)
{
  const double arc = 1e-3;
  const PJ_COORD origin = proj_coord(0.0, 0.0, 0.0, 0.0);
  const double east =
      proj_lp_dist(map->over, origin, proj_coord(arc, 0.0, 0.0, 0.0)) / arc;
  const double north = proj_lp_dist(map->over, proj_coord(0.0, -0.5 * arc, 0.0, 0.0),
                                    proj_coord(0.0, 0.5 * arc, 0.0, 0.0)) /
                       arc;
  map->radius = east;
  map->flatness = 1.0 - north / east;
}

static double angle_of(const fg__map_words *words, const char *key, double otherwise)
{
  const char *value = fg__map_words_find(words, key);
  return value ? proj_dmstor(value, NULL) / FG__RADIANS : otherwise;
}

static void find_center(fg__map *map, const fg__map_words *words)
{
  const char *zone = fg__map_words_find(words, "zone");
  double longitude = angle_of(words, "lon_0", angle_of(words, "lonc", 0.0));
  if (zone)
    longitude = 6.0 * strtod(zone, NULL) - 183.0;
  const double latitude = angle_of(words, "lat_0", 0.0);
  map->center[0] = fabs(longitude) <= 360.0 ? longitude : 0.0;
  map->center[1] = fabs(latitude) <= 90.0 ? latitude : 0.0;
  const char *name = fg__map_words_find(words, "proj");
  if (strcmp(name, "ups") == 0)
    map->center[1] = fg__map_words_find(words, "south") ? -90.0 : 90.0;
}

static fg__map_kind find_kind(const char *name)
{
  static const struct {
    const char *name;
    fg__map_kind kind;
  } kinds[] = {
      {"merc", FG__MAP_CYLINDRICAL},
      {"webmerc", FG__MAP_CYLINDRICAL},
      {"cea", FG__MAP_CYLINDRICAL},
      {"eqc", FG__MAP_CYLINDRICAL},
      {"mill", FG__MAP_CYLINDRICAL},
      {"gall", FG__MAP_CYLINDRICAL},
      {"cc", FG__MAP_CYLINDRICAL},
      {"comill", FG__MAP_CYLINDRICAL},
      {"patterson", FG__MAP_CYLINDRICAL},
      {"laea", FG__MAP_AZIMUTHAL},
      {"aeqd", FG__MAP_AZIMUTHAL},
      {"stere", FG__MAP_AZIMUTHAL},
      {"sterea", FG__MAP_AZIMUTHAL},
      {"ups", FG__MAP_AZIMUTHAL},
      {"ortho", FG__MAP_AZIMUTHAL},
      {"gnom", FG__MAP_AZIMUTHAL},
      {"nsper", FG__MAP_AZIMUTHAL},
      {"tpers", FG__MAP_AZIMUTHAL},
      {"airy", FG__MAP_AZIMUTHAL},
      {"geos", FG__MAP_AZIMUTHAL},
      {"lcc", FG__MAP_CONIC},
      {"aea", FG__MAP_CONIC},
      {"leac", FG__MAP_CONIC},
      {"eqdc", FG__MAP_CONIC},
      {"poly", FG__MAP_CONIC},
      {"bonne", FG__MAP_CONIC},
  };
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k)
    if (strcmp(name, kinds[k].name) == 0)
      return kinds[k].kind;
  return FG__MAP_OTHER;
}

/* The poles, the cut and the antipodes among others have images. */
static bool find_world(const fg__map *map)
{
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j) {
      double at[2];
      forward(map, map->center[0] + 30.0 * i, 15.0 * j, at);
      if (!(hypot(at[0], at[1]) * map->unit < 1e8))
        return false;
    }
  return true;
}

static bool has_image(const fg__map *map)
{
  bool found = false;
  for (int i = -5; i <= 6 && !found; ++i)
    for (int j = -5; j <= 5 && !found; ++j) {
      double at[2];
      forward(map, map->center[0] + 29.0 * i, 17.0 * j, at);
      found = isfinite(at[0]) && isfinite(at[1]);
    }
  return found && map->radius > 0.0 && isfinite(map->radius);
}

static fg_status open_map(fg__map *map, fg_context *context, const fg__map_words *words,
                          const char *given)
{
  fg__map_words with = *words;
  char string[FG__MAP_STRING_BYTES];
  map->context = create_context();
  if (!map->context)
    return fg__fail_memory(context, "a projection", 1);
  if (!fg__map_words_set(&with, "over", NULL) || !fg__map_words_write(string, &with))
    return fg__fail(context, FG_STATUS_ARGUMENT, "projection \"%.200s\": too long",
                    given);
  map->over = proj_create(map->context, string);
  if (!map->over || !proj_pj_info(map->over).has_inverse ||
      !proj_angular_input(map->over, PJ_FWD))
    return fail(map, context, given);
  map->angular = fg__map_words_are_degrees(words);
  map->degrees =
      map->angular && strcmp(fg__map_words_find(words, "proj"), "ob_tran") != 0;
  find_center(map, words);
  find_ellipsoid(map);
  if (!has_image(map))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": no point of the globe has an image", given);
  map->kind = find_kind(fg__map_words_find(words, "proj"));
  map->unit = find_unit(map, words);
  map->is_world = !map->angular && find_world(map);
  return FG_STATUS_OK;
}

fg_status fg__map_create(fg__map **out, fg_context *context, const char *projection)
{
  fg__map_words words;
  char string[FG__MAP_STRING_BYTES];
  *out = NULL;
  fg_status status = fg__map_words_read(&words, context, projection);
  if (status != FG_STATUS_OK)
    return status;
  fg__map *map = fg__allocate(1, sizeof *map);
  if (!map)
    return fg__fail_memory(context, "a map", sizeof *map);
  status = open_map(map, context, &words, projection);
  if (status == FG_STATUS_OK && fg__map_words_write(string, &words))
    map->projection = fg__copy_text(string);
  if (status == FG_STATUS_OK && !map->projection)
    status = fg__fail_memory(context, "a map", FG__MAP_STRING_BYTES);
  if (status == FG_STATUS_OK)
    *out = map;
  else
    fg__map_destroy(map);
  return status;
}

void fg__map_destroy(fg__map *map)
{
  if (!map)
    return;
  proj_destroy(map->over);
  if (map->context)
    proj_context_destroy(map->context);
  free(map->projection);
  free(map);
}

const char *fg__map_projection(const fg__map *map)
{
  return map->projection;
}

double fg__map_unit(const fg__map *map)
{
  return map->unit;
}

double fg__map_center(const fg__map *map)
{
  return map->center[0];
}

double fg__map_center_latitude(const fg__map *map)
{
  return map->center[1];
}

void fg__map_ellipsoid(const fg__map *map, double *radius, double *flatness)
{
  *radius = map->radius;
  *flatness = map->flatness;
}

fg__map_kind fg__map_kind_of(const fg__map *map)
{
  return map->kind;
}

bool fg__map_is_world(const fg__map *map)
{
  return map->is_world;
}
