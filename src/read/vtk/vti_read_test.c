#include "read/vtk/vti_example.h"

#include <math.h>

static const example_encoding ASCII = {.type = EXAMPLE_FLOAT64};

static bool is_missing(const fg_field *field, size_t i)
{
  const fg_field_arrays *a = fg_field_contents(field);
  return (a->valid && !a->valid[i]) || isnan(a->velocity[0][i]) ||
         isnan(a->velocity[1][i]);
}

/* "0 1 1": missing, not, not. */
static void assert_missing(const fg_field *field, const char *there)
{
  size_t i = 0;
  for (; *there; ++there)
    if (*there == '0' || *there == '1')
      assert_int_equal(is_missing(field, i++), *there == '0');
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(i, a->size[0] * a->size[1]);
}

static void assert_numbers(const float *found, const double *expected, size_t count)
{
  for (size_t i = 0; i < count; ++i)
    assert_true(fabs((double)found[i] - expected[i]) <= 1e-6 * fabs(expected[i]));
}

/* 3 x 2 points */
#define SIX "1 10 0 2 20 0 3 30 0\n4 40 0 5 50 0 6 60 0"

static void cells_are_averaged_onto_the_points(void **state)
{
  /* 2 x 2 cells: a corner has one cell, an edge two, the middle all four */
  static const double u[9] = {1, 1.5, 2, 2, 2.75, 3.5, 3, 4, 5};
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "Spacing='2 1 1'", "0 2 0 2 0 1",
                CELLS(VECTOR("U", "1 -1 9 2 -2 9 3 -3 9 5 -5 9")));
  fg_field *field = example_field(*state, file, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 3);
  assert_int_equal(a->size[1], 3);
  assert_true(a->axis[0][2] == 4.0 && a->axis[1][2] == 2.0);
  assert_numbers(a->velocity[0], u, 9);
  for (size_t i = 0; i < 9; ++i)
    assert_true(a->velocity[1][i] == -a->velocity[0][i]);
  assert_string_equal(a->velocity_name[1], "U_y");
  assert_string_equal(a->title, "U");
  fg_field_destroy(field);
}

static void a_layer_along_any_axis_is_a_plane(void **state)
{
  static const struct {
    const char *extent;
    int size[2];
    int component[2];
    const char *names[2];
  } cases[] = {
      {"0 2 0 1 7 7", {3, 2}, {0, 1}, {"x", "y"}},
      {"0 2 7 7 0 1", {3, 2}, {0, 2}, {"x", "z"}},
      {"7 7 0 2 0 1", {3, 2}, {1, 2}, {"y", "z"}},
      {"0 1 0 2 -3 -3", {2, 3}, {0, 1}, {"x", "y"}},
  };
  for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
    char file[EXAMPLE_FILE_BYTES];
    example_image(
        file, "", cases[c].extent,
        POINTS(VECTOR("U", "1 10 100 2 20 200 3 30 300 4 40 400 5 50 500 6 60 600")));
    fg_field *field = example_field(*state, file, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    for (size_t k = 0; k < 2; ++k) {
      assert_int_equal(a->size[k], cases[c].size[k]);
      assert_string_equal(a->axis_name[k], cases[c].names[k]);
      double scale = pow(10.0, cases[c].component[k]);
      for (size_t i = 0; i < 6; ++i)
        assert_true((double)a->velocity[k][i] == scale * (double)(i + 1));
    }
    fg_field_destroy(field);
  }
}

static void two_layers_of_points_are_their_mean(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 2 0 1 0 2",
                POINTS(VECTOR("U", "1 0 1 2 0 1 3 0 1  5 0 9 6 0 9 9 0 9\n"
                                   "10 0 2 11 0 2 12 0 2  20 0 4 21 0 4 22 0 4\n"
                                   "0 0 0 0 0 0 0 0 0  2 0 2 4 0 4 6 0 6")));
  /* two points along y: the plane is x, z, the mean of rows that lie one after another */
  static const double u[9] = {3, 4, 6, 15, 16, 17, 1, 2, 3};
  static const double w[9] = {5, 5, 5, 3, 3, 3, 1, 2, 3};
  fg_field *field = example_field(*state, file, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 3);
  assert_int_equal(a->size[1], 3);
  assert_numbers(a->velocity[0], u, 9);
  assert_numbers(a->velocity[1], w, 9);
  fg_field_destroy(field);
}

static void pieces_make_the_same_field_as_the_whole(void **state)
{
  enum { NX = 5, NY = 4 };
  static const int cuts[][6] = {
      {0, 2, 0, 3, 0, 0}, {2, 4, 0, 1, 0, 0}, {1, 4, 1, 3, 0, 0}}; /* two overlap */
  for (int place = 0; place < 2; ++place) {
    int nx = place == 0 ? NX : NX - 1;
    example_text file = {0}, appended = {0};
    example_begin(&file, &ASCII, "WholeExtent=\"0 4 0 3 0 0\"");
    for (size_t p = 0; p < 3; ++p) {
      double numbers[2 * NX * NY];
      size_t count = 0;
      int more = place == 0 ? 1 : 0;
      for (int y = cuts[p][2]; y < cuts[p][3] + more; ++y)
        for (int x = cuts[p][0]; x < cuts[p][1] + more; ++x) {
          numbers[count++] = 1.0 + y * nx + x;
          numbers[count++] = x - 7.0 * y;
        }
      char words[128];
      snprintf(words, sizeof words, "<Piece Extent=\"%d %d %d %d 0 0\"><%s>", cuts[p][0],
               cuts[p][1], cuts[p][2], cuts[p][3], place == 0 ? "PointData" : "CellData");
      example_words(&file, words);
      example_array(&file, &appended, &ASCII, "v", 2, numbers, count);
      example_words(&file, place == 0 ? "</PointData></Piece>" : "</CellData></Piece>");
    }
    example_words(&file, "<Piece Extent=\"0 -1 0 -1 0 -1\"/>");
    example_end(&file, &appended, &ASCII);
    fg_field *field = NULL;
    assert_int_equal(example_read(&field, *state, file.bytes, file.size, NULL),
                     FG_STATUS_OK);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], NX);
    assert_int_equal(a->size[1], NY);
    for (size_t y = 1; y < NY - 1; ++y)
      for (size_t x = 1; x < NX - 1; ++x) {
        /* linear, so that a mean over four cells is half a cell down and left of them */
        double offset = place == 0 ? 0.0 : 0.5;
        double i = (double)x - offset, j = (double)y - offset;
        size_t at = y * NX + x;
        assert_true((double)a->velocity[0][at] == 1.0 + j * nx + i);
        assert_true((double)a->velocity[1][at] == i - 7.0 * j);
      }
    fg_field_destroy(field);
    example_free(&file);
  }
}

static void assert_chosen(fg_context *context, const char *data, const char *vars,
                          const char *u_name, float first)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 2 0 1 0 0", data);
  fg_read_options options = {.vars = vars};
  fg_field *field = example_field(context, file, &options);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_string_equal(a->velocity_name[0], u_name);
  assert_true(a->velocity[0][0] == first);
  fg_field_destroy(field);
}

static void assert_not_chosen(fg_context *context, const char *data, const char *vars,
                              fg_status expected, const char *words)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 2 0 1 0 0", data);
  fg_read_options options = {.vars = vars};
  fg_field *field = NULL;
  assert_int_equal(example_read_words(&field, context, file, &options), expected);
  assert_null(field);
  if (!strstr(fg_context_message(context), words))
    assert_non_null(strstr(fg_context_hint(context), words));
}

#define ONES "1 1 1 1 1 1"
#define TWOS "2 2 2 2 2 2"
#define THREES "3 3 3 3 3 3"
#define SIX2 "7 1 7 1 7 1 7 1 7 1 7 1"

static void the_vector_is_found(void **state)
{
  assert_chosen(*state, POINTS(SCALAR("p", ONES) VECTOR("U", SIX)), NULL, "U_x", 1);
  assert_chosen(*state,
                "<PointData Vectors='B'>" VECTOR("A", SIX)
                    PAIR_OF("B", SIX2) "</PointData>",
                NULL, "B_x", 7);
  assert_chosen(*state, POINTS(VECTOR("A", SIX) PAIR_OF("B", SIX2)), "B", "B_x", 7);
  assert_chosen(
      *state,
      POINTS(SCALAR("v", ONES) SCALAR("u", TWOS) SCALAR("x", ONES) SCALAR("y", ONES)),
      NULL, "u", 2);
  assert_chosen(*state, POINTS(SCALAR("wind_y", ONES) SCALAR("wind_x", TWOS)), NULL,
                "wind_x", 2);
  assert_chosen(*state, POINTS(SCALAR("u10", THREES) SCALAR("v10", ONES)), NULL, "u10",
                3);
  assert_chosen(*state, POINTS(SCALAR("a", ONES) SCALAR("b", TWOS)), "b,a", "b", 2);
  /* a vector is found before pairs, and colours are no vectors */
  assert_chosen(*state, POINTS(SCALAR("u", ONES) SCALAR("v", TWOS) VECTOR("U", SIX)),
                NULL, "U_x", 1);
  assert_chosen(*state,
                POINTS("<DataArray type='UInt8' Name='rgb' NumberOfComponents='3'>" SIX
                       "</DataArray>" VECTOR("U", SIX)),
                NULL, "U_x", 1);
  /* one name on points and cells is one quantity */
  assert_chosen(*state, CELLS(VECTOR("U", "8 8 8 8 8 8")) POINTS(VECTOR("U", SIX)), NULL,
                "U_x", 1);
}

static void what_cannot_be_chosen_is_explained(void **state)
{
  const char *two = POINTS(VECTOR("first", SIX) VECTOR("second", SIX));
  assert_not_chosen(*state, two, NULL, FG_STATUS_ARGUMENT, "first; second");
  assert_not_chosen(*state, two, NULL, FG_STATUS_ARGUMENT, "--vars first");
  assert_not_chosen(*state, two, "third", FG_STATUS_ARGUMENT, "first; second");
  assert_not_chosen(*state, two, "", FG_STATUS_ARGUMENT, "first; second");
  assert_not_chosen(*state, two, "first,second", FG_STATUS_ARGUMENT, "3 components");
  assert_not_chosen(*state, POINTS(SCALAR("p", ONES)), NULL, FG_STATUS_UNSUPPORTED,
                    "no vectors found among its 1 variable: p");
  assert_not_chosen(*state, "", NULL, FG_STATUS_UNSUPPORTED, "0 variables");
  assert_not_chosen(*state, POINTS(SCALAR("p", ONES)), "p", FG_STATUS_ARGUMENT,
                    "is one variable");
  assert_not_chosen(*state, POINTS(SCALAR("p", ONES)), "p,q", FG_STATUS_ARGUMENT, "'q'");
  assert_not_chosen(*state, POINTS(SCALAR("p", ONES)), "p,p,p,p", FG_STATUS_ARGUMENT,
                    "two or three names");
  assert_not_chosen(*state, POINTS(SCALAR("p", ONES)) CELLS(SCALAR("q", "1 1")), "p,q",
                    FG_STATUS_UNSUPPORTED, "points and cells");
  assert_not_chosen(*state, POINTS(SCALAR("U", ONES) VECTOR("U", SIX)), NULL,
                    FG_STATUS_FILE_FORMAT, "two arrays");
}

static void only_one_snapshot_is_there(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 2 0 1 0 0", POINTS(VECTOR("U", SIX)));
  fg_field *field = NULL;
  fg_read_options time = {.time = 2}, level = {.level = -1}, from = {.vars_from = "x"};
  assert_int_equal(example_read_words(&field, *state, file, &time), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(*state), "time 2"));
  assert_int_equal(example_read_words(&field, *state, file, &level), FG_STATUS_ARGUMENT);
  assert_int_equal(example_read_words(&field, *state, file, &from),
                   FG_STATUS_UNSUPPORTED);
  fg_read_options geo = {.scale = FG_SCALE_GEO};
  field = example_field(*state, file, &geo);
  assert_true(fg_field_contents(field)->scale == FG_SCALE_GEO);
  fg_field_destroy(field);
}

static void words_are_taken_from_the_file(void **state)
{
  static const char file[] =
      "<?xml version=\"1.0\"?><!-- <by hand> -->\n"
      "<VTKFile type='ImageData'><ImageData WholeExtent='0 2 0 1 0 0'>"
      "<FieldData><DataArray type='Float64' Name='TimeValue' NumberOfTuples='1' "
      "format='ascii'>0.03</DataArray></FieldData>"
      "<Piece Extent='0 2 0 1 0 0'><PointData><DataArray type='Float64' Name='a &lt; b' "
      "NumberOfComponents='2'> <InformationKey name='UNITS_LABEL' "
      "location='vtkDataArray'>"
      " mm/s\n</InformationKey>" SIX2 "</DataArray></PointData></Piece></ImageData>"
      "</VTKFile>";
  fg_field *field = example_field(*state, file, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_string_equal(a->time, "t = 0.03");
  assert_string_equal(a->velocity_units, "mm/s");
  assert_string_equal(a->title, "a < b");
  assert_true(a->scale == FG_SCALE_PLAIN);
  fg_field_destroy(field);
}

/* 4 x 3 points of something */
#define TWELVE "1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2"

static void assert_mask(fg_context *context, const char *data, const char *mask,
                        const char *there)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 3 0 2 0 0", data);
  fg_read_options options = {.mask = mask};
  fg_field *field = example_field(context, file, &options);
  assert_missing(field, there);
  fg_field_destroy(field);
}

static void missing_samples_are_known(void **state)
{
  /* NaN in either component */
  assert_mask(
      *state,
      POINTS(PAIR_OF("U", "nan 2 1 2 1 2 1 2\n1 2 1 2 1 NaN 1 2\n1 2 1 2 1 2 1 2")), NULL,
      "0111 1101 1111");
  /* bit 2 is hidden, bit 1 only a duplicate */
  assert_mask(
      *state,
      POINTS(PAIR_OF("U", TWELVE) BYTES("vtkGhostType", "2 0 1 0 0 0 0 0 0 0 0 3")), NULL,
      "0111 1111 1110");
  assert_mask(
      *state,
      POINTS(PAIR_OF("U", TWELVE) BYTES("vtkValidPointMask", "1 1 1 0 1 1 1 1 1 1 1 1")),
      NULL, "1110 1111 1111");
  /* a hidden cell, the last of the first row, takes its four corners */
  assert_mask(*state,
              POINTS(PAIR_OF("U", TWELVE)) CELLS(BYTES("vtkGhostType", "0 1 32 0 0 0")),
              NULL, "1100 1100 1111");
  assert_mask(*state,
              CELLS(PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 1 2")
                        BYTES("vtkGhostType", "32 4 0 0 0 0")),
              NULL, "0011 0011 1111");
  assert_mask(*state, CELLS(PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 nan nan")), NULL,
              "1111 1100 1100");
}

static void a_mask_is_zero_outside(void **state)
{
  assert_mask(*state,
              POINTS(PAIR_OF("U", TWELVE) SCALAR("m", "0 1 2 1 1 1 1 1 1 nan 1 1")), "m",
              "0111 1111 1011");
  /* flags of velocimetry are negative where a vector was rejected */
  assert_mask(*state,
              POINTS(PAIR_OF("U", TWELVE) SCALAR("m", "1 1 1 1 1 1 -3 1 1 1 1 1")), "m",
              "1111 1101 1111");
  /* a vector is its own mask where it is filled with zeros */
  assert_mask(*state,
              POINTS(PAIR_OF("U", "0 0 0 1 1 0 -1 0\n1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2")),
              "U", "0111 1111 1111");
  /* the mask on cells, the vector on points */
  assert_mask(*state, POINTS(PAIR_OF("U", TWELVE)) CELLS(SCALAR("m", "1 1 1 0 1 1")), "m",
              "1111 0011 0011");

  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 3 0 2 0 0", POINTS(PAIR_OF("U", TWELVE)));
  fg_read_options options = {.mask = "m"};
  fg_field *field = NULL;
  assert_int_equal(example_read_words(&field, *state, file, &options),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_hint(*state), "U"));
}

static fg_inventory *inventory_of(fg_context *context, const char *words)
{
  fg_inventory *inventory = NULL;
  fg_context_clear(context);
  assert_int_equal(fg__inventory_create(&inventory, context, "x"), FG_STATUS_OK);
  fg__source source = {
      .path = "a.vti", .bytes = (const unsigned char *)words, .size = strlen(words)};
  assert_int_equal(fg__format_vti.inventory(inventory, context, &source, NULL),
                   FG_STATUS_OK);
  return inventory;
}

static void every_vector_is_listed(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(
      file, "Origin='1 2 3' Spacing='0.5 2 1'", "0 3 0 2 0 0",
      "<PointData Vectors='U'>" PAIR_OF("U", "nan 2 1 2 1 2 1 2\n1 2 1 2 1 NaN 1 2\n"
                                             "1 2 nan 2 1 2 1 2")
          SCALAR("vx", "1 1 1 1 1 1 1 1 1 1 1 1") SCALAR("vy", "1 1 1 1 1 1 1 1 1 1 1 1")
              SCALAR("p", "") "</PointData>" CELLS(PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 1 2")
                                                       SCALAR("p", "")));
  fg_inventory *inventory = inventory_of(*state, file);
  assert_int_equal(fg_inventory_vector_count(inventory), 2);
  const fg_inventory_vector *u = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(u->name[0], "U");
  assert_null(u->name[1]);
  assert_string_equal(u->found_by, "Vectors attribute");
  assert_int_equal(u->components, 2);
  assert_int_equal(u->dimension, 2);
  assert_int_equal(u->size[0], 4);
  assert_int_equal(u->size[1], 3);
  assert_true(u->missing_share == 0.25);
  assert_true(u->bounds[0] == 1.0 && u->bounds[1] == 2.5);
  assert_true(u->bounds[2] == 2.0 && u->bounds[3] == 6.0);
  assert_null(u->unusable);
  const fg_inventory_vector *pair = fg_inventory_vector_at(inventory, 1);
  assert_string_equal(pair->name[1], "vy");
  assert_string_equal(pair->found_by, "names");
  fg_inventory_destroy(inventory);
}

static void infinite_samples_are_missing(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  example_image(file, "", "0 3 0 2 0 0",
                POINTS(PAIR_OF("U", "inf 2 1 2 1 2 1 -inf 1 2 1 2 1 2 1 nan 1 2 1 2 1 2 "
                                    "1 2")));
  fg_field *field = example_field(*state, file, NULL);
  assert_missing(field, "011011101111");
  assert_int_equal(fg_field_infinite(field), 2);
  fg_field_destroy(field);
  fg_inventory *inventory = inventory_of(*state, file);
  assert_true(fg_inventory_vector_at(inventory, 0)->missing_share == 0.25);
  fg_inventory_destroy(inventory);
  /* one cell of six, at a corner of the grid: the four points round it */
  example_image(file, "", "0 3 0 2 0 0",
                CELLS(PAIR_OF("U", "inf 2 1 2 1 2 1 2 1 2 1 2")));
  field = example_field(*state, file, NULL);
  assert_missing(field, "001100111111");
  assert_int_equal(fg_field_infinite(field), 4);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_are_averaged_onto_the_points),
      cmocka_unit_test(a_layer_along_any_axis_is_a_plane),
      cmocka_unit_test(two_layers_of_points_are_their_mean),
      cmocka_unit_test(pieces_make_the_same_field_as_the_whole),
      cmocka_unit_test(the_vector_is_found),
      cmocka_unit_test(what_cannot_be_chosen_is_explained),
      cmocka_unit_test(only_one_snapshot_is_there),
      cmocka_unit_test(words_are_taken_from_the_file),
      cmocka_unit_test(missing_samples_are_known),
      cmocka_unit_test(infinite_samples_are_missing),
      cmocka_unit_test(a_mask_is_zero_outside),
      cmocka_unit_test(every_vector_is_listed),
  };
  return cmocka_run_group_tests_name("read/vtk/vti_read", tests, context_set_up,
                                     context_tear_down);
}
