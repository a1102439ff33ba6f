/* Longitudes and latitudes in the units that files have them in, and in others than they
 * say. */
#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

enum { NX = 36, NY = 17, COUNT = NX * NY };

typedef enum places { ON_AXES, ON_A_CURVED_GRID, AT_POINTS, PLACES } places;

/* How positions are written: their degrees times a factor. */
typedef struct written {
  const char *units[2];
  double factor[2];
  const char *words; /* of the refusal; NULL: they are read */
} written;

#define RADIANS 0.017453292519943295

static const written CASES[] = {
    {{"degrees_east", "degrees_north"}, {1.0, 1.0}, NULL},
    {{"degrees_west", "degrees_north"}, {-1.0, 1.0}, NULL},
    {{"degree_E", "degrees_south"}, {1.0, -1.0}, NULL},
    {{"radians", "radian"}, {RADIANS, RADIANS}, NULL},
    {{"degrees_east", "degrees_north"}, {RADIANS, RADIANS}, "are radians, not degrees"},
    {{"degrees", "degrees"}, {RADIANS, RADIANS}, "are radians, not degrees"},
};

static void define_places(sample_file *f, places at, const written *how, int dimension[2])
{
  double place[2][COUNT];
  for (int n = 0; n < COUNT; ++n) {
    const double bend = at == ON_A_CURVED_GRID ? 2.0 * sin(0.5 * (n % NX)) : 0.0;
    place[0][n] = (-180.0 + 10.0 * (n % NX)) * how->factor[0];
    place[1][n] = (80.0 - 10.0 * (double)(n / NX) + bend) * how->factor[1];
  }
  for (int j = 0; j < NY && at == ON_AXES; ++j)
    place[1][j] = place[1][j * NX];
  if (at == AT_POINTS) {
    dimension[0] = sample_dimension(f, "station", COUNT);
  } else {
    dimension[0] = sample_dimension(f, at == ON_AXES ? "lat" : "j", NY);
    dimension[1] = sample_dimension(f, at == ON_AXES ? "lon" : "i", NX);
  }
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "lon" : "lat", NC_DOUBLE,
                                   at == ON_A_CURVED_GRID ? 2 : 1,
                                   at == ON_AXES ? &dimension[1 - k] : dimension);
    sample_text(f, id, "units", how->units[k]);
    sample_put(f, id, place[k]);
  }
}

static void write_file(sample_file *f, places at, const written *how)
{
  int dimension[2];
  double values[COUNT];
  sample_begin(f, NC_NETCDF4);
  define_places(f, at, how, dimension);
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "u" : "v", NC_DOUBLE,
                                   at == AT_POINTS ? 1 : 2, dimension);
    for (int n = 0; n < COUNT; ++n)
      values[n] = 1.0 + k + 0.25 * (n % NX) - 0.125 * (double)(n / NX);
    sample_text(f, id, "units", "m s-1");
    sample_text(f, id, "coordinates", "lon lat");
    sample_text(f, id, "standard_name", k == 0 ? "eastward_wind" : "northward_wind");
    sample_put(f, id, values);
  }
  sample_end(f);
}

static void assert_alike(const fg_field *field, const fg_field *other, const char *what)
{
  const fg_field_arrays *a = fg_field_contents(field), *b = fg_field_contents(other);
  assert_true(a->scale == FG_SCALE_GEO && a->size[0] == b->size[0] &&
              a->size[1] == b->size[1]);
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < a->size[k]; ++i)
      if (fabs(a->axis[k][i] - b->axis[k][i]) > 1e-9)
        fail_msg("%s: axis %d has %g, not %g", what, k, a->axis[k][i], b->axis[k][i]);
  for (int n = 0; n < a->size[0] * a->size[1]; ++n)
    for (int k = 0; k < 2; ++k)
      if (fabsf(a->velocity[k][n] - b->velocity[k][n]) > 1e-4f)
        fail_msg("%s: %d has %g, not %g", what, n, (double)a->velocity[k][n],
                 (double)b->velocity[k][n]);
}

static void places_are_in_the_unit_of_their_numbers(void **state)
{
  sample_file *f = *state;
  for (int at = 0; at < PLACES; ++at) {
    write_file(f, (places)at, &CASES[0]);
    fg_field *degrees = read_with(f, NULL);
    for (size_t i = 1; i < sizeof CASES / sizeof *CASES; ++i) {
      write_file(f, (places)at, &CASES[i]);
      fg_field *field = NULL;
      const fg_status status = fg_field_read(&field, f->context, f->path, NULL);
      const char *message = fg_context_message(f->context);
      if ((status == FG_STATUS_OK) != !CASES[i].words ||
          (CASES[i].words && !strstr(message, CASES[i].words)))
        fail_msg("places %d, case %zu: %s", at, i, message);
      if (status == FG_STATUS_OK)
        assert_alike(field, degrees, CASES[i].units[0]);
      fg_field_destroy(field);
      fg_context_clear(f->context);
    }
    fg_field_destroy(degrees);
  }
}

/* Colatitudes, or degrees that are said to be radians. */
static void latitudes_end_at_the_poles(void **state)
{
  static const written radians = {{"radians", "radians"}, {1.0, 1.0}, NULL};
  sample_file *f = *state;
  write_file(f, ON_AXES, &radians);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "lie beyond the poles");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(places_are_in_the_unit_of_their_numbers),
      CASE(latitudes_end_at_the_poles),
  };
  return cmocka_run_group_tests_name("read/netcdf/degrees", tests, NULL, NULL);
}
