#include "report/table.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Rows are buffered up to this size. */
enum { ENOUGH_BYTES = 1 << 16, ROW_BYTES = 512 };

static const char heading[] = "step,t,tau,energy,chemical_energy,gradient_energy,mass,"
                              "area_fraction,clusters,cycles,"
                              "cells,seconds\n";

static bool append(cli_table *table, const char *text, size_t bytes)
{
  if (table->capacity - table->used < bytes) {
    size_t capacity = 2 * (table->capacity + ENOUGH_BYTES);
    char *larger = realloc(table->rows, capacity);
    if (!larger) {
      complain("out of memory: %zu bytes for evolution.csv", capacity);
      return false;
    }
    table->rows = larger;
    table->capacity = capacity;
  }
  memcpy(table->rows + table->used, text, bytes);
  table->used += bytes;
  return true;
}

static int begin(cli_table *out, char *path)
{
  *out = (cli_table){.path = path, .file = -1};
  return path ? EXIT_DONE : complain_of_memory("a file's name");
}

int table_start(cli_table *out, char *path)
{
  int code = begin(out, path);
  if (code)
    return code;
  out->file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out->file < 0)
    return complain_of_file(path, "cannot be written");
  return append(out, heading, sizeof heading - 1) ? EXIT_DONE : EXIT_FAILED;
}

/* On a full disk the first write is short; only the next one sets errno. */
static bool write_all(int file, const char *bytes, size_t count)
{
  while (count > 0) {
    ssize_t put = write(file, bytes, count);
    if (put < 0 && errno != EINTR)
      return false;
    bytes += put > 0 ? put : 0;
    count -= put > 0 ? (size_t)put : 0;
  }
  return true;
}

/* Another version may have other columns. */
static int check_heading(const char *path, int source)
{
  char begin[sizeof heading - 1];
  ssize_t got = pread(source, begin, sizeof begin, 0);
  if (got < 0)
    return complain_of_file(path, "cannot be read");
  if ((size_t)got < sizeof begin || memcmp(begin, heading, sizeof begin) == 0)
    return EXIT_DONE; /* copy_start reports a file that is too short */
  complain("%s: has the columns of another version of flowgrain", path);
  advise("Start anew with --force.");
  return EXIT_FAILED;
}

/* Copies the first `bytes` bytes. */
static int copy_start(const char *to, const char *from, long long bytes)
{
  int source = open(from, O_RDONLY | O_CLOEXEC);
  if (source < 0)
    return complain_of_file(from, "cannot be read");
  int code = check_heading(from, source), target = -1;
  if (!code) {
    target = open(to, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (target < 0)
      code = complain_of_file(to, "cannot be written");
  }
  char chunk[1 << 14];
  for (long long left = bytes; !code && left > 0;) {
    size_t wanted = left < (long long)sizeof chunk ? (size_t)left : sizeof chunk;
    ssize_t got = read(source, chunk, wanted);
    if (got <= 0) {
      complain("%s: damaged: it ends %lld bytes before the checkpoint's last row", from,
               left);
      code = EXIT_FAILED;
    } else if (!write_all(target, chunk, (size_t)got))
      code = complain_of_file(from, "cannot be written");
    left -= got;
  }
  if (target >= 0 && close(target) != 0 && !code)
    code = complain_of_file(from, "cannot be written");
  close(source);
  return code;
}

int table_resume(cli_table *out, char *path, long long bytes)
{
  int code = begin(out, path);
  char *part = code ? NULL : join_texts(path, ".part");
  if (!part)
    return EXIT_FAILED;
  code = copy_start(part, path, bytes);
  if (!code && rename(part, path) != 0)
    code = complain_of_file(path, "cannot be written");
  if (code)
    unlink(part);
  free(part);
  if (code)
    return code;
  out->bytes = bytes;
  out->file = open(path, O_WRONLY | O_CLOEXEC);
  return out->file < 0 ? complain_of_file(path, "cannot be written") : EXIT_DONE;
}

int table_add(cli_table *table, const fg_step *step)
{
  char row[ROW_BYTES];
  int bytes = snprintf(
      row, sizeof row,
      "%" PRId64 ",%.9g,%.9g,%.12g,%.12g,%.12g,%.12g,%.6g,%d,%d,%" PRId64 ",%.6f\n",
      step->step, step->time, step->tau, step->energy, step->chemical_energy,
      step->gradient_energy, step->mass, step->area_fraction, step->clusters,
      step->cycles, step->cells, step->seconds);
  if (!append(table, row, (size_t)bytes))
    return EXIT_FAILED;
  if (table->used >= ENOUGH_BYTES)
    table_flush(table, false); /* a failed write is repeated later */
  return EXIT_DONE;
}

bool table_flush(cli_table *table, bool to_disk)
{
  for (size_t done = 0; done < table->used;) {
    ssize_t put = pwrite(table->file, table->rows + done, table->used - done,
                         (off_t)(table->bytes + (long long)done));
    if (put < 0 && errno == EINTR)
      continue;
    if (put < 0)
      return false;
    done += (size_t)put;
  }
  table->bytes += (long long)table->used;
  table->used = 0;
  return !to_disk || fsync(table->file) == 0 || errno == EINVAL || errno == ENOSYS;
}

void table_close(cli_table *table)
{
  if (table->file >= 0)
    close(table->file);
  free(table->path);
  free(table->rows);
  *table = (cli_table){.file = -1};
}
