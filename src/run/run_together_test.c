/* A run of scales on several ranks gives what one rank gives, to the bit. */
#include "flowgrain/run.h"

#include "evolution/evolution.h"
#include "grid/together_test.h"

#include <string.h>

enum { NUMBERS = 2 };
static const int numbers[NUMBERS] = {30, 12};

/* The same evolution on rank 0 alone, step by step. */
typedef struct reference {
  fg_evolution *evolution;
  fg_step step;
  fg_placement *placement;
  fg_icons *icons;
} reference;

static void go_on(reference *r, const fg_field *field, bool placed, int k)
{
  fg_density *density = NULL;
  fg_icons *finer = placed ? r->icons : NULL;
  while (!r->step.clusters || r->step.clusters > numbers[k])
    expect(fg_evolution_step(r->evolution, &r->step) == FG_STATUS_OK);
  expect(fg_density_create(&density, r->evolution) == FG_STATUS_OK);
  fg_icons *before = r->icons;
  if (placed)
    expect(fg_run_place(&r->icons, us.context, r->placement, numbers[k], density, false,
                        finer) == FG_STATUS_OK);
  else
    expect(fg_icons_create(&r->icons, us.context, field, density,
                           &(fg_icon_options){.extent = FG_EXTENT_CLUSTER}) ==
           FG_STATUS_OK);
  fg_icons_destroy(before);
  fg_density_destroy(density);
}

static void compare(const fg_icons *got, const fg_icons *want)
{
  expect(fg_icons_count(got) == fg_icons_count(want));
  for (int n = 0; n < fg_icons_count(want) && n < fg_icons_count(got); ++n) {
    const fg_icon *a = fg_icons_at(got, n), *b = fg_icons_at(want, n);
    expect(a->point_count == b->point_count && a->cluster == b->cluster &&
           a->id == b->id);
    if (a->point_count == b->point_count)
      expect(memcmp(a->points, b->points, (size_t)a->point_count * sizeof *a->points) ==
             0);
  }
}

static void check(const char *name, fg_run_kind kind)
{
  const bool placed = kind == FG_RUN_ARROWS;
  const fg_run_options options = {.kind = kind,
                                  .numbers = numbers,
                                  .count = NUMBERS,
                                  .evolution = {.nodes = 97, .seed = 3},
                                  .placement = {.effort = FG_EFFORT_QUICK}};
  fg_field *field = NULL;
  fg_run *run = NULL;
  const fg_run_scale *scale = NULL;
  reference r = {.evolution = NULL};
  expect(fg_field_create_analytic(&field, us.context, name, 33) == FG_STATUS_OK);
  expect(fg__evolution_create(&r.evolution, us.context, &fg__single_rank, field,
                              &options.evolution) == FG_STATUS_OK);
  expect(fg_placement_create(&r.placement, us.context, field, &options.placement) ==
         FG_STATUS_OK);
  expect(fg_run_create(&run, us.context, field, &options) == FG_STATUS_OK);
  for (int k = 0; k < NUMBERS; ++k) {
    expect(fg_run_next(&scale, run) == FG_STATUS_OK);
    expect(scale != NULL);
    if (!scale)
      break;
    expect((scale->icons != NULL) == (us.ranks->rank == 0));
    expect(scale->wanted[0] == numbers[k]);
    expect(fg__ranks_alike(us.ranks, (uint64_t)scale->step.step));
    if (us.ranks->rank == 0) {
      go_on(&r, field, placed, k);
      expect(scale->step.step == r.step.step);
      if (scale->icons)
        compare(scale->icons, r.icons);
    }
    if (placed)
      expect((scale->density != NULL) == (us.ranks->rank == 0));
    else
      expect(fg_density_is_distributed(scale->density) == (us.ranks->count > 1));
  }
  expect(fg_run_next(&scale, run) == FG_STATUS_OK && !scale);
  fg_run_destroy(run);
  fg_icons_destroy(r.icons);
  fg_placement_destroy(r.placement);
  fg_evolution_destroy(r.evolution);
  fg_field_destroy(field);
}

static void ranks_give_the_scales_of_one(void **state)
{
  (void)state;
  check("vortex3", FG_RUN_CLUSTERS);
  check("vortex3", FG_RUN_ARROWS);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {TOGETHER(ranks_give_the_scales_of_one)};
  return cmocka_run_group_tests_name("run/run_together", tests, NULL, NULL);
}
