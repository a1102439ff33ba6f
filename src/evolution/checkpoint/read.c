#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "evolution/checkpoint/layout.h"
#include "evolution/checkpoint/runs.h"
#include "file/checksum.h"

static fg_status fail_access(fg_context *context, const char *path)
{
  return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: cannot be read: %s", path,
                  strerror(errno));
}

static fg_status get(const fg__checkpoint_file *file, fg_context *context, void *out,
                     size_t count, uint64_t offset)
{
  unsigned char *bytes = out;
  while (count > 0) {
    ssize_t done = pread(file->file, bytes, count, (off_t)offset);
    if (done < 0 && errno == EINTR)
      continue;
    if (done < 0)
      return fail_access(context, file->path);
    if (done == 0)
      return fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "%s: damaged: it ends at byte %llu, while it is read", file->path,
                      (unsigned long long)offset);
    bytes += done;
    count -= (size_t)done;
    offset += (uint64_t)done;
  }
  return FG_STATUS_OK;
}

static fg_status check_sum(const char *path, fg_context *context, const char *part,
                           uint32_t sum, uint32_t noted)
{
  if (sum == noted)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "%s: damaged: the checksum of its %s is %08x, not %08x", path, part,
                  (unsigned)sum, (unsigned)noted);
}

static fg_status check_preamble(const fg__checkpoint_file *file, fg_context *context,
                                const unsigned char *preamble, uint64_t bytes)
{
  if (memcmp(preamble, FG__CHECKPOINT_MAGIC, sizeof FG__CHECKPOINT_MAGIC - 1) != 0)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: is no checkpoint: its first bytes are not those of one",
                    file->path);
  fg_status status = check_sum(file->path, context, "preamble",
                               fg__checksum(0, preamble, FG__AT_PREAMBLE_CHECKSUM),
                               fg__get_32(preamble + FG__AT_PREAMBLE_CHECKSUM));
  if (status)
    return status;
  uint32_t format = fg__get_32(preamble + FG__AT_FORMAT);
  if (format != FG__CHECKPOINT_FORMAT)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a checkpoint of format %u; only format %d is known", file->path,
                    (unsigned)format, FG__CHECKPOINT_FORMAT);
  uint64_t expected = fg__get_64(preamble + FG__AT_FILE_BYTES);
  if (bytes != expected)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: damaged: it has %llu bytes, not %llu", file->path,
                    (unsigned long long)bytes, (unsigned long long)expected);
  return FG_STATUS_OK;
}

/* A record as an entry of the table says; false when it contradicts itself. */
static bool take_entry(fg__box_record *record, const unsigned char *entry)
{
  memcpy(record->array, entry, FG__ARRAY_NAME_BYTES);
  record->grid = (int)fg__get_32(entry + FG__AT_GRID);
  record->offset = fg__get_64(entry + FG__AT_OFFSET);
  record->bytes = fg__get_64(entry + FG__AT_BYTES);
  record->checksum = fg__get_32(entry + FG__AT_CHECKSUM);
  uint64_t values = record->bytes / sizeof(float);
  for (int k = 0; k < 3; ++k) {
    uint32_t first = fg__get_32(entry + FG__AT_FIRST + 4 * k);
    uint32_t nodes = fg__get_32(entry + FG__AT_NODES + 4 * k);
    if (first > INT32_MAX / 2 || nodes < 1 || nodes > INT32_MAX / 2 ||
        values % nodes != 0)
      return false;
    record->box.first[k] = (int)first;
    record->box.nodes[k] = (int)nodes;
    values /= nodes;
  }
  return values == 1 && record->bytes % sizeof(float) == 0 && record->grid >= 0 &&
         record->array[FG__ARRAY_NAME_BYTES - 1] == '\0' &&
         fg__get_32(entry + FG__AT_ELEMENT) == FG__ELEMENT_FLOAT32;
}

/* Records follow each other from the preamble to the text: no byte is out of check. */
static fg_status take_table(fg__checkpoint_file *file, fg_context *context,
                            const unsigned char *table, uint64_t text_offset)
{
  uint64_t offset = FG__CHECKPOINT_FIRST_OFFSET;
  for (size_t n = 0; n < file->record_count; ++n) {
    fg__box_record *r = &file->record[n];
    bool sound = take_entry(r, table + n * FG__ENTRY_BYTES) && r->offset == offset &&
                 r->bytes <= text_offset - offset;
    if (!sound)
      return fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "%s: damaged: entry %zu of its table contradicts itself",
                      file->path, n);
    offset += r->bytes;
  }
  if (offset != text_offset)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: damaged: its records end at byte %llu, not %llu", file->path,
                    (unsigned long long)offset, (unsigned long long)text_offset);
  return FG_STATUS_OK;
}

static fg_status read_frame(fg__checkpoint_file *file, fg_context *context)
{
  struct stat about;
  if (fstat(file->file, &about) != 0)
    return fail_access(context, file->path);
  if (!S_ISREG(about.st_mode))
    return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: is no regular file", file->path);
  uint64_t bytes = (uint64_t)about.st_size;
  if (bytes < FG__PREAMBLE_BYTES)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: damaged: it has %llu bytes, at least %d are needed", file->path,
                    (unsigned long long)bytes, FG__PREAMBLE_BYTES);
  unsigned char preamble[FG__PREAMBLE_BYTES], *table = NULL;
  fg_status status = get(file, context, preamble, sizeof preamble, 0);
  if (!status)
    status = check_preamble(file, context, preamble, bytes);
  if (status)
    return status;
  uint64_t text_offset = fg__get_64(preamble + FG__AT_TEXT_OFFSET);
  uint64_t text_bytes = fg__get_64(preamble + FG__AT_TEXT_BYTES);
  uint64_t count = fg__get_64(preamble + FG__AT_RECORD_COUNT);
  if (text_offset < FG__PREAMBLE_BYTES || text_offset > bytes ||
      text_bytes > bytes - text_offset ||
      (bytes - text_offset - text_bytes) / FG__ENTRY_BYTES != count ||
      (bytes - text_offset - text_bytes) % FG__ENTRY_BYTES != 0)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: damaged: its preamble contradicts itself", file->path);
  file->identity = fg__get_32(preamble + FG__AT_PREAMBLE_CHECKSUM);
  size_t table_bytes = (size_t)count * FG__ENTRY_BYTES;
  file->record_count = (size_t)count;
  file->text = fg__allocate((size_t)text_bytes + 1, 1);
  file->record = fg__allocate(file->record_count, sizeof *file->record);
  file->share = fg__allocate(file->record_count, sizeof *file->share);
  table = fg__allocate(table_bytes, 1);
  if (!file->text || !file->record || !file->share || !table)
    status = fg__fail_memory(context, "the table of a checkpoint", table_bytes);
  if (!status)
    status = get(file, context, file->text, (size_t)text_bytes, text_offset);
  if (!status)
    status = check_sum(file->path, context, "text",
                       fg__checksum(0, file->text, (size_t)text_bytes),
                       fg__get_32(preamble + FG__AT_TEXT_CHECKSUM));
  if (!status)
    status = get(file, context, table, table_bytes, text_offset + text_bytes);
  if (!status)
    status = check_sum(file->path, context, "table", fg__checksum(0, table, table_bytes),
                       fg__get_32(preamble + FG__AT_TABLE_CHECKSUM));
  if (!status)
    status = take_table(file, context, table, text_offset);
  free(table);
  return status;
}

fg_status fg__checkpoint_read(fg__checkpoint_file *out, fg_context *context,
                              const char *path)
{
  *out = (fg__checkpoint_file){.file = -1};
  out->path = fg__copy_text(path);
  if (!out->path)
    return fg__fail_memory(context, "a file's name", strlen(path));
  /* not to be kept waiting by a pipe of that name */
  out->file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  fg_status status =
      out->file < 0 ? fail_access(context, path) : read_frame(out, context);
  if (status)
    fg__checkpoint_close(out);
  return status;
}

void fg__checkpoint_close(fg__checkpoint_file *file)
{
  if (file->file >= 0)
    close(file->file);
  free(file->path);
  free(file->text);
  free(file->record);
  free(file->share);
  *file = (fg__checkpoint_file){.file = -1};
}

/* Reads `length` values of a record from `at` bytes on; `values` NULL: for the sum only.
 */
static fg_status get_run(const fg__checkpoint_file *file, fg_context *context,
                         const fg__box_record *record, uint64_t at, float *values,
                         uint64_t length, fg__checksum_share *share)
{
  unsigned char chunk[FG__CHUNK_BYTES];
  for (uint64_t left = length * sizeof *values; left > 0;) {
    size_t bytes = left < sizeof chunk ? (size_t)left : sizeof chunk;
    fg_status status = get(file, context, chunk, bytes, record->offset + at);
    if (status)
      return status;
    fg__checksum_share_add(share, at, chunk, bytes);
    for (size_t n = 0; values && n < bytes; n += sizeof *values, ++values) {
      uint32_t bits = fg__get_32(chunk + n);
      memcpy(values, &bits, sizeof bits);
    }
    at += bytes;
    left -= bytes;
  }
  return FG_STATUS_OK;
}

/* This rank's part of a record's values. */
static fg_status verify_part(const fg__checkpoint_file *file, fg_context *context,
                             const fg__ranks *ranks, size_t n)
{
  const fg__box_record *record = &file->record[n];
  uint64_t values = record->bytes / sizeof(float), count = (uint64_t)ranks->count;
  uint64_t part = values / count + 1, first = part * (uint64_t)ranks->rank;
  if (first >= values)
    return FG_STATUS_OK;
  uint64_t length = values - first < part ? values - first : part;
  fg__checksum_share share = fg__checksum_share_of(record->bytes);
  fg_status status =
      get_run(file, context, record, first * sizeof(float), NULL, length, &share);
  file->share[n] ^= fg__checksum_share_sum(&share);
  return status;
}

fg_status fg__checkpoint_verify(const fg__checkpoint_file *file, fg_context *context,
                                const fg__ranks *ranks)
{
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; !status && n < file->record_count; ++n)
    status = verify_part(file, context, ranks, n);
  status = fg__ranks_agree(ranks, context, status);
  return status ? status : fg__checkpoint_check(file, context, ranks);
}

fg_status fg__checkpoint_check(const fg__checkpoint_file *file, fg_context *context,
                               const fg__ranks *ranks)
{
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < file->record_count; ++n) {
    const fg__box_record *r = &file->record[n];
    uint32_t sum = file->share[n];
    fg__ranks_combine(ranks, &sum, 1);
    sum ^= fg__checksum_of_zeros(r->bytes);
    file->share[n] = 0;
    char part[FG__ARRAY_NAME_BYTES + 80];
    snprintf(part, sizeof part, "values of '%s' from node (%d, %d, %d)", r->array,
             r->box.first[0], r->box.first[1], r->box.first[2]);
    if (!status)
      status = check_sum(file->path, context, part, sum, r->checksum);
  }
  return status;
}

fg_status fg__checkpoint_read_box(const fg__checkpoint_file *file, fg_context *context,
                                  const char *array, int grid, const fg__box *box,
                                  float *values)
{
  int64_t found = 0;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < file->record_count; ++n) {
    const fg__box_record *r = &file->record[n];
    if (r->grid != grid || strcmp(r->array, array) != 0)
      continue;
    fg__runs runs = fg__runs_of(&r->box, box);
    fg__checksum_share share = fg__checksum_share_of(r->bytes);
    for (int plane = 0; plane < runs.planes; ++plane)
      for (int row = 0; !status && row < runs.rows; ++row)
        status = get_run(
            file, context, r, sizeof *values * fg__run_at(&runs, &r->box, row, plane),
            values + fg__run_at(&runs, box, row, plane), runs.length, &share);
    if (status)
      return status;
    file->share[n] ^= fg__checksum_share_sum(&share);
    if (runs.rows > 0)
      found += fg__box_count(&runs.part);
  }
  if (found == fg__box_count(box))
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "%s: has the values of '%s' at %" PRId64 " of the %" PRId64
                  " nodes wanted of grid %d",
                  file->path, array, found, fg__box_count(box), grid);
}
