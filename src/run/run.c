#include "run/run.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "icon/icons.h"
#include "place/placement.h"

static fg_status check_times(fg_context *context, const fg_run_options *o)
{
  if (o->count < 1 || o->count > FG_MOST_SCALES || !o->times)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "scales: %d times given; 1 to %d are possible", o->count,
                    FG_MOST_SCALES);
  for (int k = 0; k < o->count; ++k)
    if (!isfinite(o->times[k]) || !(o->times[k] > (k > 0 ? o->times[k - 1] : 0.0)))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "scales: time %d is %g; they must ascend from above 0", k,
                      o->times[k]);
  return FG_STATUS_OK;
}

static fg_status check_numbers(fg_context *context, const fg_run_options *o)
{
  if (o->count < 0 || o->count > FG_MOST_SCALES || (o->count > 0 && !o->numbers))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "scales: %d numbers given, %d at most are possible", o->count,
                    FG_MOST_SCALES);
  for (int k = 0; k < o->count; ++k)
    if (o->numbers[k] < 1 || (k > 0 && o->numbers[k] >= o->numbers[k - 1]))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "scales: number %d is %d; they must descend, to 1 at least", k,
                      o->numbers[k]);
  return FG_STATUS_OK;
}

static fg_status check(fg_context *context, const fg_run_options *o)
{
  if (o->kind != FG_RUN_ARROWS && o->kind != FG_RUN_CLUSTERS && o->kind != FG_RUN_TIMES)
    return fg__fail(context, FG_STATUS_ARGUMENT, "scales: there is no kind %d",
                    (int)o->kind);
  fg_status status =
      o->kind == FG_RUN_TIMES ? check_times(context, o) : check_numbers(context, o);
  if (status)
    return status;
  if (o->kind == FG_RUN_ARROWS && o->count > 0 && o->numbers[0] > FG__MOST_ARROWS)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%d arrows are too many to be placed: %d can be", o->numbers[0],
                    FG__MOST_ARROWS);
  if (o->first && (o->kind != FG_RUN_ARROWS || o->count < 1 ||
                   fg_icons_count(o->first) != o->numbers[0]))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "scales: %d icons are given for the first, of %d arrows",
                    fg_icons_count(o->first),
                    o->kind == FG_RUN_ARROWS && o->count > 0 ? o->numbers[0] : 0);
  if (!(o->max_time >= 0.0) || o->max_steps < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "scales: max_time %g and max_steps %" PRId64 " must not be negative",
                    o->max_time, o->max_steps);
  return FG_STATUS_OK;
}

fg_status fg_run_create(fg_run **out, fg_context *context, const fg_field *field,
                        const fg_run_options *options)
{
  const fg_run_options o = options ? *options : (fg_run_options){.count = 0};
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "scales: a NULL argument");
  *out = NULL;
  fg_status status = check(context, &o);
  if (status)
    return status;
  fg_run *s = fg__allocate(1, sizeof *s);
  if (!s)
    return fg__fail_memory(context, "a run of scales", sizeof *s);
  *s = (fg_run){.context = context,
                .field = field,
                .max_time = o.max_time,
                .max_steps = o.max_steps,
                .even_start = o.even_start,
                .first_icons = o.first,
                .placement_options = o.placement};
  fg_evolution_options evolution = o.evolution;
  if (s->placement_options.threads == 0)
    s->placement_options.threads = evolution.threads;
  if (o.kind == FG_RUN_TIMES)
    fg__plan_start_timed(&s->plan, o.times, o.count);
  else if (o.kind == FG_RUN_CLUSTERS)
    fg__plan_start(&s->plan, o.numbers, o.count);
  else
    fg__plan_start_placed(&s->plan, o.numbers, o.count,
                          fg_field_contents(field)->dimension);
  if (evolution.nodes == 0 && s->plan.placed)
    evolution.nodes = fg__plan_nodes(field, s->plan.wanted[0]);
  status = fg_evolution_create(&s->evolution, context, field, &evolution);
  if (status) {
    fg_run_destroy(s);
    return status;
  }
  *out = s;
  return FG_STATUS_OK;
}

static void clear_scale(fg_run *s)
{
  fg_density_destroy(s->density);
  fg_icons_destroy(s->finer);
  fg_icons_destroy(s->icons);
  s->density = NULL;
  s->finer = s->icons = NULL;
}

void fg_run_destroy(fg_run *run)
{
  if (!run)
    return;
  clear_scale(run);
  fg_placement_destroy(run->placement);
  fg_evolution_destroy(run->evolution);
  free(run);
}

fg_run_outcome fg__run_ending(const fg_run *s)
{
  if (fg__plan_done(&s->plan))
    return FG_RUN_ALL;
  if (s->max_time > 0.0 && s->step.time >= s->max_time)
    return FG_RUN_AT_TIME;
  if (s->max_steps && s->step.step >= s->max_steps)
    return FG_RUN_AT_STEPS;
  return s->step.stationary ? FG_RUN_STATIONARY : FG_RUN_GO_ON;
}

fg_run_outcome fg_run_ended(const fg_run *run)
{
  return run->outcome;
}

fg_status fg_run_step(fg_step *step, fg_run *run)
{
  fg_run *s = run;
  fg_status status = fg_evolution_step(s->evolution, &s->step);
  if (status == FG_STATUS_STOPPED)
    s->outcome = FG_RUN_STOPPED;
  if (status)
    return status;
  if (s->step.clusters && !s->first.step)
    s->first = s->step;
  s->pending = fg__plan_reach(&s->plan, &s->step);
  s->outcome = fg__run_ending(s);
  *step = s->step;
  return FG_STATUS_OK;
}

bool fg_run_take(fg_run_scale *out, fg_run *run)
{
  fg_run *s = run;
  if (!s->pending && !s->extra)
    return false;
  *out = (fg_run_scale){.index = s->taken, .step = s->step};
  if (s->pending) {
    int next = s->plan.next - s->pending;
    out->wanted = s->plan.timed ? NULL : &s->plan.wanted[next];
    out->times = s->plan.timed ? &s->plan.times[next] : NULL;
    out->wanted_count = s->plan.placed ? 1 : s->pending;
    s->pending -= out->wanted_count;
  }
  if (!s->pending)
    s->extra = false;
  ++s->taken;
  s->last_clusters = s->step.clusters;
  s->last_step = s->step.step;
  return true;
}

/* The state is one more scale of a run that can go on; a pattern that no longer changes
 * is that of all times to come. */
static void close_timed(fg_run *s, bool settled)
{
  if (settled) {
    s->pending = s->plan.count - s->plan.next;
    s->plan.next = s->plan.count;
  } else
    s->extra = s->step.step && s->last_step != s->step.step;
}

/* Any number of arrows can be placed, even where no cluster has room for an icon. */
void fg_run_close(fg_run *run)
{
  fg_run *s = run;
  bool settled = s->outcome == FG_RUN_STATIONARY;
  if (s->closed)
    return;
  s->closed = true;
  if (s->plan.timed && !fg__plan_done(&s->plan)) {
    close_timed(s, settled);
    return;
  }
  if (fg__plan_done(&s->plan) || (!s->step.clusters && !(s->plan.placed && settled)))
    return;
  if (!s->plan.placed) {
    s->extra = s->last_clusters != s->step.clusters;
    return;
  }
  if (s->outcome == FG_RUN_STOPPED)
    return;
  s->pending = s->plan.count - s->plan.next;
  s->plan.next = s->plan.count;
}

int fg_run_wanted(const int **wanted, int *next, const fg_run *run)
{
  *wanted = run->plan.wanted;
  *next = run->plan.next;
  return run->plan.count;
}

void fg_run_progress(double *share, double *seconds_left, const fg_run *run)
{
  const fg_run *s = run;
  *share = fg__plan_share(&s->plan, &s->first, &s->step);
  *seconds_left =
      s->first.step ? fg__plan_seconds_left(&s->plan, &s->step, &s->first) : -1.0;
}

fg_evolution *fg_run_evolution(const fg_run *run)
{
  return run->evolution;
}

fg_status fg_run_place(fg_icons **out, fg_context *context, fg_placement *placement,
                       int count, const fg_density *density, bool even_start,
                       fg_icons *finer)
{
  fg_icons *clusters = NULL;
  fg_status status = FG_STATUS_OK;
  *out = NULL;
  if (!finer && density && !even_start)
    status = fg_icons_create(&clusters, context, fg__placement_field(placement), density,
                             NULL);
  if (!status)
    status = fg_placement_place(placement, count, clusters);
  fg_icons_destroy(clusters);
  if (!status)
    status = fg_placement_icons(out, placement);
  if (!status && density)
    status = fg_placement_find_clusters(context, *out, density);
  if (!status && finer)
    fg_placement_find_parents(placement, finer);
  if (status) {
    fg_icons_destroy(*out);
    *out = NULL;
  }
  return status;
}

/* Takes the given icons of the first scale. On a field that differs a little from the one
 * on which they were placed some may not fit. */
static fg_status take_first(fg_run *s)
{
  const int count = fg_icons_count(s->first_icons);
  int missing;
  fg_status status = fg__placement_resume(s->placement, s->first_icons, &missing);
  if (!status && missing > count / 2)
    status = fg__fail(s->context, FG_STATUS_ARGUMENT,
                      "scales: %d of the first's %d icons were not placed on this field",
                      missing, count);
  if (!status)
    status = fg__icons_copy(&s->icons, s->context, s->first_icons);
  return status ? status : fg_placement_find_clusters(s->context, s->icons, s->density);
}

static fg_status place(fg_run *s, int count)
{
  fg_status status = FG_STATUS_OK;
  if (!s->placement)
    status =
        fg_placement_create(&s->placement, s->context, s->field, &s->placement_options);
  if (status)
    return status;
  if (s->first_icons && s->scale.index == 0)
    return take_first(s);
  return fg_run_place(&s->icons, s->context, s->placement, count, s->density,
                      s->even_start, s->finer);
}

/* Of the present state; of a distributed density rank 0 places what it has gathered. */
static fg_status make_icons(fg_run *s, const fg_run_scale *scale)
{
  if (!s->plan.placed)
    return fg_icons_create(&s->icons, s->context, s->field, s->density,
                           &(fg_icon_options){.extent = FG_EXTENT_CLUSTER, .threads = 1});
  if (!fg_density_is_distributed(s->density))
    return place(s, scale->wanted[0]);
  fg_density *shared = s->density;
  s->density = NULL;
  fg_status status = fg_density_gather(&s->density, s->context, shared);
  fg_density_destroy(shared);
  if (status)
    return status;
  if (s->density) /* rank 0 */
    status = place(s, scale->wanted[0]);
  return fg_ranks_agree(s->context, status, NULL, NULL);
}

static fg_status make(fg_run *s)
{
  fg_icons *before = s->plan.placed ? s->icons : NULL;
  s->icons = s->plan.placed ? NULL : s->icons;
  clear_scale(s);
  s->finer = before;
  fg_status status = fg_density_create(&s->density, s->evolution);
  if (!status)
    status = make_icons(s, &s->scale);
  s->scale.density = s->density;
  s->scale.icons = s->icons;
  s->scale.finer = s->finer;
  return status;
}

fg_status fg_run_next(const fg_run_scale **out, fg_run *run)
{
  fg_run *s = run;
  fg_step step;
  *out = NULL;
  while (!fg_run_take(&s->scale, s)) {
    if (s->closed)
      return FG_STATUS_OK;
    if (s->outcome) {
      fg_run_close(s);
      continue;
    }
    fg_status status = fg_run_step(&step, s);
    if (status)
      return status;
  }
  fg_status status = make(s);
  if (!status)
    *out = &s->scale;
  return status;
}
