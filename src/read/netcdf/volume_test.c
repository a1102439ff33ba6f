/* Fields in 3D from NetCDF, and pairs that stay a plane. */
#include "read/netcdf/situation_test.h"

#define TIME "time[2] :units=hours since 2014-01-31 00:00 = 0 6;"
#define LINE(name, attributes, numbers) name attributes " = " numbers ";"
#define X(attributes) LINE("x[5]", attributes, "1.5 2 4 4.5 7")
#define Y(attributes) LINE("y[4]", attributes, "-3 -1 .5 .75")
#define Z(attributes) LINE("z[3]", attributes, "10 10.5 12")
#define METRES " :units=m"
#define AXES TIME X(METRES) Y(METRES) Z(METRES)
#define SPEED " :units=m/s :_FillValue=@-999"
#define ONE(name, all, attributes, first)                                                \
  "float " name "(" all ")" attributes " ~ " first " x 1 y 10 z 100 time 1000;"
#define ALL "time,z,y,x"
#define PAIR ONE("u", ALL, SPEED, "1") ONE("v", ALL, SPEED, "2")
#define THREE(u, v, w)                                                                   \
  ONE(u, ALL, SPEED, "1") ONE(v, ALL, SPEED, "2") ONE(w, ALL, SPEED, "3")
#define PLAIN AXES THREE("u", "v", "w")

#define VOLUME                                                                           \
  " 5 x 4 x 3\n|x = 1.5 2 4 4.5 7\n|y = -3 -1 0.5 0.75\n|z = 10 10.5 12\n|"              \
  "at 1.5 -3 10 = 1 2 3|at 2 -1 10.5 = 112 113 114|at 7 .75 12 = 235 236 237"
/* the plane of a level, whose first sample is 1, 101 or 201 */
#define PLANE(first, second)                                                             \
  " 5 x 4\n|u = " first "1 " first "2 " first "3 |v = " second "2 " second "3 "

#define RISING(all)                                                                      \
  {                                                                                      \
    .what = all,                                                                         \
    .file = AXES ONE("u", "time," all, SPEED, "1") ONE("v", "time," all, SPEED, "2")     \
        ONE("w", "time," all, SPEED, "3"),                                               \
    .field = VOLUME                                                                      \
  }
#define FALLING(all)                                                                     \
  {                                                                                      \
    .what = all ", z descends",                                                          \
    .file = TIME X(METRES) Y(METRES) LINE("z[3]", METRES, "12 10.5 10")                  \
        ONE("u", "time," all, SPEED, "1") ONE("v", "time," all, SPEED, "2")              \
            ONE("w", "time," all, SPEED, "3"),                                           \
    .field =                                                                             \
        " 5 x 4 x 3\n|z = 10 10.5 12\n|at 1.5 -3 12 = 1 2 3|at 2 -1 10.5 = 112 113 "     \
        "114|at 7 .75 10 = 235 236 237"                                                  \
  }
#define NAMED(u, v, w)                                                                   \
  {                                                                                      \
    .what = u, .file = AXES THREE(u, v, w), .field = "name '" w "'|" VOLUME              \
  }
/* what leaves a doubt is read by levels */
#define DOUBT(what_, file_)                                                              \
  {.what = what_, .file = file_, .field = PLANE("", "")},                                \
  {                                                                                      \
    .what = what_ ", its last level", .options = {.level = 2},                           \
    .field = PLANE("20", "20")                                                           \
  }
#define REFUSED(vars_, words)                                                            \
  {                                                                                      \
    .what = vars_, .options = {.vars = vars_}, .status = FG_STATUS_ARGUMENT,             \
    .refused = words                                                                     \
  }
#define THREE_ASKED(words)                                                               \
  {                                                                                      \
    .what = words, .options = {.vars = "u,v,w"}, .refused = words                        \
  }

static const situation SITUATIONS[] = {
    {.what = "three components are a volume",
     .file = PLAIN,
     .options = {.time = 1},
     .field = "map 5 x 4 x 3\n|at 1.5 -3 10 = 1001 1002 1003|name 'w'|units 'm/s'|axis 2 "
              "'z' 'm'|time '2014-01-31 06:00'|level ''",
     .inventory = "vectors 1\n|[u,v,w |bounds = 1.5 7 -3 0.75 10 12\n|times 2\n|levels "
                  "1\n|map 5 x 4 x 3\n"},
    RISING("z,y,x"),
    RISING("z,x,y"),
    RISING("y,z,x"),
    RISING("x,y,z"),
    RISING("y,x,z"),
    RISING("x,z,y"),
    FALLING("z,y,x"),
    FALLING("z,x,y"),
    FALLING("y,z,x"),
    FALLING("x,y,z"),
    FALLING("y,x,z"),
    FALLING("x,z,y"),
    NAMED("vx", "vy", "vz"),
    NAMED("U_x", "U_y", "U_z"),
    NAMED("UWND", "VWND", "WWND"),
    NAMED("velocity_u", "velocity_v", "velocity_w"),
    {.what = "an upward velocity is the third",
     .file = AXES PAIR ONE("lift", ALL, SPEED " :standard_name=upward_air_velocity", "3"),
     .field = VOLUME},
    DOUBT("a third of another name", AXES THREE("u", "v", "q")),
    DOUBT("two components", AXES PAIR),
    DOUBT("longitude and latitude",
          TIME X(" :units=degrees_east") Y(" :units=degrees_north") Z(METRES)
              THREE("u", "v", "w")),
    DOUBT("levels of pressure",
          TIME X(METRES) Y(METRES) Z(" :units=hPa") THREE("u", "v", "w")),
    DOUBT("depths",
          TIME X(METRES) Y(METRES) Z(METRES " :positive=down") THREE("u", "v", "w")),
    DOUBT("a map", TIME X(METRES " :standard_name=projection_x_coordinate") Y(METRES)
                       Z(METRES) THREE("u", "v", "w")),
    {.what = "a map's volume, as asked", .options = {.vars = "u,v,w"}, .field = VOLUME},
    DOUBT("a third of other units", AXES PAIR ONE("w", ALL, " :units=Pa/s", "3")),
    THREE_ASKED("'u' and 'w' differ in units"),
    DOUBT("a third at other places", AXES "z_w[4] :units=m = 9 10.2 11 13;" PAIR
                                          "float w(time,z_w,y,x) :units=m/s ~ 3 x 1"),
    THREE_ASKED("a staggered grid"),
    {.what = "names choose a plane",
     .file = PLAIN,
     .options = {.vars = "u,v", .level = 1},
     .field = PLANE("10", "10")},
    {.what = "a level of a volume",
     .options = {.level = 1},
     .status = FG_STATUS_ARGUMENT,
     .refused = "three components and all 3 levels",
     .hint = "--vars U,V"},
    REFUSED("u,v,u", "two components are 'u'"),
    REFUSED("u,v,omega", "omega"),
    REFUSED("u", "two or three "),
    REFUSED("u,", "two or three "),
    REFUSED(",v", "two or three "),
    REFUSED("u,v,", "two or three "),
    REFUSED("u,,w", "two or three "),
    REFUSED("u,v,w,x,y", "two or three "),
    REFUSED(",", "two or three "),
    {.what = "spheres have no volume",
     .file = TIME X(" :units=degrees_east") Y(" :units=degrees_north") Z(METRES)
         THREE("u", "v", "w"),
     .options = {.vars = "u,v,w"},
     .refused = "longitude, latitude and height",
     .hint = "--scale plain"},
    {.what = "a sphere's volume, as asked",
     .options = {.vars = "u,v,w", .scale = FG_SCALE_PLAIN},
     .field = "plain" VOLUME},
    {.what = "holes and masks cut the volume",
     .file = PLAIN "byte sea(y,x) = 1*4 0 1*15",
     .options = {.mask = "sea"},
     .field = "missing 3\n|u = 1 2 3 4 nan 11|w = 3 4 5 6 nan 13"},
    {.what = "a hole of one component is one of all",
     .file = AXES PAIR "float w(" ALL ")" SPEED " = 1*33 -999 1*86",
     .field = "missing 1\n|u = 1 2 3 4 5 11 12 13 14 15 21 22 23 24 25 31 32 33 34 35 "
              "101 102 103 104 105 111 112 113 114 115 121 122 123 nan 125"},
};

SITUATIONS_MAIN("read/netcdf/volume", SITUATIONS)
