#include "decode/signature.h"
#include "read/grib/grib_example.h"

static const char U[] = "indicatorOfParameter=33,table2Version=2",
                  V[] = "indicatorOfParameter=34,table2Version=2",
                  WIND_U[] = "parameterCategory=2,parameterNumber=2",
                  WIND_V[] = "parameterCategory=2,parameterNumber=3";

/* Each sample of a field on a longitude-latitude grid has the flow of its place, or the
 * spin. Returns how many are missing. */
static size_t assert_flow(const fg_field *field, const double *south, double tolerance)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t missing = 0;
  assert_int_equal(a->scale, FG_SCALE_GEO);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const size_t n = (size_t)j * (size_t)a->size[0] + (size_t)i;
      double east, north;
      if (isnan(a->velocity[0][n]) && ++missing)
        continue;
      if (south)
        spin_at(south, a->axis[0][i], a->axis[1][j], &east, &north);
      else
        flow_at(a->axis[0][i], a->axis[1][j], &east, &north);
      if (!(fabs((double)a->velocity[0][n] - east) <= tolerance &&
            fabs((double)a->velocity[1][n] - north) <= tolerance))
        fail_msg("at %g, %g: %g, %g instead of %g, %g", a->axis[0][i], a->axis[1][j],
                 (double)a->velocity[0][n], (double)a->velocity[1][n], east, north);
    }
  return missing;
}

/* All orders of scanning, and packings, of edition 2. */
static void a_longitude_latitude_grid(void **state)
{
  grib_file *f = *state;
  static const char *const packings[] = {"grid_simple", "grid_ccsds", "grid_jpeg",
                                         "grid_ieee", "grid_second_order"};
  for (int order = 0; order < 16; ++order) {
    char keys[512];
    const bool west = order & 1, north = order & 2;
    const size_t run = order < 8 ? 0 : order & 4 ? 7 : 12;
    unlink(f->path);
    snprintf(keys, sizeof keys,
             "Ni=12,Nj=7,numberOfDataPoints=84,longitudeOfFirstGridPointInDegrees=%s,"
             "longitudeOfLastGridPointInDegrees=%s,latitudeOfFirstGridPointInDegrees=%s,"
             "latitudeOfLastGridPointInDegrees=%s,iDirectionIncrementInDegrees=5,"
             "jDirectionIncrementInDegrees=10,iScansNegatively=%d,jScansPositively=%d,"
             "jPointsAreConsecutive=%d,alternativeRowScanning=%d",
             west ? "25" : "330", west ? "330" : "25", north ? "-20" : "40",
             north ? "40" : "-20", west, north, order >> 2 & 1, order >> 3);
    char packing[64];
    snprintf(packing, sizeof packing, "bitsPerValue=16,packingType=%s",
             packings[order % (int)(sizeof packings / sizeof *packings)]);
    grib_add(f, "regular_ll_pl_grib2", keys, run, packing, WIND_U, WIND_V, NULL);
    fg_field *field = grib_read(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], 12);
    assert_int_equal(a->size[1], 7);
    assert_true(a->period[0] == 0.0);
    assert_int_equal(assert_flow(field, NULL, 1e-3), 0);
    fg_field_destroy(field);
  }
}

static void a_gaussian_grid(void **state)
{
  grib_file *f = *state;
  grib_add(f, "regular_gg_pl_grib1", "", 0, "bitsPerValue=20", U, V, NULL);
  fg_field *field = grib_read(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->period[0] == 360.0);
  assert_int_equal(a->size[0], 128);
  assert_int_equal(a->size[1], 64);
  assert_int_equal(assert_flow(field, NULL, 1e-4), 0);
  fg_field_destroy(field);
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_true(fg_inventory_vector_at(inventory, 0)->periodic[0]);
  fg_inventory_destroy(inventory);
}

/* Sampled on the sphere by triangles between rows, or cells of a grid with another pole.
 * ecCodes says the places of rotated Gaussian grids as if they were not. */
static void grids_on_the_sphere(void **state)
{
  static const double south[2] = {15.0, -40.0}, own[2] = {0.0, -90.0};
  static const struct {
    const char *sample, *u, *v;
    const double *filled, *expected;
    size_t missing;
  } cases[] = {
      {"reduced_gg_pl_32_grib2", WIND_U, WIND_V, NULL, NULL, 0},
      {"rotated_ll_pl_grib2", WIND_U, WIND_V, NULL, NULL, 1000},
      {"rotated_ll_pl_grib2", WIND_U, WIND_V, south, south, 1000},
      {"reduced_rotated_gg_pl_32_grib1", U, V, own, south, 0},
  };
  grib_file *f = *state;
  for (int k = 0; k < 4; ++k) {
    unlink(f->path);
    grib_add(f, cases[k].sample,
             k == 0   ? ""
             : k == 1 ? "latitudeOfSouthernPoleInDegrees=-40,"
                        "longitudeOfSouthernPoleInDegrees=15,uvRelativeToGrid=0"
                      : "latitudeOfSouthernPoleInDegrees=-40,"
                        "longitudeOfSouthernPoleInDegrees=15,uvRelativeToGrid=1",
             0, "bitsPerValue=20", cases[k].u, cases[k].v, cases[k].filled);
    fg_field *field = grib_read_whole(f, NULL);
    assert_in_range(assert_flow(field, cases[k].expected, 0.06), 0, cases[k].missing);
    fg_field_destroy(field);
  }
}

enum { COLUMNS = 21, ROWS = 16, POINTS = COLUMNS * ROWS };

/* Where ecCodes says the points of a file's first message are. */
static void read_places(const grib_file *f, double *longitude, double *latitude)
{
  int error = 0;
  size_t count = POINTS;
  FILE *stream = fopen(f->path, "rb");
  codes_handle *handle = codes_grib_handle_new_from_file(NULL, stream, &error);
  codes_must(error, f->path);
  codes_must(codes_get_double_array(handle, "longitudes", longitude, &count), "places");
  codes_must(codes_get_double_array(handle, "latitudes", latitude, &count), "places");
  assert_int_equal(count, POINTS);
  codes_handle_delete(handle);
  fclose(stream);
}

/* The length of a step between points, and the flow's component along it. */
static double along(const double *longitude, const double *latitude, size_t from,
                    size_t to, double *length)
{
  const double degree = acos(-1.0) / 180.0;
  const double middle = 0.5 * (latitude[from] + latitude[to]);
  const double turn = remainder(longitude[to] - longitude[from], 360.0);
  const double east = turn * cos(middle * degree), north = latitude[to] - latitude[from];
  double flow[2];
  flow_at(longitude[from] + 0.5 * turn, middle, &flow[0], &flow[1]);
  *length = hypot(east, north) * degree;
  return (flow[0] * east + flow[1] * north) / hypot(east, north);
}

/* Components are along the plane's axes, steps between points as long as the projection
 * makes all lengths near them. */
static void assert_plane(const grib_file *f, const fg_field *field, bool relative)
{
  const fg_field_arrays *a = fg_field_contents(field);
  double longitude[POINTS], latitude[POINTS];
  assert_int_equal(a->scale, FG_SCALE_MAP);
  assert_int_equal(a->size[0] * a->size[1], POINTS);
  read_places(f, longitude, latitude);
  for (size_t j = 1; j + 1 < ROWS; ++j)
    for (size_t i = 1; i + 1 < COLUMNS; ++i) {
      const size_t n = j * COLUMNS + i;
      double flow[2], step[2];
      double x = along(longitude, latitude, n - 1, n + 1, &step[0]);
      double y = along(longitude, latitude, n - COLUMNS, n + COLUMNS, &step[1]);
      flow_at(longitude[n], latitude[n], &flow[0], &flow[1]);
      if (relative)
        x = flow[0], y = flow[1];
      assert_true(fabs((double)a->velocity[0][n] - x) < 0.05);
      assert_true(fabs((double)a->velocity[1][n] - y) < 0.05);
      assert_true(fabs(step[0] / step[1] - 1.0) < 0.01);
      assert_true(fabs(a->axis[0][i + 1] - a->axis[0][i] - 100000.0) < 1e-3);
      assert_true(fabs(a->axis[1][j + 1] - a->axis[1][j] - 100000.0) < 1e-3);
    }
}

/* The first point's coordinates are what PROJ makes of its longitude and latitude. Of
 * southern cones and the oblate Earth ecCodes does not say points rightly, or not at all.
 */
static void projected_grids(void **state)
{
  static const char north_cone[] =
      "gridType=lambert,latitudeOfFirstGridPointInDegrees=30,"
      "longitudeOfFirstGridPointInDegrees=350,LoVInDegrees=10,LaDInDegrees=45,"
      "Latin1InDegrees=40,Latin2InDegrees=50,shapeOfTheEarth=6";
  static const struct {
    const char *grid, *packing, *projection;
    double first[2];
    bool first_only;
  } cases[] = {
      {north_cone,
       "bitsPerValue=20",
       "+proj=lcc +lat_0=45 +lon_0=10 +lat_1=40 +lat_2=50 +R=6371229 +units=m",
       {-1961707.198, -1436429.762},
       false},
      {north_cone,
       "bitsPerValue=20,shapeOfTheEarth=5",
       "+proj=lcc +lat_0=45 +lon_0=10 +lat_1=40 +lat_2=50 +a=6378137 +b=6356752.314 "
       "+units=m",
       {-1965226.721, -1432748.077},
       true},
      {"gridType=lambert,latitudeOfFirstGridPointInDegrees=-50,"
       "longitudeOfFirstGridPointInDegrees=130,LoVInDegrees=140,LaDInDegrees=-40,"
       "Latin1InDegrees=-40,Latin2InDegrees=-40,shapeOfTheEarth=6",
       "bitsPerValue=20",
       "+proj=lcc +lat_0=-40 +lon_0=140 +lat_1=-40 +lat_2=-40 +R=6371229 +units=m",
       {-724894.688, -1158614.926},
       true},
      {"gridType=polar_stereographic,latitudeOfFirstGridPointInDegrees=60,"
       "longitudeOfFirstGridPointInDegrees=300,orientationOfTheGridInDegrees=340,"
       "LaDInDegrees=60,southPoleOnProjectionPlane=0,shapeOfTheEarth=6",
       "bitsPerValue=20",
       "+proj=stere +lat_0=90 +lon_0=340 +lat_ts=60 +R=6371229 +units=m",
       {-2047673.53, -2440322.286},
       false},
      {"gridType=polar_stereographic,latitudeOfFirstGridPointInDegrees=-60,"
       "longitudeOfFirstGridPointInDegrees=300,orientationOfTheGridInDegrees=0,"
       "LaDInDegrees=-60,southPoleOnProjectionPlane=1,shapeOfTheEarth=6",
       "bitsPerValue=20",
       "+proj=stere +lat_0=-90 +lon_0=0 +lat_ts=-60 +R=6371229 +units=m",
       {-2758823.084, 1592807.25},
       false},
      {"gridType=mercator,latitudeOfFirstGridPointInDegrees=-10,"
       "longitudeOfFirstGridPointInDegrees=350,LaDInDegrees=20,"
       "orientationOfTheGridInDegrees=0,shapeOfTheEarth=6",
       "bitsPerValue=20",
       "+proj=merc +lon_0=-0.4",
       {-1000000.0, -1050273.894},
       false},
  };
  grib_file *f = *state;
  for (size_t k = 0; k < 2 * sizeof cases / sizeof *cases; ++k) {
    const size_t c = k / 2;
    const bool relative = k % 2;
    char grid[512];
    snprintf(grid, sizeof grid,
             "%s,Ni=21,Nj=16,numberOfDataPoints=336,DxInMetres=100000,DyInMetres=100000,"
             "iScansNegatively=0,jScansPositively=1,resolutionAndComponentFlags=%d",
             cases[c].grid, relative ? 8 : 0);
    unlink(f->path);
    grib_add(f, "regular_ll_pl_grib2", grid, 0, cases[c].packing, WIND_U, WIND_V, NULL);
    fg_field *field = grib_read(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_memory_equal(a->projection, cases[c].projection, strlen(cases[c].projection));
    for (int axis = 0; axis < 2; ++axis)
      assert_true(fabs(a->axis[axis][0] - cases[c].first[axis]) < 2e-3);
    if (!cases[c].first_only)
      assert_plane(f, field, relative);
    fg_field_destroy(field);
  }
}

/* A file of `count` bytes of another. */
static void cut_file(const grib_file *f, size_t count)
{
  char bytes[1 << 16];
  FILE *stream = fopen(f->path, "rb");
  assert_in_range(fread(bytes, 1, sizeof bytes, stream), count, sizeof bytes - 1);
  fclose(stream);
  stream = fopen(f->path, "wb");
  assert_int_equal(fwrite(bytes, 1, count, stream), count);
  fclose(stream);
}

/* Two levels at two times, of which one level is there once; and another parameter. */
static void times_and_levels(void **state)
{
  grib_file *f = *state;
  static const char *const places[] = {"dataDate=20140201,level=500",
                                       "dataDate=20140131,level=500",
                                       "dataDate=20140201,level=300"};
  for (int k = 0; k < 3; ++k) {
    char u[128], v[128];
    snprintf(u, sizeof u, "%s,%s", WIND_U, places[k]);
    snprintf(v, sizeof v, "%s,%s", WIND_V, places[k]);
    grib_add(f, "regular_ll_pl_grib2", "dataTime=600", 0, "bitsPerValue=16", u, v, NULL);
  }
  grib_add(f, "regular_ll_sfc_grib2", "", 0, "bitsPerValue=16",
           "typeOfLevel=heightAboveGround,level=10,parameterCategory=2,parameterNumber=2",
           "typeOfLevel=heightAboveGround,level=10,parameterCategory=2,parameterNumber=3",
           NULL);
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 2);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(vector->name[0], "u");
  assert_int_equal(vector->times, 2);
  assert_int_equal(vector->levels, 2);
  assert_string_equal(vector->time_value[0].words, "2014-01-31 06:00");
  assert_string_equal(vector->level_value[1].words, "500 hPa");
  assert_string_equal(fg_inventory_vector_at(inventory, 1)->name[0], "10u");
  fg_inventory_destroy(inventory);
  grib_refuse(f, NULL, FG_STATUS_ARGUMENT, "u,v; 10u,10v");
  grib_refuse(f, &(fg_read_options){.vars = "u,v"}, FG_STATUS_ARGUMENT,
              "at time 0 (2014-01-31 06:00) and level 0 (300 hPa)");
  grib_refuse(f, &(fg_read_options){.vars = "u,w"}, FG_STATUS_ARGUMENT,
              "has no variable 'w'");
  grib_refuse(f, &(fg_read_options){.vars = "u"}, FG_STATUS_ARGUMENT,
              "'u' is one variable, and a velocity has two or three components");
  fg_field *field = grib_read(f, &(fg_read_options){.vars = "u,v", .time = 1});
  assert_string_equal(fg_field_contents(field)->level, "300 hPa");
  assert_string_equal(fg_field_contents(field)->time, "2014-02-01 06:00");
  fg_field_destroy(field);
  field = grib_read(f, &(fg_read_options){.vars = "u10,v10"});
  assert_string_equal(fg_field_contents(field)->velocity_name[0], "10u");
  assert_string_equal(fg_field_contents(field)->velocity_units, "m/s");
  fg_field_destroy(field);
}

/* Two forecasts of one time are told apart by when they began. */
static void forecasts_of_one_time(void **state)
{
  static const char *const starts[] = {"dataDate=20140131,endStep=36",
                                       "dataDate=20140201,endStep=12"};
  grib_file *f = *state;
  fg_inventory *inventory = NULL;
  for (int k = 1; k >= 0; --k)
    grib_add(f, "regular_ll_pl_grib2", starts[k], 0, "bitsPerValue=16", WIND_U, WIND_V,
             NULL);
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  assert_int_equal(vector->times, 2);
  assert_string_equal(vector->time_value[0].words, "2014-02-02 from 2014-01-31 12:00");
  assert_string_equal(vector->time_value[1].words, "2014-02-02 from 2014-02-01 12:00");
  fg_inventory_destroy(inventory);
  fg_field *field = grib_read(f, &(fg_read_options){.time = 1});
  assert_string_equal(fg_field_contents(field)->time, "2014-02-02 from 2014-02-01 12:00");
  fg_field_destroy(field);
}

/* Members of an ensemble are along a dimension of their own. */
static void one_member_is_read(void **state)
{
  grib_file *f = *state;
  for (int k = 1; k <= 3; ++k) {
    char member[128];
    snprintf(member, sizeof member,
             "productDefinitionTemplateNumber=1,numberOfForecastsInEnsemble=3,"
             "perturbationNumber=%d,bitmapPresent=%d",
             4 - k, k == 2);
    grib_add(f, "regular_ll_pl_grib2", member, 0, "bitsPerValue=16", WIND_U, WIND_V,
             NULL);
  }
  grib_refuse(f, NULL, FG_STATUS_UNSUPPORTED,
              "dimension 'number' of 3 samples is neither time nor level");
  assert_string_equal(fg_context_hint(f->context),
                      "--at number=WHICH reads one of them: 1, 2, 3");
  fg_field *field = grib_read(f, &(fg_read_options){.at = "number=2"});
  assert_string_equal(fg_field_contents(field)->level, "850 hPa, number 2");
  assert_int_equal(assert_flow(field, NULL, 1e-3), 0);
  fg_field_destroy(field);
}

static void fields_without_a_pair_are_named(void **state)
{
  grib_file *f = *state;
  static const char w[] = "parameterCategory=2,parameterNumber=8,level=500";
  for (int k = 0; k < 2; ++k)
    grib_add(f, "regular_ll_pl_grib2", k ? "dataTime=600" : "", 0, "bitsPerValue=16",
             WIND_U, w, NULL);
  grib_refuse(f, NULL, FG_STATUS_UNSUPPORTED,
              "no vectors found among its 7 variables: u, w, longitude");
}

/* A heading of `size` bytes before the messages: bytes of `text` over and over. */
static void put_heading(const grib_file *f, const char *text, size_t size)
{
  static unsigned char bytes[1 << 16];
  FILE *stream = fopen(f->path, "rb");
  const size_t messages = fread(bytes + size, 1, sizeof bytes - size, stream);
  fclose(stream);
  for (size_t n = 0; n < size; ++n)
    bytes[n] = (unsigned char)text[n % strlen(text)];
  stream = fopen(f->path, "wb");
  fwrite(bytes, 1, size + messages, stream);
  assert_int_equal(fclose(stream), 0);
}

/* Of bulletins in ASCII and in EBCDIC, of archives; with the letters in it, too. */
static void headings_are_skipped(void **state)
{
  static const struct {
    const char *text;
    size_t size;
    bool found;
  } rows[] = {
      {"\001\r\r\n024\r\r\nHTXA99 KWBC 130000\r\r\n", 33, true},
      {"\xC8\xE3\xE7\xC1\xF9\xF9\x40\xD2\xE6\xC2\xC3\x40\xF1\xF3", 42, true},
      {"\xC8\xE3\xE7\xC1\xF9\xF9\x40\xD2\xE6\xC2\xC3\x40\xF1\xF3", 3000, true},
      {"ETA MODEL, GRIB EDITION 1; ", 1500, true},
      {"GRIB\xff\xff\xff\007", 400, false}, /* edition 7 at the first byte */
      {"\xC7\xD9\xC9\xC2", 16383, true},
      {"\xC7\xD9\x02\xC2", 16384, false},
  };
  grib_file *f = *state;
  for (size_t n = 0; n < 2 * sizeof rows / sizeof *rows; ++n) {
    unlink(f->path);
    grib_add(f, n % 2 ? "regular_ll_pl_grib1" : "regular_ll_pl_grib2", "", 0,
             "bitsPerValue=16", n % 2 ? U : WIND_U, n % 2 ? V : WIND_V, NULL);
    put_heading(f, rows[n / 2].text, rows[n / 2].size);
    if (rows[n / 2].found)
      fg_field_destroy(grib_read(f, NULL));
    else
      grib_refuse(f, NULL,
                  rows[n / 2].size == 400 ? FG_STATUS_UNSUPPORTED : FG_STATUS_FILE_FORMAT,
                  rows[n / 2].size == 400 ? "edition 7" : "unknown format");
  }
}

/* Letters alone are no message. */
static void what_only_names_grib_is_none(void **state)
{
  static const char *const texts[] = {"# of a GRIB file\nx,y,u,v\n1,1,1,1\n",
                                      "\xff GRIB\001\001\001\003 and no length",
                                      "\xff GRIB\001\001\001\002 and \001 no length"};
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n)
    assert_false(fg__is_grib((const unsigned char *)texts[n], strlen(texts[n])));
  static const unsigned char short_1[24] = "\xff GRIB\0\0\062\001",
                             short_2[24] = "\xff GRIB\0\0\0\002\0\0\0\0\0\0\0\050";
  assert_false(fg__is_grib(short_1, sizeof short_1));
  assert_false(fg__is_grib(short_2, sizeof short_2));
  (void)state;
}

/* Both components in one message; and without its last bytes, or those between. */
static void a_message_of_two_fields(void **state)
{
  grib_file *f = *state;
  unsigned char bytes[1 << 15];
  grib_add(f, "regular_ll_pl_grib2", "", 0, "bitsPerValue=16", WIND_U, WIND_V, NULL);
  FILE *stream = fopen(f->path, "rb");
  const size_t size = fread(bytes, 1, sizeof bytes, stream);
  fclose(stream);
  const size_t one = (size_t)bytes[14] * 256 + bytes[15];
  assert_int_equal(2 * one, size);
  size_t skipped = one + 16; /* the second message's sections 4 to 7 */
  while (bytes[skipped + 4] < 4)
    skipped += (size_t)bytes[skipped + 2] * 256 + bytes[skipped + 3];
  memmove(bytes + one - 4, bytes + skipped, size - skipped);
  const size_t joined = one - 4 + size - skipped;
  bytes[14] = (unsigned char)(joined / 256);
  bytes[15] = (unsigned char)(joined % 256);
  stream = fopen(f->path, "wb");
  assert_int_equal(fwrite(bytes, 1, joined, stream), joined);
  fclose(stream);
  fg_field *field = grib_read(f, NULL);
  assert_int_equal(assert_flow(field, NULL, 1e-3), 0);
  fg_field_destroy(field);
  cut_file(f, joined - 1);
  grib_refuse(f, NULL, FG_STATUS_FILE_FORMAT, "from byte 0 on");
}

/* A bitmap leaves out values; a mask leaves out more. */
static void missing_values(void **state)
{
  grib_file *f = *state;
  grib_add(f, "regular_ll_pl_grib1", "", 0, "bitsPerValue=16,bitmapPresent=1", U, V,
           NULL);
  FILE *stream = fopen(f->path, "rb");
  int error = 0;
  codes_handle *handle = codes_grib_handle_new_from_file(NULL, stream, &error);
  codes_must(error, f->path);
  fclose(stream);
  double values[16 * 31];
  size_t count = 16 * 31;
  codes_must(codes_get_double_array(handle, "values", values, &count), "values");
  values[5] = 9999.0;
  grib_set(handle, "indicatorOfParameter=49");
  codes_must(codes_set_double_array(handle, "values", values, count), "values");
  codes_must(codes_write_message(handle, f->path, "a"), f->path);
  grib_set(handle, "indicatorOfParameter=50");
  codes_must(codes_write_message(handle, f->path, "a"), f->path);
  for (size_t n = 0; n < count; ++n)
    values[n] = n < 100 ? 0.0 : 1.0;
  grib_set(handle, "indicatorOfParameter=81");
  codes_must(codes_set_double_array(handle, "values", values, count), "values");
  codes_must(codes_write_message(handle, f->path, "a"), f->path);
  codes_handle_delete(handle);
  for (int masked = 0; masked < 2; ++masked) {
    const fg_read_options options = {.vars = "ucurr,vcurr",
                                     .mask = masked ? "lsm" : NULL};
    size_t missing = 0;
    fg_field *field = grib_read(f, &options);
    for (size_t n = 0; n < count; ++n)
      missing += isnan(fg_field_contents(field)->velocity[0][n]) ? 1 : 0;
    assert_int_equal(missing, masked ? 100 : 1);
    fg_field_destroy(field);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, grib_set_up, grib_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_longitude_latitude_grid), CASE(a_gaussian_grid),
      CASE(grids_on_the_sphere),       CASE(projected_grids),
      CASE(times_and_levels),          CASE(fields_without_a_pair_are_named),
      CASE(headings_are_skipped),      CASE(what_only_names_grib_is_none),
      CASE(a_message_of_two_fields),   CASE(missing_values),
      CASE(forecasts_of_one_time),     CASE(one_member_is_read),
  };
  return cmocka_run_group_tests_name("read/grib", tests, NULL, NULL);
}
