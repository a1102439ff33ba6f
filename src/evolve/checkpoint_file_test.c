/* Checkpoint files: what is written by any division into ranks and boxes is read by any
 * other, and no damaged file is accepted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/checksum.h"
#include "evolve/checkpoint_file.h"

/* A grid of 7 x 5 x 3 nodes cut into three boxes, and a coarser one in a single box. */
enum { NX = 7, NY = 5, NZ = 3, COARSE_NX = 4, COARSE_NY = 2, BOXES = 3, RECORDS = 7 };
static const int box_first[BOXES][3] = {{0, 0, 0}, {4, 0, 0}, {0, 0, 2}};
static const int box_nodes[BOXES][3] = {{4, NY, 2}, {3, NY, 2}, {NX, NY, 1}};
static const char text[] = "time 3fb999999999999a\n\n{\"note\":1}";

typedef struct fixture {
  fg_context *context;
  char folder[64], path[96], previous[128], part[128];
} fixture;

static int set_up(void **state)
{
  static fixture f;
  memset(&f, 0, sizeof f);
  strcpy(f.folder, "/tmp/flowgrain-checkpoint-XXXXXX");
  if (!mkdtemp(f.folder))
    return 1;
  snprintf(f.path, sizeof f.path, "%s/checkpoint", f.folder);
  snprintf(f.previous, sizeof f.previous, "%s.previous", f.path);
  snprintf(f.part, sizeof f.part, "%s.part", f.path);
  *state = &f;
  return fg_context_create(&f.context) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  fixture *f = *state;
  unlink(f->path);
  unlink(f->previous);
  unlink(f->part);
  fg_context_destroy(f->context);
  return rmdir(f->folder);
}

static bool is_there(const char *path)
{
  struct stat about;
  return lstat(path, &about) == 0;
}

/* Some bits for every node, so that signalling NaNs, infinities and -0 come too. */
static float value_at(uint32_t salt, int i, int j, int k)
{
  uint32_t n = (uint32_t)(i + NX * (j + NY * k));
  uint32_t bits = (n + salt) * 2654435761U;
  if (n % 11 == 0)
    bits = 0x7f800001U + n; /* a signalling NaN */
  if (n % 13 == 1)
    bits = 0x80000000U;
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static void fill(float *values, uint32_t salt, const int first[3], const int nodes[3])
{
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        *values++ = value_at(salt, first[0] + i, first[1] + j, first[2] + k);
}

static void describe(fg__box_record *record, const char *array, int grid,
                     const int first[3], const int nodes[3])
{
  *record = (fg__box_record){.grid = grid};
  strcpy(record->array, array);
  memcpy(record->first, first, sizeof record->first);
  memcpy(record->nodes, nodes, sizeof record->nodes);
}

/* Two arrays of the fine grid in BOXES boxes and one of the coarse grid, shared out to
 * three ranks that write in an order of their own. */
static fg_status write_file(fixture *f, uint32_t salt, fg_status outcome)
{
  static const int shares[4] = {0, 2, 3, RECORDS}, order[3] = {2, 0, 1};
  const int origin[3] = {0}, coarse[3] = {COARSE_NX, COARSE_NY, 1};
  fg__box_record records[RECORDS];
  for (int n = 0; n < 2 * BOXES; ++n)
    describe(&records[n], n % 2 ? "previous" : "current", 0, box_first[n / 2],
             box_nodes[n / 2]);
  describe(&records[RECORDS - 1], "defect", 1, origin, coarse);
  uint64_t offset = FG__CHECKPOINT_FIRST_OFFSET;
  for (int rank = 0; rank < 3; ++rank)
    offset = fg__checkpoint_place(records + shares[rank],
                                  (size_t)(shares[rank + 1] - shares[rank]), offset);
  fg__checkpoint_writer writer[3];
  fg_status status = FG_STATUS_OK;
  for (int rank = 0; rank < 3; ++rank) {
    status = fg__checkpoint_begin(&writer[rank], f->context, f->path, rank == 0);
    if (status)
      return status;
  }
  for (int turn = 0; turn < 3; ++turn) {
    int rank = order[turn];
    for (int n = shares[rank]; !status && n < shares[rank + 1]; ++n) {
      float values[NX * NY * NZ];
      fill(values, salt + (uint32_t)strlen(records[n].array), records[n].first,
           records[n].nodes);
      status = fg__checkpoint_write(&writer[rank], f->context, &records[n], values);
    }
    if (rank > 0)
      status = fg__checkpoint_end_share(&writer[rank], f->context, status);
  }
  return fg__checkpoint_commit(&writer[0], f->context, text, records, RECORDS,
                               status ? status : outcome);
}

static void holds_array(fixture *f, const fg__checkpoint_file *file, const char *array,
                        int grid, uint32_t salt, const int first[3], const int nodes[3])
{
  float values[NX * NY * NZ], expected[NX * NY * NZ];
  size_t bytes = (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2] * sizeof *values;
  assert_int_equal(
      fg__checkpoint_read_box(file, f->context, array, grid, first, nodes, values),
      FG_STATUS_OK);
  fill(expected, salt + (uint32_t)strlen(array), first, nodes);
  assert_memory_equal(values, expected, bytes);
}

/* The file at `path` holds what write_file wrote with this salt. */
static void holds(fixture *f, const char *path, uint32_t salt)
{
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, path), FG_STATUS_OK);
  assert_string_equal(file.text, text);
  assert_int_equal(file.record_count, RECORDS);
  assert_int_equal(fg__checkpoint_verify(&file, f->context, 0, RECORDS), FG_STATUS_OK);
  static const int first[][3] = {{0, 0, 0}, {2, 1, 1}, {6, 4, 2}, {3, 0, 0}};
  static const int nodes[][3] = {{NX, NY, NZ}, {4, 3, 2}, {1, 1, 1}, {2, NY, 1}};
  for (int n = 0; n < 4; ++n) {
    holds_array(f, &file, "current", 0, salt, first[n], nodes[n]);
    holds_array(f, &file, "previous", 0, salt, first[n], nodes[n]);
  }
  const int origin[3] = {0}, coarse[3] = {COARSE_NX, COARSE_NY, 1};
  holds_array(f, &file, "defect", 1, salt, origin, coarse);
  fg__checkpoint_close(&file);
}

static void any_ranks_any_boxes(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  holds(f, f->path, 1);
  assert_false(is_there(f->part));
  assert_false(is_there(f->previous));
}

static void the_previous_one_is_kept(void **state)
{
  fixture *f = *state;
  for (uint32_t salt = 1; salt <= 3; ++salt)
    assert_int_equal(write_file(f, salt, FG_STATUS_OK), FG_STATUS_OK);
  holds(f, f->path, 3);
  holds(f, f->previous, 2);
}

static void a_failure_changes_nothing(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  assert_int_equal(write_file(f, 2, FG_STATUS_MPI), FG_STATUS_MPI);
  holds(f, f->path, 1);
  assert_false(is_there(f->part));
  assert_false(is_there(f->previous));
}

static void a_name_that_can_not_be_taken(void **state)
{
  fixture *f = *state;
  char inside[160];
  snprintf(inside, sizeof inside, "%s/inside", f->previous);
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  assert_int_equal(mkdir(f->previous, 0777), 0); /* which no file can replace */
  assert_int_equal(mkdir(inside, 0777), 0);
  assert_int_equal(write_file(f, 2, FG_STATUS_OK), FG_STATUS_FILE_ACCESS);
  assert_non_null(strstr(fg_context_message(f->context), f->path));
  assert_int_equal(rmdir(inside), 0);
  assert_int_equal(rmdir(f->previous), 0);
  holds(f, f->path, 1);
  assert_false(is_there(f->part));
}

/* Reads a file as a resumed run would, and says what comes of it. */
static fg_status read_whole(fixture *f, const char *path)
{
  fg__checkpoint_file file;
  fg_status status = fg__checkpoint_read(&file, f->context, path);
  if (!status)
    status = fg__checkpoint_verify(&file, f->context, 0, file.record_count);
  fg__checkpoint_close(&file);
  return status;
}

static void is_refused(fixture *f, const unsigned char *bytes, size_t count,
                       const char *how, size_t at)
{
  unlink(f->path); /* file systems hasten to write what replaces a content */
  FILE *stream = fopen(f->path, "wb");
  assert_non_null(stream);
  assert_int_equal(fwrite(bytes, 1, count, stream), count);
  assert_int_equal(fclose(stream), 0);
  fg_status status = read_whole(f, f->path);
  const char *message = fg_context_message(f->context);
  bool named = strstr(message, f->path) == message;
  bool said = strstr(message, "damaged") || strstr(message, "is no checkpoint");
  if (status != FG_STATUS_FILE_FORMAT || !named || !said)
    fail_msg("%s at byte %zu: status %d, \"%s\"", how, at, status, message);
  fg_context_clear(f->context);
}

static unsigned char *slurp(const char *path, size_t *count)
{
  static unsigned char bytes[8192];
  FILE *stream = fopen(path, "rb");
  assert_non_null(stream);
  *count = fread(bytes, 1, sizeof bytes, stream);
  assert_true(*count < sizeof bytes);
  fclose(stream);
  return bytes;
}

static void every_truncation_is_refused(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  size_t count;
  unsigned char *bytes = slurp(f->path, &count);
  for (size_t n = 0; n < count; ++n)
    is_refused(f, bytes, n, "truncated", n);
  bytes[count] = 0;
  is_refused(f, bytes, count + 1, "one byte too many", count);
}

static void every_changed_byte_is_refused(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  size_t count;
  unsigned char *bytes = slurp(f->path, &count);
  for (size_t n = 0; n < count; ++n) {
    unsigned char kept = bytes[n];
    for (int bit = 0; bit < 8; ++bit) {
      bytes[n] = (unsigned char)(kept ^ (1U << bit));
      is_refused(f, bytes, count, "a bit flipped", n);
    }
    bytes[n] = (unsigned char)~kept;
    is_refused(f, bytes, count, "a byte inverted", n);
    bytes[n] = kept;
  }
  for (size_t n = 0; n + 512 <= count; n += 37) { /* a lost sector */
    unsigned char kept[512];
    memcpy(kept, bytes + n, sizeof kept);
    memset(bytes + n, 0, sizeof kept);
    is_refused(f, bytes, count, "zeroed", n);
    memcpy(bytes + n, kept, sizeof kept);
  }
}

/* A preamble whose checksum is right and whose numbers are not. */
static void lying_numbers_are_refused(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  size_t count;
  unsigned char *bytes = slurp(f->path, &count);
  static const uint64_t lies[] = {0, 1, 63, 1U << 20, UINT64_MAX, UINT64_MAX / 80 + 1};
  for (size_t place = 16; place < 48; place += 8)
    for (size_t n = 0; n < sizeof lies / sizeof lies[0]; ++n) {
      unsigned char kept[64];
      memcpy(kept, bytes, sizeof kept);
      for (int k = 0; k < 8; ++k)
        bytes[place + (size_t)k] = (unsigned char)(lies[n] >> (8 * k));
      uint32_t sum = fg__checksum(0, bytes, 60);
      for (int k = 0; k < 4; ++k)
        bytes[60 + k] = (unsigned char)(sum >> (8 * k));
      is_refused(f, bytes, count, "a lie", place);
      memcpy(bytes, kept, sizeof kept);
    }
}

static void what_is_no_file_is_refused(void **state)
{
  fixture *f = *state;
  assert_int_equal(read_whole(f, f->path), FG_STATUS_FILE_ACCESS);
  fg_context_clear(f->context);
  assert_int_equal(read_whole(f, f->folder), FG_STATUS_FILE_ACCESS);
  fg_context_clear(f->context);
  assert_int_equal(mkfifo(f->path, 0600), 0);
  assert_int_equal(read_whole(f, f->path), FG_STATUS_FILE_ACCESS);
  assert_non_null(strstr(fg_context_message(f->context), "no regular file"));
}

static void boxes_that_are_not_covered(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, f->path), FG_STATUS_OK);
  float values[(NX + 1) * NY];
  static const int first[3] = {0, 0, 1}, nodes[3] = {NX + 1, NY, 1};
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "current", 0, first, nodes, values),
      FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(f->context), "35 of the 40 nodes"));
  fg_context_clear(f->context);
  const int one[3] = {1, 1, 1};
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "energy", 0, first, one, values),
      FG_STATUS_FILE_FORMAT);
  fg__checkpoint_close(&file);
}

/* More than one chunk of 64 KiB, with rows that cross its end. */
static void a_large_box(void **state)
{
  fixture *f = *state;
  const int first[3] = {5, 0, 0}, nodes[3] = {1021, 67, 1};
  size_t count = (size_t)nodes[0] * (size_t)nodes[1];
  float *values = malloc(count * sizeof *values);
  assert_non_null(values);
  for (size_t n = 0; n < count; ++n)
    values[n] = (float)n;
  fg__box_record record;
  describe(&record, "current", 0, first, nodes);
  fg__checkpoint_place(&record, 1, FG__CHECKPOINT_FIRST_OFFSET);
  fg__checkpoint_writer writer;
  assert_int_equal(fg__checkpoint_begin(&writer, f->context, f->path, true),
                   FG_STATUS_OK);
  fg_status status = fg__checkpoint_write(&writer, f->context, &record, values);
  assert_int_equal(fg__checkpoint_commit(&writer, f->context, text, &record, 1, status),
                   FG_STATUS_OK);
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, f->path), FG_STATUS_OK);
  const int corner[3] = {100, 10, 0}, size[3] = {900, 50, 1};
  memset(values, 0, count * sizeof *values);
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "current", 0, corner, size, values),
      FG_STATUS_OK);
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i)
      assert_true(values[j * size[0] + i] ==
                  (float)((corner[1] + j) * nodes[0] + corner[0] + i - first[0]));
  fg__checkpoint_close(&file);
  free(values);
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(any_ranks_any_boxes),         CASE(the_previous_one_is_kept),
      CASE(a_failure_changes_nothing),   CASE(a_name_that_can_not_be_taken),
      CASE(every_truncation_is_refused), CASE(every_changed_byte_is_refused),
      CASE(lying_numbers_are_refused),   CASE(what_is_no_file_is_refused),
      CASE(boxes_that_are_not_covered),  CASE(a_large_box),
  };
  return cmocka_run_group_tests_name("evolve/checkpoint_file", tests, NULL, NULL);
}
