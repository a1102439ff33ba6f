#include "write/vti.h"

#include "base/memory.h"
#include "base/utf8.h"
#include "file/base64.h"
#include "file/number_text.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

const char *fg__vti_byte_order(void)
{
  const uint16_t one = 1;
  return *(const unsigned char *)&one == 1 ? "LittleEndian" : "BigEndian";
}

/* Text as an attribute or an element holds it; what XML cannot hold becomes '?'. */
static void write_text(FILE *stream, const char *text)
{
  bool utf8 = fg__utf8_is_valid(text);
  for (; *text; ++text) {
    unsigned char c = (unsigned char)*text;
    if (c == '&')
      fputs("&amp;", stream);
    else if (c == '<')
      fputs("&lt;", stream);
    else if (c == '>')
      fputs("&gt;", stream);
    else if (c == '"')
      fputs("&quot;", stream);
    else
      fputc(c < 0x20 || c == 0x7f || (c >= 0x80 && !utf8) ? '?' : c, stream);
  }
}

static void write_attribute(FILE *stream, const char *name, const char *value)
{
  if (!value)
    return;
  fprintf(stream, " %s=\"", name);
  write_text(stream, value);
  fputc('"', stream);
}

static void write_triple(FILE *stream, const char *name, const double triple[3])
{
  char number[3][FG__NUMBER_BYTES];
  for (int k = 0; k < 3; ++k)
    fg__number_write(number[k], triple[k]);
  fprintf(stream, " %s=\"%s %s %s\"", name, number[0], number[1], number[2]);
}

static void write_number(FILE *stream, const char *name, const double *value)
{
  if (!value)
    return;
  char number[FG__NUMBER_BYTES];
  fg__number_write(number, *value);
  fprintf(stream,
          "<DataArray type=\"Float64\" Name=\"%s\" NumberOfTuples=\"1\" "
          "format=\"ascii\">\n%s\n</DataArray>\n",
          name, number);
}

/* Strings as VTK writes them in text: a number a byte, each ended by 0. */
static void write_strings(FILE *stream, const char *name, const char *const string[],
                          int count)
{
  if (!string[0] || !string[0][0])
    return;
  fprintf(stream,
          "<Array type=\"String\" Name=\"%s\" NumberOfTuples=\"%d\" "
          "format=\"ascii\">\n",
          name, count);
  for (int k = 0; k < count; ++k) {
    for (const char *c = string[k]; *c; ++c)
      fprintf(stream, "%d ", (unsigned char)*c);
    fputs("0 ", stream);
  }
  fputs("\n</Array>\n", stream);
}

static void write_field_words(FILE *stream, const fg_field_arrays *field)
{
  static const char *const scales[] = {"plain", "geo", "map", "plain"};
  write_strings(stream, "Scale", &scales[field->scale], 1);
  write_strings(stream, "AxisNames", field->axis_name, field->dimension);
  write_strings(stream, "AxisUnits", field->axis_units, field->dimension);
  write_strings(stream, "Projection", &field->projection, 1);
  write_strings(stream, "TimeWords", &field->time, 1);
  write_strings(stream, "LevelWords", &field->level, 1);
  if (field->period[0] > 0.0)
    write_number(stream, "AxisPeriod", &field->period[0]);
}

void fg__vti_write_open(FILE *stream, const fg__vti_image *image, const char *vectors,
                        const char *scalars)
{
  const bool flat = image->points[2] == 0;
  const int last[3] = {image->points[0] - 1, image->points[1] - 1,
                       flat ? 0 : image->points[2] - 1};
  fprintf(
      stream,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
      "byte_order=\"%s\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      "<ImageData WholeExtent=\"0 %d 0 %d 0 %d\"",
      fg__vti_byte_order(), last[0], last[1], last[2]);
  write_triple(stream, "Origin", image->origin);
  write_triple(stream, "Spacing",
               (const double[]){image->spacing[0], image->spacing[1],
                                flat ? 1.0 : image->spacing[2]});
  fputs(">\n", stream);
  if (image->time || image->least_area || image->field) {
    fputs("<FieldData>\n", stream);
    write_number(stream, "TimeValue", image->time);
    write_number(stream, "LeastClusterArea", image->least_area);
    if (image->field)
      write_field_words(stream, image->field);
    fputs("</FieldData>\n", stream);
  }
  fprintf(stream, "<Piece Extent=\"0 %d 0 %d 0 %d\">\n<PointData", last[0], last[1],
          last[2]);
  write_attribute(stream, "Vectors", vectors);
  write_attribute(stream, "Scalars", scalars);
  fputs(">\n", stream);
}

void fg__vti_write_cells(FILE *stream)
{
  fputs("</PointData>\n<CellData>\n", stream);
}

void fg__vti_write_close(FILE *stream)
{
  fputs("</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n", stream);
}

static void encode(fg__vti_text *text, size_t count)
{
  char encoded[FG__VTI_ENCODED / 3 * 4];
  fg__base64_encode(encoded, text->waiting, count);
  fwrite(encoded, 1, fg__base64_length(count), text->stream);
  text->count = 0;
}

void fg__vti_put(fg__vti_text *text, const unsigned char *bytes, size_t count)
{
  while (count > 0) {
    size_t room = FG__VTI_ENCODED - text->count, part = count < room ? count : room;
    memcpy(text->waiting + text->count, bytes, part);
    text->count += part;
    bytes += part;
    count -= part;
    if (text->count == FG__VTI_ENCODED)
      encode(text, text->count);
  }
}

void fg__vti_put_end(fg__vti_text *text)
{
  if (text->count > 0)
    encode(text, text->count);
}

fg_status fg__vti_pack(fg__vti_blocks *out, fg_context *context, const void *data,
                       size_t bytes)
{
  size_t blocks = (bytes + FG__VTI_BLOCK - 1) / FG__VTI_BLOCK;
  size_t bound = (size_t)compressBound(FG__VTI_BLOCK);
  *out = (fg__vti_blocks){.count = blocks,
                          .sizes = fg__allocate(blocks, sizeof *out->sizes),
                          .packed = fg__allocate(blocks, bound)};
  if (!out->sizes || !out->packed)
    return fg__fail_memory(context, "a compressed array", bytes);
  for (size_t block = 0, at = 0; at < bytes; at += FG__VTI_BLOCK, ++block) {
    size_t part = bytes - at < FG__VTI_BLOCK ? bytes - at : FG__VTI_BLOCK;
    uLongf size = (uLongf)(blocks * bound - out->used);
    if (compress(out->packed + out->used, &size, (const unsigned char *)data + at,
                 (uLong)part) != Z_OK)
      return fg__fail_memory(context, "compression", blocks * bound);
    out->sizes[block] = size;
    out->used += size;
  }
  return FG_STATUS_OK;
}

void fg__vti_blocks_clear(fg__vti_blocks *blocks)
{
  free(blocks->sizes);
  free(blocks->packed);
  *blocks = (fg__vti_blocks){0};
}

void fg__vti_begin_array(FILE *stream, const fg__vti_output *array, const uint64_t *sizes)
{
  uint64_t blocks = (array->bytes + FG__VTI_BLOCK - 1) / FG__VTI_BLOCK;
  const uint64_t header[] = {blocks, FG__VTI_BLOCK, array->bytes % FG__VTI_BLOCK};
  fprintf(stream, "<DataArray type=\"%s\"", array->type);
  write_attribute(stream, "Name", array->name);
  fprintf(stream, " NumberOfComponents=\"%d\" format=\"binary\">\n", array->components);
  fg__vti_text text = {.stream = stream};
  fg__vti_put(&text, (const unsigned char *)header, sizeof header);
  fg__vti_put(&text, (const unsigned char *)sizes, blocks * sizeof *sizes);
  fg__vti_put_end(&text);
}

void fg__vti_end_array(FILE *stream, const fg__vti_output *array)
{
  fputc('\n', stream);
  /* VTK looks for the data right behind the tag, so what else there is follows them */
  if (array->units && array->units[0]) {
    fputs("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">", stream);
    write_text(stream, array->units);
    fputs("</InformationKey>\n", stream);
  }
  fputs("</DataArray>\n", stream);
}

fg_status fg__vti_write_array(FILE *stream, fg_context *context,
                              const fg__vti_output *array)
{
  fg__vti_blocks blocks;
  fg_status status = fg__vti_pack(&blocks, context, array->data, array->bytes);
  if (status == FG_STATUS_OK) {
    fg__vti_text text = {.stream = stream};
    fg__vti_begin_array(stream, array, blocks.sizes);
    fg__vti_put(&text, blocks.packed, blocks.used);
    fg__vti_put_end(&text);
    fg__vti_end_array(stream, array);
  }
  fg__vti_blocks_clear(&blocks);
  return status;
}
