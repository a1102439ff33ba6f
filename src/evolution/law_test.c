#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"

typedef struct fixture {
  fg_context *context;
  fg_field *field;
} fixture;

static int set_up(void **state)
{
  static fixture f;
  *state = &f;
  return fg_context_create(&f.context) != FG_STATUS_OK ||
         fg_field_create_analytic(&f.field, f.context, "vortex3", 65) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  fixture *f = *state;
  fg_field_destroy(f->field);
  fg_context_destroy(f->context);
  return 0;
}

/* The flow energy written anew, but for the length in `data` that it must carry along. */
static void along_the_stream(double a[6], const fg_energy_place *place, const void *data)
{
  const double *length = data;
  double u = *length * place->direction[0], v = *length * place->direction[1];
  double square = u * u + v * v, cost = place->anisotropy;
  a[0] = (u * u + cost * v * v) / square;
  a[1] = (1.0 - cost) * u * v / square;
  a[2] = (v * v + cost * u * u) / square;
}

static void along_one_line(double a[6], const fg_energy_place *place, const void *data)
{
  const double *e = data;
  double cost = place->anisotropy;
  a[0] = cost + (1.0 - cost) * e[0] * e[0];
  a[1] = (1.0 - cost) * e[0] * e[1];
  a[2] = cost + (1.0 - cost) * e[1] * e[1];
}

static fg_density *after_steps(fixture *f, const fg_evolution_options *options, int steps)
{
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_step step;
  assert_int_equal(fg_evolution_create(&evolution, f->context, f->field, options),
                   FG_STATUS_OK);
  for (int n = 0; n < steps; ++n)
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  fg_evolution_destroy(evolution);
  return density;
}

static double largest_difference(const fg_density *one, const fg_density *other)
{
  const fg_density_arrays *a = fg_density_contents(one), *b = fg_density_contents(other);
  size_t count = (size_t)a->nodes[0] * (size_t)a->nodes[1];
  double most = 0.0;
  for (size_t n = 0; n < count; ++n)
    most = fmax(most, fabs((double)(a->u[n] - b->u[n])));
  return most;
}

static void a_law_can_be_what_an_energy_is(void **state)
{
  fixture *f = *state;
  const double length = 2.75;
  fg_energy_law law = {
      .name = "stream", .tensor = along_the_stream, .data = &length, .axes = true};
  fg_density *ours =
      after_steps(f, &(fg_evolution_options){.nodes = 65, .anisotropy = 0.21}, 30);
  fg_density *theirs = after_steps(
      f, &(fg_evolution_options){.nodes = 65, .anisotropy = 0.21, .law = &law}, 30);
  /* rounding of the tensor, before it grows much */
  assert_true(largest_difference(ours, theirs) < 0.02);
  fg_density_destroy(ours);
  fg_density_destroy(theirs);
}

/* Sum of squared differences along x and along y, (du/dx)^2 against (du/dy)^2. */
static void roughness(const fg_density *density, double sum[2])
{
  const fg_density_arrays *a = fg_density_contents(density);
  size_t width = (size_t)a->nodes[0];
  sum[0] = sum[1] = 0.0;
  for (int j = 0; j + 1 < a->nodes[1]; ++j)
    for (int i = 0; i + 1 < a->nodes[0]; ++i) {
      const float *u = a->u + (size_t)j * width + (size_t)i;
      sum[0] += pow((double)(u[1] - u[0]), 2.0);
      sum[1] += pow((double)(u[width] - u[0]), 2.0);
    }
}

static void clusters_follow_the_law_and_not_the_field(void **state)
{
  fixture *f = *state;
  const double along_x[2] = {1.0, 0.0}, along_y[2] = {0.0, 1.0};
  fg_energy_law law = {.name = "line", .tensor = along_one_line, .data = along_x};
  fg_evolution_options options = {.nodes = 65, .law = &law};
  double sum[2];
  fg_density *density = after_steps(f, &options, 60);
  roughness(density, sum);
  assert_true(sum[1] > 2.0 * sum[0]);
  fg_density_destroy(density);
  law.data = along_y;
  density = after_steps(f, &options, 60);
  roughness(density, sum);
  assert_true(sum[0] > 2.0 * sum[1]);
  fg_density_destroy(density);
}

static void refuses(fixture *f, const fg_energy_law *law, const char *part_of_message)
{
  fg_evolution *evolution = NULL;
  fg_evolution_options options = {.nodes = 33, .law = law};
  assert_int_equal(fg_evolution_create(&evolution, f->context, f->field, &options),
                   FG_STATUS_ARGUMENT);
  assert_null(evolution);
  assert_non_null(strstr(fg_context_message(f->context), part_of_message));
  fg_context_clear(f->context);
}

static void a_law_out_of_range_is_refused(void **state)
{
  fixture *f = *state;
  const double twice[2] = {1.2, 0.9}, half[2] = {0.3, 0.4}, none[2] = {(double)NAN, 1.0};
  fg_energy_law law = {.name = "line", .tensor = along_one_line, .data = twice};
  refuses(f, &law, "energy line: the tensor's eigenvalues go from 0.15 to 2.0625 at (");
  law.data = none;
  refuses(f, &law, "energy line");
  law.data = half; /* 0.15 + 0.85 / 4 is within the range */
  fg_evolution *evolution = NULL;
  fg_evolution_options options = {.nodes = 33, .law = &law};
  assert_int_equal(fg_evolution_create(&evolution, f->context, f->field, &options),
                   FG_STATUS_OK);
  fg_evolution_destroy(evolution);
  law.tensor = NULL;
  refuses(f, &law, "no such energy");
}

/* What a law stands on belongs to its checkpoint. */
static void a_checkpoint_goes_on_with_the_same_law_only(void **state)
{
  fixture *f = *state;
  const double e[2] = {0.6, 0.8};
  fg_energy_law law = {
      .name = "line", .tensor = along_one_line, .data = e, .identity = 41};
  fg_evolution_options options = {.nodes = 33, .law = &law};
  fg_evolution *evolution = NULL;
  fg_checkpoint *checkpoint = NULL;
  fg_step step;
  char path[] = "law_test.checkpoint.XXXXXX";
  assert_non_null(mkdtemp(path));
  char file[sizeof path + 8];
  snprintf(file, sizeof file, "%s/state", path);
  assert_int_equal(fg_evolution_create(&evolution, f->context, f->field, &options),
                   FG_STATUS_OK);
  assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
  assert_int_equal(fg_evolution_save(evolution, file, NULL), FG_STATUS_OK);
  fg_evolution_destroy(evolution);
  assert_int_equal(fg_checkpoint_open(&checkpoint, f->context, file), FG_STATUS_OK);
  for (uint64_t identity = 41; identity <= 42; ++identity) {
    law.identity = identity;
    assert_int_equal(fg_evolution_create(&evolution, f->context, f->field, &options),
                     FG_STATUS_OK);
    assert_int_equal(fg_evolution_resume(evolution, &step, checkpoint),
                     identity == 41 ? FG_STATUS_OK : FG_STATUS_ARGUMENT);
    fg_evolution_destroy(evolution);
  }
  assert_non_null(strstr(fg_context_message(f->context), "law"));
  fg_checkpoint_destroy(checkpoint);
  remove(file);
  remove(path);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_law_can_be_what_an_energy_is),
      CASE(clusters_follow_the_law_and_not_the_field),
      CASE(a_law_out_of_range_is_refused),
      CASE(a_checkpoint_goes_on_with_the_same_law_only),
  };
  return cmocka_run_group_tests_name("evolution/law", tests, NULL, NULL);
}
