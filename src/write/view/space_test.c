/* What the page of a run in 3D holds, read back by the definitions of Base64 and zlib. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "file/base64.h"
#include "write/view/parts.h"

/* The numbers that follow "name": in a text; *count is how many. */
static int32_t *read_packed(const char *text, const char *name, size_t *count)
{
  char key[40];
  snprintf(key, sizeof key, "\"%s\":\"", name);
  const char *first = strstr(text, key);
  assert_non_null(first);
  first += strlen(key);
  const size_t length = (size_t)(strchr(first, '"') - first);
  fg__base64 coded = {.text = (const unsigned char *)first, .size = length};
  size_t size = length / 4 * 3 - (first[length - 1] == '=') - (first[length - 2] == '=');
  unsigned char *packed = malloc(size), *plane = malloc(1 << 22);
  assert_true(packed && plane);
  assert_true(fg__base64_read(&coded, packed, size));
  uLongf bytes = 1 << 22;
  assert_int_equal(uncompress(plane, &bytes, packed, (uLong)size), Z_OK);
  *count = bytes / 4;
  int32_t *out = malloc(bytes + 1);
  assert_non_null(out);
  uint32_t value = 0;
  for (size_t n = 0; n < *count; ++n) {
    uint32_t zigzag = 0;
    for (size_t k = 0; k < 4; ++k)
      zigzag |= (uint32_t)plane[k * *count + n] << 8 * k;
    value += zigzag & 1U ? ~(zigzag >> 1) : zigzag >> 1;
    memcpy(&out[n], &value, sizeof value);
  }
  free(packed);
  free(plane);
  return out;
}

static void packed_numbers_come_back(void **state)
{
  (void)state;
  enum { COUNT = 1000 };
  int32_t values[COUNT] = {0, INT32_MAX, INT32_MIN, -1, INT32_MAX, 7, 7, -70000};
  for (int n = 8; n < COUNT; ++n)
    values[n] = n * n % 4093 - 2000;
  char *text = NULL;
  size_t length = 0, count;
  FILE *stream = open_memstream(&text, &length);
  assert_non_null(stream);
  fputs("\"values\":", stream);
  assert_true(fg__view_packed(stream, values, COUNT));
  fclose(stream);
  int32_t *back = read_packed(text, "values", &count);
  assert_int_equal(count, COUNT);
  assert_memory_equal(back, values, sizeof values);
  free(back);
  free(text);
}

/* A ball of radius 0.3 about (0.4, 0.5, 0.55), as a density. */
static fg_surface *make_ball(void)
{
  enum { NODES = 49 };
  static float u[NODES * NODES * NODES];
  for (int n = 0; n < NODES * NODES * NODES; ++n) {
    const double x = n % NODES / (NODES - 1.0) - 0.4,
                 y = n / NODES % NODES / (NODES - 1.0) - 0.5,
                 z = n / (NODES * NODES) / (NODES - 1.0) - 0.55;
    u[n] = (float)(0.3 - sqrt(x * x + y * y + z * z));
  }
  fg_density *density;
  fg_surface *surface;
  const double step = 1.0 / (NODES - 1);
  const fg_density_arrays arrays = {.dimension = 3,
                                    .nodes = {NODES, NODES, NODES},
                                    .spacing = {step, step, step},
                                    .u = u};
  assert_int_equal(fg_density_create_from_arrays(&density, NULL, &arrays), FG_STATUS_OK);
  assert_int_equal(fg_density_surface(&surface, NULL, density), FG_STATUS_OK);
  fg_density_destroy(density);
  return surface;
}

static void a_surface_of_fewer_vertices_holds_as_much(void **state)
{
  (void)state;
  fg_surface *ball = make_ball();
  const double low[3] = {0.0, 0.0, 0.0}, high[3] = {1.0, 1.0, 1.0};
  char *text = NULL;
  size_t length = 0, corners, vertices;
  FILE *stream = open_memstream(&text, &length);
  assert_non_null(stream);
  assert_int_equal(fg__view_surface(stream, NULL, ball, low, high, 30), FG_STATUS_OK);
  fclose(stream);
  int32_t *corner = read_packed(text, "triangles", &corners), *place[3];
  static const char *const names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    place[k] = read_packed(text, names[k], &vertices);
  assert_in_range(vertices, 300, ball->vertex_count * 2 / 3);
  double volume = 0.0;
  for (size_t t = 0; t < corners; t += 3) {
    double p[3][3];
    for (int c = 0; c < 3; ++c) {
      assert_in_range(corner[t + (size_t)c], 0, vertices - 1);
      for (int k = 0; k < 3; ++k)
        p[c][k] = (double)place[k][corner[t + (size_t)c]] / FG__VIEW_STEPS;
    }
    volume += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
               p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
              6.0;
  }
  const double exact = 4.0 / 3.0 * acos(-1.0) * 0.027;
  assert_true(fabs(volume / exact - 1.0) < 0.02);
  for (size_t n = 0; n < vertices; ++n) {
    const double x = (double)place[0][n] / FG__VIEW_STEPS - 0.4,
                 y = (double)place[1][n] / FG__VIEW_STEPS - 0.5,
                 z = (double)place[2][n] / FG__VIEW_STEPS - 0.55;
    assert_true(fabs(sqrt(x * x + y * y + z * z) - 0.3) < 3e-3);
  }
  for (int k = 0; k < 3; ++k)
    free(place[k]);
  free(corner);
  free(text);
  fg_surface_destroy(ball);
}

static void a_page_in_3d_needs_scales(void **state)
{
  (void)state;
  fg_field *field;
  assert_int_equal(fg_field_create_analytic(&field, NULL, "abc", 9), FG_STATUS_OK);
  assert_int_equal(fg_view_write(NULL, "never.html", field, NULL), FG_STATUS_ARGUMENT);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(packed_numbers_come_back),
      cmocka_unit_test(a_surface_of_fewer_vertices_holds_as_much),
      cmocka_unit_test(a_page_in_3d_needs_scales)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
