#include <math.h>

#include "file/folder_test.h"

/* More than one zlib block, and not a whole number of them. */
enum { NX = 131, NY = 77, COUNT = NX * NY };

typedef struct samples {
  double x[NX], y[NY];
  float u[COUNT], v[COUNT];
} samples;

static fg_field *make_field(fg_context *context, samples *s, fg_field_arrays words)
{
  for (size_t i = 0; i < NX; ++i)
    s->x[i] = -3.0 + 0.25 * (double)i;
  for (size_t j = 0; j < NY; ++j)
    s->y[j] = 10.0 + 0.1 * (double)j;
  for (size_t i = 0; i < COUNT; ++i) {
    s->u[i] = 1.0f / (float)(i + 1);
    s->v[i] = (float)i * (i % 2 ? 1e-30f : -1e3f);
    if (i % 97 > 90)
      s->u[i] = NAN;
  }
  words.dimension = 2;
  words.size[0] = NX;
  words.size[1] = NY;
  words.axis[0] = s->x;
  words.axis[1] = s->y;
  words.velocity[0] = s->u;
  words.velocity[1] = s->v;
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &words), FG_STATUS_OK);
  return field;
}

static bool is_missing(const fg_field_arrays *a, size_t i)
{
  return (a->valid && !a->valid[i]) || isnan(a->velocity[0][i]);
}

static void assert_same_samples(const fg_field *first, const fg_field *second,
                                double axis_tolerance)
{
  const fg_field_arrays *a = fg_field_contents(first), *b = fg_field_contents(second);
  assert_int_equal(a->dimension, b->dimension);
  size_t count = 1;
  for (int k = 0; k < a->dimension; ++k) {
    assert_int_equal(a->size[k], b->size[k]);
    count *= (size_t)a->size[k];
    for (int i = 0; i < a->size[k]; ++i)
      assert_true(fabs(a->axis[k][i] - b->axis[k][i]) <= axis_tolerance);
  }
  for (size_t i = 0; i < count; ++i) {
    assert_int_equal(is_missing(a, i), is_missing(b, i));
    for (int k = 0; k < a->dimension && !is_missing(a, i); ++k)
      assert_true(a->velocity[k][i] == b->velocity[k][i]);
  }
}

/* VTK finds no inline data behind another element (seen with VTK 9.1). */
static void assert_data_follow_their_tag(const char *path)
{
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  char start[1024] = "";
  assert_true(fread(start, 1, sizeof start - 1, file) > 0);
  fclose(file);
  const char *data = strstr(start, "format=\"binary\">\n");
  assert_non_null(data);
  assert_int_not_equal(data[strlen("format=\"binary\">\n")], '<');
}

static void an_image_comes_back_bit_for_bit(void **state)
{
  folder *f = *state;
  samples s;
  fg_field *field = make_field(
      f->context, &s,
      (fg_field_arrays){.velocity_units = "<mm>/s", .velocity_name = {"a&b_x", "a&b_y"}});
  fg_field *back = NULL;
  assert_int_equal(fg_field_write(f->context, path_of(f, "a.vti"), field), FG_STATUS_OK);
  assert_data_follow_their_tag(f->path);
  assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), FG_STATUS_OK);
  assert_same_samples(field, back, 1e-13);
  const fg_field_arrays *b = fg_field_contents(back);
  assert_string_equal(b->velocity_units, "<mm>/s");
  assert_string_equal(b->velocity_name[0], "a&b_x");
  assert_string_equal(b->title, "a&b");
  fg_field_destroy(back);
  fg_field_destroy(field);
}

static void netcdf_comes_back_bit_for_bit(void **state)
{
  folder *f = *state;
  static const fg_scale scales[] = {FG_SCALE_PLAIN, FG_SCALE_MAP, FG_SCALE_GEO};
  for (size_t i = 0; i < 3; ++i) {
    samples s;
    fg_field *field = make_field(f->context, &s,
                                 (fg_field_arrays){.scale = scales[i],
                                                   .velocity_units = "m/s",
                                                   .axis_units = {"m", "m"}});
    fg_field *back = NULL;
    assert_int_equal(fg_field_write(f->context, path_of(f, "a.nc"), field), FG_STATUS_OK);
    assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), FG_STATUS_OK);
    assert_same_samples(field, back, 0.0);
    assert_string_equal(fg_field_contents(back)->velocity_units, "m/s");
    if (scales[i] == FG_SCALE_GEO)
      assert_true(fg_field_contents(back)->scale == FG_SCALE_GEO);
    fg_field_destroy(back);
    fg_field_destroy(field);
  }
}

/* A .vti carries what its axes are. */
static void an_image_keeps_its_map(void **state)
{
  folder *f = *state;
  static const char laea[] = "+proj=laea +lat_0=52 +lon_0=10 +R=6371000 +units=km";
  static const struct {
    fg_field_arrays words;
    fg_status status; /* of reading it */
  } cases[] = {{{.scale = FG_SCALE_GEO,
                 .axis_name = {"longitude", "latitude"},
                 .axis_units = {"°E", "°N"},
                 .period = {NX * 0.25}},
                FG_STATUS_OK},
               {{.scale = FG_SCALE_MAP,
                 .axis_units = {"km", "km"},
                 .projection = laea,
                 .time = "1982-07-16 12:00",
                 .level = "850 hPa"},
                FG_STATUS_OK},
               {{.scale = FG_SCALE_MAP, .projection = "+proj=merc +nadgrids=/etc/passwd"},
                FG_STATUS_FILE_FORMAT}};
  for (size_t i = 0; i < 3; ++i) {
    samples s;
    const fg_field_arrays *words = &cases[i].words;
    fg_field *field = make_field(f->context, &s, *words), *back = NULL;
    assert_int_equal(fg_field_write(f->context, path_of(f, "a.vti"), field),
                     FG_STATUS_OK);
    if (i > 0 && !fg_has_feature(FG_FEATURE_MAPS)) {
      fg_field_destroy(field);
      continue;
    }
    assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), cases[i].status);
    fg_context_clear(f->context);
    if (back) {
      const fg_field_arrays *a = fg_field_contents(field), *b = fg_field_contents(back);
      assert_true(b->scale == words->scale && b->period[0] == words->period[0]);
      for (int k = 0; k < 2; ++k) {
        assert_string_equal(b->axis_name[k], a->axis_name[k]);
        assert_string_equal(b->axis_units[k], a->axis_units[k]);
      }
      if (i == 1) {
        assert_string_equal(b->projection, laea);
        assert_string_equal(b->time, "1982-07-16 12:00");
        assert_string_equal(b->level, "850 hPa");
      }
      assert_same_samples(field, back, 1e-13);
    }
    fg_field_destroy(back);
    fg_field_destroy(field);
  }
}

static void analytic_fields_go_through_both_formats(void **state)
{
  folder *f = *state;
  static const char *const names[] = {"a.vti", "a.nc"};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, f->context, "benard", 65),
                   FG_STATUS_OK);
  for (size_t i = 0; i < 2; ++i) {
    fg_field *back = NULL;
    assert_int_equal(fg_field_write(f->context, path_of(f, names[i]), field),
                     FG_STATUS_OK);
    assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), FG_STATUS_OK);
    assert_same_samples(field, back, 1e-15);
    assert_true(fg_field_contents(back)->scale == FG_SCALE_PLAIN);
    fg_field_destroy(back);
    unlink(f->path);
  }
  f->path[0] = '\0';
  fg_field_destroy(field);
}

/* Axes of three lengths, and a hole. */
static fg_field *make_volume(fg_context *context)
{
  enum { SX = 7, SY = 5, SZ = 4, SAMPLES = SX * SY * SZ };
  double axis[3][SX];
  float velocity[3][SAMPLES];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < SX; ++i)
      axis[k][i] = 1.0 + k + 0.25 * (k + 1) * i;
  for (int c = 0; c < 3; ++c)
    for (int n = 0; n < SAMPLES; ++n)
      velocity[c][n] = n == 71 && c == 2 ? NAN : (float)(n - 20) / (float)(c + 3);
  fg_field *field = NULL;
  assert_int_equal(
      fg_field_create(
          &field, context,
          &(fg_field_arrays){.dimension = 3,
                             .size = {SX, SY, SZ},
                             .axis = {axis[0], axis[1], axis[2]},
                             .velocity = {velocity[0], velocity[1], velocity[2]},
                             .velocity_units = "m/s"}),
      FG_STATUS_OK);
  return field;
}

static void volumes_come_back_bit_for_bit(void **state)
{
  folder *f = *state;
  fg_field *field = make_volume(f->context), *back = NULL;
  assert_int_equal(fg_field_write(f->context, path_of(f, "a.vti"), field), FG_STATUS_OK);
  assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), FG_STATUS_OK);
  assert_same_samples(field, back, 1e-13);
  assert_int_equal(fg_field_contents(back)->valid[71], 0);
  assert_string_equal(fg_field_contents(back)->velocity_units, "m/s");
  fg_field_destroy(back);
  fg_field_destroy(field);
}

/* In a file a period has an end: the first samples again. */
static void periodic_axes_are_closed(void **state)
{
  folder *f = *state;
  fg_field *field = NULL, *back = NULL;
  assert_int_equal(fg_field_create_analytic(&field, f->context, "abc", 9), FG_STATUS_OK);
  assert_int_equal(fg_field_write(f->context, path_of(f, "a.vti"), field), FG_STATUS_OK);
  assert_int_equal(fg_field_read(&back, f->context, f->path, NULL), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(back);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(a->size[k], 9);
    assert_true(a->period[k] == 0.0 && a->axis[k][8] == 1.0);
  }
  for (int n = 0; n < 50; ++n) {
    const double at[3] = {fmod(0.37 * n, 1.0), fmod(0.53 * n, 1.0), 1.0};
    double v[3] = {0.0}, w[3] = {0.0};
    assert_true(fg_field_velocity(field, at, v) && fg_field_velocity(back, at, w));
    for (int k = 0; k < 3; ++k)
      assert_true(fabs(v[k] - w[k]) < 1e-6);
  }
  fg_field_destroy(back);
  fg_field_destroy(field);
}

static void what_cannot_be_written_leaves_nothing(void **state)
{
  folder *f = *state;
  samples s;
  fg_field *field = make_field(f->context, &s, (fg_field_arrays){0}), *uneven = NULL;
  static const struct {
    const char *name;
    fg_status status;
  } wrong[] = {{"a.vtk", FG_STATUS_UNSUPPORTED},
               {"a", FG_STATUS_UNSUPPORTED},
               {"missing/a.vti", FG_STATUS_FILE_ACCESS},
               {"missing/a.nc", FG_STATUS_FILE_ACCESS}};
  for (size_t i = 0; i < 4; ++i) {
    assert_int_equal(fg_field_write(f->context, path_of(f, wrong[i].name), field),
                     wrong[i].status);
    fg_context_clear(f->context);
  }
  fg_field_arrays words = *fg_field_contents(field);
  s.y[40] += 0.01;
  words.axis[1] = s.y;
  assert_int_equal(fg_field_create(&uneven, f->context, &words), FG_STATUS_OK);
  assert_int_equal(fg_field_write(f->context, path_of(f, "b.vti"), uneven),
                   FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(f->context), "sample 40"));
  assert_int_equal(access(f->path, F_OK), -1);
  fg_context_clear(f->context);
  assert_int_equal(fg_field_write(f->context, path_of(f, "b.nc"), uneven), FG_STATUS_OK);
  fg_field_destroy(uneven);
  fg_field_destroy(field);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(an_image_comes_back_bit_for_bit),
      TEST(netcdf_comes_back_bit_for_bit),
      TEST(an_image_keeps_its_map),
      TEST(analytic_fields_go_through_both_formats),
      TEST(volumes_come_back_bit_for_bit),
      TEST(periodic_axes_are_closed),
      TEST(what_cannot_be_written_leaves_nothing),
  };
  return cmocka_run_group_tests_name("write/field", tests, NULL, NULL);
}
