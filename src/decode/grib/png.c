/* Values packed as an image. ecCodes lets libpng print what it finds wrong with one, so
 * what could be wrong is looked for before. */
#include "base/memory.h"
#include "decode/grib/grib.h"
#include "file/checksum.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

typedef struct rows_of_bytes {
  uint64_t row; /* bytes, with the one that says its filter */
  uint64_t rows;
} rows_of_bytes;

/* A chunk: its length, its type, its bytes, a checksum of both. */
typedef struct chunk {
  const unsigned char *type, *bytes;
  size_t size;
} chunk;

/* Steps over the chunk at *at; false: there is none that is whole. */
static bool next_chunk(chunk *out, const unsigned char *png, size_t size, size_t *at)
{
  if (size - *at < 12)
    return false;
  const uint64_t length = fg__grib_number(png + *at, 4);
  if (length > size - *at - 12)
    return false;
  *out = (chunk){png + *at + 4, png + *at + 8, (size_t)length};
  *at += (size_t)length + 12;
  return fg__checksum(0, out->type, out->size + 4) ==
         fg__grib_number(out->bytes + out->size, 4);
}

static bool is_type(const chunk *c, const char *type)
{
  return memcmp(c->type, type, 4) == 0;
}

/* Greys of 1 to 16 bits, colours of 8 or 16, in rows one after the other. */
static bool read_header(rows_of_bytes *out, const chunk *c)
{
  if (c->size != 13 || !is_type(c, "IHDR"))
    return false;
  const uint64_t width = fg__grib_number(c->bytes, 4);
  const unsigned depth = c->bytes[8], color = c->bytes[9];
  const unsigned channels = color == 0 ? 1 : color == 2 ? 3 : color == 6 ? 4 : 0;
  const bool deep = depth == 8 || depth == 16;
  out->rows = fg__grib_number(c->bytes + 4, 4);
  out->row = 1 + (width * channels * depth + 7) / 8;
  return channels > 0 &&
         (deep || (channels == 1 && (depth == 1 || depth == 2 || depth == 4))) &&
         c->bytes[10] == 0 && c->bytes[11] == 0 && c->bytes[12] == 0 && width > 0 &&
         width < 1 << 24 && out->rows > 0 && out->rows < 1 << 24;
}

/* Unpacks bytes of IDAT; each row begins with a filter's number, of which there are 5. */
static bool check_filters(z_stream *stream, const rows_of_bytes *image, uint64_t *at,
                          int *state)
{
  unsigned char room[4096] = {0};
  do {
    stream->next_out = room;
    stream->avail_out = sizeof room;
    *state = inflate(stream, Z_NO_FLUSH);
    if (*state != Z_OK && *state != Z_STREAM_END && *state != Z_BUF_ERROR)
      return false;
    const size_t got = sizeof room - stream->avail_out;
    uint64_t filter = (image->row - *at % image->row) % image->row;
    for (; filter < got; filter += image->row)
      if (room[filter] > 4)
        return false;
    *at += got;
    if (*at > image->row * image->rows)
      return false;
  } while (stream->avail_out == 0 && *state == Z_OK);
  return *state != Z_STREAM_END || stream->avail_in == 0;
}

static bool check_chunks(z_stream *stream, const unsigned char *png, size_t size)
{
  size_t at = 8;
  rows_of_bytes header;
  chunk c;
  uint64_t unpacked = 0;
  int state = Z_OK;
  if (!next_chunk(&c, png, size, &at) || !read_header(&header, &c))
    return false;
  while (next_chunk(&c, png, size, &at)) {
    if (is_type(&c, "IEND"))
      return state == Z_STREAM_END && unpacked == header.row * header.rows && c.size == 0;
    if (c.type[0] & 32) /* may be skipped */
      continue;
    if (!is_type(&c, "IDAT") || state == Z_STREAM_END)
      return false;
    union {
      const unsigned char *read;
      unsigned char *written;
    } bytes = {.read = c.bytes}; /* zlib only reads them */
    stream->next_in = bytes.written;
    stream->avail_in = (uInt)c.size;
    if (!check_filters(stream, &header, &unpacked, &state))
      return false;
  }
  return false;
}

bool fg__grib_is_png(const unsigned char *png, size_t size)
{
  static const unsigned char mark[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  z_stream stream;
  memset(&stream, 0, sizeof stream);
  if (size < sizeof mark || memcmp(png, mark, sizeof mark) != 0 ||
      inflateInit(&stream) != Z_OK)
    return false;
  const bool sound = check_chunks(&stream, png, size);
  inflateEnd(&stream);
  return sound;
}
