/* Points in layers, grids with gaps, and Tecplot's zones. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/situation_test.h"
#include "read/table/tables_test.h"

enum { N = 5, TEXT_BYTES = 1 << 14 };

static const char MIXED[] =
    "TITLE = \"cut\"\nVARIABLES = \"X [m]\" \"Y [m]\" \"U [m/s]\" \"V [m/s]\"\n"
    "ZONE T=\"a (b)\" I=2 J=2 F=BLOCK AUXDATA a=\"1\"\n0 1 0 1\n0 0 1 1\n1 2 3 4\n4*1\n"
    "ZONE N=3 E=1 F=FEPOINT ET=TRIANGLE\n0 2 1 1\n1 2 1 1\n0 3 1 1\n1 2 3\n";

/* Two layers across an axis, of a flow along the other two; `other` is added to one
 * component of one point. */
static const char *write_layers(char text[TEXT_BYTES], int across, double other)
{
  size_t used = (size_t)snprintf(text, TEXT_BYTES, "x,y,z,u,v,w\n");
  for (int n = 0; n < 2 * N * N; ++n) {
    double at[3], flow[3] = {0.0, 0.0, 0.0};
    at[across] = n / (N * N) ? 0.75 : 0.25;
    at[(across + 1) % 3] = n % N;
    at[(across + 2) % 3] = 2.0 * (double)(n / N % N);
    flow[(across + 1) % 3] = at[(across + 2) % 3] + (n == 3 ? other : 0.0);
    flow[(across + 2) % 3] = -1.0 - n % N;
    used += (size_t)snprintf(text + used, TEXT_BYTES - used, "%g,%g,%g,%g,%g,%g\n", at[0],
                             at[1], at[2], flow[0], flow[1], flow[2]);
  }
  return text;
}

static void equal_layers_are_a_plane(void **state)
{
  static const char *const level[] = {"x = 0.25 and 0.75", "y = 0.25 and 0.75",
                                      "z = 0.25 and 0.75"};
  static const int axes[3][2] = {{1, 2}, {0, 2}, {0, 1}};
  char text[TEXT_BYTES];
  for (int across = 0; across < 3; ++across) {
    fg_field *field = read_text(*state, write_layers(text, across, 0.0));
    const fg_field_arrays *f = fg_field_contents(field);
    assert_int_equal(f->dimension, 2);
    assert_string_equal(f->level, level[across]);
    for (int k = 0; k < 2; ++k) {
      const char name[2] = {"xyz"[axes[across][k]], '\0'};
      assert_int_equal(f->size[k], N);
      assert_string_equal(f->axis_name[k], name);
    }
    const int first = axes[across][0] == (across + 1) % 3 ? 0 : 1;
    for (int n = 0; n < N * N; ++n) {
      const int at[2] = {n % N, n / N};
      assert_true((double)f->velocity[first][n] == f->axis[1 - first][at[1 - first]]);
      assert_true((double)f->velocity[1 - first][n] == -1.0 - f->axis[first][at[first]]);
    }
    fg_field_destroy(field);
    field = read_text(*state, write_layers(text, across, 0.5));
    assert_int_equal(fg_field_contents(field)->dimension, 3);
    fg_field_destroy(field);
  }
}

/* Coordinates of two axes and all three components: those along the two are meant. The
 * flow is 1 along x, 2 along y and 3 along z. */
static void planes_have_the_components_along_them(void **state)
{
  static const struct {
    const char *columns;
    double flow[2];
  } cases[] = {{"x,y,u,v,w", {1.0, 2.0}},
               {"x,z,u,v,w", {1.0, 3.0}},
               {"y,z,u,v,w", {2.0, 3.0}},
               {"x,z,vx,vy,vz", {1.0, 3.0}},
               {"y,z,Velocity:0,Velocity:1,Velocity:2", {2.0, 3.0}},
               {"x,z,u,w", {1.0, 2.0}}};
  char text[TEXT_BYTES];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    size_t used = (size_t)snprintf(text, sizeof text, "%s\n", cases[i].columns);
    const bool two = strlen(cases[i].columns) < strlen("x,z,u,v,w");
    for (int n = 0; n < N * N; ++n)
      used += (size_t)snprintf(text + used, sizeof text - used, "%d,%d,1,2%s\n", n % N,
                               n / N, two ? "" : ",3");
    fg_field *field = read_text(*state, text);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_int_equal(f->dimension, 2);
    for (int k = 0; k < 2; ++k)
      if ((double)f->velocity[k][N + 1] != cases[i].flow[k])
        fail_msg("%s: component %d is %g", cases[i].columns, k,
                 (double)f->velocity[k][N + 1]);
    fg_field_destroy(field);
  }
}

/* Five lines at 0 to 4 and five more, u = the place across them. */
#define FIVE(row, b) row("0", b) row("1", b) row("2", b) row("3", b) row("4", b)
#define UPWARD(a, b) a "," b "," a ",1\n"
#define ALONG(a, b) b "," a "," a ",1\n"
#define LINES(row, v, w, x, y, z)                                                        \
  "x,y,u,v\n" ROW(row, "0", v, w, x, y, z) ROW(row, "1", v, w, x, y, z)                  \
      ROW(row, "2", v, w, x, y, z) ROW(row, "3", v, w, x, y, z)                          \
          ROW(row, "4", v, w, x, y, z)
#define ROW(row, b, v, w, x, y, z)                                                       \
  FIVE(row, b) row(v, b) row(w, b) row(x, b) row(y, b) row(z, b)

/* u = x + 2 y in a square of 2 x 2 without its upper right quarter */
#define L_SHAPED(what_, text_)                                                           \
  {                                                                                      \
    .what = what_, .text = text_,                                                        \
    .field = "linear 0 1 2 1 0 0|at 0.5 0.25 = 1 1|at 1.5 0.5 = 2.5 1|at 0.75 1.5 = "    \
             "3.75 1|at 1.5 1.5 = none"                                                  \
  }
#define DAMAGED(zone, status_, words)                                                    \
  {                                                                                      \
    .what = words, .text = "VARIABLES = x y u v\n" zone, .status = status_,              \
    .refused = words                                                                     \
  }

static const situation SITUATIONS[] = {
    {.what = "a gap between columns",
     .text = LINES(UPWARD, "40", "41", "42", "43", "44"),
     .field = "at 3.5 1.5 = 3.5 1|at 40.5 1.5 = 40.5 1|at 22 1.5 = none"},
    {.what = "a gap between rows",
     .text = LINES(ALONG, "40", "41.25", "42.5", "43.75", "45"),
     .field = "at 1.5 3.5 = 3.5 1|at 1.5 40.5 = 40.5 1|at 1.5 22 = none"},
    {.what = "a step that is no gap",
     .text = LINES(UPWARD, "7", "8.5", "10", "11.5", "13"),
     .field = "at 3.5 1.5 = 3.5 1|at 7.5 1.5 = 7.5 1|at 5.5 1.5 = 5.5 1"},
    L_SHAPED("two ordered zones, by points",
             "TITLE = \"an L\"\nVARIABLES = \"X\" \"Y\" \"U\" \"V\"\nZONE I=3, J=2\n0 0 "
             "0 1\n1 0 1 1\n2 0 2 1\n0 1 2 1\n1 1 3 1\n2 1 4 1\nZONE T=\"upper\" I=2 "
             "J=2\n0 1 2 1\n1 1 3 1\n0 2 4 1\n1 2 5 1\n"),
    L_SHAPED("two ordered zones, by variables",
             "VARIABLES = X, Y, U, V\nZONE I=3, J=2, DATAPACKING=BLOCK\n0 1 2 0 1 2\n0 0 "
             "0 1 1 1\n0 1 2 2 3 4\n6*1\nZONE I=2, J=2, F=BLOCK\n0 1 0 1\n1 1 2 2\n2 3 4 "
             "5\n4*1\n"),
    L_SHAPED(
        "quadrilaterals",
        "VARIABLES = X Y U V\nZONE N=8, E=3, F=FEPOINT, ET=QUADRILATERAL\n0 0 0 1\n1 "
        "0 1 1\n2 0 2 1\n0 1 2 1\n1 1 3 1\n2 1 4 1\n0 2 4 1\n1 2 5 1\n1 2 5 4\n2 3 6 "
        "5\n4 5 8 7\n"),
    L_SHAPED("triangles",
             "# of triangles\nVARIABLES = X Y U V\nZONE NODES=8, ELEMENTS=6, "
             "DATAPACKING=BLOCK,\n ZONETYPE=FETRIANGLE\n0 1 2 0 1 2 0 1\n0 0 0 1 1 1 2 "
             "2\n0 1 2 2 3 4 4 5\n8*1.0\n1 2 5\n1 5 4\n2 3 6\n2 6 5\n4 5 8\n4 8 7\n"),
    {.what = "values at cells",
     .text = "VARIABLES = X Y U V\nZONE N=8, E=3, DATAPACKING=BLOCK, "
             "ZONETYPE=FEQUADRILATERAL\nVARLOCATION=([3-4]=CELLCENTERED)\n0 1 2 0 1 2 0 "
             "1\n0 0 0 1 1 1 2 2\n3 3 3\n1 1 1\n1 2 5 4\n2 3 6 5\n4 5 8 7\n",
     .field = "at 1 0.5 = 3 1"},
    {.what = "zones at times",
     .text =
         "VARIABLES = X Y U V\nZONE I=2 J=2 SOLUTIONTIME=0.5 STRANDID=1\n0 0 1 1\n1 0 "
         "1 1\n0 1 1 1\n1 1 1 1\nZONE I=2 J=2 SOLUTIONTIME=1.5 STRANDID=1\n0 0 7 1\n1 "
         "0 7 1\n0 1 7 1\n1 1 7 1\n",
     .field = "time 'time 0.5'|at 0.5 0.5 = 1 1"},
    {.what = "the second time",
     .options = {.time = 1},
     .field = "time 'time 1.5'|at 0.5 0.5 = 7 1"},
    /* nodes of bricks on a grid are a volume's */
    {.what = "a zone in space",
     .text =
         "VARIABLES = X Y Z U V W\nZONE N=12, E=2, F=FEPOINT, ET=BRICK\n0 0 0 1 1 "
         "1\n1 0 0 1 1 1\n2 0 0 1 1 1\n0 1 0 1 2 1\n1 1 0 1 2 1\n2 1 0 1 2 1\n0 0 1 2 "
         "1 1\n1 0 1 2 1 1\n2 0 1 2 1 1\n0 1 1 2 2 1\n1 1 1 2 2 1\n2 1 1 2 2 1\n1 2 5 "
         "4 7 8 11 10\n2 3 6 5 8 9 12 11\n",
     .field = " 3 x 2 x 2\n|u = 1 1 1 1 1 1 2 2 2 2 2 2\n"},
    DAMAGED("ZONE N=4 E=1 F=FEBLOCK ET=POLYGON\n1 2\n", FG_STATUS_UNSUPPORTED,
            "a Tecplot zone of POLYGON"),
    DAMAGED("ZONE I=2 J=2 F=BLOCK VARSHARELIST=([1,2]=1)\n1 2\n", FG_STATUS_UNSUPPORTED,
            "with VARSHARELIST"),
    DAMAGED("ZONE I=2 J=2 F=BLOCK\n0 1 0 1\n0 0 1 1\n1 2 3 4\n1 2 3\n",
            FG_STATUS_FILE_FORMAT, "is no number: "),
    DAMAGED("ZONE I=2 J=2 F=BLOCK\n0 1 0 1\n0 0 x 1\n1 2 3 4\n1 2 3 4\n",
            FG_STATUS_FILE_FORMAT, "line 4: is no number: x"),
    DAMAGED("ZONE N=3 E=1 F=FEPOINT ET=TRIANGLE\n0 0 1 1\n1 0 1 1\n0 1 1 1\n1 2 4\n",
            FG_STATUS_FILE_FORMAT, "a cell with a corner that is no node"),
    DAMAGED("ZONE N=99999999 E=1 F=FEPOINT ET=TRIANGLE\n0 0 1 1\n", FG_STATUS_FILE_FORMAT,
            "more points than the file"),
};

static void shapes_are_read_or_refused(void **state)
{
  check_texts(*state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
}

/* Zones cut off anywhere are refused, or are those before. */
static void zones_may_end_anywhere(void **state)
{
  static const fg_read_options options = {0};
  for (size_t size = 1; size < sizeof MIXED; ++size) {
    char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, MIXED, size);
    const fg__source source = {
        .path = "cut", .bytes = (const unsigned char *)copy, .size = size};
    fg_field *field = NULL;
    const fg_status status = fg__dataset_read(&field, *state, &fg__format_table, &source,
                                              &options, (fg__slab_index){0, 1});
    assert_int_equal(status == FG_STATUS_OK, field != NULL);
    assert_true(status == FG_STATUS_OK || fg_context_message(*state)[0]);
    fg_field_destroy(field);
    fg_context_clear(*state);
    free(copy);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_layers_are_a_plane),
      cmocka_unit_test(planes_have_the_components_along_them),
      cmocka_unit_test(shapes_are_read_or_refused),
      cmocka_unit_test(zones_may_end_anywhere),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
