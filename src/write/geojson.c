/* Icons as GeoJSON (RFC 7946): a LineString each, from tail to head. Coordinates are the
 * input's own, which the RFC wants to be longitude and latitude only. */
#include "file/number_text.h"
#include "file/whole_file.h"
#include "icon/icons.h"

#include <math.h>

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

static void write_position(FILE *stream, const double position[3], int dimension)
{
  for (int k = 0; k < dimension; ++k)
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

static void write_icon(FILE *stream, const fg_icon *icon, int dimension)
{
  fputs("{\"type\":\"Feature\",\"geometry\":{\"type\":\"LineString\",\"coordinates\":[",
        stream);
  for (int i = 0; i < icon->point_count; ++i) {
    if (i > 0)
      fputc(',', stream);
    write_position(stream, icon->points[i], dimension);
  }
  fprintf(stream, "]},\"properties\":{\"cluster\":%d,\"kind\":\"%s\"", icon->cluster,
          kind_name(icon->kind));
  write_number(stream, dimension == 3 ? ",\"volume\":" : ",\"area\":", icon->area);
  write_number(stream, ",\"speed\":", icon->speed);
  write_number(stream, ",\"width\":", icon->width);
  write_number(stream, ",\"tail_width\":", icon->tail_width);
  write_number(stream, ",\"head_length\":", icon->head_length);
  write_number(stream, ",\"head_width\":", icon->head_width);
  fputs(",\"center\":", stream);
  write_position(stream, icon->center, dimension);
  if (icon->id > 0)
    write_placement(stream, icon, dimension);
  fputs("}}", stream);
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
  fg_status status = fg__whole_file_open(&file, context, path);
  if (status == FG_STATUS_OK) {
    int dimension = is_flat(icons) ? 2 : 3;
    fprintf(file.stream,
            "{\"type\":\"FeatureCollection\",\"clusters\":%d,\"dropped\":%d,",
            fg_icons_clusters(icons), fg_icons_dropped(icons));
    if (fg__icons_next_id(icons) > 0)
      fprintf(file.stream, "\"next_id\":%d,", fg__icons_next_id(icons));
    if (fg_icons_kept_score(icons))
      write_error(file.stream, fg_icons_kept_score(icons));
    fputs("\"features\":[", file.stream);
    for (int n = 0; n < fg_icons_count(icons); ++n) {
      fputs(n > 0 ? ",\n" : "\n", file.stream);
      write_icon(file.stream, fg_icons_at(icons, n), dimension);
    }
    fputs("\n]}\n", file.stream);
    status = fg__whole_file_close(&file, context, status);
  }
  fg__number_locale_end(&locale);
  return status;
}
