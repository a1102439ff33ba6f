#include <math.h>

#include <cjson/cJSON.h>

#include "file/folder_test.h"
#include "icon/icons.h"
#include "picture/palette.h"
#include "picture/solid_field_test.h"

static int set_up(void **state)
{
  int failed = folder_set_up(state);
  if (!failed)
    path_of(*state, "icons.glb");
  return failed;
}

enum { POINTS = 12, ICONS = 3 };

/* Far from the origin: single precision has steps of 0.06 there. */
static fg_icons *make_icons(fg_context *context)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  for (int n = 0; n < ICONS; ++n) {
    double points[POINTS][3];
    for (int i = 0; i < POINTS; ++i) {
      points[i][0] = 5e5 + 10 * n + cos(0.2 * i);
      points[i][1] = -3e5 + 0.3 * i;
      points[i][2] = 100.0 * n + sin(0.2 * i);
    }
    fg_icon icon = {.cluster = 4 + n,
                    .point_count = POINTS,
                    .points = (const double(*)[3])points,
                    .width = n == 1 ? 0.0 : 0.1, /* one that has no solid */
                    .tail_width = 0.04,
                    .head_length = 0.3,
                    .head_width = 0.25,
                    .center = {5e5, -3e5, 100.0 * n},
                    .area = 7.5 + n,
                    .speed = 1.0 + n,
                    .spine = (const double(*)[3])points,
                    .spine_count = POINTS - n};
    assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
  }
  return icons;
}

/* A file taken apart. */
typedef struct glb {
  unsigned char *bytes;
  size_t size, json_size;
  const unsigned char *numbers;
  cJSON *json;
} glb;

static uint32_t word_at(const unsigned char *bytes)
{
  return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
         (uint32_t)bytes[3] << 24;
}

static float float_at(const unsigned char *bytes)
{
  uint32_t word = word_at(bytes);
  float out;
  memcpy(&out, &word, sizeof out);
  return out;
}

static glb read_glb(const char *path)
{
  glb out = {.bytes = calloc(1, 1 << 20)};
  assert_non_null(out.bytes);
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  out.size = fread(out.bytes, 1, 1 << 20, file);
  fclose(file);
  assert_memory_equal(out.bytes, "glTF", 4);
  assert_int_equal(word_at(out.bytes + 4), 2);
  assert_int_equal(word_at(out.bytes + 8), out.size);
  out.json_size = word_at(out.bytes + 12);
  assert_int_equal(out.json_size % 4, 0);
  assert_memory_equal(out.bytes + 16, "JSON", 4);
  out.json = cJSON_ParseWithLength((const char *)out.bytes + 20, out.json_size);
  assert_non_null(out.json);
  if (20 + out.json_size < out.size) {
    assert_memory_equal(out.bytes + 24 + out.json_size, "BIN", 4);
    out.numbers = out.bytes + 28 + out.json_size;
    assert_int_equal(word_at(out.bytes + 20 + out.json_size),
                     out.size - 28 - out.json_size);
  }
  return out;
}

static void clear_glb(glb *g)
{
  cJSON_Delete(g->json);
  free(g->bytes);
}

static double number(const cJSON *object, const char *name)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
  return item ? item->valuedouble : 0.0;
}

static const cJSON *entry(const glb *g, const char *list, int index)
{
  const cJSON *item =
      cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(g->json, list), index);
  assert_non_null(item);
  return item;
}

/* The bytes of an accessor, whose stretch must lie in its view and that in the buffer. */
static const unsigned char *data_of(const glb *g, int accessor, int *count)
{
  const cJSON *a = entry(g, "accessors", accessor);
  const cJSON *view = entry(g, "bufferViews", (int)number(a, "bufferView"));
  const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(a, "type"));
  *count = (int)number(a, "count");
  double bytes = *count * (strcmp(type, "VEC3") == 0 ? 12.0 : 4.0);
  double begin = number(a, "byteOffset"), start = number(view, "byteOffset");
  assert_true(begin + bytes <= number(view, "byteLength"));
  assert_true(start + number(view, "byteLength") <=
              number(entry(g, "buffers", 0), "byteLength"));
  return g->numbers + (size_t)(start + begin);
}

/* The mesh of an arrow against its solid; `center` is what node 0 adds, turned back. */
static void compare_arrow(const glb *g, const cJSON *node, const fg_icon *icon,
                          const double center[3])
{
  fg_surface *solid;
  assert_int_equal(fg_icon_solid(&solid, NULL, icon), FG_STATUS_OK);
  const cJSON *mesh = entry(g, "meshes", (int)number(node, "mesh"));
  const cJSON *primitive =
      cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(mesh, "primitives"), 0);
  const cJSON *attributes = cJSON_GetObjectItemCaseSensitive(primitive, "attributes");
  int places, normals, indices;
  const unsigned char *place = data_of(g, (int)number(attributes, "POSITION"), &places);
  const unsigned char *normal = data_of(g, (int)number(attributes, "NORMAL"), &normals);
  const unsigned char *index = data_of(g, (int)number(primitive, "indices"), &indices);
  assert_int_equal(places, solid->corner_count);
  assert_int_equal(normals, solid->corner_count);
  assert_int_equal(indices, 3 * solid->triangle_count);
  for (int n = 0; n < places; ++n)
    for (int k = 0; k < 3; ++k) {
      double got = (double)float_at(place + 12 * n + 4 * k) + center[k];
      assert_true(fabs(got - solid->vertex[solid->corner[n]][k]) < 2e-5);
      assert_true(float_at(normal + 12 * n + 4 * k) == solid->normal[n][k]);
    }
  for (int n = 0; n < indices; ++n)
    assert_int_equal(word_at(index + 4 * n), solid->triangle[n / 3][n % 3]);
  const cJSON *extras = cJSON_GetObjectItemCaseSensitive(node, "extras");
  assert_true(number(extras, "volume") == icon->area);
  assert_true(number(extras, "speed") == icon->speed);
  fg_surface_destroy(solid);
}

static void a_file_holds_what_was_written(void **state)
{
  folder *f = *state;
  fg_icons *icons = make_icons(f->context);
  fg_solid_options options = {.palette = "#ff0000", .speed_min = 1, .speed_max = 3};
  assert_int_equal(fg_solid_write(f->context, f->path, NULL, icons, &options),
                   FG_STATUS_OK);
  glb g = read_glb(f->path);
  const cJSON *root = entry(&g, "nodes", 0);
  const cJSON *moved = cJSON_GetObjectItemCaseSensitive(root, "translation");
  const double center[3] = {cJSON_GetArrayItem(moved, 0)->valuedouble,
                            -cJSON_GetArrayItem(moved, 2)->valuedouble,
                            cJSON_GetArrayItem(moved, 1)->valuedouble};
  int nodes = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(g.json, "nodes"));
  assert_int_equal(nodes, 1 + 2 + 2); /* spines, centres, two arrows */
  assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(root, "children")),
                   nodes - 1);
  int arrows = 0;
  for (int n = 1; n < nodes; ++n) {
    const cJSON *node = entry(&g, "nodes", n);
    const cJSON *extras = cJSON_GetObjectItemCaseSensitive(node, "extras");
    int cluster = (int)number(extras, "cluster");
    if (extras) {
      compare_arrow(&g, node, fg_icons_at(icons, cluster - 4), center);
      arrows++;
    }
  }
  assert_int_equal(arrows, 2);
  int centers, spines;
  const unsigned char *place = data_of(&g, 2, &centers);
  assert_int_equal(centers, ICONS);
  assert_true(fabs((double)float_at(place + 12 * 2 + 8) + center[2] - 200.0) < 1e-4);
  data_of(&g, 0, &spines);
  assert_int_equal(spines, 3 * POINTS - 3);
  /* pure red is 1 in linear light as well */
  const cJSON *material =
      cJSON_GetObjectItemCaseSensitive(entry(&g, "materials", 3), "pbrMetallicRoughness");
  const cJSON *color = cJSON_GetObjectItemCaseSensitive(material, "baseColorFactor");
  for (int k = 0; k < 4; ++k)
    assert_true(fabs(cJSON_GetArrayItem(color, k)->valuedouble - (k == 0 || k == 3)) <
                1e-9);
  clear_glb(&g);
  fg_icons_destroy(icons);
}

/* A surface is a mesh of its own behind the arrows, which one sees through. */
static void the_surface_of_clusters_is_transparent(void **state)
{
  folder *f = *state;
  fg_icons *icons = make_icons(f->context);
  fg_surface *surface;
  assert_int_equal(fg_icon_solid(&surface, f->context, fg_icons_at(icons, 2)),
                   FG_STATUS_OK);
  fg_solid_options options = {.surface = surface};
  assert_int_equal(fg_solid_write(f->context, f->path, NULL, icons, &options),
                   FG_STATUS_OK);
  glb g = read_glb(f->path);
  int last = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(g.json, "nodes")) - 1;
  assert_int_equal(last, 2 + 2 + 1); /* spines, centres, two arrows, the clusters */
  const cJSON *node = entry(&g, "nodes", last);
  assert_string_equal(
      cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(node, "name")), "clusters");
  const cJSON *primitive = cJSON_GetArrayItem(
      cJSON_GetObjectItemCaseSensitive(entry(&g, "meshes", (int)number(node, "mesh")),
                                       "primitives"),
      0);
  const cJSON *attributes = cJSON_GetObjectItemCaseSensitive(primitive, "attributes");
  int normals, indices;
  data_of(&g, (int)number(attributes, "NORMAL"), &normals);
  data_of(&g, (int)number(primitive, "indices"), &indices);
  assert_int_equal(normals, surface->corner_count);
  assert_int_equal(indices, 3 * surface->triangle_count);
  for (int n = 0; n < last; ++n) {
    const cJSON *mode =
        cJSON_GetObjectItemCaseSensitive(entry(&g, "materials", n), "alphaMode");
    assert_int_equal(mode != NULL, n == last - 1);
  }
  clear_glb(&g);
  fg_surface_destroy(surface);
  fg_icons_destroy(icons);
}

/* Speed 1 at the side of least x, 5 at the other. */
static bool faster_along_x(const double place[3], double velocity[3])
{
  velocity[1] = 1.0 + 2.0 * (place[0] - field_low[0]);
  return true;
}

static double linear(double level)
{
  return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

static const cJSON *primitive_of(const glb *g, int mesh)
{
  return cJSON_GetArrayItem(
      cJSON_GetObjectItemCaseSensitive(entry(g, "meshes", mesh), "primitives"), 0);
}

/* Across the flow's gradient, from x = 3.3 to 4.7: its vertices have the colours of 1.6
 * to 4.4, whatever its mean is. */
static void an_arrow_is_coloured_by_the_speed_along_it(void **state)
{
  folder *f = *state;
  enum { LINE = 8 };
  double points[LINE][3];
  for (int n = 0; n < LINE; ++n)
    for (int k = 0; k < 3; ++k)
      points[n][k] = (double[]){3.3 + 0.2 * n, -0.3, 10.2}[k];
  const fg_icon icon = {.cluster = 1,
                        .point_count = LINE,
                        .points = (const double(*)[3])points,
                        .width = 0.02,
                        .tail_width = 0.01,
                        .head_length = 0.2,
                        .head_width = 0.05,
                        .speed = 9.0};
  fg_icons *icons = NULL;
  fg_field *field = field_of(faster_along_x);
  fg__palette palette;
  assert_int_equal(fg__palette_create(&palette, f->context, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_create_empty(&icons, f->context), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, f->context, &icon), FG_STATUS_OK);
  fg_solid_options options = {.speed_min = 1, .speed_max = 5};
  assert_int_equal(fg_solid_write(f->context, f->path, field, icons, &options),
                   FG_STATUS_OK);
  glb g = read_glb(f->path);
  const int arrow =
      cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(g.json, "meshes")) - 1;
  const cJSON *attributes =
      cJSON_GetObjectItemCaseSensitive(primitive_of(&g, arrow), "attributes");
  int places, colors;
  const unsigned char *place = data_of(&g, (int)number(attributes, "POSITION"), &places);
  const unsigned char *color = data_of(&g, (int)number(attributes, "COLOR_0"), &colors);
  const cJSON *moved =
      cJSON_GetObjectItemCaseSensitive(entry(&g, "nodes", 0), "translation");
  assert_int_equal(colors, places);
  for (int n = 0; n < places; ++n) {
    double x =
        (double)float_at(place + 12 * n) + cJSON_GetArrayItem(moved, 0)->valuedouble;
    fg__color wanted = fg__palette_color(&palette, (x - 3.0) / 2.0);
    assert_true(fabs((double)float_at(color + 12 * n) - linear(wanted.red)) < 1e-3);
    assert_true(fabs((double)float_at(color + 12 * n + 4) - linear(wanted.green)) < 1e-3);
    assert_true(fabs((double)float_at(color + 12 * n + 8) - linear(wanted.blue)) < 1e-3);
  }
  clear_glb(&g);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

static void no_icons_make_an_empty_scene(void **state)
{
  folder *f = *state;
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, f->context), FG_STATUS_OK);
  assert_int_equal(fg_solid_write(f->context, f->path, NULL, icons, NULL), FG_STATUS_OK);
  glb g = read_glb(f->path);
  assert_null(g.numbers);
  assert_null(cJSON_GetObjectItemCaseSensitive(g.json, "meshes"));
  clear_glb(&g);
  assert_int_equal(fg_solid_write(f->context, "icons.stl", NULL, icons, NULL),
                   FG_STATUS_ARGUMENT);
  fg_context_clear(f->context);
  fg_solid_options options = {.palette = "no such"};
  assert_int_equal(fg_solid_write(f->context, f->path, NULL, icons, &options),
                   FG_STATUS_ARGUMENT);
  fg_context_clear(f->context);
  fg_icons_destroy(icons);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, folder_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(a_file_holds_what_was_written),
      TEST(the_surface_of_clusters_is_transparent),
      TEST(an_arrow_is_coloured_by_the_speed_along_it),
      TEST(no_icons_make_an_empty_scene),
  };
  return cmocka_run_group_tests_name("write/glb", tests, NULL, NULL);
}
