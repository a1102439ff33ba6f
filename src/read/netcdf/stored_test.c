/* Meaning of stored numbers: packed, missing, masked, out of range. */
#include "read/netcdf/situation_test.h"

#define AXES "y[4] :units=km = 0 1 2 3; x[5] :units=km = 0 1 2 3 4;"
#define PAIR(type, of_u, u, of_v, v)                                                     \
  AXES type "u(y,x)" of_u " = " u ";" type "v(y,x)" of_v " = " v ";"
#define COUNTED "1:20:1"

#define PACKED(type)                                                                     \
  {                                                                                      \
    .what = "packed " type,                                                              \
    .file = PAIR(type, " :scale_factor=#.5 :add_offset=#-7", "-20:37:3",                 \
                 " :scale_factor=#2", COUNTED),                                          \
    .field = "u = -17 -15.5 -14 -12.5 -11|8.5 10 11.5\nv = 2 4 6 8"                      \
  }
/* a value that was never written; and three reasons, with a range of stored values */
#define MISSING(type, fill)                                                              \
  {.what = "never written " type,                                                        \
   .file = PAIR(type, "", COUNTED, "", "1 2 3 " fill " 5:20:1"),                         \
   .field = "v = 1 2 3 nan 5 6",                                                         \
   .inventory = "missing 0.05\n"},                                                       \
  {                                                                                      \
    .what = "declared missing " type,                                                    \
    .file = PAIR(type,                                                                   \
                 " :_FillValue=@-999 :missing_value=@-777 :valid_max=@299 "              \
                 ":scale_factor=#.01",                                                   \
                 "1 2 3 -999 -777 6:19:1 300", " :scale_factor=#.01", COUNTED),          \
    .field = "u = 0.01 0.02 0.03 nan nan 0.06|0.18 0.19 nan\n",                          \
    .inventory = "missing 0.15\n"                                                        \
  }

static const situation SITUATIONS[] = {
    PACKED("short "),
    PACKED("float "),
    PACKED(""),
    PACKED("int "),
    PACKED("byte "),
    MISSING("short ", "-32767"),
    MISSING("int ", "-2147483647"),
    MISSING("float ", "_"),
    MISSING("", "_"),
    {.what = "no number, and a missing value that is not exact in float",
     .file = PAIR("float ", " :missing_value=#-1e34", "1 2 nan 4:17:1 -1e34 19 20", "",
                  COUNTED),
     .field = "u = 1 2 nan 4 5 6 7 8 9 10 11 12 13 14 15 16 17 nan 19 20\n"},
    {.what = "a range of the unpacked type is of unpacked values",
     .file = PAIR("short ", " :scale_factor=#.01 :valid_range=#-1 1.5", "-200 200 2:19:1",
                  " :scale_factor=#.01", COUNTED),
     .field = "u = nan nan 0.02 0.03",
     .inventory = "missing 0.1\n"},
    {.what = "a missing value of the unpacked type is of unpacked values",
     .file = PAIR("short ", " :scale_factor=#.5 :missing_value=#-3", "-6 2:20:1",
                  " :scale_factor=#.5", COUNTED),
     .field = "u = nan 1 1.5 2"},
    {.what = "missing values and a range by texts",
     .file = PAIR("short ", " :missing_value=-9 :valid_range=1, 19", COUNTED, "",
                  "-9 2:20:1"),
     .field = "u = 1 2 3|18 19 nan\nv = -9 2 3"},
    {.what = "a packing that is no number",
     .file = PAIR("short ", " :scale_factor=0,001 m/s", COUNTED, "", COUNTED),
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'u' has a scale_factor that is no number: '0,001 m/s'"},
    {.what = "one of two components of whole numbers is packed",
     .file = PAIR("short ", "", COUNTED, " :scale_factor=#.01", COUNTED),
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'v' has a scale_factor of 0.01, 'u' none, and both are whole numbers"},
    {.what = "a packed component beside one that is not",
     .file = PAIR("float ", "", COUNTED, " :scale_factor=#.01", COUNTED),
     .field = "u = 1 2 3|\nv = 0.01 0.02"},
    {.what = "packing by texts",
     .file = PAIR("short ", " :scale_factor=.5 :add_offset=-7", "-20:37:3",
                  " :scale_factor=2", COUNTED),
     .field = "u = -17 -15.5 -14 -12.5 -11|8.5 10 11.5\nv = 2 4 6 8"},
    {.what = "unsigned bytes",
     .file = PAIR("byte ", " :_Unsigned=true", "5 -1 -128 127", "", COUNTED),
     .field = "u = 5 255 128 127 5"},
    {.what = "an infinite number is missing",
     .file = PAIR("", "", COUNTED, "", "1:7:1 inf 9:20:1"),
     .field = "infinite 1|v = 1 2 3 4 5 6 7 nan 9",
     .inventory = "missing 0.05\n"},
    {.what = "a speed that is none",
     .file = PAIR("", "", COUNTED, "", "1:7:1 1e300 9:20:1"),
     .status = FG_STATUS_FILE_FORMAT,
     .refused = "sample (2, 1)"},
    {.what = "all is zero",
     .file = PAIR("", "", "0", "", "0"),
     .status = FG_STATUS_FILE_FORMAT,
     .refused = "zero everywhere"},
    {.what = "all is missing",
     .file = PAIR("", "", COUNTED, "", "_*5 nan*15"),
     .status = FG_STATUS_FILE_FORMAT,
     .refused = "all 20 samples of 'v' are missing (5 fill values, 0 outside the valid "
                "range, 15 not a number)"},
    {.what = "a mask along x, y",
     .file = PAIR("float ", "", COUNTED, "",
                  COUNTED) "byte sea(x,y) = 1*11 0 1*8; byte line(x) = 1",
     .options = {.mask = "sea"},
     .field = "u = 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 nan 19 20\n"},
    {.what = "a mask that is not there",
     .options = {.mask = "land"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "'land'"},
    {.what = "a mask along x alone",
     .options = {.mask = "line"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "'line'"},
};

SITUATIONS_MAIN("read/netcdf/stored", SITUATIONS)
