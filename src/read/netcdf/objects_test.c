/* NetCDF-4 files with cyclic or external links, that declare more memory than they hold,
 * or have names or numbers of objects beyond all that libnetcdf was made for. */
#define H5_USE_110_API
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

#include "read/netcdf/plain_example.h"

static void must(hid_t id)
{
  if (id < 0)
    abort();
}

/* Opens a valid file of u and v, to add something to it. */
static hid_t begin(sample_file *f)
{
  int id[2];
  double stored[COUNT];
  for (int i = 0; i < COUNT; ++i)
    stored[i] = 2 * i - 9;
  make_plain(f, NC_NETCDF4, NC_FLOAT, id);
  sample_put(f, id[0], stored);
  sample_put(f, id[1], stored);
  sample_end(f);
  const hid_t file = H5Fopen(f->path, H5F_ACC_RDWR, H5P_DEFAULT);
  must(file);
  return file;
}

static void refused(sample_file *f, hid_t file, const char *words)
{
  must(H5Fclose(file));
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, words);
  fg_inventory *inventory = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path),
                   FG_STATUS_UNSUPPORTED);
  assert_null(inventory);
}

static void links_that_lead_round_are_refused(void **state)
{
  sample_file *f = *state;
  hid_t file = begin(f);
  const hid_t group = H5Gcreate2(file, "part", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  must(group);
  for (int k = 0; k < 12; ++k) {
    char name[16];
    snprintf(name, sizeof name, "way%d", k);
    must(H5Lcreate_hard(file, "/", group, name, H5P_DEFAULT, H5P_DEFAULT));
  }
  H5Gclose(group);
  refused(f, file, "is a group that another link leads to");

  file = begin(f);
  must(H5Lcreate_soft("/", file, "round", H5P_DEFAULT, H5P_DEFAULT));
  refused(f, file, "'round' is a group that another link leads to");
}

static void a_second_name_of_a_variable_is_read(void **state)
{
  sample_file *f = *state;
  const hid_t file = begin(f);
  must(H5Lcreate_hard(file, "u", file, "zonal", H5P_DEFAULT, H5P_DEFAULT));
  must(H5Fclose(file));
  const fg_read_options options = {.vars = "u,v"};
  fg_field_destroy(read_with(f, &options));
}

static void other_files_are_not_read(void **state)
{
  sample_file *f = *state;
  char pipe[128];
  snprintf(pipe, sizeof pipe, "%s/pipe", f->folder);
  assert_int_equal(mkfifo(pipe, 0600), 0);
  const hsize_t length[2] = {7, 5};
  const hid_t space = H5Screate_simple(2, length, NULL);

  hid_t file = begin(f);
  must(H5Lcreate_external(pipe, "/u", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT));
  refused(f, file, "'elsewhere' is a link into another file");

  file = begin(f);
  must(H5Lcreate_external(pipe, "/", file, "zzz", H5P_DEFAULT, H5P_DEFAULT));
  must(H5Lcreate_soft("/zzz/u", file, "aaa", H5P_DEFAULT, H5P_DEFAULT));
  refused(f, file, "'zzz' is a link into another file");

  file = begin(f);
  hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  must(H5Pset_external(creation, pipe, 0, H5F_UNLIMITED));
  hid_t set = H5Dcreate2(file, "outside", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, creation,
                         H5P_DEFAULT);
  must(set);
  H5Dclose(set);
  H5Pclose(creation);
  refused(f, file, "'outside' is stored outside of the file");

  file = begin(f);
  creation = H5Pcreate(H5P_DATASET_CREATE);
  must(H5Pset_virtual(creation, space, pipe, "/u", space));
  set = H5Dcreate2(file, "together", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, creation,
                   H5P_DEFAULT);
  must(set);
  H5Dclose(set);
  H5Pclose(creation);
  refused(f, file, "'together' is a virtual data set");
  H5Sclose(space);
  unlink(pipe);
}

static void add_chunked(hid_t file, hsize_t side)
{
  const hsize_t length[2] = {7, 5}, most[2] = {H5S_UNLIMITED, H5S_UNLIMITED};
  const hsize_t chunk[2] = {side, side};
  const hid_t space = H5Screate_simple(2, length, most);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  must(H5Pset_chunk(creation, 2, chunk));
  const hid_t set = H5Dcreate2(file, "extra", H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                               creation, H5P_DEFAULT);
  must(set);
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
}

static void large_chunks_are_refused(void **state)
{
  sample_file *f = *state;
  hid_t file = begin(f);
  add_chunked(file, 30000);
  refused(f, file, "'extra' is stored in pieces of more than 268435456 bytes");
  file = begin(f);
  add_chunked(file, 8192);
  must(H5Fclose(file));
  fg_field_destroy(read_with(f, NULL));
}

/* A chunk of 100 kB stored as a far longer stream, which HDF5 would inflate to its
 * end. */
static void overlong_chunks_are_refused(void **state)
{
  enum { NOISE = 3 << 20, SIDE = 160 };
  sample_file *f = *state;
  const hsize_t length[2] = {SIDE, SIDE}, origin[2] = {0, 0};
  unsigned char *noise = malloc(NOISE), *packed = malloc(NOISE + NOISE / 8);
  assert_true(noise && packed);
  uint64_t number = 88172645463325252U;
  for (int n = 0; n < NOISE; ++n) {
    number ^= number << 13;
    number ^= number >> 7;
    number ^= number << 17;
    noise[n] = (unsigned char)(number >> 24);
  }
  for (int large = 0; large < 2; ++large) {
    uLongf packed_size = NOISE + NOISE / 8;
    assert_int_equal(
        compress2(packed, &packed_size, noise, large ? NOISE : 4 * SIDE * SIDE, 1), Z_OK);
    const hid_t file = begin(f);
    const hid_t space = H5Screate_simple(2, length, NULL);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    must(H5Pset_chunk(creation, 2, length));
    must(H5Pset_deflate(creation, 1));
    const hid_t set = H5Dcreate2(file, "extra", H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                                 creation, H5P_DEFAULT);
    must(set);
    must(H5Dwrite_chunk(set, H5P_DEFAULT, 0, origin, (size_t)packed_size, packed));
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(space);
    if (large) {
      refused(f, file, "'extra' is stored in more bytes than it has");
    } else {
      must(H5Fclose(file));
      fg_field_destroy(read_with(f, NULL));
    }
  }
  free(noise);
  free(packed);
}

/* Names as long as NetCDF's may be and longer, of all that has one. */
static void long_names_are_refused(void **state)
{
  enum { DATA_SET, GROUP, TYPE, ATTRIBUTE, LINK, KINDS };
  static const size_t lengths[] = {255, 256, 257, 4000};
  sample_file *f = *state;
  const hid_t space = H5Screate(H5S_SCALAR);
  char name[4001], words[64];
  for (int n = 0; n < 4 * KINDS; ++n) {
    const size_t length = lengths[n / KINDS];
    memset(name, 'n', length);
    name[length] = '\0';
    const hid_t file = begin(f);
    hid_t made = -1;
    if (n % KINDS == DATA_SET)
      made = H5Dcreate2(file, name, H5T_NATIVE_FLOAT, space, H5P_DEFAULT, H5P_DEFAULT,
                        H5P_DEFAULT);
    else if (n % KINDS == GROUP)
      made = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    else if (n % KINDS == ATTRIBUTE)
      made = H5Acreate_by_name(file, "v", name, H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
    if (n % KINDS == TYPE) {
      made = H5Tcreate(H5T_COMPOUND, sizeof(float));
      must(H5Tinsert(made, "a", 0, H5T_NATIVE_FLOAT));
      must(H5Tcommit2(file, name, made, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    } else if (n % KINDS == LINK) {
      must(H5Lcreate_soft("/u", file, name, H5P_DEFAULT, H5P_DEFAULT));
    } else {
      must(made);
    }
    if (made >= 0)
      H5Idec_ref(made);
    snprintf(words, sizeof words, "nnn...' is a name of %zu bytes", length);
    if (length >= 256) {
      refused(f, file, words);
      continue;
    }
    must(H5Fclose(file));
    fg_field_destroy(read_with(f, &(fg_read_options){.vars = "u,v"}));
  }
  H5Sclose(space);
}

static void add_attributes(hid_t file, const char *to, int count)
{
  const hid_t space = H5Screate(H5S_SCALAR), object = H5Oopen(file, to, H5P_DEFAULT);
  must(object);
  for (int n = 0; n < count; ++n) {
    char name[16];
    snprintf(name, sizeof name, "a%d", n);
    const hid_t attribute =
        H5Acreate2(object, name, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT);
    must(attribute);
    H5Aclose(attribute);
  }
  H5Oclose(object);
  H5Sclose(space);
}

static void thousands_of_attributes_or_groups_are_refused(void **state)
{
  sample_file *f = *state;
  hid_t file = begin(f);
  add_attributes(file, "v", 8200);
  refused(f, file, "attributes; 8192 can be read");
  file = begin(f);
  add_attributes(file, "/", 8200);
  refused(f, file, "'/' has 8201 attributes; 8192 can be read");
  file = begin(f);
  for (int n = 0; n < 8200; ++n) {
    char name[16];
    snprintf(name, sizeof name, "g%d", n);
    const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    must(group);
    H5Gclose(group);
  }
  refused(f, file, "has more than 8192 groups and variables");
  file = begin(f);
  add_attributes(file, "v", 300);
  must(H5Fclose(file));
  fg_field_destroy(read_with(f, NULL));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(links_that_lead_round_are_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(a_second_name_of_a_variable_is_read, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(other_files_are_not_read, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(large_chunks_are_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(overlong_chunks_are_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(long_names_are_refused, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(thousands_of_attributes_or_groups_are_refused,
                                      sample_set_up, sample_tear_down),
  };
  return cmocka_run_group_tests_name("read/netcdf/objects", tests, NULL, NULL);
}
