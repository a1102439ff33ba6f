/* Extents that a file states beside its coordinates: global attributes, and bounds of
 * cells. */
#include "read/netcdf/situation_test.h"

#define FLOW "float u(lat,lon) = 1; float v(lat,lon) = 2;"
#define AXES(lat, lon)                                                                   \
  "lat[4] :units=degrees_north = " lat "; lon[5] :units=degrees_east = " lon ";" FLOW
#define HERE AXES("10 12 14 16", "200 202 204 206 208")
#define LATITUDES(a, b) ":geospatial_lat_min=" a "; :geospatial_lat_max=" b ";"
#define LONGITUDES(a, b) ":geospatial_lon_min=" a "; :geospatial_lon_max=" b ";"
#define BOUNDED(lat, lon)                                                                \
  "n[2]; lat[4] :units=degrees_north :bounds=lat_b = 10 12 14 16; lon[5] "               \
  ":units=degrees_east :bounds=lon_b = 200 202 204 206 208; lat_b(lat,n) = " lat         \
  "; lon_b(lon,n) = " lon ";" FLOW
#define CURVED(attributes)                                                               \
  "y[4]; x[5]; lat(y,x) :units=degrees_north ~ 10 y 2 x .4; lon(y,x) "                   \
  ":units=degrees_east ~ 200 x 2 y .3; float u(y,x) :standard_name=eastward_wind = 1; "  \
  "float v(y,x) :standard_name=northward_wind = 2;" attributes

#define MONTHS(times, bounds)                                                            \
  "n[2]; lat[4] :units=degrees_north = 10 12 14 16; lon[5] :units=degrees_east = 200 "   \
  "202 204 206 208; time[2] :units=days since 2001-01-01 :bounds=time_b = " times        \
  "; time_b(time,n) = " bounds "; float u(time,lat,lon) = 1; float v(time,lat,lon) = 2;"

#define AGREES(what_, file_)                                                             \
  {                                                                                      \
    .what = what_, .file = file_, .field = "geo 5 x 4|doubts ''"                         \
  }
#define REFUSED(what_, file_, words)                                                     \
  {.what = what_, .file = file_, .refused = words, .hint = "--scale geo"},               \
  {                                                                                      \
    .what = what_ ", as asked", .options = {.scale = FG_SCALE_GEO}, .field = "geo "      \
  }

static const situation SITUATIONS[] = {
    AGREES("edges", HERE LATITUDES("#9", "#17") LONGITUDES("#199", "#209")),
    AGREES("centres, rounded",
           HERE LATITUDES("#10.001", "#15.9") LONGITUDES("#200", "#208")),
    AGREES("as text", HERE LATITUDES("9.0", "17.0") LONGITUDES("199.0", "209.0")),
    AGREES("longitudes to the west", HERE LONGITUDES("#-161", "#-151")),
    AGREES("round the date line",
           AXES("10 12 14 16", "176 178 180 182 184") LONGITUDES("#175", "#-175")),
    AGREES("what it was cut out of",
           HERE LATITUDES("#-90", "#90") LONGITUDES("#0", "#360")),
    AGREES("from -180 to 180", HERE LONGITUDES("#-180", "#180")),
    AGREES("from -179.5 to 179.5", HERE LONGITUDES("#-179.5", "#179.5")),
    AGREES("northern latitude first", HERE LATITUDES("#17", "#9")),
    AGREES("in radians",
           HERE ":geospatial_lat_units=radian;" LATITUDES("#.157", "#.297")),
    AGREES("nothing but zeros", HERE LATITUDES("#0", "#0") LONGITUDES("#0", "#0")),
    AGREES("a fill", HERE LATITUDES("#-999", "#-999") LONGITUDES("#-999", "#999")),
    AGREES("no numbers", HERE LATITUDES("unknown", "north") LONGITUDES("", "")),
    {.what = "a row and a column more",
     .file = HERE LATITUDES("#10", "#13") LONGITUDES("#200", "#205"),
     .field = "geo 5 x 4|doubts '1 of 5 longitudes lie outside 200 to 205, which "
              "geospatial_lon_min and geospatial_lon_max state\n1 of 4 latitudes",
     .inventory = "geo 5 x 4|doubts '1 of 5 longitudes"},
    REFUSED("latitudes of the other hemisphere", HERE LATITUDES("#-17", "#-9"),
            "latitudes are 10 to 16 by coordinates, and -17 to -9 by geospatial_lat_min"),
    REFUSED(
        "longitudes elsewhere", HERE LONGITUDES("#20", "#30"),
        "longitudes are 200 to 208 by coordinates, and 20 to 30 by geospatial_lon_min"),
    REFUSED("radians called degrees",
            AXES(".1 .12 .14 .16", ".2 .22 .24 .26 .28") LATITUDES("#5", "#10"),
            "latitudes are 0.1 to 0.16 by coordinates, and 5 to 10 by"),
    REFUSED("a curved grid elsewhere", CURVED(LATITUDES("#-20", "#-5")),
            "latitudes are 10 to 17.6 by coordinates, and -20 to -5 by"),
    {.what = "a curved grid there",
     .file = CURVED(LATITUDES("#10", "#17.6")),
     .field = "geo |doubts ''"},

    AGREES("cells round their centres",
           BOUNDED("9 11 11 13 13 15 15 17", "199 201 201 203 203 205 205 207 207 209")),
    AGREES("longitudes of cells to the west, latitudes reversed",
           BOUNDED("11 9 13 11 15 13 17 15",
                   "-161 -159 -159 -157 -157 -155 -155 -153 -153 -151")),
    AGREES("cells that were never written", BOUNDED("0*8", "0*10")),
    REFUSED("cells of the other hemisphere",
            BOUNDED("-17 -15 -15 -13 -13 -11 -11 -9", "199 201 201 203 203 205 205 207"),
            "'lat' lies outside the cells of 'lat_b', its bounds, at 4 of 4 samples"),

    AGREES("times within their bounds", MONTHS("15 45", "0 31 31 59")),
    AGREES("times at which their bounds begin", MONTHS("0 31", "0 31 31 59")),
    AGREES("times at which hours end", MONTHS("1 1.125", ".875 1 1 1.125")),
    {.what = "times at which months end",
     .file = MONTHS("31 59", "0 31 31 59"),
     .field = "doubts 'times are the ends of their bounds: 2001-02-01 that of 2001-01-01 "
              "to 2001-02-01'"},
    {.what = "times outside their bounds",
     .file = MONTHS("75 105", "0 31 31 59"),
     .field = "doubts 'times lie outside their bounds: 2001-03-17 that of 2001-01-01 to "
              "2001-02-01'"},
};

SITUATIONS_MAIN("read/netcdf/extent", SITUATIONS)
