/* What pictures of the tests show, and the folder that they are written to. */
#ifndef FG__PICTURE_EXAMPLE_H
#define FG__PICTURE_EXAMPLE_H

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_test.h"
#include "icon/icons.h"

/* A field on [10, 40] x [-5, 15] with a hole, three arrows, and a density: with no frame
 * a picture of 300 points has 10 points a unit. */
typedef struct example {
  fg_context *context;
  fg_field *field;
  fg_icons *icons;
  fg_density *density;
  char folder[64];
} example;

enum { NX = 61, NY = 41 };

static const double speeds[] = {2.0, 5.5, 11.0};

static inline void add_arrow(example *e, double x, double y, double dx, double dy,
                             double speed)
{
  double points[5][3] = {{0}};
  for (int n = 0; n < 5; ++n) {
    points[n][0] = x + 0.25 * n * dx;
    points[n][1] = y + 0.25 * n * dy;
  }
  const double spine[2][3] = {{x, y + 2.0, 0.0}, {x + dx, y + dy + 2.0, 0.0}};
  double length = hypot(dx, dy);
  fg_icon icon = {.spine_count = 2,
                  .spine = spine,
                  .center = {x, y - 2.0},
                  .cluster = 1,
                  .point_count = 5,
                  .points = (const double(*)[3])points,
                  .width = 0.12 * length,
                  .tail_width = 0.05 * length,
                  .head_length = 0.3 * length,
                  .head_width = 0.3 * length,
                  .speed = speed};
  assert_int_equal(fg__icons_add(e->icons, e->context, &icon), FG_STATUS_OK);
}

static inline void make_field(example *e, bool periodic)
{
  static double x[NX], y[NY];
  static float u[NX * NY], v[NX * NY];
  for (int i = 0; i < NX; ++i)
    x[i] = 10.0 + 0.5 * i * (periodic ? 60.0 / 61.0 : 1.0);
  for (int j = 0; j < NY; ++j)
    y[j] = -5.0 + 0.5 * j;
  for (int n = 0; n < NX * NY; ++n) {
    double px = x[n % NX], py = y[n / NX];
    u[n] = hypot(px - 32.0, py - 10.0) < 3.0 ? NAN : 1.0F;
    v[n] = 0.5F;
  }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {NX, NY, 0},
                            .axis = {x, y, NULL},
                            .velocity = {u, v, NULL},
                            .velocity_units = "m/s",
                            .title = "Wind & waves <1 \xFF",
                            .level = "10 m"};
  arrays.period[0] = periodic ? 30.0 : 0.0;
  assert_int_equal(fg_field_create(&e->field, e->context, &arrays), FG_STATUS_OK);
}

static inline void make_density(example *e)
{
  static float u[NX * NY];
  for (int n = 0; n < NX * NY; ++n)
    u[n] = (float)(3.0 - hypot(10.0 + 0.5 * (n % NX) - 15.0, -5.0 + 0.5 * (n / NX)));
  fg_density_arrays arrays = {.dimension = 2,
                              .nodes = {NX, NY, 1},
                              .origin = {10.0, -5.0, 0.0},
                              .spacing = {0.5, 0.5, 0.0},
                              .u = u};
  assert_int_equal(fg_density_create_from_arrays(&e->density, e->context, &arrays),
                   FG_STATUS_OK);
}

static inline int example_set_up(void **state)
{
  example *e = calloc(1, sizeof *e);
  assert_non_null(e);
  assert_int_equal(fg_context_create(&e->context), FG_STATUS_OK);
  make_field(e, false);
  make_density(e);
  assert_int_equal(fg__icons_create_empty(&e->icons, e->context), FG_STATUS_OK);
  add_arrow(e, 13.0, 0.0, 6.0, 0.0, speeds[0]);
  add_arrow(e, 22.0, -2.0, 0.0, 7.0, speeds[1]);
  add_arrow(e, 36.0, 2.0, -5.0, -3.0, speeds[2]);
  snprintf(e->folder, sizeof e->folder, "/tmp/flowgrain-picture-XXXXXX");
  assert_non_null(mkdtemp(e->folder));
  *state = e;
  return 0;
}

static inline int files_in(const char *folder)
{
  DIR *listing = opendir(folder);
  assert_non_null(listing);
  int count = 0;
  for (struct dirent *entry; (entry = readdir(listing));)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
      ++count;
  closedir(listing);
  return count;
}

static inline void path_in(char path[160], const example *e, const char *name)
{
  snprintf(path, 160, "%s/%s", e->folder, name);
}

static inline int example_tear_down(void **state)
{
  example *e = *state;
  DIR *listing = opendir(e->folder);
  if (!listing)
    return -1;
  for (struct dirent *entry; (entry = readdir(listing));) {
    char path[400];
    snprintf(path, sizeof path, "%s/%s", e->folder, entry->d_name);
    unlink(path);
  }
  closedir(listing);
  rmdir(e->folder);
  fg_density_destroy(e->density);
  fg_icons_destroy(e->icons);
  fg_field_destroy(e->field);
  fg_context_destroy(e->context);
  free(e);
  return 0;
}

static inline void write_picture(const example *e, const char *name,
                                 const fg_picture_options *options)
{
  char path[160];
  path_in(path, e, name);
  fg_status status =
      fg_picture_write(e->context, path, e->field, e->density, e->icons, options);
  if (status)
    print_error("%s\n", fg_context_message(e->context));
  assert_int_equal(status, FG_STATUS_OK);
}

static inline char *read_file(const example *e, const char *name, size_t *size)
{
  char path[160];
  path_in(path, e, name);
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  char *bytes = calloc(*size + 1, 1);
  assert_non_null(bytes);
  assert_int_equal(fread(bytes, 1, *size, file), *size);
  fclose(file);
  return bytes;
}

#endif
