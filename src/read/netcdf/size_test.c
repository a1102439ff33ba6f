#include "decode/source.h"
#include "read/netcdf/sample_example.h"

enum { NX = 5, NY = 3, RECORDS = 2, COUNT = NX * NY };

/* Two components in records, with a fixed variable before and odd-sized ones between, so
 * that every kind of padding occurs; no sample is zero. */
static void make(sample_file *f, int mode, bool records)
{
  static const double x[NX] = {1.5, 2.0, 4.0, 4.5, 7.0};
  static const double y[NY] = {-3.0, -1.0, 0.5};
  double values[RECORDS * COUNT];
  sample_begin(f, mode);
  const int dimension_y = sample_axis(f, "y", NY, y, "m");
  const int dimension_x = sample_axis(f, "x", NX, x, "m");
  const int time = sample_dimension(f, "time", records ? NC_UNLIMITED : RECORDS);
  const int all[3] = {time, dimension_y, dimension_x};
  const int flag = sample_variable(f, "flag", NC_BYTE, 3, all);
  const int u = sample_variable(f, "u", NC_SHORT, 3, all);
  const int v = sample_variable(f, "v", NC_SHORT, 3, all);
  for (int i = 0; i < RECORDS * COUNT; ++i)
    values[i] = 90 + i;
  const size_t start[3] = {0, 0, 0};
  const size_t count[3] = {RECORDS, NY, NX};
  sample_write(f);
  nc_must(nc_put_vara_double(f->id, flag, start, count, values));
  nc_must(nc_put_vara_double(f->id, u, start, count, values));
  for (int i = 0; i < RECORDS * COUNT; ++i)
    values[i] = -200 - 3 * i;
  nc_must(nc_put_vara_double(f->id, v, start, count, values));
  sample_end(f);
}

static unsigned char *load(const char *path, size_t *size)
{
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  unsigned char *bytes = malloc(1 << 16);
  assert_non_null(bytes);
  *size = fread(bytes, 1, 1 << 16, file);
  assert_true(*size > 0 && *size < 1 << 16);
  fclose(file);
  return bytes;
}

static void store(const char *path, const unsigned char *bytes, size_t size)
{
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
}

static fg_status read_last_record(sample_file *f, fg_field **field)
{
  const fg_read_options options = {.time = RECORDS - 1};
  *field = NULL;
  fg_context_clear(f->context);
  return fg_field_read(field, f->context, f->path, &options);
}

/* The same for bytes in memory: thousands of files on disk would be slow. */
static fg_status read_bytes(sample_file *f, const unsigned char *bytes, size_t size,
                            fg_field **field)
{
  const fg_read_options options = {.time = RECORDS - 1};
  const fg__source source = {.path = f->path, .bytes = bytes, .size = size};
  const fg__format *format = fg__format_find(bytes, size);
  *field = NULL;
  fg_context_clear(f->context);
  return format ? fg__dataset_read(field, f->context, format, &source, &options,
                                   (fg__slab_index){0, 1})
                : fg__fail(f->context, FG_STATUS_FILE_FORMAT, "%s: unknown", f->path);
}

/* Each truncated file is refused, or reads the same as the whole file. */
static void check_truncations(sample_file *f, size_t step)
{
  size_t size;
  unsigned char *bytes = load(f->path, &size);
  fg_field *whole;
  assert_int_equal(read_last_record(f, &whole), FG_STATUS_OK);
  size_t refused = 0;
  for (size_t length = 0; length < size; length += step) {
    fg_field *field;
    const bool on_disk = length % 61 == 0;
    if (on_disk)
      store(f->path, bytes, length);
    const fg_status status =
        on_disk ? read_last_record(f, &field) : read_bytes(f, bytes, length, &field);
    if (status == FG_STATUS_OK) {
      for (int k = 0; k < 2; ++k)
        assert_memory_equal(fg_field_contents(field)->velocity[k],
                            fg_field_contents(whole)->velocity[k], COUNT * sizeof(float));
      fg_field_destroy(field);
      continue;
    }
    assert_int_equal(status, FG_STATUS_FILE_FORMAT);
    assert_null(field);
    assert_non_null(strstr(fg_context_message(f->context), f->path));
    ++refused;
  }
  /* only the padding after the last variable may be lost */
  assert_true(refused * step + 4 * step >= size);
  fg_field_destroy(whole);
  free(bytes);
}

static void truncated_classic_files_are_refused(void **state)
{
  static const int mode[] = {0, NC_64BIT_OFFSET, NC_64BIT_DATA};
  for (size_t i = 0; i < sizeof mode / sizeof *mode; ++i) {
    make(*state, mode[i], true);
    check_truncations(*state, 1);
    make(*state, mode[i], false);
    check_truncations(*state, 1);
  }
}

/* Bytes inserted after the header, which shift the data, or at the end. Additional whole
 * records are those of a file that was not closed. */
static void lengthened_classic_files_are_refused(void **state)
{
  static const size_t more[] = {4, 16, 64};
  sample_file *f = *state;
  for (int records = 0; records < 2; ++records)
    for (size_t i = 0; i < sizeof more / sizeof *more; ++i)
      for (int middle = 0; middle < 2; ++middle) {
        size_t size;
        fg_field *field;
        make(f, 0, records == 1);
        unsigned char *bytes = load(f->path, &size);
        unsigned char *longer = malloc(size + more[i]);
        assert_non_null(longer);
        memset(longer, 7, size + more[i]);
        const size_t at = middle ? size - COUNT : size;
        memcpy(longer, bytes, at);
        memcpy(longer + at + more[i], bytes + at, size - at);
        assert_int_equal(read_bytes(f, longer, size + more[i], &field),
                         FG_STATUS_FILE_FORMAT);
        assert_non_null(
            strstr(fg_context_message(f->context), "damaged: its data end at"));
        free(longer);
        free(bytes);
      }
}

/* libnetcdf moves data by blocks of 8192 bytes where a header grows, and leaves the rest
 * of the last behind them. */
static void zeros_behind_the_data_are_passed_over(void **state)
{
  static const size_t more[] = {4, 64, 6000};
  sample_file *f = *state;
  for (int records = 0; records < 2; ++records)
    for (size_t i = 0; i < sizeof more / sizeof *more; ++i) {
      size_t size;
      fg_field *field;
      make(f, 0, records == 1);
      unsigned char *bytes = load(f->path, &size);
      memset(bytes + size, 0, more[i]);
      assert_int_equal(read_bytes(f, bytes, size + more[i], &field), FG_STATUS_OK);
      const fg_field_arrays *a = fg_field_contents(field);
      assert_true(a->velocity[0][0] == 90.0f + COUNT);
      fg_field_destroy(field);
      free(bytes);
    }
}

static void truncated_netcdf4_is_refused(void **state)
{
  make(*state, NC_NETCDF4, true);
  check_truncations(*state, 97);
}

/* Whatever value one byte gets, the reader returns an error or a field of finite numbers
 * on a valid grid. */
static void damaged_bytes_are_survived(void **state)
{
  sample_file *f = *state;
  static const unsigned char value[] = {0x00, 0x01, 0x7f, 0x80, 0xff};
  static const int mode[] = {0, NC_64BIT_DATA};
  for (size_t m = 0; m < sizeof mode / sizeof *mode; ++m) {
    make(f, mode[m], true);
    size_t size;
    unsigned char *bytes = load(f->path, &size);
    for (size_t at = 0; at < size; ++at) {
      const unsigned char old = bytes[at];
      for (size_t k = 0; k < sizeof value; ++k) {
        fg_field *field;
        bytes[at] = value[k];
        if (read_bytes(f, bytes, size, &field) != FG_STATUS_OK) {
          assert_null(field);
          assert_true(strlen(fg_context_message(f->context)) > 0);
        }
        fg_field_destroy(field);
      }
      bytes[at] = old;
    }
    free(bytes);
  }
}

/* Replaces the length of a dimension, found by its name in the header of a CDF-1 file. */
static void set_length(sample_file *f, const char *name, uint32_t length)
{
  size_t size;
  unsigned char *bytes = load(f->path, &size);
  size_t at = 8;
  while (memcmp(bytes + at, name, strlen(name)) != 0)
    ++at;
  at += (strlen(name) + 3) / 4 * 4;
  for (unsigned i = 0; i < 4; ++i)
    bytes[at + i] = (unsigned char)(length >> (24 - 8 * i));
  store(f->path, bytes, size);
  free(bytes);
}

static void absurd_dimensions_are_refused(void **state)
{
  sample_file *f = *state;
  fg_field *field;
  make(f, 0, true);
  set_length(f, "x", 0x7fffffff);
  assert_int_equal(read_last_record(f, &field), FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(f->context), "truncated"));
  make(f, 0, false);
  set_length(f, "time", 0xfffffffc);
  set_length(f, "x", 0xfffffffc);
  set_length(f, "y", 0xfffffffc);
  assert_int_equal(read_last_record(f, &field), FG_STATUS_FILE_FORMAT);
}

static void wrong_magic_is_refused(void **state)
{
  sample_file *f = *state;
  static const char *const start[] = {
      "CDF",      "CDF\003", "CDF\004aaaaaaaaaaaaaa", "\x89HDF", "\x89HDF\r\n\x1a\n",
      "GRUB....", "x"};
  for (size_t i = 0; i < sizeof start / sizeof *start; ++i) {
    fg_field *field;
    store(f->path, (const unsigned char *)start[i], strlen(start[i]));
    assert_int_equal(read_last_record(f, &field), FG_STATUS_FILE_FORMAT);
    assert_non_null(strstr(fg_context_message(f->context), f->path));
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(truncated_classic_files_are_refused),
      CASE(lengthened_classic_files_are_refused),
      CASE(zeros_behind_the_data_are_passed_over),
      CASE(truncated_netcdf4_is_refused),
      CASE(damaged_bytes_are_survived),
      CASE(absurd_dimensions_are_refused),
      CASE(wrong_magic_is_refused),
  };
  return cmocka_run_group_tests_name("read/netcdf/size", tests, NULL, NULL);
}
