/* glTF 2.0 (ISO/IEC 12113), its binary container: a chunk of JSON and one of numbers.
 * The numbers are all places, then all indices, all normals and all colours; a mesh is a
 * stretch of each. */
#include "write/glb.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "file/number_text.h"
#include "file/whole_file.h"
#include "write/glb_model.h"

enum { FLOAT = 5126, UNSIGNED_INT = 5125, VERTICES = 34962, INDICES = 34963 };
enum { VIEW_PLACES, VIEW_INDICES, VIEW_NORMALS, VIEW_COLORS };

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
static void put_nodes(const fg__glb_model *m, FILE *out)
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
    const fg__glb_part *p = &m->part[n];
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

static void put_meshes(const fg__glb_model *m, FILE *out)
{
  fputs(",\n\"meshes\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const fg__glb_part *p = &m->part[n];
    fprintf(out, "%s\n{\"primitives\":[{\"attributes\":{\"POSITION\":%d", n ? "," : "",
            p->accessor);
    if (p->mode == FG__GLB_TRIANGLES)
      fprintf(out, ",\"NORMAL\":%d", p->accessor + 2);
    if (p->colored)
      fprintf(out, ",\"COLOR_0\":%d", p->accessor + 3);
    fprintf(out, "},\"indices\":%d,\"mode\":%d,\"material\":%zu}]}", p->accessor + 1,
            p->mode, n);
  }
  fputc(']', out);
}

static void put_places(FILE *out, const fg__glb_part *p)
{
  fprintf(out,
          "{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
          "\"type\":\"VEC3\"",
          VIEW_PLACES, 12 * p->first, FLOAT, p->count);
  put_triple(out, ",\"min\":[", p->low);
  put_triple(out, ",\"max\":[", p->high);
  fputc('}', out);
}

/* Of normals and colours, of which a part has as many as places. */
static void put_triples(FILE *out, int view, size_t first, size_t count)
{
  fprintf(out,
          ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
          "\"type\":\"VEC3\"}",
          view, 12 * first, FLOAT, count);
}

static void put_accessors(const fg__glb_model *m, FILE *out)
{
  fputs(",\n\"accessors\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const fg__glb_part *p = &m->part[n];
    fputs(n ? ",\n" : "\n", out);
    put_places(out, p);
    fprintf(out,
            ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,"
            "\"type\":\"SCALAR\"}",
            VIEW_INDICES, 4 * p->first_index, UNSIGNED_INT, p->index_count);
    if (p->mode == FG__GLB_TRIANGLES)
      put_triples(out, VIEW_NORMALS, p->first_normal, p->count);
    if (p->colored)
      put_triples(out, VIEW_COLORS, p->first_color, p->count);
  }
  fputc(']', out);
}

static void put_materials(const fg__glb_model *m, FILE *out)
{
  fputs(",\n\"materials\":[", out);
  for (size_t n = 0; n < m->parts; ++n) {
    const double *color = m->part[n].color;
    put_number(out,
               n ? ",\n{\"pbrMetallicRoughness\":{\"baseColorFactor\":["
                 : "\n{\"pbrMetallicRoughness\":{\"baseColorFactor\":[",
               color[0]);
    put_number(out, ",", color[1]);
    put_number(out, ",", color[2]);
    put_number(out, ",", m->part[n].opacity);
    fputs("],\"metallicFactor\":0,\"roughnessFactor\":0.6}", out);
    if (m->part[n].opacity < 1.0)
      fputs(",\"alphaMode\":\"BLEND\",\"doubleSided\":true", out);
    fputc('}', out);
  }
  fputc(']', out);
}

/* Of triples, if there are any. */
static void put_view(FILE *out, size_t offset, size_t bytes)
{
  if (bytes)
    fprintf(out,
            ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":12,"
            "\"target\":%d}",
            offset, bytes, VERTICES);
}

static void put_buffer(const fg__glb_model *m, FILE *out)
{
  size_t places = 12 * m->places, normals = 12 * m->normals, indices = 4 * m->indices;
  fprintf(out, ",\n\"buffers\":[{\"byteLength\":%zu}],\n\"bufferViews\":[",
          fg__glb_bytes(m));
  fprintf(out,
          "{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":12,\"target\":%d},"
          "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":%d}",
          places, VERTICES, places, indices, INDICES);
  put_view(out, places + indices, normals);
  put_view(out, places + indices + normals, 12 * m->colors);
  fputc(']', out);
}

static void put_json(const fg__glb_model *m, FILE *out)
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

static void put_file(FILE *out, const fg__glb_model *m, const char *json, size_t length)
{
  enum { MAGIC = 0x46546C67, JSON = 0x4E4F534A, BINARY = 0x004E4942 };
  size_t padded = (length + 3) / 4 * 4;
  size_t numbers = fg__glb_bytes(m);
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
  put_words(out, m->color, 3 * m->colors);
}

static fg_status make_json(char **json, size_t *length, fg_context *context,
                           const fg__glb_model *m)
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

fg_status fg__glb_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_icons *icons, const fg_solid_options *options)
{
  fg__glb_model m = {.places = 0};
  char *json = NULL;
  size_t length = 0;
  fg__whole_file file;
  fg_status status = fg__glb_collect(&m, context, field, icons, options);
  if (!status)
    status = make_json(&json, &length, context, &m);
  if (!status)
    status = fg__whole_file_open(&file, context, path);
  if (!status) {
    put_file(file.stream, &m, json, length);
    status = fg__whole_file_close(&file, context, status);
  }
  free(json);
  fg__glb_clear(&m);
  return status;
}
