#include <math.h>

#include "read/netcdf/sample_example.h"

/* What is put in: linear in the place, so that linear cells give it back exactly. */
static double velocity_at(const double p[3], int k, int time)
{
  static const double slope[3][3] = {{0.5, -1.0, 0.25}, {2.0, 0.75, -0.5}, {-1.5, 1, 1}};
  double out = 3.0 + k;
  for (int j = 0; j < 3; ++j)
    out += slope[k][j] * p[j];
  return out * (1 + time);
}

typedef struct block {
  const char *type, *name;
  int cells, nodes;
  const int *connect;
} block;

/* A file with two times, velocities at nodes, displacements of no meaning. */
static void write_mesh(sample_file *f, int mode, int dimension, int points,
                       double (*point)[3], const block *blocks, int count)
{
  static const char *const names[] = {"disp_x", "disp_y", "VEL_X", "VEL_Y", "VEL_Z"};
  const int variables = 2 + dimension;
  double *line = calloc((size_t)points, sizeof *line);
  sample_begin(f, mode);
  const int time = sample_dimension(f, "time_step", NC_UNLIMITED);
  const int nodes = sample_dimension(f, "num_nodes", (size_t)points);
  const int letters = sample_dimension(f, "len_name", 33);
  const int all = sample_dimension(f, "num_el_blk", (size_t)count);
  const int named = sample_dimension(f, "num_nod_var", (size_t)variables);
  sample_dimension(f, "num_dim", (size_t)dimension);
  const int times = sample_variable(f, "time_whole", NC_DOUBLE, 1, &time);
  const int block_names =
      sample_variable(f, "eb_names", NC_CHAR, 2, (int[]){all, letters});
  const int of = sample_variable(f, "name_nod_var", NC_CHAR, 2, (int[]){named, letters});
  for (int k = 0; k < dimension; ++k) {
    const char name[] = {'c', 'o', 'o', 'r', 'd', (char)('x' + k), 0};
    const int axis = sample_variable(f, name, NC_DOUBLE, 1, &nodes);
    for (int n = 0; n < points; ++n)
      line[n] = point[n][k];
    sample_put(f, axis, line);
  }
  for (int b = 0; b < count; ++b) {
    char name[32];
    snprintf(name, sizeof name, "num_el_in_blk%d", b + 1);
    const int cells = sample_dimension(f, name, (size_t)blocks[b].cells);
    snprintf(name, sizeof name, "num_nod_per_el%d", b + 1);
    const int per = sample_dimension(f, name, (size_t)blocks[b].nodes);
    snprintf(name, sizeof name, "connect%d", b + 1);
    const int connect = sample_variable(f, name, NC_INT, 2, (int[]){cells, per});
    sample_text(f, connect, "elem_type", blocks[b].type);
    sample_write(f);
    nc_must(nc_put_var_int(f->id, connect, blocks[b].connect));
    nc_must(nc_put_vara_text(f->id, block_names, (size_t[]){(size_t)b, 0},
                             (size_t[]){1, strlen(blocks[b].name)}, blocks[b].name));
  }
  for (int v = 0; v < variables; ++v) {
    char name[32];
    snprintf(name, sizeof name, "vals_nod_var%d", v + 1);
    const int values = sample_variable(f, name, NC_DOUBLE, 2, (int[]){time, nodes});
    sample_write(f);
    nc_must(nc_put_vara_text(f->id, of, (size_t[]){(size_t)v, 0},
                             (size_t[]){1, strlen(names[v])}, names[v]));
    for (size_t t = 0; t < 2; ++t) {
      const double at = 0.5 * (double)t;
      for (int n = 0; n < points; ++n)
        line[n] = v < 2 ? 7.0 * n : velocity_at(point[n], v - 2, (int)t);
      nc_must(nc_put_vara_double(f->id, values, (size_t[]){t, 0},
                                 (size_t[]){1, (size_t)points}, line));
      nc_must(nc_put_vara_double(f->id, times, &t, (size_t[]){1}, &at));
    }
  }
  sample_end(f);
  free(line);
}

/* Samples that are there have the velocity of their place; returns their share. */
static double check_field(const fg_field *field, int time)
{
  const fg_field_arrays *a = fg_field_contents(field);
  const int deep = a->dimension == 3 ? a->size[2] : 1;
  size_t n = 0, there = 0;
  for (int z = 0; z < deep; ++z)
    for (int y = 0; y < a->size[1]; ++y)
      for (int x = 0; x < a->size[0]; ++x, ++n) {
        const double p[3] = {a->axis[0][x], a->axis[1][y],
                             a->dimension == 3 ? a->axis[2][z] : 0.0};
        if (a->valid && !a->valid[n])
          continue;
        ++there;
        for (int k = 0; k < 3 && k < a->dimension; ++k)
          if (fabs((double)a->velocity[k][n] - velocity_at(p, k, time)) >= 1e-4)
            fail_msg("%g %g %g: component %d is %g, not %g", p[0], p[1], p[2], k,
                     (double)a->velocity[k][n], velocity_at(p, k, time));
      }
  return (double)there / (double)n;
}

static fg_field *read_mesh(sample_file *f, const fg_read_options *options)
{
  fg_field *field = NULL;
  fg__source source;
  if (fg_field_read(&field, f->context, f->path, options))
    fail_msg("%s", fg_context_message(f->context));
  assert_int_equal(fg__source_open(&source, f->context, f->path), FG_STATUS_OK);
  assert_slabs_alike(&fg__format_exodus, &source, options, field);
  fg__source_close(&source, NULL, FG_STATUS_OK);
  return field;
}

static double PLANE[6][3] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {3, 0}, {3, 1}};
static const int SQUARE[] = {1, 2, 3, 4}, TRIANGLES[] = {2, 5, 3, 5, 6, 3};
static const block PLANE_BLOCKS[] = {{"QUAD4", "left", 1, 4, SQUARE},
                                     {"tri", "right", 2, 3, TRIANGLES}};

static void times_and_blocks_are_chosen(void **state)
{
  sample_file *f = *state;
  static const int modes[] = {NC_64BIT_OFFSET, NC_NETCDF4};
  for (size_t m = 0; m < 2; ++m) {
    write_mesh(f, modes[m], 2, 6, PLANE, PLANE_BLOCKS, 2);
    for (int time = 0; time < 2; ++time) {
      fg_field *field = read_mesh(f, &(fg_read_options){.time = time});
      const fg_field_arrays *a = fg_field_contents(field);
      assert_true(check_field(field, time) == 1.0);
      assert_true(a->axis[0][0] == 0.0 && a->axis[0][a->size[0] - 1] == 3.0);
      assert_string_equal(a->velocity_name[1], "VEL_Y");
      assert_string_equal(a->time, time ? "t = 0.5" : "t = 0");
      fg_field_destroy(field);
    }
    fg_field *right = read_mesh(f, &(fg_read_options){.block = "right"});
    assert_true(fg_field_contents(right)->axis[0][0] == 2.0);
    fg_field_destroy(right);
  }
}

/* A cube and a prism by the order of the standard (its figures 5 and 6): corners, edges
 * below, upright edges, edges above, centre, faces below, above, left, right, front and
 * back. */
static const double CUBE[27][3] = {
    {0, 0, 0},   {1, 0, 0},   {1, 1, 0},    {0, 1, 0},   {0, 0, 1},   {1, 0, 1},
    {1, 1, 1},   {0, 1, 1},   {.5, 0, 0},   {1, .5, 0},  {.5, 1, 0},  {0, .5, 0},
    {0, 0, .5},  {1, 0, .5},  {1, 1, .5},   {0, 1, .5},  {.5, 0, 1},  {1, .5, 1},
    {.5, 1, 1},  {0, .5, 1},  {.5, .5, .5}, {.5, .5, 0}, {.5, .5, 1}, {0, .5, .5},
    {1, .5, .5}, {.5, 0, .5}, {.5, 1, .5}};
static const double PRISM[15][3] = {{0, 0, 0},  {1, 0, 0},   {0, 1, 0},  {0, 0, 1},
                                    {1, 0, 1},  {0, 1, 1},   {.5, 0, 0}, {.5, .5, 0},
                                    {0, .5, 0}, {0, 0, .5},  {1, 0, .5}, {0, 1, .5},
                                    {.5, 0, 1}, {.5, .5, 1}, {0, .5, 1}};

static void nodes_come_in_the_order_of_the_standard(void **state)
{
  sample_file *f = *state;
  enum { STACKED = 8 }; /* two each way: a layer would be read as a plane */
  int nodes[STACKED * 27];
  double point[STACKED * 27][3];
  static const struct {
    const char *type;
    int nodes;
    const double (*point)[3];
    double least, most; /* share of the box that the cell fills */
  } cases[] = {{"HEX", 8, CUBE, 1.0, 1.0},
               {"HEX20", 20, CUBE, 1.0, 1.0},
               {"HEX27", 27, CUBE, 1.0, 1.0},
               {"wedge", 15, PRISM, 0.45, 0.65}};
  for (int n = 0; n < STACKED * 27; ++n)
    nodes[n] = n + 1;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    const block both = {cases[i].type, "", STACKED, cases[i].nodes, nodes};
    for (int n = 0; n < STACKED * cases[i].nodes; ++n)
      for (int k = 0; k < 3; ++k)
        point[n][k] =
            cases[i].point[n % cases[i].nodes][k] + (n / cases[i].nodes >> k & 1);
    write_mesh(f, NC_CLASSIC_MODEL, 3, STACKED * cases[i].nodes, point, &both, 1);
    fg_field *field = read_mesh(f, &(fg_read_options){.time = 0});
    const double share = check_field(field, 0);
    assert_true(share >= cases[i].least && share <= cases[i].most);
    fg_field_destroy(field);
  }
}

static void refuse(sample_file *f, const fg_read_options *options, fg_status status,
                   const char *words)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, options), status);
  const char *message = fg_context_message(f->context);
  if (field || !strstr(message, words) || strncmp(message, f->path, strlen(f->path)) != 0)
    fail_msg("\"%s\" lacks \"%s\" or the file's name", message, words);
}

static void what_does_not_fit_is_refused(void **state)
{
  sample_file *f = *state;
  static const int beyond[] = {1, 2, 7, 4}, below[] = {1, 0, 3, 4};
  const block wrong[] = {{"QUAD", "", 1, 4, beyond},
                         {"QUAD", "", 1, 4, below},
                         {"NSIDED", "", 1, 4, SQUARE}};
  static const char *const words[] = {"point 6 of 6", "point -1 of 6", "type \"NSIDED\""};
  write_mesh(f, NC_CLASSIC_MODEL, 2, 6, PLANE, PLANE_BLOCKS, 2);
  refuse(f, &(fg_read_options){.time = 2}, FG_STATUS_ARGUMENT, "time 2 is asked for");
  refuse(f, &(fg_read_options){.block = "up"}, FG_STATUS_ARGUMENT, "no block \"up\"");
  for (size_t i = 0; i < 3; ++i) {
    write_mesh(f, NC_CLASSIC_MODEL, 2, 6, PLANE, &wrong[i], 1);
    refuse(f, NULL, i < 2 ? FG_STATUS_FILE_FORMAT : FG_STATUS_UNSUPPORTED, words[i]);
  }
}

/* Cut off at each byte, a file is refused; with a byte changed it may be another. */
static void damaged_files_do_no_harm(void **state)
{
  static const fg_read_options none = {0};
  sample_file *f = *state;
  unsigned char bytes[8192];
  write_mesh(f, NC_CLASSIC_MODEL, 2, 6, PLANE, PLANE_BLOCKS, 2);
  FILE *file = fopen(f->path, "rb");
  assert_non_null(file);
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  assert_true(size > 1000 && size < sizeof bytes);
  for (size_t n = 4; n < 2 * size; n += 3) {
    fg__source source = {.path = "bytes", .bytes = bytes, .size = n < size ? n : size};
    fg_field *field = NULL;
    const unsigned char kept = bytes[n % size];
    if (n >= size)
      bytes[n % size] = (unsigned char)(kept ^ 0x81);
    const fg_status status = fg__dataset_read(&field, f->context, &fg__format_exodus,
                                              &source, &none, (fg__slab_index){0, 1});
    bytes[n % size] = kept; /* cppcheck-suppress redundantAssignment */
    assert_true((field != NULL) == (status == FG_STATUS_OK));
    assert_true(n >= size - 1 || status != FG_STATUS_OK);
    fg_field_destroy(field);
    fg_context_clear(f->context);
  }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(times_and_blocks_are_chosen),
      TEST(nodes_come_in_the_order_of_the_standard),
      TEST(what_does_not_fit_is_refused),
      TEST(damaged_files_do_no_harm),
  };
  return cmocka_run_group_tests_name("read/exodus", tests, NULL, NULL);
}
