/* The numbers of one array: base64 or raw, plain or in blocks of zlib or LZ4. */
#include "base/memory.h"
#include "decode/vtk/vtk.h"
#include "file/base64.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <lz4.h>
#include <zlib.h>

/* Deflate cannot shrink data more than this (zlib's technical details: 1032 to 1), LZ4
 * not more than 255 to 1 (a byte a run of as many), so a block that promises more is
 * refused before anything is allocated. */
static const uint64_t LARGEST_COMPRESSION[] = {
    [FG__VTK_PLAIN] = 1, [FG__VTK_ZLIB] = 1032, [FG__VTK_LZ4] = 255};

typedef struct byte_stream {
  fg__base64 base64; /* used for its text and its position when not encoded, too */
  bool encoded;
} byte_stream;

static size_t bytes_available(const byte_stream *stream)
{
  return stream->encoded ? fg__base64_available(&stream->base64)
                         : stream->base64.size - stream->base64.at;
}

/* Reads `count` bytes; NULL: skips them. False where fewer are left. */
static bool read_bytes(byte_stream *stream, unsigned char *out, size_t count)
{
  if (stream->encoded)
    return fg__base64_read(&stream->base64, out, count);
  if (count > bytes_available(stream))
    return false;
  if (out)
    memcpy(out, stream->base64.text + stream->base64.at, count);
  stream->base64.at += count;
  return true;
}

uint64_t fg__vtk_size(const fg__vtk *vtk, const unsigned char *bytes)
{
  const bool little = fg__is_little_endian() != vtk->swap;
  uint64_t size = 0;
  for (size_t k = 0; k < vtk->header_bytes; ++k)
    size = size << 8 | bytes[little ? vtk->header_bytes - 1 - k : k];
  return size;
}

static bool read_header(byte_stream *stream, const fg__vtk *vtk, uint64_t *number)
{
  unsigned char bytes[8];
  if (!read_bytes(stream, bytes, vtk->header_bytes))
    return false;
  *number = fg__vtk_size(vtk, bytes);
  return true;
}

/* Where a binary array's bytes are. Uncompressed is one block stored as it is. */
typedef struct block_layout {
  byte_stream sizes; /* at the compressed size of the first block */
  byte_stream data;  /* at the first block */
  uint64_t blocks, block_size, last_size;
  uint64_t stored; /* bytes of all blocks in the file */
  uint64_t size;   /* of all that they hold */
} block_layout;

/* For a number of expected bytes: any, as the array has it. */
static const size_t ANY_SIZE = SIZE_MAX;

static fg_status fail_array(const fg__vtk *vtk, const fg__vtk_array *array,
                            const char *what)
{
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: array \"%.100s\": %s",
                  vtk->path, array->name, what);
}

static fg_status fail_short(const fg__vtk *vtk, const fg__vtk_array *array,
                            uint64_t needed, uint64_t there)
{
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                  "%s: array \"%.100s\" is cut short: %llu bytes promised, %llu there",
                  vtk->path, array->name, (unsigned long long)needed,
                  (unsigned long long)there);
}

static fg_status fail_size(const fg__vtk *vtk, const fg__vtk_array *array,
                           uint64_t promised, size_t expected)
{
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                  "%s: array \"%.100s\" has %llu bytes where its extent needs %zu",
                  vtk->path, array->name, (unsigned long long)promised, expected);
}

static fg_status open_stream(byte_stream *out, const fg__vtk *vtk,
                             const fg__vtk_array *array)
{
  if (array->storage == FG__VTK_INLINE) {
    *out = (byte_stream){
        .base64 = {.text = (const unsigned char *)array->text, .size = array->text_size},
        .encoded = true};
    return FG_STATUS_OK;
  }
  if (!vtk->appended)
    return fail_array(vtk, array, "is appended, but the file has no AppendedData");
  if (array->offset > vtk->appended_size)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: array \"%.100s\" begins at offset %zu of %zu appended bytes",
                    vtk->path, array->name, array->offset, vtk->appended_size);
  *out = (byte_stream){
      .base64 = {.text = vtk->appended, .size = vtk->appended_size, .at = array->offset},
      .encoded = vtk->appended_base64};
  return FG_STATUS_OK;
}

static fg_status read_plain_layout(block_layout *out, const fg__vtk *vtk,
                                   const fg__vtk_array *array, size_t expected)
{
  uint64_t size;
  if (!read_header(&out->data, vtk, &size))
    return fail_array(vtk, array, "is cut short: not even its size is there");
  if (size != expected && expected != ANY_SIZE)
    return fail_size(vtk, array, size, expected);
  if (size > bytes_available(&out->data))
    return fail_short(vtk, array, size, bytes_available(&out->data));
  out->blocks = 1;
  out->block_size = out->stored = out->size = size;
  return FG_STATUS_OK;
}

static uint64_t size_of_block(const block_layout *layout, uint64_t block)
{
  return block + 1 == layout->blocks && layout->last_size > 0 ? layout->last_size
                                                              : layout->block_size;
}

/* Adds up the blocks' sizes in the file; each must be able to hold what it promises. */
static fg_status read_block_sizes(block_layout *out, const fg__vtk *vtk,
                                  const fg__vtk_array *array)
{
  for (uint64_t block = 0; block < out->blocks; ++block) {
    uint64_t size = 0;
    if (!read_header(&out->data, vtk, &size))
      return fail_array(vtk, array, "is cut short inside its list of blocks");
    uint64_t available = bytes_available(&out->data);
    if (size > available || out->stored > available - size)
      return fail_short(vtk, array, size, available - out->stored);
    if (size_of_block(out, block) / LARGEST_COMPRESSION[vtk->compression] > size)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: array \"%.100s\": block %llu cannot hold %llu bytes in %llu",
                      vtk->path, array->name, (unsigned long long)block,
                      (unsigned long long)size_of_block(out, block),
                      (unsigned long long)size);
    out->stored += size;
  }
  return FG_STATUS_OK;
}

static fg_status read_block_layout(block_layout *out, const fg__vtk *vtk,
                                   const fg__vtk_array *array, size_t expected)
{
  if (!read_header(&out->data, vtk, &out->blocks) ||
      !read_header(&out->data, vtk, &out->block_size) ||
      !read_header(&out->data, vtk, &out->last_size))
    return fail_array(vtk, array, "is cut short: not even its size is there");
  uint64_t room = bytes_available(&out->data) / vtk->header_bytes;
  if (out->blocks > room)
    return fail_short(vtk, array, out->blocks, room);
  if (out->last_size > out->block_size ||
      (out->block_size > 0 && out->blocks > UINT64_MAX / out->block_size))
    return fg__fail(
        vtk->context, FG_STATUS_FILE_FORMAT,
        "%s: array \"%.100s\": %llu blocks of %llu bytes and a last one of %llu",
        vtk->path, array->name, (unsigned long long)out->blocks,
        (unsigned long long)out->block_size, (unsigned long long)out->last_size);
  /* the last block alone may be smaller than what the header calls a block */
  uint64_t total = out->blocks * out->block_size;
  if (out->last_size > 0 && out->blocks > 0)
    total -= out->block_size - out->last_size;
  if (total != expected && expected != ANY_SIZE)
    return fail_size(vtk, array, total, expected);
  out->size = total;
  out->sizes = out->data;
  return read_block_sizes(out, vtk, array);
}

static fg_status read_layout(block_layout *out, const fg__vtk *vtk,
                             const fg__vtk_array *array, size_t expected)
{
  *out = (block_layout){0};
  if (vtk->compression == FG__VTK_OTHER_COMPRESSION) {
    fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
             "%s: array \"%.100s\" is compressed by %.100s, which cannot be read yet",
             vtk->path, array->name, vtk->compressor);
    fg__hint(vtk->context, "write it with zlib, with LZ4 or without compression");
    return FG_STATUS_UNSUPPORTED;
  }
  fg_status status = open_stream(&out->data, vtk, array);
  if (status != FG_STATUS_OK)
    return status;
  return vtk->compression == FG__VTK_PLAIN ? read_plain_layout(out, vtk, array, expected)
                                           : read_block_layout(out, vtk, array, expected);
}

static fg_status expected_count(size_t *count, const fg__vtk *vtk,
                                const fg__vtk_array *array, size_t tuples)
{
  if (array->type < FG__TYPE_INT8)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: array \"%.100s\" holds no numbers", vtk->path, array->name);
  size_t components = (size_t)array->components;
  /* 8 bytes a number at most */
  if (tuples > SIZE_MAX / 8 / components)
    return fail_array(vtk, array, "its sizes overflow");
  *count = tuples * components;
  return FG_STATUS_OK;
}

static bool is_text(const fg__vtk_array *array)
{
  return array->storage == FG__VTK_ASCII || array->storage == FG__VTK_TOKENS;
}

bool fg__vtk_is_read_whole(const fg__vtk_array *array)
{
  return array->storage == FG__VTK_HELD ? array->is_read_whole : is_text(array);
}

/* The type that an array's numbers have once they are read. */
static fg__type type_in_memory(const fg__vtk_array *array)
{
  return is_text(array) || array->storage == FG__VTK_HELD ? FG__TYPE_FLOAT64
                                                          : array->type;
}

fg_status fg__vtk_values_check(const fg__vtk *vtk, const fg__vtk_array *array,
                               size_t tuples, size_t *stored)
{
  size_t count = 0;
  fg_status status = expected_count(&count, vtk, array, tuples);
  if (status != FG_STATUS_OK)
    return status;
  if (is_text(array)) {
    /* a number takes a digit and a space at least */
    *stored = array->text_size;
    if (count > array->text_size / 2 + 1)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: array \"%.100s\" is cut short: %zu numbers promised in %zu "
                      "characters",
                      vtk->path, array->name, count, array->text_size);
    return FG_STATUS_OK;
  }
  if (array->storage == FG__VTK_HELD) {
    *stored = 0; /* its size is that of what it is in, which is checked there */
    return count <= array->text_size
               ? FG_STATUS_OK
               : fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                          "%s: array \"%.100s\" has %zu numbers where its grid needs "
                          "%zu",
                          vtk->path, array->name, array->text_size, count);
  }
  if (array->storage == FG__VTK_RAW) {
    *stored = array->text_size;
    return *stored == count * fg__type_bytes(array->type)
               ? FG_STATUS_OK
               : fail_size(vtk, array, *stored, count * fg__type_bytes(array->type));
  }
  block_layout layout;
  status = read_layout(&layout, vtk, array, count * fg__type_bytes(array->type));
  *stored = (size_t)layout.stored;
  return status;
}

fg_status fg__vtk_values_count(size_t *out, const fg__vtk *vtk,
                               const fg__vtk_array *array)
{
  block_layout layout;
  const size_t size = fg__type_bytes(array->type);
  fg_status status = read_layout(&layout, vtk, array, ANY_SIZE);
  *out = (size_t)layout.size / size;
  return status;
}

/* Bytes of an array: those that are wanted, and all there are. */
typedef struct byte_range {
  size_t first, end, all;
} byte_range;

static bool grow_to(unsigned char **buffer, size_t *capacity, size_t size)
{
  if (size <= *capacity)
    return true;
  free(*buffer);
  *buffer = fg__allocate(size, 1);
  *capacity = *buffer ? size : 0;
  return *buffer != NULL;
}

static bool inflate_block(const fg__vtk *vtk, unsigned char *out, size_t wanted,
                          const unsigned char *packed, size_t size)
{
  if (vtk->compression == FG__VTK_LZ4)
    return wanted <= INT_MAX && size <= INT_MAX &&
           LZ4_decompress_safe((const char *)packed, (char *)out, (int)size,
                               (int)wanted) == (int)wanted;
  uLongf inflated = (uLongf)wanted;
  uLong used = (uLong)size;
  return uncompress2(out, &inflated, packed, &used) == Z_OK && inflated == wanted &&
         used == size;
}

/* Blocks without a wanted byte are skipped. */
static fg_status inflate_blocks(unsigned char *out, const fg__vtk *vtk,
                                const fg__vtk_array *array, block_layout *layout,
                                const byte_range *range)
{
  unsigned char *packed = NULL, *whole = NULL;
  size_t packed_capacity = 0, whole_capacity = 0, at = 0;
  fg_status status = FG_STATUS_OK;
  for (uint64_t block = 0; block < layout->blocks && status == FG_STATUS_OK; ++block) {
    uint64_t size = 0;
    if (!read_header(&layout->sizes, vtk, &size)) {
      status = fail_array(vtk, array, "its list of blocks cannot be read");
      break;
    }
    const size_t wanted = (size_t)size_of_block(layout, block);
    const size_t first = at > range->first ? at : range->first;
    const size_t end = at + wanted < range->end ? at + wanted : range->end;
    const bool skipped = first >= end, entire = !skipped && end - first == wanted;
    if (!skipped && (!grow_to(&packed, &packed_capacity, (size_t)size) ||
                     (!entire && !grow_to(&whole, &whole_capacity, wanted)))) {
      status = fg__fail_memory(vtk->context, "a compressed block", (size_t)size + wanted);
      break;
    }
    unsigned char *to = skipped ? NULL : entire ? out + (at - range->first) : whole;
    if (!read_bytes(&layout->data, skipped ? NULL : packed, (size_t)size) ||
        (!skipped && !inflate_block(vtk, to, wanted, packed, (size_t)size)))
      status =
          fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                   "%s: array \"%.100s\": block %llu of %llu does not inflate to %llu "
                   "bytes",
                   vtk->path, array->name, (unsigned long long)block + 1,
                   (unsigned long long)layout->blocks, (unsigned long long)wanted);
    else if (!skipped && !entire)
      memcpy(out + (first - range->first), whole + (first - at), end - first);
    at += wanted;
  }
  free(packed);
  free(whole);
  return status;
}

static fg_status read_binary(fg__vtk_values *out, const fg__vtk *vtk,
                             const fg__vtk_array *array, size_t all)
{
  const size_t size = fg__type_bytes(array->type);
  const byte_range range = {out->first * size, (out->first + out->count) * size,
                            all * size};
  block_layout layout;
  if (array->storage == FG__VTK_RAW) {
    memcpy(out->bytes, array->text + range.first, range.end - range.first);
    return FG_STATUS_OK;
  }
  const bool is_inline = array->storage == FG__VTK_INLINE;
  fg_status status = read_layout(&layout, vtk, array, range.all);
  if (status != FG_STATUS_OK)
    return status;
  if (vtk->compression != FG__VTK_PLAIN)
    status = range.all > 0 ? inflate_blocks(out->bytes, vtk, array, &layout, &range)
                           : FG_STATUS_OK;
  else if (!read_bytes(&layout.data, NULL, range.first) ||
           !read_bytes(&layout.data, out->bytes, range.end - range.first) ||
           (is_inline && !read_bytes(&layout.data, NULL, range.all - range.end)))
    status = fail_array(vtk, array, "its base64 has a wrong character or ends early");
  if (status != FG_STATUS_OK)
    return status;
  if (is_inline && !fg__base64_ended(&layout.data.base64))
    return fail_array(vtk, array, "has more bytes than it promises");
  return FG_STATUS_OK;
}

fg_status fg__vtk_values_create_some(fg__vtk_values *out, const fg__vtk *vtk,
                                     const fg__vtk_array *array, size_t tuples,
                                     size_t first, size_t end)
{
  *out = (fg__vtk_values){0};
  size_t stored;
  fg_status status = fg__vtk_values_check(vtk, array, tuples, &stored);
  if (status != FG_STATUS_OK)
    return status;
  const size_t components = (size_t)array->components, all = tuples * components;
  out->first = first * components;
  out->count = (end - first) * components;
  out->type = type_in_memory(array);
  out->swapped = vtk->swap && array->storage != FG__VTK_HELD && !is_text(array);
  size_t size = fg__type_bytes(out->type);
  out->bytes = fg__allocate(out->count, size);
  if (!out->bytes)
    return fg__fail_memory(vtk->context, "an array of the file", out->count * size);
  status = array->storage == FG__VTK_HELD ? array->read((double *)(void *)out->bytes, vtk,
                                                        array, out->first, out->count)
           : is_text(array)               ? fg__vtk_values_from_text(out, vtk, array, all)
                                          : read_binary(out, vtk, array, all);
  if (status != FG_STATUS_OK)
    fg__vtk_values_clear(out);
  return status;
}

fg_status fg__vtk_values_create(fg__vtk_values *out, const fg__vtk *vtk,
                                const fg__vtk_array *array, size_t tuples)
{
  return fg__vtk_values_create_some(out, vtk, array, tuples, 0, tuples);
}

void fg__vtk_values_clear(fg__vtk_values *values)
{
  free(values->bytes);
  *values = (fg__vtk_values){0};
}

double fg__vtk_value(const fg__vtk_values *values, size_t index)
{
  const size_t at = (index - values->first) * fg__type_bytes(values->type);
  return fg__number_of_bytes(values->type, values->bytes + at, values->swapped);
}

fg_status fg__vtk_read_numbers(double *out, const fg__vtk *vtk,
                               const fg__vtk_array *array, size_t tuples)
{
  fg__vtk_values values;
  const fg_status status = fg__vtk_values_create(&values, vtk, array, tuples);
  for (size_t i = 0; status == FG_STATUS_OK && i < values.count; ++i)
    out[i] = fg__vtk_value(&values, i);
  fg__vtk_values_clear(&values);
  return status;
}
