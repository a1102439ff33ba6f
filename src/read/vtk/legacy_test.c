#include <math.h>

#include "read/vtk/legacy_example.h"

enum { NX = 4, NY = 3, NZ = 3, COUNT = NX * NY * NZ };

static fg_status read_bytes(fg_field **out, fg_context *context, const void *bytes,
                            size_t size, const fg_read_options *options)
{
  return example_read_as(out, context, &fg__format_vtk_legacy, bytes, size, options);
}

static fg_field *field_of(fg_context *context, const example_text *file,
                          const fg_read_options *options)
{
  return example_field_as(context, &fg__format_vtk_legacy, file->bytes, file->size,
                          options);
}

static double sample(int n, int component)
{
  return 0.25 * n * n - 3.0 * component + 1.0;
}

static void add_vectors(example_text *file, bool binary, int type)
{
  double numbers[3 * COUNT];
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c)
      numbers[3 * n + c] = sample(n, c);
  example_legacy_numbers(file, binary, type, numbers, 3 * COUNT);
}

static void begin(example_text *file, bool binary, const char *dataset)
{
  example_words(file, "# vtk DataFile Version 3.0\nany title, ASCII say\n");
  example_words(file, binary ? "BINARY\n" : "ASCII\n");
  example_words(file, dataset);
}

/* With everything that a file may hold before the vectors. */
static example_text image(bool binary)
{
  example_text file = {0};
  double ramp[9 * COUNT], four[4] = {65.0, 66.0, 67.0, 68.0};
  for (int n = 0; n < 9 * COUNT; ++n)
    ramp[n] = n % 100;
  begin(&file, binary, "DATASET STRUCTURED_POINTS\nFIELD FieldData 2\nTIME 1 1 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, (const double[]){2.5}, 1);
  example_words(&file, "chars 4 1 char\n");
  example_legacy_numbers(&file, binary, 0, four, 4);
  example_words(&file, "ORIGIN 1 2 -3\ndimensions 4 3 3\nAspect_Ratio 0.5 2 1e1\n");
  example_words(&file, "CELL_DATA 12\nSCALARS cells%20here int\nLOOKUP_TABLE default\n");
  example_legacy_numbers(&file, binary, 4, ramp, 12);
  example_words(&file, "METADATA\nINFORMATION 1\nNAME X LOCATION Y\nDATA VECTORS 3\n\n");
  example_words(&file, "POINT_DATA 36\nSCALARS three unsigned_short 3\n");
  example_words(&file, "LOOKUP_TABLE mine\n");
  example_legacy_numbers(&file, binary, 3, ramp, 3 * COUNT);
  example_words(&file, "LOOKUP_TABLE mine 2\n");
  example_legacy_numbers(&file, binary, binary ? 1 : EXAMPLE_FLOAT64, ramp, 8);
  example_words(&file, "COLOR_SCALARS colour 4\n");
  example_legacy_numbers(&file, binary, binary ? 1 : EXAMPLE_FLOAT64, ramp, 4 * COUNT);
  example_words(&file, "NORMALS n float\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64 - 1, ramp, 3 * COUNT);
  example_words(&file, "TEXTURE_COORDINATES t 2 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, ramp, 2 * COUNT);
  example_words(&file, "TENSORS stress float\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64 - 1, ramp, 9 * COUNT);
  example_words(&file, "SCALARS old long\n"); /* without a table */
  example_legacy_numbers(&file, binary, 6, ramp, COUNT);
  example_words(&file, "SCALARS bits bit\nLOOKUP_TABLE default\n");
  if (binary)
    example_legacy_numbers(&file, binary, 1, ramp, 5); /* 36 bits */
  else
    example_legacy_numbers(&file, binary, 1, ramp, COUNT);
  example_words(&file, "FIELD more 2\nnames 1 2 string\n");
  example_words(&file, binary ? "\xC5"
                                "ab cd"
                                "\x80\x05"
                                "VECTO\n"
                              : "ab cd\nVECTO\n");
  example_words(&file, "NULL_ARRAY\nVECTORS flow double\n");
  add_vectors(&file, binary, EXAMPLE_FLOAT64);
  return file;
}

static void assert_samples(const fg_field *field)
{
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->dimension, 3);
  assert_true(f->size[0] == NX && f->size[1] == NY && f->size[2] == NZ);
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c)
      assert_true(f->velocity[c][n] == (float)sample(n, c));
}

static void images_are_read_past_all_else(void **state)
{
  for (int binary = 0; binary < 2; ++binary) {
    example_text file = image(binary);
    fg_field *field = field_of(*state, &file, NULL);
    assert_samples(field);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_true(f->axis[0][3] == 2.5 && f->axis[1][1] == 4.0 && f->axis[2][2] == 17.0);
    assert_string_equal(f->velocity_name[1], "flow_y");
    assert_string_equal(f->title, "flow");
    assert_string_equal(f->time, "t = 2.5");
    fg_field_destroy(field);
    example_free(&file);
  }
}

static void other_arrays_can_be_named(void **state)
{
  for (int binary = 0; binary < 2; ++binary) {
    example_text file = image(binary);
    static const char *const names[] = {"three", "n"};
    for (int i = 0; i < 2; ++i) {
      fg_read_options options = {.vars = names[i], .mask = "cells here"};
      fg_field *field = field_of(*state, &file, &options);
      const fg_field_arrays *f = fg_field_contents(field);
      /* the only cell of the mask that is 0, the first, spoils its corners */
      assert_true(isnan(f->velocity[0][0]) && isnan(f->velocity[0][NX + 1]));
      assert_true(f->velocity[2][2] == 8.0f && f->velocity[1][COUNT - 1] == 6.0f);
      fg_field_destroy(field);
    }
    example_free(&file);
  }
}

static example_text grid(bool binary)
{
  example_text file = {0};
  begin(&file, binary, "DATASET RECTILINEAR_GRID\nDIMENSIONS 4 3 3\n");
  example_words(&file, "X_COORDINATES 4 float\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64 - 1,
                         (double[]){-1.5, 0.0, 0.25, 8.0}, 4);
  example_words(&file, "METADATA\nINFORMATION 1\nNAME X LOCATION Y\nDATA 1\n\n");
  example_words(&file, "Y_COORDINATES 3 int\n");
  example_legacy_numbers(&file, binary, 4, (double[]){1.0, 5.0, 6.0}, 3);
  example_words(&file, "Z_COORDINATES 3 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, (double[]){0.1, 0.2, 0.4}, 3);
  example_words(&file, "POINT_DATA 36\r\nVECTORS flow float\n");
  add_vectors(&file, binary, EXAMPLE_FLOAT64 - 1);
  return file;
}

static void rectilinear_grids_have_their_own_axes(void **state)
{
  for (int binary = 0; binary < 2; ++binary) {
    example_text file = grid(binary);
    fg_field *field = field_of(*state, &file, NULL);
    assert_samples(field);
    const fg_field_arrays *f = fg_field_contents(field);
    const double z[] = {0.1, 0.2, 0.4};
    assert_true(f->axis[0][0] == -1.5 && f->axis[0][2] == 0.25 && f->axis[0][3] == 8.0);
    assert_true(f->axis[1][1] == 5.0);
    assert_memory_equal(f->axis[2], z, sizeof z);
    fg_field_destroy(field);
    example_free(&file);
  }
}

static void several_vectors_are_ambiguous(void **state)
{
  example_text file = image(true);
  example_words(&file, "VECTORS field double\n");
  add_vectors(&file, true, EXAMPLE_FLOAT64);
  fg_field *field = NULL;
  assert_int_equal(read_bytes(&field, *state, file.bytes, file.size, NULL),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(*state), "flow; field"));
  field = field_of(*state, &file, &(fg_read_options){.vars = "field"});
  assert_samples(field);
  fg_field_destroy(field);
  example_free(&file);
}

static const char GOOD[] =
    "# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 1\n"
    "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 6\nVECTORS v float\n"
    "1 0 0 2 0 0 3 0 0\n4 0 0 5 0 0 6 0 0\n";

static void an_image_one_point_thick_is_a_plane(void **state)
{
  fg_field *field = NULL;
  assert_int_equal(read_bytes(&field, *state, GOOD, strlen(GOOD), NULL), FG_STATUS_OK);
  assert_int_equal(fg_field_contents(field)->dimension, 2);
  assert_true(fg_field_contents(field)->velocity[0][5] == 6.0f);
  fg_field_destroy(field);
}

#define AXES                                                                             \
  "X_COORDINATES 3 int\n0 1 4\nY_COORDINATES 2 int\n0 2\nZ_COORDINATES 1 int\n7\n"

static void wrong_words_are_refused(void **state)
{
  static const example_change cases[] = {
      {"ASCII", "TEXT", FG_STATUS_FILE_FORMAT, "neither ASCII nor BINARY but \"TEXT\""},
      {"DATASET", "DATASAT", FG_STATUS_FILE_FORMAT, "no DATASET but \"DATASAT\""},
      {"STRUCTURED_POINTS", "TABLE", FG_STATUS_UNSUPPORTED, "TABLE"},
      {"STRUCTURED_POINTS", "STRUCTURED_GRID", FG_STATUS_FILE_FORMAT, "has no POINTS"},
      {"STRUCTURED_POINTS", "UNSTRUCTURED_GRID", FG_STATUS_FILE_FORMAT, "has no POINTS"},
      {"STRUCTURED_POINTS", "RECTILINEAR_GRID", FG_STATUS_FILE_FORMAT,
       "no X_COORDINATES"},
      {"DIMENSIONS 3 2 1\n", "", FG_STATUS_FILE_FORMAT, "no DIMENSIONS"},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 3 2", FG_STATUS_FILE_FORMAT, "points \"ORIGIN\""},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 3 -2 1", FG_STATUS_FILE_FORMAT, "\"-2\""},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 3 0 1", FG_STATUS_FILE_FORMAT, "\"0\""},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 3 2 99999999999", FG_STATUS_FILE_FORMAT,
       "\"99999999999\""},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 2147483647 2147483647 2147483647",
       FG_STATUS_FILE_FORMAT, "2147483647 x 2147483647"},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 46340 46340 1", FG_STATUS_FILE_FORMAT,
       "POINT_DATA of 6 where the grid has 2147395600"},
      {"DIMENSIONS 3 2 1", "DIMENSIONS 6 1 1", FG_STATUS_UNSUPPORTED, "a line"},
      {"ORIGIN 0 0 0", "ORIGIN 0 nan 0", FG_STATUS_FILE_FORMAT, "an origin \"nan\""},
      {"SPACING 1 1 1", "SPACING 1 -1 1", FG_STATUS_FILE_FORMAT, "not positive"},
      {"SPACING 1 1 1", "SPACING 1 1", FG_STATUS_FILE_FORMAT, "a spacing \"POINT_DATA\""},
      {"STRUCTURED_POINTS\nDIMENSIONS 3 2 1\n",
       "RECTILINEAR_GRID\nDIMENSIONS 3 2 1\n" AXES, FG_STATUS_OK, ""},
      {"STRUCTURED_POINTS\nDIMENSIONS 3 2 1\n",
       "RECTILINEAR_GRID\nDIMENSIONS 3 2 1\n" AXES AXES, FG_STATUS_FILE_FORMAT,
       "comes \"X_COORDINATES\""},
      {"POINT_DATA 6", "POINT_DATA 7", FG_STATUS_FILE_FORMAT, "7 where the grid has 6"},
      {"POINT_DATA 6", "CELL_DATA 6", FG_STATUS_FILE_FORMAT, "6 where the grid has 2"},
      {"POINT_DATA 6", "POINT_DATA six", FG_STATUS_FILE_FORMAT, "\"six\""},
      {"POINT_DATA 6", "", FG_STATUS_FILE_FORMAT, "before POINT_DATA"},
      {"VECTORS v float", "VECTORS v half", FG_STATUS_FILE_FORMAT, "type \"half\""},
      {"VECTORS v float", "VECTORS v float\n1", FG_STATUS_FILE_FORMAT,
       "unknown keyword \"0\""},
      {"VECTORS v float", "VECTORZ v float", FG_STATUS_FILE_FORMAT,
       "unknown keyword \"VECTORZ\""},
      {"VECTORS v float", "\x1b[2J\xff v float", FG_STATUS_FILE_FORMAT, "\"?[2J?\""},
      {"VECTORS v float", "SCALARS v float 0", FG_STATUS_FILE_FORMAT, "components \"0\""},
      {"VECTORS v float", "SCALARS v float 2147483647", FG_STATUS_FILE_FORMAT,
       "cut short: 12884901882 numbers"},
      {"VECTORS v float", "SCALARS v float 3", FG_STATUS_OK, ""},
      {"VECTORS v float", "SCALARS v float", FG_STATUS_FILE_FORMAT, "keyword"},
      {"VECTORS v float", "FIELD f 2147483647\nv 3 6 float", FG_STATUS_FILE_FORMAT,
       "no name of an array"},
      {"VECTORS v float", "FIELD f 1\nv 2147483647 2147483647 double",
       FG_STATUS_FILE_FORMAT, "v"},
      {"VECTORS v float", "FIELD f 1\nv 3 5 float", FG_STATUS_FILE_FORMAT, "keyword"},
      {"VECTORS v float", "FIELD f 1\nv 3 6 float", FG_STATUS_OK, ""},
      {"VECTORS v float", "FIELD f 1\nv 6 3 float", FG_STATUS_UNSUPPORTED, "no vectors"},
      {"5 0 0", "5 O 0", FG_STATUS_FILE_FORMAT, "13 found, then \"O\""},
      {"5 0 0 6 0 0\n", "5 0 0 6 0", FG_STATUS_FILE_FORMAT, "18 numbers promised"},
  };
  example_try_changes(*state, &fg__format_vtk_legacy, GOOD, cases,
                      sizeof cases / sizeof cases[0]);
}

/* As some programs write them; what is too long for that is not cut to something else. */
static void long_numbers_are_read_whole_or_refused(void **state)
{
  for (int zeros = 80; zeros <= 800; zeros += 720) {
    char file[EXAMPLE_FILE_BYTES], number[1024] = "5";
    memset(number + 1, '0', (size_t)zeros);
    snprintf(number + 1 + zeros, 24, "e-%d 0\v0\f5 0\t0", zeros);
    example_changed(file, GOOD,
                    &(example_change){.before = "4 0 0 5 0 0", .after = number});
    fg_field *field = NULL;
    fg_status status = read_bytes(&field, *state, file, strlen(file), NULL);
    assert_int_equal(status, zeros == 80 ? FG_STATUS_OK : FG_STATUS_FILE_FORMAT);
    if (field)
      assert_true(fg_field_contents(field)->velocity[0][3] == 5.0f);
    fg_field_destroy(field);
  }
}

static void assert_one_line(const fg_context *context)
{
  const char *message = fg_context_message(context);
  assert_true(strlen(message) > 0 && !strchr(message, '\n'));
}

/* Where the last number begins in text, or ends in binary: a number cut short is one. */
static size_t needed_size(const example_text *file, bool binary)
{
  size_t size = file->size;
  while (!binary && strchr(" \n", file->bytes[size - 1]))
    --size;
  while (!binary && !strchr(" \n", file->bytes[size - 1]))
    --size;
  return binary ? size - 1 : size + 1;
}

/* A file that ends anywhere is refused, or whole. */
static void truncated_files_are_refused(void **state)
{
  for (int kind = 0; kind < 4; ++kind) {
    example_text file = kind < 2 ? image(kind) : grid(kind - 2);
    for (size_t size = 0; size < needed_size(&file, kind % 2); ++size) {
      fg_field *field = NULL;
      assert_int_not_equal(read_bytes(&field, *state, file.bytes, size, NULL),
                           FG_STATUS_OK);
      assert_null(field);
      assert_one_line(*state);
    }
    example_free(&file);
  }
}

/* Bytes changed at random are refused or read, never worse. */
static void damaged_files_do_no_harm(void **state)
{
  uint64_t random_state = 5;
  int refused = 0;
  for (int kind = 0; kind < 4; ++kind) {
    example_text file = kind < 2 ? image(kind) : grid(kind - 2);
    unsigned char *damaged = malloc(file.size);
    assert_non_null(damaged);
    for (int round = 0; round < 500; ++round) {
      memcpy(damaged, file.bytes, file.size);
      for (int change = 0; change <= round % 4; ++change) {
        random_state = random_state * 6364136223846793005U + 1442695040888963407U;
        size_t at = (size_t)(random_state >> 33) % file.size;
        damaged[at] = (unsigned char)(random_state >> 20);
      }
      fg_field *field = NULL;
      if (read_bytes(&field, *state, damaged, file.size, NULL) != FG_STATUS_OK) {
        assert_null(field);
        ++refused;
      }
      fg_field_destroy(field);
    }
    free(damaged);
    example_free(&file);
  }
  assert_true(refused > 100);
}

static void the_format_is_known_by_its_first_line(void **state)
{
  (void)state;
  assert_ptr_equal(fg__format_find((const unsigned char *)GOOD, strlen(GOOD)),
                   &fg__format_vtk_legacy);
  assert_false(fg__format_vtk_legacy.is_mine((const unsigned char *)GOOD, 12));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(images_are_read_past_all_else),
      cmocka_unit_test(other_arrays_can_be_named),
      cmocka_unit_test(rectilinear_grids_have_their_own_axes),
      cmocka_unit_test(several_vectors_are_ambiguous),
      cmocka_unit_test(an_image_one_point_thick_is_a_plane),
      cmocka_unit_test(wrong_words_are_refused),
      cmocka_unit_test(long_numbers_are_read_whole_or_refused),
      cmocka_unit_test(truncated_files_are_refused),
      cmocka_unit_test(damaged_files_do_no_harm),
      cmocka_unit_test(the_format_is_known_by_its_first_line),
  };
  return cmocka_run_group_tests_name("read/vtk/legacy", tests, context_set_up,
                                     context_tear_down);
}
