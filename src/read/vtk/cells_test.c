/* Curvilinear and unstructured grids in VTK files. */
#include "read/vtk/cells_example.h"

/* Frees the file. */
static fg_field *field_of(fg_context *context, example_text file,
                          const fg_read_options *options)
{
  const fg__format *format = fg__format_find(file.bytes, file.size);
  assert_non_null(format);
  fg_field *field = example_field_as(context, format, file.bytes, file.size, options);
  example_free(&file);
  return field;
}

static void assert_same_field(const fg_field *a, const fg_field *b)
{
  const fg_field_arrays *one = fg_field_contents(a), *other = fg_field_contents(b);
  size_t samples = 1;
  assert_int_equal(one->dimension, other->dimension);
  for (int k = 0; k < one->dimension; ++k) {
    assert_int_equal(one->size[k], other->size[k]);
    samples *= (size_t)one->size[k];
    assert_memory_equal(one->axis[k], other->axis[k],
                        (size_t)one->size[k] * sizeof(double));
  }
  for (int k = 0; k < one->dimension; ++k)
    for (size_t n = 0; n < samples; ++n)
      if (!isnan(one->velocity[k][n]) || !isnan(other->velocity[k][n]))
        assert_true(one->velocity[k][n] == other->velocity[k][n]);
}

/* The field is linear in the plane of x and z, and all of its box is covered but for the
 * triangle that the pixel does not share with the last polygon. */
static void assert_linear(const fg_field *field)
{
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->dimension, 2);
  assert_string_equal(f->axis_name[0], "x");
  assert_string_equal(f->axis_name[1], "z");
  assert_string_equal(f->velocity_name[1], "U_z");
  assert_true(f->axis[0][0] == 0.0 && f->axis[0][f->size[0] - 1] == 4.0);
  assert_true(f->axis[1][0] == 0.0 && f->axis[1][f->size[1] - 1] == 3.0);
  for (int j = 0; j < f->size[1]; ++j)
    for (int i = 0; i < f->size[0]; ++i) {
      const double x = f->axis[0][i], z = f->axis[1][j];
      const size_t n = (size_t)j * (size_t)f->size[0] + (size_t)i;
      assert_true(fabs((double)f->velocity[0][n] - (1.0 + 2.0 * x - z)) < 1e-5);
      assert_true(fabs((double)f->velocity[1][n] - (3.0 - 0.5 * x + 4.0 * z)) < 1e-5);
    }
}

static void every_way_of_writing_gives_the_same_field(void **state)
{
  const example_encoding plain = {.type = EXAMPLE_FLOAT64};
  fg_field *first = field_of(*state, vtu(&plain, ""), NULL);
  assert_linear(first);
  int tried = 0;
  for (int storage = 0; storage < EXAMPLE_STORAGES; ++storage)
    for (int packing = 0; packing < 3; ++packing, ++tried) {
      const example_encoding encoding = {.storage = (example_storage)storage,
                                         .zlib = packing == 1,
                                         .lz4 = packing == 2,
                                         .block = 48,
                                         .wide = tried % 2,
                                         .big = tried % 3 == 0,
                                         .type = EXAMPLE_FLOAT64};
      fg_field *other = field_of(*state, vtu(&encoding, ""), NULL);
      assert_same_field(first, other);
      fg_field_destroy(other);
    }
  for (int way = 0; way < 4; ++way) {
    fg_field *other = field_of(*state, legacy(way % 2, way / 2), NULL);
    assert_same_field(first, other);
    assert_string_equal(fg_field_contents(other)->time, "t = 2.5");
    fg_field_destroy(other);
  }
  fg_field_destroy(first);
}

/* From the last point to the first: then all three axes descend. */
static void turn_back(double numbers[3 * COUNT])
{
  for (size_t n = 0; n < COUNT / 2; ++n)
    for (size_t c = 0; c < 3; ++c) {
      double *one = &numbers[3 * n + c], *other = &numbers[3 * (COUNT - 1 - n) + c];
      const double kept = *one;
      *one = *other;
      *other = kept;
    }
}

static example_text structured_so(bool binary, double shear, bool back)
{
  example_text file = {0};
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, shear);
  if (back) {
    turn_back(place);
    turn_back(vector);
  }
  begin_legacy(&file, binary, "STRUCTURED_GRID\nDIMENSIONS 5 4 3\nPOINTS 60 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, place, 3 * COUNT);
  example_words(&file, "POINT_DATA 60\nVECTORS U double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, vector, 3 * COUNT);
  return file;
}

static example_text structured(bool binary, double shear)
{
  return structured_so(binary, shear, false);
}

/* The same grid as a list of hexahedra, the cells' turned about. */
static example_text listed(const example_encoding *encoding, double shear)
{
  enum { HEXAHEDRA = (NX - 1) * (NY - 1) * (NZ - 1) };
  example_text file = {0}, appended = {0};
  double place[3 * COUNT], vector[3 * COUNT], corner[8 * HEXAHEDRA], ends[HEXAHEDRA];
  double types[HEXAHEDRA], cells[3 * HEXAHEDRA];
  size_t count = 0;
  grid_points(place, vector, shear);
  for (int k = 0; k < NZ - 1; ++k)
    for (int j = 0; j < NY - 1; ++j)
      for (int i = 0; i < NX - 1; ++i, ++count) {
        const int c = (k * NY + j) * NX + i, up = NX * NY;
        const int eight[8] = {c,      c + 1,      c + 1 + NX,      c + NX,
                              c + up, c + up + 1, c + up + 1 + NX, c + up + NX};
        const int rows[8] = {0, 1, 3, 2, 4, 5, 7, 6};
        types[count] = count % 2 ? 11 : 12;
        for (size_t n = 0; n < 8; ++n)
          corner[8 * count + n] = eight[count % 2 ? rows[n] : (int)n];
        ends[count] = 8.0 * (double)(count + 1);
        for (size_t n = 0; n < 3; ++n)
          cells[3 * count + n] = (double)(7 * count % 11 + n);
      }
  example_begin_kind(&file, encoding, "UnstructuredGrid", "");
  example_words(&file, "<Piece NumberOfPoints=\"60\" NumberOfCells=\"24\">\n<PointData>");
  example_array(&file, &appended, encoding, "U", 3, vector, 3 * COUNT);
  example_words(&file, "</PointData><CellData>\n");
  example_array(&file, &appended, encoding, "C", 3, cells, 3 * HEXAHEDRA);
  example_words(&file, "</CellData>");
  add_points(&file, &appended, encoding, place, COUNT);
  add_cells(&file, &appended, encoding, corner, 8 * HEXAHEDRA, ends, types, HEXAHEDRA);
  example_words(&file, "</Piece>\n");
  example_end_kind(&file, &appended, encoding, "UnstructuredGrid");
  return file;
}

static void a_curvilinear_grid_is_the_cells_between_its_points(void **state)
{
  fg_field *cells = field_of(*state, listed(&RAW, 0.1), &(fg_read_options){.vars = "U"});
  fg_field *xml = field_of(*state, vts(&RAW, 0.1), NULL);
  fg_field *text = field_of(*state, structured(false, 0.1), NULL);
  fg_field *binary = field_of(*state, structured(true, 0.1), NULL);
  assert_int_equal(fg_field_contents(xml)->dimension, 3);
  assert_true(fg_field_contents(xml)->size[0] > 2 * NX);
  assert_same_field(cells, xml);
  assert_same_field(cells, text);
  assert_same_field(cells, binary);
  fg_field_destroy(cells);
  fg_field_destroy(xml);
  fg_field_destroy(text);
  fg_field_destroy(binary);
}

/* One layer of points is quads: here in the plane x = 7, sheared. */
static void a_flat_curvilinear_grid_is_a_plane(void **state)
{
  static const double place[18] = {7, 0, 1, 7, 2, 1, 7, 5, 1, 7, 1, 4, 7, 3, 4, 7, 6, 4};
  static const double vector[18] = {9, 0, 1, 9, 2, 1, 9, 5, 1, 9, 1, 4, 9, 3, 4, 9, 6, 4};
  example_text file = {0}, appended = {0};
  example_begin_kind(&file, &RAW, "StructuredGrid", "WholeExtent=\"0 2 4 4 0 1\"");
  example_words(&file, "<Piece Extent=\"0 2 4 4 0 1\"><PointData>\n");
  example_array(&file, &appended, &RAW, "U", 3, vector, 18);
  example_words(&file, "</PointData>");
  add_points(&file, &appended, &RAW, place, 6);
  example_words(&file, "</Piece>\n");
  example_end_kind(&file, &appended, &RAW, "StructuredGrid");
  const fg__source source = {"x", .bytes = file.bytes, .size = file.size};
  fg_inventory *inventory = NULL;
  assert_int_equal(fg__inventory_create(&inventory, *state, "x"), FG_STATUS_OK);
  assert_int_equal(
      fg__dataset_inventory(inventory, *state, &fg__format_vti, &source, NULL),
      FG_STATUS_OK);
  const fg_inventory_vector *told = fg_inventory_vector_at(inventory, 0);
  fg_field *field = field_of(*state, file, NULL);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->dimension, 2);
  for (int k = 0; k < 2; ++k) {
    assert_string_equal(f->axis_name[k], k ? "z" : "y");
    assert_string_equal(told->axis_name[k], f->axis_name[k]);
  }
  fg_inventory_destroy(inventory);
  assert_true(f->axis[1][0] == 1.0 && f->axis[1][f->size[1] - 1] == 4.0);
  int missing = 0;
  for (int j = 0; j < f->size[1]; ++j)
    for (int i = 0; i < f->size[0]; ++i) {
      const size_t n = (size_t)j * (size_t)f->size[0] + (size_t)i;
      const double y = f->axis[0][i], z = f->axis[1][j], left = (z - 1.0) / 3.0;
      missing += isnan(f->velocity[0][n]) ? 1 : 0;
      if (isnan(f->velocity[0][n]))
        assert_true(y < left + 1e-3 || y > left + 5.0 - 1e-3);
      else
        assert_true(fabs((double)f->velocity[0][n] - y) < 1e-5 &&
                    fabs((double)f->velocity[1][n] - z) < 1e-5);
    }
  assert_true(missing > 0);
  fg_field_destroy(field);
}

/* A grid whose points are where lines along the axes cross keeps its axes and samples,
 * also where the lines run against an axis. */
static void a_curvilinear_grid_along_the_axes_stays_as_it_is(void **state)
{
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, 0.0);
  for (int way = 0; way < 4; ++way) {
    fg_field *field = field_of(
        *state, way == 2 ? vts(&RAW, 0.0) : structured_so(way == 1, 0.0, way == 3), NULL);
    const fg_field_arrays *f = fg_field_contents(field);
    const int size[3] = {NX, NY, NZ};
    for (int k = 0; k < 3; ++k) {
      assert_int_equal(f->size[k], size[k]);
      assert_memory_equal(f->axis[k], EDGES[k], (size_t)size[k] * sizeof(double));
      for (size_t n = 0; n < COUNT; ++n)
        assert_true(f->velocity[k][n] == (float)vector[3 * n + (size_t)k]);
    }
    fg_field_destroy(field);
  }
}

/* The same cells and their values, as an image and as a list: on the image's points the
 * two agree. */
static void values_of_cells_agree_with_those_of_an_image(void **state)
{
  char image[EXAMPLE_FILE_BYTES];
  example_image(image, "Spacing='2 1 1'", "0 3 0 2 0 0",
                CELLS(VECTOR("U", "1 2 0 3 5 0 8 -1 0 4 4 0 -2 7 0 5 9 0")));
  /* clang-format off */
  static const char list[] =
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>"
      "<Piece NumberOfPoints='12' NumberOfCells='6'>"
      CELLS(VECTOR("U", "1 2 0 3 5 0 8 -1 0 4 4 0 -2 7 0 5 9 0"))
      "<Points>"
      VECTOR("P", "0 0 0 2 0 0 4 0 0 6 0 0 0 1 0 2 1 0 4 1 0 6 1 0 0 2 0 2 2 0 4 2 0 6 2 0")
      "</Points><Cells>"
      SCALAR("connectivity", "0 1 4 5 1 2 5 6 2 3 6 7 4 5 8 9 5 6 9 10 6 7 10 11")
      SCALAR("offsets", "4 8 12 16 20 24")
      SCALAR("types", "8 8 8 8 8 8")
      "</Cells></Piece></UnstructuredGrid></VTKFile>";
  /* clang-format on */
  fg_field *a = example_field(*state, image, NULL),
           *b = example_field(*state, list, NULL);
  const fg_field_arrays *coarse = fg_field_contents(a), *fine = fg_field_contents(b);
  const int times = (fine->size[0] - 1) / 3;
  assert_true(fine->size[0] == 3 * times + 1 && fine->size[1] == 2 * times + 1);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 2; ++k)
        assert_true(fabsf(coarse->velocity[k][j * 4 + i] -
                          fine->velocity[k][(j * fine->size[0] + i) * times]) < 1e-5f);
  fg_field_destroy(a);
  fg_field_destroy(b);
}

/* What is hidden, or not positive in the mask, is missing with the cells round it. */
static void masks_and_hidden_points_are_missing(void **state)
{
  const example_encoding plain = {.type = EXAMPLE_FLOAT64};
  static const char *const more[] = {"", SCALAR("mask", "0 1 1 1 1 1 1 1 1"),
                                     BYTES("vtkGhostType", "2 0 0 0 0 0 0 0 0"),
                                     BYTES("vtkValidPointMask", "0 1 1 1 1 1 1 1 1")};
  for (int way = 0; way < 4; ++way) {
    const fg_read_options options = {.vars = "U", .mask = way == 1 ? "mask" : NULL};
    fg_field *field = field_of(*state, vtu(&plain, more[way]), &options);
    const fg_field_arrays *f = fg_field_contents(field);
    for (int j = 0; j < f->size[1]; ++j)
      for (int i = 0; i < f->size[0]; ++i) {
        const size_t n = (size_t)j * (size_t)f->size[0] + (size_t)i;
        const double x = f->axis[0][i], z = f->axis[1][j];
        const bool in_first = z < 1.0 && x < 2.0 + 0.5 * z; /* the quad at point 0 */
        if (fabs(x - 2.0 - 0.5 * z) > 1e-3 && fabs(z - 1.0) > 1e-3)
          assert_true(isnan(f->velocity[0][n]) == (in_first && way > 0));
      }
    fg_field_destroy(field);
  }
}

/* Two pieces of a list are one field: quads at the left and at the right. */
static void pieces_are_put_together(void **state)
{
  /* clang-format off */
  static const char piece[] =
      "<Piece NumberOfPoints='4' NumberOfCells='1'>"
      POINTS(PAIR_OF("U", "1 2 1 2 1 2 1 %d"))
      "<Points>" VECTOR("P", "%d 0 0 2 0 0 %d 1 0 2 1 0") "</Points>\n"
      "<Cells>" SCALAR("connectivity", "0 1 2 3") SCALAR("offsets", "4") SCALAR("types", "8")
      "</Cells></Piece>";
  /* clang-format on */
  char file[EXAMPLE_FILE_BYTES], left[1024], right[1024];
  snprintf(left, sizeof left, piece, 0, 0, 0);
  snprintf(right, sizeof right, piece, 5, 5, 5);
  snprintf(file, sizeof file,
           "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>%s<Piece "
           "NumberOfPoints='0' NumberOfCells='0'></Piece>%s</UnstructuredGrid></VTKFile>",
           left, right);
  fg_field *field = example_field(*state, file, NULL);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->axis[0][0] == 0.0 && f->axis[0][f->size[0] - 1] == 5.0);
  for (int n = 0; n < f->size[0] * f->size[1]; ++n)
    assert_true(f->velocity[0][n] == 1.0f);
  assert_true(f->velocity[1][0] == 2.0f);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_way_of_writing_gives_the_same_field),
      cmocka_unit_test(a_curvilinear_grid_is_the_cells_between_its_points),
      cmocka_unit_test(a_flat_curvilinear_grid_is_a_plane),
      cmocka_unit_test(a_curvilinear_grid_along_the_axes_stays_as_it_is),
      cmocka_unit_test(values_of_cells_agree_with_those_of_an_image),
      cmocka_unit_test(masks_and_hidden_points_are_missing),
      cmocka_unit_test(pieces_are_put_together),
  };
  return cmocka_run_group_tests_name("read/vtk/cells", tests, context_set_up,
                                     context_tear_down);
}
