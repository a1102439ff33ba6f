#include "map/words.h"

#include <stdio.h>
#include <string.h>

/* They say what an object is, or lead from one datum to another, and leave the plane as
 * it is; +over is added where it is wanted, and x is east, y north. */
static const char *const SILENT[] = {"no_defs", "type",    "wktext",    "over",
                                     "axis",    "towgs84", "geoidgrids"};

/* They read files or are no projection. */
static const char *const REFUSED[] = {"init", "grids", "nadgrids", "step", "catalog",
                                      "file", "inv",   "xyzgrids", "model"};

/* Operations that PROJ knows beside projections, of angles to lengths, too. */
static const char *const OPERATIONS[] = {"pipeline", "cart", "geocent", "topocentric",
                                         "geoc",     "push", "pop",     "set"};

/* PROJ takes a text that is no number for 0. */
static const char *const NUMBERS[] = {
    "lon_0", "lat_0", "lat_1",  "lat_2", "lat_3",   "lon_1",   "lon_2",
    "lon_3", "lonc",  "lat_ts", "alpha", "gamma",   "k",       "k_0",
    "x_0",   "y_0",   "R",      "a",     "b",       "rf",      "f",
    "h",     "zone",  "azi",    "tilt",  "o_lat_p", "o_lon_p", "to_meter"};

/* A datum's ellipsoid: the way from one datum to another is no part of a plane, and some
 * need files for it. */
static const char *const DATUMS[][2] = {
    {"WGS84", "WGS84"},          {"GGRS87", "GRS80"},   {"NAD83", "GRS80"},
    {"NAD27", "clrk66"},         {"potsdam", "bessel"}, {"carthage", "clrk80ign"},
    {"hermannskogel", "bessel"}, {"ire65", "mod_airy"}, {"nzgd49", "intl"},
    {"OSGB36", "airy"}};

static void take_ellipsoid(char *parameter)
{
  static const char key[] = "datum=";
  if (strncmp(parameter, key, sizeof key - 1) != 0)
    return;
  for (size_t k = 0; k < sizeof DATUMS / sizeof *DATUMS; ++k)
    if (strcmp(parameter + sizeof key - 1, DATUMS[k][0]) == 0) {
      snprintf(parameter, FG__MAP_PARAMETER_BYTES, "ellps=%s", DATUMS[k][1]);
      return;
    }
}

static bool is_one_of(const char *key, const char *const *keys, size_t count)
{
  for (size_t k = 0; k < count; ++k)
    if (strcmp(key, keys[k]) == 0)
      return true;
  return false;
}

/* The length of the key of "key=value". */
static size_t key_length(const char *parameter)
{
  return strcspn(parameter, "=");
}

static bool has_key(const char *parameter, const char *key)
{
  const size_t length = key_length(parameter);
  return strlen(key) == length && strncmp(parameter, key, length) == 0;
}

static bool is_number(const char *text)
{
  return strspn(text, "0123456789.+-/dDeE'\"rRnNsSwW") == strlen(text) &&
         strpbrk(text, "0123456789");
}

static int place_of(const fg__map_words *words, const char *key)
{
  for (int k = 0; k < words->count; ++k)
    if (has_key(words->parameter[k], key))
      return k;
  return -1;
}

const char *fg__map_words_find(const fg__map_words *words, const char *key)
{
  const int k = place_of(words, key);
  if (k < 0)
    return NULL;
  const char *value = words->parameter[k] + key_length(words->parameter[k]);
  return *value ? value + 1 : value;
}

void fg__map_words_drop(fg__map_words *words, const char *key)
{
  for (int k = place_of(words, key); k >= 0; k = place_of(words, key)) {
    --words->count;
    memmove(words->parameter[k], words->parameter[k + 1],
            (size_t)(words->count - k) * sizeof words->parameter[0]);
  }
}

bool fg__map_words_set(fg__map_words *words, const char *key, const char *value)
{
  fg__map_words_drop(words, key);
  if (words->count == FG__MAP_PARAMETERS)
    return false;
  char *parameter = words->parameter[words->count++];
  const int length = snprintf(parameter, FG__MAP_PARAMETER_BYTES, "%s%s%s", key,
                              value ? "=" : "", value ? value : "");
  return length > 0 && length < FG__MAP_PARAMETER_BYTES;
}

bool fg__map_words_write(char out[FG__MAP_STRING_BYTES], const fg__map_words *words)
{
  size_t used = 0;
  for (int k = 0; k < words->count; ++k) {
    const int length = snprintf(out + used, FG__MAP_STRING_BYTES - used, "%s+%s",
                                k ? " " : "", words->parameter[k]);
    if (length < 0 || (size_t)length >= FG__MAP_STRING_BYTES - used)
      return false;
    used += (size_t)length;
  }
  return used > 0;
}

static fg_status refuse(fg_context *context, const char *string, const char *what)
{
  return fg__fail(context, FG_STATUS_ARGUMENT, "projection \"%.200s\": %s", string, what);
}

static fg_status add(fg__map_words *out, fg_context *context, const char *string,
                     const char *start, size_t length)
{
  if (*start == '+') {
    ++start;
    --length;
  }
  if (out->count == FG__MAP_PARAMETERS || length >= FG__MAP_PARAMETER_BYTES)
    return refuse(context, string, "too many or too long parameters");
  char *parameter = out->parameter[out->count];
  memcpy(parameter, start, length);
  parameter[length] = '\0';
  take_ellipsoid(parameter);
  char key[FG__MAP_PARAMETER_BYTES];
  snprintf(key, sizeof key, "%.*s", (int)key_length(parameter), parameter);
  if (strcmp(parameter, "nadgrids=@null") == 0 ||
      is_one_of(key, SILENT, sizeof SILENT / sizeof *SILENT))
    return FG_STATUS_OK;
  const char *value =
      parameter + key_length(parameter) + (strchr(parameter, '=') != NULL);
  if (is_one_of(key, NUMBERS, sizeof NUMBERS / sizeof *NUMBERS) && !is_number(value))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": +%s is to be a number", string, parameter);
  if (strcmp(key, "proj") == 0 &&
      is_one_of(value, OPERATIONS, sizeof OPERATIONS / sizeof *OPERATIONS))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": %s is no projection to a plane", string,
                    value);
  if (is_one_of(key, REFUSED, sizeof REFUSED / sizeof *REFUSED))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": +%s names a file or a chain of operations",
                    string, parameter);
  if (strcmp(key, "proj") == 0 && fg__map_words_find(out, "proj"))
    return refuse(context, string, "it has +proj twice");
  ++out->count;
  return FG_STATUS_OK;
}

fg_status fg__map_words_read(fg__map_words *out, fg_context *context, const char *string)
{
  static const char space[] = " \t\n\r";
  memset(out, 0, sizeof *out);
  if (strlen(string) >= FG__MAP_STRING_BYTES)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection: a string of %zu bytes; fewer than %d are taken",
                    strlen(string), FG__MAP_STRING_BYTES);
  fg_status status = FG_STATUS_OK;
  const char *at = string + strspn(string, space);
  while (*at && status == FG_STATUS_OK) {
    const size_t length = strcspn(at, space);
    status = add(out, context, string, at, length);
    at += length;
    at += strspn(at, space);
  }
  if (status == FG_STATUS_OK && !fg__map_words_find(out, "proj"))
    status = refuse(context, string, "it has no +proj=NAME");
  return status;
}

bool fg__map_words_are_degrees(const fg__map_words *words)
{
  static const char *const names[] = {"longlat", "latlong", "lonlat", "latlon"};
  const char *name = fg__map_words_find(words, "proj");
  if (strcmp(name, "ob_tran") == 0)
    name = fg__map_words_find(words, "o_proj");
  for (size_t k = 0; name && k < sizeof names / sizeof *names; ++k)
    if (strcmp(name, names[k]) == 0)
      return true;
  return false;
}
