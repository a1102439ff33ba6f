#include "format/vti_write.h"

#include "base/memory.h"
#include "format/base64.h"
#include "format/number_text.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/xmlstring.h>
#include <zlib.h>

enum {
  BLOCK_BYTES = 32768,  /* VTK's own default */
  HEADER_NUMBERS = 3,   /* blocks, bytes of a block, bytes of the last */
  ENCODED_BYTES = 12288 /* encoded in one go: a multiple of 3, so that no padding is put
                           between */
};

static const char *byte_order(void)
{
  const uint16_t one = 1;
  return *(const unsigned char *)&one == 1 ? "LittleEndian" : "BigEndian";
}

/* Text as an attribute or an element holds it; what XML cannot hold becomes '?'. */
static void write_text(FILE *stream, const char *text)
{
  bool utf8 = xmlCheckUTF8((const unsigned char *)text) != 0;
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
      byte_order(), last[0], last[1], last[2]);
  write_triple(stream, "Origin", image->origin);
  write_triple(stream, "Spacing",
               (const double[]){image->spacing[0], image->spacing[1],
                                flat ? 1.0 : image->spacing[2]});
  fputs(">\n", stream);
  if (image->time) {
    char number[FG__NUMBER_BYTES];
    fg__number_write(number, *image->time);
    fprintf(stream,
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
            "NumberOfTuples=\"1\" format=\"ascii\">\n%s\n</DataArray>\n</FieldData>\n",
            number);
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

static void write_base64(FILE *stream, const unsigned char *bytes, size_t count)
{
  char text[ENCODED_BYTES / 3 * 4];
  for (size_t at = 0; at < count; at += ENCODED_BYTES) {
    size_t part = count - at < ENCODED_BYTES ? count - at : ENCODED_BYTES;
    fg__base64_encode(text, bytes + at, part);
    fwrite(text, 1, fg__base64_length(part), stream);
  }
}

/* Deflates block by block; sizes[i] becomes what block i takes, *used what all do. */
static fg_status deflate_blocks(unsigned char *packed, size_t capacity, uint64_t *sizes,
                                size_t *used, fg_context *context,
                                const fg__vti_output *array)
{
  *used = 0;
  size_t block = 0;
  for (size_t at = 0; at < array->bytes; at += BLOCK_BYTES, ++block) {
    size_t part = array->bytes - at < BLOCK_BYTES ? array->bytes - at : BLOCK_BYTES;
    uLongf size = (uLongf)(capacity - *used);
    if (compress(packed + *used, &size, (const unsigned char *)array->data + at,
                 (uLong)part) != Z_OK)
      return fg__fail_memory(context, "compression", capacity);
    sizes[block] = size;
    *used += size;
  }
  return FG_STATUS_OK;
}

fg_status fg__vti_write_array(FILE *stream, fg_context *context,
                              const fg__vti_output *array)
{
  size_t blocks = (array->bytes + BLOCK_BYTES - 1) / BLOCK_BYTES, used = 0;
  size_t bound = (size_t)compressBound(BLOCK_BYTES);
  uint64_t *header = fg__allocate(HEADER_NUMBERS + blocks, sizeof *header);
  unsigned char *packed = fg__allocate(blocks, bound);
  fg_status status;
  if (!header || !packed) {
    status = fg__fail_memory(context, "a compressed array", array->bytes);
    goto cleanup;
  }
  header[0] = blocks;
  header[1] = BLOCK_BYTES;
  header[2] = array->bytes % BLOCK_BYTES;
  status = deflate_blocks(packed, blocks * bound, header + HEADER_NUMBERS, &used, context,
                          array);
  if (status != FG_STATUS_OK)
    goto cleanup;
  fprintf(stream, "<DataArray type=\"%s\"", array->type);
  write_attribute(stream, "Name", array->name);
  fprintf(stream, " NumberOfComponents=\"%d\" format=\"binary\">\n", array->components);
  write_base64(stream, (const unsigned char *)header,
               (HEADER_NUMBERS + blocks) * sizeof *header);
  write_base64(stream, packed, used);
  fputc('\n', stream);
  /* VTK looks for the data right behind the tag, so what else there is follows them */
  if (array->units && array->units[0]) {
    fputs("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">", stream);
    write_text(stream, array->units);
    fputs("</InformationKey>\n", stream);
  }
  fputs("</DataArray>\n", stream);

cleanup:
  free(packed);
  free(header);
  return status;
}
