/* Files with the names, staggering and angles of ocean and weather models. All have the
 * same field, a linear map of space without its part upwards, which must be read to the
 * error of interpolation. */
#ifndef FG__MODEL_EXAMPLE_H
#define FG__MODEL_EXAMPLE_H

#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

#define RADIANS 0.017453292519943295

enum { COLUMNS = 26, ROWS = 22 };

static const double STEP = 2.0; /* degrees */
static const double TOLERANCE = 4e-3;
static const double FLOW[3][3] = {{0.9, -0.8, -0.4}, {0.7, -0.6, -0.5}, {0.3, 0.6, 0.2}};

static inline double dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The position of index (i, j), centres at whole numbers: a longitude-latitude grid about
 * a point of the equator, rotated to 100 degrees east, 62 north. Its corner is beyond the
 * pole, so that the antimeridian crosses it. */
static inline void place_of(double at[3], double i, double j)
{
  const double a = STEP * (i - 0.5 * COLUMNS) * RADIANS;
  const double b = STEP * (j - 0.5 * ROWS) * RADIANS;
  const double x = cos(b) * cos(a), y = cos(b) * sin(a), z = sin(b);
  const double tip = 62.0 * RADIANS, turn = 100.0 * RADIANS, spin = 0.5;
  const double p = cos(spin) * y - sin(spin) * z, q = sin(spin) * y + cos(spin) * z;
  const double r = cos(tip) * x - sin(tip) * q;
  at[0] = cos(turn) * r - sin(turn) * p;
  at[1] = sin(turn) * r + cos(turn) * p;
  at[2] = sin(tip) * x + cos(tip) * q;
}

static inline void degrees_of(double *longitude, double *latitude, const double at[3])
{
  *longitude = atan2(at[1], at[0]) / RADIANS;
  *latitude = asin(at[2]) / RADIANS;
}

/* Shear and strain: a linear map of space, projected to the tangent plane. */
static inline void flow_at(double w[3], const double at[3])
{
  for (int k = 0; k < 3; ++k)
    w[k] = dot(FLOW[k], at);
  const double up = dot(w, at);
  for (int k = 0; k < 3; ++k)
    w[k] -= up * at[k];
}

static inline void exact(double out[2], double longitude, double latitude)
{
  const double s = sin(longitude * RADIANS), c = cos(longitude * RADIANS);
  const double sine = sin(latitude * RADIANS), cosine = cos(latitude * RADIANS);
  const double at[3] = {cosine * c, cosine * s, sine};
  const double east[3] = {-s, c, 0.0}, north[3] = {-sine * c, -sine * s, cosine};
  double w[3];
  flow_at(w, at);
  out[0] = dot(w, east);
  out[1] = dot(w, north);
}

/* The angle of i from east. */
static inline double angle_at(double i, double j)
{
  double a[3], b[3], at[3], longitude, latitude;
  place_of(a, i - 0.01, j);
  place_of(b, i + 0.01, j);
  place_of(at, i, j);
  degrees_of(&longitude, &latitude, at);
  const double s = sin(longitude * RADIANS), c = cos(longitude * RADIANS);
  const double sine = sin(latitude * RADIANS), cosine = cos(latitude * RADIANS);
  const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double east[3] = {-s, c, 0.0}, north[3] = {-sine * c, -sine * s, cosine};
  return atan2(dot(d, north), dot(d, east));
}

typedef enum quantity {
  LONGITUDE,
  LATITUDE,
  ALONG_I,
  ALONG_J,
  EAST,
  NORTH,
  ANGLE,
  COSINE,
  SINE,
  OPPOSITE,
  SEA
} quantity;

static inline double value_of(quantity what, double i, double j)
{
  double at[3], longitude, latitude, flow[2];
  place_of(at, i, j);
  degrees_of(&longitude, &latitude, at);
  exact(flow, longitude, latitude);
  const double angle = angle_at(i, j);
  switch (what) {
  case LONGITUDE:
    return longitude;
  case LATITUDE:
    return latitude;
  case ALONG_I:
    return flow[0] * cos(angle) + flow[1] * sin(angle);
  case ALONG_J:
    return flow[1] * cos(angle) - flow[0] * sin(angle);
  case EAST:
  case NORTH:
    return flow[what == NORTH];
  case ANGLE:
    return angle;
  case COSINE:
    return cos(angle);
  case SINE:
    return sin(angle);
  case OPPOSITE:
    return -sin(angle);
  case SEA:
    return i < 6.0 ? 0.0 : 1.0;
  }
  return 0.0;
}

/* A variable of a model; its dimensions are defined at their first use. */
typedef struct model_variable {
  const char *name;
  quantity what;
  const char *row, *column;       /* dimensions */
  int more_rows, more_columns;    /* difference from the number of centres */
  double shift_row, shift_column; /* of sample 0 from centre 0 */
  const char *attributes[6];      /* name, value, ... */
} model_variable;

static inline int dimension_of(const sample_file *f, const char *name, size_t length)
{
  int id;
  if (nc_inq_dimid(f->id, name, &id) == NC_NOERR)
    return id;
  return sample_dimension(f, name, length);
}

/* level: a dimension of two levels, with the flow in the second and its opposite in the
 * first; NULL: none. */
static inline void write_variable(const sample_file *f, const model_variable *v,
                                  const char *level)
{
  const size_t rows = (size_t)(ROWS + v->more_rows);
  const size_t columns = (size_t)(COLUMNS + v->more_columns);
  const size_t plane = rows * columns, levels = level ? 2 : 1;
  const int dimensions[3] = {level ? dimension_of(f, level, levels) : -1,
                             dimension_of(f, v->row, rows),
                             dimension_of(f, v->column, columns)};
  const int id = level ? sample_variable(f, v->name, NC_DOUBLE, 3, dimensions)
                       : sample_variable(f, v->name, NC_DOUBLE, 2, dimensions + 1);
  double *values = malloc(levels * plane * sizeof *values);
  assert_non_null(values);
  for (int k = 0; k + 1 < 6 && v->attributes[k]; k += 2)
    sample_text(f, id, v->attributes[k], v->attributes[k + 1]);
  for (size_t n = 0; n < levels * plane; ++n)
    values[n] = (n / plane + 1 == levels ? 1.0 : -1.0) *
                value_of(v->what, (double)(n % columns) + v->shift_column,
                         (double)(n % plane / columns) + v->shift_row);
  sample_put(f, id, values);
  free(values);
}

static inline void write_model_at(sample_file *f, const model_variable *v,
                                  const char *level)
{
  sample_begin(f, NC_CLASSIC_MODEL);
  for (; v->name; ++v)
    write_variable(f, v, v->what > LATITUDE ? level : NULL);
  sample_end(f);
}

static inline void write_model(sample_file *f, const model_variable *v)
{
  write_model_at(f, v, NULL);
}

/* Asserts every sample; `least`: lower bound of the number of valid ones. */
static inline void assert_near(const fg_field *field, size_t least, double tolerance)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t found = 0;
  assert_int_equal(a->scale, FG_SCALE_GEO);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const size_t n = (size_t)j * (size_t)a->size[0] + (size_t)i;
      double expected[2];
      exact(expected, a->axis[0][i], a->axis[1][j]);
      if (isnan(a->velocity[0][n]))
        continue;
      ++found;
      if (hypot((double)a->velocity[0][n] - expected[0],
                (double)a->velocity[1][n] - expected[1]) > tolerance)
        fail_msg("at %g, %g: %g, %g instead of %g, %g", a->axis[0][i], a->axis[1][j],
                 (double)a->velocity[0][n], (double)a->velocity[1][n], expected[0],
                 expected[1]);
    }
  if (found < least)
    fail_msg("%zu samples have values", found);
}

static inline void assert_flow(const fg_field *field, size_t least)
{
  assert_near(field, least, TOLERANCE);
}

static inline void assert_frame(sample_file *f, const char *words)
{
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  assert_null(vector->unusable);
  assert_true(vector->cells > 0 && vector->size[0] > 1);
  if (!vector->frame || !strstr(vector->frame, words))
    fail_msg("\"%s\" lacks \"%s\"", vector->frame ? vector->frame : "", words);
  fg_inventory_destroy(inventory);
}

#define LONLAT(x, y, row, column, more_rows, more_columns, j, i)                         \
  {x, LONGITUDE, row, column, more_rows, more_columns, j, i, {"units", "degrees_east"}}, \
  {                                                                                      \
    y, LATITUDE, row, column, more_rows, more_columns, j, i,                             \
    {                                                                                    \
      "units", "degrees_north"                                                           \
    }                                                                                    \
  }

#endif
