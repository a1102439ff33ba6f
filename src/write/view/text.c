#include "base/memory.h"
#include "file/base64.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>

#include <zlib.h>

void fg__view_text(FILE *stream, const char *text)
{
  if (!text) {
    fputs("null", stream);
    return;
  }
  putc('"', stream);
  for (const unsigned char *c = (const unsigned char *)text; *c; ++c)
    if (*c < 0x20 || *c == '"' || *c == '\\' || *c == '<' || *c == '>' || *c == '&')
      fprintf(stream, "\\u%04x", *c);
    else
      putc(*c, stream);
  putc('"', stream);
}

bool fg__view_bytes(FILE *stream, const void *bytes, size_t size)
{
  const size_t length = fg__base64_length(size);
  char *text = fg__allocate(length + 1, 1);
  if (!text)
    return false;
  fg__base64_encode(text, bytes, size);
  putc('"', stream);
  fwrite(text, 1, length, stream);
  putc('"', stream);
  free(text);
  return true;
}

bool fg__view_packed(FILE *stream, const int32_t *values, size_t count)
{
  uLongf size = compressBound((uLong)(4 * count));
  unsigned char *plane = fg__allocate(count + 1, 4), *packed = fg__allocate(size, 1);
  bool done = plane && packed;
  uint32_t before = 0;
  for (size_t n = 0; n < count && done; ++n) {
    const uint32_t step = (uint32_t)values[n] - before;
    const uint32_t zigzag = step << 1 ^ (step >> 31 ? 0xffffffffU : 0U);
    for (size_t k = 0; k < 4; ++k)
      plane[k * count + n] = (unsigned char)(zigzag >> 8 * k);
    before = (uint32_t)values[n];
  }
  done = done &&
         compress2(packed, &size, plane, (uLong)(4 * count), Z_BEST_COMPRESSION) == Z_OK;
  done = done && fg__view_bytes(stream, packed, size);
  free(plane);
  free(packed);
  return done;
}

static void put_place(unsigned char out[2], double share)
{
  const unsigned place = (unsigned)floor(65535.0 * fmin(fmax(share, 0.0), 1.0) + 0.5);
  out[0] = (unsigned char)(place & 255U);
  out[1] = (unsigned char)(place >> 8);
}

bool fg__view_lines(FILE *stream, const char *name, const fg__polygons *lines,
                    const double low[2], const double high[2])
{
  fprintf(stream, "\"%s\":[", name);
  unsigned char *places = fg__allocate(lines->point_count + 1, 4);
  if (!places)
    return false;
  bool done = true;
  for (size_t k = 0; k < lines->count && done; ++k) {
    const size_t first = lines->start[k], end = lines->start[k + 1];
    for (size_t n = first; n < end; ++n)
      for (int i = 0; i < 2; ++i)
        put_place(places + 4 * (n - first) + 2 * i,
                  (lines->point[n][i] - low[i]) / (high[i] - low[i]));
    if (k)
      putc(',', stream);
    done = fg__view_bytes(stream, places, 4 * (end - first));
  }
  free(places);
  putc(']', stream);
  return done;
}
