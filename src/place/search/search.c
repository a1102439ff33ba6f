#include "place/search/search.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The least step of moves in lambda, but in a last descent. */
static const double LEAST_STEP = 0.04;

static fg_status set_scale(fg__place_search *search, int count, bool free,
                           fg__place_grain grain)
{
  search->scale = fg__place_scale_of(search->domain, count, free, grain);
  search->least_step = LEAST_STEP;
  fg_status status = fg__place_raster_create(&search->raster, search->context,
                                             search->domain, &search->scale);
  if (status == FG_STATUS_OK)
    status = fg__place_diffusion_create(&search->diffusion, search->context,
                                        &search->raster, search->domain, &search->scale);
  if (status != FG_STATUS_OK)
    return status;
  search->map = fg__allocate(search->raster.count, sizeof *search->map);
  search->smooth = fg__allocate(search->raster.count, sizeof *search->smooth);
  if (!search->map || !search->smooth)
    return fg__fail_memory(search->context, "a map of errors",
                           2 * search->raster.count * sizeof *search->map);
  search->weights =
      (fg__place_weights){.inverse_error = (float)(1.0 / search->reference_error),
                          .far = (float)search->scale.far,
                          .reach = (float)fg__place_reach(search)};
  return FG_STATUS_OK;
}

static void clear_scale(fg__place_search *search)
{
  fg__place_raster_clear(&search->raster);
  fg__place_diffusion_clear(&search->diffusion);
  free(search->map);
  free(search->smooth);
  search->map = search->smooth = NULL;
}

fg_status fg__place_search_create(fg__place_search *out, fg_context *context,
                                  const fg__place_domain *domain, int count, bool free,
                                  fg__place_grain grain)
{
  *out = (fg__place_search){.domain = domain,
                            .context = context,
                            .own = {.search = out},
                            .reference_error = 30.0};
  fg_status status = set_scale(out, count, free, grain);
  if (status != FG_STATUS_OK)
    fg__place_search_clear(out);
  return status;
}

static void free_icon(fg__place_icon *icon)
{
  fg__place_contribution_clear(&icon->contribution);
  free(icon);
}

void fg__place_search_clear(fg__place_search *search)
{
  for (int n = 0; n < search->count; ++n)
    free_icon(search->icon[n]);
  free(search->icon);
  free(search->box);
  clear_scale(search);
  fg__place_worker_clear(&search->own);
  for (size_t n = 0; n < search->helper_count; ++n)
    fg__place_worker_clear(&search->helper[n]);
  free(search->helper);
  fg__place_visits_clear(search);
  *search = (fg__place_search){0};
}

/* The contribution of a line on the search's raster. */
static fg_status compute(fg__place_search *search, fg__place_contribution *out,
                         const fg__place_line *line)
{
  return fg__place_contribution_compute(out, search->context, &search->raster,
                                        &search->scale, line);
}

/* Removes an icon from the list; the diffusion reader's field has no part of it. */
static void erase(fg__place_search *search, int index)
{
  free_icon(search->icon[index]);
  --search->count;
  memmove(&search->icon[index], &search->icon[index + 1],
          (size_t)(search->count - index) * sizeof(fg__place_icon *));
  memmove(&search->box[index], &search->box[index + 1],
          (size_t)(search->count - index) * sizeof *search->box);
}

fg_status fg__place_search_rescale(fg__place_search *search, int count,
                                   fg__place_grain grain)
{
  double before = search->scale.lambda;
  const double ink = search->scale.ink;
  bool free = search->scale.free;
  clear_scale(search);
  fg_status status = set_scale(search, count, free, grain);
  search->scale.ink = ink;
  double grown = search->scale.lambda / before;
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n) {
    fg__place_icon *icon = search->icon[n];
    for (int k = 0; k < 2; ++k)
      icon->seed.way[k] *= grown;
    icon->step *= grown;
    icon->has_removal_cost = false;
    fg__place_no_steps(&icon->steps);
    fg__place_trace(&icon->line, search->domain, &search->scale, &icon->seed);
    if (icon->line.count == 0) {
      erase(search, n--);
      continue;
    }
    status = compute(search, &icon->contribution, &icon->line);
    search->box[n] = icon->contribution.box;
  }
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n)
    fg__place_diffusion_add(&search->diffusion, &search->icon[n]->line);
  return status == FG_STATUS_OK
             ? fg__place_diffusion_solve(&search->diffusion, search->context, false)
             : status;
}

void fg__place_forget_removal_costs(fg__place_search *search, const fg__place_box *box)
{
  for (int n = 0; n < search->count; ++n)
    if (fg__place_boxes_meet(box, &search->box[n]))
      search->icon[n]->has_removal_cost = false;
}

fg_status fg__place_add(fg__place_search *search, bool *added, const fg__place_seed *seed,
                        int identity)
{
  *added = false;
  fg__place_icon *icon = fg__allocate(1, sizeof *icon);
  const size_t needed = (size_t)search->count + 1;
  if (!icon ||
      !fg__grow((void **)&search->icon, &search->capacity, needed,
                sizeof(fg__place_icon *)) ||
      !fg__grow((void **)&search->box, &search->box_capacity, needed,
                sizeof *search->box)) {
    free(icon);
    return fg__fail_memory(search->context, "an icon", sizeof *icon);
  }
  icon->seed = *seed;
  icon->step = 0.25 * search->scale.lambda;
  icon->identity = identity;
  fg__place_trace(&icon->line, search->domain, &search->scale, seed);
  fg_status status = FG_STATUS_OK;
  if (icon->line.count > 0)
    status = compute(search, &icon->contribution, &icon->line);
  if (status == FG_STATUS_OK && icon->line.count > 0) {
    double growth;
    status = fg__place_diffusion_try(&growth, &search->own.window, &search->diffusion,
                                     search->context, NULL, &icon->line);
    if (status == FG_STATUS_OK)
      fg__place_diffusion_keep(&search->diffusion, &search->own.window, NULL,
                               &icon->line);
  }
  if (status != FG_STATUS_OK || icon->line.count == 0) {
    free_icon(icon);
    return status;
  }
  fg__place_forget_removal_costs(search, &icon->contribution.box);
  search->box[search->count] = icon->contribution.box;
  search->icon[search->count++] = icon;
  *added = true;
  return FG_STATUS_OK;
}

fg_status fg__place_remove(fg__place_search *search, int index)
{
  double growth;
  const fg__place_line *line = &search->icon[index]->line;
  fg_status status = fg__place_diffusion_try(
      &growth, &search->own.window, &search->diffusion, search->context, line, NULL);
  if (status == FG_STATUS_OK) {
    fg__place_diffusion_keep(&search->diffusion, &search->own.window, line, NULL);
    fg__place_forget_removal_costs(search, &search->icon[index]->contribution.box);
    erase(search, index);
  }
  return status;
}

double fg__place_ink(const fg__place_search *search)
{
  double sum = 0.0;
  for (int n = 0; n < search->count; ++n)
    sum += search->icon[n]->line.length;
  return sum / (search->scale.count * search->scale.lambda);
}
