/* Speed and direction of a wind in place of components: the flow is that of the same
 * places' components. */
#include "read/grib/grib_example.h"

static const char SPEED[] = "parameterCategory=2,parameterNumber=1",
                  DIRECTION[] = "parameterCategory=2,parameterNumber=0";

#define LAMBERT                                                                          \
  "gridType=lambert,latitudeOfFirstGridPointInDegrees=30,"                               \
  "longitudeOfFirstGridPointInDegrees=350,LoVInDegrees=10,LaDInDegrees=45,"              \
  "Latin1InDegrees=40,Latin2InDegrees=50,shapeOfTheEarth=6,Ni=21,Nj=16,"                 \
  "numberOfDataPoints=336,DxInMetres=100000,DyInMetres=100000,iScansNegatively=0,"       \
  "jScansPositively=1,resolutionAndComponentFlags="

/* Adds the flow as a speed and the direction from which it blows. */
static void add_polar(const grib_file *f, const char *sample, const char *grid,
                      const char *speed, const char *direction)
{
  codes_handle *handle = codes_grib_handle_new_from_samples(NULL, sample);
  size_t count;
  assert_non_null(handle);
  grib_set(handle, grid);
  double *u = grib_flow(&count, handle, 0, 0, NULL),
         *v = grib_flow(&count, handle, 1, 0, NULL);
  grib_set(handle, "bitsPerValue=24");
  for (size_t n = 0; n < count; ++n) {
    const double length = hypot(u[n], v[n]);
    v[n] = 180.0 + atan2(u[n], v[n]) * 180.0 / acos(-1.0);
    u[n] = length;
  }
  for (int k = 0; k < 2; ++k) {
    grib_set(handle, k == 0 ? speed : direction);
    codes_must(codes_set_double_array(handle, "values", k == 0 ? u : v, count), "values");
    codes_must(codes_write_message(handle, f->path, "a"), f->path);
  }
  codes_handle_delete(handle);
  free(u);
  free(v);
}

static void assert_alike(const fg_field *field, const fg_field *other)
{
  const fg_field_arrays *a = fg_field_contents(field), *b = fg_field_contents(other);
  assert_int_equal(a->scale, b->scale);
  assert_true(a->size[0] == b->size[0] && a->size[1] == b->size[1] && a->size[1] > 1);
  for (int n = 0; n < a->size[0] * a->size[1]; ++n)
    for (int k = 0; k < 2; ++k)
      if (!(fabsf(a->velocity[k][n] - b->velocity[k][n]) < 1e-3f) &&
          !(isnan(a->velocity[k][n]) && isnan(b->velocity[k][n])))
        fail_msg("%d: %g instead of %g", n, (double)a->velocity[k][n],
                 (double)b->velocity[k][n]);
}

/* On the globe, in a plane and on the sphere. A flag of components along the grid says
 * nothing of directions. */
static void they_are_read_as_components(void **state)
{
  static const struct {
    const char *sample, *grid, *of_components;
  } cases[] = {{"regular_ll_pl_grib2", "", ""},
               {"regular_ll_pl_grib2", LAMBERT "0", LAMBERT "0"},
               {"regular_ll_pl_grib2", LAMBERT "8", LAMBERT "0"},
               {"reduced_gg_pl_32_grib2", "", ""},
               {"rotated_ll_pl_grib2", "uvRelativeToGrid=1", "uvRelativeToGrid=0"}};
  static const char *const vars[] = {NULL, "ws,wdir", "wdir,ws"};
  grib_file *f = *state;
  for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
    unlink(f->path);
    grib_add(f, cases[c].sample, cases[c].of_components, 0, "bitsPerValue=24",
             "parameterCategory=2,parameterNumber=2",
             "parameterCategory=2,parameterNumber=3", NULL);
    fg_field *components = grib_read_whole(f, NULL);
    unlink(f->path);
    add_polar(f, cases[c].sample, cases[c].grid, SPEED, DIRECTION);
    for (size_t k = 0; k < sizeof vars / sizeof *vars; ++k) {
      fg_field *field = grib_read_whole(f, &(fg_read_options){.vars = vars[k]});
      assert_alike(field, components);
      assert_string_equal(fg_field_contents(field)->velocity_units, "m/s");
      fg_field_destroy(field);
    }
    fg_field_destroy(components);
  }
}

static void edition_1_has_them_too(void **state)
{
  grib_file *f = *state;
  grib_add(f, "regular_ll_pl_grib1", "", 0, "bitsPerValue=24",
           "indicatorOfParameter=33,table2Version=2",
           "indicatorOfParameter=34,table2Version=2", NULL);
  fg_field *components = grib_read(f, NULL);
  unlink(f->path);
  add_polar(f, "regular_ll_pl_grib1", "", "indicatorOfParameter=32,table2Version=2",
            "indicatorOfParameter=31,table2Version=2");
  fg_field *field = grib_read(f, NULL);
  assert_alike(field, components);
  fg_field_destroy(components);
  fg_field_destroy(field);
}

/* Heights of waves and the direction from which they come are a vector where they are
 * asked for: of all waves, of those of the wind and of swell, in either order. */
static void waves_are_read_by_their_names(void **state)
{
  static const struct {
    const char *sample, *height, *direction, *level;
  } cases[] = {{"regular_ll_sfc_grib2", "swh", "mwd", "height 0 m"},
               {"regular_ll_sfc_grib1", "swh", "mwd", "surface"},
               {"regular_ll_sfc_grib1", "shww", "mdww", "surface"},
               {"reduced_gg_sfc_grib1", "shts", "mdts", "surface"}};
  grib_file *f = *state;
  for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
    char height[64], direction[64], vars[2][128];
    unlink(f->path);
    grib_add(f, cases[c].sample, "", 0, "bitsPerValue=24", "shortName=10u",
             "shortName=10v", NULL);
    fg_field *components = grib_read_whole(f, NULL);
    unlink(f->path);
    snprintf(height, sizeof height, "shortName=%s", cases[c].height);
    snprintf(direction, sizeof direction, "shortName=%s", cases[c].direction);
    add_polar(f, cases[c].sample, "", height, direction);
    grib_refuse(f, NULL, FG_STATUS_UNSUPPORTED, "no vectors found");
    snprintf(vars[0], sizeof vars[0], "%s,%s", cases[c].height, cases[c].direction);
    snprintf(vars[1], sizeof vars[1], "%s,%s", cases[c].direction, cases[c].height);
    for (int k = 0; k < 2; ++k) {
      fg_field *field = grib_read_whole(f, &(fg_read_options){.vars = vars[k]});
      assert_alike(field, components);
      assert_string_equal(fg_field_contents(field)->velocity_units, "m");
      assert_string_equal(fg_field_contents(field)->level, cases[c].level);
      fg_field_destroy(field);
    }
    fg_field_destroy(components);
  }
}

/* An inventory tells the rule; a file's components go first. */
static void components_go_first(void **state)
{
  static const char height[] = "typeOfLevel=heightAboveGround,level=10,";
  grib_file *f = *state;
  char speed[128], direction[128];
  fg_inventory *inventory = NULL;
  snprintf(speed, sizeof speed, "%s%s", height, SPEED);
  snprintf(direction, sizeof direction, "%s%s", height, DIRECTION);
  add_polar(f, "regular_ll_sfc_grib2", "", speed, direction);
  fg_field *field = grib_read(f, &(fg_read_options){.vars = "10si,10wdir"});
  assert_string_equal(fg_field_contents(field)->title, "10 metre wind");
  fg_field_destroy(field);
  grib_add(f, "regular_ll_pl_grib2", "", 0, "bitsPerValue=24",
           "parameterCategory=2,parameterNumber=2",
           "parameterCategory=2,parameterNumber=3", NULL);
  field = grib_read(f, NULL);
  assert_string_equal(fg_field_contents(field)->velocity_name[0], "u");
  fg_field_destroy(field);
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 2);
  assert_null(fg_inventory_vector_at(inventory, 0)->frame);
  const fg_inventory_vector *polar = fg_inventory_vector_at(inventory, 1);
  assert_string_equal(polar->name[0], "10si");
  assert_string_equal(polar->name[1], "10wdir");
  assert_non_null(strstr(polar->frame, "from where it comes, in degrees clockwise"));
  fg_inventory_destroy(inventory);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, grib_set_up, grib_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(they_are_read_as_components),
      CASE(edition_1_has_them_too),
      CASE(waves_are_read_by_their_names),
      CASE(components_go_first),
  };
  return cmocka_run_group_tests_name("read/grib/polar", tests, NULL, NULL);
}
