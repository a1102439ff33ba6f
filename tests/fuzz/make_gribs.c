#include "make_corpus.h"

#include "read/grib/grib_example.h"

/* Sines on the grid of one of ecCodes' samples, as the wind's components. */
static void make_grib(const char *name, const char *sample, const char *packing,
                      bool bitmap)
{
  remove(name);
  for (int k = 0; k < 2; ++k) {
    codes_handle *handle = codes_grib_handle_new_from_samples(NULL, sample);
    size_t count = 0, length = strlen(packing);
    codes_must(codes_get_size(handle, "values", &count), sample);
    double *values = calloc(count, sizeof *values);
    for (size_t n = 0; n < count; ++n)
      values[n] = bitmap && n % 7 == 0 ? 9999.0 : 10.0 * sin(0.05 * (double)n + k);
    grib_set(handle, strstr(sample, "grib1")
                         ? (k ? "table2Version=2,indicatorOfParameter=34"
                              : "table2Version=2,indicatorOfParameter=33")
                         : (k ? "parameterCategory=2,parameterNumber=3"
                              : "parameterCategory=2,parameterNumber=2"));
    if (strncmp(sample, "polar", 5) == 0)
      grib_set(handle, "DxInMetres=100000,DyInMetres=100000");
    codes_must(codes_set_long(handle, "bitmapPresent", bitmap), sample);
    codes_must(codes_set_double_array(handle, "values", values, count), sample);
    codes_must(codes_set_long(handle, "bitsPerValue", 12), sample);
    codes_must(codes_set_string(handle, "packingType", packing, &length), sample);
    codes_must(codes_set_double_array(handle, "values", values, count), sample);
    codes_must(codes_write_message(handle, name, "a"), name);
    codes_handle_delete(handle);
    free(values);
  }
}

/* A seed with a byte changed, counted from its end where negative. */
static void make_damaged_grib(const char *name, const char *seed, long at, int byte)
{
  unsigned char bytes[1 << 15];
  FILE *file = fopen(seed, "rb");
  if (!file)
    abort();
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  bytes[at < 0 ? (long)size + at : at] = (unsigned char)byte;
  store(name, bytes, size);
}

void make_gribs(void)
{
  make_grib("grib/seed-simple.grb", "regular_ll_pl_grib2", "grid_simple", false);
  make_grib("grib/seed-ccsds.grb", "regular_ll_pl_grib2", "grid_ccsds", false);
  make_grib("grib/seed-jpeg.grb", "regular_ll_pl_grib2", "grid_jpeg", false);
  make_grib("grib/seed-complex.grb", "regular_ll_pl_grib2", "grid_complex", false);
  make_grib("grib/seed-bitmap.grb", "regular_ll_pl_grib1", "grid_simple", true);
  make_grib("grib/seed-second-order.grb", "regular_ll_pl_grib1", "grid_second_order",
            false);
  make_grib("grib/seed-rotated.grb", "rotated_ll_pl_grib2", "grid_simple", false);
  make_grib("grib/seed-plane.grb", "polar_stereographic_pl_grib1", "grid_simple", false);
  make_damaged_grib("grib/fault-edition.grb", "grib/seed-simple.grb", 7, 3);
  make_damaged_grib("grib/fault-unit-of-time.grb", "grib/seed-bitmap.grb", 8 + 17, 200);
  make_damaged_grib("grib/fault-end.grb", "grib/seed-simple.grb", -1, '8');
  make_damaged_grib("grib/fault-points.grb", "grib/seed-simple.grb", 16 + 21 + 6, 255);
}
