/* A mesh that is coarsened, on several ranks: the bits of one rank alone, also after a
 * checkpoint. */
#include "evolution/checkpoint/place_test.h"
#include "evolution/steps_test.h"

enum { SAMPLES = 33, BEFORE = 6, BETWEEN = 4, AFTER = 4 };

static fg_evolution *begin(const fg_field *field, const fg__ranks *ranks,
                           const fg_evolution_options *options)
{
  fg_evolution *e;
  expect(fg__evolution_create(&e, us.context, ranks, field, options) == FG_STATUS_OK);
  return e;
}

/* Rank 0 takes the same steps alone. */
static void compare_with_one(const fg_field *field, const fg_evolution_options *options,
                             const fg_step *before, const fg_step *coarsened,
                             const fg_step *after)
{
  fg_evolution *one = begin(field, &fg__single_rank, options);
  fg_step step = advance(one, BEFORE);
  expect_same(&step, before);
  expect(fg_evolution_coarsen(one, &step) == FG_STATUS_OK);
  expect_same(&step, coarsened);
  step = advance(one, BETWEEN + AFTER);
  expect_same(&step, after);
  fg_evolution_destroy(one);
}

static void compare(const char *name, const fg_evolution_options *options)
{
  fg_field *field;
  expect(fg_field_create_analytic(&field, us.context, name, SAMPLES) == FG_STATUS_OK);
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
  if (us.ranks->rank == 0)
    compare_with_one(field, options, &before, &coarsened, &after);
  fg_evolution_destroy(all);
  fg_evolution_destroy(later);
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

/* 64 x 16 cells are enough for four ranks, half as many for two. */
static void more_ranks_than_the_coarsened_mesh_has_blocks_for_are_refused(void **state)
{
  (void)state;
  const fg__ranks *alone = &fg__single_rank;
  const fg_evolution_options options = {.nodes = 65};
  fg_field *field = strip();
  fg_evolution *one = begin(field, alone, &options),
               *all = begin(field, us.ranks, &options);
  fg_step a = advance(one, BEFORE), b = advance(all, BEFORE), coarsened;
  expect_same(&a, &b);
  fg_status status = fg_evolution_coarsen(all, &coarsened);
  expect(status == (us.ranks->count > 2 ? FG_STATUS_ARGUMENT : FG_STATUS_OK));
  if (status) {
    expect(strstr(fg_context_message(us.context), "2 ranks fit") != NULL);
    a = advance(one, AFTER); /* nothing has changed */
    b = advance(all, AFTER);
    expect_same(&a, &b);
  }
  fg_evolution_destroy(one);
  fg_evolution_destroy(all);
  fg_field_destroy(field);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(a_coarsened_mesh_has_the_bits_of_one_rank),
      TOGETHER(more_ranks_than_the_coarsened_mesh_has_blocks_for_are_refused),
  };
  return cmocka_run_group_tests_name("evolution/coarsen_together", tests, name_checkpoint,
                                     remove_checkpoint);
}
