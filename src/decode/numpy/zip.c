/* ZIP archives (PKWARE's APPNOTE), as numpy.savez writes them: stored or deflated. */
#include <string.h>

#define ZLIB_CONST
#include <zlib.h>

#include "base/utf8.h"
#include "decode/numpy/numpy.h"
#include "file/checksum.h"

enum {
  END_BYTES = 22,
  LONGEST_COMMENT = 65535,
  CENTRAL_BYTES = 46,
  LOCAL_BYTES = 30,
  MOST_ENTRIES = 4096,
  STORED = 0,
  DEFLATED = 8
};

/* Larger entries may not be more than so many times the bytes they are stored in: deflate
 * comes to 1032 times, fields of numbers to a few. */
static const size_t LARGE = (size_t)1 << 28, MOST_TIMES = 200;

static size_t number(const unsigned char *bytes, int count)
{
  size_t out = 0;
  for (int i = count - 1; i >= 0; --i)
    out = out << 8 | bytes[i];
  return out;
}

static fg_status fail_damaged(fg_context *context, const char *path, const char *what)
{
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: damaged ZIP archive: %s", path,
                  what);
}

/* The directory's end, which a comment may follow. */
static const unsigned char *find_end(const fg__source *source)
{
  if (source->size < END_BYTES)
    return NULL;
  const size_t last = source->size - END_BYTES;
  for (size_t back = 0; back <= last && back <= LONGEST_COMMENT; ++back) {
    const unsigned char *at = source->bytes + last - back;
    if (memcmp(at, "PK\005\006", 4) == 0 && number(at + 20, 2) == back)
      return at;
  }
  return NULL;
}

/* Sizes and place that do not fit 32 bits stand in an extra field, in this order. */
static bool read_large(size_t value[3], const unsigned char *extra, size_t size)
{
  for (size_t at = 0; at + 4 <= size;) {
    const size_t length = number(extra + at + 2, 2);
    if (length > size - at - 4)
      return false;
    if (number(extra + at, 2) == 1) {
      size_t from = at + 4;
      for (int k = 0; k < 3; ++k) {
        if (value[k] != UINT32_MAX)
          continue;
        if (from + 8 > at + 4 + length)
          return false;
        value[k] = number(extra + from, 8);
        from += 8;
      }
    }
    at += 4 + length;
  }
  return value[0] != UINT32_MAX && value[1] != UINT32_MAX && value[2] != UINT32_MAX;
}

/* Where an entry's bytes begin: behind a header of their own. */
static bool find_bytes(fg__zip_entry *entry, const fg__source *source, size_t at)
{
  if (source->size < LOCAL_BYTES || at > source->size - LOCAL_BYTES ||
      memcmp(source->bytes + at, "PK\003\004", 4) != 0)
    return false;
  const size_t begin = at + LOCAL_BYTES + number(source->bytes + at + 26, 2) +
                       number(source->bytes + at + 28, 2);
  if (begin > source->size || entry->stored > source->size - begin)
    return false;
  entry->bytes = source->bytes + begin;
  return true;
}

static fg_status check_entry(fg_context *context, const char *path,
                             const fg__zip_entry *entry, size_t flags, size_t method)
{
  if ((flags & 1) != 0)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: \"%s\" is encrypted", path,
                    entry->name);
  if (method != STORED && method != DEFLATED)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: \"%s\" is compressed by method %zu, not deflate", path,
                    entry->name, method);
  if (method == STORED && entry->stored != entry->size)
    return fail_damaged(context, path, "sizes of an entry that is only stored differ");
  if (entry->size > LARGE && entry->size / MOST_TIMES > entry->stored)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: \"%s\" claims to become %zu bytes of %zu", path, entry->name,
                    entry->size, entry->stored);
  return FG_STATUS_OK;
}

/* Adds the entry at `at` of the directory, and moves behind it. */
static fg_status add_entry(fg__zip *out, fg_context *context, const fg__source *source,
                           const unsigned char **at, size_t left)
{
  const unsigned char *c = *at;
  if (left < CENTRAL_BYTES || memcmp(c, "PK\001\002", 4) != 0)
    return fail_damaged(context, source->path, "its directory ends too early");
  const size_t name = number(c + 28, 2), extra = number(c + 30, 2);
  const size_t length = CENTRAL_BYTES + name + extra + number(c + 32, 2);
  if (length > left)
    return fail_damaged(context, source->path, "its directory ends too early");
  *at += length;
  if (name < 5 || memcmp(c + CENTRAL_BYTES + name - 4, ".npy", 4) != 0)
    return FG_STATUS_OK;
  if (out->count == FG__NPY_ARRAYS)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: more than %d arrays",
                    source->path, FG__NPY_ARRAYS);
  fg__zip_entry *entry = &out->entry[out->count++];
  size_t value[3] = {number(c + 24, 4), number(c + 20, 4), number(c + 42, 4)};
  *entry = (fg__zip_entry){.deflated = number(c + 10, 2) == DEFLATED,
                           .checksum = (uint32_t)number(c + 16, 4)};
  fg__utf8_take(entry->name, FG__NPY_NAME, (const char *)c + CENTRAL_BYTES, name - 4);
  if (!read_large(value, c + CENTRAL_BYTES + name, extra))
    return fail_damaged(context, source->path, "an entry has no size");
  entry->size = value[0];
  entry->stored = value[1];
  if (!find_bytes(entry, source, value[2]))
    return fail_damaged(context, source->path, "an entry is not where it should be");
  return check_entry(context, source->path, entry, number(c + 8, 2), number(c + 10, 2));
}

/* Entries that share bytes would let a small file become any number of arrays. */
static fg_status check_apart(fg_context *context, const char *path, const fg__zip *zip)
{
  for (size_t i = 0; i < zip->count; ++i)
    for (size_t k = 0; k < i; ++k)
      if (zip->entry[i].bytes < zip->entry[k].bytes + zip->entry[k].stored &&
          zip->entry[k].bytes < zip->entry[i].bytes + zip->entry[i].stored)
        return fail_damaged(context, path, "entries overlap");
  return FG_STATUS_OK;
}

fg_status fg__zip_list(fg__zip *out, fg_context *context, const fg__source *source)
{
  const unsigned char *end = find_end(source);
  out->count = 0;
  if (!end)
    return fail_damaged(context, source->path, "its directory is missing");
  const size_t entries = number(end + 10, 2), begin = number(end + 16, 4);
  if (entries == UINT16_MAX || begin == UINT32_MAX || entries > MOST_ENTRIES)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a ZIP archive of %zu entries or of more than 4 GiB",
                    source->path, entries);
  if (begin > (size_t)(end - source->bytes))
    return fail_damaged(context, source->path, "its directory is outside");
  const unsigned char *at = source->bytes + begin;
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < entries && status == FG_STATUS_OK; ++i)
    status = add_entry(out, context, source, &at, (size_t)(end - at));
  return status == FG_STATUS_OK ? check_apart(context, source->path, out) : status;
}

static unsigned int piece(size_t size)
{
  return size < ((size_t)1 << 30) ? (unsigned int)size : 1U << 30;
}

/* Inflates without zlib's frame; false when the bytes are damaged. */
static bool inflate_entry(unsigned char *out, size_t size, size_t *got,
                          const fg__zip_entry *entry)
{
  z_stream stream = {0};
  const unsigned char *from = entry->bytes;
  size_t left = entry->stored;
  int code = Z_OK;
  *got = 0;
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    return false;
  while (*got < size && code == Z_OK) {
    const unsigned int in = piece(left), room = piece(size - *got);
    stream.next_in = from;
    stream.avail_in = in;
    stream.next_out = out + *got;
    stream.avail_out = room;
    code = inflate(&stream, Z_NO_FLUSH);
    from += in - stream.avail_in;
    left -= in - stream.avail_in;
    *got += room - stream.avail_out;
    if (code == Z_BUF_ERROR || (in == stream.avail_in && room == stream.avail_out))
      break;
  }
  inflateEnd(&stream);
  return code == Z_OK || code == Z_STREAM_END;
}

fg_status fg__zip_extract(unsigned char *out, size_t size, size_t *got,
                          fg_context *context, const char *path,
                          const fg__zip_entry *entry)
{
  const size_t wanted = size < entry->size ? size : entry->size;
  if (!entry->deflated) {
    *got = wanted;
    memcpy(out, entry->bytes, wanted);
  } else if (!inflate_entry(out, wanted, got, entry) || *got != wanted) {
    return fail_damaged(context, path, "an entry cannot be inflated");
  }
  if (wanted == entry->size && fg__checksum(0, out, wanted) != entry->checksum)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: \"%s\" is damaged: its checksum is not %08x", path, entry->name,
                    (unsigned)entry->checksum);
  return FG_STATUS_OK;
}
