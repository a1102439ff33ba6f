#include "run/placing.h"

#include "folder/scale_files.h"

fg_status placing_score(fg_context *context, const run_settings *settings,
                        const fg_field *field, fg_icons *icons)
{
  fg_score score;
  fg_score_options options = {
      .lengths = FG_SCORE_FREE, .threads = settings->work.threads, .readers_only = true};
  fg_status status = fg_icons_score(&score, context, field, icons, &options);
  if (!status)
    fg_icons_keep_score(icons, &score);
  if (status != FG_STATUS_UNSUPPORTED)
    return status;
  fg_context_clear(context); /* in too narrow a domain icons have no score */
  return FG_STATUS_OK;
}

int placing_find_count(int *count, fg_context *context, const run_settings *settings,
                       const fg_field *field)
{
  enum { MOST_ARROWS = 3000 };
  fg_placement *placement = NULL;
  fg_placement_options options = settings_placement(settings);
  fg_status status = fg_placement_create(&placement, context, field, &options);
  if (!status)
    status = fg_placement_within(placement, settings->tolerance, MOST_ARROWS, count);
  fg_placement_destroy(placement);
  return status ? complain_of(context, status, settings->reading.input) : EXIT_DONE;
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

fg_status placing_make(fg_icons **out, cli_placing *placing, int count,
                       const scale_snapshot *snapshot, fg_icons *finer)
{
  const run_settings *settings = placing->settings;
  fg_status status = placing->placement ? FG_STATUS_OK : begin(placing, finer);
  if (!status)
    status =
        fg_run_place(out, placing->context, placing->placement, count, snapshot->density,
                     settings->start || settings->tolerance > 0.0, finer);
  return status ? status
                : placing_score(placing->context, settings, placing->field, *out);
}

fg_status placing_regions(fg_density **out, const cli_placing *placing)
{
  *out = NULL;
  if (!placing->settings->picture.tint || scales_are_solid(placing->field))
    return FG_STATUS_OK;
  return fg_placement_regions(out, placing->placement);
}

void placing_clear(cli_placing *placing)
{
  fg_placement_destroy(placing->placement);
  placing->placement = NULL;
}
