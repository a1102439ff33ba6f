#include <math.h>
#include <stdlib.h>

#include "decode/vtk/vtk.h"
#include "file/folder_test.h"

/* What a file has of a density. */
typedef struct written {
  fg__source source;
  fg__dataset data;
  double *u, *cluster, *ghost;
} written;

static double *values_of(const fg__dataset *data, const char *name)
{
  const fg__variable *v = fg__dataset_find(data, name);
  assert_non_null(v);
  const size_t start[3] = {0, 0, 0};
  size_t size[3], count = 1;
  for (int k = 0; k < 3; ++k)
    count *= size[k] = data->dimensions[v->dimension[k]].length;
  double *out = malloc(count * sizeof *out);
  assert_non_null(out);
  assert_int_equal(fg__variable_fetch(v, start, size, out), FG_STATUS_OK);
  return out;
}

static void write_and_open(written *out, folder *f, const fg_density *density)
{
  *out = (written){.u = NULL};
  assert_int_equal(fg_density_write(f->context, path_of(f, "u.vti"), density),
                   FG_STATUS_OK);
  assert_int_equal(fg__source_open(&out->source, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg__vtk_open(&out->data, f->context, &out->source, NULL),
                   FG_STATUS_OK);
  out->u = values_of(&out->data, "u");
  out->cluster = values_of(&out->data, "cluster");
  out->ghost = values_of(&out->data, "vtkGhostType");
}

/* A number that the file has of itself, or of an axis. */
static double number_of(const fg__variable *of, const char *name)
{
  double out = (double)NAN;
  assert_int_equal(fg__attribute_numbers(of, name, &out, 1), 1);
  return out;
}

static double axis_number(const written *w, int axis, const char *name)
{
  return number_of(&w->data.variables[w->data.space.axis[axis]], name);
}

static void close_written(written *w)
{
  free(w->ghost);
  free(w->cluster);
  free(w->u);
  fg__dataset_close(&w->data);
  fg__source_close(&w->source, NULL, FG_STATUS_OK);
}

/* 6 x 5 nodes, periodic along x: a cluster across the boundary, one within, a masked
 * cell.
 */
static void a_density_shows_clusters_and_mask(void **state)
{
  folder *f = *state;
  enum { WIDE = 6, HIGH = 5 };
  float u[WIDE * HIGH];
  unsigned char active[WIDE * (HIGH - 1)];
  memset(active, 1, sizeof active);
  active[2 * WIDE + 4] = 0;
  for (size_t i = 0; i < WIDE * HIGH; ++i)
    u[i] = -0.5f;
  u[0] = u[5] = u[6] = u[11] = 0.75f;
  u[3 * WIDE + 2] = u[3 * WIDE + 3] = 0.25f;
  fg_density *density = NULL;
  assert_int_equal(
      fg_density_create_from_arrays(&density, f->context,
                                    &(fg_density_arrays){.dimension = 2,
                                                         .nodes = {WIDE, HIGH},
                                                         .origin = {-1, 2},
                                                         .spacing = {0.5, 0.25},
                                                         .periodic = {true, false},
                                                         .u = u,
                                                         .active = active,
                                                         .time = 1e-4}),
      FG_STATUS_OK);
  assert_int_equal(fg_density_write(f->context, path_of(f, "u.png"), density),
                   FG_STATUS_UNSUPPORTED);
  fg_context_clear(f->context);
  written w;
  write_and_open(&w, f, density);
  assert_int_equal(w.data.space.points[0],
                   WIDE + 1); /* the first column again at the end */
  assert_int_equal(w.data.space.points[1], HIGH);
  assert_true(axis_number(&w, 0, "origin") == -1.0 &&
              axis_number(&w, 1, "spacing") == 0.25);
  for (size_t y = 0; y < HIGH; ++y)
    for (size_t x = 0; x <= WIDE; ++x) {
      size_t at = y * (WIDE + 1) + x, node = y * WIDE + x % WIDE;
      assert_true(w.u[at] == (double)u[node]);
      double label = u[node] < 0.0f ? 0.0 : y < 2 ? 1.0 : 2.0;
      assert_true(w.cluster[at] == label);
    }
  for (size_t i = 0; i < sizeof active; ++i)
    assert_true(w.ghost[i] == (active[i] ? 0.0 : 32.0));
  assert_true(fabs(number_of(w.data.groups, "TimeValue") - 1e-4) < 1e-9);
  close_written(&w);
  fg_density_destroy(density);
}

/* Three drops in 7 x 4 x 6 nodes, periodic along z: one across that boundary, one within,
 * one that is debris; a masked cell. */
static void a_density_in_space_comes_back(void **state)
{
  folder *f = *state;
  enum { WIDE = 7, HIGH = 4, DEEP = 6, CELLS = (WIDE - 1) * (HIGH - 1) * DEEP };
  float u[WIDE * HIGH * DEEP];
  unsigned char active[CELLS];
  memset(active, 1, sizeof active);
  active[(2 * 3 + 1) * 6 + 5] = 0;
  for (size_t i = 0; i < WIDE * HIGH * DEEP; ++i)
    u[i] = -0.5f - 0.001f * (float)i;
#define AT(x, y, z) (((z)*HIGH + (y)) * WIDE + (x))
  u[AT(1, 1, 0)] = u[AT(1, 1, 5)] = u[AT(1, 2, 5)] = 0.75f;
  u[AT(4, 1, 2)] = u[AT(4, 1, 3)] = u[AT(4, 2, 3)] = 0.5f;
  u[AT(6, 3, 1)] = 0.001f;
  fg_density *density = NULL;
  const fg_density_arrays arrays = {.dimension = 3,
                                    .nodes = {WIDE, HIGH, DEEP},
                                    .origin = {-1, 2, 30},
                                    .spacing = {0.5, 0.25, 2.0},
                                    .periodic = {false, false, true},
                                    .u = u,
                                    .active = active,
                                    .debris_area = 0.1 * 0.25,
                                    .time = 3e-5};
  assert_int_equal(fg_density_create_from_arrays(&density, f->context, &arrays),
                   FG_STATUS_OK);
  written w;
  write_and_open(&w, f, density);
  const size_t points[3] = {WIDE, HIGH, DEEP + 1};
  assert_memory_equal(w.data.space.points, points, sizeof points);
  assert_true(axis_number(&w, 2, "origin") == 30.0 &&
              axis_number(&w, 2, "spacing") == 2.0);
  for (size_t z = 0; z <= DEEP; ++z)
    for (size_t y = 0; y < HIGH; ++y)
      for (size_t x = 0; x < WIDE; ++x) {
        size_t at = AT(x, y, z), node = AT(x, y, z % DEEP);
        double label = u[node] < 0.0f ? 0.0 : x == 1 ? 1.0 : x == 4 ? 2.0 : -1.0;
        assert_true(w.u[at] == (double)u[node]);
        assert_true(w.cluster[at] == label);
      }
#undef AT
  for (size_t i = 0; i < CELLS; ++i)
    assert_true(w.ghost[i] == (active[i] ? 0.0 : 32.0));
  close_written(&w);
  fg_density_destroy(density);
}

/* A field of any values over so many samples, of that period along one axis. */
static fg_field *field_with_period(fg_context *context, int dimension, int axis,
                                   double period)
{
  static const double place[3] = {0.0, 1.0, 2.0};
  static float velocity[27];
  for (int n = 0; n < 27; ++n)
    velocity[n] = 1.0f;
  fg_field_arrays arrays = {.dimension = dimension};
  for (int k = 0; k < dimension; ++k) {
    arrays.size[k] = 3;
    arrays.axis[k] = place;
    arrays.velocity[k] = velocity;
  }
  arrays.period[axis] = period;
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* In either dimension, with a mask and a periodic axis: what was written comes back to
 * the bit, but what is too small for a cluster lies outside. */
static void what_was_written_is_read_again(void **state)
{
  folder *f = *state;
  enum { WIDE = 6, HIGH = 5, DEEP = 4 };
  for (int dimension = 2; dimension <= 3; ++dimension) {
    int last = dimension - 1; /* the periodic axis */
    fg_density_arrays arrays = {.dimension = dimension,
                                .nodes = {WIDE, HIGH, dimension == 3 ? DEEP : 1},
                                .origin = {-1, 2.1, dimension == 3 ? 0.3 : 0.0},
                                .spacing = {0.1, 0.7, dimension == 3 ? 1.3 : 0.0},
                                .debris_area = dimension == 3 ? 0.1 : 0.08,
                                .time = 3.7e-5};
    arrays.periodic[last] = true;
    size_t nodes = (size_t)WIDE * HIGH * (size_t)arrays.nodes[2];
    size_t cells = dimension == 2 ? (WIDE - 1) * HIGH : (WIDE - 1) * (HIGH - 1) * DEEP;
    float u[WIDE * HIGH * DEEP];
    unsigned char active[WIDE * HIGH * DEEP];
    memset(active, 1, sizeof active);
    active[7] = 0;
    for (size_t n = 0; n < nodes; ++n)
      u[n] = -0.5f - 0.001f * (float)n;
    for (size_t n = 0; n < 4; ++n)
      u[nodes - 1 - n] = u[nodes - 1 - n - WIDE] = 0.75f;
    u[WIDE + 1] = 0.25f; /* too small */
    arrays.u = u;
    arrays.active = active;
    fg_density *density = NULL, *again = NULL;
    assert_int_equal(fg_density_create_from_arrays(&density, f->context, &arrays),
                     FG_STATUS_OK);
    assert_int_equal(fg_density_write(f->context, path_of(f, "u.vti"), density),
                     FG_STATUS_OK);
    fg_field *field = field_with_period(f->context, dimension, last, 3.5);
    if (fg_density_read(&again, f->context, f->path, field))
      fail_msg("%s", fg_context_message(f->context));
    const fg_density_arrays *a = fg_density_contents(again);
    assert_int_equal(a->dimension, dimension);
    assert_memory_equal(a->nodes, arrays.nodes, sizeof a->nodes);
    assert_memory_equal(a->origin, arrays.origin, sizeof a->origin);
    assert_memory_equal(a->spacing, arrays.spacing, sizeof a->spacing);
    assert_memory_equal(a->periodic, arrays.periodic, sizeof a->periodic);
    assert_memory_equal(a->active, active, cells);
    assert_true(a->time == arrays.time);
    assert_int_equal(a->clusters, 1);
    assert_true(a->debris_area == arrays.debris_area);
    assert_memory_equal(a->u, u, nodes * sizeof *u);
    fg_density_destroy(again);
    fg_field_destroy(field);
    /* a density of a field with another dimension */
    field = field_with_period(f->context, 5 - dimension, 0, 0.0);
    assert_int_equal(fg_density_read(&again, f->context, f->path, field),
                     FG_STATUS_FILE_FORMAT);
    assert_null(again);
    fg_context_clear(f->context);
    /* an image of something else */
    assert_int_equal(fg_field_write(f->context, f->path, field), FG_STATUS_OK);
    fg_field_destroy(field);
    field = field_with_period(f->context, 5 - dimension, 0, 0.0);
    assert_int_equal(fg_density_read(&again, f->context, f->path, field),
                     FG_STATUS_FILE_FORMAT);
    assert_non_null(strstr(fg_context_message(f->context), "is no density"));
    fg_context_clear(f->context);
    fg_field_destroy(field);
    fg_density_destroy(density);
  }
}

/* Numbers that other programs may write where ours writes small whole ones. */
static void what_is_no_cluster_or_mark_is_refused(void **state)
{
  static const struct {
    const char *cluster, *ghost, *words;
  } cases[] = {{"1", "32", ""},
               {"2147483647", "255", ""},
               {"1e10", "0", "a cluster number 1e+10"},
               {"1", "-1", "vtkGhostType of cell 1 of 2 is -1"},
               {"1", "256", "is 256"},
               {"1", "nan", "is nan"},
               {"1", "1e300", "is 1e+300"}};
  folder *f = *state;
  fg_field *field = field_with_period(f->context, 2, 0, 0.0);
  for (size_t n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
    FILE *file = fopen(path_of(f, "u.vti"), "w");
    assert_non_null(file);
    fprintf(file,
            "<VTKFile type='ImageData'><ImageData WholeExtent='0 2 0 1 0 0'>"
            "<Piece Extent='0 2 0 1 0 0'><PointData>"
            "<DataArray type='Float32' Name='u'>1 1 -1 0.5 1 -1</DataArray>"
            "<DataArray type='Float64' Name='cluster'>0 0 %s 0 0 0</DataArray>"
            "</PointData><CellData>"
            "<DataArray type='Float64' Name='vtkGhostType'>0 %s</DataArray>"
            "</CellData></Piece></ImageData></VTKFile>",
            cases[n].cluster, cases[n].ghost);
    assert_int_equal(fclose(file), 0);
    fg_density *density = NULL;
    fg_context_clear(f->context);
    fg_status status = fg_density_read(&density, f->context, f->path, field);
    assert_int_equal(status, cases[n].words[0] ? FG_STATUS_FILE_FORMAT : FG_STATUS_OK);
    if (!strstr(fg_context_message(f->context), cases[n].words))
      fail_msg("%s", fg_context_message(f->context));
    if (density)
      assert_int_equal(fg_density_contents(density)->active[1], 0);
    fg_density_destroy(density);
  }
  fg_field_destroy(field);
}

/* Stages that know two dimensions only say so. */
static void icons_and_pictures_in_space_are_refused(void **state)
{
  folder *f = *state;
  float u[8] = {1, 1, -1, -1, -1, -1, -1, -1};
  fg_density *density = NULL;
  const fg_density_arrays arrays = {
      .dimension = 3, .nodes = {2, 2, 2}, .spacing = {1, 1, 1}, .u = u};
  assert_int_equal(fg_density_create_from_arrays(&density, f->context, &arrays),
                   FG_STATUS_OK);
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, f->context, "vortex", 9),
                   FG_STATUS_OK);
  fg_icons *icons = NULL;
  assert_int_equal(fg_icons_create(&icons, f->context, field, density, NULL),
                   FG_STATUS_ARGUMENT);
  assert_null(icons);
  assert_non_null(strstr(fg_context_message(f->context), "3 dimensions"));
  fg_context_clear(f->context);
  fg_density *flat = NULL;
  fg_density_arrays plane = arrays;
  plane.dimension = 2;
  assert_int_equal(fg_density_create_from_arrays(&flat, f->context, &plane),
                   FG_STATUS_OK);
  assert_int_equal(fg_icons_create(&icons, f->context, field, flat, NULL), FG_STATUS_OK);
  assert_int_equal(
      fg_picture_write(f->context, path_of(f, "a.svg"), field, density, icons, NULL),
      FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(f->context), "3 dimensions"));
  assert_int_equal(access(f->path, F_OK), -1);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
  fg_density_destroy(flat);
  fg_density_destroy(density);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(a_density_shows_clusters_and_mask),
      TEST(a_density_in_space_comes_back),
      TEST(what_was_written_is_read_again),
      TEST(what_is_no_cluster_or_mark_is_refused),
      TEST(icons_and_pictures_in_space_are_refused),
  };
  return cmocka_run_group_tests_name("write/density", tests, NULL, NULL);
}
