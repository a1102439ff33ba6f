/* Small GRIB files for the tests of the reader, made with ecCodes: an analytic flow at
 * the latitudes and longitudes that ecCodes says of each point. */
#ifndef FG__GRIB_SAMPLE_H
#define FG__GRIB_SAMPLE_H

#include <eccodes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "read/slabs_alike_test.h"

typedef struct grib_file {
  char folder[64];
  char path[96];
  char other[96];
  fg_context *context;
} grib_file;

static inline int grib_set_up(void **state)
{
  grib_file *f = calloc(1, sizeof *f);
  if (!f)
    return 1;
  strcpy(f->folder, "/tmp/flowgrain-grib-XXXXXX");
  if (!mkdtemp(f->folder) || fg_context_create(&f->context) != FG_STATUS_OK)
    return 1;
  snprintf(f->path, sizeof f->path, "%s/sample.grb", f->folder);
  snprintf(f->other, sizeof f->other, "%s/other.grb", f->folder);
  *state = f;
  return 0;
}

static inline int grib_tear_down(void **state)
{
  grib_file *f = *state;
  unlink(f->path);
  unlink(f->other);
  rmdir(f->folder);
  fg_context_destroy(f->context);
  free(f);
  return 0;
}

static inline void codes_must(int error, const char *what)
{
  if (error)
    fail_msg("ecCodes: %s: %s", what, codes_get_error_message(error));
}

/* Keys as grib_set takes them: "Ni=16,Nj=9,shortName=u". */
static inline void grib_set(codes_handle *handle, const char *keys)
{
  char text[1024];
  snprintf(text, sizeof text, "%s", keys);
  for (char *key = strtok(text, ","); key; key = strtok(NULL, ",")) {
    char *value = strchr(key, '=');
    assert_non_null(value);
    *value++ = '\0';
    size_t length = strlen(value);
    if (strspn(value, "-0123456789") == length)
      codes_must(codes_set_long(handle, key, atol(value)), key);
    else if (strspn(value, "-0123456789.") == length)
      codes_must(codes_set_double(handle, key, atof(value)), key);
    else
      codes_must(codes_set_string(handle, key, value, &length), key);
  }
}

/* Smooth all over the sphere: the horizontal parts of two constant vectors in space, one
 * for each component's use. */
static inline void flow_at(double longitude, double latitude, double *east, double *north)
{
  static const double w[3] = {7.0, -4.0, 11.0};
  const double degree = acos(-1.0) / 180.0;
  const double l = longitude * degree, p = latitude * degree;
  *east = -w[0] * sin(l) + w[1] * cos(l);
  *north = -w[0] * sin(p) * cos(l) - w[1] * sin(p) * sin(l) + w[2] * cos(p);
}

/* The sphere spins about an axis through `south`, longitude and latitude of its own south
 * pole: east and north at a place. Along parallels about that pole it has the length that
 * is returned. */
static inline double spin_at(const double south[2], double longitude, double latitude,
                             double *east, double *north)
{
  const double degree = acos(-1.0) / 180.0;
  const double l = (longitude - south[0]) * degree, p = latitude * degree;
  const double pole = south[1] * degree;
  *east = -10.0 * (sin(pole) * cos(p) - cos(pole) * sin(p) * cos(l));
  *north = 10.0 * cos(pole) * sin(l) * -1.0;
  return hypot(*east, *north);
}

/* Turns every other run of values: ecCodes says the places of a longitude-latitude grid
 * as if it had not alternating rows. */
static inline void grib_alternate(double *values, size_t count, size_t run)
{
  for (size_t first = run; first + run <= count; first += 2 * run)
    for (size_t n = 0; n < run / 2; ++n) {
      const double swapped = values[first + n];
      values[first + n] = values[first + run - 1 - n];
      values[first + run - 1 - n] = swapped;
    }
}

/* Values of a component at each of a message's points, in its order. run: how many before
 * they turn, 0 never. south: NULL, or of the spin, whose components are along the grid.
 */
static inline double *grib_flow(size_t *count, codes_handle *handle, int component,
                                size_t run, const double *south)
{
  int error = 0;
  long all = 0;
  double latitude, longitude, old;
  codes_must(codes_get_long(handle, "numberOfDataPoints", &all), "points");
  *count = (size_t)all;
  double *values = calloc(*count, sizeof *values);
  values[0] = 1.0;
  codes_must(codes_set_double_array(handle, "values", values, *count), "values");
  codes_iterator *points = codes_grib_iterator_new(handle, 0, &error);
  codes_must(error, "iterator");
  for (size_t n = 0; codes_grib_iterator_next(points, &latitude, &longitude, &old); ++n) {
    double vector[2];
    flow_at(longitude, latitude, &vector[0], &vector[1]);
    if (south) {
      vector[0] = spin_at(south, longitude, latitude, &vector[0], &vector[1]);
      vector[1] = 0.0;
    }
    values[n] = vector[component];
  }
  codes_grib_iterator_delete(points);
  if (run > 0)
    grib_alternate(values, *count, run);
  return values;
}

/* Adds the flow's components to a file: messages of a sample with such a grid, packed so,
 * and the parameters u and v. */
static inline void grib_add(const grib_file *f, const char *sample, const char *grid,
                            size_t run, const char *packing, const char *u, const char *v,
                            const double *south)
{
  for (int k = 0; k < 2; ++k) {
    size_t count;
    codes_handle *handle = codes_grib_handle_new_from_samples(NULL, sample);
    assert_non_null(handle);
    grib_set(handle, grid);
    double *values = grib_flow(&count, handle, k, run, south);
    grib_set(handle, packing);
    grib_set(handle, k ? v : u);
    codes_must(codes_set_double_array(handle, "values", values, count), "values");
    codes_must(codes_write_message(handle, f->path, "a"), f->path);
    codes_handle_delete(handle);
    free(values);
  }
}

static inline fg_field *grib_read_whole(grib_file *f, const fg_read_options *options)
{
  fg_field *field = NULL;
  if (fg_field_read(&field, f->context, f->path, options) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  return field;
}

/* And by slabs. */
static inline fg_field *grib_read(grib_file *f, const fg_read_options *options)
{
  static const fg_read_options none = {0};
  fg_field *field = grib_read_whole(f, options);
  fg__source source;
  if (fg__source_open(&source, NULL, f->path) == FG_STATUS_OK)
    assert_slabs_alike(&fg__format_grib, &source, options ? options : &none, field);
  fg__source_close(&source, NULL, FG_STATUS_OK);
  return field;
}

static inline void grib_refuse(grib_file *f, const fg_read_options *options,
                               fg_status status, const char *words)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, options), status);
  assert_null(field);
  const char *message = fg_context_message(f->context);
  if (!strstr(message, words) || strncmp(message, f->path, strlen(f->path)) != 0)
    fail_msg("\"%s\" lacks \"%s\" or the file's name", message, words);
}

#endif
