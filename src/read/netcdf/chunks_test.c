/* Chunks that inflate to more than their declared size, and many small ones. */
#define H5_USE_110_API
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "read/netcdf/plain_example.h"

/* A chunk of more than a megabyte as stored; smaller ones inflate to a gigabyte at
 * most. */
enum { SIDE = 700, SAMPLES = SIDE * SIDE, BYTES = 4 * SAMPLES, MORE = 64 << 20 };

static void must(hid_t id)
{
  if (id < 0)
    abort();
}

/* Incompressible numbers. */
static void fill(float *value)
{
  uint64_t number = 88172645463325252U;
  for (int n = 0; n < SAMPLES; ++n) {
    number ^= number << 13;
    number ^= number >> 7;
    number ^= number << 17;
    value[n] = (float)((double)(number >> 11) / 9007199254740992.0);
  }
}

/* u and v in one chunk each, on axes that count samples. */
static void make_large(sample_file *f, const float *value)
{
  static const char *const names[] = {"u", "v"};
  const size_t chunk[2] = {SIDE, SIDE};
  sample_begin(f, NC_NETCDF4);
  const int all[2] = {sample_dimension(f, "y", SIDE), sample_dimension(f, "x", SIDE)};
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, names[k], NC_FLOAT, 2, all);
    nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
    nc_must(nc_def_var_deflate(f->id, id, 0, 1, 1));
    nc_must(nc_put_var_float(f->id, id, value));
  }
  sample_end(f);
}

/* Appends zeros to the chunk of v, which compress to few bytes. */
static void append_zeros(const sample_file *f, const float *value)
{
  const hsize_t origin[2] = {0, 0};
  unsigned char *whole = calloc(1, (size_t)BYTES + MORE);
  uLongf size = compressBound(BYTES + MORE);
  unsigned char *packed = malloc(size);
  if (!whole || !packed)
    abort();
  memcpy(whole, value, BYTES);
  assert_int_equal(compress2(packed, &size, whole, (size_t)BYTES + MORE, 1), Z_OK);
  assert_true(size > (1 << 20) && size < BYTES + (1 << 20)); /* not overlong by size */
  const hid_t file = H5Fopen(f->path, H5F_ACC_RDWR, H5P_DEFAULT);
  must(file);
  const hid_t set = H5Dopen2(file, "v", H5P_DEFAULT);
  must(set);
  must(H5Dwrite_chunk(set, H5P_DEFAULT, 0, origin, (size_t)size, packed));
  H5Dclose(set);
  must(H5Fclose(file));
  free(whole);
  free(packed);
}

static void chunks_of_their_size_are_read(void **state)
{
  sample_file *f = *state;
  float *value = malloc(BYTES);
  assert_non_null(value);
  fill(value);
  make_large(f, value);
  fg_field *field = read_with(f, NULL);
  for (int k = 0; k < 2; ++k)
    assert_memory_equal(fg_field_contents(field)->velocity[k], value, BYTES);
  fg_field_destroy(field);
  free(value);
}

static void chunks_that_swell_are_refused(void **state)
{
  sample_file *f = *state;
  float *value = malloc(BYTES);
  assert_non_null(value);
  fill(value);
  make_large(f, value);
  append_zeros(f, value);
  refuse_with(f, NULL, FG_STATUS_FILE_FORMAT, "is more than the 1960000 that it should");
  fg_inventory *inventory = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path),
                   FG_STATUS_FILE_FORMAT);
  assert_null(inventory);
  free(value);
}

/* The check of inflated sizes handles one stage of deflate. */
/* Of few samples each, which are read a thousand at a time: along the first dimension of
 * more than one sample, from the middle of a chunk on. */
static void small_chunks_are_read(void **state)
{
  enum { TALL = 61, WIDE = 77, ALL = TALL * WIDE };
  static const size_t shapes[][3] = {
      {1, 1, 1}, {1, 3, 2}, {1, 40, 1}, {1, 1, 77}, {2, 7, 1}};
  static const char *const names[] = {"u", "v"};
  sample_file *f = *state;
  static double value[2][2 * ALL];
  for (int n = 0; n < 2 * ALL; ++n) {
    value[0][n] = 1.0 + n;
    value[1][n] = 0.5 * n - 7.0;
  }
  for (size_t s = 0; s < 2 * sizeof shapes / sizeof *shapes; ++s) {
    sample_begin(f, NC_NETCDF4);
    const int all[3] = {sample_dimension(f, "time", 2), sample_dimension(f, "y", TALL),
                        sample_dimension(f, "x", WIDE)};
    for (int k = 0; k < 2; ++k) {
      const int id = sample_variable(f, names[k], NC_DOUBLE, 3, all);
      nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, shapes[s / 2]));
      nc_must(nc_def_var_deflate(f->id, id, 0, (int)(s % 2), 1));
      nc_must(nc_put_var_double(f->id, id, value[k]));
    }
    sample_end(f);
    fg_field *field = read_with(f, &(fg_read_options){.time = 1});
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], WIDE);
    assert_int_equal(a->size[1], TALL);
    for (int k = 0; k < 2; ++k)
      for (int n = 0; n < ALL; ++n)
        if (a->velocity[k][n] != (float)value[k][ALL + n])
          fail_msg("shape %zu, component %d, sample %d", s, k, n);
    fg_field_destroy(field);
  }
}

static void deflate_twice_is_refused(void **state)
{
  sample_file *f = *state;
  const hsize_t length[2] = {7, 5};
  int id[2];
  make_plain(f, NC_NETCDF4, NC_FLOAT, id);
  sample_end(f);
  const hid_t file = H5Fopen(f->path, H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(2, length, NULL);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  must(H5Pset_chunk(creation, 2, length));
  must(H5Pset_deflate(creation, 1));
  must(H5Pset_filter(creation, H5Z_FILTER_SHUFFLE, 0, 0, NULL));
  const hid_t set = H5Dcreate2(file, "extra", H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                               creation, H5P_DEFAULT);
  must(set);
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  must(H5Fclose(file));
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "another filter after deflate");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(chunks_of_their_size_are_read, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(chunks_that_swell_are_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(deflate_twice_is_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(small_chunks_are_read, sample_set_up,
                                      sample_tear_down),
  };
  return cmocka_run_group_tests_name("read/netcdf/chunks", tests, NULL, NULL);
}
