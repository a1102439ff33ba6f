/* Checkpoint files: what is written by any division into ranks and boxes is read by any
 * other, and no damaged file is accepted. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context_test.h"
#include "evolution/checkpoint/file.h"
#include "file/checksum.h"

/* A grid of 7 x 5 x 3 nodes cut into three boxes, and a coarser one in a single box. */
enum { NX = 7, NY = 5, NZ = 3, COARSE_NX = 4, COARSE_NY = 2, BOXES = 3, RECORDS = 4 };
static const fg__box piece[BOXES] = {
    {{0, 0, 0}, {4, NY, 2}}, {{4, 0, 0}, {3, NY, 2}}, {{0, 0, 2}, {NX, NY, 1}}};
static const fg__box whole = {{0, 0, 0}, {NX, NY, NZ}};
static const fg__box coarse = {{0, 0, 0}, {COARSE_NX, COARSE_NY, 1}};
static const fg__ranks one = {.count = 1};
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

static void fill(float *values, uint32_t salt, const fg__box *box)
{
  const int *first = box->first, *nodes = box->nodes;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        *values++ = value_at(salt, first[0] + i, first[1] + j, first[2] + k);
}

static void describe(fg__box_record *record, const char *array, int grid,
                     const fg__box *box)
{
  *record = (fg__box_record){.grid = grid, .box = *box};
  strcpy(record->array, array);
}

/* Writes a box of a record's array; returns `status` or a failure. */
static fg_status put(fixture *f, fg__checkpoint_writer *writer, fg__box_record *record,
                     const fg__box *box, uint32_t salt, fg_status status)
{
  float values[NX * NY * NZ];
  fill(values, salt + (uint32_t)strlen(record->array), box);
  return status ? status : fg__checkpoint_write(writer, f->context, record, box, values);
}

/* What rank `rank` of three writes of four records: an array of the fine grid as a whole,
 * from boxes that are shared out, another one cut in two records, and one of the coarse
 * grid. With `alone` it writes everything, from whole arrays. */
static fg_status write_share(fixture *f, fg__checkpoint_writer *writer,
                             fg__box_record records[RECORDS], uint32_t salt, int rank,
                             bool alone)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < 3; ++n) {
    if (alone)
      status = put(f, writer, &records[n], &whole, salt, status);
    for (int b = 0; !alone && b < BOXES; ++b)
      if ((b + n) % 3 == rank)
        status = put(f, writer, &records[n], &piece[b], salt, status);
  }
  if (alone || rank == 2)
    status = put(f, writer, &records[3], &coarse, salt, status);
  return status;
}

static void describe_all(fg__box_record records[RECORDS])
{
  static const fg__box lower = {{0, 0, 0}, {NX, 2, NZ}};
  static const fg__box upper = {{0, 2, 0}, {NX, NY - 2, NZ}};
  describe(&records[0], "current", 0, &whole);
  describe(&records[1], "previous", 0, &lower);
  describe(&records[2], "previous", 0, &upper);
  describe(&records[3], "defect", 1, &coarse);
  fg__checkpoint_place(records, RECORDS);
}

static fg_status write_alone(fixture *f, uint32_t salt)
{
  fg__box_record records[RECORDS];
  describe_all(records);
  fg__checkpoint_writer writer;
  fg_status status = fg__checkpoint_begin(&writer, f->context, f->path, true);
  if (status)
    return status;
  status = write_share(f, &writer, records, salt, 0, true);
  fg__checkpoint_settle(records, RECORDS, &one);
  return fg__checkpoint_commit(&writer, f->context, text, records, RECORDS, status);
}

/* Three ranks that write in an order of their own. */
static fg_status write_file(fixture *f, uint32_t salt, fg_status outcome)
{
  static const int order[3] = {2, 0, 1};
  fg__checkpoint_writer writer[3];
  fg__box_record records[3][RECORDS];
  fg_status status = FG_STATUS_OK;
  for (int rank = 0; rank < 3; ++rank) {
    describe_all(records[rank]);
    status = fg__checkpoint_begin(&writer[rank], f->context, f->path, rank == 0);
    if (status)
      return status;
  }
  for (int turn = 0; turn < 3; ++turn) {
    int rank = order[turn];
    status = write_share(f, &writer[rank], records[rank], salt, rank, false);
    if (rank > 0)
      status = fg__checkpoint_end_share(&writer[rank], f->context, status);
  }
  for (int n = 0; n < RECORDS; ++n)
    records[0][n].checksum ^= records[1][n].checksum ^ records[2][n].checksum;
  fg__checkpoint_settle(records[0], RECORDS, &one);
  return fg__checkpoint_commit(&writer[0], f->context, text, records[0], RECORDS,
                               status ? status : outcome);
}

static void holds_array(fixture *f, const fg__checkpoint_file *file, const char *array,
                        int grid, uint32_t salt, const fg__box *box)
{
  float values[NX * NY * NZ], expected[NX * NY * NZ];
  assert_int_equal(fg__checkpoint_read_box(file, f->context, array, grid, box, values),
                   FG_STATUS_OK);
  fill(expected, salt + (uint32_t)strlen(array), box);
  assert_memory_equal(values, expected, (size_t)fg__box_count(box) * sizeof *values);
}

/* The file at `path` holds what write_file wrote with this salt. */
static void holds(fixture *f, const char *path, uint32_t salt)
{
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, path), FG_STATUS_OK);
  assert_string_equal(file.text, text);
  assert_int_equal(file.record_count, RECORDS);
  assert_int_equal(fg__checkpoint_verify(&file, f->context, &one), FG_STATUS_OK);
  static const fg__box box[] = {{{2, 1, 1}, {4, 3, 2}},
                                {{6, 4, 2}, {1, 1, 1}},
                                {{3, 0, 0}, {2, NY, 1}},
                                {{0, 1, 0}, {NX, 3, 2}}};
  for (int n = 0; n < 4; ++n) {
    holds_array(f, &file, "current", 0, salt, &box[n]);
    holds_array(f, &file, "previous", 0, salt, &box[n]);
  }
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

static unsigned char *slurp(const char *path, size_t *count);

static void the_bytes_do_not_tell_the_ranks(void **state)
{
  fixture *f = *state;
  size_t count[2];
  unsigned char first[8192];
  assert_int_equal(write_alone(f, 1), FG_STATUS_OK);
  memcpy(first, slurp(f->path, &count[0]), sizeof first);
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  const unsigned char *second = slurp(f->path, &count[1]);
  assert_int_equal(count[0], count[1]);
  assert_memory_equal(first, second, count[0]);
}

/* Reads all arrays, one box of one of them so many times. */
static fg_status check_after(fixture *f, const fg__checkpoint_file *file, int times)
{
  for (int b = 0; b < BOXES; ++b) {
    holds_array(f, file, "current", 0, 1, &piece[b]);
    for (int n = 0; n < (b == 1 ? times : 1); ++n)
      holds_array(f, file, "previous", 0, 1, &piece[b]);
  }
  holds_array(f, file, "defect", 1, 1, &coarse);
  fg_status status = fg__checkpoint_check(file, f->context, &one);
  fg_context_clear(f->context);
  return status;
}

static void what_was_read_is_checked(void **state)
{
  fixture *f = *state;
  assert_int_equal(write_file(f, 1, FG_STATUS_OK), FG_STATUS_OK);
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(check_after(f, &file, 1), FG_STATUS_OK);
  assert_int_equal(check_after(f, &file, 0), FG_STATUS_FILE_FORMAT);
  assert_int_equal(check_after(f, &file, 2), FG_STATUS_FILE_FORMAT);
  assert_int_equal(check_after(f, &file, 1), FG_STATUS_OK);
  /* spoilt behind our back */
  FILE *stream = fopen(f->path, "r+b");
  assert_non_null(stream);
  assert_int_equal(fseek(stream, 64 + NX * NY * NZ * 4 + 5, SEEK_SET), 0);
  assert_int_equal(fputc(77, stream), 77);
  assert_int_equal(fclose(stream), 0);
  float values[NX * NY * NZ];
  static const char *const names[] = {"current", "previous"};
  for (int n = 0; n < 2; ++n)
    assert_int_equal(
        fg__checkpoint_read_box(&file, f->context, names[n], 0, &whole, values),
        FG_STATUS_OK);
  holds_array(f, &file, "defect", 1, 1, &coarse);
  assert_int_equal(fg__checkpoint_check(&file, f->context, &one), FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(f->context), "values of 'previous'"));
  fg__checkpoint_close(&file);
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
    status = fg__checkpoint_verify(&file, f->context, &one);
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
  static const fg__box wide = {{0, 0, 1}, {NX + 1, NY, 1}}, corner = {{0}, {1, 1, 1}};
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "current", 0, &wide, values),
      FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(f->context), "35 of the 40 nodes"));
  fg_context_clear(f->context);
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "energy", 0, &corner, values),
      FG_STATUS_FILE_FORMAT);
  fg__checkpoint_close(&file);
}

/* More than one chunk of 64 KiB, with rows that cross its end. */
static void a_large_box(void **state)
{
  fixture *f = *state;
  const fg__box box = {{5, 0, 0}, {1021, 67, 1}};
  size_t count = (size_t)fg__box_count(&box);
  float *values = malloc(count * sizeof *values);
  assert_non_null(values);
  for (size_t n = 0; n < count; ++n)
    values[n] = (float)n;
  fg__box_record record;
  describe(&record, "current", 0, &box);
  fg__checkpoint_place(&record, 1);
  fg__checkpoint_writer writer;
  assert_int_equal(fg__checkpoint_begin(&writer, f->context, f->path, true),
                   FG_STATUS_OK);
  fg_status status = fg__checkpoint_write(&writer, f->context, &record, &box, values);
  fg__checkpoint_settle(&record, 1, &one);
  assert_int_equal(fg__checkpoint_commit(&writer, f->context, text, &record, 1, status),
                   FG_STATUS_OK);
  fg__checkpoint_file file;
  assert_int_equal(fg__checkpoint_read(&file, f->context, f->path), FG_STATUS_OK);
  const fg__box part = {{100, 10, 0}, {900, 50, 1}};
  memset(values, 0, count * sizeof *values);
  assert_int_equal(
      fg__checkpoint_read_box(&file, f->context, "current", 0, &part, values),
      FG_STATUS_OK);
  for (int j = 0; j < 50; ++j)
    for (int i = 0; i < 900; ++i)
      assert_true(values[j * 900 + i] == (float)((10 + j) * 1021 + 100 + i - 5));
  fg__checkpoint_close(&file);
  free(values);
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(any_ranks_any_boxes),         CASE(the_bytes_do_not_tell_the_ranks),
      CASE(what_was_read_is_checked),    CASE(the_previous_one_is_kept),
      CASE(a_failure_changes_nothing),   CASE(a_name_that_can_not_be_taken),
      CASE(every_truncation_is_refused), CASE(every_changed_byte_is_refused),
      CASE(lying_numbers_are_refused),   CASE(what_is_no_file_is_refused),
      CASE(boxes_that_are_not_covered),  CASE(a_large_box),
  };
  return cmocka_run_group_tests_name("evolution/checkpoint/file", tests, NULL, NULL);
}
