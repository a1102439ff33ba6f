#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/context_test.h"
#include "file/base64.h"
#include "icon/icons.h"
#include "picture/solid_field_test.h"
#include "write/vtp.h"

static const char *const path = "vtp_test.vtp";

static char *read_text(void)
{
  FILE *stream = fopen(path, "rb");
  assert_non_null(stream);
  char *text = calloc(1, 1 << 20);
  assert_non_null(text);
  assert_true(fread(text, 1, (1 << 20) - 1, stream) < (1 << 20) - 1);
  fclose(stream);
  return text;
}

/* Decodes an array of one block by its name; returns how many bytes it has. */
static size_t read_array(const char *text, const char *name, void *out, size_t room)
{
  char tag[64];
  snprintf(tag, sizeof tag, "Name=\"%s\"", name);
  const char *at = strstr(text, tag);
  assert_non_null(at);
  at = strchr(at, '>') + 1;
  fg__base64 base64 = {.text = (const unsigned char *)at,
                       .size = (size_t)(strchr(at, '<') - at)};
  uint64_t header[4]; /* blocks, bytes of one, of the last, of it compressed */
  assert_true(fg__base64_read(&base64, (unsigned char *)header, sizeof header));
  assert_int_equal(header[0], 1);
  unsigned char *packed = malloc((size_t)header[3]);
  assert_non_null(packed);
  assert_true(fg__base64_read(&base64, packed, (size_t)header[3]));
  uLongf bytes = (uLongf)room;
  assert_int_equal(uncompress(out, &bytes, packed, (uLong)header[3]), Z_OK);
  free(packed);
  return (size_t)bytes;
}

/* The clusters' surface belongs to none of them: all its numbers are 0, and `part` tells
 * it from the icons, which keep theirs. */
static void a_surface_has_numbers(void **state)
{
  (void)state;
  enum { MOST = 4096 };
  static double speed[MOST], volume[MOST];
  static unsigned char part[MOST];
  static int cluster[MOST];
  const double points[3][3] = {{0, 0, 0}, {1, 0.2, 0}, {2, 0.6, 0.1}};
  const fg_icon icon = {.cluster = 7,
                        .point_count = 3,
                        .points = points,
                        .width = 0.2,
                        .tail_width = 0.1,
                        .head_length = 0.5,
                        .head_width = 0.4,
                        .speed = 2.5,
                        .area = 0.75};
  fg_icons *icons = NULL;
  fg_surface *surface = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  assert_int_equal(fg_icon_solid(&surface, NULL, &icon), FG_STATUS_OK);
  assert_int_equal(fg__vtp_write(NULL, path, NULL, icons, surface), FG_STATUS_OK);
  char *text = read_text();
  size_t count = read_array(text, "part", part, sizeof part);
  assert_int_equal(read_array(text, "speed", speed, sizeof speed), 8 * count);
  assert_int_equal(read_array(text, "volume", volume, sizeof volume), 8 * count);
  assert_int_equal(read_array(text, "cluster", cluster, sizeof cluster), 4 * count);
  size_t of_surface = 0;
  for (size_t n = 0; n < count; ++n) {
    const bool clusters = part[n] == FG__VTP_CLUSTER;
    of_surface += clusters;
    assert_true(speed[n] == (clusters ? 0.0 : 2.5));
    assert_true(volume[n] == (clusters ? 0.0 : 0.75));
    assert_int_equal(cluster[n], clusters ? 0 : 7);
  }
  assert_int_equal(of_surface, surface->triangle_count);
  free(text);
  unlink(path);
  fg_surface_destroy(surface);
  fg_icons_destroy(icons);
}

/* Speed 1 at the side of least x, 5 at the other. */
static bool faster_along_x(const double place[3], double velocity[3])
{
  velocity[1] = 1.0 + 2.0 * (place[0] - field_low[0]);
  return true;
}

/* Each point of the lines and of the solid has the speed of the flow at its place along
 * its line, not the arrow's mean. */
static void points_have_the_speed_of_the_flow_there(void **state)
{
  (void)state;
  enum { MOST = 4096, LINE = 5 };
  static float speed[MOST];
  static double place[MOST][3];
  double arrow[LINE][3], line[LINE][3];
  for (int n = 0; n < LINE; ++n)
    for (int k = 0; k < 3; ++k) {
      arrow[n][k] = (double[]){4.5 - 0.3 * n, -0.3, 10.2}[k];
      line[n][k] = (double[]){3.3 + 0.3 * n, -0.5, 10.3}[k];
    }
  const fg_icon icon = {.cluster = 1,
                        .point_count = LINE,
                        .points = (const double(*)[3])arrow,
                        .width = 0.02,
                        .tail_width = 0.01,
                        .head_length = 0.2,
                        .head_width = 0.05,
                        .center = {3.4, -0.4, 10.4},
                        .speed = 9.0,
                        .spine = (const double(*)[3])line,
                        .spine_count = LINE,
                        .streamline = (const double(*)[3])line,
                        .streamline_count = LINE};
  fg_icons *icons = NULL;
  fg_field *field = field_of(faster_along_x);
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  assert_int_equal(fg__vtp_write(NULL, path, field, icons, NULL), FG_STATUS_OK);
  char *text = read_text();
  size_t count = read_array(text, "local_speed", speed, sizeof speed) / sizeof *speed;
  assert_int_equal(read_array(text, "Points", place, sizeof place), 24 * count);
  assert_true(count > 1 + 2 * LINE);
  for (size_t n = 0; n < count; ++n)
    assert_true(fabs((double)speed[n] - (1.0 + 2.0 * (place[n][0] - 3.0))) < 1e-4);
  free(text);
  unlink(path);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_surface_has_numbers),
      cmocka_unit_test(points_have_the_speed_of_the_flow_there),
  };
  return cmocka_run_group_tests_name("write/vtp", tests, NULL, NULL);
}
