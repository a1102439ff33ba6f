/* A mesh that is coarsened, on several ranks: the bits of one rank alone, also after a
 * checkpoint. */
#include "evolution/checkpoint/place_test.h"
#include "evolution/steps_test.h"

#include <stdlib.h>

enum { SAMPLES = 33, BEFORE = 6, BETWEEN = 4, AFTER = 4 };

static fg_evolution *begin(const fg_field *field, const fg__ranks *ranks,
                           const fg_evolution_options *options)
{
  fg_evolution *e;
  expect(fg__evolution_create(&e, us.context, ranks, field, options) == FG_STATUS_OK);
  return e;
}

/* What all ranks see of their last state, on rank 0. */
static fg_density *gather(const fg_evolution *all)
{
  fg_density *shared, *out = NULL;
  expect(fg_density_create(&shared, all) == FG_STATUS_OK);
  if (us.ranks->count == 1)
    return shared;
  expect(fg_density_gather(&out, us.context, shared) == FG_STATUS_OK);
  fg_density_destroy(shared);
  return out;
}

static void expect_same_density(const fg_density *a, const fg_density *b)
{
  const fg_density_arrays *of_a = fg_density_contents(a), *of_b = fg_density_contents(b);
  const int *nodes = of_a->nodes;
  size_t count = (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
  expect(memcmp(nodes, of_b->nodes, sizeof of_a->nodes) == 0);
  expect(memcmp(of_a->u, of_b->u, count * sizeof(float)) == 0);
  expect(memcmp(fg_density_labels(a), fg_density_labels(b), count * sizeof(int)) == 0);
}

/* Rank 0 takes the same steps alone. */
static void compare_with_one(const fg_field *field, const fg_evolution_options *options,
                             const fg_step *before, const fg_step *coarsened,
                             const fg_step *after, const fg_density *last)
{
  fg_evolution *one = begin(field, &fg__single_rank, options);
  fg_density *density;
  fg_step step = advance(one, BEFORE);
  expect_same(&step, before);
  expect(fg_evolution_coarsen(one, &step) == FG_STATUS_OK);
  expect_same(&step, coarsened);
  step = advance(one, BETWEEN + AFTER);
  expect_same(&step, after);
  expect(fg_density_create(&density, one) == FG_STATUS_OK);
  expect_same_density(density, last);
  fg_density_destroy(density);
  fg_evolution_destroy(one);
}

static void compare_on(const fg_field *field, const fg_evolution_options *options)
{
  fg_evolution *all = begin(field, us.ranks, options);
  fg_step before = advance(all, BEFORE), coarsened, after, resumed;
  expect(fg_evolution_coarsen(all, &coarsened) == FG_STATUS_OK);
  advance(all, BETWEEN);
  expect(fg_evolution_save(all, path, "halved") == FG_STATUS_OK);

  fg_checkpoint *checkpoint;
  expect(fg__checkpoint_open(&checkpoint, us.context, path, us.ranks) == FG_STATUS_OK);
  fg_evolution *later = begin(field, us.ranks, options);
  expect(fg_evolution_resume(later, &resumed, checkpoint) == FG_STATUS_OK);
  fg_checkpoint_destroy(checkpoint);
  resumed = advance(later, AFTER);
  after = advance(all, AFTER);
  expect_same(&after, &resumed);
  expect_alike(&before);
  expect_alike(&coarsened);
  expect_alike(&after);
  fg_density *last = gather(all);
  if (us.ranks->rank == 0)
    compare_with_one(field, options, &before, &coarsened, &after, last);
  fg_density_destroy(last);
  fg_evolution_destroy(all);
  fg_evolution_destroy(later);
}

static void compare(const char *name, const fg_evolution_options *options)
{
  fg_field *field;
  expect(fg_field_create_analytic(&field, us.context, name, SAMPLES) == FG_STATUS_OK);
  compare_on(field, options);
  fg_field_destroy(field);
}

static void a_coarsened_mesh_has_the_bits_of_one_rank(void **state)
{
  (void)state;
  compare("vortex3", &(fg_evolution_options){.nodes = 129, .seed = 3});
  compare("benard", &(fg_evolution_options){.nodes = 129}); /* periodic */
  compare("vortex3", &(fg_evolution_options){.nodes = 65, .scheme = FG_SCHEME_THETA});
  compare("abc", &(fg_evolution_options){.nodes = 33}); /* 3D, periodic */
  compare("vortex3d", &(fg_evolution_options){.nodes = 33});
  end_together();
}

/* Two seas that a wall divides, one of them with an island. */
static void compare_masked(const char *name, const fg_evolution_options *options)
{
  fg_field *field, *masked;
  expect(fg_field_create_analytic(&field, us.context, name, SAMPLES) == FG_STATUS_OK);
  fg_field_arrays arrays = *fg_field_contents(field);
  const int *size = arrays.size;
  size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
  unsigned char *valid = calloc(count, 1);
  expect(valid != NULL);
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        int x = 5 * (i - 24), y = 4 * (j - 18), z = k - size[2] / 2;
        bool wall = i >= 11 && i <= 13, island = x * x + y * y + z * z < 300;
        valid[((size_t)k * (size_t)size[1] + (size_t)j) * (size_t)size[0] + (size_t)i] =
            !wall && !island;
      }
  arrays.valid = valid;
  expect(fg_field_create(&masked, us.context, &arrays) == FG_STATUS_OK);
  free(valid);
  compare_on(masked, options);
  fg_field_destroy(masked);
  fg_field_destroy(field);
}

static void a_coarsened_mask_has_the_bits_of_one_rank(void **state)
{
  (void)state;
  compare_masked("vortex3", &(fg_evolution_options){.nodes = 129, .seed = 3});
  compare_masked("vortex3",
                 &(fg_evolution_options){.nodes = 65, .scheme = FG_SCHEME_THETA});
  compare_masked("vortex3d", &(fg_evolution_options){.nodes = 33});
  end_together();
}

/* A strip four times as long as wide. */
static fg_field *strip(void)
{
  enum { COLUMNS = 33, ROWS = 9 };
  double x[COLUMNS], y[ROWS];
  float u[ROWS * COLUMNS], v[ROWS * COLUMNS];
  for (int i = 0; i < COLUMNS; ++i)
    x[i] = 0.125 * i;
  for (int j = 0; j < ROWS; ++j)
    y[j] = 0.125 * j;
  for (int n = 0; n < ROWS * COLUMNS; ++n) {
    u[n] = 1.0F + 0.1F * (float)(n % 7);
    v[n] = 0.2F * (float)(n % 5) - 0.3F;
  }
  const fg_field_arrays arrays = {
      .dimension = 2, .size = {COLUMNS, ROWS}, .axis = {x, y}, .velocity = {u, v}};
  fg_field *field;
  expect(fg_field_create(&field, us.context, &arrays) == FG_STATUS_OK);
  return field;
}

/* 64 x 16 cells are enough for four ranks, half as many for two: the others fall idle,
 * also after a checkpoint. */
static void ranks_that_no_longer_fit_fall_idle(void **state)
{
  (void)state;
  fg_field *field = strip();
  compare_on(field, &(fg_evolution_options){.nodes = 65});
  compare_on(field, &(fg_evolution_options){.nodes = 65, .scheme = FG_SCHEME_THETA});
  fg_field_destroy(field);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(a_coarsened_mesh_has_the_bits_of_one_rank),
      TOGETHER(a_coarsened_mask_has_the_bits_of_one_rank),
      TOGETHER(ranks_that_no_longer_fit_fall_idle),
  };
  return cmocka_run_group_tests_name("evolution/coarsen_together", tests, name_checkpoint,
                                     remove_checkpoint);
}
