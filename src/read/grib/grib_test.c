#include "read/grib/sample.h"

static const char U[] = "indicatorOfParameter=33,table2Version=2",
                  V[] = "indicatorOfParameter=34,table2Version=2",
                  WIND_U[] = "parameterCategory=2,parameterNumber=2",
                  WIND_V[] = "parameterCategory=2,parameterNumber=3";

/* Each sample of a field on a longitude-latitude grid has the flow of its place. */
static void assert_flow(const fg_field *field, double tolerance)
{
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->scale, FG_SCALE_GEO);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const size_t n = (size_t)j * (size_t)a->size[0] + (size_t)i;
      double east, north;
      flow_at(a->axis[0][i], a->axis[1][j], &east, &north);
      if (fabs((double)a->velocity[0][n] - east) > tolerance ||
          fabs((double)a->velocity[1][n] - north) > tolerance)
        fail_msg("at %g, %g: %g, %g instead of %g, %g", a->axis[0][i], a->axis[1][j],
                 (double)a->velocity[0][n], (double)a->velocity[1][n], east, north);
    }
}

/* All orders of scanning, and packings, of edition 2. */
static void a_longitude_latitude_grid(void **state)
{
  grib_file *f = *state;
  static const char *const packings[] = {"grid_simple", "grid_ccsds",
                                         "grid_jpeg",   "grid_png",
                                         "grid_ieee",   "grid_second_order"};
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
    grib_add(f, "regular_ll_pl_grib2", keys, run, packing, WIND_U, WIND_V);
    fg_field *field = grib_read(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], 12);
    assert_int_equal(a->size[1], 7);
    assert_true(a->period[0] == 0.0);
    assert_flow(field, 1e-3);
    fg_field_destroy(field);
  }
}

static void a_gaussian_grid(void **state)
{
  grib_file *f = *state;
  for (int edition = 1; edition <= 2; ++edition) {
    unlink(f->path);
    if (edition == 1)
      grib_add(f, "regular_gg_pl_grib1", "", 0, "bitsPerValue=20", U, V);
    else
      grib_add(f, "regular_gg_pl_grib2", "", 0, "bitsPerValue=8,packingType=grid_png",
               WIND_U, WIND_V);
    fg_field *field = grib_read(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_true(a->period[0] == 360.0);
    assert_int_equal(a->size[0], 128);
    assert_int_equal(a->size[1], 64);
    assert_flow(field, edition == 1 ? 1e-4 : 0.1);
    fg_field_destroy(field);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, grib_set_up, grib_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_longitude_latitude_grid),
      CASE(a_gaussian_grid),
  };
  return cmocka_run_group_tests_name("read/grib", tests, NULL, NULL);
}
