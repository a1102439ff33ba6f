/* Fields whose parts lie in two files. */
#include "read/netcdf/situation_test.h"

#define AXES "y[4] :units=km = -3 -1 .5 .75; x[5] :units=km = 1.5 2 4 4.5 7;"
#define ONE(name) "float " name "(y,x) ~ 1 @x 2 @y -1;"
#define FLOW "|linear 1 2 -1 1 2 -1"
#define PAIR AXES ONE("u") ONE("v")
#define DEGREES(k) " :units=degrees_" k
/* without their coordinates */
#define BARE "y[4]; x[5]; float u(y,x) = 1:20:1; float v(y,x) = 2"

/* A solid rotation about 5 west, 47 north on a grid of 2 degrees: one component, with the
 * latitude and longitude of its first sample. Half a cell is 0.05. */
#define ROTATION "geo |linear 2.35 0 -0.05 0.25 0.05 0 within 0.005"
#define AT_X " :units=m/s :standard_name=sea_water_x_velocity"
#define AT_Y " :units=m/s :standard_name=sea_water_y_velocity"
#define ON_LINES(lat, lon, component)                                                    \
  "y[14]" DEGREES("north") " ~ " lat " y 2; x[16]" DEGREES("east") " ~ " lon             \
                                                                   " x 2;" component
#define U_ON_LINES(lat, lon) ON_LINES(lat, lon, "uo(y,x)" AT_X " ~ 2.35 @y -.05")
#define V_ON_LINES(lat, lon) ON_LINES(lat, lon, "vo(y,x)" AT_Y " ~ .25 @x .05")
#define ON_PLANE(lat, lon, i, j)                                                         \
  "y[14]; x[16]; nav_lat(y,x)" DEGREES(                                                  \
      "north") " ~ " lat " y 2 x " i "; nav_lon(y,x)" DEGREES("east") " ~ " lon          \
                                                                      " x 2 y " j ";"
#define PLACED " :coordinates=nav_lat nav_lon ~ "
#define U_ON(plane) plane "uo(y,x)" AT_X PLACED "2.35 @nav_lat -.05"
#define V_ON(plane) plane "vo(y,x)" AT_Y PLACED ".25 @nav_lon .05"
#define EVEN(lat, lon) ON_PLANE(lat, lon, "0", "0")
#define CURVED(lat, lon) ON_PLANE(lat, lon, "-.5", ".5")
#define TURNED "|frame 'along the grid, turned by its positions"
#define MET(what_, u, v)                                                                 \
  {                                                                                      \
    .what = what_, .file = u, .second = v, .options = {.vars = "uo,vo"},                 \
    .field = ROTATION, .inventory = "uo,vo " TURNED                                      \
  }
#define APART(what_, u, v)                                                               \
  {                                                                                      \
    .what = what_, .file = u, .second = v, .options = {.vars = "uo,vo"},                 \
    .refused = "second.nc lie more than half a cell apart"                               \
  }
#define NEAR(what_, u, v)                                                                \
  {                                                                                      \
    .what = what_, .file = u, .second = v, .options = {.vars = "uo,vo"}, .field = "geo " \
  }
#define KILOMETRES(component, x, y)                                                      \
  "y[14] :units=km ~ " y " y 1; x[16] :units=km ~ " x " x 1; " component "(y,x) = 1.5"

/* NEMO's depths have a name of their own in each file. */
#define LAYERS(component, depth, units, list, lat, lon, attributes, speed)               \
  depth "[3] :units=" units " = " list "; y[14]" DEGREES(                                \
      "north") " ~ " lat " y 2; x[16]" DEGREES("east") " ~ " lon " x 2; " component      \
                                                       "(" depth ",y,x)" attributes      \
                                                       " ~ " speed " " depth " " speed
#define U_LAYERS(list) LAYERS("uo", "depthu", "m", list, "33", "-20", AT_X, "1")
#define V_LAYERS_IN(units, list)                                                         \
  LAYERS("vo", "depthv", units, list, "34", "-21", AT_Y, "2")
#define V_LAYERS(list) V_LAYERS_IN("m", list)
#define DEPTHS ".5 10 100"
#define LAYER(at_, level_)                                                               \
  {                                                                                      \
    .what = "levels of two names", .file = U_LAYERS(DEPTHS), .second = V_LAYERS(DEPTHS), \
    .options = {.at = at_, .level = level_},                                             \
    .field = "level 'depth 100 m'|linear 3 0 0 6 0 0 within 0.01"                        \
  }
#define NO_LAYER(at_, status_, words)                                                    \
  {                                                                                      \
    .what = at_, .file = U_LAYERS(DEPTHS), .second = V_LAYERS(DEPTHS),                   \
    .options = {.at = at_}, .status = status_, .refused = words                          \
  }

#define SQUARE_AND                                                                       \
  "lat[2] :units=degrees_north = 40 41; lon[2] :units=degrees_east = 5 6; "
#define DATED(name, units, value)                                                        \
  SQUARE_AND "time[1] :units=" units " = " value "; float " name "(time,lat,lon) = 1;"
#define SINGLE(name, value)                                                              \
  SQUARE_AND "time() :units=days since 2000-01-01 = " value "; float " name              \
             "(lat,lon) :coordinates=time = 1;"

static const situation SITUATIONS[] = {
    {.what = "half of a pair",
     .file = AXES ONE("u") ONE("temperature"),
     .refused = "no vectors"},
    {.what = "the other component is in a second file",
     .file = AXES ONE("u") ONE("temperature"),
     .second = AXES ONE("salt") ONE("v"),
     .field = "map 5 x 4\n" FLOW},
    {.what = "the same by names",
     .file = AXES ONE("u") ONE("temperature"),
     .second = AXES ONE("salt") ONE("v"),
     .options = {.vars = "u,v"},
     .field = "map 5 x 4\n" FLOW},
    {.what = "a second file that is not there",
     .file = PAIR,
     .options = {.vars_from = "/nonexistent.nc"},
     .status = FG_STATUS_FILE_ACCESS,
     .refused = ""},
    {.what = "a second file of no use",
     .file = PAIR,
     .second = AXES "float sea(y,x) = 0 1 1 1 1",
     .options = {.vars = "u,v"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "second.nc: gives no comp"},
    {.what = "a second file has the mask",
     .file = PAIR,
     .second = AXES "float sea(y,x) = 0 1 1 1 1",
     .options = {.vars = "u,v", .mask = "sea"},
     .field = "missing 4\n|u = nan 8 "},
    {.what = "axes in a file of the mesh",
     .file = BARE,
     .mesh = "y[4]" DEGREES("north") " = -3 -1 .5 .75; x[5]" DEGREES(
         "east") " = 1.5 2 4 4.5 7",
     .field = "geo 5 x 4\n|x = 1.5 2 4 4.5 7\n|y = -3 -1 0.5 0.75\n|u = 1 2 3 4 5 6 7 8"},
    {.what = "axes in a plane of the mesh's file",
     .file = BARE,
     .mesh = "y[4]; x[5]; lat(y,x)" DEGREES(
         "north") " = -3*5 -1*5 .5*5 .75*5; lon(y,x)" DEGREES("east") " = 1.5 2 4 4.5 7",
     .field = "geo 5 x 4\n|x = 1.5 2 4 4.5 7\n|y = -3 -1 0.5 0.75\n|u = 1 2 3 4 5 6 7 8"},

    /* grid_U and grid_V on a regular grid: each has the places of its own faces */
    MET("faces to the left, on lines", U_ON_LINES("33", "-22"), V_ON_LINES("32", "-21")),
    MET("faces to the right, on lines", U_ON_LINES("33", "-20"), V_ON_LINES("34", "-21")),
    MET("faces to the left", U_ON(EVEN("33", "-22")), V_ON(EVEN("32", "-21"))),
    MET("faces to the right", U_ON(EVEN("33", "-20")), V_ON(EVEN("34", "-21"))),
    {.what = "equal places up to rounding are axes",
     .file = U_ON(EVEN("33", "-21")),
     .second = V_ON(EVEN("32.999998", "-20.999998")),
     .options = {.vars = "uo,vo"},
     .field = "geo 16 x 14\n|linear 2.35 0 -0.05 0.25 0.05 0 within 1e-6"},
    NEAR("half a cell apart, on lines", U_ON_LINES("33", "-20"), V_ON_LINES("34", "-21")),
    APART("columns apart, on lines", U_ON_LINES("33", "-20"), V_ON_LINES("34", "39")),
    APART("rows apart, on lines", U_ON_LINES("33", "-20"), V_ON_LINES("10", "-21")),
    APART("cells apart, on lines", U_ON_LINES("33", "-20"), V_ON_LINES("36", "-18")),
    NEAR("half a cell apart", U_ON(EVEN("33", "-20")), V_ON(EVEN("34", "-21"))),
    APART("columns apart", U_ON(EVEN("33", "-20")), V_ON(EVEN("34", "39"))),
    APART("rows apart", U_ON(EVEN("33", "-20")), V_ON(EVEN("10", "-21"))),
    APART("cells apart", U_ON(EVEN("33", "-20")), V_ON(EVEN("36", "-18"))),
    NEAR("half a cell apart, curved", U_ON(CURVED("32.75", "-20")),
         V_ON(CURVED("34", "-20.75"))),
    APART("columns apart, curved", U_ON(CURVED("32.75", "-20")),
          V_ON(CURVED("19", "39.25"))),
    APART("rows apart, curved", U_ON(CURVED("32.75", "-20")),
          V_ON(CURVED("10", "-26.75"))),
    APART("cells apart, curved", U_ON(CURVED("32.75", "-20")),
          V_ON(CURVED("35.25", "-17.25"))),
    /* in a plane whose axes are no degrees */
    {.what = "faces of kilometres",
     .file = KILOMETRES("u", ".5", "0"),
     .second = KILOMETRES("v", "0", ".5"),
     .options = {.vars = "u,v"},
     .field = "linear 1.5 0 0 1.5 0 0"},
    {.what = "faces of kilometres, apart",
     .file = KILOMETRES("u", ".5", "0"),
     .second = KILOMETRES("v", "40", ".5"),
     .options = {.vars = "u,v"},
     .refused = "second.nc lie more than half a cell apart"},

    /* the level of the options, or the sample of one's dimension, is that of both */
    LAYER(NULL, 2),
    LAYER("depthu=2", 0),
    LAYER("depthu=100m", 0),
    LAYER("depthv=2", 0),
    LAYER("depthv=100.0", 0),
    LAYER("depthu=2,depthv=2", 0),
    NO_LAYER("depthu=1 m", FG_STATUS_ARGUMENT, "'depthu=1 m' is not there"),
    NO_LAYER("depthu=0,depthv=2", FG_STATUS_OK,
             "'depthu' of 'uo' and 'depthv' of 'vo' have different"),
    {.what = "depths turned round, by value",
     .file = U_LAYERS(DEPTHS),
     .second = V_LAYERS("100 10 .5"),
     .options = {.at = "depthu=100m"},
     .field = "level 'depth 100 m'|linear 3 0 0 2 0 0 within 0.01"},
    {.what = "other depths",
     .file = U_LAYERS(DEPTHS),
     .second = V_LAYERS(".5 12 100"),
     .refused = "'depthu' of 'uo' and 'depthv' of 'vo' have different values"},
    {.what = "one date of two units",
     .file = DATED("u", "days since 2000-01-02", "0"),
     .second = DATED("v", "hours since 2000-01-01", "24"),
     .options = {.vars = "u,v"},
     .field = "time '2000-01-02'"},
    {.what = "two dates of equal numbers",
     .file = DATED("u", "days since 2000-01-01", "0"),
     .second = DATED("v", "days since 2001-01-01", "0"),
     .options = {.vars = "u,v"},
     .refused = "'time' of 'u' and 'time' of 'v' have different values"},
    {.what = "levels in two units",
     .file = U_LAYERS(DEPTHS),
     .second = V_LAYERS_IN("cm", "50 1000 10000"),
     .field = "level 'depth 0.5 m'"},
    {.what = "levels of equal numbers in two units",
     .file = U_LAYERS(DEPTHS),
     .second = V_LAYERS_IN("km", ".5 10 100"),
     .refused = "'depthu' of 'uo' and 'depthv' of 'vo' have different values"},
    {.what = "single dates",
     .file = SINGLE("u", "0"),
     .second = SINGLE("v", "31"),
     .options = {.vars = "u,v"},
     .refused = "'time' of 'u' and 'time' of 'v' have different values"},
};

static void situations_are_read_or_refused(void **state)
{
  check_situations(state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
}

static void a_file_cannot_be_its_own_second(void **state)
{
  sample_file *f = *state;
  notation_write(f, PAIR, 0);
  refuse_with(f, &(fg_read_options){.vars = "u,v", .vars_from = f->path},
              FG_STATUS_ARGUMENT, "sample.nc: is given twice");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(situations_are_read_or_refused),
      CASE(a_file_cannot_be_its_own_second),
  };
  return cmocka_run_group_tests_name("read/netcdf/files", tests, NULL, NULL);
}
