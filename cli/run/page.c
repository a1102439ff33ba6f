#include "run/page.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "folder/scale_files.h"

/* In 2D: bounds of the page's largest number of arrows, and upper bound of its
 * smallest. */
enum { LEAST_MOST = 60, MOST_MOST = 400, MOST_FEWEST = 12 };

static int within(int number, int least, int most)
{
  return number < least ? least : number > most ? most : number;
}

/* In 2D the page places arrows by itself, for the energies that it supports. */
static bool wants_page(const cli_run *run)
{
  const run_settings *settings = run->settings;
  const char *energy = settings->evolution.energy;
  return fg_has_feature(FG_FEATURE_VIEWER) && !settings->no_page &&
         (scales_are_solid(drawing_field(run->drawing)) || !energy ||
          strcmp(energy, "flow") == 0);
}

typedef struct page_scales {
  fg_view_scale scale[MAX_SCALES + 1];
  fg_icons *icons[MAX_SCALES + 1];
  fg_density *density[MAX_SCALES + 1];
  int count;
} page_scales;

static char *path_of(const cli_run *run, int index, const char *end)
{
  char name[SCALE_NAME_BYTES];
  scale_name(name, index, end);
  return output_path(&run->output, name);
}

static fg_status read_scale(page_scales *scales, fg_context *context, const cli_run *run,
                            int index)
{
  char *icons = path_of(run, index, ".geojson"), *density = path_of(run, index, ".vti");
  fg_status status = icons && density ? FG_STATUS_OK : FG_STATUS_MEMORY;
  if (!status)
    status = fg_icons_read(&scales->icons[index], context, icons);
  if (!status && scales_are_solid(drawing_field(run->drawing)) &&
      access(density, F_OK) == 0) /* a scale without clusters has none */
    status = fg_density_read(&scales->density[index], context, density,
                             drawing_field(run->drawing));
  scales->scale[index] = (fg_view_scale){scales->icons[index], scales->density[index]};
  free(icons);
  free(density);
  return status;
}

static void clear_scales(page_scales *scales)
{
  for (int k = 0; k < scales->count; ++k) {
    fg_icons_destroy(scales->icons[k]);
    fg_density_destroy(scales->density[k]);
  }
}

/* In 2D the page has the first scale only, and none for clusters or for more arrows than
 * its largest number. */
static int count_scales(const cli_run *run)
{
  const int count = drawing_count(run->drawing);
  if (scales_are_solid(drawing_field(run->drawing)))
    return count;
  return count > 0 && settings_place(run->settings) && run->record.wanted[0] <= MOST_MOST;
}

static fg_status write_page(fg_context *context, const char *path, const cli_run *run)
{
  const run_settings *settings = run->settings;
  const fg_field *field = drawing_field(run->drawing);
  const common_look *look = drawing_look(run->drawing);
  const int *wanted = run->record.wanted, count = run->record.count;
  page_scales scales = {.count = count_scales(run)};
  fg_view_options options = {.palette = settings->picture.palette,
                             .speed_min = look->speeds[0],
                             .speed_max = look->speeds[1],
                             .title = settings->picture.title,
                             .scales = scales.scale,
                             .scale_count = scales.count};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < scales.count && !status; ++k)
    status = read_scale(&scales, context, run, k);
  if (scales_are_solid(field)) {
    options.azimuth = look->view[0];
    options.elevation = look->view[1];
  } else {
    options.most = within(wanted[0], LEAST_MOST, MOST_MOST);
    options.fewest = within(wanted[count - 1], 1, MOST_FEWEST);
    options.seed = settings->work.seed;
    options.kind = settings_place(settings) ? FG_RUN_ARROWS : FG_RUN_CLUSTERS;
    options.lengths = (fg_lengths)settings->lengths;
    options.anisotropy = settings->evolution.anisotropy;
    options.coverage = settings->evolution.coverage;
  }
  if (!status)
    status = fg_view_write(context, path, field, &options);
  clear_scales(&scales);
  return status;
}

int page_write(cli_run *run)
{
  if (!wants_page(run))
    return EXIT_DONE;
  char *path = output_path(&run->output, VIEW_NAME);
  if (!path)
    return EXIT_FAILED;
  fg_context *context; /* an interrupt may have stopped the run's context */
  fg_status status = fg_context_create(&context);
  if (!status)
    status = write_page(context, path, run);
  free(path);
  run->facts.has_page = !status;
  const int code =
      status ? complain_of(context, status, run->settings->output) : EXIT_DONE;
  fg_context_destroy(context);
  return code;
}
