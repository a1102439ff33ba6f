/* Grids as ocean and weather models write them, with their names, staggering and angles.
 * All have the same field, a rotation of the sphere, which must be read to the error of
 * interpolation. A component shifted to the wrong side gives ten times that error, a
 * wrong frame or angle more. */
#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample.h"

#define RADIANS 0.017453292519943295

enum { COLUMNS = 26, ROWS = 22 };

static const double STEP = 2.0; /* degrees */
static const double TOLERANCE = 4e-3;
static const double FLOW[3][3] = {{0.9, -0.8, -0.4}, {0.7, -0.6, -0.5}, {0.3, 0.6, 0.2}};

static double dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The position of index (i, j), centres at whole numbers: a longitude-latitude grid about
 * a point of the equator, rotated to 100 degrees east, 62 north. Its corner is beyond the
 * pole, so that the antimeridian crosses it. */
static void place_of(double at[3], double i, double j)
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

static void degrees_of(double *longitude, double *latitude, const double at[3])
{
  *longitude = atan2(at[1], at[0]) / RADIANS;
  *latitude = asin(at[2]) / RADIANS;
}

/* Shear and strain: a linear map of space, projected to the tangent plane. */
static void flow_at(double w[3], const double at[3])
{
  for (int k = 0; k < 3; ++k)
    w[k] = dot(FLOW[k], at);
  const double up = dot(w, at);
  for (int k = 0; k < 3; ++k)
    w[k] -= up * at[k];
}

static void exact(double out[2], double longitude, double latitude)
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
static double angle_at(double i, double j)
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

static double value_of(quantity what, double i, double j)
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

static int dimension_of(const sample_file *f, const char *name, size_t length)
{
  int id;
  if (nc_inq_dimid(f->id, name, &id) == NC_NOERR)
    return id;
  return sample_dimension(f, name, length);
}

static void write_variable(const sample_file *f, const model_variable *v)
{
  const size_t rows = (size_t)(ROWS + v->more_rows);
  const size_t columns = (size_t)(COLUMNS + v->more_columns);
  const int dimensions[2] = {dimension_of(f, v->row, rows),
                             dimension_of(f, v->column, columns)};
  const int id = sample_variable(f, v->name, NC_DOUBLE, 2, dimensions);
  double *values = malloc(rows * columns * sizeof *values);
  assert_non_null(values);
  for (int k = 0; k + 1 < 6 && v->attributes[k]; k += 2)
    sample_text(f, id, v->attributes[k], v->attributes[k + 1]);
  for (size_t n = 0; n < rows * columns; ++n)
    values[n] = value_of(v->what, (double)(n % columns) + v->shift_column,
                         (double)(n / columns) + v->shift_row);
  sample_put(f, id, values);
  free(values);
}

static void write_model(sample_file *f, const model_variable *v)
{
  sample_begin(f, NC_CLASSIC_MODEL);
  for (; v->name; ++v)
    write_variable(f, v);
  sample_end(f);
}

/* Asserts every sample; `least`: lower bound of the number of valid ones. */
static void assert_near(const fg_field *field, size_t least, double tolerance)
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

static void assert_flow(const fg_field *field, size_t least)
{
  assert_near(field, least, TOLERANCE);
}

static void assert_frame(sample_file *f, const char *words)
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

/* The models of docs/method/model-grids.md. */
static const model_variable ROMS[] = {
    LONLAT("lon_rho", "lat_rho", "eta_rho", "xi_rho", 0, 0, 0.0, 0.0),
    LONLAT("lon_u", "lat_u", "eta_u", "xi_u", 0, -1, 0.0, 0.5),
    {"u", ALONG_I, "eta_u", "xi_u", 0, -1, 0.0, 0.5, {"units", "m s-1"}},
    {"v", ALONG_J, "eta_v", "xi_v", -1, 0, 0.5, 0.0, {"units", "m s-1"}},
    {"angle", ANGLE, "eta_rho", "xi_rho", 0, 0, 0.0, 0.0, {"units", "radians"}},
    {0}};

static const model_variable MITGCM[] = {
    LONLAT("XC", "YC", "j", "i", 0, 0, 0.0, 0.0),
    LONLAT("XG", "YG", "j_g", "i_g", 0, 0, -0.5, -0.5),
    {"UVEL", ALONG_I, "j", "i_g", 0, 0, 0.0, -0.5, {"long_name", "Zonal Component"}},
    {"VVEL", ALONG_J, "j_g", "i", 0, 0, -0.5, 0.0, {"long_name", "Meridional Component"}},
    {"AngleCS", COSINE, "j", "i", 0, 0, 0.0, 0.0, {0}},
    {"AngleSN", SINE, "j", "i", 0, 0, 0.0, 0.0, {0}},
    {0}};

static const model_variable WRF[] = {
    LONLAT("XLONG", "XLAT", "south_north", "west_east", 0, 0, 0.0, 0.0),
    {"U", ALONG_I, "south_north", "west_east_stag", 0, 1, 0.0, -0.5, {"units", "m s-1"}},
    {"V", ALONG_J, "south_north_stag", "west_east", 1, 0, -0.5, 0.0, {"units", "m s-1"}},
    {"COSALPHA", COSINE, "south_north", "west_east", 0, 0, 0.0, 0.0, {0}},
    {"SINALPHA", SINE, "south_north", "west_east", 0, 0, 0.0, 0.0, {0}},
    {0}};

/* its angle has the opposite sign */
static const model_variable MOM6[] = {
    LONLAT("geolon", "geolat", "yh", "xh", 0, 0, 0.0, 0.0),
    LONLAT("geolon_u", "geolat_u", "yh", "xq", 0, 0, 0.0, 0.5),
    {"uo",
     ALONG_I,
     "yh",
     "xq",
     0,
     0,
     0.0,
     0.5,
     {"standard_name", "sea_water_x_velocity"}},
    {"vo",
     ALONG_J,
     "yq",
     "xh",
     0,
     0,
     0.5,
     0.0,
     {"standard_name", "sea_water_y_velocity"}},
    {"cos_rot", COSINE, "yh", "xh", 0, 0, 0.0, 0.0, {0}},
    {"sin_rot", OPPOSITE, "yh", "xh", 0, 0, 0.0, 0.0, {0}},
    {0}};

/* both at the corners of the tracers' cells, whose positions are also in the file */
static const model_variable POP[] = {
    LONLAT("TLONG", "TLAT", "nlat", "nlon", 0, 0, -0.5, -0.5),
    LONLAT("ULONG", "ULAT", "nlat", "nlon", 0, 0, 0.0, 0.0),
    {"UVEL",
     ALONG_I,
     "nlat",
     "nlon",
     0,
     0,
     0.0,
     0.0,
     {"coordinates", "ULONG ULAT", "long_name", "Zonal Velocity"}},
    {"VVEL",
     ALONG_J,
     "nlat",
     "nlon",
     0,
     0,
     0.0,
     0.0,
     {"coordinates", "ULONG ULAT", "long_name", "Meridional Velocity"}},
    {"ANGLE", ANGLE, "nlat", "nlon", 0, 0, 0.0, 0.0, {"units", "radians"}},
    {0}};

static const model_variable POP_EAST[] = {
    LONLAT("ULONG", "ULAT", "nlat", "nlon", 0, 0, 0.0, 0.0),
    {"urot", EAST, "nlat", "nlon", 0, 0, 0.0, 0.0, {"long_name", "Zonal Velocity"}},
    {"vrot", NORTH, "nlat", "nlon", 0, 0, 0.0, 0.0, {"long_name", "Meridional Velocity"}},
    {0}};

static const model_variable HYCOM[] = {
    LONLAT("Longitude", "Latitude", "Y", "X", 0, 0, 0.0, 0.0),
    {"u",
     EAST,
     "Y",
     "X",
     0,
     0,
     0.0,
     0.0,
     {"standard_name", "eastward_sea_water_velocity"}},
    {"v",
     NORTH,
     "Y",
     "X",
     0,
     0,
     0.0,
     0.0,
     {"standard_name", "northward_sea_water_velocity"}},
    {0}};

static void models_are_read(void **state)
{
  static const struct {
    const model_variable *variables;
    const char *frame;
  } models[] = {{ROMS, "turned by 'angle' (a staggered grid)"},
                {MITGCM, "turned by 'AngleCS' (a staggered grid)"},
                {WRF, "turned by 'COSALPHA' (a staggered grid)"},
                {MOM6, "'cos_rot', which is the angle from the grid to east"},
                {POP, "turned by 'ANGLE' (the file has the grid's angle)"},
                {POP_EAST, "east and north (its name says zonal)"},
                {HYCOM, "east and north (standard_name eastward_sea_water_velocity)"}};
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof models / sizeof *models; ++n) {
    write_model(f, models[n].variables);
    fg_field *field = read_with(f, NULL);
    assert_flow(field, 400);
    fg_field_destroy(field);
    assert_frame(f, models[n].frame);
  }
}

/* One file for each component, of equal shapes: only positions show on which side of the
 * centres components are, or that they are on the centres. */
static void two_files_of_one_shape(void **state)
{
  sample_file *f = *state;
  char second[128];
  snprintf(second, sizeof second, "%s.v", f->path);
  for (int side = -1; side <= 1; ++side) {
    const double off = 0.5 * side;
    const model_variable v[] = {
        LONLAT("nav_lon", "nav_lat", "y", "x", 0, 0, off, 0.0),
        {"vomecrty", ALONG_J, "y", "x", 0, 0, off, 0.0, {"units", "m/s"}},
        {0}};
    const model_variable u[] = {
        LONLAT("nav_lon", "nav_lat", "y", "x", 0, 0, 0.0, off),
        {"vozocrtx", ALONG_I, "y", "x", 0, 0, 0.0, off, {"units", "m/s"}},
        {0}};
    write_model(f, v);
    assert_int_equal(rename(f->path, second), 0);
    write_model(f, u);
    fg_field *field = read_with(f, &(fg_read_options){.vars_from = second});
    assert_flow(field, 400);
    fg_field_destroy(field);
    unlink(second);
  }
}

/* Land west of column 6 is only in the mask; velocities are zero there. */
static void masks_keep_land_out(void **state)
{
  sample_file *f = *state;
  enum { COUNT = sizeof ROMS / sizeof *ROMS };
  model_variable masked[COUNT + 1] = {{0}};
  memcpy(masked, ROMS, sizeof ROMS);
  masked[COUNT - 1] =
      (model_variable){"mask_rho", SEA, "eta_rho",
                       "xi_rho",   0,   0,
                       0.0,        0.0, {"standard_name", "land_binary_mask"}};
  write_model(f, masked);
  fg_field *all, *sea;
  sea = read_with(f, NULL);
  assert_near(sea, 200, 10.0 * TOLERANCE); /* half a cell is as its neighbours */
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  /* of 19 x 20 centres the outermost lack a face */
  assert_float_equal(fg_inventory_vector_at(inventory, 0)->missing_share, 0.3356643,
                     1e-6);
  fg_inventory_destroy(inventory);
  write_model(f, ROMS);
  all = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(all), *b = fg_field_contents(sea);
  assert_true(b->axis[0][b->size[0] - 1] - b->axis[0][0] <
              a->axis[0][a->size[0] - 1] - a->axis[0][0]);
  fg_field_destroy(all);
  fg_field_destroy(sea);
}

/* Faces of different counts and no centres: the positions of centres are undetermined. */
static void faces_need_centres(void **state)
{
  static const model_variable faces[] = {
      LONLAT("lon_u", "lat_u", "eta_rho", "xi_u", 0, -1, 0.0, 0.5),
      LONLAT("lon_v", "lat_v", "eta_v", "xi_rho", -1, 0, 0.5, 0.0),
      {"u", ALONG_I, "eta_rho", "xi_u", 0, -1, 0.0, 0.5, {"units", "m s-1"}},
      {"v", ALONG_J, "eta_v", "xi_rho", -1, 0, 0.5, 0.0, {"units", "m s-1"}},
      {0}};
  sample_file *f = *state;
  write_model(f, faces);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "a staggered grid");
}

/* Where no rule applies, the option `frame` decides. */
static void frames_may_be_given(void **state)
{
  static const model_variable plain[] = {
      LONLAT("lon", "lat", "rows", "columns", 0, 0, 0.0, 0.0),
      {"u", EAST, "rows", "columns", 0, 0, 0.0, 0.0, {"units", "m/s"}},
      {"v", NORTH, "rows", "columns", 0, 0, 0.0, 0.0, {"units", "m/s"}},
      {0}};
  sample_file *f = *state;
  write_model(f, plain);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "nothing says whether");
  fg_field *field = read_with(f, &(fg_read_options){.frame = FG_FRAME_EAST});
  assert_flow(field, 400);
  fg_field_destroy(field);
  model_variable grid[5];
  memcpy(grid, plain, sizeof grid);
  grid[2].what = ALONG_I;
  grid[3].what = ALONG_J;
  write_model(f, grid);
  field = read_with(f, &(fg_read_options){.frame = FG_FRAME_GRID});
  assert_flow(field, 400);
  fg_field_destroy(field);
}

/* A tripolar grid: confocal ellipses about a segment through the pole, in the
 * stereographic plane. Its rows close, and the last row is folded. */
static void seams_close(void **state)
{
  enum { AROUND = 72, ACROSS = 20 };
  static double lon[ACROSS * AROUND], lat[ACROSS * AROUND], u[ACROSS * AROUND],
      v[ACROSS * AROUND];
  sample_file *f = *state;
  for (int n = 0; n < ACROSS * AROUND; ++n) {
    const double turn = 360.0 * RADIANS * (n % AROUND + 0.5) / AROUND;
    const double row = 0.09 * (ACROSS - n / AROUND - 0.5);
    const double x = 0.2 * cosh(row) * cos(turn), y = 0.2 * sinh(row) * sin(turn);
    double flow[2];
    lon[n] = atan2(y, x) / RADIANS;
    lat[n] = 90.0 - 2.0 * atan(hypot(x, y)) / RADIANS;
    exact(flow, lon[n], lat[n]);
    u[n] = flow[0];
    v[n] = flow[1];
  }
  sample_begin(f, 0);
  const int plane[2] = {sample_dimension(f, "nj", ACROSS),
                        sample_dimension(f, "ni", AROUND)};
  const double *const values[] = {lon, lat, u, v};
  static const char *const words[][3] = {
      {"TLON", "units", "degrees_east"},
      {"TLAT", "units", "degrees_north"},
      {"uo", "standard_name", "eastward_sea_water_velocity"},
      {"vo", "standard_name", "northward_sea_water_velocity"}};
  for (int k = 0; k < 4; ++k) {
    const int id = sample_variable(f, words[k][0], NC_DOUBLE, 2, plane);
    sample_text(f, id, words[k][1], words[k][2]);
    sample_put(f, id, values[k]);
  }
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  assert_near(field, 1000, 2e-2);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->period[0] == 360.0);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0] && a->axis[1][j] > 60.0; ++i)
      assert_true(isfinite(a->velocity[0][j * a->size[0] + i]));
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(models_are_read),     CASE(two_files_of_one_shape),
      CASE(masks_keep_land_out), CASE(frames_may_be_given),
      CASE(seams_close),         CASE(faces_need_centres),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
