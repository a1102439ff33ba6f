/* What is drawn of the Earth, on planes of all kinds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cairo.h>

#include "base/context_test.h"
#include "flowgrain/flowgrain.h"
#include "picture/map/land.h"
#include "picture/map/map_scene.h"
#include "picture/map/page_map.h"
#include "picture/map/views_test.h"

static const struct {
  double longitude, latitude;
  bool land;
} places[] = {
    {10.0, 22.0, true},   /* Sahara */
    {-100.0, 45.0, true}, /* Dakota */
    {-55.0, -12.0, true}, /* Mato Grosso */
    {135.0, -25.0, true}, /* Australia */
    {100.0, 60.0, true},  /* Siberia */
    {179.0, 67.0, true},  /* Chukotka, on either side of the antimeridian */
    {-175.5, 66.5, true},   {0.0, -80.0, true}, /* Antarctica, all round the pole */
    {100.0, -80.0, true},   {40.0, -89.0, true},   {-42.0, 72.0, true}, /* Greenland */
    {47.0, -19.0, true},                                                /* Madagascar */
    {-30.0, 30.0, false},                                               /* the Atlantic */
    {-25.0, -30.0, false},  {-150.0, 20.0, false}, /* the Pacific, on either side of the
                                                      antimeridian */
    {170.0, -10.0, false},  {80.0, -20.0, false},  /* the Indian Ocean */
    {51.0, 41.0, false},                           /* the Caspian Sea */
    {0.0, 88.0, false},                            /* the Arctic Ocean */
    {-140.0, -60.0, false},                        /* the Southern Ocean */
};
enum { PLACES = sizeof places / sizeof *places };

/* By the even-odd rule. */
static bool contains(const fg__polygons *loops, const double at[2])
{
  bool inside = false;
  for (size_t k = 0; k < loops->count; ++k)
    for (size_t n = loops->start[k]; n < loops->start[k + 1]; ++n) {
      const size_t next = n + 1 < loops->start[k + 1] ? n + 1 : loops->start[k];
      const double *a = loops->point[n], *b = loops->point[next];
      if ((a[1] > at[1]) != (b[1] > at[1]) &&
          at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
        inside = !inside;
    }
  return inside;
}

/* Whether the frame, and the disc in it, shows a place, and where. */
static bool shows(const fg__plane *plane, double longitude, double latitude, double at[2])
{
  if (!plane->map)
    longitude += 360.0 * ceil((plane->low[0] - longitude) / 360.0);
  fg__plane_forward(plane, 1, &longitude, &latitude, &at[0], &at[1]);
  if (!isfinite(at[0]) || !isfinite(at[1]))
    return false;
  for (int k = 0; k < 2; ++k)
    if (at[k] < plane->low[k] || at[k] > plane->high[k])
      return false;
  return !plane->whole || contains(&plane->outline, at);
}

static void land_is_where_it_is(void **state)
{
  fg_context *context = *state;
  int shown = 0;
  for (int k = 0; k < VIEWS; ++k)
    for (int detail = FG__COAST_110M; detail <= FG__COAST_10M; ++detail) {
      fg__plane plane;
      fg__polygons land = {0};
      make_plane(&plane, context, views[k]);
      assert_int_equal(fg__land_trace(&land, NULL, context, &plane, FG__COAST_LAND,
                                      (fg__coast_detail)detail),
                       FG_STATUS_OK);
      for (int n = 0; n < PLACES; ++n) {
        double at[2];
        if (!shows(&plane, places[n].longitude, places[n].latitude, at))
          continue;
        ++shown;
        if (contains(&land, at) != places[n].land)
          fail_msg("view %d, detail %d: %g, %g", k, detail, places[n].longitude,
                   places[n].latitude);
      }
      fg__polygons_clear(&land);
      fg__plane_clear(&plane);
    }
  assert_true(shown > 3 * 80);
}

/* Coasts are lines of short edges: none leads across the map or along its cut. */
static void coasts_do_not_cross_the_map(void **state)
{
  fg_context *context = *state;
  for (int k = 0; k < VIEWS; ++k) {
    fg__plane plane;
    fg__polygons lines = {0};
    make_plane(&plane, context, views[k]);
    assert_int_equal(
        fg__land_trace(NULL, &lines, context, &plane, FG__COAST_LAND, FG__COAST_50M),
        FG_STATUS_OK);
    assert_true(views[k] == &sahara ? lines.count == 0 : lines.count > 20);
    const double longest = 0.04 * (plane.high[0] - plane.low[0]);
    for (size_t line = 0; line < lines.count; ++line)
      for (size_t n = lines.start[line]; n + 1 < lines.start[line + 1]; ++n) {
        const double *a = lines.point[n], *b = lines.point[n + 1];
        double place[2][2];
        bool shown = true;
        for (int i = 0; i < 2; ++i) {
          const double *p = i ? b : a;
          fg__plane_inverse(&plane, 1, &p[0], &p[1], &place[i][0], &place[i][1]);
          shown = shown && shows(&plane, place[i][0], place[i][1], (double[2]){0.0, 0.0});
        }
        if (!shown)
          continue;
        assert_true(hypot(b[0] - a[0], b[1] - a[1]) < longest);
        for (int i = 0; i < 2 && plane.kind == FG__PLANE_CUT; ++i)
          assert_false(fabs(place[0][1] - place[1][1]) > 0.5 &&
                       fabs(fabs(place[0][0] - plane.center[0]) - 180.0) < 1e-3 &&
                       fabs(fabs(place[1][0] - plane.center[0]) - 180.0) < 1e-3);
      }
    fg__polygons_clear(&lines);
    fg__plane_clear(&plane);
  }
}

static double distance_to(const fg__polygons *lines, const double at[2])
{
  double least = HUGE_VAL;
  for (size_t k = 0; k < lines->count; ++k)
    for (size_t n = lines->start[k]; n + 1 < lines->start[k + 1]; ++n) {
      const double *a = lines->point[n], *b = lines->point[n + 1];
      const double d[2] = {b[0] - a[0], b[1] - a[1]};
      const double share = fmin(fmax(((at[0] - a[0]) * d[0] + (at[1] - a[1]) * d[1]) /
                                         (d[0] * d[0] + d[1] * d[1]),
                                     0.0),
                                1.0);
      least =
          fmin(least, hypot(a[0] + share * d[0] - at[0], a[1] + share * d[1] - at[1]));
    }
  return least;
}

/* All round an island on the antimeridian, but for the edge at which the data cut it. */
static void coasts_go_on_at_the_antimeridian(void **state)
{
  static const view fiji = {
      "+proj=merc +lon_0=180 +R=6371000 +units=km", {-40, -1910}, {40, -1840}, false};
  fg__plane plane;
  fg__polygons land = {0}, lines = {0};
  int edges = 0;
  make_plane(&plane, *state, &fiji);
  assert_int_equal(
      fg__land_trace(&land, &lines, *state, &plane, FG__COAST_LAND, FG__COAST_10M),
      FG_STATUS_OK);
  for (size_t k = 0; k < land.count; ++k)
    for (size_t n = land.start[k]; n < land.start[k + 1]; ++n) {
      const size_t next = n + 1 < land.start[k + 1] ? n + 1 : land.start[k];
      const double *a = land.point[n], *b = land.point[next];
      const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
      /* near the antimeridian, x = 0, but not along it, nor where the frame ends */
      if (fabs(middle[0]) > 3.0 || fabs(middle[0]) < 0.01 || middle[1] < fiji.low[1] ||
          middle[1] > fiji.high[1])
        continue;
      ++edges;
      assert_true(distance_to(&lines, middle) < 0.01);
    }
  assert_true(edges > 10);
  fg__polygons_clear(&land);
  fg__polygons_clear(&lines);
  fg__plane_clear(&plane);
}

/* What a label says of where it stands: degrees, north and east positive. */
static bool read_degrees(const fg__map_label *label, double *value, bool *is_latitude)
{
  const char last = label->text[strlen(label->text) - 1];
  *value = atof(label->text) * (last == 'S' || last == 'W' ? -1.0 : 1.0);
  *is_latitude = last == 'N' || last == 'S';
  return last == 'N' || last == 'S' || last == 'W' || last == 'E';
}

static void labels_say_where_lines_end(void **state)
{
  fg_context *context = *state;
  for (int k = 0; k < VIEWS; ++k) {
    fg__plane plane;
    fg__graticule *graticule = calloc(1, sizeof *graticule);
    assert_non_null(graticule);
    make_plane(&plane, context, views[k]);
    assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
    assert_true(graticule->labels + graticule->insides > 5);
    for (int n = 0; n < graticule->labels + graticule->insides; ++n) {
      const fg__map_label *label = n < graticule->labels
                                       ? &graticule->label[n]
                                       : &graticule->inside[n - graticule->labels];
      double given, place[2];
      bool is_latitude;
      /* a little inwards: on the rim itself there need be no way back */
      const double inwards =
          n < graticule->labels ? 1e-4 * (plane.high[0] - plane.low[0]) : 0.0;
      const double x = label->at[0] - inwards * label->out[0];
      const double y = label->at[1] - inwards * label->out[1];
      fg__plane_inverse(&plane, 1, &x, &y, &place[0], &place[1]);
      if (!read_degrees(label, &given, &is_latitude) || !isfinite(place[0]))
        continue;
      const double off =
          is_latitude ? given - place[1] : remainder(given - place[0], 360.0);
      if (!(fabs(off) < 0.6))
        fail_msg("view %d: %s stands at %g, %g", k, label->text, place[0], place[1]);
    }
    fg__graticule_clear(graticule);
    fg__plane_clear(&plane);
    free(graticule);
  }
}

/* Parallels end within the frame, at the cut. */
static void a_band_round_the_globe_has_its_own_frame(void **state)
{
  fg__plane plane;
  fg__graticule *graticule = calloc(1, sizeof *graticule);
  int parallels = 0;
  assert_non_null(graticule);
  make_plane(&plane, *state, &tropics);
  assert_false(plane.whole);
  for (int k = 0; k < 2; ++k)
    assert_true(plane.low[k] == tropics.low[k] && plane.high[k] == tropics.high[k]);
  assert_int_equal(fg__graticule_create(graticule, *state, &plane), FG_STATUS_OK);
  for (int n = 0; n < graticule->labels; ++n)
    parallels += graticule->label[n].at[0] == plane.low[0];
  assert_int_equal(parallels, 5); /* 20 S, 10 S, 0, 10 N, 20 N */
  fg__graticule_clear(graticule);
  fg__plane_clear(&plane);
  free(graticule);
}

/* A page of 480 points: no two texts touch, all are on it, and the key keeps its gap. */
static void no_two_labels_touch(void **state)
{
  fg_context *context = *state;
  int before_key = 0;
  for (int k = 0; k < VIEWS; ++k) {
    fg__plane plane;
    fg__graticule *graticule = calloc(1, sizeof *graticule);
    fg__page *page = calloc(1, sizeof *page);
    assert_non_null(graticule);
    assert_non_null(page);
    make_plane(&plane, context, views[k]);
    assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
    fg__page_plan plan = plan_of(&plane, graticule);
    strcpy(plan.title, "A title");
    plan.color_key = true;
    fg__axis_of_numbers(&plan.speed, 0.0, 10.0, 10.0, "mean speed", "m/s");
    cairo_t *ruler = fg__text_ruler();
    fg__page_layout(page, &plan, ruler);
    fg__map_scene scene = {.coasts = false};
    const fg__polygons none = {0};
    fg__map_scene_label(&scene, page, graticule, &none, ruler);
    cairo_destroy(ruler);
    assert_true(page->text_count > 8);
    assert_int_equal(page->framed, !plane.whole);
    for (int n = 0; n < page->text_count; ++n) {
      const fg__page_box *a = &page->text[n].box;
      assert_true(a->x0 >= 0.0 && a->y0 >= 0.0 && a->x1 <= page->width &&
                  a->y1 <= page->height);
      if (page->color_key_upright && a->x0 >= page->frame.x1 &&
          a->x0 < page->color_key.x0) {
        assert_true(a->x1 < page->color_key.x0 - page->font_size);
        ++before_key;
      }
      for (int m = 0; m < n; ++m) {
        const fg__page_box *b = &page->text[m].box;
        assert_false(a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1);
      }
    }
    fg__map_scene_clear(&scene);
    fg__graticule_clear(graticule);
    fg__plane_clear(&plane);
    free(graticule);
    free(page);
  }
  assert_true(before_key > 0);
}

/* Of a sea's field with data up to x = 2000 km, on a plane without land in it. */
static bool page_has(const fg__page *page, const char *text)
{
  for (int k = 0; k < page->text_count; ++k)
    if (strcmp(page->text[k].text, text) == 0)
      return true;
  return false;
}

/* Where not all have room, as many west of the middle are labelled as east of it. */
static void fewer_labels_are_still_even(void **state)
{
  fg_context *context = *state;
  static const char *const pairs[][2] = {{"60\u00B0W", "60\u00B0E"},
                                         {"120\u00B0W", "120\u00B0E"},
                                         {"30\u00B0S", "30\u00B0N"},
                                         {"60\u00B0S", "60\u00B0N"}};
  fg__plane plane;
  fg__graticule *graticule = calloc(1, sizeof *graticule);
  fg__page *page = calloc(1, sizeof *page);
  assert_non_null(graticule);
  assert_non_null(page);
  make_plane(&plane, context, &world);
  assert_int_equal(fg__graticule_create(graticule, context, &plane), FG_STATUS_OK);
  fg__page_plan plan = plan_of(&plane, graticule);
  cairo_t *ruler = fg__text_ruler();
  int least = 100, most = 0;
  for (plan.width = 60.0; plan.width < 500.0; plan.width += 40.0) {
    fg__page_layout(page, &plan, ruler);
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; ++k)
      assert_int_equal(page_has(page, pairs[k][0]), page_has(page, pairs[k][1]));
    least = page->text_count < least ? page->text_count : least;
    most = page->text_count > most ? page->text_count : most;
  }
  assert_true(least < most);
  assert_int_equal(most, 10);
  cairo_destroy(ruler);
  fg__graticule_clear(graticule);
  fg__plane_clear(&plane);
  free(graticule);
  free(page);
}

static uint32_t pixel_of(const char *path, double x, double y)
{
  cairo_surface_t *image = cairo_image_surface_create_from_png(path);
  assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
  uint32_t pixel;
  const int column = (int)(x * cairo_image_surface_get_width(image));
  const int row = (int)(y * cairo_image_surface_get_height(image));
  memcpy(&pixel,
         cairo_image_surface_get_data(image) +
             row * cairo_image_surface_get_stride(image) + 4 * column,
         sizeof pixel);
  cairo_surface_destroy(image);
  return pixel & 0xffffff;
}

/* Data that reach over Australia and its seas, and hardly over other land. */
static bool near_australia(double x, double y)
{
  return x > 105.0 && x < 165.0 && y > -50.0 && y < 0.0;
}

/* Land covers a texture of data of the sea, which on coarse grids are on coasts, too. */
static void land_covers_textures_of_the_sea(void **state)
{
  fg_context *context = *state;
  char folder[] = "/tmp/flowgrain-map-XXXXXX", path[64];
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/map.png", folder);
  for (int all = 0; all < 2; ++all) {
    fg_field *field = make_field(context, &degrees, all ? NULL : near_australia);
    fg_texture *texture = NULL;
    const fg_texture_style style = {.land = "#804020", .palette = "#00ff00"};
    assert_int_equal(fg_texture_create(&texture, context, field,
                                       &(fg_texture_options){.longest = 358}),
                     FG_STATUS_OK);
    assert_int_equal(fg_texture_write(context, path, field, texture, &style),
                     FG_STATUS_OK);
    const uint32_t pixel = pixel_of(path, (135.0 - 21.0) / 358.0, (89.0 + 25.0) / 178.0);
    assert_true((pixel == 0x804020) == !all);
    fg_texture_destroy(texture);
    fg_field_destroy(field);
  }
  unlink(path);
  rmdir(folder);
}

static void pictures_show_land(void **state)
{
  fg_context *context = *state;
  char folder[] = "/tmp/flowgrain-map-XXXXXX", path[64];
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/map.png", folder);
  fg_field *field = make_field(context, &degrees, NULL);
  fg_icons *icons = NULL;
  assert_int_equal(
      fg_arrows_create(&icons, context, field, &(fg_arrows_options){.count = 2}),
      FG_STATUS_OK);
  fg_picture_options options = {
      .no_frame = true, .no_arrows = true, .pixels_per_point = 1.0, .land = "#804020"};
  /* Australia and the Pacific, from 21 to 379 degrees east and 89 north to 89 south */
  const double land[2] = {(135.0 - 21.0) / 358.0, (89.0 + 25.0) / 178.0};
  const double sea[2] = {(200.0 - 21.0) / 358.0, (89.0 + 25.0) / 178.0};
  assert_int_equal(fg_picture_write(context, path, field, NULL, icons, &options),
                   FG_STATUS_OK);
  assert_int_equal(pixel_of(path, land[0], land[1]), 0x804020);
  assert_int_equal(pixel_of(path, sea[0], sea[1]), 0xffffff);
  options.no_coast = true;
  assert_int_equal(fg_picture_write(context, path, field, NULL, icons, &options),
                   FG_STATUS_OK);
  assert_int_equal(pixel_of(path, land[0], land[1]), 0xffffff);
  options.land = "brown";
  assert_int_equal(fg_picture_write(context, path, field, NULL, icons, &options),
                   FG_STATUS_ARGUMENT);
  unlink(path);
  rmdir(folder);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* A disc that is too small for degrees round it has none in it. */
static void small_discs_have_no_degrees(void **state)
{
  fg_context *context = *state;
  char folder[] = "/tmp/flowgrain-map-XXXXXX", path[64];
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/map.svg", folder);
  fg_field *field = make_field(context, &south, NULL);
  fg_icons *icons = NULL;
  assert_int_equal(
      fg_arrows_create(&icons, context, field, &(fg_arrows_options){.count = 2}),
      FG_STATUS_OK);
  for (int large = 0; large < 2; ++large) {
    static char text[1 << 22];
    const fg_picture_options options = {.width = large ? 300.0 : 60.0};
    assert_int_equal(fg_picture_write(context, path, field, NULL, icons, &options),
                     FG_STATUS_OK);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_int_equal(strstr(text, "\xC2\xB0S<") != NULL, large);
  }
  unlink(path);
  rmdir(folder);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

int main(void)
{
#define TEST(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      TEST(land_is_where_it_is),
      TEST(coasts_do_not_cross_the_map),
      TEST(coasts_go_on_at_the_antimeridian),
      TEST(labels_say_where_lines_end),
      TEST(no_two_labels_touch),
      TEST(a_band_round_the_globe_has_its_own_frame),
      TEST(pictures_show_land),
      TEST(small_discs_have_no_degrees),
      TEST(fewer_labels_are_still_even),
      TEST(land_covers_textures_of_the_sea),
  };
  return cmocka_run_group_tests_name("picture/map/map", tests, NULL, NULL);
}
