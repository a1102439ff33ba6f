/* Icons as GeoJSON (RFC 7946): a line each, from tail to head, in longitude and latitude
 * where they are of a map or in degrees; what they are in the plane is a property. Other
 * coordinates are the input's own. */
#include "file/number_text.h"
#include "file/whole_file.h"
#include "icon/icons.h"
#include "write/parts.h"

#include <math.h>
#include <string.h>

static const char *kind_name(fg_icon_kind kind)
{
  return kind == FG_ICON_RING ? "ring" : kind == FG_ICON_SPIRAL ? "spiral" : "arrow";
}

static bool all_finite(const fg_icon *icon)
{
  const double numbers[] = {icon->width,      icon->tail_width, icon->head_length,
                            icon->head_width, icon->center[0],  icon->center[1],
                            icon->center[2],  icon->area,       icon->speed};
  bool finite = true;
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
    finite = finite && isfinite(numbers[i]);
  for (int i = 0; i < icon->point_count; ++i)
    for (int k = 0; k < 3; ++k)
      finite = finite && isfinite(icon->points[i][k]);
  return finite;
}

static bool is_flat(const fg_icons *icons)
{
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 0; i < icon->point_count; ++i)
      if (icon->points[i][2] != 0.0)
        return false;
  }
  return true;
}

static void write_number(FILE *stream, const char *before, double number)
{
  char text[FG__NUMBER_BYTES];
  fg__number_write(text, number);
  fputs(before, stream);
  fputs(text, stream);
}

static void write_position(FILE *stream, const double *position, int dimension)
{
  for (int k = 0; k < 3 && k < dimension; ++k)
    write_number(stream, k == 0 ? "[" : ",", position[k]);
  fputc(']', stream);
}

static void write_reader(FILE *stream, const char *name, const fg_reader_error *reader)
{
  fprintf(stream, ",\"%s\":{", name);
  write_number(stream, "\"mean\":", reader->mean);
  write_number(stream, ",\"percentile_95\":", reader->percentile_95);
  write_number(stream, ",\"speed_weighted\":", reader->speed_weighted);
  fputc('}', stream);
}

/* The readers' errors in degrees. */
static void write_error(FILE *stream, const fg_score *score)
{
  write_number(stream, "\"error\":{\"mean\":", score->mean);
  write_number(stream, ",\"percentile_95\":", score->percentile_95);
  write_reader(stream, "diffusion", &score->diffusion);
  write_reader(stream, "nearest", &score->nearest);
  write_reader(stream, "inverse_distance", &score->inverse_distance);
  fputs("},", stream);
}

/* What a placed icon is in the chain of scales; `seed` and `way` are what a run goes on
 * from. */
static void write_placement(FILE *stream, const fg_icon *icon, int dimension)
{
  fprintf(stream, ",\"id\":%d", icon->id);
  if (icon->parent > 0)
    fprintf(stream, ",\"parent\":%d", icon->parent);
  fputs(",\"seed\":", stream);
  write_position(stream, icon->seed, dimension);
  write_number(stream, ",\"way\":[", icon->way[0]);
  write_number(stream, ",", icon->way[1]);
  fputc(']', stream);
}

/* What a file's icons have in common. */
typedef struct common {
  FILE *stream;
  fg_context *context;
  int dimension;
  bool on_globe; /* in degrees, or on a map's plane */
  fg__map *map;  /* NULL: none, or degrees */
  fg__line_parts lines;
} common;

static void write_points(FILE *stream, const fg_icon *icon, int dimension)
{
  for (int i = 0; i < icon->point_count; ++i) {
    if (i > 0)
      fputc(',', stream);
    write_position(stream, icon->points[i], dimension);
  }
}

/* A line in one part or several; null where it has no image. */
static void write_lines(FILE *stream, const fg__line_parts *lines)
{
  if (lines->parts == 0) {
    fputs("null", stream);
    return;
  }
  const bool one = lines->parts == 1;
  fprintf(stream, "{\"type\":\"%sLineString\",\"coordinates\":[", one ? "" : "Multi");
  for (int part = 0; part < lines->parts; ++part) {
    const int first = lines->first[part];
    const int end = part + 1 < lines->parts ? lines->first[part + 1] : lines->count;
    if (!one)
      fputs(part ? ",[" : "[", stream);
    for (int i = first; i < end; ++i) {
      const double at[3] = {lines->position[i][0], lines->position[i][1], 0.0};
      if (i > first)
        fputc(',', stream);
      write_position(stream, at, 2);
    }
    if (!one)
      fputc(']', stream);
  }
  fputs("]}", stream);
}

static fg_status write_geometry(common *all, const fg_icon *icon)
{
  fputs("{\"type\":\"Feature\",\"geometry\":", all->stream);
  if (all->on_globe) {
    fg_status status = fg__parts_find(&all->lines, all->context, all->map, icon->points,
                                      icon->point_count);
    if (status == FG_STATUS_OK)
      write_lines(all->stream, &all->lines);
    return status;
  }
  fputs("{\"type\":\"LineString\",\"coordinates\":[", all->stream);
  write_points(all->stream, icon, all->dimension);
  fputs("]}", all->stream);
  return FG_STATUS_OK;
}

/* Area on the plane over that on the globe; 1 up to differences of rounding is 1. */
static double area_scale(const common *all, const fg_icon *icon)
{
  double at[2];
  if (!all->map)
    return 1.0;
  fg__map_inverse(all->map, 1, &icon->center[0], &icon->center[1], &at[0], &at[1]);
  const double scale = fg__map_area_scale(all->map, at[0], at[1]);
  return isfinite(scale) && scale > 0.0 && fabs(scale - 1.0) > 1e-6 ? scale : 1.0;
}

static void write_area(const common *all, const fg_icon *icon)
{
  const double scale = area_scale(all, icon);
  write_number(all->stream,
               all->dimension == 3 ? ",\"volume\":" : ",\"area\":", icon->area / scale);
  if (scale < 1.0 || scale > 1.0)
    write_number(all->stream, ",\"plane_area\":", icon->area);
}

/* Its coordinates, and those of the plane that differ from the geometry's. */
static void write_place(const common *all, const fg_icon *icon)
{
  double center[3] = {icon->center[0], icon->center[1], icon->center[2]};
  if (all->on_globe)
    fg__parts_position(center, all->map, icon->center);
  const bool seen = isfinite(center[0]) && isfinite(center[1]);
  fputs(",\"center\":", all->stream);
  write_position(all->stream, seen ? center : icon->center, all->dimension);
  if (!all->on_globe || !all->lines.moved)
    return;
  fputs(",\"plane_center\":", all->stream);
  write_position(all->stream, icon->center, 2);
  fputs(",\"plane\":[", all->stream);
  write_points(all->stream, icon, 2);
  fputc(']', all->stream);
}

static fg_status write_icon(common *all, const fg_icon *icon)
{
  FILE *stream = all->stream;
  fg_status status = write_geometry(all, icon);
  if (status != FG_STATUS_OK)
    return status;
  fprintf(stream, ",\"properties\":{\"cluster\":%d,\"kind\":\"%s\"", icon->cluster,
          kind_name(icon->kind));
  write_area(all, icon);
  write_number(stream, ",\"speed\":", icon->speed);
  write_number(stream, ",\"width\":", icon->width);
  write_number(stream, ",\"tail_width\":", icon->tail_width);
  write_number(stream, ",\"head_length\":", icon->head_length);
  write_number(stream, ",\"head_width\":", icon->head_width);
  write_place(all, icon);
  if (icon->id > 0)
    write_placement(stream, icon, all->dimension);
  fputs("}}", stream);
  return FG_STATUS_OK;
}

static void write_critical(common *all, const fg_critical_point *point)
{
  static const char *const axis[] = {",\"outflow\":", ",\"inflow\":"};
  FILE *stream = all->stream;
  const double plane[3] = {point->at[0], point->at[1], 0.0};
  double at[3] = {plane[0], plane[1], 0.0};
  if (all->on_globe)
    fg__parts_position(at, all->map, plane);
  const bool seen = isfinite(at[0]) && isfinite(at[1]);
  fputs("{\"type\":\"Feature\",\"geometry\":{\"type\":\"Point\",\"coordinates\":",
        stream);
  write_position(stream, seen ? at : plane, 2);
  fprintf(stream, "},\"properties\":{\"kind\":\"%s\",\"index\":%d",
          fg_critical_kind_word(point->kind), point->index);
  if (point->sense)
    fprintf(stream, ",\"sense\":\"%sclockwise\"", point->sense > 0 ? "anti" : "");
  if (point->outward)
    fprintf(stream, ",\"flow\":\"%sward\"", point->outward > 0 ? "out" : "in");
  for (int k = 0; k < 2 && point->kind == FG_CRITICAL_SADDLE; ++k) {
    fputs(axis[k], stream);
    write_position(stream, point->axis[k], 2);
  }
  if (all->map) {
    fputs(",\"plane\":", stream);
    write_position(stream, plane, 2);
  }
  fputs("}}", stream);
}

/* A text of PROJ has no quotes, backslashes or control characters; others would not have
 * made a map. */
static void write_projection(FILE *stream, const char *projection)
{
  fputs("\"projection\":\"", stream);
  for (const char *c = projection; *c; ++c)
    if (*c != '"' && *c != '\\' && (unsigned char)*c >= ' ')
      fputc(*c, stream);
  fputs("\",", stream);
}

static fg_status write_collection(common *all, const fg_icons *icons)
{
  FILE *stream = all->stream;
  fg_status status = FG_STATUS_OK;
  fprintf(stream, "{\"type\":\"FeatureCollection\",\"clusters\":%d,\"dropped\":%d,",
          fg_icons_clusters(icons), fg_icons_dropped(icons));
  if (fg__icons_next_id(icons) > 0)
    fprintf(stream, "\"next_id\":%d,", fg__icons_next_id(icons));
  if (all->on_globe)
    write_projection(stream, fg_icons_projection(icons));
  if (fg_icons_kept_score(icons))
    write_error(stream, fg_icons_kept_score(icons));
  fputs("\"features\":[", stream);
  for (int n = 0; n < fg_icons_count(icons) && status == FG_STATUS_OK; ++n) {
    fputs(n > 0 ? ",\n" : "\n", stream);
    status = write_icon(all, fg_icons_at(icons, n));
  }
  const fg_critical_points *points = fg_icons_kept_critical(icons);
  for (int n = 0; n < fg_critical_points_count(points); ++n) {
    fputs(n > 0 || fg_icons_count(icons) > 0 ? ",\n" : "\n", stream);
    write_critical(all, fg_critical_points_at(points, n));
  }
  fputs("\n]}\n", stream);
  return status;
}

/* Without PROJ a map's icons are written like those of any plane. */
static fg_status find_map(common *all, const fg_icons *icons)
{
  const char *projection = fg_icons_projection(icons);
  all->dimension = is_flat(icons) ? 2 : 3;
  if (!projection || all->dimension == 3)
    return FG_STATUS_OK;
  const bool degrees = strcmp(projection, FG__DEGREES) == 0;
  all->on_globe = degrees || fg_has_feature(FG_FEATURE_MAPS);
  return degrees || !all->on_globe ? FG_STATUS_OK
                                   : fg__map_create(&all->map, all->context, projection);
}

fg_status fg_icons_write(fg_context *context, const char *path, const fg_icons *icons)
{
  if (!path || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "icons: %s to write",
                    path ? "none" : "no file name");
  for (int n = 0; n < fg_icons_count(icons); ++n)
    if (!all_finite(fg_icons_at(icons, n)))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "%s: icon %d of %d holds a number that is not finite", path, n,
                      fg_icons_count(icons));
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(context, "a locale", sizeof locale);
  fg__whole_file file;
  common all = {.context = context};
  fg_status status = find_map(&all, icons);
  if (status == FG_STATUS_OK)
    status = fg__whole_file_open(&file, context, path);
  if (status == FG_STATUS_OK) {
    all.stream = file.stream;
    status = fg__whole_file_close(&file, context, write_collection(&all, icons));
  }
  fg__parts_clear(&all.lines);
  fg__map_destroy(all.map);
  fg__number_locale_end(&locale);
  return status;
}
