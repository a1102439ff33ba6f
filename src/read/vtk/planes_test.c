/* Planes across each axis of space, whose vectors are several arrays: in every kind of
 * file the plane's own components are taken. */
#include "read/vtk/legacy_example.h"

enum { NS = 4, NT = 3, POINTS_OF_PLANE = NS * NT };

typedef enum kind {
  IMAGE,
  THICK_IMAGE, /* two layers of points */
  RECTILINEAR,
  STRUCTURED,
  LEGACY,
  QUADS,
  POLYGONS,
  HEXAHEDRA, /* a layer of cells */
  WEDGES,
  KINDS
} kind;

/* The plane: its axes ascending, and the one that it is across. */
typedef struct plane {
  int axis[2], across;
} plane;

static const plane PLANES[] = {{{0, 1}, 2}, {{0, 2}, 1}, {{1, 2}, 0}};

static int layers_of(kind k)
{
  return k == THICK_IMAGE || k == HEXAHEDRA || k == WEDGES ? 2 : 1;
}

/* Points of a layer along an axis of space. */
static int count_along(const plane *p, kind k, int axis)
{
  return axis == p->axis[0] ? NS : axis == p->axis[1] ? NT : layers_of(k);
}

/* Component c at a place of the plane; not 0. */
static double component_at(int c, int s, int t)
{
  return 1.0 + 10.0 * c + s - 0.25 * t;
}

/* Calls `put` for all points in the order of files: x fastest. */
static void each_point(example_text *file, const plane *p, kind k,
                       void (*put)(example_text *file, const plane *p, const int at[3],
                                   int component),
                       int component)
{
  int at[3];
  for (at[2] = 0; at[2] < count_along(p, k, 2); ++at[2])
    for (at[1] = 0; at[1] < count_along(p, k, 1); ++at[1])
      for (at[0] = 0; at[0] < count_along(p, k, 0); ++at[0])
        put(file, p, at, component);
}

static void put_number(example_text *file, double number)
{
  char word[32];
  snprintf(word, sizeof word, "%.9g ", number);
  example_words(file, word);
}

static void put_component(example_text *file, const plane *p, const int at[3],
                          int component)
{
  put_number(file, component_at(component, at[p->axis[0]], at[p->axis[1]]));
}

static void put_place(example_text *file, const plane *p, const int at[3], int unused)
{
  (void)p;
  (void)unused;
  for (int k = 0; k < 3; ++k)
    put_number(file, at[k]);
}

static void begin_array(example_text *file, kind k, const char *name, int components)
{
  char words[160];
  if (k == LEGACY)
    snprintf(words, sizeof words, "SCALARS %s double\nLOOKUP_TABLE default\n", name);
  else
    snprintf(words, sizeof words,
             "<DataArray type='Float64' Name='%s' NumberOfComponents='%d'>", name,
             components);
  example_words(file, words);
}

static void end_array(example_text *file, kind k)
{
  example_words(file, k == LEGACY ? "\n" : "</DataArray>");
}

/* The number of a point in the order of files. */
static int number_of(const plane *p, kind k, int s, int t, int layer)
{
  int at[3], out = 0;
  at[p->axis[0]] = s;
  at[p->axis[1]] = t;
  at[p->across] = layer;
  for (int axis = 2; axis >= 0; --axis)
    out = out * count_along(p, k, axis) + at[axis];
  return out;
}

/* Corners of the two triangles of a square that are left or right of its diagonal. */
static const int SQUARE[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const int HALVES[2][3] = {{0, 1, 2}, {0, 2, 3}};

static int cells_of(kind k)
{
  return (NS - 1) * (NT - 1) * (k == WEDGES ? 2 : 1);
}

static int corners_of(kind k)
{
  return k == HEXAHEDRA ? 8 : k == WEDGES ? 6 : 4;
}

static void put_cells(example_text *file, const plane *p, kind k)
{
  const int halves = k == WEDGES ? 2 : 1, around = k == WEDGES ? 3 : 4;
  for (int cell = 0; cell < cells_of(k) / halves; ++cell)
    for (int half = 0; half < halves; ++half)
      for (int layer = 0; layer < layers_of(k); ++layer)
        for (int c = 0; c < around; ++c) {
          const int *corner = SQUARE[halves == 2 ? HALVES[half][c] : c];
          put_number(file, number_of(p, k, cell % (NS - 1) + corner[0],
                                     cell / (NS - 1) + corner[1], layer));
        }
}

static void put_topology(example_text *file, const plane *p, kind k)
{
  example_words(file, k == POLYGONS ? "<Polys>" : "<Cells>");
  begin_array(file, k, "connectivity", 1);
  put_cells(file, p, k);
  end_array(file, k);
  begin_array(file, k, "offsets", 1);
  for (int cell = 1; cell <= cells_of(k); ++cell)
    put_number(file, cell * corners_of(k));
  end_array(file, k);
  if (k != POLYGONS) {
    begin_array(file, k, "types", 1);
    for (int cell = 0; cell < cells_of(k); ++cell)
      put_number(file, k == HEXAHEDRA ? 12 : k == WEDGES ? 13 : 9);
    end_array(file, k);
  }
  example_words(file, k == POLYGONS ? "</Polys>" : "</Cells>");
}

static void put_points(example_text *file, const plane *p, kind k)
{
  example_words(file, "<Points>");
  begin_array(file, k, "points", 3);
  each_point(file, p, k, put_place, 0);
  end_array(file, k);
  example_words(file, "</Points>");
}

static void put_axes(example_text *file, const plane *p, kind k)
{
  example_words(file, "<Coordinates>");
  for (int axis = 0; axis < 3; ++axis) {
    begin_array(file, k, "axis", 1);
    for (int i = 0; i < count_along(p, k, axis); ++i)
      put_number(file, i);
    end_array(file, k);
  }
  example_words(file, "</Coordinates>");
}

static const char *const TYPES[KINDS] = {[IMAGE] = "ImageData",
                                         [THICK_IMAGE] = "ImageData",
                                         [RECTILINEAR] = "RectilinearGrid",
                                         [STRUCTURED] = "StructuredGrid",
                                         [LEGACY] = "",
                                         [QUADS] = "UnstructuredGrid",
                                         [POLYGONS] = "PolyData",
                                         [HEXAHEDRA] = "UnstructuredGrid",
                                         [WEDGES] = "UnstructuredGrid"};

static void begin_file(example_text *file, const plane *p, kind k)
{
  char words[400], extent[64];
  const int n[3] = {count_along(p, k, 0), count_along(p, k, 1), count_along(p, k, 2)};
  snprintf(extent, sizeof extent, "0 %d 0 %d 0 %d", n[0] - 1, n[1] - 1, n[2] - 1);
  if (k == LEGACY)
    snprintf(words, sizeof words,
             "# vtk DataFile Version 3.0\nplane\nASCII\nDATASET STRUCTURED_POINTS\n"
             "DIMENSIONS %d %d %d\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA %d\n",
             n[0], n[1], n[2], n[0] * n[1] * n[2]);
  else if (k == POLYGONS)
    snprintf(words, sizeof words,
             "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='%d' "
             "NumberOfPolys='%d'><PointData>",
             n[0] * n[1] * n[2], cells_of(k));
  else if (k > LEGACY)
    snprintf(words, sizeof words,
             "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece "
             "NumberOfPoints='%d' NumberOfCells='%d'><PointData>",
             n[0] * n[1] * n[2], cells_of(k));
  else
    snprintf(words, sizeof words,
             "<VTKFile type='%s'><%s WholeExtent='%s'><Piece Extent='%s'><PointData>",
             TYPES[k], TYPES[k], extent, extent);
  example_words(file, words);
}

static void end_file(example_text *file, const plane *p, kind k)
{
  char words[80];
  if (k == LEGACY)
    return;
  example_words(file, "</PointData>");
  if (k == RECTILINEAR)
    put_axes(file, p, k);
  if (k == STRUCTURED || k > LEGACY)
    put_points(file, p, k);
  if (k > LEGACY)
    put_topology(file, p, k);
  snprintf(words, sizeof words, "</Piece></%s></VTKFile>", TYPES[k]);
  example_words(file, words);
}

/* names[c]: of component c, "": there is no such array. */
static fg_status read_plane(fg_field **out, fg_context *context, const plane *p, kind k,
                            const char *const names[3], const char *vars)
{
  example_text file = {0};
  begin_file(&file, p, k);
  for (int c = 0; c < 3; ++c)
    if (names[c][0]) {
      begin_array(&file, k, names[c], 1);
      each_point(&file, p, k, put_component, c);
      end_array(&file, k);
    }
  end_file(&file, p, k);
  const fg__source source = {
      .path = "plane", .bytes = (const unsigned char *)file.bytes, .size = file.size};
  const fg__format *format = k == LEGACY ? &fg__format_vtk_legacy : &fg__format_vti;
  const fg_read_options options = {.vars = vars};
  fg_context_clear(context);
  const fg_status status =
      fg__dataset_read(out, context, format, &source, &options, (fg__slab_index){0, 1});
  example_free(&file);
  return status;
}

/* Components a and b, found between samples of a raster as well. */
static void assert_components(const fg_field *field, const plane *p, const int c[2],
                              const char *const names[3])
{
  const fg_field_arrays *f = fg_field_contents(field);
  static const char *const axes[] = {"x", "y", "z"};
  const double at[3] = {1.5, 0.75, 0.0};
  double u[3] = {0};
  assert_int_equal(f->dimension, 2);
  assert_true(fg_field_velocity(field, at, u));
  for (int k = 0; k < 2; ++k) {
    assert_string_equal(f->axis_name[k], axes[p->axis[k]]);
    assert_string_equal(f->velocity_name[k], names[c[k]]);
    assert_true(fabs(u[k] - (1.0 + 10.0 * c[k] + at[0] - 0.25 * at[1])) < 1e-5);
  }
}

static void three_arrays_have_the_planes_components(void **state)
{
  static const char *const names[][3] = {
      {"Ux", "Uy", "Uz"}, {"u", "v", "w"}, {"vel_0", "vel_1", "vel_2"}};
  for (size_t n = 0; n < sizeof names / sizeof *names; ++n)
    for (int p = 0; p < 3; ++p)
      for (int k = 0; k < KINDS; ++k) {
        fg_field *field = NULL;
        if (read_plane(&field, *state, &PLANES[p], (kind)k, names[n], NULL))
          fail_msg("%d %d: %s", p, k, fg_context_message(*state));
        assert_components(field, &PLANES[p], PLANES[p].axis, names[n]);
        assert_true(fg_field_normal_share(field) > 0.0);
        fg_field_destroy(field);
      }
}

static void two_arrays_have_them_or_are_refused(void **state)
{
  for (int there = 0; there < 3; ++there) /* two components: those of this plane */
    for (int p = 0; p < 3; ++p)
      for (int k = 0; k < KINDS; ++k) {
        static const char *const all[3] = {"flow_x", "flow_y", "flow_z"};
        const char *names[3] = {all[0], all[1], all[2]};
        char vars[32];
        const int *c = PLANES[there].axis;
        fg_field *field = NULL;
        names[PLANES[there].across] = "";
        const fg_status status =
            read_plane(&field, *state, &PLANES[p], (kind)k, names, NULL);
        if (p == there) {
          assert_int_equal(status, FG_STATUS_OK);
          assert_components(field, &PLANES[p], c, names);
          fg_field_destroy(field);
          continue;
        }
        assert_int_equal(status, FG_STATUS_UNSUPPORTED);
        assert_non_null(strstr(fg_context_message(*state), "which are not those of"));
        snprintf(vars, sizeof vars, "%s,%s", names[c[0]], names[c[1]]);
        assert_non_null(strstr(fg_context_hint(*state), vars));
        assert_int_equal(read_plane(&field, *state, &PLANES[p], (kind)k, names, vars),
                         FG_STATUS_OK);
        assert_components(field, &PLANES[p], c, names);
        fg_field_destroy(field);
      }
}

/* All of a vector is normal to the plane. */
static void a_plane_without_vectors_in_it_is_refused(void **state)
{
  static const char *const only[3] = {"1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0",
                                      "0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0",
                                      "0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6"};
  static const char *const extent[3] = {"0 0 0 2 0 1", "0 2 0 0 0 1", "0 2 0 1 0 0"};
  static const char *const words[3] = {"normal to the plane of y and z",
                                       "normal to the plane of x and z",
                                       "normal to the plane of x and y"};
  for (int across = 0; across < 3; ++across)
    for (int c = 0; c < 3; ++c) {
      char file[EXAMPLE_FILE_BYTES], array[400];
      fg_field *field = NULL;
      snprintf(array, sizeof array, POINTS(VECTOR("V", "%s")), only[c]);
      example_image(file, "", extent[across], array);
      const fg_status status = example_read_words(&field, *state, file, NULL);
      assert_int_equal(status == FG_STATUS_OK, c != across);
      if (c == across)
        assert_non_null(strstr(fg_context_message(*state), words[across]));
      fg_field_destroy(field);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(three_arrays_have_the_planes_components),
      cmocka_unit_test(two_arrays_have_them_or_are_refused),
      cmocka_unit_test(a_plane_without_vectors_in_it_is_refused),
  };
  return cmocka_run_group_tests_name("read/vtk/planes", tests, context_set_up,
                                     context_tear_down);
}
