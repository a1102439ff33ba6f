#include "write/vtp.h"

#include "base/memory.h"
#include "file/number_text.h"
#include "file/whole_file.h"
#include "picture/arrow_speeds.h"
#include "write/vti.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { KINDS = 3 }; /* verts, lines, polys: the order of cells in a file */

/* Cells of one kind. */
typedef struct cells {
  int *point, *end; /* points of all cells; where each cell's points end */
  int *cluster;
  unsigned char *part;
  double *speed, *volume;
  size_t points, count, point_capacity, capacity[5];
} cells;

typedef struct polydata {
  double (*point)[3];
  float *speed; /* [points] of the flow there */
  size_t points, capacity, speed_capacity;
  cells kind[KINDS];
} polydata;

/* False when there is no memory. */
static bool add_point(polydata *data, const double position[3], double speed)
{
  if (!fg__grow((void **)&data->point, &data->capacity, data->points + 1,
                sizeof *data->point) ||
      !fg__grow((void **)&data->speed, &data->speed_capacity, data->points + 1,
                sizeof *data->speed))
    return false;
  data->speed[data->points] = (float)speed;
  memcpy(data->point[data->points++], position, sizeof *data->point);
  return true;
}

static bool add_cell(cells *to, const int *point, int count, const fg_icon *icon,
                     fg__vtp_part part)
{
  size_t one = to->count + 1, all = to->points + (size_t)count;
  if (!fg__grow((void **)&to->point, &to->point_capacity, all, sizeof *to->point) ||
      !fg__grow((void **)&to->end, &to->capacity[0], one, sizeof *to->end) ||
      !fg__grow((void **)&to->cluster, &to->capacity[1], one, sizeof *to->cluster) ||
      !fg__grow((void **)&to->part, &to->capacity[2], one, 1) ||
      !fg__grow((void **)&to->speed, &to->capacity[3], one, sizeof *to->speed) ||
      !fg__grow((void **)&to->volume, &to->capacity[4], one, sizeof *to->volume))
    return false;
  memcpy(to->point + to->points, point, (size_t)count * sizeof *point);
  to->points = all;
  to->end[to->count] = (int)all;
  to->cluster[to->count] = icon->cluster;
  to->part[to->count] = (unsigned char)part;
  to->speed[to->count] = icon->speed;
  to->volume[to->count] = icon->area;
  to->count = one;
  return true;
}

/* A line of an icon, or of one point its centre. */
static fg_status add_line(polydata *data, fg_context *context, const fg_field *field,
                          const fg_icon *icon, const double (*line)[3], int count,
                          fg__vtp_part part)
{
  const int kind = part == FG__VTP_CENTER ? 0 : 1, first = (int)data->points;
  if (!line || count < 1 + kind)
    return FG_STATUS_OK;
  const fg_icon along = {.points = line, .point_count = count, .speed = icon->speed};
  double *speed;
  fg_status status = fg__arrow_speeds(&speed, context, field, &along);
  if (status)
    return status;
  int *point = fg__allocate((size_t)count, sizeof *point);
  bool room = point != NULL;
  for (int n = 0; n < count && room; ++n) {
    point[n] = first + n;
    room = add_point(data, line[n], speed[n]);
  }
  room = room && add_cell(&data->kind[kind], point, count, icon, part);
  free(point);
  free(speed);
  return room ? FG_STATUS_OK
              : fg__fail_memory(context, "icons to write", data->points * 24);
}

/* speed: of each vertex; NULL: 0. */
static bool add_surface(polydata *data, const fg_surface *solid, const float *speed,
                        const fg_icon *icon, fg__vtp_part part)
{
  int first = (int)data->points;
  bool room = true;
  for (int n = 0; n < solid->vertex_count && room; ++n)
    room = add_point(data, solid->vertex[n], speed ? (double)speed[n] : 0.0);
  for (int n = 0; n < solid->triangle_count && room; ++n) {
    int point[3];
    for (int k = 0; k < 3; ++k)
      point[k] = first + solid->corner[solid->triangle[n][k]];
    room = add_cell(&data->kind[2], point, 3, icon, part);
  }
  return room;
}

static fg_status add_solid(polydata *data, fg_context *context, const fg_field *field,
                           const fg_icon *icon)
{
  fg_surface *solid;
  float *speed;
  fg_status status = fg__arrow_solid(&solid, &speed, context, field, icon);
  if (status)
    return status;
  bool room = add_surface(data, solid, speed, icon, FG__VTP_ARROW);
  free(speed);
  fg_surface_destroy(solid);
  return room ? FG_STATUS_OK
              : fg__fail_memory(context, "icons to write", data->points * 24);
}

static fg_status add_icon(polydata *data, fg_context *context, const fg_field *field,
                          const fg_icon *icon)
{
  const struct {
    const double (*line)[3];
    int count;
    fg__vtp_part part;
  } lines[] = {{&icon->center, 1, FG__VTP_CENTER},
               {icon->spine, icon->spine_count, FG__VTP_SPINE},
               {icon->streamline, icon->streamline_count, FG__VTP_STREAMLINE}};
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < sizeof lines / sizeof *lines && !status; ++n)
    status = add_line(data, context, field, icon, lines[n].line, lines[n].count,
                      lines[n].part);
  return status ? status : add_solid(data, context, field, icon);
}

static void clear(polydata *data)
{
  for (int k = 0; k < KINDS; ++k) {
    free(data->kind[k].point);
    free(data->kind[k].end);
    free(data->kind[k].cluster);
    free(data->kind[k].part);
    free(data->kind[k].speed);
    free(data->kind[k].volume);
  }
  free(data->point);
  free(data->speed);
}

static fg_status write_array(FILE *stream, fg_context *context, const char *name,
                             const char *type, const void *values, size_t count,
                             size_t size, int components)
{
  return fg__vti_write_array(stream, context,
                             &(fg__vti_output){.name = name,
                                               .type = type,
                                               .data = values,
                                               .bytes = count * size,
                                               .components = components});
}

/* An array of all cells, put together from those of the kinds; `offset` is a thread of
 * cells. */
static fg_status write_of_cells(FILE *stream, fg_context *context, const polydata *data,
                                const char *name, const char *type, size_t offset,
                                size_t size)
{
  size_t count = 0, at = 0;
  for (int k = 0; k < KINDS; ++k)
    count += data->kind[k].count;
  unsigned char *all = fg__allocate(count, size);
  if (!all)
    return fg__fail_memory(context, "icons to write", count * size);
  for (int k = 0; k < KINDS; ++k) {
    const void *values;
    memcpy(&values, (const unsigned char *)&data->kind[k] + offset, sizeof values);
    if (data->kind[k].count)
      memcpy(all + at * size, values, data->kind[k].count * size);
    at += data->kind[k].count;
  }
  fg_status status = write_array(stream, context, name, type, all, count, size, 1);
  free(all);
  return status;
}

static fg_status write_cell_data(FILE *stream, fg_context *context, const polydata *data)
{
  static const struct {
    const char *name, *type;
    size_t offset, size;
  } arrays[] = {
      {"cluster", "Int32", offsetof(cells, cluster), sizeof(int)},
      {"part", "UInt8", offsetof(cells, part), 1},
      {"speed", "Float64", offsetof(cells, speed), sizeof(double)},
      {"volume", "Float64", offsetof(cells, volume), sizeof(double)},
  };
  fg_status status = FG_STATUS_OK;
  fputs("<CellData Scalars=\"speed\">\n", stream);
  for (size_t n = 0; n < sizeof arrays / sizeof *arrays && !status; ++n)
    status = write_of_cells(stream, context, data, arrays[n].name, arrays[n].type,
                            arrays[n].offset, arrays[n].size);
  fputs("</CellData>\n", stream);
  return status;
}

static fg_status write_polydata(FILE *stream, fg_context *context, const polydata *data)
{
  static const char *const tags[KINDS] = {"Verts", "Lines", "Polys"};
  fprintf(stream,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
          "byte_order=\"%s\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">"
          "\n<PolyData>\n<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" "
          "NumberOfLines=\"%zu\" NumberOfStrips=\"0\" NumberOfPolys=\"%zu\">\n",
          fg__vti_byte_order(), data->points, data->kind[0].count, data->kind[1].count,
          data->kind[2].count);
  fputs("<PointData Scalars=\"local_speed\">\n", stream);
  fg_status status = write_array(stream, context, "local_speed", "Float32", data->speed,
                                 data->points, sizeof(float), 1);
  fputs("</PointData>\n", stream);
  if (!status)
    status = write_cell_data(stream, context, data);
  fputs("<Points>\n", stream);
  if (!status)
    status = write_array(stream, context, "Points", "Float64", data->point,
                         3 * data->points, sizeof(double), 3);
  fputs("</Points>\n", stream);
  for (int k = 0; k < KINDS && !status; ++k) {
    const cells *kind = &data->kind[k];
    fprintf(stream, "<%s>\n", tags[k]);
    status = write_array(stream, context, "connectivity", "Int32", kind->point,
                         kind->points, sizeof(int), 1);
    if (!status)
      status = write_array(stream, context, "offsets", "Int32", kind->end, kind->count,
                           sizeof(int), 1);
    fprintf(stream, "</%s>\n", tags[k]);
  }
  fputs("</Piece>\n</PolyData>\n</VTKFile>\n", stream);
  return status;
}

fg_status fg__vtp_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_icons *icons, const fg_surface *surface)
{
  /* of all clusters, and of none: its numbers are 0 */
  static const fg_icon none = {0};
  polydata data = {0};
  fg__number_locale locale;
  fg__whole_file file;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg_icons_count(icons) && !status; ++n) {
    status = add_icon(&data, context, field, fg_icons_at(icons, n));
    if (!status && data.points > INT_MAX / 8)
      status = fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: too many points", path);
  }
  if (!status && surface && (size_t)surface->vertex_count + data.points > INT_MAX / 8)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: too many points", path);
  if (!status && surface && !add_surface(&data, surface, NULL, &none, FG__VTP_CLUSTER))
    status = fg__fail_memory(context, "clusters to write", data.points * 24);
  if (!status && !fg__number_locale_begin(&locale))
    status = fg__fail_memory(context, "a locale", sizeof locale);
  if (!status) {
    status = fg__whole_file_open(&file, context, path);
    if (!status) {
      status = write_polydata(file.stream, context, &data);
      status = fg__whole_file_close(&file, context, status);
    }
    fg__number_locale_end(&locale);
  }
  clear(&data);
  return status;
}
