/* Points in layers, grids with gaps, and Tecplot's zones. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static bool is_known(const fg_field *field, double x, double y, double u)
{
  double velocity[3] = {0.0, 0.0, 0.0};
  const bool known = fg_field_velocity(field, (const double[]){x, y, 0.0}, velocity);
  assert_true(!known || fabs(velocity[0] - u) < 1e-4);
  return known;
}

/* Lines at 0 to 4 and from `second` on. */
static void grids_are_not_read_across_gaps(void **state)
{
  static const struct {
    double second, step;
    bool turned, gap;
  } cases[] = {
      {40.0, 1.0, false, true}, {40.0, 1.25, true, true}, {7.0, 1.5, false, false}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[TEXT_BYTES];
    size_t used = (size_t)snprintf(text, sizeof text, "x,y,u,v\n");
    for (int n = 0; n < 2 * N * N; ++n) {
      const int line = n % (2 * N);
      const double a = line < N ? line : cases[i].second + cases[i].step * (line - N);
      const double b = (double)(n / (2 * N));
      used += (size_t)snprintf(text + used, sizeof text - used, "%g,%g,%g,1\n",
                               cases[i].turned ? b : a, cases[i].turned ? a : b, a);
    }
    fg_field *field = read_text(*state, text);
    const double inside[] = {3.5, cases[i].second + 0.5},
                 between = 0.5 * (4.0 + cases[i].second);
    for (int k = 0; k < 2; ++k)
      assert_true(cases[i].turned ? is_known(field, 1.5, inside[k], inside[k])
                                  : is_known(field, inside[k], 1.5, inside[k]));
    assert_int_equal(cases[i].turned ? is_known(field, 1.5, between, between)
                                     : is_known(field, between, 1.5, between),
                     !cases[i].gap);
    fg_field_destroy(field);
  }
}

/* u = x + 2 y in a square of 2 x 2 without its upper right quarter. */
static void zones_of_cells_are_meshes(void **state)
{
  static const char *const cases[] = {
      /* two ordered zones, by points */
      "TITLE = \"an L\"\nVARIABLES = \"X\" \"Y\" \"U\" \"V\"\nZONE I=3, J=2\n0 0 0 1\n1 "
      "0 1 1\n"
      "2 0 2 1\n0 1 2 1\n1 1 3 1\n2 1 4 1\nZONE T=\"upper\" I=2 J=2\n0 1 2 1\n1 1 3 1\n0 "
      "2 4 1\n"
      "1 2 5 1\n",
      /* by variables */
      "VARIABLES = X, Y, U, V\nZONE I=3, J=2, DATAPACKING=BLOCK\n0 1 2 0 1 2\n0 0 0 1 1 "
      "1\n"
      "0 1 2 2 3 4\n6*1\nZONE I=2, J=2, F=BLOCK\n0 1 0 1\n1 1 2 2\n2 3 4 5\n4*1\n",
      /* finite elements */
      "VARIABLES = X Y U V\nZONE N=8, E=3, F=FEPOINT, ET=QUADRILATERAL\n0 0 0 1\n1 0 1 "
      "1\n2 0 2 1\n"
      "0 1 2 1\n1 1 3 1\n2 1 4 1\n0 2 4 1\n1 2 5 1\n1 2 5 4\n2 3 6 5\n4 5 8 7\n",
      "# of triangles\nVARIABLES = X Y U V\nZONE NODES=8, ELEMENTS=6, "
      "DATAPACKING=BLOCK,\n"
      " ZONETYPE=FETRIANGLE\n0 1 2 0 1 2 0 1\n0 0 0 1 1 1 2 2\n0 1 2 2 3 4 4 5\n8*1.0\n"
      "1 2 5\n1 5 4\n2 3 6\n2 6 5\n4 5 8\n4 8 7\n",
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    fg_field *field = read_text(*state, cases[i]);
    assert_true(is_known(field, 0.5, 0.25, 1.0) && is_known(field, 1.5, 0.5, 2.5) &&
                is_known(field, 0.75, 1.5, 3.75));
    assert_false(is_known(field, 1.5, 1.5, 4.5));
    fg_field_destroy(field);
  }
}

static void zones_may_have_values_at_cells_or_times(void **state)
{
  static const char cells[] =
      "VARIABLES = X Y U V\nZONE N=8, E=3, DATAPACKING=BLOCK, ZONETYPE=FEQUADRILATERAL\n"
      "VARLOCATION=([3-4]=CELLCENTERED)\n0 1 2 0 1 2 0 1\n0 0 0 1 1 1 2 2\n3 3 3\n1 1 1\n"
      "1 2 5 4\n2 3 6 5\n4 5 8 7\n";
  static const char times[] = "VARIABLES = X Y U V\nZONE I=2 J=2 SOLUTIONTIME=0.5 "
                              "STRANDID=1\n0 0 1 1\n1 0 1 1\n0 1 1 1\n"
                              "1 1 1 1\nZONE I=2 J=2 SOLUTIONTIME=1.5 STRANDID=1\n0 0 7 "
                              "1\n1 0 7 1\n0 1 7 1\n1 1 7 1\n";
  fg_field *field = read_text(*state, cells);
  assert_true(is_known(field, 1.0, 0.5, 3.0));
  fg_field_destroy(field);
  for (int time = 0; time < 2; ++time) {
    field = read_with(*state, times, &(fg_read_options){.time = time});
    assert_string_equal(fg_field_contents(field)->time, time ? "time 1.5" : "time 0.5");
    assert_true(is_known(field, 0.5, 0.5, time ? 7.0 : 1.0));
    fg_field_destroy(field);
  }
}

/* Nodes of bricks on a grid are a volume's. */
static void zones_in_space_are_points(void **state)
{
  static const char text[] =
      "VARIABLES = X Y Z U V W\nZONE N=12, E=2, F=FEPOINT, ET=BRICK\n0 0 0 1 1 1\n1 0 0 "
      "1 1 1\n"
      "2 0 0 1 1 1\n0 1 0 1 2 1\n1 1 0 1 2 1\n2 1 0 1 2 1\n0 0 1 2 1 1\n1 0 1 2 1 1\n2 0 "
      "1 2 1 1\n"
      "0 1 1 2 2 1\n1 1 1 2 2 1\n2 1 1 2 2 1\n1 2 5 4 7 8 11 10\n2 3 6 5 8 9 12 11\n";
  fg_field *field = read_text(*state, text);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->dimension == 3 && f->size[0] == 3 && f->size[1] == 2 && f->size[2] == 2);
  for (int n = 0; n < 12; ++n)
    assert_true(f->velocity[0][n] == (n < 6 ? 1.0f : 2.0f));
  fg_field_destroy(field);
}

static void damaged_zones_are_told(void **state)
{
  static const struct {
    const char *zone, *words;
  } cases[] = {
      {"ZONE N=4 E=1 F=FEBLOCK ET=POLYGON\n1 2\n", "a Tecplot zone of POLYGON"},
      {"ZONE I=2 J=2 F=BLOCK VARSHARELIST=([1,2]=1)\n1 2\n", "with VARSHARELIST"},
      {"ZONE I=2 J=2 F=BLOCK\n0 1 0 1\n0 0 1 1\n1 2 3 4\n1 2 3\n", "is no number: "},
      {"ZONE I=2 J=2 F=BLOCK\n0 1 0 1\n0 0 x 1\n1 2 3 4\n1 2 3 4\n",
       "line 4: is no number: x"},
      {"ZONE N=3 E=1 F=FEPOINT ET=TRIANGLE\n0 0 1 1\n1 0 1 1\n0 1 1 1\n1 2 4\n",
       "a cell with a corner that is no node"},
      {"ZONE N=99999999 E=1 F=FEPOINT ET=TRIANGLE\n0 0 1 1\n",
       "more points than the file"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[512];
    snprintf(text, sizeof text, "VARIABLES = x y u v\n%s", cases[i].zone);
    const fg__source source = source_of(text);
    static const fg_read_options options = {0};
    fg_field *field = NULL;
    assert_int_not_equal(
        fg__format_table.read(&field, *state, &source, &options, (fg__slab_index){0, 1}),
        FG_STATUS_OK);
    assert_null(field);
    if (!strstr(fg_context_message(*state), cases[i].words))
      fail_msg("\"%s\" lacks \"%s\"", fg_context_message(*state), cases[i].words);
    fg_context_clear(*state);
  }
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
    const fg_status status =
        fg__format_table.read(&field, *state, &source, &options, (fg__slab_index){0, 1});
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
      cmocka_unit_test(grids_are_not_read_across_gaps),
      cmocka_unit_test(zones_of_cells_are_meshes),
      cmocka_unit_test(zones_may_have_values_at_cells_or_times),
      cmocka_unit_test(zones_in_space_are_points),
      cmocka_unit_test(damaged_zones_are_told),
      cmocka_unit_test(zones_may_end_anywhere),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
