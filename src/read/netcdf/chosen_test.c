/* Dimensions that are neither time nor level, of which one sample is chosen. */
#include "read/netcdf/situation_test.h"

#define PLANE "y[4] :units=km = -3 -1 .5 .75; x[5] :units=km = 1.5 2 4 4.5 7;"
/* time, member, version and level add 10, 1000, 10000 and 100 */
#define ENSEMBLE(chunks)                                                                 \
  "time[2]; member[3] :units=1 = 0 10 20; version[2]; lev[2] :units=hPa = 850 "          \
  "500;" PLANE "letters[3]; float u(time,member,version,lev,y,x)" chunks                 \
  " ~ 1 x 1 y 8 time 10 lev 100 member 1000 version 10000;"                              \
  "float v(time,member,version,lev,y,x)" chunks                                          \
  " ~ -2 x 1 y 8 time 10 lev 100 member 1000 version 10000"
#define CHUNKED ENSEMBLE(" :_Chunks=#1 2 2 1 4 5")
/* along one dimension the blocks begin with 1, 101, 201 */
#define BLOCKS(dimension, along, rest)                                                   \
  dimension ";" PLANE rest "float u(" along ",y,x) ~ 1 x 1 y 5 " along                   \
            " 100; float v(" along ",y,x) ~ 2 x 1 y 5 " along " 100"

#define CHOSEN(at_, level_, first)                                                       \
  {.what = at_,                                                                          \
   .file = ENSEMBLE(""),                                                                 \
   .options = {.at = at_, .time = 1, .level = 1},                                        \
   .field = "level '500 hPa, " level_ "'|u = " first " "},                               \
  {                                                                                      \
    .what = at_ " of chunks", .file = CHUNKED, .mode = NC_NETCDF4,                       \
    .options = {.at = at_, .time = 1, .level = 1},                                       \
    .field = "level '500 hPa, " level_ "'|u = " first " "                                \
  }
#define REFUSED(at_, words)                                                              \
  {                                                                                      \
    .what = at_, .options = {.at = at_}, .status = FG_STATUS_ARGUMENT, .refused = words  \
  }
#define UNSUPPORTED(at_, words)                                                          \
  {                                                                                      \
    .what = at_, .options = {.at = at_}, .refused = words                                \
  }
#define EXPVER BLOCKS("expver[2] = 1 5", "expver", "")

/* what is chosen leaves its part, such as time, to another dimension */
#define TAKING(first, second, third)                                                     \
  first "[*2]; " second "[2]; " third "[2];" PLANE "float u(" first "," second "," third \
        ",y,x) ~ 1 " first " 400 " second " 200 " third " 100 y 5 x 1; float v(" first   \
        "," second "," third ",y,x) ~ 1 " first " 400 " second " 200 " third             \
        " 100 y 5 x 1"
#define MEMBERS(members, values)                                                         \
  "time[2]; member[" members "] :units=1 = " values                                      \
  "; lev[2] :units=hPa = 850 500;" PLANE                                                 \
  "float u(time,member,lev,y,x); float v(time,member,lev,y,x)"

/* samples that have names: strings, or rows of letters, in Latin-1 */
#define NAMES " = historical & ssp\xB9 26 & ssp585;"
#define LABELLED(what_, labels)                                                          \
  {.what = what_,                                                                        \
   .file = BLOCKS("scenario[3]; letters[11]", "scenario", labels NAMES),                 \
   .mode = NC_NETCDF4,                                                                   \
   .options = {.at = "scenario=ssp585"},                                                 \
   .field = "level 'scenario ssp585'|u = 201 "},                                         \
      {.what = what_ ", by index",                                                       \
       .options = {.at = "scenario=1"},                                                  \
       .field = "level 'scenario ssp\xC2\xB9 26'|u = 101 "},                             \
  {                                                                                      \
    .what = what_ ", a name that is not there", .options = {.at = "scenario=ssp999"},    \
    .refused = "0 is historical, 2 is ssp585"                                            \
  }
#define TABLE "x,y,u,v\n0,0,1,1\n1,0,1,2\n0,1,1,3\n1,1,1,4\n"

static const situation SITUATIONS[] = {
    CHOSEN("member=0,version=0", "member 0, version 0", "111"),
    CHOSEN("version=1,member=2", "member 20, version 1", "12111"),
    CHOSEN("member=10.,version=1", "member 10, version 1", "11111"),
    {.what = "what is chosen is listed",
     .file = ENSEMBLE(""),
     .options = {.at = "version=1,member=20,time=0"},
     .inventory = "chosen 'member 20, version 1, time 0'|levels 2"},
    {.what = "a time and a level can be chosen so, too",
     .options = {.at = "time=1,lev=500hPa,member=1,version=0"},
     .field = "time 'time 1'|level 'member 10, version 0, 500 hPa'|u = 1111 "},
    {.what = "a dimension with another variable along it",
     .file = BLOCKS("expver[2]; weight(expver) = .5 .5", "expver", ""),
     .options = {.at = "expver=1"},
     .field = "level 'expver 1'|u = 101 "},
    {.what = "nothing is chosen",
     .file = ENSEMBLE(""),
     .refused = "dimension 'member' of 3 samples is neither time nor level",
     .hint = "--at member=WHICH reads one of them: 0, 10, 20"},
    {.what = "one of two is chosen",
     .options = {.at = "member=0"},
     .refused = "dimension 'version' of 2",
     .hint = "--at version=0 reads the first of them"},
    REFUSED("member", "'member' is no choice of"),
    REFUSED("member=", "'member=' is no choice of"),
    REFUSED("=2", "'=2' is no choice of"),
    REFUSED("member=0,", "'' is no choice of"),
    REFUSED("number=0", "has no dimension 'number'"),
    REFUSED("member=0, member=1", "of 'member' two samples are chosen"),
    UNSUPPORTED("member=3", "member 3 asked for, and there are 3"),
    REFUSED("member=0:1,version=0", "'member=0:1' are 2 samples"),
    REFUSED("member=all,version=0", "'member=all' are 3 samples"),
    REFUSED("member=0,version=0,letters=1", "'u' and 'v' have no dimension 'letters'"),
    UNSUPPORTED("member=0,version=0,x=1", "'u' points east, across the vertical section"),
    {.what = "an analytic field has no members",
     .path = "synth:saddle",
     .options = {.at = "member=1"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "has no variables"},
    /* a number that is a value is that one, else an index */
    {.what = "value 1 is number 0",
     .file = EXPVER,
     .options = {.at = "expver=1"},
     .field = "level 'expver 1'|u = 1 "},
    {.what = "value 5 is number 1",
     .options = {.at = "expver=5"},
     .field = "level 'expver 5'|u = 101 "},
    {.what = "0 is no value",
     .options = {.at = "expver=0"},
     .field = "level 'expver 1'|u = 1 "},
    REFUSED("expver=1.2", "'expver=1.2' is not there; the nearest is expver 1"),
    {.what = "two samples",
     .options = {.at = "expver=0:1"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "are 2 samples",
     .hint = "flowgrain draw"},
    {.what = "a record dimension is chosen, two others are time and level",
     .file = TAKING("number", "aa", "bb"),
     .mode = NC_NETCDF4,
     .options = {.at = "number=1", .time = 1},
     .field = "u = 501 "},
    {.what = "a time is chosen beside another",
     .file = TAKING("time", "step", "lev"),
     .mode = NC_NETCDF4,
     .options = {.at = "time=1", .time = 1},
     .field = "u = 601 "},
    {.what = "a further file's dimension with a single sample has it for all",
     .file = ENSEMBLE(""),
     .second = "member[1];" PLANE "float sea(member,y,x) = 0 1 1 1 1",
     .options = {.at = "member=2,version=0", .vars = "u,v", .mask = "sea"},
     .field = "u = nan 2002 2003 2004 2005 nan"},
    {.what = "a time among the components' coordinates is said once (ERA5)",
     .file = "valid_time[2] :units=hours since 2020-01-01 = 0 6;" PLANE
             "float u(valid_time,y,x) :coordinates=number valid_time = 0 1 2; "
             "float v(valid_time,y,x) :coordinates=number valid_time = 0 1 2",
     .options = {.at = "valid_time=1"},
     .field = "time '2020-01-01 06:00'"},
    {.what = "five samples are offered",
     .file = MEMBERS("5", "1 2 3 4 5"),
     .refused = "'member'",
     .hint = "--at member=WHICH reads one of them: 1, 2, 3, 4, 5"},
    {.what = "of seven samples the first ones and the last are offered",
     .file = MEMBERS("7", "1 2 3 4 5 6 9"),
     .refused = "'member'",
     .hint = "--at member=WHICH reads one of them: 1, 2, 3, 4, ..., 9"},
    LABELLED("strings", "string scenario(scenario)"),
    LABELLED("letters", "char scenario(scenario,letters)"),
    LABELLED("letters of another name", "char label(scenario,letters)"),
    /* readers without named dimensions say so */
    {.what = "a table has no dimensions",
     .text = TABLE,
     .options = {.at = "x=1"},
     .refused = "a sample of a named dimension",
     .inventory = "refused"},
    {.what = "a table has no mesh",
     .text = TABLE,
     .options = {.mesh_from = "mesh.nc"},
     .refused = "a file with the",
     .inventory = "refused"},
};

SITUATIONS_MAIN("read/netcdf/chosen", SITUATIONS)
