/* Axes and dimensions: which are longitude and latitude, in which order they run, and
 * what fits none. Column i has u = v = i + 1, which identifies it at its longitude. */
#include "read/netcdf/situation_test.h"

#define NORTHWARD "lat[3] :units=degrees_north = -10 5 30;"
#define COMPONENTS "float u(lat,lon) ~ 1 lon 1; float v(lat,lon) ~ 1 lon 1;"
#define OF_LONGITUDES(list) NORTHWARD "lon" list "; " COMPONENTS
#define EAST " :units=degrees_east = "

/* Positions in two dimensions, with a shear as of rounding to float, or of a curved grid.
 */
#define SHEARED(all, lon, lat, columns, across, along, shear)                            \
  "nav_lon(" all ") :units=degrees_east = " lon " ~ 0 " across " " shear                 \
  "; nav_lat(" all ") :units=degrees_north = " lat " ~ 0 " along " " shear               \
  "; float u(" all ") = " columns "; float v(" all ") = " columns ";"
#define STRAIGHT(all, shear)                                                             \
  SHEARED(all, "300 350 5 20", "-10*4 5*4 30*4", "1 2 3 4", "cross", "along", shear)
#define TRANSPOSED(all)                                                                  \
  SHEARED(all, "300*3 350*3 5*3 20*3", "-10 5 30", "1*3 2*3 3*3 4*3", "along", "cross",  \
          "1e-5")
#define CURVED "cross[3]; along[4];" STRAIGHT("cross,along", "2")
#define GRID "geo 4 x 3|axis 1 'latitude'|x = 300 350 365 380|y = -10 5 30|at 365 0 = 3 3"

#define MAPPED(mapping) MAPPED_BY("crs", mapping)
#define MAPPED_BY(variable, mapping)                                                     \
  "y[3] :units=m = 0 2500 5000; x[4] :units=m = 0 2500 5000 7500; int crs() "            \
  ":grid_mapping_name=" mapping "; float u(y,x) :standard_name=eastward_wind "           \
  ":grid_mapping=" variable                                                              \
  " ~ 1 x 1; float v(y,x) :standard_name=northward_wind ~ 1 x 1"
#define ROTATED(u, v)                                                                    \
  "rlat[3] :units=degrees :standard_name=grid_latitude = -10 5 30; rlon[4] "             \
  ":units=degrees :standard_name=grid_longitude = -3 -2 -1 .5; float u(rlat,rlon)" u     \
  " = 1 2 3 4; float v(rlat,rlon)" v " = 1 2 3 4"
#define SQUARE NORTHWARD "lon[3] :units=degrees_east = -10 5 30;"
#define HUGE_PLANE(side)                                                                 \
  "y[" side "]; x[" side "]; float u(y,x) :_Chunks=#1000 1000; float v(y,x) "            \
  ":_Chunks=#1000 1000"

/* Coordinates along dimensions of other names, and of theirs in the other order, without
 * units: what they are called alone says which is x. */
#define CALLED(x, y, scale)                                                              \
  {.what = x " along a dimension of another name",                                       \
   .file = "r[3]; c[4]; " y "(r) = 10 20 30; " x "(c) = 2 4 6 8; float u(r,c) ~ 1 c 1; " \
           "float v(r,c) ~ 0 r 1",                                                       \
   .field = scale " 4 x 3|x = 2 4 6 8\n|y = 10 20 30\n|at 6 20 = 3 1|doubts ''"},        \
  {                                                                                      \
    .what = x " before " y,                                                              \
    .file = x "[4] = 2 4 6 8; " y "[3] = 10 20 30; float u(" x "," y ") ~ 1 " x          \
              " 1; float v(" x "," y ") ~ 0 " y " 1",                                    \
    .field = scale " 4 x 3|x = 2 4 6 8\n|y = 10 20 30\n|at 6 20 = 3 1|doubts ''"         \
  }
/* In two dimensions, curved: of a plane samples are counted, with a word. */
#define BOTH_WAYS(x, y, field_)                                                          \
  {                                                                                      \
    .what = x " in two dimensions",                                                      \
    .file = "r[3]; c[4]; " y "(r,c) ~ 10 r 2 c .3; " x "(r,c) ~ 2 c 2 r .5; float "      \
            "u(r,c) = 1; float v(r,c) = 1",                                              \
    .options = {.frame = FG_FRAME_EAST}, .field = field_                                 \
  }
#define COUNTED(x, y)                                                                    \
  BOTH_WAYS(x, y,                                                                        \
            "plain 4 x 3|doubts 'axes count the samples of 'u': '" x "' and '" y         \
            "' do not lie there'")

#define FLOW(u, v) "float u(" u ") = 1; float v(" v ") = 1;"
#define INDICES "y[3] = 0 1 2; x[4] = 0 1 2 3;"
#define ON_FACES "doubts 'axes count cells: 'u' and 'v' lie on faces without positions"

static const situation SITUATIONS[] = {
    {.what = "faces without positions",
     .file = "j[4]; i[4]; j_g[4]; i_g[4];" FLOW("j,i_g", "j_g,i"),
     .field = "plain 3 x 3|" ON_FACES},
    {.what = "the same, whose faces and centres are counted",
     .file = "j[4] = 0 1 2 3; i[4] = 0 1 2 3; j_g[4] = 0 1 2 3; i_g[4] = 0 1 2 3;" FLOW(
         "j,i_g", "j_g,i"),
     .field = "plain 3 x 3|" ON_FACES},
    {.what = "faces on both sides of cells (WRF)",
     .file = "south_north[3]; west_east[4]; south_north_stag[4]; west_east_stag[5];" FLOW(
         "south_north,west_east_stag", "south_north_stag,west_east"),
     .field = "plain 4 x 3|" ON_FACES,
     .inventory = ON_FACES},
    {.what = "faces at places of a plane",
     .file =
         "j[4] :units=m = 5 15 25 35; i[4] :units=m = 5 15 25 35; j_g[4] :units=m = 0 "
         "10 20 30; i_g[4] :units=m = 0 10 20 30;" FLOW("j,i_g", "j_g,i"),
     .field = "map 3 x 3|x = 5 15 25\n|doubts ''"},
    {.what = "sample numbers beside positions of other points",
     .file = INDICES "r[4]; c[5]; lon(r,c) ~ 9 c 1; lat(r,c) ~ 9 r 1;" FLOW("y,x", "y,x"),
     .field =
         "plain 4 x 3|doubts 'axes count the samples of 'u': 'lon' and 'lat' do not lie "
         "there'",
     .inventory = "doubts 'axes count the samples of 'u'"},
    {.what = "positions by their standard names in a plane (Delft3D)",
     .file =
         "m[3]; n[4]; XZ(m,n) :units=m :standard_name=projection_x_coordinate ~ 9 m 5 "
         "n 1; YZ(m,n) :units=m :standard_name=projection_y_coordinate ~ 9 n 5 m 1;" FLOW(
             "m,n", "m,n"),
     .field =
         "plain |doubts 'axes count the samples of 'u': 'XZ' and 'YZ' do not lie there"},
    {.what = "positions of two points of cells, of which nothing says which are meant",
     .file =
         "j[4]; i[5]; TLONG(j,i) ~ 9 i 1 j .2; TLAT(j,i) ~ 9 j 1; ULONG(j,i) ~ 9.5 i 1 "
         "j .2; ULAT(j,i) ~ 9.5 j 1;" FLOW("j,i", "j,i"),
     .options = {.frame = FG_FRAME_EAST},
     .field = "geo |doubts ''u' is taken to lie at 'TLONG', not at 'ULONG''"},
    {.what = "the same, where the attribute says",
     .file =
         "j[4]; i[5]; TLONG(j,i) ~ 9 i 1 j .2; TLAT(j,i) ~ 9 j 1; ULONG(j,i) ~ 9.5 i 1 "
         "j .2; ULAT(j,i) ~ 9.5 j 1; float u(j,i) :coordinates=ULONG ULAT = 1; float "
         "v(j,i) :coordinates=ULONG ULAT = 1",
     .options = {.frame = FG_FRAME_EAST},
     .field = "geo |doubts ''"},
    {.what = "positions that are farther apart than the points of a cell",
     .file =
         "j[4]; i[5]; TLONG(j,i) ~ 9 i 1 j .2; TLAT(j,i) ~ 9 j 1; ULONG(j,i) ~ 12 i 1 "
         "j .2; ULAT(j,i) ~ 9.5 j 1;" FLOW("j,i", "j,i"),
     .options = {.frame = FG_FRAME_EAST},
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'TLONG' and 'ULONG' are more than a cell apart, and nothing says at "
                "which 'u' lies"},
    {.what = "latitudes that are",
     .file = "y[4]; x[5]; lon(x) ~ 9 x 1; lat(y) ~ 9 y 1; lat_v(y) ~ 19 y 1;" FLOW("y,x",
                                                                                   "y,x"),
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'lat' and 'lat_v' are more than a cell apart"},
    {.what = "the same, where the attribute says",
     .file = "y[4]; x[5]; lon(x) ~ 9 x 1; lat(y) ~ 9 y 1; lat_v(y) ~ 19 y 1; float "
             "u(y,x) :coordinates=lat_v lon = 1; float v(y,x) :coordinates=lat_v lon = 1",
     .field = "geo |y = 19 20 21 22"},
    {.what = "a longitude whose attribute says that it is along y",
     .file = "lat[4] :units=degrees_north :axis=X = 10 20 30 40; lon[5] "
             ":units=degrees_east :axis=Y = 1 2 3 4 5;" FLOW("lat,lon", "lat,lon"),
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'lat' is a latitude by its name, and a longitude by its axis X"},
    {.what = "the standard name says another frame than the long name",
     .file = "j[4]; i[5]; lon(j,i) ~ 9 i 1 j .2; lat(j,i) ~ 9 j 1; float u(j,i) "
             ":standard_name=eastward_wind :long_name=x component of wind = 1; float "
             "v(j,i) :standard_name=northward_wind :long_name=y component of wind = 1",
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'u' is along east and north by its standard name 'eastward_wind', and "
                "along the grid by its long name 'x component of wind'"},
    {.what = "the same, decided",
     .options = {.frame = FG_FRAME_EAST},
     .field = "geo |doubts ''"},
    {.what = "longitudes without latitudes",
     .file = INDICES "lon(y,x) ~ 9 x 1;" FLOW("y,x", "y,x"),
     .field =
         "plain 4 x 3|doubts 'axes count the samples of 'u': 'lon' does not lie there'"},
    {.what = "the same along an axis",
     .file = "lat[3]; lon[4] = 10 20 30 40;" FLOW("lat,lon", "lat,lon"),
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'lat' counts samples, beside 'longitude' in degrees"},
    {.what = "the same as numbers",
     .options = {.scale = FG_SCALE_PLAIN},
     .field = "plain 4 x 3|doubts ''"},
    {.what = "longitude and latitude without numbers",
     .file = "lat[3]; lon[4];" FLOW("lat,lon", "lat,lon"),
     .field =
         "plain 4 x 3|doubts ''lon' and 'lat' count samples: they have no coordinates'"},
    {.what = "x and y of a unit of their own",
     .file = "y[3] = 0 .1 .2; x[4] = 0 .1 .2 .3; r[4]; lon(r) = 1; lat(r) = 1;" FLOW(
         "y,x", "y,x"),
     .field = "plain 4 x 3|x = 0 0.1 0.2 0.3\n|doubts ''"},
    {.what = "sample numbers, where the file has no places",
     .file = INDICES FLOW("y,x", "y,x"),
     .field = "plain 4 x 3|doubts ''"},
    CALLED("x_f", "y_f", "plain"),
    CALLED("x_rho", "y_rho", "plain"),
    CALLED("xu", "yu", "plain"),
    CALLED("xq", "yq", "plain"),
    CALLED("XG", "YG", "plain"),
    CALLED("X1", "Y1", "plain"),
    CALLED("grid_xt", "grid_yt", "plain"),
    CALLED("xCell", "yCell", "plain"),
    CALLED("easting_c", "northing_c", "plain"),
    CALLED("lon_0", "lat_0", "geo"),
    CALLED("nav_lon_u", "nav_lat_u", "geo"),
    CALLED("longitude_t", "latitude_t", "geo"),
    CALLED("TLONG", "TLAT", "geo"),
    CALLED("XLONG_U", "XLAT_U", "geo"),
    CALLED("geolon_c", "geolat_c", "geo"),
    CALLED("glamt", "gphit", "geo"),
    CALLED("ulon", "ulat", "geo"),
    BOTH_WAYS("glamu", "gphiu", "geo "),
    BOTH_WAYS("nav_lon_grid", "nav_lat_grid", "geo "),
    COUNTED("x_rho", "y_rho"),
    COUNTED("xc", "yc"),
    COUNTED("x_face", "y_face"),
    {.what = "places of cells and faces along one dimension: neither is taken",
     .file = "r[3]; c[4]; y_c(r) = 1 2 3; y_f(r) = 1.5 2.5 3.5; x_c(c) = 2 4 6 8; x_f(c) "
             "= 3 5 7 9; float u(r,c) = 1; float v(r,c) = 1",
     .field = "plain 4 x 3|x = 0 1 2 3\n|doubts 'axes count the samples of 'u'"},
    {.what = "positions along one dimension are those of points, not its axis",
     .file =
         "n[4]; r[3]; lon_0(n) = 1 2 3 1; lat_0(n) = 4 3 1 1; float u(r,n) = 1; float "
         "v(r,n) = 1",
     .field = "geo "},
    {.what = "a closed circle is periodic",
     .file = OF_LONGITUDES("[36]" EAST "5:355:10"),
     .field = "geo 36 x 3|period 0 360|at -355 0 = 1 1|at 357.5 0 = 27.25 27.25"},
    {.what = "one column short is a region",
     .file = OF_LONGITUDES("[35]" EAST "0:340:10"),
     .field = "open 0|at 345 0 = none"},
    /* columns at either end that repeat others are read once */
    {.what = "from -180 to 180",
     .file = OF_LONGITUDES("[37]" EAST "-180:180:10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 1 2 3 4|at 170 0 = 36 36"},
    {.what = "three columns twice",
     .file = OF_LONGITUDES("[39]" EAST "-180:200:10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 1 2 3 4|at 170 0 = 36 36"},
    {.what = "five columns twice",
     .file = OF_LONGITUDES("[41]" EAST "-180:220:10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 1 2 3 4|at 170 0 = 36 36"},
    {.what = "from 180 to -180",
     .file = OF_LONGITUDES("[37]" EAST "180:-180:-10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 37 36 35|at 170 0 = 2 2"},
    {.what = "three columns twice, westward",
     .file = OF_LONGITUDES("[39]" EAST "200:-180:-10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 39 38 37|at 170 0 = 4 4"},
    {.what = "five columns twice, westward",
     .file = OF_LONGITUDES("[41]" EAST "220:-180:-10"),
     .field = "geo 36 x 3|period 0 360|x = -180 -170|u = 41 40 39|at 170 0 = 6 6"},
    {.what = "longitudes that jump at 180",
     .file = OF_LONGITUDES("[6]" EAST "150 170 -170 -150 -110 -60"),
     .field = "x = 150 170 190 210 250 300\n|u = 1 2 3 4 5 6 1"},
    {.what = "longitudes that jump at 360",
     .file = OF_LONGITUDES("[6]" EAST "300 340 0 20 30 35.5"),
     .field = "x = 300 340 360 380 390 395.5\n|u = 1 2 3 4 5 6 1"},
    {.what = "longitudes that jump westward",
     .file = OF_LONGITUDES("[6]" EAST "-150 -170 170 150 149 120"),
     .field = "x = -240 -211 -210 -190 -170 -150\n|u = 6 5 4 3 2 1 6"},
    {.what = "a longitude twice",
     .file = OF_LONGITUDES("[4]" EAST "1 2 2 4"),
     .refused = "not strictly monotonic: 2 and 2 at samples 1 and 2"},
    {.what = "longitudes out of order",
     .file = OF_LONGITUDES("[4]" EAST "9 7 8 4"),
     .refused = "not strictly monotonic: 7 and 8 at samples 1 and 2"},
    {.what = "a longitude that is no number",
     .file = OF_LONGITUDES("[3]" EAST "1 nan 3"),
     .refused = "coordinate 1 of 'lon' is"},
    {.what = "a longitude that is missing",
     .file = OF_LONGITUDES("[3]" EAST "1 2 _"),
     .refused = "coordinate 2 of 'lon' is"},
    {.what = "a single column",
     .file = OF_LONGITUDES("[1]" EAST "1"),
     .refused = "only 1 sample"},

    {.what = "positions of a grid along longitude and latitude",
     .file = "cross[3]; along[4];" STRAIGHT("cross,along", "1e-5"),
     .field = GRID},
    {.what = "its columns are along latitude",
     .file = "cross[4]; along[3];" TRANSPOSED("cross,along"),
     .field = GRID},
    {.what = "its positions have a time",
     .file = "Time[1]; cross[3]; along[4];" STRAIGHT("Time,cross,along", "1e-5"),
     .field = GRID},
    {.what = "its positions have a time, and columns are along latitude",
     .file = "Time[1]; cross[4]; along[3];" TRANSPOSED("Time,cross,along"),
     .field = GRID},
    {.what = "a curvilinear grid without a frame",
     .file = CURVED,
     .refused = "nothing says whether 'u' and 'v' point east",
     .hint = "--frame grid"},
    {.what = "a curvilinear grid as a map",
     .options = {.scale = FG_SCALE_MAP},
     .refused = "curvilinear",
     .hint = "--scale plain"},
    {.what = "a curvilinear grid on its indices",
     .options = {.scale = FG_SCALE_PLAIN},
     .field = "plain 4 x 3|x = 0 1 2 3\n|axis 0 'along' ''"},
    {.what = "lines of a swath at times of their own are no times of the field (SWOT)",
     .file = CURVED "time(cross) :units=seconds since 2000-01-01 = 0 3 6",
     .options = {.frame = FG_FRAME_EAST},
     .field = "geo "},

    {.what = "components along east on axes that do not run east",
     .file = MAPPED("lambert_conformal_conic"),
     .refused = "points east",
     .hint = "--scale map"},
    {.what = "the same, of a mapping that names its axes",
     .file = MAPPED_BY("crs: x y", "lambert_conformal_conic"),
     .refused = "points east",
     .hint = "--scale map"},
    {.what = "the same, as asked", .options = {.scale = FG_SCALE_MAP}, .field = "map "},
    {.what = "Mercator's axes run east", .file = MAPPED("mercator"), .field = "map "},
    {.what = "a rotated pole alone is a plane: nothing says where it is",
     .file = ROTATED("", ""),
     .field = "plain |axis 0 'grid longitude' '°'"},
    {.what = "the same with components along east",
     .file = ROTATED(" :standard_name=eastward_wind", " :standard_name=northward_wind"),
     .refused = "'u' points east, but the axes of its rotated grid do not"},
    {.what = "without coordinates or known names the last dimension is x",
     .file = "one[1]; gridx[3]; gridy[4]; float u(one,gridx,gridy) = 1 2 3 4; float "
             "v(one,gridx,gridy) = 1 2 3 4",
     .field = "plain 4 x 3|u = 1 2 3 4 1 2 3 4 1 2 3 4\n"},

    {.what = "a dimension that is neither time nor level",
     .file = "time[2]; lev[2]; member[3];" SQUARE "float u(time,lev,member,lat,lon); "
             "float v(time,lev,member,lat,lon)",
     .refused = "dimension 'member' of 3 samples is neither time nor level",
     .hint = "--at member=0"},
    {.what = "an empty dimension",
     .file = "time[*0];" SQUARE "float u(time,lat,lon); float v(time,lat,lon)",
     .refused = "dimension 'time' is empty"},
    {.what = "a line of stations",
     .file = "time[4]; station[7]; float u(time,station); float v(time,station)",
     .refused = "only one dimension in space"},
    {.what = "components of different rank",
     .file = "time[2];" SQUARE "float u(time,lat,lon); float v(lat,lon)",
     .refused = "'u' is 2 x 3 x 3, 'v' is 3 x 3 samples|!staggered"},
    /* a file of a few kilobytes that declares gigabytes costs neither time nor memory */
    {.what = "more samples than the file can have",
     .file = HUGE_PLANE("40000"),
     .mode = NC_NETCDF4,
     .refused = "but the file has only"},
    {.what = "more samples than a field can have",
     .file = HUGE_PLANE("2000000000"),
     .mode = NC_NETCDF4,
     .refused = "are more than the"},
    {.what = "long coordinates are not read to compare the components' places",
     .file = "upper[2000000000] :_Chunks=#1000; lower[2000000000] :_Chunks=#1000;" SQUARE
             "float u(upper,lat,lon) :_Chunks=#1000 3 3; float v(lower,lat,lon) "
             ":_Chunks=#1000 3 3",
     .mode = NC_NETCDF4,
     .refused = "'u' runs along 'upper', 'v' along 'lower'"},
};

SITUATIONS_MAIN("read/netcdf/axes", SITUATIONS)
