#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/vector.h"
#include "icon/icons.h"
#include "picture/render/render.h"

enum { WIDTH = 150, HEIGHT = 120 };

static uint32_t image[HEIGHT][WIDTH], other[HEIGHT][WIDTH];

static fg_icons *list_of(const fg_icon *icon)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, NULL, icon), FG_STATUS_OK);
  return icons;
}

static fg__palette red_palette(void)
{
  fg__palette red;
  assert_int_equal(fg__palette_create(&red, NULL, "#d02010"), FG_STATUS_OK);
  return red;
}

/* A box of 4 x 4 x 2 with an arrow that stands in it, off the middle, leaning. */
static fg_icons *make_icons(double turned, bool beyond)
{
  double points[9][3];
  for (int n = 0; n < 9; ++n) {
    double x = beyond ? 1.7 + 0.05 * n : 0.4, y = -0.9 + 0.02 * n;
    points[n][0] = 12.0 + cos(turned) * x - sin(turned) * y;
    points[n][1] = -3.0 + sin(turned) * x + cos(turned) * y;
    points[n][2] = 5.2 + 0.2 * n;
  }
  fg_icon icon = {.cluster = 1,
                  .point_count = 9,
                  .points = (const double(*)[3])points,
                  .width = 0.36,
                  .tail_width = 0.24,
                  .head_length = 0.5,
                  .head_width = 0.7,
                  .speed = 1.0};
  return list_of(&icon);
}

static void set_view_box(fg__view_box *view_box, double period)
{
  static const float one[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  static const double axis[3][2] = {{10.0, 14.0}, {-5.0, -1.0}, {5.0, 7.0}};
  fg_field_arrays field = {.dimension = 3,
                           .size = {2, 2, 2},
                           .axis = {axis[0], axis[1], axis[2]},
                           .period = {period, 0.0, 0.0},
                           .velocity = {one, one, one}};
  fg__view_box_of(view_box, &field);
}

static fg__rendering rendering_of(const fg_icons *icons, const fg__palette *palette,
                                  double azimuth, double elevation)
{
  fg__rendering out = {.width = WIDTH,
                       .height = HEIGHT,
                       .icons = icons,
                       .palette = palette,
                       .range = {0.0, 2.0},
                       .transparent = true,
                       .threads = 1};
  const fg__pane pane = {10.0, 5.0, 140.0, 115.0};
  set_view_box(&out.view_box, 0.0);
  fg__camera_look(&out.camera, &out.view_box, azimuth, elevation, &pane);
  return out;
}

static int channel(uint32_t pixel, int shift)
{
  return (int)(pixel >> shift & 255U);
}

/* The pixel of a point in input coordinates. */
static uint32_t pixel_at(const fg__rendering *r, double x, double y, double z)
{
  const double place[3] = {fg__view_box_place(&r->view_box, 0, x),
                           fg__view_box_place(&r->view_box, 1, y),
                           fg__view_box_place(&r->view_box, 2, z)};
  double at[2];
  fg__camera_project(&r->camera, place, at);
  assert_true(at[0] >= 0 && at[0] < WIDTH && at[1] >= 0 && at[1] < HEIGHT);
  return image[(int)at[1]][(int)at[0]];
}

static void an_arrow_is_seen_where_it_is(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, false);
  const fg__palette red = red_palette();
  for (int view = 0; view < 12; ++view) {
    fg__rendering r = rendering_of(icons, &red, 30.0 * view, 10.0 * view - 55.0);
    assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
    for (int n = 2; n < 8; ++n) {
      uint32_t pixel = pixel_at(&r, 12.4, -3.9 + 0.02 * n, 5.2 + 0.2 * n);
      assert_true(channel(pixel, 24) > 100);
      assert_true(channel(pixel, 16) > channel(pixel, 8) + 40);
    }
    assert_int_equal(pixel_at(&r, 10.5, -1.5, 6.0), 0);
    assert_int_equal(image[0][0], 0);
  }
  fg_icons_destroy(icons);
}

/* Walls are what lies behind, and the arrow's shadow lies on the floor. */
static void walls_lie_behind_and_take_shadows(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, false);
  const fg__palette red = red_palette();
  fg__rendering r = rendering_of(icons, &red, 25.0, 35.0);
  r.walls = true;
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  int far = channel(pixel_at(&r, 10.6, -4.2, 5.0), 8), darkest = 255;
  assert_true(far > 200);
  assert_int_equal(channel(pixel_at(&r, 11.0, -1.0, 6.5), 24), 255);
  uint32_t arrow = pixel_at(&r, 12.4, -3.8, 6.2);
  assert_true(channel(arrow, 16) > channel(arrow, 8) + 40);
  for (int n = 0; n < 60; ++n)
    for (int m = 0; m < 60; ++m) {
      uint32_t floor_there = pixel_at(&r, 10.2 + 0.06 * n, -4.8 + 0.06 * m, 5.0);
      if (channel(floor_there, 16) < channel(floor_there, 8) + 3) /* not the arrow */
        darkest = channel(floor_there, 8) < darkest ? channel(floor_there, 8) : darkest;
    }
  assert_true(darkest < far - 15);
  fg_icons_destroy(icons);
}

/* An upright arrow before one along x, both in the middle of the box, the second behind.
 */
static fg_icons *make_crossing(void)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  const double points[2][2][3] = {{{12.0, -4.3, 5.2}, {12.0, -4.3, 6.9}},
                                  {{10.4, -1.8, 6.0}, {13.8, -1.8, 6.0}}};
  for (int n = 0; n < 2; ++n) {
    fg_icon icon = {.cluster = n + 1,
                    .point_count = 2,
                    .points = points[n],
                    .width = 0.2,
                    .tail_width = 0.18,
                    .head_length = 0.5,
                    .head_width = 0.5,
                    .speed = 1.0 + n};
    assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  }
  return icons;
}

/* The one behind ends at the halo of the one before it, which is whole. */
static void halos_part_arrows(void **state)
{
  (void)state;
  fg_icons *icons = make_crossing();
  fg__palette colors;
  assert_int_equal(fg__palette_create(&colors, NULL, "#208010"), FG_STATUS_OK);
  fg__rendering r = rendering_of(icons, &colors, 0.0, 0.0);
  for (int halo = 0; halo < 2; ++halo)
    for (int page = 0; page < 2; ++page) {
      r.halo = 4.0 * halo;
      r.transparent = !page;
      assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
      uint32_t paper = page ? 0xffffffffU : 0;
      double front = 0.1 * r.camera.factor * r.view_box.scale /
                     (fg__length(r.camera.eye) - 1.3 * r.view_box.scale);
      double at[2];
      const double middle[3] = {0.0, -1.3 * r.view_box.scale, 0.0};
      fg__camera_project(&r.camera, middle, at);
      int x = (int)at[0], y = (int)at[1];
      int beside = (int)floor(at[0] + front + 2.0);
      assert_int_not_equal(image[y][x], paper);
      assert_int_not_equal(image[y][beside + 6], paper);
      if (halo)
        assert_int_equal(image[y][beside], paper);
      else
        assert_int_not_equal(image[y][beside], paper);
      assert_int_equal(image[y - 12][beside + 2], paper); /* behind it is nothing */
    }
  fg_icons_destroy(icons);
}

/* A surface is clearer where it is seen from the front than at its rim. */
static void outlines_are_darkest_at_the_rim(void **state)
{
  (void)state;
  fg_icons *none = NULL;
  fg_surface *body;
  fg__palette colors;
  assert_int_equal(fg__palette_create(&colors, NULL, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_create_empty(&none, NULL), FG_STATUS_OK);
  const double points[2][3] = {{12.0, -3.0, 5.1}, {12.0, -3.0, 6.9}};
  const fg_icon thick = {.point_count = 2,
                         .points = points,
                         .width = 1.0,
                         .tail_width = 1.0,
                         .head_length = 0.1,
                         .head_width = 1.01};
  assert_int_equal(fg_icon_solid(&body, NULL, &thick), FG_STATUS_OK);
  fg__rendering r = rendering_of(none, &colors, 70.0, 0.0);
  r.silhouette = body;
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  double at[2];
  const double middle[3] = {0.0, 0.0, 0.0};
  fg__camera_project(&r.camera, middle, at);
  int y = (int)at[1], front = channel(image[y][(int)at[0]], 24), rim = 0, x = 0;
  for (x = (int)at[0]; image[y][x] != 0; ++x)
    rim = channel(image[y][x], 24) > rim ? channel(image[y][x], 24) : rim;
  double radius = (x - at[0]) / (r.camera.factor / fg__length(r.camera.eye));
  assert_true(fabs(radius - 0.5 * r.view_box.scale) < 0.02);
  assert_true(front > 5 && front < 60 && rim > 2 * front);
  fg_surface_destroy(body);
  fg_icons_destroy(none);
}

/* An arrow upwards where the flow is faster above: from the slow colour to the fast. */
static void colors_follow_the_speed(void **state)
{
  (void)state;
  static const double axis[3][2] = {{10.0, 14.0}, {-5.0, -1.0}, {5.0, 7.0}};
  static const float none[8] = {0}, up[8] = {0.5F, 0.5F, 0.5F, 0.5F, 2, 2, 2, 2};
  const fg_field_arrays arrays = {.dimension = 3,
                                  .size = {2, 2, 2},
                                  .axis = {axis[0], axis[1], axis[2]},
                                  .velocity = {none, none, up}};
  fg_field *field;
  fg_icons *icons = make_icons(0.0, false);
  fg__palette greys;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  assert_int_equal(fg__palette_create(&greys, NULL, "grey"), FG_STATUS_OK);
  fg__rendering r = rendering_of(icons, &greys, 20.0, 5.0);
  int level[2][2];
  for (int varies = 0; varies < 2; ++varies) {
    r.field = varies ? field : NULL;
    assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
    level[varies][0] = channel(pixel_at(&r, 12.4, -3.9 + 0.02, 5.4), 8);
    level[varies][1] = channel(pixel_at(&r, 12.4, -3.9 + 0.1, 6.2), 8);
  }
  assert_true(abs(level[0][0] - level[0][1]) < 12);
  assert_true(level[1][0] - level[1][1] > 25); /* what is fast is dark */
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* What goes on across a period comes in at the other side, and is cut at the boundary. */
static void arrows_go_round_periods(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, true);
  const fg__palette red = red_palette();
  fg__rendering r = rendering_of(icons, &red, 10.0, 15.0);
  set_view_box(&r.view_box, 4.0);
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  assert_true(channel(pixel_at(&r, 13.8, -3.86, 5.6), 24) > 100);
  assert_int_equal(pixel_at(&r, 14.15, -3.72, 6.8), 0);
  assert_true(channel(pixel_at(&r, 10.05, -3.76, 6.6), 24) > 100);
  fg_icons_destroy(icons);
}

/* The pixels of an arrow along -y that are as light as paper. */
static int light_pixels(double azimuth)
{
  static const double points[2][3] = {{12.0, -2.0, 6.0}, {12.0, -4.0, 6.0}};
  const fg_icon icon = {.point_count = 2,
                        .points = points,
                        .width = 0.3,
                        .tail_width = 0.3,
                        .head_length = 1.0,
                        .head_width = 0.8,
                        .speed = 1.0};
  fg_icons *icons = list_of(&icon);
  const fg__palette red = red_palette();
  int count = 0;
  fg__rendering r = rendering_of(icons, &red, azimuth, 0.0);
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x)
      count += channel(image[y][x], 24) == 255 && channel(image[y][x], 8) > 230;
  if (azimuth == 0.0)
    assert_true(channel(pixel_at(&r, 12.0, -4.0, 6.0), 8) > 230);
  fg_icons_destroy(icons);
  return count;
}

/* A head that points at the viewer has a dot on its tip; no other has one. */
static void arrows_out_of_the_page_have_a_dot(void **state)
{
  (void)state;
  assert_true(light_pixels(0.0) > 15);
  assert_true(light_pixels(0.0) > light_pixels(16.0));
  assert_int_equal(light_pixels(25.0), 0);
  assert_int_equal(light_pixels(90.0), 0);
  assert_int_equal(light_pixels(180.0), 0);
}

/* In a periodic field, too, an arrow along a side of the box is whole, and there is no
 * chip of it at the other side. */
static void arrows_beside_a_period_are_whole(void **state)
{
  (void)state;
  static const double points[2][3] = {{13.9, -3.0, 5.2}, {13.9, -3.0, 6.8}};
  const fg_icon icon = {.point_count = 2,
                        .points = points,
                        .width = 0.3,
                        .tail_width = 0.3,
                        .head_length = 0.6,
                        .head_width = 0.6,
                        .speed = 1.0};
  fg_icons *icons = list_of(&icon);
  const fg__palette red = red_palette();
  fg__rendering r = rendering_of(icons, &red, 10.0, 15.0);
  assert_int_equal(fg__render(NULL, &r, other[0], WIDTH), FG_STATUS_OK);
  set_view_box(&r.view_box, 4.0);
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  assert_memory_equal(image, other, sizeof image);
  assert_true(channel(pixel_at(&r, 14.1, -3.0, 6.25), 24) > 200);
  fg_icons_destroy(icons);
}

static void threads_change_nothing(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, false);
  fg__palette colors;
  assert_int_equal(fg__palette_create(&colors, NULL, NULL), FG_STATUS_OK);
  fg__rendering r = rendering_of(icons, &colors, 200.0, 20.0);
  r.walls = true;
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  r.threads = 3;
  memset(other, 7, sizeof other);
  assert_int_equal(fg__render(NULL, &r, other[0], WIDTH), FG_STATUS_OK);
  assert_memory_equal(image, other, sizeof image);
  fg_icons_destroy(icons);
}

/* Where the box is square a turned arrow looks the same from a viewpoint turned as far;
 * but for pixels that its edge just touches. */
static void turning_all_changes_nothing(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, false);
  fg_icons *turned = make_icons(1.5707963267948966, false);
  fg__palette colors;
  assert_int_equal(fg__palette_create(&colors, NULL, NULL), FG_STATUS_OK);
  fg__rendering r = rendering_of(icons, &colors, 35.0, 20.0);
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  r = rendering_of(turned, &colors, 125.0, 20.0);
  assert_int_equal(fg__render(NULL, &r, other[0], WIDTH), FG_STATUS_OK);
  int differ = 0, seen = 0;
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      seen += image[y][x] != 0;
      for (int shift = 0; shift < 32; shift += 8)
        differ += abs(channel(image[y][x], shift) - channel(other[y][x], shift)) > 24;
    }
  assert_true(seen > 300 && differ < seen / 20);
  fg_icons_destroy(icons);
  fg_icons_destroy(turned);
}

/* Between triangles there is no gap: what lies amid pixels of a thick arrow is one. */
static void arrows_have_no_holes(void **state)
{
  (void)state;
  fg_icons *icons = NULL;
  const fg__palette red = red_palette();
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  double points[17][3];
  for (int n = 0; n < 17; ++n) {
    points[n][0] = 11.0 + 0.12 * n;
    points[n][1] = -3.6 + 0.07 * n;
    points[n][2] = 6.0 + 0.4 * sin(0.2 * n);
  }
  const fg_icon icon = {.cluster = 1,
                        .point_count = 17,
                        .points = (const double(*)[3])points,
                        .width = 0.9,
                        .tail_width = 0.5,
                        .head_length = 0.6,
                        .head_width = 1.3,
                        .speed = 1.0};
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  int covered = 0;
  for (int view = 0; view < 5; ++view) {
    fg__rendering r = rendering_of(icons, &red, 17.0 + 71.0 * view, 31.0 * view - 60.0);
    assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
    for (int y = 1; y + 1 < HEIGHT; ++y)
      for (int x = 1; x + 1 < WIDTH; ++x) {
        bool amid = true;
        for (int n = 0; n < 9; ++n)
          amid =
              amid && (n == 4 || channel(image[y + n / 3 - 1][x + n % 3 - 1], 24) == 255);
        covered += amid;
        if (amid)
          assert_int_equal(channel(image[y][x], 24), 255);
      }
  }
  assert_true(covered > 2000);
  fg_icons_destroy(icons);
}

/* What another program's file has behind the viewer or far away is no matter. */
static void far_arrows_take_nothing_away(void **state)
{
  (void)state;
  fg_icons *near_one = make_icons(0.0, false), *both = make_icons(0.0, false);
  const fg__palette red = red_palette();
  const double points[2][3] = {{12.0, -4e9, 5.2}, {12.0, 3.0, 6.9}};
  const fg_icon far_one = {.cluster = 2,
                           .point_count = 2,
                           .points = points,
                           .width = 0.2,
                           .tail_width = 0.2,
                           .head_length = 0.5,
                           .head_width = 0.5,
                           .speed = 1.0};
  assert_int_equal(fg__icons_add(both, NULL, &far_one), FG_STATUS_OK);
  fg__rendering r = rendering_of(near_one, &red, 0.0, 60.0);
  assert_int_equal(fg__render(NULL, &r, image[0], WIDTH), FG_STATUS_OK);
  r.icons = both;
  assert_int_equal(fg__render(NULL, &r, other[0], WIDTH), FG_STATUS_OK);
  int lost = 0;
  for (int n = 0; n < WIDTH * HEIGHT; ++n)
    lost += image[n / WIDTH][n % WIDTH] != 0 && other[n / WIDTH][n % WIDTH] == 0;
  assert_int_equal(lost, 0); /* nothing hides or takes away what is there */
  fg_icons_destroy(near_one);
  fg_icons_destroy(both);
}

/* What a stopped context is given is not drawn. */
static void a_stopped_context_stops_the_drawing(void **state)
{
  (void)state;
  fg_icons *icons = make_icons(0.0, false);
  fg__palette colors;
  fg_context *context;
  assert_int_equal(fg__palette_create(&colors, NULL, NULL), FG_STATUS_OK);
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg__rendering r = rendering_of(icons, &colors, 20.0, 20.0);
  memset(image, 0, sizeof image);
  fg_context_stop(context);
  assert_int_equal(fg__render(context, &r, image[0], WIDTH), FG_STATUS_STOPPED);
  for (int n = 0; n < WIDTH * HEIGHT; ++n)
    assert_int_equal(image[n / WIDTH][n % WIDTH], 0);
  fg_context_destroy(context);
  fg_icons_destroy(icons);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_arrow_is_seen_where_it_is),
      cmocka_unit_test(walls_lie_behind_and_take_shadows),
      cmocka_unit_test(halos_part_arrows),
      cmocka_unit_test(outlines_are_darkest_at_the_rim),
      cmocka_unit_test(colors_follow_the_speed),
      cmocka_unit_test(arrows_go_round_periods),
      cmocka_unit_test(arrows_beside_a_period_are_whole),
      cmocka_unit_test(arrows_out_of_the_page_have_a_dot),
      cmocka_unit_test(threads_change_nothing),
      cmocka_unit_test(turning_all_changes_nothing),
      cmocka_unit_test(arrows_have_no_holes),
      cmocka_unit_test(far_arrows_take_nothing_away),
      cmocka_unit_test(a_stopped_context_stops_the_drawing),
  };
  return cmocka_run_group_tests_name("picture/render/render", tests, NULL, NULL);
}
