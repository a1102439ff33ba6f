/* What is wrong with curvilinear and unstructured grids in VTK files, and damage. */
#include "read/vtk/cells_example.h"

/* clang-format off */
static const char GOOD_XML[] =
    "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>"
    "<Piece NumberOfPoints='4' NumberOfCells='2'>"
    POINTS(VECTOR("U", "1 2 0 1 3 0 1 4 0 1 5 0"))
    "<Points>" VECTOR("P", "0 0 0 2 0 0 2 1 0 0 1 0") "</Points><Cells>"
    SCALAR("connectivity", "0 1 2 0 2 3") SCALAR("offsets", "3 6") SCALAR("types", "5 5")
    "</Cells></Piece></UnstructuredGrid></VTKFile>";
/* clang-format on */

static void wrong_cells_of_xml_are_refused(void **state)
{
  static const example_change cases[] = {
      {"UnstructuredGrid'>", "HyperTreeGrid'>", FG_STATUS_UNSUPPORTED, "HyperTreeGrid"},
      {"NumberOfPoints='4'", "", FG_STATUS_FILE_FORMAT, "NumberOfPoints"},
      {"NumberOfPoints='4'", "NumberOfPoints='-4'", FG_STATUS_FILE_FORMAT, "Points"},
      {"NumberOfPoints='4'", "NumberOfPoints='5'", FG_STATUS_FILE_FORMAT, "promised"},
      {"NumberOfPoints='4'", "NumberOfPoints='2000000000'", FG_STATUS_FILE_FORMAT, "cut"},
      {"NumberOfPoints='4'", "NumberOfPoints='3'", FG_STATUS_FILE_FORMAT, "after its 9"},
      {"NumberOfCells='2'", "NumberOfCells='3'", FG_STATUS_FILE_FORMAT, "promised"},
      {"NumberOfCells='2'", "NumberOfCells='0'", FG_STATUS_UNSUPPORTED, "none of its 0"},
      {"NumberOfCells='2'", "", FG_STATUS_FILE_FORMAT, "NumberOfCells"},
      {"'connectivity'", "'corners'", FG_STATUS_FILE_FORMAT, "\"connectivity\""},
      {"'offsets'", "'ends'", FG_STATUS_FILE_FORMAT, "\"offsets\""},
      {"'types'", "'kinds'", FG_STATUS_FILE_FORMAT, "\"types\""},
      {"<Points>", "<Points><DataArray/>", FG_STATUS_FILE_FORMAT, "one array of points"},
      {"Name='P'", "format='appended' offset='9'", FG_STATUS_FILE_FORMAT,
       "array \"Points\""},
      {"0 2 3", "0 2 4", FG_STATUS_FILE_FORMAT, "corner 2 of cell 1 is point 4 of 4"},
      {"0 2 3", "0 2 -1", FG_STATUS_FILE_FORMAT, "corner 2 of cell 1 is point -1"},
      {"3 6", "6 3", FG_STATUS_FILE_FORMAT, "after its 3 numbers"},
      {"3 6", "7 6", FG_STATUS_FILE_FORMAT, "corners of cell 0 are not within those 6"},
      {"3 6", "4 6", FG_STATUS_FILE_FORMAT, "cell 0 is a triangle with 4 corners"},
      {"3 6", "3 1e9", FG_STATUS_FILE_FORMAT, "cut short"},
      {"3 6", "3 1e30", FG_STATUS_FILE_FORMAT, "corners"},
      {"3 6", "3 -6", FG_STATUS_FILE_FORMAT, "corners"},
      {"5 5<", "5 22<", FG_STATUS_FILE_FORMAT, "quadratic triangle with 3 corners"},
      {"5 5<", "42 5<", FG_STATUS_UNSUPPORTED, "cell 0 is a polyhedron"},
      {"5 5<", "5 99<", FG_STATUS_UNSUPPORTED, "not known"},
      {"5 5<", "5 4.5<", FG_STATUS_UNSUPPORTED, "not known"},
      {"5 5<", "1 3<", FG_STATUS_UNSUPPORTED, "none of its 2 cells has an area"},
      {"2 1 0 0 1 0<", "2 1 0 0 1 nan<", FG_STATUS_FILE_FORMAT, "cell 1 is at"},
      {"2 1 0 0 1 0<", "2 1 5 0 1 0<", FG_STATUS_UNSUPPORTED, "that is not plane"},
      {"2 1 0 0 1 0<", "2 0 0 0 0 0<", FG_STATUS_UNSUPPORTED, "fill no area"},
      {"1 5 0<", "1 1e99 0<", FG_STATUS_ARGUMENT, "speeds up to 1e+30"},
  };
  fg_field_destroy(example_field(*state, GOOD_XML, NULL));
  example_try_changes(*state, &fg__format_vti, GOOD_XML, cases,
                      sizeof cases / sizeof cases[0]);
}

/* clang-format off */
static const char POLYHEDRON[] =
    "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>"
    "<Piece NumberOfPoints='5' NumberOfCells='2'>"
    POINTS(VECTOR("U", "1 0 2 3 0.2 2 1.5 1 2.5 1.25 0.3 5 2.5 1.2 4"))
    "<Points>" VECTOR("P", "0 0 0 2 0.2 0 0.5 1 0.5 0.25 0.3 3 1.5 1.2 2") "</Points><Cells>"
    SCALAR("connectivity", "0 1 2 3 1 2 3 4") SCALAR("offsets", "4 8")
    SCALAR("types", "10 42")
    SCALAR("faces", "4 3 1 2 3 3 1 2 4 3 2 3 4 3 3 1 4") SCALAR("faceoffsets", "-1 17")
    "</Cells></Piece></UnstructuredGrid></VTKFile>";
/* clang-format on */

/* A velocity that is linear in space stays so. */
static void assert_linear_within(fg_context *context, const char *file)
{
  fg_field *field = example_field(context, file, NULL);
  const fg_field_arrays *f = fg_field_contents(field);
  int inside = 0;
  for (int n = 0; n < 1000; ++n) {
    const int place[3] = {n % 10, n / 10 % 10, n / 100};
    double at[3], u[3];
    for (int k = 0; k < 3; ++k)
      at[k] = f->axis[k][f->size[k] - 1] * (place[k] + 0.5) / 10.0;
    if (!fg_field_velocity(field, at, u))
      continue;
    ++inside;
    for (int k = 0; k < 3; ++k)
      assert_true(fabs(u[k] - at[k] - (double[]){1.0, 0.0, 2.0}[k]) < 1e-4);
  }
  assert_true(inside > 100);
  fg_field_destroy(field);
}

static void polyhedra_are_read(void **state)
{
  static const example_change wrong[] = {
      {"'faces'", "'sides'", FG_STATUS_UNSUPPORTED, "cell 1 is a polyhedron"},
      {"'faceoffsets'", "'ends'", FG_STATUS_UNSUPPORTED, "cell 1 is a polyhedron"},
      {"-1 17", "-1 -1", FG_STATUS_FILE_FORMAT, "0 numbers of faces"},
      {"-1 17", "-1 nan", FG_STATUS_FILE_FORMAT, "numbers of faces"},
      {"-1 17", "17 -1", FG_STATUS_FILE_FORMAT, "the faces of cell 1 are not within"},
      {"-1 17", "-1 18", FG_STATUS_FILE_FORMAT, "is cut short"},
      {"-1 17", "-1 1e9", FG_STATUS_FILE_FORMAT, "cut short"},
      {"-1 17", "-1 16", FG_STATUS_FILE_FORMAT, "after its 16"},
      {"4 3 1 2 3", "5 3 1 2 3", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"4 3 1 2 3", "4 nan 1 2 3", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"4 3 1 2 3", "4 3 1 2 5", FG_STATUS_FILE_FORMAT, "is point 5 of 5"},
      {"1 2 3 4<", "1 2 3 5<", FG_STATUS_FILE_FORMAT, "is point 5 of 5"},
  };
  assert_linear_within(*state, POLYHEDRON);
  example_try_changes(*state, &fg__format_vti, POLYHEDRON, wrong,
                      sizeof wrong / sizeof wrong[0]);
}

/* clang-format off */
static const char FACES[] =
    SCALAR("faces", "4 3 1 2 3 3 1 2 4 3 2 3 4 3 3 1 4") SCALAR("faceoffsets", "-1 17");

/* As VTK writes them from 9.4 on. */
static const char FACES_APART[] =
    SCALAR("face_connectivity", "1 2 3 1 2 4 2 3 4 3 1 4") SCALAR("face_offsets", "3 6 9 12")
    SCALAR("polyhedron_to_faces", "3 0 2 1") SCALAR("polyhedron_offsets", "0 4");
/* clang-format on */

static void faces_may_be_apart(void **state)
{
  static const example_change apart = {FACES, FACES_APART, FG_STATUS_OK, ""};
  static const example_change wrong[] = {
      {"'face_offsets'", "'ends'", FG_STATUS_UNSUPPORTED, "cell 1 is a polyhedron"},
      {"3 6 9 12", "3 6 9 13", FG_STATUS_FILE_FORMAT, "cut short"},
      {"3 6 9 12", "3 6 5 12", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"3 6 9 12", "-3 6 9 12", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"3 6 9 12", "3 nan 9 12", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {">3 0 2 1<", ">3 0 2 9<", FG_STATUS_FILE_FORMAT, "cut short"},
      {">3 0 2 1<", ">3 0 2 -1<", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"'>0 4<", "'>0 3<", FG_STATUS_FILE_FORMAT, "after its 3"},
      {"'>0 4<", "'>4 0<", FG_STATUS_FILE_FORMAT, "the faces of cell 1"},
      {"'>0 4<", "'>0 0<", FG_STATUS_FILE_FORMAT, "numbers of faces"},
      {"1 2 3 1 2 4 2", "1 2 3 1 2 5 2", FG_STATUS_FILE_FORMAT, "is point 5 of 5"},
  };
  static const example_change often = {">3 0 2 1<", ">3 3 3 3 3 3 3 3 3<", 0, ""};
  static const example_change nine = {"'>0 4<", "'>0 9<", FG_STATUS_FILE_FORMAT,
                                      "of more than one other"};
  char file[EXAMPLE_FILE_BYTES], other[EXAMPLE_FILE_BYTES];
  example_changed(file, POLYHEDRON, &apart);
  assert_linear_within(*state, file);
  example_try_changes(*state, &fg__format_vti, file, wrong,
                      sizeof wrong / sizeof wrong[0]);
  example_changed(other, file, &often);
  example_try_changes(*state, &fg__format_vti, other, &nine, 1);
}

static const char GOOD_LEGACY[] =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
    "0 0 0 2 0 0 2 1 0 0 1 0\nCELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5 5\n"
    "POINT_DATA 4\nVECTORS U float\n1 2 0 1 3 0 1 4 0 1 5 0\n";

static void wrong_words_of_legacy_files_are_refused(void **state)
{
  static const example_change cases[] = {
      {"UNSTRUCTURED_GRID", "TABLE", FG_STATUS_UNSUPPORTED, "TABLE"},
      {"UNSTRUCTURED_GRID", "POLYDATA", FG_STATUS_FILE_FORMAT, "comes \"CELLS\""},
      {"UNSTRUCTURED_GRID", "STRUCTURED_GRID", FG_STATUS_FILE_FORMAT, "POINTS"},
      {"POINTS 4", "POINTS 0", FG_STATUS_FILE_FORMAT, "number of points"},
      {"POINTS 4", "POINTS 3", FG_STATUS_FILE_FORMAT, "comes"},
      {"POINTS 4", "POINTS 2000000000", FG_STATUS_FILE_FORMAT, "cut short"},
      {"4 float", "4 quaternion", FG_STATUS_FILE_FORMAT, "unknown type"},
      {"CELLS 2 8", "CELLS 2 7", FG_STATUS_FILE_FORMAT, "comes \"3\""},
      {"CELLS 2 8", "CELLS 2 -8", FG_STATUS_FILE_FORMAT, "number of corners"},
      {"CELLS 2 8", "CELLS 0 8", FG_STATUS_FILE_FORMAT, "number of cells"},
      {"CELLS 2 8", "CELLS 3 8", FG_STATUS_FILE_FORMAT, "CELL_TYPES of 2 cells"},
      {"3 0 2 3", "4 0 2 3", FG_STATUS_FILE_FORMAT, "corners of cell 1 are not within"},
      {"3 0 2 3", "-3 0 2 3", FG_STATUS_FILE_FORMAT, "corners of cell 1 are not within"},
      {"3 0 2 3", "2 0 2 3", FG_STATUS_FILE_FORMAT, "a triangle with 2 corners"},
      {"3 0 2 3", "3 0 2 9", FG_STATUS_FILE_FORMAT, "point 9 of 4"},
      {"CELLS 2 8\n3 0 1 2\n3 0 2 3\n", "", FG_STATUS_FILE_FORMAT, "CELLS of 0"},
      {"CELL_TYPES 2\n5 5\n", "", FG_STATUS_FILE_FORMAT, "has no CELL_TYPES"},
      {"CELL_TYPES 2\n5 5", "CELL_TYPES 2\n5 7", FG_STATUS_OK, ""},
      {"CELL_TYPES 2\n5 5", "CELL_TYPES 2\n5 6", FG_STATUS_OK, ""},
      {"POINT_DATA 4", "POINT_DATA 5", FG_STATUS_FILE_FORMAT, "the grid has 4"},
      {"POINT_DATA 4", "CELL_DATA 4", FG_STATUS_FILE_FORMAT, "the grid has 2"},
      {"CELLS 2 8", "CELLS 3 6\nOFFSETS int\n0 3 6\nCONNECTED int", FG_STATUS_FILE_FORMAT,
       "no CONNECTIVITY"},
      {"CELLS 2 8", "CELLS 2 3\nOFFSETS int\n0 3\nCONNECTIVITY int\n0 1 2\nCELLS 2 8",
       FG_STATUS_FILE_FORMAT, "comes \"CELLS\""},
      {"CELL_TYPES 2", "CELL_TYPES 2\n5 5\nCELL_TYPES 2", FG_STATUS_FILE_FORMAT,
       "comes \"CELL_TYPES\""},
  };
  example_try_changes(*state, &fg__format_vtk_legacy, GOOD_LEGACY, cases,
                      sizeof cases / sizeof cases[0]);
}

/* Of a file that may begin in any way; not by parts. */
static fg_status read_bytes(fg_field **out, fg_context *context, const void *bytes,
                            size_t size)
{
  static const fg_read_options none = {0};
  unsigned char *copy = malloc(size + !size); /* its end is where the sanitizer watches */
  assert_non_null(copy);
  memcpy(copy, bytes, size);
  fg__source source = {.path = "example", .bytes = copy, .size = size};
  const fg__format *format = fg__format_find(copy, size);
  fg_context_clear(context);
  *out = NULL;
  fg_status status = FG_STATUS_FILE_FORMAT;
  if (format)
    status =
        fg__dataset_read(out, context, format, &source, &none, (fg__slab_index){0, 1});
  free(copy);
  return status;
}

enum { KINDS = 9 };

static example_text file_of(int kind)
{
  const example_encoding encoding = {.storage =
                                         (example_storage)(kind % EXAMPLE_STORAGES),
                                     .zlib = kind == 1,
                                     .lz4 = kind == 2,
                                     .block = 64,
                                     .type = EXAMPLE_FLOAT64};
  if (kind < 4)
    return vtu(&encoding, "");
  if (kind < 8)
    return legacy(kind % 2, kind / 2 % 2);
  return vts(&RAW, 0.1);
}

/* A file that ends anywhere is refused, or whole. */
static void truncated_files_are_refused_or_whole(void **state)
{
  for (int kind = 0; kind < KINDS; ++kind) {
    example_text file = file_of(kind);
    fg_field *whole = NULL;
    assert_int_equal(read_bytes(&whole, *state, file.bytes, file.size), FG_STATUS_OK);
    int refused = 0;
    for (size_t size = 0; size < file.size; size += kind < 8 ? 1 : 13) {
      fg_field *field = NULL;
      if (read_bytes(&field, *state, file.bytes, size) == FG_STATUS_OK) {
        /* only the last word's last figure may be missing */
        assert_true(size + 40 > file.size);
      } else {
        assert_null(field);
        ++refused;
      }
      fg_field_destroy(field);
    }
    assert_true(refused > 100);
    fg_field_destroy(whole);
    example_free(&file);
  }
}

/* Bytes changed at random are refused or read, never worse. */
static void damaged_files_do_no_harm(void **state)
{
  uint64_t random = 11;
  int refused = 0, read = 0;
  for (int kind = 0; kind < KINDS; ++kind) {
    example_text file = file_of(kind);
    unsigned char *damaged = malloc(file.size);
    assert_non_null(damaged);
    for (int round = 0; round < (kind < 8 ? 150 : 10); ++round) {
      memcpy(damaged, file.bytes, file.size);
      for (int change = 0; change <= round % 4; ++change) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        const size_t at = (size_t)(random >> 33) % file.size;
        damaged[at] = round % 2 ? (unsigned char)('0' + (random >> 20) % 10)
                                : (unsigned char)(random >> 20);
      }
      fg_field *field = NULL;
      const fg_status status = read_bytes(&field, *state, damaged, file.size);
      assert_true((status == FG_STATUS_OK) == (field != NULL));
      assert_int_not_equal(status, FG_STATUS_MEMORY);
      refused += status != FG_STATUS_OK;
      read += status == FG_STATUS_OK;
      fg_field_destroy(field);
    }
    free(damaged);
    example_free(&file);
  }
  assert_true(refused > 100 && read > 100);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wrong_cells_of_xml_are_refused),
      cmocka_unit_test(polyhedra_are_read),
      cmocka_unit_test(faces_may_be_apart),
      cmocka_unit_test(wrong_words_of_legacy_files_are_refused),
      cmocka_unit_test(truncated_files_are_refused_or_whole),
      cmocka_unit_test(damaged_files_do_no_harm),
  };
  return cmocka_run_group_tests_name("read/vtk/cells_refusal", tests, context_set_up,
                                     context_tear_down);
}
