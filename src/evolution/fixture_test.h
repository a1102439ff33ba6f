/* A field that tests may spoil, and what they ask of it: shared by limits_test.c and
 * stationary_test.c. */
#ifndef FG__FIXTURE_TEST_H
#define FG__FIXTURE_TEST_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"

enum { SIDE = 65 };

typedef struct fixture {
  fg_context *context;
  double x[SIDE], y[SIDE];
  float u[SIDE * SIDE], v[SIDE * SIDE];
  unsigned char valid[SIDE * SIDE];
  fg_field_arrays arrays;
} fixture;

static inline int set_up(void **state)
{
  static fixture f;
  memset(&f, 0, sizeof f);
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i) {
      f.u[j * SIDE + i] = (float)(1.0 + 0.5 * sin(0.1 * j));
      f.v[j * SIDE + i] = (float)cos(0.07 * i);
      f.valid[j * SIDE + i] = 1;
    }
  for (int i = 0; i < SIDE; ++i) {
    f.x[i] = -2.0 + 3.0 * i / (SIDE - 1);
    f.y[i] = 7.0 + 2.3 * i / (SIDE - 1);
  }
  f.arrays = (fg_field_arrays){.dimension = 2,
                               .size = {SIDE, SIDE, 1},
                               .axis = {f.x, f.y},
                               .velocity = {f.u, f.v},
                               .valid = f.valid};
  *state = &f;
  return fg_context_create(&f.context) != FG_STATUS_OK;
}

static inline int tear_down(void **state)
{
  fg_context_destroy(((fixture *)*state)->context);
  return 0;
}

static inline fg_field *make(fixture *f)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, f->context, &f->arrays), FG_STATUS_OK);
  return field;
}

static inline void refuses(fixture *f, const fg_evolution_options *options,
                           const char *words)
{
  fg_field *field = make(f);
  fg_evolution *evolution = (fg_evolution *)f; /* must be cleared */
  assert_int_equal(fg_evolution_create(&evolution, f->context, field, options),
                   FG_STATUS_ARGUMENT);
  assert_null(evolution);
  const char *message = fg_context_message(f->context);
  if (!strstr(message, words) || strchr(message, '\n'))
    fail_msg("\"%s\" does not say \"%s\" in one line", message, words);
  fg_context_clear(f->context);
  fg_field_destroy(field);
}

/* Whether a node adjoins an active cell. */
static inline bool alive(const fg_density_arrays *d, int i, int j)
{
  int cells[2];
  for (int k = 0; k < 2; ++k)
    cells[k] = d->nodes[k] - !d->periodic[k];
  for (int a = 0; a < 4; ++a) {
    int x = i - a % 2, y = j - a / 2;
    if (d->periodic[0])
      x = (x + cells[0]) % cells[0];
    if (d->periodic[1])
      y = (y + cells[1]) % cells[1];
    if (x >= 0 && y >= 0 && x < cells[0] && y < cells[1] &&
        (!d->active || d->active[y * cells[0] + x]))
      return true;
  }
  return false;
}

#endif
