/* Dates as text, as WRF, FVCOM and MPAS write them. */
#include "read/netcdf/situation_test.h"

#define PLANE "y[4] :units=km = -3 -1 .5 .75; x[5] :units=km = 1.5 2 4 4.5 7;"
#define PAIR "float u(Time,y,x) ~ 1 Time 1; float v(Time,y,x) ~ 1 Time 1;"
#define DATED(dates) "Time[*3]; DateStrLen[27];" PLANE dates ";" PAIR
#define LETTERS(name, dates) DATED("char " name "(Time,DateStrLen) = " dates)
#define STRINGS(name, dates) DATED("string " name "(Time) = " dates)

#define WRF "2010-07-15_12:00:00 & 2010-07-16_00:00:00 & 2010-07-16_00:00:30"
#define FVCOM "2010-07-15T12:00:00Z & 2010-07-16T00:00:00.000000 & 2010-07-16 00:00:30.5"
/* a date has neither a number nor units */
#define LISTED                                                                           \
  "times 3\n|time '2010-07-15 12:00' nan ''|time '2010-07-16' nan ''|time '2010-07-16 "  \
  "00:00:30' nan ''"
#define THREE(what_, mode_, text)                                                        \
  {.what = what_,                                                                        \
   .file = text,                                                                         \
   .mode = mode_,                                                                        \
   .field = "time '2010-07-15 12:00'|u = 1 ",                                            \
   .inventory = LISTED},                                                                 \
      {.what = what_, .options = {.time = 1}, .field = "time '2010-07-16'|u = 2 "},      \
  {                                                                                      \
    .what = what_, .options = {.time = 2}, .field = "time '2010-07-16 00:00:30'|u = 3 "  \
  }
#define EVERY(name)                                                                      \
  THREE(name ", classic", 0, LETTERS(name, WRF)),                                        \
      THREE(name ", classic, as FVCOM", 0, LETTERS(name, FVCOM)),                        \
      THREE(name ", letters", NC_NETCDF4, LETTERS(name, WRF)),                           \
      THREE(name ", strings", NC_NETCDF4, STRINGS(name, WRF)),                           \
      THREE(name ", strings, as FVCOM", NC_NETCDF4, STRINGS(name, FVCOM))
#define NO_DATE(text)                                                                    \
  {.what = "no date: " text,                                                             \
   .file = LETTERS("Times", "2010-07-15_12:00:00 & " text " & 2010-07-16_00:00:30"),     \
   .field = "time '2010-07-15 12:00'",                                                   \
   .inventory = "times 3\n|!time '"},                                                    \
  {                                                                                      \
    .what = "no date: " text, .options = {.time = 1}, .field = "time 'Time 1'|u = 2 "    \
  }
#define BESIDE(type, units)                                                              \
  LETTERS("Times", "2014-12-09T00:00:00 & 2014-12-09T01:00:00 & 2014-12-09T02:00:00")    \
  type "Time(Time) :units=" units " = 57000 57000.041666666664 57000.083333333336"

static const situation SITUATIONS[] = {
    EVERY("Times"),
    {.what = "dates without signs",
     .file = STRINGS("date", "20100715 & 2010071612 & 20100716T123030Z"),
     .mode = NC_NETCDF4,
     .field = "time '2010-07-15'",
     .inventory =
         "times 3\n|time '2010-07-15' nan ''|time '2010-07-16 12:00' nan ''|time "
         "'2010-07-16 12:30:30' nan ''"},
    NO_DATE("20101315"),
    NO_DATE("201007"),
    NO_DATE("20100715 125"),
    EVERY("xtime"),
    EVERY("Time"),
    EVERY("valid_time"),
    /* FVCOM's modified Julian days in single precision are minutes off */
    {.what = "texts go before days in float",
     .file = BESIDE("float ", "days since 1858-11-17"),
     .mode = NC_NETCDF4,
     .options = {.time = 1},
     .field = "time '2014-12-09 01:00'|u = 2 "},
    {.what = "exact days go before texts",
     .file = BESIDE("", "days since 1858-11-17 00:30"),
     .mode = NC_NETCDF4,
     .options = {.time = 1},
     .field = "time '2014-12-09 01:30'|u = 2 "},
    NO_DATE(""),
    NO_DATE("yesterday"),
    NO_DATE("2010-13-15_12:00:00"),
    NO_DATE("2010-07-32_12:00:00"),
    NO_DATE("2010-07-15_24:00:00"),
    NO_DATE("2010-07-15_12:61:00"),
    NO_DATE("2010-07-15_12:00:00 noon"),
    NO_DATE("----------"),
    /* The steps of a forecast (cfgrib) have dates beside them; the levels of a reanalysis
     * are air pressure, whose first is read. */
    {.what = "dates beside steps",
     .file = "step[2] :units=hours = 0 6; level[3] :units=millibar :positive=down = 1000 "
             "500 250;" PLANE "valid_time(step) :units=hours since 2024-05-01 = 0 6; "
             "float u(step,level,y,x) ~ 1 step 1; float v(step,level,y,x) ~ 1 step 1",
     .options = {.time = 1},
     .field = "time '2024-05-01 06:00'|u = 2 ",
     .inventory = "usual level 0\n"},
};

SITUATIONS_MAIN("read/netcdf/date_texts", SITUATIONS)
