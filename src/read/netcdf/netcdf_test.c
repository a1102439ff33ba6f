/* What every NetCDF file has: kinds of files, orders of dimensions, times and levels, and
 * requests that cannot be met. */
#include "read/netcdf/situation_test.h"

#define AXES(units) "y[4]" units " = -3 -1 .5 .75; x[5]" units " = 1.5 2 4 4.5 7;"
#define KILOMETRES AXES(" :units=km")
#define PLAIN KILOMETRES "float u(y,x) ~ 1 x 1 y 8; float v(y,x) ~ -2 x .5 y -3"
#define READ_PLAIN                                                                       \
  "map 5 x 4\n|axis 0 'x' 'km'|x = 1.5 2 4 4.5 7\n|y = -3 -1 0.5 0.75\n|time ''|level "  \
  "''|u = 1 2 3 4 5 9 10 11 12 13 17 18 19 20 21 25 26 27 28 29\n|v = -2 -1.5 -1 -0.5 "  \
  "0 -5 "
#define KIND(what_, mode_)                                                               \
  {                                                                                      \
    .what = what_, .file = PLAIN, .mode = mode_, .field = READ_PLAIN                     \
  }

/* Any order of dimensions, and axes that descend. The first number is such that it is 121
 * at the last time and level. */
#define ALONG(all, first, x, y)                                                          \
  "lon[5] :units=degrees_east = " x                                                      \
  "; time[3] :units=hours since 2001-02-28 12:00 = 6 12 18; lev[2] :units=hPa = 850 "    \
  "500; lat[4] :units=degrees_north = " y "; float u(" all ") ~ " first                  \
  " lon 1 lat 8 time 10 lev 100; float v(" all ") ~ " first                              \
  " lon -1 lat 8 time 10 lev 100"
#define RISING_X "1.5 2 4 4.5 7"
#define RISING_Y "-3 -1 .5 .75"
#define FALLING_X "7 4.5 4 2 1.5"
#define FALLING_Y ".75 .5 -1 -3"
#define DIRECTED(all, first, last, levelled, words, x_, y_, u_, v_)                      \
  {                                                                                      \
    .what = all, .file = ALONG(all, first, x_, y_),                                      \
    .options = {.time = last, .level = levelled},                                        \
    .field = "geo 5 x 4\n|x = 1.5 2 4 4.5 7\n|y = -3 -1 0.5 0.75\n|u = " u_ "|v = " v_   \
             "|" words                                                                   \
  }
#define BEYOND(time_, level_, words)                                                     \
  {                                                                                      \
    .what = words, .options = {.time = time_, .level = level_},                          \
    .status = FG_STATUS_ARGUMENT, .refused = words                                       \
  }
#define ORDER(all, first, last, levelled, words, times)                                  \
  DIRECTED(all, first, last, levelled, words, RISING_X, RISING_Y,                        \
           "121 122 123 124 125 129 ", "121 120 119 118 117 129 "),                      \
      DIRECTED(all, first, last, levelled, words, FALLING_X, RISING_Y,                   \
               "125 124 123 122 121 133 ", "117 118 119 120 121 125 "),                  \
      DIRECTED(all, first, last, levelled, words, RISING_X, FALLING_Y,                   \
               "145 146 147 148 149 137 ", "145 144 143 142 141 137 "),                  \
      DIRECTED(all, first, last, levelled, words, FALLING_X, FALLING_Y,                  \
               "149 148 147 146 145 141 ", "141 142 143 144 145 133 "),                  \
      BEYOND((last) + 1, levelled, times), BEYOND(last, -1, "level -1")
#define BOTH "time '2001-03-01 06:00'|level '500 hPa'"

#define WINDS                                                                            \
  "rows[4] :units=degrees_north = 59:62:1; columns[5] :units=degrees_east = 0:4:1;"      \
  "float abc(rows,columns) :standard_name=eastward_wind :units=m s-1 "                   \
  ":long_name=10 metre U wind component = 3; float xyz(rows,columns) "                   \
  ":standard_name=northward_wind :units=m.s**-1 :long_name=10 metre V wind component = " \
  "8"

#define REFUSED(vars_, words)                                                            \
  {                                                                                      \
    .what = vars_, .options = {.vars = vars_}, .status = FG_STATUS_ARGUMENT,             \
    .refused = words                                                                     \
  }
#define UNSUPPORTED(vars_, words)                                                        \
  {                                                                                      \
    .what = vars_, .options = {.vars = vars_}, .refused = words                          \
  }

/* as xarray writes what it has chosen: coordinates that components, or the file, name */
#define SINGLE(what_, of_u, of_file)                                                     \
  {                                                                                      \
    .what = what_,                                                                       \
    .file =                                                                              \
        "ny[4]; nx[5]; start() :standard_name=forecast_reference_time :units=hours "     \
        "since 2023-05-01 = 0; valid() :standard_name=time :units=hours since "          \
        "2023-05-01 = 6; height() :standard_name=height :units=m = 10; float u(ny,nx) "  \
        ":standard_name=eastward_wind :units=m/s" of_u " = 1 2; float v(ny,nx) "         \
        ":standard_name=northward_wind :units=m/s = 1 2;" of_file,                       \
    .field = "time '2023-05-01 06:00'|level 'height 10 m'",                              \
    .inventory = "times 1\n|time '2023-05-01 06:00'|level 'height 10 m'"                 \
  }
#define COORDINATES " :coordinates=start valid height"

/* In the ocean the surface is read; in the air, or without attributes, the first level.
 */
#define LEVEL(what_, attributes, levels, usual)                                          \
  {                                                                                      \
    .what = what_,                                                                       \
    .file = "level[3]" attributes " = " levels                                           \
            "; ny[4]; nx[5]; float u(level,ny,nx) :units=m/s :coordinates=level glat "   \
            "glon; float v(level,ny,nx) :units=m/s :coordinates=level glat glon",        \
    .inventory = "usual level " usual "\n|absent 'glat, glon'"                           \
  }
#define RISING "-90 -5 -40"
#define DEPTHS "40 5 90"

static const situation SITUATIONS[] = {
    KIND("classic", 0),
    KIND("with long offsets", NC_64BIT_OFFSET),
    KIND("with long lengths", NC_64BIT_DATA),
    KIND("NetCDF-4", NC_NETCDF4),
    KIND("NetCDF-4 classic", NC_NETCDF4 | NC_CLASSIC_MODEL),
    ORDER("time,lev,lat,lon", "1", 2, 1, BOTH, "0 to 2"),
    ORDER("time,lev,lon,lat", "1", 2, 1, BOTH, "0 to 2"),
    ORDER("lon,lat,lev,time", "1", 2, 1, BOTH, "0 to 2"),
    ORDER("lat,time,lon,lev", "1", 2, 1, BOTH, "0 to 2"),
    ORDER("lat,lon", "121", 0, 0, "time ''|level ''", "no time axis"),
    ORDER("lon,lat", "121", 0, 0, "time ''|level ''", "no time axis"),
    ORDER("time,lon,lat", "101", 2, 0, "time '2001-03-01 06:00'|level ''", "0 to 2"),
    {.what = "winds on the sphere",
     .file = WINDS,
     .field = "geo |units 'm/s'|axis 0 'longitude' '°E'|axis 1 'latitude' '°N'|title '10 "
              "metre wind'|tangent 1.3 60 = 6 8"},
    {.what = "winds as stored",
     .options = {.scale = FG_SCALE_PLAIN},
     .field = "plain |tangent 1.3 60 = 3 8"},
    {.what = "groups are searched",
     .file = KILOMETRES "float ocean/uo(y,x) ~ 1 x 1 y 8; float ocean/vo(y,x) ~ -2 x .5",
     .mode = NC_NETCDF4,
     .field = "name 'ocean/uo'|u = 1 2 3 4 5 9 10|v = -2 -1.5 "},
    {.what = "with and without the group's name",
     .options = {.vars = "uo,ocean/vo"},
     .field = "u = 1 2 "},

    {.what = "another order of components",
     .file = KILOMETRES
     "float u(y,x) :units=m/s ~ 1 x 1; float v(y,x) ~ 2 y 1; "
     "char letters(y,x); string words(y,x); float line(y); float slow(y,x) "
     ":units=cm/s",
     .mode = NC_NETCDF4,
     .options = {.vars = "v,u"},
     .field = "name 'v'\nx ="},
    {.what = "one component",
     .options = {.vars = "u"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "'u' is one variable, and a velocity has two or three components",
     .hint = "pairs in it: u,v"},
    REFUSED("u,v,w", "'w'"),
    REFUSED(",v", "two"),
    REFUSED("u,u", "both"),
    REFUSED("u,w", "'w'"),
    UNSUPPORTED("u,letters", "text"),
    UNSUPPORTED("u,words", "text"),
    UNSUPPORTED("u,line", "'line' has 1 dimension"),
    UNSUPPORTED("u,slow", "'u' is in m/s, 'slow' in cm/s"),
    {.what = "kilometres are no longitudes",
     .options = {.scale = FG_SCALE_GEO},
     .refused = "'x' is in km"},
    {.what = "no vectors",
     .file = "x[5] :units=m = 1:5:1; float temperature(x)",
     .refused = "no vectors found among its 2 variables: x, temperature",
     .inventory = "vectors 0\n"},

    {.what = "an inventory has what reading gives",
     .file = KILOMETRES "u(y,x) ~ 1 x 1; v(y,x) = 2.5 _ 2.5 2.5",
     .mode = NC_64BIT_OFFSET,
     .inventory = "NetCDF\nvectors 1\n[u,v names]|map 5 x 4\n|missing 0.25\n|times 1\n|"
                  "bounds = 1.5 7 -3 0.75\n|open\n|!unusable"},
    /* a second pair of one time and level shows that the chosen pair is read */
    {.what = "times and levels",
     .file = "time[3] :units=hours since 2001-02-28 12:00 = 0 6 12.008333; lev[2] "
             ":units=Pa = 85000 30000;" KILOMETRES "float u(time,lev,y,x); float "
             "v(time,lev,y,x); float u10(y,x); float v10(y,x)",
     .options = {.vars = "u,v"},
     .inventory = "vectors 1\n|times 3\n|levels 2\n|time '2001-02-28 18:00' 6 'hours|"
                  "time '2001-03-01 00:00:30'|level '300 hPa' 30000 'Pa'"},
    {.what = "a pair of one time and level",
     .options = {.vars = "v10,u10"},
     .inventory = "[v10,u10 |times 1\n|levels 1\n|!time '"},
    SINGLE("coordinates of a component", COORDINATES, ""),
    SINGLE("coordinates of the file", "", ":coordinates=start valid height"),
    LEVEL("s up", " :standard_name=ocean_s_coordinate_g2 :positive=up", RISING, "1"),
    LEVEL("sigma", " :standard_name=ocean_sigma_coordinate", RISING, "1"),
    LEVEL("depth", " :standard_name=depth :units=m", DEPTHS, "1"),
    LEVEL("down", " :positive=down :units=m", DEPTHS, "1"),
    LEVEL("depth, negative", " :standard_name=depth :positive=down :units=m", RISING,
          "1"),
    LEVEL("down, negative", " :positive=down :units=m", RISING, "1"),
    LEVEL("up, negative", " :positive=up :units=m", RISING, "1"),
    LEVEL("up", " :positive=up :units=m", DEPTHS, "0"),
    LEVEL("height", " :standard_name=height :positive=up :units=m", RISING, "0"),
    LEVEL("pressure", " :standard_name=air_pressure :positive=down :units=hPa", DEPTHS,
          "0"),
    /* 65160 packed global samples, none missing */
    {.what = "the file of the demonstration",
     .path = FLOWGRAIN_SOURCE_DIR "/data/gfs_20140131.nc",
     .field = "geo 360 x 181\n|period 0 360|y = -90 -89|units 'm/s'|missing 0\n|at -0.5 "
              "45.5 = there"},
};

SITUATIONS_MAIN("read/netcdf/netcdf", SITUATIONS)
