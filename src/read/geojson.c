/* Icons from GeoJSON, by cJSON; every number and word is checked. */
#include "read/geojson.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "base/memory.h"

/* A tree of JSON takes some thirty times the text's memory; ten thousand icons of a
 * hundred points take a tenth of this. */
enum { LARGEST_FILE = 256 << 20 };

typedef struct reading {
  fg_context *context;
  const char *path;
  int feature;                 /* the one being read, from 0; -1: none */
  bool has_projection, on_map; /* of the file; on_map: not degrees */
} reading;

static fg_status fail(const reading *at, const char *what)
{
  if (at->feature < 0)
    return fg__fail(at->context, FG_STATUS_FILE_FORMAT, "%s: %s", at->path, what);
  return fg__fail(at->context, FG_STATUS_FILE_FORMAT, "%s: feature %d: %s", at->path,
                  at->feature, what);
}

static fg_status fail_member(const reading *at, const char *member, const char *wanted)
{
  return fg__fail(at->context, FG_STATUS_FILE_FORMAT, "%s: feature %d: \"%s\" is not %s",
                  at->path, at->feature, member, wanted);
}

static bool has_type(const cJSON *object, const char *type)
{
  const char *value =
      cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, "type"));
  return value && strcmp(value, type) == 0;
}

static fg_status read_position(double out[3], const reading *at, const cJSON *position,
                               const char *member)
{
  int count = cJSON_IsArray(position) ? cJSON_GetArraySize(position) : 0;
  if (count < 2 || count > 3)
    return fail_member(at, member, "made of positions of 2 or 3 numbers");
  out[2] = 0.0;
  const cJSON *number = position->child;
  for (int k = 0; k < count; ++k, number = number->next) {
    if (!cJSON_IsNumber(number) || !isfinite(number->valuedouble))
      return fail_member(at, member, "made of finite numbers");
    out[k] = number->valuedouble;
  }
  return FG_STATUS_OK;
}

/* A property of the plane, where the file tells which plane that is. */
static const cJSON *plane_of(const reading *at, const cJSON *feature, const char *name)
{
  const cJSON *properties = cJSON_GetObjectItemCaseSensitive(feature, "properties");
  return at->has_projection ? cJSON_GetObjectItemCaseSensitive(properties, name) : NULL;
}

/* *points is allocated; end it with free. */
static fg_status read_positions(double (**points)[3], int *count, const reading *at,
                                const cJSON *positions, const char *member)
{
  *count = cJSON_IsArray(positions) ? cJSON_GetArraySize(positions) : 0;
  if (*count < 2)
    return fail_member(at, member, "an array of at least 2 positions");
  *points = fg__allocate((size_t)*count, sizeof **points);
  if (!*points)
    return fg__fail_memory(at->context, "an icon's points",
                           (size_t)*count * sizeof **points);
  const cJSON *position = positions->child;
  for (int i = 0; i < *count; ++i, position = position->next) {
    fg_status status = read_position((*points)[i], at, position, member);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

/* The plane's coordinates where the file tells its projection, else the geometry's. */
static fg_status read_line(double (**points)[3], int *count, const reading *at,
                           const cJSON *feature)
{
  const cJSON *geometry = cJSON_GetObjectItemCaseSensitive(feature, "geometry");
  const cJSON *plane = plane_of(at, feature, "plane");
  if (plane)
    return read_positions(points, count, at, plane, "plane");
  if (!has_type(geometry, "LineString")) {
    const fg_status status = fail_member(at, "geometry", "a LineString");
    if (has_type(geometry, "MultiLineString"))
      fg__hint(at->context,
               "it is a MultiLineString: every icon is to be one line; ogr2ogr "
               "-explodecollections makes them so");
    return status;
  }
  if (at->on_map)
    return fail_member(at, "plane", "there, and the file's projection says it is");
  return read_positions(points, count, at,
                        cJSON_GetObjectItemCaseSensitive(geometry, "coordinates"),
                        "coordinates");
}

/* A number that may be left out, then *out stays as it is. */
static fg_status read_number(double *out, const reading *at, const cJSON *object,
                             const char *member)
{
  const cJSON *number = cJSON_GetObjectItemCaseSensitive(object, member);
  if (!number)
    return FG_STATUS_OK;
  if (!cJSON_IsNumber(number) || !isfinite(number->valuedouble) ||
      number->valuedouble < 0.0)
    return fail_member(at, member, "a finite number of at least 0");
  *out = number->valuedouble;
  return FG_STATUS_OK;
}

static fg_status read_whole_number(int *out, const reading *at, const cJSON *object,
                                   const char *member, int least)
{
  double number = *out;
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, member);
  fg_status status = read_number(&number, at, object, member);
  if (status != FG_STATUS_OK || !item)
    return status;
  if (number != floor(number) || number < least || number > INT_MAX)
    return fg__fail(at->context, FG_STATUS_FILE_FORMAT,
                    "%s: \"%s\" is %.17g, not a whole number from %d to %d", at->path,
                    member, number, least, INT_MAX);
  *out = (int)number;
  return FG_STATUS_OK;
}

static fg_status read_kind(fg_icon_kind *out, const reading *at, const cJSON *properties)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(properties, "kind");
  const char *kind = cJSON_GetStringValue(item);
  *out = FG_ICON_ARROW;
  if (!item || (kind && strcmp(kind, "arrow") == 0))
    return FG_STATUS_OK;
  if (!kind || (strcmp(kind, "ring") != 0 && strcmp(kind, "spiral") != 0))
    return fail_member(at, "kind", "\"arrow\", \"ring\" or \"spiral\"");
  *out = strcmp(kind, "ring") == 0 ? FG_ICON_RING : FG_ICON_SPIRAL;
  return FG_STATUS_OK;
}

static fg_status read_way(double out[2], const reading *at, const cJSON *way)
{
  const cJSON *number = way->child;
  for (int k = 0; k < 2; ++k, number = number->next) {
    if (cJSON_GetArraySize(way) != 2 || !cJSON_IsNumber(number) ||
        !isfinite(number->valuedouble) || number->valuedouble < 0.0)
      return fail_member(at, "way", "two finite numbers of at least 0");
    out[k] = number->valuedouble;
  }
  return FG_STATUS_OK;
}

/* What a placed icon goes on from. Other programs' lines may have an `id` of any kind:
 * only one beside a `seed` and a `way` is ours. */
static fg_status read_placement(fg_icon *icon, const reading *at, const cJSON *properties)
{
  const cJSON *seed = cJSON_GetObjectItemCaseSensitive(properties, "seed");
  const cJSON *way = cJSON_GetObjectItemCaseSensitive(properties, "way");
  if (!cJSON_IsArray(seed) || !cJSON_IsArray(way))
    return FG_STATUS_OK;
  fg_status status = read_whole_number(&icon->id, at, properties, "id", 1);
  if (status == FG_STATUS_OK)
    status = read_whole_number(&icon->parent, at, properties, "parent", 1);
  if (status == FG_STATUS_OK)
    status = read_position(icon->seed, at, seed, "seed");
  if (status == FG_STATUS_OK)
    status = read_way(icon->way, at, way);
  return status;
}

/* Properties that another program's lines lack stay 0; their cluster is their place in
 * the file and their centre the middle point. */
static fg_status read_properties(fg_icon *icon, const reading *at, const cJSON *feature)
{
  const cJSON *properties = cJSON_GetObjectItemCaseSensitive(feature, "properties");
  if (properties && !cJSON_IsObject(properties) && !cJSON_IsNull(properties))
    return fail_member(at, "properties", "an object");
  icon->cluster = at->feature + 1;
  memcpy(icon->center, icon->points[icon->point_count / 2], sizeof icon->center);
  const struct {
    const char *member;
    double *number;
  } numbers[] = {{"area", &icon->area},
                 {"volume", &icon->area},
                 {"speed", &icon->speed},
                 {"width", &icon->width},
                 {"tail_width", &icon->tail_width},
                 {"head_length", &icon->head_length},
                 {"head_width", &icon->head_width}};
  fg_status status = read_whole_number(&icon->cluster, at, properties, "cluster", 0);
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
    if (status == FG_STATUS_OK)
      status = read_number(numbers[i].number, at, properties, numbers[i].member);
  if (status == FG_STATUS_OK)
    status = read_kind(&icon->kind, at, properties);
  if (status == FG_STATUS_OK && plane_of(at, feature, "plane_area"))
    status = read_number(&icon->area, at, properties, "plane_area");
  const cJSON *center = plane_of(at, feature, "plane_center");
  if (!center && !plane_of(at, feature, "plane"))
    center = cJSON_GetObjectItemCaseSensitive(properties, "center");
  if (status == FG_STATUS_OK && center)
    status = read_position(icon->center, at, center, "center");
  if (status == FG_STATUS_OK)
    status = read_placement(icon, at, properties);
  return status;
}

static fg_status read_feature(fg__icon_list *list, const reading *at,
                              const cJSON *feature)
{
  double(*points)[3] = NULL;
  fg_icon icon = {0};
  if (!has_type(feature, "Feature"))
    return fail_member(at, "type", "\"Feature\"");
  fg_status status = read_line(&points, &icon.point_count, at, feature);
  icon.points = (const double(*)[3])points;
  if (status == FG_STATUS_OK)
    status = read_properties(&icon, at, feature);
  void *icons = list->icon;
  if (status == FG_STATUS_OK &&
      !fg__grow(&icons, &list->capacity, list->count + 1, sizeof icon))
    status = fg__fail_memory(at->context, "the list of icons",
                             (list->count + 1) * sizeof icon);
  if (status != FG_STATUS_OK) {
    free(points);
    return status;
  }
  list->icon = icons;
  list->icon[list->count++] = icon;
  return FG_STATUS_OK;
}

/* What a file does not tell of a score. */
#define UNKNOWN ((double)NAN)

static fg_status read_reader(fg_reader_error *out, const reading *at, const cJSON *error,
                             const char *name)
{
  const cJSON *reader = cJSON_GetObjectItemCaseSensitive(error, name);
  *out = (fg_reader_error){UNKNOWN, UNKNOWN, UNKNOWN};
  fg_status status = read_number(&out->mean, at, reader, "mean");
  if (status == FG_STATUS_OK)
    status = read_number(&out->percentile_95, at, reader, "percentile_95");
  if (status == FG_STATUS_OK)
    status = read_number(&out->speed_weighted, at, reader, "speed_weighted");
  return status;
}

/* The error that our own files have beside the icons. */
static fg_status read_error(fg__icon_list *list, const reading *at, const cJSON *root)
{
  const cJSON *error = cJSON_GetObjectItemCaseSensitive(root, "error");
  fg_score score = {.icons = (int)list->count,
                    .mean = UNKNOWN,
                    .percentile_95 = UNKNOWN,
                    .advection = UNKNOWN,
                    .critical_f1 = UNKNOWN,
                    .void_mean = UNKNOWN,
                    .void_max = UNKNOWN,
                    .ink = UNKNOWN,
                    .clutter = UNKNOWN,
                    .tangency = UNKNOWN,
                    .outside = UNKNOWN,
                    .shortest = UNKNOWN,
                    .longest = UNKNOWN,
                    .count_length = UNKNOWN};
  if (!cJSON_IsObject(error))
    return FG_STATUS_OK;
  fg_status status = read_number(&score.mean, at, error, "mean");
  if (status == FG_STATUS_OK)
    status = read_number(&score.percentile_95, at, error, "percentile_95");
  if (status == FG_STATUS_OK)
    status = read_reader(&score.diffusion, at, error, "diffusion");
  if (status == FG_STATUS_OK)
    status = read_reader(&score.nearest, at, error, "nearest");
  if (status == FG_STATUS_OK)
    status = read_reader(&score.inverse_distance, at, error, "inverse_distance");
  list->scored = status == FG_STATUS_OK && isfinite(score.mean);
  list->score = score;
  return status;
}

static fg_status read_projection(fg__icon_list *list, reading *at, const cJSON *root)
{
  enum { LONGEST = 1000 };
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(root, "projection");
  const char *projection = cJSON_GetStringValue(item);
  if (!item)
    return FG_STATUS_OK;
  if (!projection || strlen(projection) > LONGEST)
    return fail(at, "\"projection\" is not a PROJ string");
  list->projection = fg__copy_text(projection);
  if (!list->projection)
    return fg__fail_memory(at->context, "a projection", strlen(projection) + 1);
  at->has_projection = true;
  at->on_map = strcmp(projection, "+proj=longlat") != 0;
  return FG_STATUS_OK;
}

/* Those that our own files have behind the icons. */
static bool is_critical_point(const cJSON *feature)
{
  const cJSON *properties = cJSON_GetObjectItemCaseSensitive(feature, "properties");
  return has_type(cJSON_GetObjectItemCaseSensitive(feature, "geometry"), "Point") &&
         cJSON_IsNumber(cJSON_GetObjectItemCaseSensitive(properties, "index")) &&
         cJSON_IsString(cJSON_GetObjectItemCaseSensitive(properties, "kind"));
}

static fg_status read_collection(fg__icon_list *list, reading *at, const cJSON *root)
{
  const cJSON *features = cJSON_GetObjectItemCaseSensitive(root, "features");
  if (!has_type(root, "FeatureCollection") || !cJSON_IsArray(features))
    return fail(at, "JSON, but no GeoJSON FeatureCollection");
  fg_status projected = read_projection(list, at, root);
  if (projected != FG_STATUS_OK)
    return projected;
  const cJSON *feature;
  cJSON_ArrayForEach(feature, features)
  {
    ++at->feature;
    fg_status status =
        is_critical_point(feature) ? FG_STATUS_OK : read_feature(list, at, feature);
    if (status != FG_STATUS_OK)
      return status;
  }
  list->clusters = (int)list->count;
  fg_status status = read_whole_number(&list->clusters, at, root, "clusters", 0);
  if (status == FG_STATUS_OK)
    status = read_whole_number(&list->dropped, at, root, "dropped", 0);
  if (status == FG_STATUS_OK)
    status = read_whole_number(&list->next_id, at, root, "next_id", 1);
  return status == FG_STATUS_OK ? read_error(list, at, root) : status;
}

/* cJSON reads a byte beyond some malformed texts (CVE-2023-53154), so that it gets a copy
 * with an end mark. */
static fg_status parse(cJSON **out, const reading *at, const fg__source *source)
{
  if (source->size > LARGEST_FILE)
    return fg__fail(at->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu bytes of JSON; at most %d can be read", at->path,
                    source->size, LARGEST_FILE);
  char *text = fg__allocate(source->size + 1, 1);
  if (!text)
    return fg__fail_memory(at->context, "a file's text", source->size + 1);
  memcpy(text, source->bytes, source->size);
  const char *end = text;
  *out = cJSON_ParseWithLengthOpts(text, source->size + 1, &end, 0);
  fg_status status = FG_STATUS_OK;
  if (!*out)
    status =
        fg__fail(at->context, FG_STATUS_FILE_FORMAT, "%s: not JSON at byte %td of %zu",
                 at->path, end - text, source->size);
  else if ((size_t)(end - text) + strspn(end, " \t\r\n") < source->size)
    status = fg__fail(at->context, FG_STATUS_FILE_FORMAT,
                      "%s: JSON ends at byte %td of %zu, then more follows", at->path,
                      end - text, source->size);
  free(text);
  return status;
}

fg_status fg__icon_list_read(fg__icon_list *out, fg_context *context,
                             const fg__source *source)
{
  *out = (fg__icon_list){0};
  reading at = {.context = context, .path = source->path, .feature = -1};
  cJSON *root = NULL;
  fg_status status = parse(&root, &at, source);
  if (status == FG_STATUS_OK)
    status = read_collection(out, &at, root);
  cJSON_Delete(root);
  return status;
}

void fg__icon_list_clear(fg__icon_list *list)
{
  for (size_t n = 0; n < list->count; ++n)
    free((void *)(uintptr_t)list->icon[n].points);
  free(list->icon);
  free(list->projection);
  *list = (fg__icon_list){0};
}
