/* Tables in memory: what is found in them, and where they are refused. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/table/tables_test.h"

static void the_layout_is_found(void **state)
{
  static const char *const same[] = {
      /* commas, rows in any order */
      "x,y,u,v\n3.5,20,23.5,-.25\n1.5,10,11.5,-0.25\n2.5,10,12.5,-25e-2\n"
      "3.5,10,13.5,-0.25\n1.5,20,21.5,-0.25\n2.5,20,22.5,-0.25\n",
      /* semicolons and decimal commas, a mark of UTF-8, ends of lines as in DOS */
      "\xEF\xBB\xBFX (mm);Y (mm);Vx (m/s);Vy (m/s)\r\n1,5;10;11,5;-0,25\r\n"
      "2,5;10;12,5;-0,25\r\n3,5;10;13,5;-0,25\r\n1,5;20;21,5;-0,25\r\n"
      "2,5;20;22,5;-0,25\r\n3,5;20;23,5;-0,25\r\n",
      /* blanks, comments, a name with a unit, more columns, no end of the last line */
      "# made by hand\n#  x [mm]  y [mm]  p [Pa]  u [m/s] v [m/s]\n"
      "1.5 10.0 7 1.15E+01 -2.5e-1\n2.5 10.0 7 12.5 -0.25\n\n3.5 10.0 nan 13.5 -0.25\n"
      "% half\n  1.5 20.0 7 2.15D1 -0.25\n2.5 20.0 7 22.5 -0.25\n3.5 20 7 23.5 -0.25",
      /* tabs, quotes, text among the numbers, decimal commas */
      "\"name\"\t\"u\"\t\"v\"\t\"x\"\t\"y\"\n\"a \"\"b\"\"\"\t11,5\t-0,25\t1,5\t10\n"
      "b\t12,5\t-0,25\t2,5\t10\nc\t13,5\t-0,25\t3,5\t10\nd\t21,5\t-0,25\t1,5\t20\n"
      "e\t22,5\t-0,25\t2,5\t20\n\"f\"\t23,5\t-0,25\t3,5\t20\n",
      /* no names: x, y, u, v; blanks round decimal commas */
      "1,5  10  11,5 -0,25\n2,5  10  12,5 -0,25\n3,5  10  13,5 -0,25\n"
      "1,5  20  21,5 -0,25\n2,5  20  22,5 -0,25\n3,5  20  23,5 -0,25\n",
      /* names, then units */
      "x,y,u,v\nmm,mm,m/s,m/s\n1.5,10,11.5,-0.25\n2.5,10,12.5,-0.25\n"
      "3.5,10,13.5,-0.25\n1.5,20,21.5,-0.25\n2.5,20,22.5,-0.25\n3.5,20,23.5,-0.25\n",
      /* a coordinate of space that is the same everywhere */
      "Points:0,Points:1,Points:2,U:0,U:1,U:2\n1.5,10,3,11.5,-0.25,9\n"
      "2.5,10,3,12.5,-0.25,9\n3.5,10,3,13.5,-0.25,9\n1.5,20,3,21.5,-0.25,9\n"
      "2.5,20,3,22.5,-0.25,9\n3.5,20,3,23.5,-0.25,9\n",
  };
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i)
    check_small(read_text(*state, same[i]), -1);
}

/* A grid in space, its rows as they come, in uneven steps, with and without names. */
static void grids_in_space_are_read(void **state)
{
  static const double x[] = {0.0, 1.0, 2.5, 7.0}, y[] = {-1.0, 0.5, 2.0},
                      z[] = {3.0, 10.0};
  enum { NX = 4, NY = 3, NZ = 2, COUNT = NX * NY * NZ };
  for (int named = 0; named < 2; ++named) {
    char text[2048];
    size_t used = 0;
    if (named)
      used = (size_t)snprintf(text, sizeof text, "X,Y,Z,U,V,W\n");
    for (int row = 0; row < COUNT; ++row) {
      const int n = 7 * row % COUNT, i = n % NX, j = n / NX % NY, k = n / (NX * NY);
      used += (size_t)snprintf(text + used, sizeof text - used,
                               named ? "%g,%g,%g,%d,%g,%d\n" : "%g %g %g %d %g %d\n",
                               x[i], y[j], z[k], n, 0.5 * n, -n);
    }
    fg_field *field = read_text(*state, text);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_int_equal(f->dimension, 3);
    assert_true(f->size[0] == NX && f->size[1] == NY && f->size[2] == NZ);
    for (int n = 0; n < COUNT; ++n) {
      assert_true(f->axis[0][n % NX] == x[n % NX]);
      assert_true(f->axis[2][n / (NX * NY)] == z[n / (NX * NY)]);
      assert_true(f->velocity[0][n] == (float)n && f->velocity[2][n] == (float)-n);
      assert_true(f->velocity[1][n] == (float)(0.5 * n));
    }
    fg_field_destroy(field);
  }
}

/* The small grid upright, with a coordinate that is the same everywhere or without one.
 */
static void planes_along_other_axes_are_read(void **state)
{
  static const char across_y[] =
      "x,y,z,u,v,w\n1.5,7,10,11.5,99,-.25\n2.5,7,10,12.5,99,-.25\n"
      "3.5,7,10,13.5,99,-.25\n1.5,7,20,21.5,99,-.25\n2.5,7,20,22.5,99,-.25\n"
      "3.5,7,20,23.5,99,-.25\n";
  static const char across_x[] =
      "x y z u v w\n-3 1.5 10 99 11.5 -.25\n-3 2.5 10 99 12.5 -.25\n"
      "-3 3.5 10 99 13.5 -.25\n-3 1.5 20 99 21.5 -.25\n-3 2.5 20 99 22.5 -.25\n"
      "-3 3.5 20 99 23.5 -.25\n";
  static const char without_y[] =
      "w,u,z,x\n-.25,11.5,10,1.5\n-.25,12.5,10,2.5\n-.25,13.5,10,3.5\n"
      "-.25,21.5,20,1.5\n-.25,22.5,20,2.5\n-.25,23.5,20,3.5\n";
  static const char *const same[] = {across_y, across_x, without_y};
  static const char *const names[][4] = {
      {"x", "z", "u", "w"}, {"y", "z", "v", "w"}, {"x", "z", "u", "w"}};
  static const char *const level[] = {"y = 7", "x = -3", ""};
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    fg_field *field = read_text(*state, same[i]);
    const fg_field_arrays *f = fg_field_contents(field);
    for (int k = 0; k < 2; ++k) {
      assert_string_equal(f->axis_name[k], names[i][k]);
      assert_string_equal(f->velocity_name[k], names[i][2 + k]);
    }
    assert_string_equal(f->level ? f->level : "", level[i]);
    check_small(field, -1);
  }
}

/* A grid of 4 x 3 in a plane that rises by 3 over 4 along x: coordinates in it, and the
 * velocity's part; what points out of it is not told. */
static void tilted_planes_have_their_own_axes(void **state)
{
  char text[1024];
  size_t used = (size_t)snprintf(text, sizeof text, "x,y,z,u,v,w\n");
  for (int n = 0; n < 12; ++n) {
    const double s = 5.0 * (n % 4), t = n / 4, along = 1.0 + n, out = 2.0;
    used += (size_t)snprintf(text + used, sizeof text - used, "%g,%g,%g,%g,%g,%g\n",
                             0.8 * s, t, 1.0 + 0.6 * s, 0.8 * along - 0.6 * out, -t,
                             0.6 * along + 0.8 * out);
  }
  fg_field *field = read_text(*state, text);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->dimension == 2 && f->size[0] == 4 && f->size[1] == 3);
  assert_string_equal(f->axis_name[0], "x'");
  assert_string_equal(f->axis_name[1], "y");
  for (int n = 0; n < 12; ++n) {
    assert_true(fabs(f->axis[0][n % 4] - f->axis[0][0] - 5.0 * (n % 4)) < 1e-9);
    assert_true(fabs((double)f->velocity[0][n] - 1.0 - n) < 1e-5);
    assert_true(f->velocity[1][n] == (float)(-(n / 4)));
  }
  fg_field_destroy(field);
}

/* What PIV programs write, each with its word for an invalid vector. */
static void exports_of_piv_are_known(void **state)
{
  static const char *const same[] = {
      /* Insight */
      "TITLE=\"E:\\Run1\" VARIABLES=\"X mm\", \"Y mm\", \"U m/s\", \"V m/s\", \"CHC\", "
      "DATASETAUXDATA Application=\"PIV\" ZONE I=3, J=2, F=POINT\n"
      "1.5, 20.0, 21.5, -0.25, 1\n2.5, 20.0, 22.5, -0.25, 2\n3.5, 20.0, 23.5, -0.25, 1\n"
      "2.5, 10.0, 12.5, -0.25, 1\n1.5, 10.0, 0.0, -0.0, -3\n3.5, 10.0, 13.5, -0.25, 1\n",
      /* DaVis */
      "#DaVis 8.1.2 2D-vector 8 2 3 \"position\" \"mm\" \"position\" \"mm\" \"velocity\" "
      "\"m/"
      "s\"\r\n1,5\t20\t21,5\t-0,25\r\n2,5\t20\t22,5\t-0,25\r\n3,5\t20\t23,5\t-0,25\r\n"
      "2,5\t10\t12,5\t-0,25\r\n1,5\t10\t0\t-0\r\n3,5\t10\t13,5\t-0,25\r\n",
      /* OpenPIV, without units */
      "# "
      "x\ty\tu\tv\tflags\tmask\n1.5\t20\t21.5\t-0.25\t0\t0\n2.5\t20\t22.5\t-0.25\t0\t0\n"
      "3.5\t20\t23.5\t-0.25\t0\t0\n2.5\t10\t12.5\t-0.25\t0\t0\n1.5\t10\t5\t5\t1\t0\n"
      "3.5\t10\t13.5\t-0.25\t0\t0\n",
      /* PIVlab */
      "PIVlab, ASCII chart output - 01-Jan-2020\nFRAME: 1, filenames: A.jpg & B.jpg, "
      "conversion factor xy (px -> m): 1, conversion factor uv (px/frame -> m/s): 1\n"
      "x [mm],y [mm],u [m/s],v [m/s],Vector type [-]\n1.5,20,21.5,-0.25,1\n"
      "2.5,20,22.5,-0.25,2\n3.5,20,23.5,-0.25,1\n2.5,10,12.5,-0.25,1\n1.5,10,NaN,NaN,0\n"
      "3.5,10,13.5,-0.25,1\n",
      /* Tecplot */
      "TITLE = \"a table\"\nVARIABLES = \"x (mm)\"\n\"y (mm)\"\n\"u (m/s)\"\n\"v "
      "(m/s)\"\n"
      "\"isValid\"\nZONE T=\"one\", I=3, J=2,\n DATAPACKING=POINT\n1.5 20 21.5 -0.25 1\n"
      "2.5 20 22.5 -0.25 1\n3.5 20 23.5 -0.25 1\n2.5 10 12.5 -0.25 1\n1.5 10 1 1 0\n"
      "3.5 10 13.5 -0.25 1\n",
  };
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    fg_field *field = read_text(*state, same[i]);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_string_equal(f->velocity_units, i == 2 ? "" : "m/s");
    assert_string_equal(f->axis_units[1], i == 2 ? "" : "mm");
    check_small(field, 0);
  }
}

/* Where wind comes from, and where a current goes to; a closed circle of longitudes. */
static void directions_are_turned_by_what_they_mean(void **state)
{
  static const char *const head[] = {"lon,lat,wind_speed (m/s),wind_direction\n",
                                     "Latitude,Longitude,current speed,current dir\n",
                                     "lon,lat,sknt,drct\n"};
  for (int n = 0; n < 3; ++n) {
    const bool way = n == 1;
    char text[2048];
    size_t used = (size_t)snprintf(text, sizeof text, "%s", head[n]);
    for (int j = -1; j <= 1; ++j)
      for (int i = 0; i < 12; ++i)
        used += (size_t)snprintf(text + used, sizeof text - used, "%d,%d,2,30\n",
                                 way ? 30 * j : 30 * i, way ? 30 * i : 30 * j);
    if (n == 2) /* nothing was measured; there is a measurement at its place */
      snprintf(text + used, sizeof text - used, "0,0,M,M\n");
    fg_field *field = read_text(*state, text);
    const fg_field_arrays *f = fg_field_contents(field);
    const double sign = way ? 1.0 : -1.0;
    assert_int_equal(f->scale, FG_SCALE_GEO);
    assert_string_equal(f->velocity_units, n == 0 ? "m/s" : n == 1 ? "" : "kn");
    assert_true(f->period[0] == 360.0 && f->size[0] == 12 && f->size[1] == 3);
    assert_true(fabs((double)f->velocity[0][5] - sign) < 1e-6);
    assert_true(fabs((double)f->velocity[1][5] - sign * sqrt(3.0)) < 1e-6);
    fg_field_destroy(field);
  }
}

static void columns_are_chosen_by_name_and_number(void **state)
{
  static const char text[] =
      "a,b,wind_u,wind_v,wave_u,wave_v,ice\n"
      "1,1,1,2,5,6,1\n2,1,1,2,5,6,1\n1,2,1,2,5,6,0\n2,2,1,2,5,6,1\n";
  static const struct {
    const char *vars, *mask;
    float u;
  } chosen[] = {{"a,b,wave_u,wave_v", NULL, 5.0f}, {"1,2,4,3", "ice", 2.0f}};
  for (int i = 0; i < 2; ++i) {
    const fg_read_options options = {.vars = chosen[i].vars, .mask = chosen[i].mask};
    const fg__source source = source_of(text);
    fg_field *field = NULL;
    const fg_status status =
        fg__format_table.read(&field, *state, &source, &options, (fg__slab_index){0, 1});
    if (chosen[i].mask) { /* the only cell has a corner of no sea */
      assert_int_equal(status, FG_STATUS_ARGUMENT);
      fg_context_clear(*state);
      continue;
    }
    assert_int_equal(status, FG_STATUS_OK);
    assert_true(fg_field_contents(field)->velocity[0][0] == chosen[i].u);
    fg_field_destroy(field);
  }
}

typedef struct refusal {
  const char *text, *vars;
  fg_status status;
  const char *words;
} refusal;

static void what_is_wrong_is_told_by_its_place(void **state)
{
  static const refusal refusals[] = {
      {"x,y,u,v\n1,2,3,4\n1,3,abc,4\n2,2,3,4\n2,3,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 3, column 3 (u): \"abc\" is no number"},
      {"x,y,u,v\n1,2,oops,4\n1,3,3,4\n2,2,3,4\n2,3,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 2, column 3: \"oops\" is no number"},
      {"x,y,u,v\n1,2,3,4\n1,3,3\n2,2,3,4\n2,3,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 3 has 3 columns, not 4"},
      {"x,y,u,v\n1,2,3,4\n1,3,3,4\n2,2,3,4,5\n2,3,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 4 has more than 4 columns"},
      {"Dear reader,\nthis is a letter.\n", NULL, FG_STATUS_FILE_FORMAT,
       "is text, but no table of points: line 1 has 2 columns, 0 of them numbers"},
      {"x;y;u;v\n1.000,5;2.000,5;0,5;0,25\n1.100,5;2.000,5;0,5;0,25\n", NULL,
       FG_STATUS_FILE_FORMAT, "line 2, column 1 (x): \"1.000,5\" is no number"},
      {"Station,Latitude,Longitude,u,v\nname,deg,deg,m/s,m/s\nS1,51.2N,14.1W,1,2\n"
       "S2,50.2N,4.1E,1,2\nS3,50.2S,4.1E,1,2\n",
       NULL, FG_STATUS_FILE_FORMAT,
       "line 3, column 2 (Latitude): \"51.2N\" is no number"},
      {"when it was so long\nand 3 days went by\nuntil it was 7 again\n", NULL,
       FG_STATUS_FILE_FORMAT, "line 2, column 1 (when): \"and\" is no number"},
      {"one two three four\nfive six seven eight\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 1 has 4 columns, 0 of them numbers"},
      {"x,y,u,v\n", NULL, FG_STATUS_FILE_FORMAT,
       "a table with the names of 4 columns, and without rows"},
      {"of 2 or 3 ways\nthe 1 that is new\nwent 4 miles on\nand 5 miles back\n", NULL,
       FG_STATUS_FILE_FORMAT, "is text, but no table of points: line 1 has 5"},
      {"1 2 3\n4 5 6\n", NULL, FG_STATUS_FILE_FORMAT, "line 1 has 3 columns, 3 of them"},
      {"1 2 3 4 5\n2 3 4 5 6\n1 3 4 5 6\n", NULL, FG_STATUS_UNSUPPORTED,
       "no vectors found among its 5 variables: 1, 2, 3, 4, 5"},
      {"x,y,z,u,v,w\n1,2,3,4,1,1\n1,3,3,4,1,1\n2,2,9,4,1,1\n5,3,5,3,4,1\n", NULL,
       FG_STATUS_UNSUPPORTED, "4 points in space lie neither on a grid"},
      {"x,y,p,q\n1,2,3,4\n1,3,3,4\n2,2,3,4\n", NULL, FG_STATUS_UNSUPPORTED,
       "no vectors found among its 4 variables: x, y, p, q"},
      {"x,y,u,v\n1,2,3,4\n1,3,3,4\n2,2,3,4\n", "u,w", FG_STATUS_ARGUMENT,
       "has no variable 'w'"},
      {"x,y,a_u,a_v,b_u,b_v\n1,2,3,4,5,6\n1,3,3,4,5,6\n2,2,3,4,5,6\n", NULL,
       FG_STATUS_ARGUMENT,
       "2 vectors, and it is not clear which is meant: a_u,a_v; b_u,b_v"},
      {"lon,lat,u,v\n-3.1,-1.5,3,4\n3.1,-1.5,3,4\n-3.1,1.5,3,4\n3.1,1.5,3,4\n0,0,1,1\n",
       NULL, FG_STATUS_ARGUMENT, "latitudes -1.5 to 1.5 are radians, not degrees"},
      {"x,y,u (m/s),v (cm/s)\n1,2,3,4\n1,3,3,4\n2,2,3,4\n2,3,3,4\n", NULL,
       FG_STATUS_UNSUPPORTED, "'u' is in m/s, 'v' in cm/s"},
      {"lon,lat,u,v\n1,2,3,4\n1,3,3,4\n2,92,3,4\n2,3,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 4: longitude 2, latitude 92"},
      {"VARIABLES = x y u v\nZONE I=2 J=2 DATAPACKING=BLOCK\n1 2 3 4\n1 3 3 4\n", NULL,
       FG_STATUS_FILE_FORMAT, "line 5: is no number: "},
      {"VARIABLES = x y u v\nZONE I=2 J=2\n1 2 3 4\n2 2 3 4\n1 3 3 4\n2 3 3 4\n"
       "ZONE I=2 J=2\n1 2 3 4\n",
       NULL, FG_STATUS_FILE_FORMAT, "line 9: is no number: "},
      {"x,y,u,v\n1,2,3,4\n1,3,3,4\n1e400,2,3,4\n", NULL, FG_STATUS_FILE_FORMAT,
       "line 4: the point's coordinate 1 is inf"},
  };
  for (size_t i = 0; i < sizeof refusals / sizeof *refusals; ++i) {
    const refusal *r = &refusals[i];
    const fg__source source = source_of(r->text);
    const fg_read_options options = {.vars = r->vars};
    fg_field *field = NULL;
    const fg_status status =
        fg__format_table.read(&field, *state, &source, &options, (fg__slab_index){0, 1});
    if (status != r->status || !strstr(fg_context_message(*state), r->words))
      fail_msg("\"%s\" (%d) lacks \"%s\"", fg_context_message(*state), status, r->words);
    assert_null(field);
    fg_context_clear(*state);
  }
}

static void other_formats_are_left_alone(void **state)
{
  static const char *const others[] = {"<?xml version=\"1.0\"?>", "{\"type\": 1}",
                                       " \n\t", "CDF\001", "\x89PNG\r\n\x1a"};
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    assert_false(
        fg__format_table.is_mine((const unsigned char *)others[i], strlen(others[i])));
  (void)state;
}

/* A file cut off anywhere is a shorter table or refused. */
static void a_file_may_end_anywhere(void **state)
{
  static const char text[] =
      "lon [deg];lat [deg];u (m/s);v (m/s)\n1,5;2,5;0,5;1e-1\n3;2;\"1\";-1\n"
      "2;3;1;inf\n1;5;NaN;2\n7;1;2;2\n4;2;3;8\n";
  static const fg_read_options options = {0};
  int were_read = 0;
  for (size_t size = 1; size < sizeof text; ++size) {
    char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, text, size);
    const fg__source source = {
        .path = "cut", .bytes = (const unsigned char *)copy, .size = size};
    fg_field *field = NULL;
    const fg_status status =
        fg__format_table.read(&field, *state, &source, &options, (fg__slab_index){0, 1});
    assert_int_equal(status == FG_STATUS_OK, field != NULL);
    assert_true(status == FG_STATUS_OK || fg_context_message(*state)[0]);
    were_read += status == FG_STATUS_OK;
    fg_field_destroy(field);
    fg_context_clear(*state);
    free(copy);
  }
  assert_true(were_read > 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_layout_is_found),
      cmocka_unit_test(grids_in_space_are_read),
      cmocka_unit_test(planes_along_other_axes_are_read),
      cmocka_unit_test(tilted_planes_have_their_own_axes),
      cmocka_unit_test(exports_of_piv_are_known),
      cmocka_unit_test(directions_are_turned_by_what_they_mean),
      cmocka_unit_test(columns_are_chosen_by_name_and_number),
      cmocka_unit_test(what_is_wrong_is_told_by_its_place),
      cmocka_unit_test(other_formats_are_left_alone),
      cmocka_unit_test(a_file_may_end_anywhere),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
