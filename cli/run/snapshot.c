#include "run/snapshot.h"

#include <stdlib.h>

#include "folder/scale_files.h"
#include "ranks.h"

/* Whether a feature needs the whole density. */
static bool needs_all(const cli_run *run)
{
  const run_settings *settings = run->settings;
  if (settings_icons(settings).extent == FG_EXTENT_TERRITORY)
    return true;
  if (scales_are_solid(run->field))
    return settings->picture.surfaces || settings_place(settings);
  return settings_place(settings) || settings->picture.tint || settings->times.count ||
         settings->picture.background;
}

static fg_status make_icons(scale_snapshot *snapshot, fg_context *context,
                            const cli_run *run, const fg_density *shared)
{
  double start = clock_seconds();
  const fg_icon_options options = settings_icons(run->settings);
  fg_status status =
      fg_icons_create(&snapshot->icons, context, run->field, shared, &options);
  snapshot->icon_seconds = clock_seconds() - start;
  return status;
}

static fg_status write_density(scale_snapshot *snapshot, fg_context *context,
                               const cli_run *run, const fg_density *shared)
{
  double start = clock_seconds();
  char *path = ranks_leader() ? drawing_density_path(run->drawing) : NULL;
  fg_status status = fg_density_write(context, path, shared);
  free(path);
  snapshot->file_seconds = clock_seconds() - start;
  return status;
}

/* Uses a context of its own: after an interrupt a completed scale is still drawn, and the
 * drawing's context is in use by its thread. */
static int take_shared(scale_snapshot *snapshot, cli_run *run, const fg_density *shared)
{
  fg_context *context;
  bool created = fg_context_create(&context) == FG_STATUS_OK;
  if (!created)
    complain("out of memory");
  int code = ranks_agree(created ? EXIT_DONE : EXIT_FAILED);
  if (code) {
    fg_context_destroy(created ? context : NULL);
    return code;
  }
  fg_status status = FG_STATUS_OK;
  if (needs_all(run)) {
    status = fg_density_gather(&snapshot->density, context, shared);
  } else {
    status = make_icons(snapshot, context, run, shared);
    if (!status && scales_have_density(run->settings, run->field))
      status = write_density(snapshot, context, run, shared);
  }
  if (status)
    code = complain_of(context, status, run->settings->reading.input);
  fg_context_destroy(context);
  return code;
}

int snapshot_take(scale_snapshot *out, cli_run *run)
{
  fg_density *density;
  fg_status status = fg_density_create(&density, fg_run_evolution(run->scales));
  if (status)
    return complain_of(run->context, status, run->settings->reading.input);
  const fg_density_arrays *contents = fg_density_contents(density);
  *out = (scale_snapshot){.time = contents->time,
                          .energy = contents->energy,
                          .area_fraction = contents->area_fraction,
                          .clusters = contents->clusters};
  if (!fg_density_is_distributed(density)) {
    out->density = density;
    return EXIT_DONE;
  }
  int code = take_shared(out, run, density);
  fg_density_destroy(density);
  if (code) {
    fg_density_destroy(out->density);
    fg_icons_destroy(out->icons);
  }
  return code;
}
