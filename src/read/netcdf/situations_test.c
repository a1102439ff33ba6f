/* Files whose statements contradict each other, or that say a thing in one of two places:
 * each is read rightly, or refused with the option that decides. The flow is the same in
 * all: east at 2, north at -1. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "read/netcdf/sample_example.h"

enum { SIDE = 20, GAP_AT = 9 };

static const double EAST = 2.0, NORTH = -1.0, FIRST_LONGITUDE = 200.0,
                    FIRST_LATITUDE = -20.0, STEP = 2.0;

typedef enum layout {
  PLAIN,  /* columns run east, rows north */
  TURNED, /* columns run south, rows east; components along them, with their angle */
  SWATHS, /* 40 degrees of longitude lie between columns GAP_AT and the next */
  UPRIGHT /* the same of swaths along the axes */
} layout;

typedef struct situation {
  const char *what;
  layout layout;
  const char *dimension[2];     /* of rows and columns */
  const char *units[2];         /* of coordinates along them; NULL: there are none */
  double first;                 /* of these, in steps of one */
  bool positions;               /* longitudes and latitudes in two dimensions */
  bool staggered;               /* u at i_g, v at j_g */
  const char *standard_name[2]; /* of the components */
  fg_scale scale;               /* that is asked for */
  const char *refused;          /* words of the message; NULL: it is read */
  const char *doubt;            /* words of the doubts; NULL: there are none */
} situation;

#define EASTWARD                                                                         \
  {                                                                                      \
    "eastward_wind", "northward_wind"                                                    \
  }
#define ALONG_X                                                                          \
  {                                                                                      \
    "sea_water_x_velocity", "sea_water_y_velocity"                                       \
  }
#define DEGREES                                                                          \
  {                                                                                      \
    "degrees_north", "degrees_east"                                                      \
  }

static const situation SITUATIONS[] = {
    {.what = "coordinates that count samples, beside positions",
     .dimension = {"j", "i"},
     .units = {"", ""},
     .positions = true,
     .staggered = true,
     .standard_name = ALONG_X},
    {.what = "a tile whose columns run south",
     .layout = TURNED,
     .dimension = {"j", "i"},
     .positions = true,
     .standard_name = ALONG_X},
    {.what = "degrees that are not where the positions are",
     .dimension = {"grid_yt", "grid_xt"},
     .units = DEGREES,
     .first = 1.0,
     .positions = true,
     .standard_name = EASTWARD,
     .doubt = "are not where the longitudes and latitudes"},
    {.what = "degrees that count samples from 1",
     .dimension = {"grid_yt", "grid_xt"},
     .units = DEGREES,
     .first = 1.0,
     .standard_name = EASTWARD,
     .refused = "are in degrees, but count samples: 1 to 20 and 1 to 20"},
    {.what = "degrees that count samples from 0",
     .dimension = {"yh", "xh"},
     .units = DEGREES,
     .standard_name = EASTWARD,
     .refused = "are in degrees, but count samples: 0 to 19 and 0 to 19"},
    {.what = "the same, as asked",
     .dimension = {"grid_yt", "grid_xt"},
     .units = DEGREES,
     .first = 1.0,
     .standard_name = EASTWARD,
     .scale = FG_SCALE_GEO},
    {.what = "the same, called longitude and latitude",
     .dimension = {"lat", "lon"},
     .units = DEGREES,
     .first = 1.0,
     .standard_name = EASTWARD,
     .doubt = "as sample numbers do"},
    {.what = "two swaths in one array",
     .layout = SWATHS,
     .dimension = {"row", "cell"},
     .positions = true,
     .standard_name = EASTWARD,
     .doubt = "19 of its 361 cells are missing: they lie over gaps"},
    {.what = "two swaths along the axes",
     .layout = UPRIGHT,
     .dimension = {"row", "cell"},
     .positions = true,
     .standard_name = EASTWARD,
     .doubt = "nothing is interpolated over 1 gap along its axes"},
};

static double position_of(const situation *s, int k, size_t j, size_t i)
{
  const double gap = s->layout >= SWATHS && i > GAP_AT ? 40.0 - STEP : 0.0;
  if (s->layout == TURNED)
    return k == 0 ? FIRST_LONGITUDE + STEP * (double)j
                  : FIRST_LATITUDE + STEP * (double)(SIDE - 1 - i);
  const double lean = s->layout == SWATHS ? 0.3 * (double)j : 0.0;
  return k == 0 ? FIRST_LONGITUDE + STEP * (double)i + gap + lean
                : FIRST_LATITUDE + STEP * (double)j;
}

static void put_all(const sample_file *f, int variable, const situation *s, int k)
{
  double values[SIDE * SIDE];
  for (size_t n = 0; n < SIDE * SIDE; ++n)
    values[n] = position_of(s, k, n / SIDE, n % SIDE);
  sample_put(f, variable, values);
}

static void put_constant(const sample_file *f, const char *name, const int dimension[2],
                         double value, const char *standard_name)
{
  double values[SIDE * SIDE];
  const int variable = sample_variable(f, name, NC_DOUBLE, 2, dimension);
  if (standard_name)
    sample_text(f, variable, "standard_name", standard_name);
  for (size_t n = 0; n < SIDE * SIDE; ++n)
    values[n] = value;
  sample_put(f, variable, values);
}

static int dimension_of(const sample_file *f, const situation *s, int k, const char *name)
{
  double count[SIDE];
  if (!s->units[k])
    return sample_dimension(f, name, SIDE);
  for (int n = 0; n < SIDE; ++n)
    count[n] = s->first + n;
  return sample_axis(f, name, SIDE, count, s->units[k][0] ? s->units[k] : NULL);
}

static void write_situation(sample_file *f, const situation *s)
{
  static const char *const name[] = {"XC", "YC"};
  static const char *const of[] = {"degrees_east", "degrees_north"};
  sample_begin(f, NC_CLASSIC_MODEL);
  int centre[2], u[2], v[2];
  for (int k = 0; k < 2; ++k)
    centre[k] = u[k] = v[k] = dimension_of(f, s, k, s->dimension[k]);
  if (s->staggered) {
    u[1] = dimension_of(f, s, 1, "i_g");
    v[0] = dimension_of(f, s, 0, "j_g");
  }
  for (int k = 0; k < 2 && s->positions; ++k) {
    const int variable = sample_variable(f, name[k], NC_DOUBLE, 2, centre);
    sample_text(f, variable, "units", of[k]);
    put_all(f, variable, s, k);
  }
  /* columns run south: east is the second component, north the opposite of the first */
  const bool turned = s->layout == TURNED;
  put_constant(f, "u", u, turned ? -NORTH : EAST, s->standard_name[0]);
  put_constant(f, "v", v, turned ? EAST : NORTH, s->standard_name[1]);
  if (turned) {
    put_constant(f, "CS", centre, 0.0, NULL);
    put_constant(f, "SN", centre, -1.0, NULL);
  }
  sample_end(f);
}

/* Every sample is the flow; most of the box that positions span has one, but for gaps. */
static void assert_read(const fg_field *field, const situation *s)
{
  const fg_field_arrays *a = fg_field_contents(field);
  const size_t all = (size_t)a->size[0] * (size_t)a->size[1];
  size_t valid = 0;
  assert_int_equal(a->scale, FG_SCALE_GEO);
  for (size_t n = 0; n < all; ++n) {
    const double u = (double)a->velocity[0][n], v = (double)a->velocity[1][n];
    const double longitude = a->axis[0][n % (size_t)a->size[0]];
    if (isnan(u))
      continue;
    ++valid;
    if (hypot(u - EAST, v - NORTH) > 1e-3)
      fail_msg("%s: %g, %g at %g", s->what, u, v, longitude);
    const double east = remainder(longitude - FIRST_LONGITUDE, 360.0);
    if (s->layout == SWATHS && east > STEP * (GAP_AT + 4) && east < STEP * GAP_AT + 38.0)
      fail_msg("%s: a value in the gap, %g east", s->what, east);
  }
  double middle[2] = {FIRST_LONGITUDE + STEP * GAP_AT + 20.0, FIRST_LATITUDE + STEP};
  double velocity[2];
  middle[0] += 360.0 * nearbyint((a->axis[0][0] - FIRST_LONGITUDE) / 360.0);
  if (s->layout == UPRIGHT && fg_field_velocity(field, middle, velocity))
    fail_msg("%s: %g, %g in the gap", s->what, velocity[0], velocity[1]);
  if (3 * valid < all)
    fail_msg("%s: %zu of %zu samples", s->what, valid, all);
}

static void contradictions_are_settled_or_refused(void **state)
{
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof SITUATIONS / sizeof *SITUATIONS; ++n) {
    const situation *s = &SITUATIONS[n];
    const fg_read_options options = {.scale = s->scale};
    fg_field *field = NULL;
    write_situation(f, s);
    const fg_status status = fg_field_read(&field, f->context, f->path, &options);
    const char *message = fg_context_message(f->context);
    if (s->refused) {
      if (status != FG_STATUS_UNSUPPORTED || !strstr(message, s->refused))
        fail_msg("%s: %d, %s", s->what, (int)status, message);
      assert_non_null(strstr(fg_context_hint(f->context), "--"));
    } else {
      if (status != FG_STATUS_OK)
        fail_msg("%s: %s", s->what, message);
      assert_read(field, s);
      const char *doubts = fg_field_contents(field)->doubts;
      const char *words = doubts ? doubts : "";
      if (s->doubt ? !strstr(words, s->doubt) : *words)
        fail_msg("%s: doubts: '%s'", s->what, words);
    }
    fg_field_destroy(field);
    fg_context_clear(f->context);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(contradictions_are_settled_or_refused,
                                      sample_set_up, sample_tear_down),
  };
  return cmocka_run_group_tests_name("read/netcdf/situations", tests, NULL, NULL);
}
