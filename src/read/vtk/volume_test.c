/* Volumes in VTK XML files, and rectilinear grids. */
#include <math.h>

#include "read/situation_test.h"
#include "read/vtk/vti_example.h"

enum {
  NX = 5,
  NY = 4,
  NZ = 3,
  COUNT = NX * NY * NZ,
  CELLS = (NX - 1) * (NY - 1) * (NZ - 1)
};

static const example_encoding TEXT = {.storage = EXAMPLE_ASCII, .type = EXAMPLE_FLOAT64};

/* Whole numbers, each its own. */
static double sample(int i, int j, int k, int component)
{
  return 1.0 + i + 10.0 * j + 100.0 * k + 1000.0 * component;
}

/* A piece of the volume [first, end), its points' or cells' vectors as U. */
static void add_piece(example_text *file, example_text *appended,
                      const example_encoding *encoding, const int first[3],
                      const int end[3], bool cells, const char *more)
{
  double numbers[3 * COUNT];
  size_t count = 0;
  int less = cells ? 1 : 0;
  for (int k = first[2]; k <= end[2] - less; ++k)
    for (int j = first[1]; j <= end[1] - less; ++j)
      for (int i = first[0]; i <= end[0] - less; ++i)
        for (int c = 0; c < 3; ++c)
          numbers[count++] = sample(i, j, k, c);
  char words[128];
  snprintf(words, sizeof words, "<Piece Extent=\"%d %d %d %d %d %d\">\n<%sData>\n",
           first[0], end[0], first[1], end[1], first[2], end[2],
           cells ? "Cell" : "Point");
  example_words(file, words);
  example_array(file, appended, encoding, "U", 3, numbers, count);
  example_words(file, more);
  example_words(file, cells ? "</CellData>\n" : "</PointData>\n");
  example_words(file, "</Piece>\n");
}

static const char BOX[] =
    "WholeExtent=\"0 4 0 3 0 2\" Origin=\"1 2 3\" Spacing=\"0.5 0.25 2\"";

static example_text volume(const example_encoding *encoding, bool cells, const char *more)
{
  example_text file = {0}, appended = {0};
  example_begin(&file, encoding, BOX);
  add_piece(&file, &appended, encoding, (const int[]){0, 0, 0},
            (const int[]){NX - 1, NY - 1, NZ - 1}, cells, more);
  example_end(&file, &appended, encoding);
  return file;
}

static fg_field *field_of(fg_context *context, example_text *file,
                          const fg_read_options *options)
{
  fg_field *field =
      example_field_as(context, &fg__format_vti, file->bytes, file->size, options);
  example_free(file);
  return field;
}

static void assert_points(const fg_field *field)
{
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->dimension, 3);
  assert_true(f->size[0] == NX && f->size[1] == NY && f->size[2] == NZ);
  size_t n = 0;
  for (int k = 0; k < NZ; ++k)
    for (int j = 0; j < NY; ++j)
      for (int i = 0; i < NX; ++i, ++n)
        for (int c = 0; c < 3; ++c)
          assert_true(f->velocity[c][n] == (float)sample(i, j, k, c));
}

static void points_of_a_volume_are_read_in_every_encoding(void **state)
{
  const example_encoding encodings[] = {
      {EXAMPLE_ASCII, false, false, 0, false, false, EXAMPLE_FLOAT64},
      {EXAMPLE_INLINE, true, false, 64, false, true, EXAMPLE_FLOAT64 - 1},
      {EXAMPLE_APPENDED_RAW, false, false, 0, true, true, EXAMPLE_FLOAT64},
      {EXAMPLE_APPENDED_BASE64, false, true, 100, true, false, EXAMPLE_FLOAT64 - 1}};
  for (size_t e = 0; e < sizeof encodings / sizeof encodings[0]; ++e) {
    example_text file = volume(&encodings[e], false, "");
    fg_field *field = field_of(*state, &file, NULL);
    assert_points(field);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_true(f->axis[0][1] == 1.5 && f->axis[1][3] == 2.75 && f->axis[2][2] == 7.0);
    assert_string_equal(f->velocity_name[2], "U_z");
    assert_string_equal(f->axis_name[2], "z");
    fg_field_destroy(field);
  }
}

static void pieces_make_a_whole(void **state)
{
  example_text file = {0}, appended = {0};
  example_begin(&file, &TEXT, BOX);
  add_piece(&file, &appended, &TEXT, (const int[]){0, 0, 0}, (const int[]){4, 3, 1},
            false, "");
  add_piece(&file, &appended, &TEXT, (const int[]){2, 0, 1}, (const int[]){4, 3, 2},
            false, "");
  add_piece(&file, &appended, &TEXT, (const int[]){0, 0, 1}, (const int[]){2, 3, 2},
            false, "");
  example_end(&file, &appended, &TEXT);
  fg_field *field = field_of(*state, &file, NULL);
  assert_points(field);
  fg_field_destroy(field);
}

/* A point has the mean of the up to eight cells round it; of a linear function that is
 * the function at their middle. */
static void cells_go_to_their_points(void **state)
{
  example_text file = volume(&TEXT, true, "");
  fg_field *field = field_of(*state, &file, NULL);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->size[0] == NX && f->size[1] == NY && f->size[2] == NZ);
  for (int k = 0; k < NZ; ++k)
    for (int j = 0; j < NY; ++j)
      for (int i = 0; i < NX; ++i) {
        double x = i == 0 ? 0.0 : i == NX - 1 ? NX - 2.0 : i - 0.5;
        double y = j == 0 ? 0.0 : j == NY - 1 ? NY - 2.0 : j - 0.5;
        double z = k == 0 ? 0.0 : k == NZ - 1 ? NZ - 2.0 : k - 0.5;
        for (int c = 0; c < 3; ++c) {
          double mean = 1.0 + x + 10.0 * y + 100.0 * z + 1000.0 * c;
          assert_true(fabs((double)f->velocity[c][(k * NY + j) * NX + i] - mean) < 1e-3);
        }
      }
  fg_field_destroy(field);
}

/* A hidden cell spoils its eight corners. */
static void hidden_cells_are_holes(void **state)
{
  char marks[256] = "<DataArray type='UInt8' Name='vtkGhostType'>";
  for (int n = 0; n < CELLS; ++n)
    strcat(marks, n == (1 * (NY - 1) + 1) * (NX - 1) + 2 ? " 32" : " 0");
  strcat(marks, "</DataArray>");
  example_text file = volume(&TEXT, true, marks);
  fg_field *field = field_of(*state, &file, NULL);
  const fg_field_arrays *f = fg_field_contents(field);
  int missing = 0;
  for (int n = 0; n < COUNT; ++n) {
    int i = n % NX, j = n / NX % NY, k = n / NX / NY;
    bool corner = (i == 2 || i == 3) && (j == 1 || j == 2) && (k == 1 || k == 2);
    assert_int_equal(f->valid[n], !corner);
    missing += corner;
  }
  assert_int_equal(missing, 8);
  fg_field_destroy(field);
}

static void a_mask_leaves_its_points_out(void **state)
{
  char mask[512] = "<DataArray type='Int16' Name='inside'>";
  for (int n = 0; n < COUNT; ++n)
    strcat(mask, n == 17 || n == 40 ? " 0" : " 3");
  strcat(mask, "</DataArray>");
  example_text file = volume(&TEXT, false, mask);
  fg_field *field = field_of(*state, &file, &(fg_read_options){.mask = "inside"});
  const fg_field_arrays *f = fg_field_contents(field);
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c)
      assert_true(isnan(f->velocity[c][n]) == (n == 17 || n == 40));
  fg_field_destroy(field);
}

/* Values of that number of points. */
#define EIGHTEEN "1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9"
#define TWENTYSEVEN EIGHTEEN " 1 2 3 4 5 6 7 8 9"
#define IMAGE(extent, data)                                                              \
  "<VTKFile type='ImageData'><ImageData WholeExtent='" extent "'><Piece Extent='" extent \
  "'>" data "</Piece></ImageData></VTKFile>"
#define VOLUME(data) IMAGE("0 2 0 2 0 2", POINTS(data))
#define ONE_OF(name) SCALAR(name, TWENTYSEVEN)

#define AXES(x, y, z)                                                                    \
  "<Coordinates>" SCALAR("a", x) SCALAR("b", y) SCALAR("c", z) "</Coordinates>"
#define RIGHT(axes)                                                                      \
  "<VTKFile type='RectilinearGrid'><RectilinearGrid WholeExtent='2 5 0 1 7 7'><Piece "   \
  "Extent='2 4 0 1 7 7'>" POINTS(PAIR_OF("U", "1 1 2 2 3 3 4 4 5 5 6 6"))                \
      AXES("0.5 1 4", "-1 2", "9") "</Piece><Piece Extent='4 5 0 1 7 7'>" POINTS(        \
          PAIR_OF("U", "3 3 7 7 6 6 8 8")) axes "</Piece></RectilinearGrid></VTKFile>"
#define WRONG(axes, words, status_)                                                      \
  {                                                                                      \
    .what = words, .text = RIGHT(axes), .status = status_, .refused = words              \
  }

static const situation SITUATIONS[] = {
    {.what = "three scalars are a vector",
     .text = VOLUME(ONE_OF("vel_z") ONE_OF("p") ONE_OF("vel_x") ONE_OF("vel_y")),
     .field = " 3 x 3 x 3\n|name 'vel_x'\nx =|name 'vel_y'\ny =|name 'vel_z'\nz ="},
    {.what = "three scalars by name",
     .options = {.vars = "p,vel_x,vel_z"},
     .field = "name 'p'\nx =|name 'vel_z'\nz ="},
    {.what = "two scalars by name",
     .options = {.vars = "vel_x,vel_y"},
     .refused = "3 x 3 x 3 points needs three",
     .hint = "--vars U,V,W"},
    {.what = "two scalars",
     .text = VOLUME(ONE_OF("u") ONE_OF("v")),
     .refused = "needs three comp"},
    {.what = "two vectors of three scalars and a pair",
     .text = VOLUME(ONE_OF("cx") ONE_OF("cy") ONE_OF("cz") ONE_OF("bx") ONE_OF("by")
                        ONE_OF("bz") ONE_OF("ax") ONE_OF("ay")),
     .status = FG_STATUS_ARGUMENT,
     .refused = "2 vectors|cx,cy,cz; bx,by,bz"},
    {.what = "two layers of points are a plane with a mean",
     .text = IMAGE("0 1 0 2 0 2", POINTS(SCALAR("u", EIGHTEEN) SCALAR("v", EIGHTEEN))),
     .field = " 3 x 3\n|u = 1.5 "},
    {.what = "rectilinear grids have their own axes",
     .text = RIGHT(AXES("4 4.25", "-1 2", "9")),
     .field = " 4 x 2\n|x = 0.5 1 4 4.25\n|y = -1 2\n|u = 1 2 3 7 4 5 6 8\n"},
    WRONG(AXES("4", "-1 2", "9"), "cut short", FG_STATUS_FILE_FORMAT),
    WRONG(AXES("4 nan", "-1 2", "9"), "coordinate 3 of 4 along x", FG_STATUS_FILE_FORMAT),
    WRONG(AXES("4 3", "-1 2", "9"), "does not ascend", FG_STATUS_ARGUMENT),
    WRONG("", "0 arrays of coordinates", FG_STATUS_FILE_FORMAT),
    WRONG("<Coordinates>" VECTOR("a", "1 2 3 4 5 6") SCALAR("b", "-1 2")
              SCALAR("c", "9") "</Coordinates>",
          "are vectors", FG_STATUS_FILE_FORMAT),
};

static void texts_are_read_or_refused(void **state)
{
  check_texts(*state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
}

static void an_inventory_tells_of_a_volume(void **state)
{
  example_text file = volume(&TEXT, false, "");
  fg_inventory *inventory = NULL;
  fg__source source = {.path = "a.vti", .bytes = file.bytes, .size = file.size};
  assert_int_equal(fg__inventory_create(&inventory, *state, "x"), FG_STATUS_OK);
  assert_int_equal(
      fg__dataset_inventory(inventory, *state, &fg__format_vti, &source, NULL),
      FG_STATUS_OK);
  const fg_inventory_vector *u = fg_inventory_vector_at(inventory, 0);
  assert_int_equal(u->dimension, 3);
  assert_int_equal(u->components, 3);
  assert_true(u->size[0] == NX && u->size[1] == NY && u->size[2] == NZ);
  assert_true(u->bounds[1] == 3.0 && u->bounds[3] == 2.75 && u->bounds[5] == 7.0);
  assert_true(u->missing_share == 0.0);
  assert_null(u->unusable);
  fg_inventory_destroy(inventory);
  example_free(&file);
}

static void add_number(example_text *file, double number)
{
  char words[64];
  snprintf(words, sizeof words, " %g", number);
  example_words(file, words);
}

/* A rectilinear grid whose axes of `which` (bits) descend, and with them its vectors U;
 * M is zero at one place. */
static example_text descending(int which, bool cells)
{
  const int points[3] = {NX, NY, NZ}, less = cells ? 1 : 0;
  int at[3], place[3];
  example_text file = {0};
  example_words(&file, "<VTKFile type='RectilinearGrid'><RectilinearGrid "
                       "WholeExtent='0 4 0 3 0 2'><Piece Extent='0 4 0 3 0 2'>"
                       "<Coordinates>");
  for (int k = 0; k < 3; ++k) {
    example_words(&file, "<DataArray type='Float64'>");
    for (int i = 0; i < points[k]; ++i) {
      const int n = which >> k & 1 ? points[k] - 1 - i : i;
      add_number(&file, k + n + 0.25 * n * n);
    }
    example_words(&file, "</DataArray>");
  }
  example_words(&file, "</Coordinates>");
  for (int marks = 0; marks < 2; ++marks) {
    example_words(&file, marks   ? "<DataArray type='Float64' Name='M'>"
                         : cells ? "<CellData><DataArray type='Float64' "
                                   "NumberOfComponents='3' Name='U'>"
                                 : "<PointData><DataArray type='Float64' "
                                   "NumberOfComponents='3' Name='U'>");
    for (at[2] = 0; at[2] < NZ - less; ++at[2])
      for (at[1] = 0; at[1] < NY - less; ++at[1])
        for (at[0] = 0; at[0] < NX - less; ++at[0]) {
          for (int k = 0; k < 3; ++k)
            place[k] = which >> k & 1 ? points[k] - less - 1 - at[k] : at[k];
          if (marks)
            add_number(&file, place[0] + 2 * place[1] != 3 || place[2] != 1);
          else
            for (int c = 0; c < 3; ++c)
              add_number(&file, sample(place[0], place[1], place[2], c));
        }
    example_words(&file, "</DataArray>");
  }
  example_words(&file, cells ? "</CellData>" : "</PointData>");
  example_words(&file, "</Piece></RectilinearGrid></VTKFile>");
  return file;
}

/* Whichever of its axes descend in the file: it is the field of ascending ones. */
static void axes_that_descend_are_reversed(void **state)
{
  for (int cells = 0; cells < 2; ++cells)
    for (int masked = 0; masked < 2; ++masked) {
      const fg_read_options options = {.mask = masked ? "M" : NULL};
      example_text file = descending(0, cells);
      fg_field *ascending = field_of(*state, &file, &options);
      const fg_field_arrays *a = fg_field_contents(ascending);
      if (!cells && !masked)
        assert_points(ascending);
      for (int which = 1; which < 8; ++which) {
        int missing = 0;
        file = descending(which, cells);
        fg_field *field = field_of(*state, &file, &options);
        const fg_field_arrays *f = fg_field_contents(field);
        for (int k = 0; k < 3; ++k) {
          assert_memory_equal(f->axis[k], a->axis[k],
                              (size_t)a->size[k] * sizeof(double));
          for (size_t n = 0; n < COUNT; ++n) {
            missing += isnan(f->velocity[k][n]);
            assert_true(f->velocity[k][n] == a->velocity[k][n] ||
                        (isnan(f->velocity[k][n]) && isnan(a->velocity[k][n])));
          }
        }
        assert_true((missing > 0) == masked && missing < 3 * COUNT);
        fg_field_destroy(field);
      }
      fg_field_destroy(ascending);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points_of_a_volume_are_read_in_every_encoding),
      cmocka_unit_test(pieces_make_a_whole),
      cmocka_unit_test(cells_go_to_their_points),
      cmocka_unit_test(hidden_cells_are_holes),
      cmocka_unit_test(a_mask_leaves_its_points_out),
      cmocka_unit_test(an_inventory_tells_of_a_volume),
      cmocka_unit_test(axes_that_descend_are_reversed),
      cmocka_unit_test(texts_are_read_or_refused),
  };
  return cmocka_run_group_tests_name("read/vtk/volume", tests, context_set_up,
                                     context_tear_down);
}
