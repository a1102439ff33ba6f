/* What is found in VTK XML images, and what is missing in them. */
#include "read/situation_test.h"
#include "read/vtk/vti_example.h"

static const example_encoding ASCII = {.type = EXAMPLE_FLOAT64};

#define IMAGE(attributes, extent, data)                                                  \
  "<VTKFile type='ImageData' version='0.1'><ImageData WholeExtent='" extent              \
  "' " attributes "><Piece Extent='" extent "'>" data "</Piece></ImageData></VTKFile>"
/* 3 x 2 points */
#define SIX "1 10 0 2 20 0 3 30 0\n4 40 0 5 50 0 6 60 0"
#define ONES "1 1 1 1 1 1"
#define TWOS "2 2 2 2 2 2"
#define THREES "3 3 3 3 3 3"
#define SIX2 "7 1 7 1 7 1 7 1 7 1 7 1"
#define SMALL(data) IMAGE("", "0 2 0 1 0 0", data)
#define TWO POINTS(VECTOR("first", SIX) VECTOR("second", SIX))
#define FOUND(what_, data, vars_, name, first)                                           \
  {                                                                                      \
    .what = what_, .text = SMALL(data), .options = {.vars = vars_},                      \
    .field = "name '" name "'\nx =|u = " first " "                                       \
  }
#define REFUSED(what_, data, vars_, status_, words)                                      \
  {                                                                                      \
    .what = what_, .text = SMALL(data), .options = {.vars = vars_}, .status = status_,   \
    .refused = words                                                                     \
  }
#define LAYER(extent, size, first, second, u, v)                                         \
  {                                                                                      \
    .what = "a layer of " extent,                                                        \
    .text = IMAGE("", extent,                                                            \
                  POINTS(VECTOR("U", "1 10 100 2 20 200 3 30 300 4 40 400 5 50 500 6 "   \
                                     "60 600"))),                                        \
    .field = " " size "\n|axis 0 '" first "'|axis 1 '" second "'|u = " u "|v = " v       \
  }
#define BY_ONE "1 2 3 4 5 6\n"
#define BY_TEN "10 20 30 40 50 60\n"
#define BY_HUNDRED "100 200 300 400 500 600\n"

/* 4 x 3 points of something; which of them are missing */
#define TWELVE "1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2"
#define LARGE(data) IMAGE("", "0 3 0 2 0 0", data)
#define MISSING(what_, data, mask_, u_)                                                  \
  {                                                                                      \
    .what = what_, .text = LARGE(data), .options = {.mask = mask_},                      \
    .field = "u = " u_ "\n"                                                              \
  }

static const situation SITUATIONS[] = {
    /* 2 x 2 cells: a corner has one cell, an edge two, the middle all four */
    {.what = "cells are averaged onto the points",
     .text = IMAGE("Spacing='2 1 1'", "0 2 0 2 0 1",
                   CELLS(VECTOR("U", "1 -1 9 2 -2 9 3 -3 9 5 -5 9"))),
     .field = " 3 x 3\n|x = 0 2 4\n|y = 0 1 2\n|u = 1 1.5 2 2 2.75 3.5 3 4 5\n|v = -1 "
              "-1.5 -2 -2 -2.75 -3.5 -3 -4 -5\n|name 'U_y'|title 'U'"},
    LAYER("0 2 0 1 7 7", "3 x 2", "x", "y", BY_ONE, BY_TEN),
    LAYER("0 2 7 7 0 1", "3 x 2", "x", "z", BY_ONE, BY_HUNDRED),
    LAYER("7 7 0 2 0 1", "3 x 2", "y", "z", BY_TEN, BY_HUNDRED),
    LAYER("0 1 0 2 -3 -3", "2 x 3", "x", "y", BY_ONE, BY_TEN),
    /* two points along y: the plane is x, z, the mean of rows one after another */
    {.what = "two layers of points are their mean",
     .text = IMAGE("", "0 2 0 1 0 2",
                   POINTS(VECTOR("U", "1 0 1 2 0 1 3 0 1  5 0 9 6 0 9 9 0 9\n"
                                      "10 0 2 11 0 2 12 0 2  20 0 4 21 0 4 22 0 4\n"
                                      "0 0 0 0 0 0 0 0 0  2 0 2 4 0 4 6 0 6"))),
     .field = " 3 x 3\n|u = 3 4 6 15 16 17 1 2 3\n|v = 5 5 5 3 3 3 1 2 3\n"},
    FOUND("a vector", POINTS(SCALAR("p", ONES) VECTOR("U", SIX)), NULL, "U_x", "1"),
    FOUND("the active vector",
          "<PointData Vectors='B'>" VECTOR("A", SIX) PAIR_OF("B", SIX2) "</PointData>",
          NULL, "B_x", "7"),
    FOUND("a named vector", POINTS(VECTOR("A", SIX) PAIR_OF("B", SIX2)), "B", "B_x", "7"),
    FOUND("a pair beside places",
          POINTS(SCALAR("v", ONES) SCALAR("u", TWOS) SCALAR("x", ONES) SCALAR("y", ONES)),
          NULL, "u", "2"),
    FOUND("a pair of one stem", POINTS(SCALAR("wind_y", ONES) SCALAR("wind_x", TWOS)),
          NULL, "wind_x", "2"),
    FOUND("a pair at a height", POINTS(SCALAR("u10", THREES) SCALAR("v10", ONES)), NULL,
          "u10", "3"),
    FOUND("a named pair", POINTS(SCALAR("a", ONES) SCALAR("b", TWOS)), "b,a", "b", "2"),
    FOUND("a vector before a pair",
          POINTS(SCALAR("u", ONES) SCALAR("v", TWOS) VECTOR("U", SIX)), NULL, "U_x", "1"),
    FOUND("colours are no vector",
          POINTS("<DataArray type='UInt8' Name='rgb' NumberOfComponents='3'>" SIX
                 "</DataArray>" VECTOR("U", SIX)),
          NULL, "U_x", "1"),
    FOUND("one name on points and cells is one quantity",
          CELLS(VECTOR("U", "8 8 8 8 8 8")) POINTS(VECTOR("U", SIX)), NULL, "U_x", "1"),
    {.what = "two vectors",
     .text = SMALL(TWO),
     .status = FG_STATUS_ARGUMENT,
     .refused = "first; second",
     .hint = "--vars first"},
    REFUSED("a third of two", TWO, "third", FG_STATUS_ARGUMENT, "first; second"),
    REFUSED("no name", TWO, "", FG_STATUS_ARGUMENT, "first; second"),
    REFUSED("two vectors as components", TWO, "first,second", FG_STATUS_ARGUMENT,
            "3 components"),
    REFUSED("a scalar", POINTS(SCALAR("p", ONES)), NULL, FG_STATUS_UNSUPPORTED,
            "no vectors found among its 1 variable: p"),
    REFUSED("nothing", "", NULL, FG_STATUS_UNSUPPORTED, "0 variables"),
    REFUSED("a named scalar", POINTS(SCALAR("p", ONES)), "p", FG_STATUS_ARGUMENT,
            "is one variable"),
    REFUSED("a second that is not there", POINTS(SCALAR("p", ONES)), "p,q",
            FG_STATUS_ARGUMENT, "'q'"),
    REFUSED("four names", POINTS(SCALAR("p", ONES)), "p,p,p,p", FG_STATUS_ARGUMENT,
            "two or three names"),
    REFUSED("points and cells", POINTS(SCALAR("p", ONES)) CELLS(SCALAR("q", "1 1")),
            "p,q", FG_STATUS_UNSUPPORTED, "points and cells"),
    REFUSED("one name twice", POINTS(SCALAR("U", ONES) VECTOR("U", SIX)), NULL,
            FG_STATUS_FILE_FORMAT, "two arrays"),
    {.what = "a longitude and latitude, as asked",
     .text = SMALL(POINTS(VECTOR("U", SIX))),
     .options = {.scale = FG_SCALE_GEO},
     .field = "geo "},
    {.what = "there is one time",
     .options = {.time = 2},
     .status = FG_STATUS_ARGUMENT,
     .refused = "time 2"},
    {.what = "there is one level",
     .options = {.level = -1},
     .status = FG_STATUS_ARGUMENT,
     .refused = "level -1"},
    {.what = "no second file", .options = {.vars_from = "x"}, .refused = ""},
    {.what = "time, units and a name with a reference",
     .text = "<?xml version=\"1.0\"?><!-- <by hand> -->\n"
             "<VTKFile type='ImageData'><ImageData WholeExtent='0 2 0 1 0 0'>"
             "<FieldData><DataArray type='Float64' Name='TimeValue' NumberOfTuples='1' "
             "format='ascii'>0.03</DataArray></FieldData>"
             "<Piece Extent='0 2 0 1 0 0'><PointData><DataArray type='Float64' Name='a "
             "&lt; b' NumberOfComponents='2'> <InformationKey name='UNITS_LABEL' "
             "location='vtkDataArray'> mm/s\n</InformationKey>" SIX2
             "</DataArray></PointData></Piece></ImageData></VTKFile>",
     .field = "plain |time 't = 0.03'|units 'mm/s'|title 'a < b'"},

    MISSING("not a number in either component",
            POINTS(PAIR_OF("U", "nan 2 1 2 1 2 1 2\n1 2 1 2 1 NaN 1 2\n1 2 1 2 1 2 1 2")),
            NULL, "nan 1 1 1 1 1 nan 1 1 1 1 1"),
    MISSING("bit 2 is hidden, bit 1 only a duplicate",
            POINTS(PAIR_OF("U", TWELVE) BYTES("vtkGhostType", "2 0 1 0 0 0 0 0 0 0 0 3")),
            NULL, "nan 1 1 1 1 1 1 1 1 1 1 nan"),
    MISSING("points that are not valid",
            POINTS(PAIR_OF("U", TWELVE)
                       BYTES("vtkValidPointMask", "1 1 1 0 1 1 1 1 1 1 1 1")),
            NULL, "1 1 1 nan 1 1 1 1 1 1 1 1"),
    MISSING("a hidden cell takes its four corners",
            POINTS(PAIR_OF("U", TWELVE)) CELLS(BYTES("vtkGhostType", "0 1 32 0 0 0")),
            NULL, "1 1 nan nan 1 1 nan nan 1 1 1 1"),
    MISSING("hidden cells",
            CELLS(PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 1 2")
                      BYTES("vtkGhostType", "32 4 0 0 0 0")),
            NULL, "nan nan 1 1 nan nan 1 1 1 1 1 1"),
    MISSING("a cell without a number", CELLS(PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 nan nan")),
            NULL, "1 1 1 1 1 1 nan nan 1 1 nan nan"),
    MISSING("a mask is zero outside",
            POINTS(PAIR_OF("U", TWELVE) SCALAR("m", "0 1 2 1 1 1 1 1 1 nan 1 1")), "m",
            "nan 1 1 1 1 1 1 1 1 nan 1 1"),
    MISSING("flags of velocimetry are negative where a vector was rejected",
            POINTS(PAIR_OF("U", TWELVE) SCALAR("m", "1 1 1 1 1 1 -3 1 1 1 1 1")), "m",
            "1 1 1 1 1 1 nan 1 1 1 1 1"),
    MISSING("a vector is its own mask where it is filled with zeros",
            POINTS(PAIR_OF("U", "0 0 0 1 1 0 -1 0\n1 2 1 2 1 2 1 2\n1 2 1 2 1 2 1 2")),
            "U", "nan 0 1 -1 1 1 1 1 1 1 1 1"),
    MISSING("the mask on cells, the vector on points",
            POINTS(PAIR_OF("U", TWELVE)) CELLS(SCALAR("m", "1 1 1 0 1 1")), "m",
            "1 1 1 1 nan nan 1 1 nan nan 1 1"),
    {.what = "a mask that is not there",
     .text = LARGE(POINTS(PAIR_OF("U", TWELVE))),
     .options = {.mask = "m"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "",
     .hint = "U"},
    {.what = "infinite samples are missing",
     .text = LARGE(POINTS(PAIR_OF("U", "inf 2 1 2 1 2 1 -inf 1 2 1 2 1 2 1 nan 1 2 1 2 1 "
                                       "2 1 2"))),
     .field = "u = nan 1 1 nan 1 1 1 nan 1 1 1 1\n|infinite 2\n",
     .inventory = "missing 0.25\n"},
    {.what = "one infinite cell of six takes the four points round it",
     .text = LARGE(CELLS(PAIR_OF("U", "inf 2 1 2 1 2 1 2 1 2 1 2"))),
     .field = "u = nan nan 1 1 nan nan 1 1 1 1 1 1\n|infinite 4\n"},
    {.what = "every vector is listed",
     .text = IMAGE("Origin='1 2 3' Spacing='0.5 2 1'", "0 3 0 2 0 0",
                   "<PointData Vectors='U'>" PAIR_OF(
                       "U", "nan 2 1 2 1 2 1 2\n1 2 1 2 1 NaN 1 2\n"
                            "1 2 nan 2 1 2 1 2") SCALAR("vx", "1 1 1 1 1 1 1 1 1 1 1 1")
                       SCALAR("vy", "1 1 1 1 1 1 1 1 1 1 1 1")
                           SCALAR("p", "") "</PointData>" CELLS(
                               PAIR_OF("U", "1 2 1 2 1 2 1 2 1 2 1 2") SCALAR("p", ""))),
     .inventory =
         "vectors 2\n[U Vectors attribute]\nplain 4 x 3\nmissing 0.25\n|bounds = "
         "1 2.5 2 6\n|[vx,vy names]|!unusable"},
};

static void images_are_read_or_refused(void **state)
{
  check_texts(*state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(images_are_read_or_refused),
      cmocka_unit_test(pieces_make_the_same_field_as_the_whole),
  };
  return cmocka_run_group_tests_name("read/vtk/vti_read", tests, context_set_up,
                                     context_tear_down);
}
