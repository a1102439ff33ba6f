#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/memory.h"
#include "evolution/checkpoint/layout.h"
#include "evolution/checkpoint/runs.h"
#include "file/checksum.h"

static fg_status fail(fg_context *context, const char *path)
{
  return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: cannot be written: %s", path,
                  strerror(errno));
}

static char *with_end(const char *path, const char *end)
{
  size_t bytes = strlen(path) + strlen(end) + 1;
  char *name = fg__allocate(bytes, 1);
  if (name)
    snprintf(name, bytes, "%s%s", path, end);
  return name;
}

fg_status fg__checkpoint_begin(fg__checkpoint_writer *out, fg_context *context,
                               const char *path, bool create)
{
  *out = (fg__checkpoint_writer){.path = path, .file = -1};
  out->part = with_end(path, ".part");
  if (!out->part)
    return fg__fail_memory(context, "a file's name", strlen(path));
  int flags = O_WRONLY | O_CLOEXEC | (create ? O_CREAT | O_TRUNC : 0);
  out->file = open(out->part, flags, 0666);
  if (out->file >= 0)
    return FG_STATUS_OK;
  fg_status status = fail(context, path);
  free(out->part);
  out->part = NULL;
  return status;
}

void fg__checkpoint_place(fg__box_record *records, size_t count)
{
  uint64_t offset = FG__CHECKPOINT_FIRST_OFFSET;
  for (size_t n = 0; n < count; ++n) {
    fg__box_record *r = &records[n];
    r->offset = offset;
    r->bytes = sizeof(float) * (uint64_t)fg__box_count(&r->box);
    r->checksum = 0;
    offset += r->bytes;
  }
}

static fg_status put(const fg__checkpoint_writer *writer, fg_context *context,
                     const unsigned char *bytes, size_t count, uint64_t offset)
{
  while (count > 0) {
    ssize_t done = pwrite(writer->file, bytes, count, (off_t)offset);
    if (done < 0 && errno == EINTR)
      continue;
    if (done <= 0)
      return fail(context, writer->path);
    bytes += done;
    count -= (size_t)done;
    offset += (uint64_t)done;
  }
  return FG_STATUS_OK;
}

/* `at`: bytes before the run in its record. */
static fg_status put_run(const fg__checkpoint_writer *writer, fg_context *context,
                         const fg__box_record *record, uint64_t at, const float *values,
                         size_t length, fg__checksum_share *share)
{
  unsigned char chunk[FG__CHUNK_BYTES];
  fg_status status = FG_STATUS_OK;
  for (size_t left = length * sizeof *values; !status && left > 0;) {
    size_t bytes = left < sizeof chunk ? left : sizeof chunk;
    for (size_t n = 0; n < bytes; n += sizeof *values) {
      uint32_t bits;
      memcpy(&bits, values++, sizeof bits);
      fg__put_32(chunk + n, bits);
    }
    fg__checksum_share_add(share, at, chunk, bytes);
    status = put(writer, context, chunk, bytes, record->offset + at);
    at += bytes;
    left -= bytes;
  }
  return status;
}

fg_status fg__checkpoint_write(fg__checkpoint_writer *writer, fg_context *context,
                               fg__box_record *record, const fg__box *box,
                               const float *values)
{
  fg__runs runs = fg__runs_of(&record->box, box);
  fg__checksum_share share = fg__checksum_share_of(record->bytes);
  fg_status status = FG_STATUS_OK;
  for (int plane = 0; plane < runs.planes; ++plane)
    for (int row = 0; !status && row < runs.rows; ++row)
      status = put_run(writer, context, record,
                       sizeof *values * fg__run_at(&runs, &record->box, row, plane),
                       values + fg__run_at(&runs, box, row, plane), runs.length, &share);
  record->checksum ^= fg__checksum_share_sum(&share);
  return status;
}

void fg__checkpoint_settle(fg__box_record *records, size_t count, const fg__ranks *ranks)
{
  for (size_t n = 0; n < count; ++n) {
    fg__ranks_combine(ranks, &records[n].checksum, 1);
    records[n].checksum ^= fg__checksum_of_zeros(records[n].bytes);
  }
}

/* Flushes the file to the disk, where the file system supports it. */
static bool synchronise(int file)
{
  return fsync(file) == 0 || errno == EINVAL || errno == ENOSYS;
}

static fg_status end(fg__checkpoint_writer *writer, fg_context *context, fg_status status)
{
  if (!status && !synchronise(writer->file))
    status = fail(context, writer->path);
  if (close(writer->file) != 0 && !status)
    status = fail(context, writer->path);
  writer->file = -1;
  return status;
}

fg_status fg__checkpoint_end_share(fg__checkpoint_writer *writer, fg_context *context,
                                   fg_status status)
{
  status = end(writer, context, status);
  free(writer->part);
  writer->part = NULL;
  return status;
}

static void fill_entry(unsigned char *entry, const fg__box_record *record)
{
  memset(entry, 0, FG__ENTRY_BYTES);
  memcpy(entry, record->array, FG__ARRAY_NAME_BYTES);
  fg__put_32(entry + FG__AT_GRID, (uint32_t)record->grid);
  fg__put_32(entry + FG__AT_ELEMENT, FG__ELEMENT_FLOAT32);
  for (int k = 0; k < 3; ++k) {
    fg__put_32(entry + FG__AT_FIRST + 4 * k, (uint32_t)record->box.first[k]);
    fg__put_32(entry + FG__AT_NODES + 4 * k, (uint32_t)record->box.nodes[k]);
  }
  fg__put_64(entry + FG__AT_OFFSET, record->offset);
  fg__put_64(entry + FG__AT_BYTES, record->bytes);
  fg__put_32(entry + FG__AT_CHECKSUM, record->checksum);
}

static fg_status write_frame(fg__checkpoint_writer *writer, fg_context *context,
                             const char *text, const fg__box_record *records,
                             size_t count)
{
  size_t table_bytes = count * FG__ENTRY_BYTES, text_bytes = strlen(text);
  unsigned char *table = fg__allocate(count, FG__ENTRY_BYTES);
  if (!table)
    return fg__fail_memory(context, "the table of a checkpoint", table_bytes);
  uint64_t text_offset = FG__CHECKPOINT_FIRST_OFFSET;
  for (size_t n = 0; n < count; ++n) {
    fill_entry(table + n * FG__ENTRY_BYTES, &records[n]);
    text_offset += records[n].bytes;
  }
  unsigned char preamble[FG__PREAMBLE_BYTES] = {0};
  memcpy(preamble, FG__CHECKPOINT_MAGIC, sizeof FG__CHECKPOINT_MAGIC - 1);
  fg__put_32(preamble + FG__AT_FORMAT, FG__CHECKPOINT_FORMAT);
  fg__put_64(preamble + FG__AT_FILE_BYTES, text_offset + text_bytes + table_bytes);
  fg__put_64(preamble + FG__AT_TEXT_OFFSET, text_offset);
  fg__put_64(preamble + FG__AT_TEXT_BYTES, text_bytes);
  fg__put_64(preamble + FG__AT_RECORD_COUNT, count);
  fg__put_32(preamble + FG__AT_TEXT_CHECKSUM, fg__checksum(0, text, text_bytes));
  fg__put_32(preamble + FG__AT_TABLE_CHECKSUM, fg__checksum(0, table, table_bytes));
  fg__put_32(preamble + FG__AT_PREAMBLE_CHECKSUM,
             fg__checksum(0, preamble, FG__AT_PREAMBLE_CHECKSUM));
  fg_status status =
      put(writer, context, (const unsigned char *)text, text_bytes, text_offset);
  if (!status)
    status = put(writer, context, table, table_bytes, text_offset + text_bytes);
  if (!status)
    status = put(writer, context, preamble, sizeof preamble, 0);
  free(table);
  return status;
}

/* "a/b" becomes "a", "a" becomes ".", "/a" becomes "/". End with free. */
static char *folder_of(const char *path)
{
  const char *slash = strrchr(path, '/');
  if (!slash)
    return fg__copy_text(".");
  char *folder = fg__copy_text(path);
  if (folder)
    folder[slash == path ? 1 : slash - path] = '\0';
  return folder;
}

/* A name is on the disk when its folder is. */
static void synchronise_folder(const char *folder)
{
  int file = open(folder, O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    synchronise(file);
    close(file);
  }
}

/* Whoever is killed between the two renames leaves the previous file alone, and whole. */
static fg_status take_name(const fg__checkpoint_writer *writer, fg_context *context)
{
  char *previous = with_end(writer->path, ".previous"), *folder = folder_of(writer->path);
  fg_status status = FG_STATUS_OK;
  if (!previous || !folder) {
    status = fg__fail_memory(context, "a file's name", strlen(writer->path));
  } else {
    bool moved = rename(writer->path, previous) == 0;
    if ((!moved && errno != ENOENT) || rename(writer->part, writer->path) != 0) {
      status = fail(context, writer->path);
      if (moved)
        (void)rename(previous, writer->path);
    }
  }
  if (!status)
    synchronise_folder(folder);
  free(previous);
  free(folder);
  return status;
}

fg_status fg__checkpoint_commit(fg__checkpoint_writer *writer, fg_context *context,
                                const char *text, const fg__box_record *records,
                                size_t count, fg_status status)
{
  if (!status)
    status = write_frame(writer, context, text, records, count);
  status = end(writer, context, status);
  if (!status)
    status = take_name(writer, context);
  if (status)
    unlink(writer->part);
  free(writer->part);
  writer->part = NULL;
  return status;
}
