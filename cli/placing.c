#include "placing.h"

fg_status placing_score(fg_context *context, const fg_field *field, fg_icons *icons)
{
  fg_score score;
  fg_score_options options = {.lengths = FG_SCORE_FREE, .readers_only = true};
  fg_status status = fg_icons_score(&score, context, field, icons, &options);
  if (!status)
    fg_icons_keep_score(icons, &score);
  if (status != FG_STATUS_UNSUPPORTED)
    return status;
  fg_context_clear(context); /* a narrow domain: its icons have no score */
  return FG_STATUS_OK;
}

int placing_find_count(int *count, fg_context *context, const cli_settings *settings,
                       const fg_field *field)
{
  enum { MOST_ARROWS = 3000 };
  fg_placement *placement = NULL;
  fg_placement_options options = settings_placement(settings);
  fg_status status = fg_placement_create(&placement, context, field, &options);
  if (!status)
    status = fg_placement_within(placement, settings->tolerance, MOST_ARROWS, count);
  fg_placement_destroy(placement);
  return status ? complain_of(context, status, settings->operand) : EXIT_DONE;
}

static fg_status begin(cli_placing *placing, const fg_icons *finer)
{
  fg_placement_options options = settings_placement(placing->settings);
  fg_status status = fg_placement_create(&placing->placement, placing->context,
                                         placing->field, &options);
  if (!status && finer)
    status = fg_placement_resume(placing->placement, finer);
  return status;
}

/* Only the first scale starts from icons of clusters. */
static fg_status place(cli_placing *placing, int count, const scale_moment *moment,
                       bool first)
{
  fg_icons *clusters = NULL;
  fg_status status = FG_STATUS_OK;
  const cli_settings *said = placing->settings;
  bool even = !first || said->start || said->tolerance > 0.0 || !moment->density;
  if (!even)
    status = fg_icons_create(&clusters, placing->context, placing->field, moment->density,
                             NULL);
  if (!status)
    status = fg_placement_place(placing->placement, count, clusters);
  fg_icons_destroy(clusters);
  return status;
}

fg_status placing_make(fg_icons **out, cli_placing *placing, int count,
                       const scale_moment *moment, fg_icons *finer)
{
  fg_status status = placing->placement ? FG_STATUS_OK : begin(placing, finer);
  if (!status)
    status = place(placing, count, moment, !finer);
  if (!status)
    status = fg_placement_icons(out, placing->placement);
  if (!status && moment->density)
    status = fg_placement_find_clusters(placing->context, *out, moment->density);
  if (!status)
    status = placing_score(placing->context, placing->field, *out);
  if (!status && finer)
    fg_placement_find_parents(placing->placement, finer);
  return status;
}

fg_status placing_regions(fg_density **out, const cli_placing *placing)
{
  *out = NULL;
  if (!placing->settings->tint || scales_are_solid(placing->field))
    return FG_STATUS_OK;
  return fg_placement_regions(out, placing->placement);
}

void placing_clear(cli_placing *placing)
{
  fg_placement_destroy(placing->placement);
  placing->placement = NULL;
}
