/* Points alone are read as the table of them is. */
#include "read/vtk/legacy_example.h"

enum { COUNT = 900, TABLE = 0, VTP, VTU, POLYDATA, KINDS };

static void number(example_text *file, double value, const char *behind)
{
  char word[40];
  snprintf(word, sizeof word, "%.17g%s", value, behind);
  example_words(file, word);
}

/* In a plane, or in space. */
static void place_of(double at[3], int n, bool plane)
{
  at[0] = 3.0 * fmod(0.618034 * n, 1.0);
  at[1] = 2.0 * fmod(0.414214 * n + 0.13 * n * n, 1.0);
  at[2] = plane ? 4.0 : 1.5 * fmod(0.732051 * n + 0.07 * n * n, 1.0);
}

static void velocity_of(double u[3], const double at[3])
{
  u[0] = 1.0 + at[1];
  u[1] = 0.5 - at[0] * at[1];
  u[2] = 0.25 + at[2];
}

static void put_all(example_text *file, bool plane, bool velocities)
{
  for (int n = 0; n < COUNT; ++n) {
    double at[3], u[3];
    place_of(at, n, plane);
    velocity_of(u, at);
    for (int k = 0; k < 3; ++k)
      number(file, velocities ? u[k] : at[k], " ");
  }
}

static void put_numbers(example_text *file, int step, int last)
{
  for (int n = 0; n < COUNT; ++n)
    number(file, step * n + last, " ");
}

static void write_table(example_text *file, bool plane)
{
  example_words(file, plane ? "x,y,U:0,U:1,U:2\n" : "x,y,z,U:0,U:1,U:2\n");
  for (int n = 0; n < COUNT; ++n) {
    double at[3], u[3];
    place_of(at, n, plane);
    velocity_of(u, at);
    for (int k = 0; k < (plane ? 2 : 3); ++k)
      number(file, at[k], ",");
    for (int k = 0; k < 3; ++k)
      number(file, u[k], k < 2 ? "," : "\n");
  }
}

static void write_xml(example_text *file, bool plane, bool polygons)
{
  char words[300];
  const char *type = polygons ? "PolyData" : "UnstructuredGrid";
  snprintf(words, sizeof words,
           "<VTKFile type='%s'><%s><Piece NumberOfPoints='%d' NumberOf%s='%d'><PointData>"
           "<DataArray type='Float64' Name='U' NumberOfComponents='3'>",
           type, type, COUNT, polygons ? "Verts" : "Cells", COUNT);
  example_words(file, words);
  put_all(file, plane, true);
  example_words(file, "</DataArray></PointData><Points><DataArray type='Float64' "
                      "NumberOfComponents='3'>");
  put_all(file, plane, false);
  example_words(file, polygons ? "</DataArray></Points><Verts>"
                               : "</DataArray></Points><Cells>");
  example_words(file, "<DataArray type='Int32' Name='connectivity'>");
  put_numbers(file, 1, 0);
  example_words(file, "</DataArray><DataArray type='Int32' Name='offsets'>");
  put_numbers(file, 1, 1);
  example_words(file, "</DataArray>");
  if (!polygons) {
    example_words(file, "<DataArray type='UInt8' Name='types'>");
    put_numbers(file, 0, 1);
    example_words(file, "</DataArray>");
  }
  snprintf(words, sizeof words, "</%s></Piece></%s></VTKFile>",
           polygons ? "Verts" : "Cells", type);
  example_words(file, words);
}

static void write_legacy(example_text *file, bool plane)
{
  char words[120];
  snprintf(words, sizeof words,
           "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS %d double\n",
           COUNT);
  example_words(file, words);
  put_all(file, plane, false);
  snprintf(words, sizeof words, "\nVERTICES %d %d\n", COUNT, 2 * COUNT);
  example_words(file, words);
  for (int n = 0; n < COUNT; ++n) {
    example_words(file, "1 ");
    number(file, n, "\n");
  }
  snprintf(words, sizeof words, "POINT_DATA %d\nVECTORS U double\n", COUNT);
  example_words(file, words);
  put_all(file, plane, true);
}

static fg_field *read_kind(fg_context *context, int kind, bool plane)
{
  static const fg__format *const formats[KINDS] = {
      &fg__format_table, &fg__format_vti, &fg__format_vti, &fg__format_vtk_legacy};
  example_text file = {0};
  if (kind == TABLE)
    write_table(&file, plane);
  else if (kind == POLYDATA)
    write_legacy(&file, plane);
  else
    write_xml(&file, plane, kind == VTP);
  const fg__source source = {
      .path = "points", .bytes = (const unsigned char *)file.bytes, .size = file.size};
  const fg_read_options options = {0};
  fg_field *field = NULL;
  fg_context_clear(context);
  if (fg__dataset_read(&field, context, formats[kind], &source, &options,
                       (fg__slab_index){0, 1}))
    fail_msg("%d: %s", kind, fg_context_message(context));
  example_free(&file);
  return field;
}

static void points_alone_are_a_table(void **state)
{
  for (int plane = 0; plane < 2; ++plane) {
    fg_field *table = read_kind(*state, TABLE, plane);
    const fg_field_arrays *a = fg_field_contents(table);
    assert_int_equal(a->dimension, plane ? 2 : 3);
    size_t samples = 1;
    for (int k = 0; k < a->dimension; ++k)
      samples *= (size_t)a->size[k];
    for (int kind = VTP; kind < KINDS; ++kind) {
      fg_field *field = read_kind(*state, kind, plane);
      const fg_field_arrays *b = fg_field_contents(field);
      assert_memory_equal(a->size, b->size, sizeof a->size);
      for (int k = 0; k < a->dimension; ++k) {
        assert_memory_equal(a->velocity[k], b->velocity[k], samples * sizeof(float));
        assert_string_equal(a->velocity_name[k], b->velocity_name[k]);
        assert_string_equal(a->axis_name[k], b->axis_name[k]);
      }
      fg_field_destroy(field);
    }
    fg_field_destroy(table);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(points_alone_are_a_table)};
  return cmocka_run_group_tests_name("read/vtk/scattered", tests, context_set_up,
                                     context_tear_down);
}
