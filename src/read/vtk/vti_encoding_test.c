#include "read/vtk/vti_example.h"

/* 4 x 3 points, an origin and a spacing that differ along the axes, three components of
 * which the last is not the plane's. */
enum { NX = 4, NY = 3, POINTS = NX * NY };
static const char IMAGE[] = "WholeExtent=\"2 5 -1 1 0 0\" Origin=\"10 20 30\" "
                            "Spacing=\"0.5 0.25 1\"";

static bool is_unsigned(int type)
{
  return type < 8 && type % 2 == 1;
}

static double number(size_t i, int type)
{
  double value = (double)((i * 37 + i / 3 * 11) % 97 + 1);
  if (!is_unsigned(type) && i % 4 == 1)
    value = -value;
  return type >= 8 ? value + 0.25 : value;
}

static example_text make_file(const example_encoding *encoding)
{
  double numbers[3 * POINTS], other[POINTS];
  for (size_t i = 0; i < 3 * POINTS; ++i)
    numbers[i] = number(i, encoding->type);
  for (size_t i = 0; i < POINTS; ++i)
    other[i] = (double)(i % 5);
  example_text file = {0}, appended = {0};
  example_begin(&file, encoding, IMAGE);
  example_words(&file, "<Piece Extent=\"2 5 -1 1 0 0\"><PointData Vectors=\"flow\">\n");
  example_array(&file, &appended, encoding, "pressure", 1, other, POINTS);
  example_array(&file, &appended, encoding, "flow", 3, numbers, (size_t)3 * POINTS);
  example_words(&file, "</PointData></Piece>\n");
  example_end(&file, &appended, encoding);
  return file;
}

static bool is_expected(const fg_field *field, int type)
{
  const fg_field_arrays *a = fg_field_contents(field);
  if (a->size[0] != NX || a->size[1] != NY)
    return false;
  for (size_t i = 0; i < NX; ++i)
    if (a->axis[0][i] != 11.0 + 0.5 * (double)i)
      return false;
  for (size_t j = 0; j < NY; ++j)
    if (a->axis[1][j] != 19.75 + 0.25 * (double)j)
      return false;
  for (size_t i = 0; i < POINTS; ++i)
    for (size_t k = 0; k < 2; ++k)
      if ((double)a->velocity[k][i] != number(3 * i + k, type))
        return false;
  return true;
}

/* Numbers every encoding; false after the last. Types other than the last only once. */
static bool encoding_at(example_encoding *out, int index)
{
  static const size_t blocks[] = {32, 48, 1000}; /* the array is 288 bytes in Float64 */
  int combinations = EXAMPLE_STORAGES * 3 * 2 * 2 * 3;
  *out = (example_encoding){.type = EXAMPLE_FLOAT64};
  if (index >= combinations) {
    out->storage = (example_storage)(index % EXAMPLE_STORAGES);
    out->type = (index - combinations) / EXAMPLE_STORAGES;
    out->zlib = out->big = index % 3 == 0;
    out->block = 40;
    return out->type < EXAMPLE_TYPE_COUNT;
  }
  out->storage = (example_storage)(index % EXAMPLE_STORAGES);
  index /= EXAMPLE_STORAGES;
  out->zlib = index % 3 == 1;
  out->lz4 = index % 3 == 2;
  index /= 3;
  out->wide = index & 1;
  out->big = index & 2;
  out->block = blocks[index / 4];
  return true;
}

static void every_encoding_gives_the_same_field(void **state)
{
  fg_context *context = *state;
  example_encoding encoding;
  int tried = 0;
  for (; encoding_at(&encoding, tried); ++tried) {
    example_text file = make_file(&encoding);
    fg_field *field = NULL;
    assert_true(fg__format_vti.is_mine(file.bytes, file.size));
    assert_int_equal(example_read(&field, context, file.bytes, file.size, NULL),
                     FG_STATUS_OK);
    assert_true(is_expected(field, encoding.type));
    fg_field_destroy(field);
    example_free(&file);
  }
  assert_true(tried > 100);
}

/* A copy of exactly this size, so that the address sanitizer sees a byte too many. */
static unsigned char *copy(const example_text *file, size_t size)
{
  unsigned char *bytes = malloc(size);
  assert_non_null(bytes);
  memcpy(bytes, file->bytes, size);
  return bytes;
}

static void every_truncation_is_refused_or_equal(void **state)
{
  fg_context *context = *state;
  for (int storage = 0; storage < EXAMPLE_STORAGES; ++storage)
    for (int packing = 0; packing < (storage == EXAMPLE_ASCII ? 1 : 3); ++packing) {
      example_encoding encoding = {.storage = (example_storage)storage,
                                   .zlib = packing == 1,
                                   .lz4 = packing == 2,
                                   .block = 64,
                                   .big = packing == 0,
                                   .type = EXAMPLE_FLOAT64};
      example_text file = make_file(&encoding);
      for (size_t size = 1; size < file.size; ++size) {
        unsigned char *bytes = copy(&file, size);
        fg_field *field = NULL;
        fg_status status = example_read(&field, context, bytes, size, NULL);
        if (status == FG_STATUS_OK) {
          assert_true(is_expected(field, encoding.type));
        } else {
          assert_int_equal(status, FG_STATUS_FILE_FORMAT);
          assert_true(fg_context_message(context)[0] != '\0');
          assert_null(field);
        }
        fg_field_destroy(field);
        free(bytes);
      }
      example_free(&file);
    }
}

/* Bytes added anywhere in raw data shift the numbers behind them. */
static void every_insertion_is_refused(void **state)
{
  enum { MORE = 24 }; /* a tuple of the vectors */
  for (int packing = 0; packing < 3; ++packing) {
    const example_encoding encoding = {.storage = EXAMPLE_APPENDED_RAW,
                                       .zlib = packing == 1,
                                       .lz4 = packing == 2,
                                       .block = 64,
                                       .big = packing == 0,
                                       .type = EXAMPLE_FLOAT64};
    example_text file = make_file(&encoding);
    size_t at = 0;
    while (memcmp(file.bytes + at, "\n _", 3) != 0)
      ++at;
    for (at += 3; memcmp(file.bytes + at, "\n</App", 6) != 0; ++at) {
      unsigned char *bytes = calloc(1, file.size + MORE);
      assert_non_null(bytes);
      memcpy(bytes, file.bytes, at);
      memcpy(bytes + at + MORE, file.bytes + at, file.size - at);
      fg_field *field = NULL;
      assert_int_equal(example_read(&field, *state, bytes, file.size + MORE, NULL),
                       FG_STATUS_FILE_FORMAT);
      free(bytes);
    }
    example_free(&file);
  }
}

/* Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators" */
static uint64_t next_random(uint64_t *state)
{
  uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
  return z ^ z >> 31;
}

/* Nothing may crash, hang or come out without a message; what is taken is a sound field.
 */
static void no_mutation_does_harm(void **state)
{
  fg_context *context = *state;
  uint64_t random = 20240229;
  long accepted = 0, refused = 0;
  for (int storage = 0; storage < EXAMPLE_STORAGES; ++storage)
    for (int packing = 0; packing < 3; ++packing) {
      example_encoding encoding = {.storage = (example_storage)storage,
                                   .zlib = packing == 1,
                                   .lz4 = packing == 2,
                                   .block = 64,
                                   .wide = packing > 0,
                                   .type = EXAMPLE_FLOAT64};
      example_text file = make_file(&encoding);
      for (int round = 0; round < 150; ++round) {
        unsigned char *bytes = copy(&file, file.size);
        for (int changes = round % 3; changes >= 0; --changes) {
          size_t at = (size_t)(next_random(&random) % file.size);
          uint64_t kind = next_random(&random) % 4;
          if (kind == 0)
            bytes[at] = (unsigned char)next_random(&random);
          else if (kind == 1)
            bytes[at] ^= (unsigned char)(1u << next_random(&random) % 8);
          else if (kind == 2)
            bytes[at] = (unsigned char)('0' + next_random(&random) % 10);
          else
            bytes[at] = bytes[(size_t)(next_random(&random) % file.size)];
        }
        fg_field *field = NULL;
        fg_status status = example_read(&field, context, bytes, file.size, NULL);
        assert_true((status == FG_STATUS_OK) == (field != NULL));
        assert_true((status == FG_STATUS_OK) == (fg_context_message(context)[0] == '\0'));
        assert_int_not_equal(status, FG_STATUS_MEMORY);
        accepted += status == FG_STATUS_OK;
        refused += status != FG_STATUS_OK;
        fg_field_destroy(field);
        free(bytes);
      }
      example_free(&file);
    }
  assert_true(accepted > 100 && refused > 100);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_encoding_gives_the_same_field),
      cmocka_unit_test(every_truncation_is_refused_or_equal),
      cmocka_unit_test(every_insertion_is_refused),
      cmocka_unit_test(no_mutation_does_harm),
  };
  return cmocka_run_group_tests_name("read/vtk/vti_encoding", tests, context_set_up,
                                     context_tear_down);
}
