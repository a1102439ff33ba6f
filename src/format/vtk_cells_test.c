/* Curvilinear and unstructured grids in VTK files. */
#include <math.h>

#include "format/vti_example.h"

/* ---- one small plane of cells, in each way of writing
 * -------------------------------------------- */

/* Nine points in the plane y = 3, the middle one moved: a quad, a pixel, two triangles, a
 * polygon; and, to be left out, a vertex and a line. */
enum { POINTS_OF = 9, CELLS_OF = 7, CORNERS_OF = 21, TYPE_INT64 = 6, TYPE_UINT8 = 1 };
static const double PLACE[3 * POINTS_OF] = {0, 3, 0, 2, 3, 0, 4, 3, 0, 0, 3, 1, 2.5, 3,
                                            1, 4, 3, 1, 0, 3, 3, 2, 3, 3, 4, 3, 3};
static const double CORNERS[CORNERS_OF] = {0, 1, 4, 3, 8, 1, 2, 4, 2, 5, 4,
                                           3, 4, 6, 7, 6, 7, 4, 5, 8, 7};
static const double ENDS[CELLS_OF] = {4, 5, 8, 11, 15, 17, 21};
static const double TYPES[CELLS_OF] = {9, 1, 5, 5, 8, 3, 7};

/* Linear in x and z. */
static double velocity(size_t point, int component)
{
  const double *p = PLACE + 3 * point;
  return component == 0   ? 1.0 + 2.0 * p[0] - p[2]
         : component == 1 ? 50.0
                          : 3.0 - 0.5 * p[0] + 4.0 * p[2];
}

static void velocities(double out[3 * POINTS_OF])
{
  for (size_t n = 0; n < POINTS_OF; ++n)
    for (int c = 0; c < 3; ++c)
      out[3 * n + (size_t)c] = velocity(n, c);
}

static void add_as(example_text *file, example_text *appended,
                   const example_encoding *encoding, int type, const char *name,
                   const double *numbers, size_t count)
{
  example_encoding other = *encoding;
  other.type = type;
  example_array(file, appended, &other, name, 1, numbers, count);
}

static example_text vtu(const example_encoding *encoding, const char *more)
{
  example_text file = {0}, appended = {0};
  double numbers[3 * POINTS_OF];
  velocities(numbers);
  example_begin_kind(&file, encoding, "UnstructuredGrid", "");
  example_words(&file, "<Piece NumberOfPoints=\"9\" NumberOfCells=\"7\"><PointData>\n");
  example_array(&file, &appended, encoding, "U", 3, numbers, 3 * POINTS_OF);
  example_words(&file, more);
  example_words(&file, "</PointData>\n<Points>\n");
  example_array(&file, &appended, encoding, "", 3, PLACE, 3 * POINTS_OF);
  example_words(&file, "</Points>\n<Cells>\n");
  add_as(&file, &appended, encoding, TYPE_INT64, "connectivity", CORNERS, CORNERS_OF);
  add_as(&file, &appended, encoding, TYPE_INT64, "offsets", ENDS, CELLS_OF);
  add_as(&file, &appended, encoding, TYPE_UINT8, "types", TYPES, CELLS_OF);
  example_words(&file, "</Cells></Piece>\n");
  example_end_kind(&file, &appended, encoding, "UnstructuredGrid");
  return file;
}

/* `count` numbers of a type as text or big-endian bytes, then a new line. */
static void add_numbers(example_text *file, bool binary, int type, const double *numbers,
                        size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    unsigned char bytes[8];
    char word[40];
    if (binary) {
      example_bytes(file, bytes, example_number(bytes, numbers[i], type, true));
      continue;
    }
    snprintf(word, sizeof word, "%.17g%s", numbers[i], i % 9 == 8 ? "\n" : " ");
    example_words(file, word);
  }
  example_words(file, "\n");
}

static void begin_legacy(example_text *file, bool binary, const char *dataset)
{
  example_words(file, "# vtk DataFile Version 5.1\nsmall\n");
  example_words(file, binary ? "BINARY\nDATASET " : "ASCII\nDATASET ");
  example_words(file, dataset);
}

static example_text legacy(bool binary, bool with_offsets)
{
  enum { INT32 = 4, COUNTED = CORNERS_OF + CELLS_OF };
  example_text file = {0};
  double numbers[3 * POINTS_OF], counted[COUNTED], begins[CELLS_OF + 1] = {0};
  size_t count = 0;
  for (size_t c = 0, i = 0; c < CELLS_OF; ++c) {
    begins[c + 1] = ENDS[c];
    counted[count++] = ENDS[c] - begins[c];
    for (; i < (size_t)ENDS[c]; ++i)
      counted[count++] = CORNERS[i];
  }
  begin_legacy(&file, binary, "UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n");
  add_numbers(&file, binary, EXAMPLE_FLOAT64, (const double[]){2.5}, 1);
  example_words(&file, "POINTS 9 double\n");
  add_numbers(&file, binary, EXAMPLE_FLOAT64, PLACE, 3 * POINTS_OF);
  if (with_offsets) {
    example_words(&file, "METADATA\nINFORMATION 0\n\nCELLS 8 21\nOFFSETS vtktypeint64\n");
    add_numbers(&file, binary, TYPE_INT64, begins, CELLS_OF + 1);
    example_words(&file, "CONNECTIVITY vtktypeint64\n");
    add_numbers(&file, binary, TYPE_INT64, CORNERS, CORNERS_OF);
  } else {
    example_words(&file, "CELLS 7 28\n");
    add_numbers(&file, binary, INT32, counted, COUNTED);
  }
  example_words(&file, "CELL_TYPES 7\n");
  add_numbers(&file, binary, INT32, TYPES, CELLS_OF);
  example_words(&file, "POINT_DATA 9\nVECTORS U double\n");
  velocities(numbers);
  add_numbers(&file, binary, EXAMPLE_FLOAT64, numbers, 3 * POINTS_OF);
  return file;
}

static fg_status read_bytes(fg_field **out, fg_context *context, const void *bytes,
                            size_t size, const fg_read_options *options, bool parts)
{
  static const fg_read_options none = {0};
  unsigned char *copy = malloc(size + !size); /* its end is where the sanitizer watches */
  assert_non_null(copy);
  memcpy(copy, bytes, size);
  fg__source source = {.path = "example", .bytes = copy, .size = size};
  const fg__format *format = fg__format_find(copy, size);
  fg_context_clear(context);
  *out = NULL;
  options = options ? options : &none;
  fg_status status = FG_STATUS_FILE_FORMAT;
  if (format) {
    status = format->read(out, context, &source, options, (fg__dealt){0, 1});
    if (parts)
      assert_parts_alike(format, &source, options, *out);
  }
  free(copy);
  return status;
}

/* Frees the file. */
static fg_field *field_of(fg_context *context, example_text file,
                          const fg_read_options *options)
{
  fg_field *field = NULL;
  fg_status status = read_bytes(&field, context, file.bytes, file.size, options, true);
  if (status != FG_STATUS_OK)
    print_error("%s\n", fg_context_message(context));
  assert_int_equal(status, FG_STATUS_OK);
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

/* ---- grids that are not along the axes, or seem not to be
 * --------------------------------------- */

enum { NX = 5, NY = 4, NZ = 3, COUNT = NX * NY * NZ };

static const double EDGES[3][NX] = {{-1, 0, 0.5, 2, 4}, {2, 3, 3.5, 5}, {0, 1, 4}};

/* Points of a grid, and what U is there; sheared by so much. */
static void grid_points(double place[3 * COUNT], double vector[3 * COUNT], double shear)
{
  for (size_t n = 0; n < COUNT; ++n) {
    const double x = EDGES[0][n % NX], y = EDGES[1][n / NX % NY],
                 z = EDGES[2][n / NX / NY];
    place[3 * n] = x + shear * y * z;
    place[3 * n + 1] = y + shear * x;
    place[3 * n + 2] = z - shear * x;
    for (size_t c = 0; c < 3; ++c)
      vector[3 * n + c] = sin(3.0 * (double)n + (double)c);
  }
}

static example_text vts(const example_encoding *encoding, double shear)
{
  example_text file = {0}, appended = {0};
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, shear);
  example_begin_kind(&file, encoding, "StructuredGrid", "WholeExtent=\"1 5 0 3 -1 1\"");
  example_words(&file, "<Piece Extent=\"1 5 0 3 -1 1\"><PointData Vectors=\"U\">\n");
  example_array(&file, &appended, encoding, "U", 3, vector, 3 * COUNT);
  example_words(&file, "</PointData><Points>\n");
  example_array(&file, &appended, encoding, "Points", 3, place, 3 * COUNT);
  example_words(&file, "</Points></Piece>\n");
  example_end_kind(&file, &appended, encoding, "StructuredGrid");
  return file;
}

static example_text structured(bool binary, double shear)
{
  example_text file = {0};
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, shear);
  begin_legacy(&file, binary, "STRUCTURED_GRID\nDIMENSIONS 5 4 3\nPOINTS 60 double\n");
  add_numbers(&file, binary, EXAMPLE_FLOAT64, place, 3 * COUNT);
  example_words(&file, "POINT_DATA 60\nVECTORS U double\n");
  add_numbers(&file, binary, EXAMPLE_FLOAT64, vector, 3 * COUNT);
  return file;
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
  example_words(&file, "</CellData><Points>\n");
  example_array(&file, &appended, encoding, "Points", 3, place, 3 * COUNT);
  example_words(&file, "</Points><Cells>\n");
  example_array(&file, &appended, encoding, "types", 1, types, HEXAHEDRA);
  example_array(&file, &appended, encoding, "offsets", 1, ends, HEXAHEDRA);
  example_array(&file, &appended, encoding, "connectivity", 1, corner, 8 * HEXAHEDRA);
  example_words(&file, "</Cells></Piece>\n");
  example_end_kind(&file, &appended, encoding, "UnstructuredGrid");
  return file;
}

static const example_encoding RAW = {.storage = EXAMPLE_APPENDED_RAW,
                                     .type = EXAMPLE_FLOAT64};

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

/* A grid whose points are where lines along the axes cross keeps its axes and samples. */
static void a_curvilinear_grid_along_the_axes_stays_as_it_is(void **state)
{
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, 0.0);
  for (int way = 0; way < 3; ++way) {
    fg_field *field =
        field_of(*state, way == 2 ? vts(&RAW, 0.0) : structured(way, 0.0), NULL);
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
  static const char list[] =
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece "
      "NumberOfPoints='12' "
      "NumberOfCells='6'>" CELLS(VECTOR(
          "U",
          "1 2 0 3 5 0 8 -1 0 4 4 0 -2 7 0 5 "
          "9 0")) "<Points>" VECTOR("P",
                                    "0 0 0 2 0 0 4 0 0 6 0 0 0 1 0 2 1 0 4 1 0 6 1 0 0 2 "
                                    "0 2 2 0 "
                                    "4 2 0 6 2 0") "</Points><Cells>" SCALAR("connectivit"
                                                                             "y",
                                                                             "0 1 4 5 1 "
                                                                             "2 5 6 2 3 "
                                                                             "6 7 4 5 "
                                                                             "8 9 5 6 9 "
                                                                             "10 6 7 10 "
                                                                             "11")
          SCALAR("offsets", "4 8 12 16 20 24") SCALAR(
              "types", "8 8 8 8 8 8") "</Cells></Piece></UnstructuredGrid></VTKFile>";
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
  static const char piece[] =
      "<Piece NumberOfPoints='4' NumberOfCells='1'>" POINTS(PAIR_OF(
          "U",
          "1 2 1 2 1 2 1 %d")) "<Points>" VECTOR("P",
                                                 "%d 0 0 2 0 0 %d 1 0 "
                                                 "2 1 0") "</Points>\n"
                                                          "<Cells>" SCALAR(
                                                              "connectivity",
                                                              "0 1 2 3") SCALAR("offsets",
                                                                                "4")
                                                              SCALAR(
                                                                  "types",
                                                                  "8") "</Cells></Piece>";
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

/* ---- what is refused
 * -------------------------------------------------------------------------- */

static const char GOOD_XML[] =
    "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='4' "
    "NumberOfCells='2'>" POINTS(VECTOR("U", "1 2 0 1 3 0 1 4 0 1 5 0")) "<Points>" VECTOR(
        "P", "0 0 0 2 0 0 2 1 0 0 1 0") "</Points><Cells>" SCALAR("connectivity",
                                                                  "0 1 2 0 2 3")
        SCALAR("offsets", "3 6")
            SCALAR("types", "5 5") "</Cells></Piece></UnstructuredGrid></VTKFile>";

static void wrong_cells_of_xml_are_refused(void **state)
{
  static const example_change cases[] = {
      {"UnstructuredGrid'>", "PolyData'>", FG_STATUS_UNSUPPORTED, "PolyData"},
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
      {"0 2 3", "0 2 4", FG_STATUS_FILE_FORMAT, "corner 2 of cell 1 is point 4 of 4"},
      {"0 2 3", "0 2 -1", FG_STATUS_FILE_FORMAT, "corner 2 of cell 1 is point -1"},
      {"3 6", "6 3", FG_STATUS_FILE_FORMAT, "after its 3 numbers"},
      {"3 6", "7 6", FG_STATUS_FILE_FORMAT, "corners of cell 0 are not within those 6"},
      {"3 6", "4 6", FG_STATUS_FILE_FORMAT, "cell 0 is a triangle with 4 corners"},
      {"3 6", "3 1e9", FG_STATUS_FILE_FORMAT, "cut short"},
      {"3 6", "3 1e30", FG_STATUS_FILE_FORMAT, "corners"},
      {"3 6", "3 -6", FG_STATUS_FILE_FORMAT, "corners"},
      {"5 5<", "5 22<", FG_STATUS_UNSUPPORTED, "cell 1 is a quadratic triangle"},
      {"5 5<", "42 5<", FG_STATUS_UNSUPPORTED, "cell 0 is a polyhedron"},
      {"5 5<", "5 99<", FG_STATUS_UNSUPPORTED, "not known"},
      {"5 5<", "5 4.5<", FG_STATUS_UNSUPPORTED, "not known"},
      {"5 5<", "1 3<", FG_STATUS_UNSUPPORTED, "none of its 2 cells has an area"},
      {"2 1 0 0 1 0<", "2 1 0 0 1 nan<", FG_STATUS_FILE_FORMAT, "cell 1 is at"},
      {"2 1 0 0 1 0<", "2 1 5 0 1 0<", FG_STATUS_UNSUPPORTED, "no plane of two axes"},
      {"2 1 0 0 1 0<", "2 0 0 0 0 0<", FG_STATUS_UNSUPPORTED, "fill no area"},
      {"1 5 0<", "1 inf 0<", FG_STATUS_FILE_FORMAT, "infinite"},
  };
  fg_field_destroy(example_field(*state, GOOD_XML, NULL));
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    char file[EXAMPLE_FILE_BYTES];
    fg_field *field = NULL;
    example_changed(file, GOOD_XML, &cases[i]);
    fg_status status = example_read_words(&field, *state, file, NULL);
    assert_as_said(&cases[i], status, *state, field);
  }
}

static const char GOOD_LEGACY[] =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
    "0 0 0 2 0 0 2 1 0 0 1 0\nCELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5 5\n"
    "POINT_DATA 4\nVECTORS U float\n1 2 0 1 3 0 1 4 0 1 5 0\n";

static void wrong_words_of_legacy_files_are_refused(void **state)
{
  static const example_change cases[] = {
      {"UNSTRUCTURED_GRID", "POLYDATA", FG_STATUS_UNSUPPORTED, "POLYDATA"},
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
      {"CELL_TYPES 2\n5 5", "CELL_TYPES 2\n5 6", FG_STATUS_UNSUPPORTED, "triangle strip"},
      {"POINT_DATA 4", "POINT_DATA 5", FG_STATUS_FILE_FORMAT, "the grid has 4"},
      {"POINT_DATA 4", "CELL_DATA 4", FG_STATUS_FILE_FORMAT, "the grid has 2"},
      {"CELLS 2 8", "CELLS 3 6\nOFFSETS int\n0 3 6\nCONNECTED int", FG_STATUS_FILE_FORMAT,
       "no CONNECTIVITY"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    char file[EXAMPLE_FILE_BYTES];
    fg_field *field = NULL;
    example_changed(file, GOOD_LEGACY, &cases[i]);
    fg_status status = read_bytes(&field, *state, file, strlen(file), NULL, true);
    assert_as_said(&cases[i], status, *state, field);
    fg_field_destroy(field);
  }
}

/* ---- damage
 * ------------------------------------------------------------------------------------ */

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
    assert_int_equal(read_bytes(&whole, *state, file.bytes, file.size, NULL, false),
                     FG_STATUS_OK);
    int refused = 0;
    for (size_t size = 0; size < file.size; size += kind < 8 ? 1 : 13) {
      fg_field *field = NULL;
      if (read_bytes(&field, *state, file.bytes, size, NULL, false) == FG_STATUS_OK) {
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
    for (int round = 0; round < (kind < 8 ? 400 : 40); ++round) {
      memcpy(damaged, file.bytes, file.size);
      for (int change = 0; change <= round % 4; ++change) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        const size_t at = (size_t)(random >> 33) % file.size;
        damaged[at] = round % 2 ? (unsigned char)('0' + (random >> 20) % 10)
                                : (unsigned char)(random >> 20);
      }
      fg_field *field = NULL;
      const fg_status status =
          read_bytes(&field, *state, damaged, file.size, NULL, false);
      assert_true((status == FG_STATUS_OK) == (field != NULL));
      assert_int_not_equal(status, FG_STATUS_MEMORY);
      refused += status != FG_STATUS_OK;
      read += status == FG_STATUS_OK;
      fg_field_destroy(field);
    }
    free(damaged);
    example_free(&file);
  }
  assert_true(refused > 300 && read > 300);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_way_of_writing_gives_the_same_field),
      cmocka_unit_test(a_curvilinear_grid_is_the_cells_between_its_points),
      cmocka_unit_test(a_curvilinear_grid_along_the_axes_stays_as_it_is),
      cmocka_unit_test(values_of_cells_agree_with_those_of_an_image),
      cmocka_unit_test(masks_and_hidden_points_are_missing),
      cmocka_unit_test(pieces_are_put_together),
      cmocka_unit_test(wrong_cells_of_xml_are_refused),
      cmocka_unit_test(wrong_words_of_legacy_files_are_refused),
      cmocka_unit_test(truncated_files_are_refused_or_whole),
      cmocka_unit_test(damaged_files_do_no_harm),
  };
  return cmocka_run_group_tests_name("format/vtk_cells", tests, context_set_up,
                                     context_tear_down);
}
