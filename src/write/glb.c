/* glTF 2.0 (ISO/IEC 12113), its binary container: a chunk of JSON and one of numbers.
 * The numbers are all places, then all normals, then all indices; a mesh is a stretch of
 * each. */
#include "write/glb.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "file/number_text.h"
#include "file/whole_file.h"
#include "picture/caption.h"
#include "picture/palette.h"

enum { POINTS = 0, LINES = 1, TRIANGLES = 4 };
enum { FLOAT = 5126, UNSIGNED_INT = 5125, VERTICES = 34962, INDICES = 34963 };
enum { VIEW_PLACES, VIEW_INDICES, VIEW_NORMALS };

/* What becomes a mesh, and a node. */
typedef struct part {
  const char *name;    /* NULL: of an arrow */
  const fg_icon *icon; /* of an arrow */
  int mode;
  fg__color color;
  double opacity;
  size_t first, count;             /* places */
  size_t first_normal;             /* of triangles, as many as places */
  size_t first_index, index_count; /* indices count from `first` */
  float low[3], high[3];
  int accessor; /* the first of its own: places, indices, and of triangles normals */
} part;

typedef struct model {
  double center[3];
  float (*place)[3], (*normal)[3];
  uint32_t *index;
  part *part; /* those that hold something */
  size_t places, normals, indices, parts;
  size_t place_capacity, normal_capacity, index_capacity, part_capacity;
} model;

/* NULL when there is no memory. */
static part *begin_part(model *m, const char *name, int mode, fg__color color)
{
  if (!fg__grow((void **)&m->part, &m->part_capacity, m->parts + 1, sizeof *m->part))
    return NULL;
  part *out = &m->part[m->parts++];
  *out = (part){.name = name,
                .mode = mode,
                .color = color,
                .opacity = 1.0,
                .first = m->places,
                .first_normal = m->normals,
                .first_index = m->indices,
                .low = {FLT_MAX, FLT_MAX, FLT_MAX},
                .high = {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
  return out;
}

static void end_part(model *m)
{
  part *ended = &m->part[m->parts - 1];
  if (ended->index_count == 0)
    m->parts--;
  else if (m->parts > 1)
    ended->accessor = ended[-1].accessor + (ended[-1].mode == TRIANGLES ? 3 : 2);
}

/* Both are false when there is no memory. */
static bool add_place(model *m, part *to, const double position[3])
{
  if (!fg__grow((void **)&m->place, &m->place_capacity, m->places + 1, sizeof *m->place))
    return false;
  float *place = m->place[m->places++];
  for (int k = 0; k < 3; ++k) {
    place[k] = (float)(position[k] - m->center[k]);
    to->low[k] = fminf(to->low[k], place[k]);
    to->high[k] = fmaxf(to->high[k], place[k]);
  }
  to->count++;
  return true;
}

static bool add_index(model *m, part *to, size_t index)
{
  if (!fg__grow((void **)&m->index, &m->index_capacity, m->indices + 1, sizeof *m->index))
    return false;
  m->index[m->indices++] = (uint32_t)index;
  to->index_count++;
  return true;
}

static bool add_surface(model *m, part *to, const fg_surface *s)
{
  bool room = fg__grow((void **)&m->normal, &m->normal_capacity,
                       m->normals + (size_t)s->corner_count, sizeof *m->normal);
  for (int n = 0; n < s->corner_count && room; ++n) {
    memcpy(m->normal[m->normals++], s->normal[n], sizeof *m->normal);
    room = add_place(m, to, s->vertex[s->corner[n]]);
  }
  for (int n = 0; n < s->triangle_count && room; ++n)
    for (int k = 0; k < 3 && room; ++k)
      room = add_index(m, to, (size_t)s->triangle[n][k]);
  return room;
}

static bool add_line(model *m, part *to, const double (*line)[3], int count)
{
  bool room = true;
  for (int n = 0; n < count && line && room; ++n) {
    room = add_place(m, to, line[n]);
    if (n > 0)
      room = room && add_index(m, to, to->count - 2) && add_index(m, to, to->count - 1);
  }
  return room;
}

typedef enum line_kind { SPINES, STREAMLINES, CENTERS, LINE_KINDS } line_kind;

static bool add_lines(model *m, const fg_icons *icons, line_kind kind)
{
  static const char *const names[] = {"spines", "streamlines", "centres"};
  static const fg__color colors[] = {
      {0.45, 0.45, 0.45}, {0.62, 0.62, 0.62}, {0.2, 0.2, 0.2}};
  part *to = begin_part(m, names[kind], kind == CENTERS ? POINTS : LINES, colors[kind]);
  bool room = to != NULL;
  for (int n = 0; n < fg_icons_count(icons) && room; ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    if (kind == SPINES)
      room = add_line(m, to, icon->spine, icon->spine_count);
    else if (kind == STREAMLINES)
      room = add_line(m, to, icon->streamline, icon->streamline_count);
    else
      room = add_place(m, to, icon->center) && add_index(m, to, to->count - 1);
  }
  if (room)
    end_part(m);
  return room;
}

/* Numbers of single precision are finest near 0: that is the middle of the icons. */
static void find_center(model *m, const fg_icons *icons)
{
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < fg_icons_count(icons); ++n)
    for (int k = 0; k < 3; ++k) {
      low[k] = fmin(low[k], fg_icons_at(icons, n)->center[k]);
      high[k] = fmax(high[k], fg_icons_at(icons, n)->center[k]);
    }
  for (int k = 0; k < 3; ++k)
    m->center[k] = high[k] >= low[k] ? (low[k] + high[k]) / 2.0 : 0.0;
}

static fg_status add_arrows(model *m, fg_context *context, const fg_icons *icons,
                            const fg__palette *palette, const double range[2])
{
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    fg_surface *solid;
    fg_status status = fg_icon_solid(&solid, context, icon);
    if (status)
      return status;
    double share = (icon->speed - range[0]) / (range[1] - range[0]);
    part *to = begin_part(m, NULL, TRIANGLES, fg__palette_color(palette, share));
    bool room = to && add_surface(m, to, solid);
    fg_surface_destroy(solid);
    if (!room)
      return fg__fail_memory(context, "icons to write", m->places * sizeof *m->place);
    to->icon = icon;
    end_part(m);
  }
  return FG_STATUS_OK;
}

/* All clusters' surfaces in one mesh, in the colour that they have in pictures. */
static fg_status add_clusters(model *m, fg_context *context, const fg_surface *surface)
{
  static const fg__color color = {0.36, 0.52, 0.72};
  part *to = begin_part(m, "clusters", TRIANGLES, color);
  if (!to || !add_surface(m, to, surface))
    return fg__fail_memory(context, "clusters to write", m->places * sizeof *m->place);
  to->opacity = 0.25;
  end_part(m);
  return FG_STATUS_OK;
}

static fg_status collect(model *m, fg_context *context, const fg_icons *icons,
                         const fg_solid_options *options)
{
  double range[2] = {options->speed_min, options->speed_max};
  fg__palette palette;
  fg_status status = fg__palette_create(&palette, context, options->palette);
  if (status)
    return status;
  fg__speed_range(range, icons);
  find_center(m, icons);
  bool room = true;
  for (int kind = 0; kind < LINE_KINDS && room; ++kind)
    room = add_lines(m, icons, (line_kind)kind);
  if (!room)
    return fg__fail_memory(context, "icons to write", m->places * sizeof *m->place);
  status = add_arrows(m, context, icons, &palette, range);
  if (!status && options->surface)
    status = add_clusters(m, context, options->surface);
  /* chunks have 32 bits for their length */
  size_t bytes = (m->places + m->normals) * sizeof *m->place + m->indices * 4;
  if (!status && bytes > UINT32_MAX / 2)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "glTF: %zu bytes of geometry, more than a file can hold", bytes);
  return status;
}

static void put_number(FILE *out, const char *before, double number)
{
  char text[FG__NUMBER_BYTES];
  fg__number_write(text, number);
  fprintf(out, "%s%s", before, text);
}

static void put_triple(FILE *out, const char *before, const float triple[3])
{
  for (int k = 0; k < 3; ++k)
    put_number(out, k ? "," : before, (double)triple[k]);
  fputc(']', out);
}

/* Node 0 has all others as its children, and turns z up, where glTF has y. */
static void put_nodes(const model *m, FILE *out)
{
  put_number(out, "\"nodes\":[{\"name\":\"flowgrain\",\"rotation\":[", -sqrt(0.5));
  put_number(out, ",0,0,", sqrt(0.5));
  put_number(out, "],\"translation\":[", m->center[0]);
  put_number(out, ",", m->center[2]);
  put_number(out, ",", -m->center[1]);
  fputs(m->parts ? "],\"children\":[" : "]", out);
  for (size_t n = 0; n < m->parts; ++n)
    fprintf(out, "%s%zu", n ? "," : "", n + 1);
  fputs(m->parts ? "]}" : "}", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const part *p = &m->part[n];
    if (p->name) {
      fprintf(out, ",\n{\"name\":\"%s\",\"mesh\":%zu}", p->name, n);
      continue;
    }
    fprintf(out, ",\n{\"name\":\"cluster %d\",\"mesh\":%zu,\"extras\":{\"cluster\":%d",
            p->icon->cluster, n, p->icon->cluster);
    put_number(out, ",\"volume\":", p->icon->area);
    put_number(out, ",\"speed\":", p->icon->speed);
    fputs("}}", out);
  }
  fputc(']', out);
}

static void put_meshes(const model *m, FILE *out)
{
  fputs(",\n\"meshes\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const part *p = &m->part[n];
    fprintf(out, "%s\n{\"primitives\":[{\"attributes\":{\"POSITION\":%d", n ? "," : "",
            p->accessor);
    if (p->mode == TRIANGLES)
      fprintf(out, ",\"NORMAL\":%d", p->accessor + 2);
    fprintf(out, "},\"indices\":%d,\"mode\":%d,\"material\":%zu}]}", p->accessor + 1,
            p->mode, n);
  }
  fputc(']', out);
}

static void put_places(FILE *out, const part *p)
{
  fprintf(out,
          "{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
          "\"type\":\"VEC3\"",
          VIEW_PLACES, 12 * p->first, FLOAT, p->count);
  put_triple(out, ",\"min\":[", p->low);
  put_triple(out, ",\"max\":[", p->high);
  fputc('}', out);
}

static void put_accessors(const model *m, FILE *out)
{
  fputs(",\n\"accessors\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const part *p = &m->part[n];
    fputs(n ? ",\n" : "\n", out);
    put_places(out, p);
    fprintf(out,
            ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
            "\"type\":\"SCALAR\"}",
            VIEW_INDICES, 4 * p->first_index, UNSIGNED_INT, p->index_count);
    if (p->mode == TRIANGLES)
      fprintf(out,
              ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
              "\"type\":\"VEC3\"}",
              VIEW_NORMALS, 12 * p->first_normal, FLOAT, p->count);
  }
  fputc(']', out);
}

/* sRGB to linear light (IEC 61966-2-1). */
static double linear(double level)
{
  return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

static void put_materials(const model *m, FILE *out)
{
  fputs(",\n\"materials\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    fg__color color = m->part[n].color;
    put_number(out,
               n ? ",\n{\"pbrMetallicRoughness\":{\"baseColorFactor\":["
                 : "\n{\"pbrMetallicRoughness\":{\"baseColorFactor\":[",
               linear(color.red));
    put_number(out, ",", linear(color.green));
    put_number(out, ",", linear(color.blue));
    put_number(out, ",", m->part[n].opacity);
    fputs("],\"metallicFactor\":0,\"roughnessFactor\":0.6}", out);
    if (m->part[n].opacity < 1.0)
      fputs(",\"alphaMode\":\"BLEND\",\"doubleSided\":true", out);
    fputc('}', out);
  }
  fputc(']', out);
}

static void put_buffer(const model *m, FILE *out)
{
  size_t places = 12 * m->places, normals = 12 * m->normals, indices = 4 * m->indices;
  fprintf(out, ",\n\"buffers\":[{\"byteLength\":%zu}],\n\"bufferViews\":[",
          places + normals + indices);
  fprintf(out,
          "{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":12,\"target\":%d},"
          "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":%d}",
          places, VERTICES, places, indices, INDICES);
  if (normals)
    fprintf(out,
            ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":12,"
            "\"target\":%d}",
            places + indices, normals, VERTICES);
  fputc(']', out);
}

static void put_json(const model *m, FILE *out)
{
  fprintf(out,
          "{\"asset\":{\"version\":\"2.0\",\"generator\":\"flowgrain %s\"},\"scene\":0,"
          "\"scenes\":[{\"nodes\":[0]}],\n",
          fg_version());
  put_nodes(m, out);
  if (m->parts) {
    put_meshes(m, out);
    put_accessors(m, out);
    put_materials(m, out);
    put_buffer(m, out);
  }
  fputc('}', out);
}

/* Words and floats are little endian in the file. */
static void put_words(FILE *out, const void *words, size_t count)
{
  const unsigned char *bytes = words;
  for (size_t n = 0; n < count; ++n) {
    uint32_t word;
    memcpy(&word, bytes + 4 * n, sizeof word);
    const unsigned char little[4] = {(unsigned char)word, (unsigned char)(word >> 8),
                                     (unsigned char)(word >> 16),
                                     (unsigned char)(word >> 24)};
    fwrite(little, 1, sizeof little, out);
  }
}

static void put_word(FILE *out, size_t word)
{
  uint32_t value = (uint32_t)word;
  put_words(out, &value, 1);
}

static void put_file(FILE *out, const model *m, const char *json, size_t length)
{
  enum { MAGIC = 0x46546C67, JSON = 0x4E4F534A, BINARY = 0x004E4942 };
  size_t padded = (length + 3) / 4 * 4;
  size_t numbers = 12 * (m->places + m->normals) + 4 * m->indices;
  put_word(out, MAGIC);
  put_word(out, 2);
  put_word(out, 12 + 8 + padded + (numbers ? 8 + numbers : 0));
  put_word(out, padded);
  put_word(out, JSON);
  fwrite(json, 1, length, out);
  for (size_t n = length; n < padded; ++n)
    fputc(' ', out);
  if (!numbers)
    return;
  put_word(out, numbers);
  put_word(out, BINARY);
  put_words(out, m->place, 3 * m->places);
  put_words(out, m->index, m->indices);
  put_words(out, m->normal, 3 * m->normals);
}

static fg_status make_json(char **json, size_t *length, fg_context *context,
                           const model *m)
{
  fg__number_locale locale;
  FILE *stream = open_memstream(json, length);
  bool made = stream && fg__number_locale_begin(&locale);
  if (made) {
    put_json(m, stream);
    fg__number_locale_end(&locale);
    made = !ferror(stream);
  }
  if (stream)
    made = fclose(stream) == 0 && made;
  return made ? FG_STATUS_OK : fg__fail_memory(context, "a file's text", *length);
}

fg_status fg__glb_write(fg_context *context, const char *path, const fg_icons *icons,
                        const fg_solid_options *options)
{
  model m = {.places = 0};
  char *json = NULL;
  size_t length = 0;
  fg__whole_file file;
  fg_status status = collect(&m, context, icons, options);
  if (!status)
    status = make_json(&json, &length, context, &m);
  if (!status)
    status = fg__whole_file_open(&file, context, path);
  if (!status) {
    put_file(file.stream, &m, json, length);
    status = fg__whole_file_close(&file, context, status);
  }
  free(json);
  free(m.place);
  free(m.normal);
  free(m.index);
  free(m.part);
  return status;
}
