/* Converts a command's settings to option structs of the library. */
#include "option/settings.h"

#include <math.h>

#include "option/table.h"
#include "vectors.h"

static const double POINTS_AN_INCH = 72.0;

fg_read_options settings_reading(const reading_settings *settings)
{
  return (fg_read_options){
      .vars = settings->vars,
      .vars_from = settings->vars_from,
      .mesh_from = settings->mesh_from,
      .at = settings->at,
      .time = settings->time,
      .level = settings->level,
      .mask = settings->mask,
      .missing = settings->missing,
      .map = &settings->map,
      .scale = (fg_scale)settings->scale,
      .block = settings->block,
      .frame = (fg_frame)settings->frame,
      .slice = settings->slice,
  };
}

fg_evolution_options settings_evolution(const evolution_settings *settings,
                                        const work_settings *work)
{
  return (fg_evolution_options){
      .nodes = settings->nodes,
      .mesh = (fg_mesh_kind)settings->mesh,
      .scheme = (fg_scheme)settings->scheme,
      .theta = settings->theta,
      .alpha = settings->alpha,
      .residual = settings->residual,
      .energy = (fg_energy)(energy_place(settings->energy) < 0
                                ? 0
                                : energy_place(settings->energy)),
      .anisotropy = settings->anisotropy,
      .isotropic_below = settings->isotropic_below,
      .coverage = settings->coverage,
      .gamma = settings->gamma,
      .seed = work->seed,
      .noise = settings->noise,
      .threads = work->threads,
      .vectors = vectors_wanted(),
  };
}

fg_icon_options settings_icons(const run_settings *settings)
{
  static const fg_extent extents[] = {FG_EXTENT_CLUSTER, FG_EXTENT_TERRITORY};
  return (fg_icon_options){.extent = extents[settings->extent], .threads = 1};
}

fg_run_options settings_run(const run_settings *settings)
{
  bool placed = settings_place(settings), timed = settings->times.count > 0;
  const number_list *numbers = placed ? &settings->arrows : &settings->clusters;
  return (fg_run_options){
      .kind = timed    ? FG_RUN_TIMES
              : placed ? FG_RUN_ARROWS
                       : FG_RUN_CLUSTERS,
      .numbers = numbers->number,
      .times = settings->times.time,
      .count = timed ? settings->times.count : numbers->count,
      .evolution = settings_evolution(&settings->evolution, &settings->work),
      .placement = settings_placement(settings),
      .max_time = settings->max_time,
      .max_steps = settings->max_steps,
  };
}

bool settings_place(const run_settings *settings)
{
  return settings->clusters.count == 0 && settings->times.count == 0 &&
         !settings->picture.no_arrows;
}

fg_placement_options settings_placement(const run_settings *settings)
{
  return (fg_placement_options){.lengths = (fg_lengths)settings->lengths,
                                .effort = (fg_effort)settings->effort,
                                .threads = settings->work.threads};
}

fg_texture_options settings_texture(const texture_settings *settings)
{
  const picture_settings *picture = &settings->picture;
  return (fg_texture_options){
      .kind = (fg_texture_kind)settings->kind,
      .longest = settings->pixels,
      .size = {(int)lround(picture->width * picture->dpi / POINTS_AN_INCH)},
      .length = settings->length,
      .clusters = settings->number.count ? settings->number.number[0] : 0,
      .max_time = settings->max_time,
      .seed = settings->work.seed,
      .threads = settings->work.threads,
  };
}

/* The width of a texture that --dpi and its pixels determine. */
static double texture_width(const picture_settings *picture, const fg_texture *texture)
{
  if (picture->width > 0.0 || !(picture->dpi > 0.0))
    return picture->width;
  return fg_texture_contents(texture)->size[0] * POINTS_AN_INCH / picture->dpi;
}

fg_texture_style settings_texture_style(const texture_settings *settings,
                                        const fg_texture *texture)
{
  const picture_settings *picture = &settings->picture;
  return (fg_texture_style){
      .palette = picture->palette,
      .speed_min = picture->speed_range[0],
      .speed_max = picture->speed_range[1],
      .fade = settings->fade,
      .mask_color = picture->mask_color,
      .transparent = picture->transparent,
      .no_coast = picture->no_coast,
      .land = picture->land,
      .borders = picture->borders,
      .key = settings->key,
      .title = picture->title,
      .subtitle = picture->subtitle,
      .label = picture->label,
      .width = texture_width(picture, texture),
      .font_size = picture->font_size,
      .outline_text = picture->outline_text,
  };
}

fg_picture_options settings_picture(const picture_settings *settings,
                                    const fg_map_options *map)
{
  return (fg_picture_options){
      .width = settings->width,
      .height = settings->height,
      .font_size = settings->font_size,
      .pixels_per_point = settings->dpi / POINTS_AN_INCH,
      .title = settings->title,
      .subtitle = settings->subtitle,
      .label = settings->label,
      .palette = settings->palette,
      .mask_color = settings->mask_color,
      .tint_color = settings->tint_color,
      .background_fade = settings->background_fade,
      .no_keys = settings->no_keys,
      .outline_text = settings->outline_text,
      .no_frame = settings->no_frame,
      .whole = map->has_region,
      .transparent = settings->transparent,
      .tint = settings->tint,
      .skeletons = settings->skeletons,
      .centers = settings->centers,
      .no_arrows = settings->no_arrows,
      .no_coast = settings->no_coast,
      .borders = settings->borders,
      .land = settings->land,
  };
}

void settings_speeds(double speeds[2], const picture_settings *settings)
{
  for (int k = 0; k < 2 && settings->speed_range[1] > settings->speed_range[0]; ++k)
    speeds[k] = settings->speed_range[k];
}

fg_solid_options settings_solid(const picture_settings *settings, int view,
                                const double preset[2])
{
  /* pictures in 3D are 1200 pixels wide where those in 2D are 480 points */
  const double dpi = settings->dpi > 0.0 ? settings->dpi : 2.5 * POINTS_AN_INCH;
  fg_solid_options out = {
      .palette = settings->palette,
      .width = (int)lround(settings->width * dpi / POINTS_AN_INCH),
      .height = (int)lround(settings->height * dpi / POINTS_AN_INCH),
      .pixels_per_point = dpi / POINTS_AN_INCH,
      .title = settings->title,
      .subtitle = settings->subtitle,
      .label = settings->label,
      .font_size = settings->font_size,
      .no_keys = settings->no_keys,
      .outline_text = settings->outline_text,
      .no_frame = settings->no_frame,
      .transparent = settings->transparent,
  };
  const double *from = view < settings->view_count ? settings->views[view] : preset;
  if (from) {
    out.has_view = true;
    out.azimuth = from[0];
    out.elevation = from[1];
  }
  return out;
}
