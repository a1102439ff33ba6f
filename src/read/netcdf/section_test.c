/* Vertical sections: of a component along the ground and one along the vertical, over
 * heights, depths and pressures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "read/netcdf/situation_test.h"

/* 12 degrees along 60 north are 667.17 km, and 6 of them are drawn as high as 12 km. */
#define HEIGHTS "height[4] :units=m :positive=up :axis=Z = 0 4000 8000 12000;"
#define LONGITUDES "lon[4] :units=degrees_east = 118:130:4;"
#define AT_60 "lat() :units=degrees_north = 60;"
#define WINDS                                                                            \
  "u(height,lon) :units=m/s = 8; v(height,lon) :units=m/s = 1;"                          \
  "w(height,lon) :units=m/s = 0.5 ~ 0 height 0.1;"
#define PRESSURES "level[3] :units=hPa = 1000 600 200;"
#define LATITUDES "lat[5] :units=degrees_north = -40:40:20;"
#define OMEGA                                                                            \
  "u(level,lat) :units=m/s = 9; v(level,lat) :units=m/s = 3;"                            \
  "omega(level,lat) :units=Pa/s = -0.1;"
#define OCEAN(attributes)                                                                \
  "depth[3] :units=m" attributes ";x[3] :units=km = 0 10 20;"                            \
  "u(depth,x) :units=cm/s = 20; w(depth,x) :units=m/s = 0.001"
#define CHANNEL "x[5] :units=m = 0:4:1; u(z,x) :units=m/s = 2; w(z,x) :units=m/s = 1"

static const situation SECTIONS[] = {
    /* one of y is 2000 m; 55597.5 m of x: 27.8 times */
    {.what = "longitude and height",
     .file = HEIGHTS LONGITUDES AT_60 WINDS,
     .field = "plain 4 x 4|axis 0 'longitude' '°E'|axis 1 'height' '2000 m'|"
              "y = 0 2 4 6|name 'u'|name 'w'|at 120 0 = 8 13.89937|"
              "at 120 3 = 8 18.06918|level 'at 60°N; vertical component × 27.8'|"
              "doubts ''",
     .inventory = "[u,w names]|bounds = 118 130 0 12000|plain 4 x 4|levels 1|"
                  "frame 'in a vertical section, at 60°N; vertical component × 27.8'"},
    {.what = "the same without a latitude",
     .file = HEIGHTS LONGITUDES WINDS,
     .field = "at 120 0 = 8 27.79873|doubts 'the latitude of the section along 'lon' is "
              "not known: distances are those at the equator'"},
    {.what = "a latitude of one sample",
     .file = HEIGHTS LONGITUDES
     "lat[1] :units=degrees_north = 60; u(height,lat,lon) :units=m/s = 8;"
     "w(height,lat,lon) :units=m/s = 0.5",
     .field = "plain 4 x 4|at 120 0 = 8 13.89937|doubts ''"},
    {.what = "one latitude of a volume",
     .file = HEIGHTS LONGITUDES
     "lat[3] :units=degrees_north = 0 30 60;"
     "u(height,lat,lon) :units=m/s = 8; v(height,lat,lon) :units=m/s = 1;"
     "w(height,lat,lon) :units=m/s = 0.5",
     .options = {.at = "lat=60."},
     .field = "plain 4 x 4|name 'w'|at 120 0 = 8 13.89937|level 'lat 60 "},
    {.what = "a component across the section",
     .file = HEIGHTS LONGITUDES AT_60 WINDS,
     .options = {.vars = "u,v"},
     .refused =
         "a vertical section along 'longitude', and nothing says that 'v' is along "
         "the vertical",
     .hint = "--vars u,w"},
    {.what = "the same, first",
     .options = {.vars = "v,w"},
     .refused = "'v' points north, across the vertical section along 'longitude'"},
    {.what = "three of them", .options = {.vars = "u,v,w"}, .refused = "two components"},
    {.what = "a map of a section",
     .options = {.vars = "u,w", .scale = FG_SCALE_GEO},
     .refused = "a vertical section is no map"},
    {.what = "heights from 0 by their logarithm",
     .options = {.vars = "u,w", .scale = FG_SCALE_LOG},
     .refused = "--scale log, and 'height' begins at 0"},
    {.what = "components as they are, along the axes",
     .options = {.vars = "u,w", .scale = FG_SCALE_PLAIN},
     .field = "axis 1 'height' '2000 m'|at 120 0 = 8 0.00025|level ''"},
    /* 80 degrees are 8895.59 km, 40 of them 800 hPa: one of y is 20 hPa downwards */
    {.what = "latitude and pressure",
     .file = PRESSURES LATITUDES OMEGA,
     .field = "plain 5 x 3|axis 0 'latitude' '°N'|axis 1 'level' '-20 hPa'|"
              "y = -50 -30 -10|name 'v'|name 'omega'|at 0 -30 = 3 5.559746|"
              "level 'vertical: 1 Pa/s drawn as 56 m/s'|doubts ''",
     .inventory = "[v,omega names]|bounds = -40 40 1000 200"},
    /* 40 degrees are 0.699 decades: one is 0.017; 0.001 hPa/s at 600 hPa */
    {.what = "the logarithm of pressure",
     .options = {.scale = FG_SCALE_LOG},
     .field = "axis 1 'level' '-0.017 lg(re 1 hPa)'|y = -176.471 -163.421 -135.355|"
              "at 0 -163.42065 = 3 4.734452|"
              "level 'vertical component in the axes' ratio'"},
    {.what = "a velocity upwards over pressures",
     .file =
         PRESSURES LATITUDES "v(level,lat) :units=m/s = 3; w(level,lat) :units=m/s = 0.1",
     .options = {.vars = "v,w"},
     .refused = "'v' in m/s and 'w' in m/s are no vector over 'level' in hPa"},
    {.what = "a tendency of pressure over heights",
     .file = HEIGHTS LONGITUDES AT_60
     "u(height,lon) :units=m/s = 8; omega(height,lon) :units=Pa/s = 0.5",
     .options = {.vars = "u,omega"},
     .refused = "are no vector over 'height' in m"},
    {.what = "levels without a unit",
     .file = "lev[3] = 1 2 3;" LONGITUDES AT_60
             "u(lev,lon) :units=m/s = 8; w(lev,lon) :units=m/s = 0.5",
     .options = {.vars = "u,w"},
     .refused = "are no vector over 'lev' in no unit"},
    {.what = "a distance without a unit",
     .file = HEIGHTS "x[4] = 0 1 2 3; u(height,x) :units=m/s = 8;"
                     "w(height,x) :units=m/s = 0.5",
     .options = {.vars = "u,w"},
     .refused = "'x' has no unit of a length or of degrees"},
    /* 20 km and 2 km: one of y is 200 m, 5 times, and 100 cm are a metre */
    {.what = "depths, which count downwards",
     .file = OCEAN(" :positive=down = 0 1000 2000"),
     .field = "axis 1 'depth' '-200 m'|y = -10 -5 0|at 10 -5 = 20 0.5|"
              "level 'vertical component × 5.0'|doubts ''|units 'cm/s'"},
    {.what = "a velocity downwards",
     .file = "z[3] :units=m :positive=up = 0 1 2; x[3] :units=m = 0 1 2;"
             "u(z,x) :units=m/s = 2; w(z,x) :units=m/s :long_name=downward velocity = 1",
     .options = {.vars = "u,w"},
     .refused = "'w' counts downwards by its long name 'downward velocity'"},
    {.what = "a component to the east along an axis of a projection",
     .file = "z[3] :units=m :positive=up = 0 1 2; x[3] :units=m = 0 1 2;"
             "u(z,x) :units=m/s :standard_name=eastward_wind = 2;"
             "w(z,x) :units=m/s = 1",
     .options = {.vars = "u,w"},
     .field = "at 1 1 = 2 1|doubts ''u' points east, and is taken to be along 'x''"},
    {.what = "depths by their name alone",
     .file = OCEAN(" = 0 1000 2000"),
     .field = "axis 1 'depth' '-200 m'|at 10 -5 = 20 0.5|doubts ''"},
    {.what = "depths below 0",
     .file = OCEAN(" = -2000 -1000 0"),
     .field = "axis 1 'depth' '200 m'|y = -10 -5 0|at 10 -5 = 20 0.5|doubts ''"},
    {.what = "depths below 0 that count downwards",
     .file = OCEAN(" :positive=down = -2000 -1000 0"),
     .refused = "'depth' counts downwards by its attribute positive, and is -2000 to 0"},
    {.what = "its true proportions",
     .file = "z[3] :units=m = 0 1 2;" CHANNEL,
     .field = "axis 1 'z' 'm'|at 2 1 = 2 1|level ''|doubts ''z' has no attribute "
              "positive: it is taken for a height'"},
    {.what = "the same, in another unit",
     .file = "z[3] :units=km :positive=up = 0 0.001 0.002;" CHANNEL,
     .field = "axis 1 'z' '0.001 km'|y = 0 1 2|at 2 1 = 2 1|level ''|doubts ''"},
    {.what = "no section of any kind",
     .file = "y[3] :units=m = 0 1 2; x[3] :units=m = 0 1 2; u(y,x) :units=m/s = 1;"
             "v(y,x) :units=m/s = 1",
     .options = {.scale = FG_SCALE_LOG},
     .refused = "--scale log is for vertical sections"},
};

SITUATIONS_MAIN("read/netcdf/section", SECTIONS)
