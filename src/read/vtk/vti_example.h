/* Small image files for the tests, in every encoding that VTK writes. */
#ifndef FG__VTI_EXAMPLE_H
#define FG__VTI_EXAMPLE_H

#include "base/context_test.h"
#include "file/base64.h"
#include "read/format.h"
#include "read/slabs_alike_test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lz4.h>
#include <zlib.h>

typedef struct example_text {
  unsigned char *bytes;
  size_t size, capacity;
} example_text;

static inline void example_bytes(example_text *text, const void *bytes, size_t size)
{
  while (text->size + size > text->capacity) {
    text->capacity = 2 * text->capacity + 4096;
    text->bytes = realloc(text->bytes, text->capacity);
    if (!text->bytes)
      abort();
  }
  if (size > 0)
    memcpy(text->bytes + text->size, bytes, size);
  text->size += size;
}

static inline void example_words(example_text *text, const char *words)
{
  example_bytes(text, words, strlen(words));
}

static inline void example_free(example_text *text)
{
  free(text->bytes);
  *text = (example_text){0};
}

typedef enum example_storage {
  EXAMPLE_ASCII,
  EXAMPLE_INLINE,
  EXAMPLE_APPENDED_BASE64,
  EXAMPLE_APPENDED_RAW,
  EXAMPLE_STORAGES
} example_storage;

static const char *const EXAMPLE_TYPES[] = {"Int8",    "UInt8",  "Int16", "UInt16",
                                            "Int32",   "UInt32", "Int64", "UInt64",
                                            "Float32", "Float64"};
enum { EXAMPLE_TYPE_COUNT = 10, EXAMPLE_FLOAT64 = 9 };

typedef struct example_encoding {
  example_storage storage;
  bool zlib, lz4; /* one of them */
  size_t block;   /* bytes of a compressed block */
  bool wide;      /* UInt64 headers */
  bool big;       /* big-endian */
  int type;       /* index into EXAMPLE_TYPES */
} example_encoding;

/* A number of type `type`, in the wanted byte order; returns its size. */
static inline size_t example_number(unsigned char out[8], double number, int type,
                                    bool big)
{
  uint64_t whole = number < 0 ? (uint64_t)(int64_t)number : (uint64_t)number;
  size_t size = (size_t)1 << (type / 2);
  if (type == EXAMPLE_FLOAT64 - 1) {
    float narrow = (float)number;
    uint32_t bits;
    memcpy(&bits, &narrow, size = sizeof narrow);
    whole = bits;
  } else if (type == EXAMPLE_FLOAT64) {
    memcpy(&whole, &number, size = sizeof number);
  }
  for (size_t i = 0; i < size; ++i)
    out[big ? size - 1 - i : i] = (unsigned char)(whole >> (8 * i));
  return size;
}

static inline void example_header(example_text *out, const example_encoding *encoding,
                                  uint64_t number)
{
  size_t size = encoding->wide ? 8 : 4;
  unsigned char bytes[8];
  for (size_t i = 0; i < size; ++i)
    bytes[encoding->big ? size - 1 - i : i] = (unsigned char)(number >> (8 * i));
  example_bytes(out, bytes, size);
}

static inline void example_base64(example_text *out, const example_text *bytes)
{
  size_t length = fg__base64_length(bytes->size);
  char *text = malloc(length + 1);
  if (!text)
    abort();
  fg__base64_encode(text, bytes->bytes, bytes->size);
  example_bytes(out, text, length);
  free(text);
}

static inline void example_put(example_text *out, const example_encoding *encoding,
                               const example_text *part)
{
  if (encoding->storage == EXAMPLE_APPENDED_RAW)
    example_bytes(out, part->bytes, part->size);
  else
    example_base64(out, part);
}

static inline void example_packed(example_text *out, example_text *header,
                                  const example_encoding *encoding,
                                  const unsigned char *bytes, size_t size)
{
  uLongf most = compressBound((uLong)size) + (uLongf)LZ4_COMPRESSBOUND((int)size);
  unsigned char *packed = malloc(most);
  if (!packed)
    abort();
  if (encoding->lz4)
    most = (uLongf)LZ4_compress_default((const char *)bytes, (char *)packed, (int)size,
                                        (int)most);
  else if (compress(packed, &most, bytes, (uLong)size) != Z_OK)
    abort();
  example_header(header, encoding, most);
  example_bytes(out, packed, most);
  free(packed);
}

/* Header and data as VTK has them: plain, both encoded as one; in blocks, each by itself.
 */
static inline void example_binary(example_text *out, const example_encoding *encoding,
                                  const example_text *data)
{
  example_text header = {0}, packed = {0};
  if (!encoding->zlib && !encoding->lz4) {
    example_header(&header, encoding, data->size);
    example_bytes(&header, data->bytes, data->size);
    example_put(out, encoding, &header);
    example_free(&header);
    return;
  }
  size_t block = encoding->block, blocks = (data->size + block - 1) / block;
  example_header(&header, encoding, blocks);
  example_header(&header, encoding, block);
  example_header(&header, encoding, data->size % block);
  for (size_t at = 0; at < data->size; at += block) {
    size_t part = data->size - at < block ? data->size - at : block;
    example_packed(&packed, &header, encoding, data->bytes + at, part);
  }
  example_put(out, encoding, &header);
  example_put(out, encoding, &packed);
  example_free(&header);
  example_free(&packed);
}

/* Adds a DataArray element to `out`, or its data to `appended`. */
static inline void example_array(example_text *out, example_text *appended,
                                 const example_encoding *encoding, const char *name,
                                 int components, const double *numbers, size_t count)
{
  static const char *const formats[] = {"ascii", "binary", "appended", "appended"};
  char words[256];
  snprintf(words, sizeof words,
           "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"%s\" "
           "offset=\"%zu\">",
           EXAMPLE_TYPES[encoding->type], name, components, formats[encoding->storage],
           appended->size);
  example_words(out, words);
  example_text data = {0};
  for (size_t i = 0; i < count; ++i) {
    unsigned char bytes[8];
    size_t size = example_number(bytes, numbers[i], encoding->type, encoding->big);
    example_bytes(&data, bytes, size);
    snprintf(words, sizeof words, "%s%.17g", i % 6 ? " " : "\n", numbers[i]);
    if (encoding->storage == EXAMPLE_ASCII)
      example_words(out, words);
  }
  if (encoding->storage == EXAMPLE_INLINE)
    example_binary(out, encoding, &data);
  else if (encoding->storage != EXAMPLE_ASCII)
    example_binary(appended, encoding, &data);
  example_free(&data);
  example_words(out, "</DataArray>\n");
}

static inline void example_begin_kind(example_text *out, const example_encoding *encoding,
                                      const char *kind, const char *attributes)
{
  char words[512];
  snprintf(words, sizeof words,
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"1.0\" "
           "byte_order=\"%s\" header_type=\"%s\"%s>\n<%s %s>\n",
           kind, encoding->big ? "BigEndian" : "LittleEndian",
           encoding->wide ? "UInt64" : "UInt32",
           encoding->zlib  ? " compressor=\"vtkZLibDataCompressor\""
           : encoding->lz4 ? " compressor=\"vtkLZ4DataCompressor\""
                           : "",
           kind, attributes);
  example_words(out, words);
}

static inline void example_begin(example_text *out, const example_encoding *encoding,
                                 const char *image)
{
  example_begin_kind(out, encoding, "ImageData", image);
}

/* Frees `appended`. */
static inline void example_end_kind(example_text *out, example_text *appended,
                                    const example_encoding *encoding, const char *kind)
{
  char words[64];
  snprintf(words, sizeof words, "</%s>\n", kind);
  example_words(out, words);
  if (encoding->storage >= EXAMPLE_APPENDED_BASE64) {
    example_words(out, encoding->storage == EXAMPLE_APPENDED_RAW
                           ? "<AppendedData encoding=\"raw\">\n _"
                           : "<AppendedData encoding=\"base64\">\n _");
    example_bytes(out, appended->bytes, appended->size);
    example_words(out, "\n</AppendedData>\n");
  }
  example_words(out, "</VTKFile>\n");
  example_free(appended);
}

static inline void example_end(example_text *out, example_text *appended,
                               const example_encoding *encoding)
{
  example_end_kind(out, appended, encoding, "ImageData");
}

/* Reads from memory; the status, the field through *out. */
static inline fg_status example_read_as(fg_field **out, fg_context *context,
                                        const fg__format *format, const void *bytes,
                                        size_t size, const fg_read_options *options)
{
  static const fg_read_options none = {0};
  unsigned char *copy = malloc(size + !size); /* its end is where the sanitizer watches */
  assert_non_null(copy);
  memcpy(copy, bytes, size);
  fg__source source = {.path = "example", .bytes = copy, .size = size};
  fg_context_clear(context);
  options = options ? options : &none;
  *out = NULL;
  fg_status status =
      fg__dataset_read(out, context, format, &source, options, (fg__slab_index){0, 1});
  assert_slabs_alike(format, &source, options, *out);
  free(copy);
  return status;
}

static inline fg_status example_read(fg_field **out, fg_context *context,
                                     const void *bytes, size_t size,
                                     const fg_read_options *options)
{
  return example_read_as(out, context, &fg__format_vti, bytes, size, options);
}

enum { EXAMPLE_FILE_BYTES = 16384 };

static inline fg_status example_read_words(fg_field **out, fg_context *context,
                                           const char *words,
                                           const fg_read_options *options)
{
  return example_read(out, context, words, strlen(words), options);
}

/* The field of a file that must be sound. */
static inline fg_field *example_field_as(fg_context *context, const fg__format *format,
                                         const void *bytes, size_t size,
                                         const fg_read_options *options)
{
  fg_field *field = NULL;
  fg_status status = example_read_as(&field, context, format, bytes, size, options);
  if (status != FG_STATUS_OK)
    print_error("%s\n", fg_context_message(context));
  assert_int_equal(status, FG_STATUS_OK);
  return field;
}

static inline fg_field *example_field(fg_context *context, const char *words,
                                      const fg_read_options *options)
{
  return example_field_as(context, &fg__format_vti, words, strlen(words), options);
}

/* A sound file with one place of it changed, the first of `before`. */
typedef struct example_change {
  const char *before, *after;
  fg_status status;  /* of reading it */
  const char *words; /* in the message */
} example_change;

static inline void example_changed(char file[EXAMPLE_FILE_BYTES], const char *sound,
                                   const example_change *change)
{
  const char *at = strstr(sound, change->before);
  assert_non_null(at);
  int size = snprintf(file, EXAMPLE_FILE_BYTES, "%.*s%s%s", (int)(at - sound), sound,
                      change->after, at + strlen(change->before));
  assert_true(size > 0 && size < EXAMPLE_FILE_BYTES);
}

/* Reads a sound file once for each change of it. */
static inline void example_try_changes(fg_context *context, const fg__format *format,
                                       const char *sound, const example_change *change,
                                       size_t count)
{
  for (size_t n = 0; n < count; ++n, ++change) {
    char file[EXAMPLE_FILE_BYTES];
    fg_field *field = NULL;
    example_changed(file, sound, change);
    fg_status status = example_read_as(&field, context, format, file, strlen(file), NULL);
    const char *message = fg_context_message(context);
    if (status != change->status || !strstr(message, change->words))
      fail_msg("%s -> %s: %s", change->before, change->after, message);
    assert_true((field != NULL) == (status == FG_STATUS_OK));
    fg_field_destroy(field);
  }
}

/* An image with the given attributes, and what its piece holds. */
static inline void example_image(char file[EXAMPLE_FILE_BYTES], const char *attributes,
                                 const char *extent, const char *data)
{
  int size = snprintf(file, EXAMPLE_FILE_BYTES,
                      "<VTKFile type=\"ImageData\" version=\"0.1\">\n<ImageData "
                      "WholeExtent=\"%s\" %s>\n<Piece Extent=\"%s\">\n%s</Piece>\n"
                      "</ImageData>\n</VTKFile>\n",
                      extent, attributes, extent, data);
  if (size < 1 || size >= EXAMPLE_FILE_BYTES)
    abort();
}

#define VECTOR(name, numbers)                                                            \
  "<DataArray type='Float64' Name='" name "' NumberOfComponents='3'>" numbers            \
  "</DataArray>\n"
#define PAIR_OF(name, numbers)                                                           \
  "<DataArray type='Float64' Name='" name "' NumberOfComponents='2'>" numbers            \
  "</DataArray>\n"
#define SCALAR(name, numbers)                                                            \
  "<DataArray type='Float32' Name='" name "'>" numbers "</DataArray>\n"
#define BYTES(name, numbers)                                                             \
  "<DataArray type='UInt8' Name='" name "'>" numbers "</DataArray>\n"
#define POINTS(data) "<PointData>" data "</PointData>\n"
#define CELLS(data) "<CellData>" data "</CellData>\n"

#endif
