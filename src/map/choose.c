#include "map/choose.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "flowgrain/words.h"
#include "sphere/sphere.h"

/* Mean radius of the Earth in metres: what we project stands on a sphere. */
static const char RADIUS[] = "6371000";

/* The cylinder whose faults in area and shape are least between 52 degrees north and
 * south (Behrmann 30, Hobo-Dyer 37.5). */
static const char CYLINDER_LATITUDE[] = "37";

typedef enum shape {
  ROUND = 0, /* a central meridian */
  ABOUT,     /* a centre */
  CONE,      /* two true parallels */
  TRUE_AT,   /* a true parallel */
  TRANSVERSE,
  ZONE
} shape;

static const struct named {
  const char *name, *proj;
  shape shape;
} NAMES[] = {
    {"equal-earth", "eqearth", ROUND},
    {"robinson", "robin", ROUND},
    {"mollweide", "moll", ROUND},
    {"natural-earth", "natearth", ROUND},
    {"sinusoidal", "sinu", ROUND},
    {"miller", "mill", ROUND},
    {"cea", "cea", TRUE_AT},
    {"cylindrical-equal-area", "cea", TRUE_AT},
    {"merc", "merc", TRUE_AT},
    {"mercator", "merc", TRUE_AT},
    {"eqc", "eqc", TRUE_AT},
    {"plate-carree", "eqc", TRUE_AT},
    {"equirectangular", "eqc", TRUE_AT},
    {"laea", "laea", ABOUT},
    {"lambert-azimuthal", "laea", ABOUT},
    {"polar", "laea", ABOUT},
    {"aeqd", "aeqd", ABOUT},
    {"azimuthal-equidistant", "aeqd", ABOUT},
    {"stere", "stere", ABOUT},
    {"stereographic", "stere", ABOUT},
    {"ortho", "ortho", ABOUT},
    {"orthographic", "ortho", ABOUT},
    {"gnom", "gnom", ABOUT},
    {"gnomonic", "gnom", ABOUT},
    {"lcc", "lcc", CONE},
    {"lambert-conformal", "lcc", CONE},
    {"aea", "aea", CONE},
    {"albers", "aea", CONE},
    {"eqdc", "eqdc", CONE},
    {"tmerc", "tmerc", TRANSVERSE},
    {"transverse-mercator", "tmerc", TRANSVERSE},
    {"utm", "utm", ZONE},
};

const char *fg__map_name_near(const char *string)
{
  static const char key[] = "+proj=";
  const char *at = strstr(string, key);
  char name[32];
  if (!at)
    return NULL;
  at += sizeof key - 1;
  snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
  for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
    if (fg_word_is_near(name, NAMES[k].name))
      return NAMES[k].name;
  return NULL;
}

static double width_of(const fg__map_area *area)
{
  return area->east - area->west;
}

static double height_of(const fg__map_area *area)
{
  return area->north - area->south;
}

static double middle_of(const fg__map_area *area)
{
  return 0.5 * (area->south + area->north);
}

/* One side of the equator, seen from over the pole. */
static bool is_cap(const fg__map_area *area)
{
  return (area->south >= 0.0 && area->north > 75.0) ||
         (area->north <= 0.0 && area->south < -75.0);
}

static bool is_polar(const fg__map_area *area)
{
  return (area->south >= 50.0 && area->north > 75.0) ||
         (area->north <= -50.0 && area->south < -75.0);
}

const char *fg__map_auto(const fg__map_area *area)
{
  const double width = width_of(area), height = height_of(area);
  const double middle = middle_of(area), cosine = cos(middle * FG__RADIANS);
  if (width >= FG__MAP_ALL_ROUND)
    return is_cap(area) ? "laea" : "eqearth";
  if (is_polar(area))
    return "laea";
  if (width > 180.0)
    return "eqearth";
  if (height > 90.0)
    return "laea";
  if (fabs(middle) < 15.0)
    return "merc";
  return height > 2.0 * width * cosine ? "tmerc" : "lcc";
}

const char *fg_map_auto(const fg_inventory_vector *vector)
{
  if (!vector || vector->unusable || vector->dimension != 2 ||
      vector->scale != FG_SCALE_GEO || !(vector->bounds[2] < vector->bounds[3]))
    return NULL;
  if (vector->plane)
    return vector->plane;
  const double west = vector->bounds[0];
  const double east = vector->periodic[0] ? west + 360.0 : vector->bounds[1];
  const fg__map_area area = {west, east, vector->bounds[2], vector->bounds[3], false};
  return fg__map_auto(&area);
}

/* A middle in few digits: within a fortieth of the width. */
static double rounded(double value, double width)
{
  const double step = width >= 40.0  ? 1.0
                      : width >= 4.0 ? 0.1
                      : width >= 0.4 ? 0.01
                                     : 0.001;
  return nearbyint(value / step) * step;
}

static double turned(double longitude)
{
  const double turn = remainder(longitude, 360.0);
  return turn <= -180.0 ? turn + 360.0 : turn;
}

static double longitude_of(const fg_map_options *options, const fg__map_area *area)
{
  if (options->has_center)
    return options->center[0];
  if (width_of(area) >= 350.0)
    return area->sea && !is_cap(area) ? -160.0 : 0.0;
  return turned(rounded(0.5 * (area->west + area->east), width_of(area)));
}

static double latitude_of(const fg_map_options *options, const fg__map_area *area,
                          bool at_pole)
{
  if (options->has_center_latitude)
    return options->center[1];
  const double middle = middle_of(area);
  if (at_pole || is_polar(area) || (width_of(area) >= FG__MAP_ALL_ROUND && is_cap(area)))
    return middle < 0.0 ? -90.0 : 90.0;
  return rounded(middle, height_of(area));
}

static bool set_angle(fg__map_words *words, const char *key, double value)
{
  char text[32];
  snprintf(text, sizeof text, "%.10g", value);
  return fg__map_words_set(words, key, strcmp(text, "-0") == 0 ? "0" : text);
}

/* Parallels at a sixth of the height from either end (Deetz and Adams 1934); a whole
 * globe has none, and gets those of a usual map of the north. */
static bool set_parallels(fg__map_words *words, const fg_map_options *options,
                          const fg__map_area *area)
{
  double south = area->south, north = area->north;
  const double height = height_of(area);
  if (fabs(middle_of(area)) < height / 12.0) {
    south = 10.0;
    north = 70.0;
  }
  const double sixth = (north - south) / 6.0;
  const double middle = options->has_center_latitude
                            ? options->center[1]
                            : rounded(0.5 * (south + north), height);
  return set_angle(words, "lat_0", middle) &&
         set_angle(words, "lat_1", rounded(south + sixth, height)) &&
         set_angle(words, "lat_2", rounded(north - sixth, height));
}

static bool set_zone(fg__map_words *words, double longitude, double latitude)
{
  const int zone = (int)floor((turned(longitude) + 180.0) / 6.0) + 1;
  char text[16];
  snprintf(text, sizeof text, "%d", zone < 1 ? 1 : zone > 60 ? 60 : zone);
  return fg__map_words_set(words, "zone", text) &&
         (latitude >= 0.0 || fg__map_words_set(words, "south", NULL));
}

static bool set_true_parallel(fg__map_words *words, const fg_map_options *options,
                              const fg__map_area *area)
{
  if (options->has_center_latitude)
    return set_angle(words, "lat_ts", options->center[1]);
  if (width_of(area) < FG__MAP_ALL_ROUND && fabs(middle_of(area)) < 75.0)
    return set_angle(words, "lat_ts", rounded(middle_of(area), height_of(area)));
  return strcmp(fg__map_words_find(words, "proj"), "cea") != 0 ||
         fg__map_words_set(words, "lat_ts", CYLINDER_LATITUDE);
}

/* The parameters of a named projection. */
static bool fill(fg__map_words *out, const char *name, const fg_map_options *options,
                 const fg__map_area *area)
{
  const char *proj = name;
  shape kind = ROUND;
  for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
    if (strcmp(name, NAMES[k].name) == 0) {
      proj = NAMES[k].proj;
      kind = NAMES[k].shape;
    }
  const double longitude = longitude_of(options, area);
  const double latitude = latitude_of(options, area, strcmp(name, "polar") == 0);
  bool fits = fg__map_words_set(out, "proj", proj);
  if (kind == ZONE)
    return fits && set_zone(out, longitude, latitude) &&
           fg__map_words_set(out, "ellps", "WGS84");
  fits = fits && set_angle(out, "lon_0", longitude);
  if (kind == ABOUT || kind == TRANSVERSE)
    fits = fits && set_angle(out, "lat_0", latitude);
  if (kind == CONE)
    fits = fits && set_parallels(out, options, area);
  if (kind == TRUE_AT)
    fits = fits && set_true_parallel(out, options, area);
  return fits && fg__map_words_set(out, "R", RADIUS);
}

static bool is_code(const char *text)
{
  return (text[0] == 'E' || text[0] == 'e') && (text[1] == 'P' || text[1] == 'p') &&
         (text[2] == 'S' || text[2] == 's') && (text[3] == 'G' || text[3] == 'g') &&
         text[4] == ':';
}

static bool is_string(const char *text)
{
  return strchr(text, '+') || strchr(text, '=');
}

static bool is_name(const char *text)
{
  size_t length = 0;
  while (isalnum((unsigned char)text[length]) || text[length] == '-' ||
         text[length] == '_')
    ++length;
  return length > 0 && !text[length] && length < FG__MAP_PARAMETER_BYTES / 2;
}

static fg_status read_asked(fg__map_words *out, fg_context *context,
                            const fg_map_options *options, const fg__map_area *area)
{
  const char *asked = options->projection ? options->projection : "auto";
  memset(out, 0, sizeof *out);
  if ((is_code(asked) || is_string(asked)) && options->has_center)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": it has a centre of its own, and another was "
                    "given",
                    asked);
  if (is_code(asked))
    return fg__map_of_code(out, context, asked);
  if (is_string(asked))
    return fg__map_words_read(out, context, asked);
  const char *name = strcmp(asked, "auto") == 0 ? fg__map_auto(area) : asked;
  if (is_name(name) && fill(out, name, options, area))
    return FG_STATUS_OK;
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT,
               "projection \"%.200s\": not a name, a PROJ string or a code", asked);
  fg__hint(context, "as auto, none, equal-earth, mercator, polar, \"+proj=laea "
                    "+lat_0=52 +lon_0=10\" or EPSG:3035");
  return status;
}

fg_status fg__map_choose(char out[FG__MAP_STRING_BYTES], fg_context *context,
                         const fg_map_options *options, const fg__map_area *area)
{
  fg__map_words words;
  fg_status status = read_asked(&words, context, options, area);
  if (status != FG_STATUS_OK)
    return status;
  if (fg__map_words_are_degrees(&words)) {
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "projection \"%.200s\": degrees, and no plane",
                      options->projection ? options->projection : "");
    fg__hint(context, "--projection none leaves longitude and latitude as they are");
    return status;
  }
  fg__map_words_drop(&words, "to_meter");
  if (fg__map_words_set(&words, "units", "km") && fg__map_words_write(out, &words))
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "projection \"%.200s\": too long",
                  options->projection ? options->projection : "");
}
