/* Portable grey and pixel maps: a word, three numbers, then samples. */
#include "read/image/image.h"

#include <string.h>

/* Where the text is being read. */
typedef struct cursor {
  const unsigned char *at, *end;
} cursor;

static bool is_space(unsigned char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

static bool pnm_is_mine(const unsigned char *bytes, size_t size)
{
  return size >= 3 && bytes[0] == 'P' && (is_space(bytes[2]) || bytes[2] == '#') &&
         (bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '5' || bytes[1] == '6');
}

/* Past white space and, in the header, comments. */
static void skip(cursor *c, bool comments)
{
  while (c->at < c->end && (is_space(*c->at) || (comments && *c->at == '#'))) {
    if (*c->at == '#')
      while (c->at < c->end && *c->at != '\n')
        ++c->at;
    else
      ++c->at;
  }
}

/* A whole number of at most nine digits. */
static bool next_number(cursor *c, bool comments, size_t *out)
{
  skip(c, comments);
  int digits = 0;
  *out = 0;
  while (c->at < c->end && *c->at >= '0' && *c->at <= '9' && ++digits < 10)
    *out = 10 * *out + (size_t)(*c->at++ - '0');
  return digits > 0 && digits < 10;
}

static fg_status fail_short(fg_context *context, const char *path, size_t found,
                            size_t count)
{
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: ends after %zu of %zu samples",
                  path, found, count);
}

static fg_status fail_large(fg_context *context, const char *path, size_t value,
                            size_t most)
{
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: a sample is %zu, beyond %zu", path,
                  value, most);
}

static fg_status read_text(float *sample, fg_context *context, const char *path,
                           cursor *c, size_t count, size_t most)
{
  for (size_t n = 0; n < count; ++n) {
    size_t value;
    if (!next_number(c, true, &value))
      return c->at < c->end
                 ? fg__fail(context, FG_STATUS_FILE_FORMAT,
                            "%s: sample %zu of %zu is no number", path, n + 1, count)
                 : fail_short(context, path, n, count);
    if (value > most)
      return fail_large(context, path, value, most);
    sample[n] = (float)value / (float)most;
  }
  return FG_STATUS_OK;
}

static fg_status read_binary(float *sample, fg_context *context, const char *path,
                             const cursor *c, size_t count, size_t most)
{
  size_t bytes = most > 255 ? 2 : 1;
  for (size_t n = 0; n < count; ++n) {
    const unsigned char *b = c->at + n * bytes;
    size_t value = bytes == 2 ? (size_t)b[0] * 256 + b[1] : b[0];
    if (value > most)
      return fail_large(context, path, value, most);
    sample[n] = (float)value / (float)most;
  }
  return FG_STATUS_OK;
}

static fg_status pnm_read(fg_image **out, fg_context *context, const fg__source *source)
{
  cursor c = {source->bytes + 2, source->bytes + source->size};
  bool text = source->bytes[1] < '5';
  int channels = source->bytes[1] == '3' || source->bytes[1] == '6' ? 3 : 1;
  size_t width, height, most;
  if (!next_number(&c, true, &width) || !next_number(&c, true, &height) ||
      !next_number(&c, true, &most))
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: width, height and largest sample are not all there",
                    source->path);
  if (most < 1 || most > 65535)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: the largest sample is %zu; 1 to 65535 are possible",
                    source->path, most);
  if (!text && c.at < c.end)
    ++c.at; /* the one white space after the header */
  /* at least a byte a sample, in text two: nothing is allocated for what is not there */
  size_t left = (size_t)(c.end - c.at);
  size_t bytes = text ? 2 : most > 255 ? 2 : 1;
  if (width > 0 && height > 0 && width <= FG__MOST_PIXELS &&
      height <= FG__MOST_PIXELS / width) {
    size_t count = width * height * (size_t)channels;
    if ((left + (text ? 1 : 0)) / bytes < count)
      return fail_short(context, source->path, left / bytes, count);
  }
  fg_image *image;
  fg_status status =
      fg__image_begin(&image, context, source->path, width, height, channels, false);
  if (status)
    return status;
  size_t count = width * height * (size_t)channels;
  status = text ? read_text(image->sample, context, source->path, &c, count, most)
                : read_binary(image->sample, context, source->path, &c, count, most);
  if (status) {
    fg_image_destroy(image);
    return status;
  }
  *out = image;
  return FG_STATUS_OK;
}

const fg__image_format fg__image_pnm = {"PNM", pnm_is_mine, pnm_read};
