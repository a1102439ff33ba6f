/* Grids as ocean and weather models write them, with their names, staggering and angles.
 * All have the same field, a rotation of the sphere, which must be read to the error of
 * interpolation. A component shifted to the wrong side gives ten times that error, a
 * wrong frame or angle more. */
#include "read/netcdf/model_example.h"

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

/* ROMS' own components along east and north, in a file with the grid's angle */
static const model_variable ROMS_EAST[] = {
    LONLAT("lon_rho", "lat_rho", "eta_rho", "xi_rho", 0, 0, 0.0, 0.0),
    {"u_eastward",
     EAST,
     "eta_rho",
     "xi_rho",
     0,
     0,
     0.0,
     0.0,
     {"units", "meter second-1"}},
    {"v_northward",
     NORTH,
     "eta_rho",
     "xi_rho",
     0,
     0,
     0.0,
     0.0,
     {"units", "meter second-1"}},
    {"angle", ANGLE, "eta_rho", "xi_rho", 0, 0, 0.0, 0.0, {"units", "radians"}},
    {0}};

/* what CDO leaves of WRF's wind: no positions of centres, no attributes */
static const model_variable WRF_FACES[] = {
    LONLAT("XLONG_U", "XLAT_U", "south_north", "west_east_stag", 0, 1, 0.0, -0.5),
    LONLAT("XLONG_V", "XLAT_V", "south_north_stag", "west_east", 1, 0, -0.5, 0.0),
    {"U", ALONG_I, "south_north", "west_east_stag", 0, 1, 0.0, -0.5, {"stagger", "X"}},
    {"V", ALONG_J, "south_north_stag", "west_east", 1, 0, -0.5, 0.0, {"stagger", "Y"}},
    {0}};

/* a file cut out of WRF's, without COSALPHA */
static const model_variable WRF_CUT[] = {
    LONLAT("XLONG", "XLAT", "south_north", "west_east", 0, 0, 0.0, 0.0),
    {"U10", ALONG_I, "south_north", "west_east", 0, 0, 0.0, 0.0, {"MemoryOrder", "XY "}},
    {"V10", ALONG_J, "south_north", "west_east", 0, 0, 0.0, 0.0, {"MemoryOrder", "XY "}},
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
                {ROMS_EAST, "east and north (its name says eastward)"},
                {WRF_FACES, "turned by its positions (a staggered grid)"},
                {WRF_CUT, "turned by its positions (WRF's attributes)"},
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

/* The same in one file, on dimensions that both share with the corners. */
static void one_file_of_one_shape(void **state)
{
  static const model_variable faces[] = {
      LONLAT("lon_f", "lat_f", "y", "x", 0, 0, 0.5, 0.5),
      LONLAT("lon_u", "lat_u", "y", "x", 0, 0, 0.0, 0.5),
      LONLAT("lon_v", "lat_v", "y", "x", 0, 0, 0.5, 0.0),
      {"u",
       ALONG_I,
       "y",
       "x",
       0,
       0,
       0.0,
       0.5,
       {"coordinates", "lon_u lat_u", "units", "m/s"}},
      {"v",
       ALONG_J,
       "y",
       "x",
       0,
       0,
       0.5,
       0.0,
       {"coordinates", "lon_v lat_v", "units", "m/s"}},
      {0}};
  sample_file *f = *state;
  write_model(f, faces);
  fg_field *field = read_with(f, NULL);
  assert_flow(field, 400);
  fg_field_destroy(field);
  assert_frame(f, "turned by its positions (a staggered grid)");
}

/* NEMO: levels, too, have a name of their own in each file. */
static void levels_in_two_files(void **state)
{
  static const model_variable u[] = {
      LONLAT("nav_lon", "nav_lat", "y", "x", 0, 0, 0.0, 0.5),
      {"uo", ALONG_I, "y", "x", 0, 0, 0.0, 0.5, {"units", "m/s"}},
      {0}};
  static const model_variable v[] = {
      LONLAT("nav_lon", "nav_lat", "y", "x", 0, 0, 0.5, 0.0),
      {"vo", ALONG_J, "y", "x", 0, 0, 0.5, 0.0, {"units", "m/s"}},
      {0}};
  sample_file *f = *state;
  char second[128];
  snprintf(second, sizeof second, "%s.v", f->path);
  write_model_at(f, v, "depthv");
  assert_int_equal(rename(f->path, second), 0);
  write_model_at(f, u, "depthu");
  fg_field *field = read_with(f, &(fg_read_options){.vars_from = second, .level = 1});
  assert_flow(field, 400);
  fg_field_destroy(field);
  unlink(second);
}

/* Adds coordinates along two dimensions of a file, which are true for no point. */
static void add_nominal_axes(sample_file *f, const char *const name[2], double shift)
{
  static const char *const units[2] = {"degrees_north", "degrees_east"};
  nc_must(nc_open(f->path, NC_WRITE, &f->id));
  for (int k = 0; k < 2; ++k) {
    double nominal[ROWS + COLUMNS];
    int dimension;
    for (int n = 0; n < ROWS + COLUMNS; ++n)
      nominal[n] = STEP * (n + shift);
    nc_must(nc_inq_dimid(f->id, name[k], &dimension));
    const int id = sample_variable(f, name[k], NC_DOUBLE, 1, &dimension);
    sample_text(f, id, "units", units[k]);
    sample_text(f, id, "long_name", "point nominal place");
    sample_put(f, id, nominal);
  }
  sample_end(f);
}

/* MOM5: the positions are those that `coordinates` names. */
static void nominal_axes_are_not_positions(void **state)
{
  static const model_variable mom5[] = {
      LONLAT("geolon_c", "geolat_c", "yu_ocean", "xu_ocean", 0, 0, 0.0, 0.0),
      {"u",
       ALONG_I,
       "yu_ocean",
       "xu_ocean",
       0,
       0,
       0.0,
       0.0,
       {"standard_name", "sea_water_x_velocity", "coordinates", "geolon_c geolat_c"}},
      {"v",
       ALONG_J,
       "yu_ocean",
       "xu_ocean",
       0,
       0,
       0.0,
       0.0,
       {"standard_name", "sea_water_y_velocity", "coordinates", "geolon_c geolat_c"}},
      {0}};
  sample_file *f = *state;
  write_model(f, mom5);
  add_nominal_axes(f, (const char *const[]){"yu_ocean", "xu_ocean"}, 0.0);
  fg_field *field = read_with(f, NULL);
  assert_flow(field, 400);
  fg_field_destroy(field);
}

/* MOM6: components in one file with nominal axes, and what places and turns them in
 * another. */
static void positions_in_a_second_file(void **state)
{
  const model_variable components[] = {MOM6[4], MOM6[5], {0}};
  const model_variable positions[] = {MOM6[0], MOM6[1], MOM6[2], MOM6[3],
                                      MOM6[6], MOM6[7], {0}};
  sample_file *f = *state;
  char second[128];
  snprintf(second, sizeof second, "%s.static", f->path);
  write_model(f, positions);
  assert_int_equal(rename(f->path, second), 0);
  write_model(f, components);
  add_nominal_axes(f, (const char *const[]){"yh", "xh"}, 0.0);
  add_nominal_axes(f, (const char *const[]){"yq", "xq"}, 0.5);
  const fg_read_options both = {.vars_from = second};
  fg_field *field = read_with(f, &both);
  assert_flow(field, 400);
  fg_field_destroy(field);
  fg_read_defaults alone, together;
  assert_int_equal(fg_read_defaults_find(&alone, f->context, f->path, NULL),
                   FG_STATUS_OK);
  assert_int_equal(fg_read_defaults_find(&together, f->context, f->path, &both),
                   FG_STATUS_OK);
  assert_non_null(strstr(alone.absent, "nominal"));
  assert_string_equal(together.absent, "");
  unlink(second);
}

/* The same where each component has a file of its own, too. */
static void positions_in_a_third_file(void **state)
{
  const model_variable u[] = {MOM6[4], {0}}, v[] = {MOM6[5], {0}};
  const model_variable positions[] = {MOM6[0], MOM6[1], MOM6[2], MOM6[3],
                                      MOM6[6], MOM6[7], {0}};
  sample_file *f = *state;
  char second[128], third[128];
  snprintf(second, sizeof second, "%s.v", f->path);
  snprintf(third, sizeof third, "%s.static", f->path);
  write_model(f, positions);
  assert_int_equal(rename(f->path, third), 0);
  write_model(f, v);
  assert_int_equal(rename(f->path, second), 0);
  write_model(f, u);
  fg_field *field =
      read_with(f, &(fg_read_options){.vars_from = second, .mesh_from = third});
  assert_flow(field, 400);
  fg_field_destroy(field);
  unlink(second);
  unlink(third);
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
  model_variable faces[sizeof WRF_FACES / sizeof *WRF_FACES + 1] = {
      {"wet", SEA, "south_north", "west_east", 0, 0, 0.0, 0.0, {0}}};
  memcpy(faces + 1, WRF_FACES, sizeof WRF_FACES);
  write_model(f, faces);
  sea = read_with(f, NULL);
  assert_near(sea, 200, 10.0 * TOLERANCE);
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
      CASE(models_are_read),
      CASE(two_files_of_one_shape),
      CASE(one_file_of_one_shape),
      CASE(masks_keep_land_out),
      CASE(frames_may_be_given),
      CASE(seams_close),
      CASE(faces_need_centres),
      CASE(levels_in_two_files),
      CASE(nominal_axes_are_not_positions),
      CASE(positions_in_a_second_file),
      CASE(positions_in_a_third_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
