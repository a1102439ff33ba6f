#include "picture/page/figure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/caption.h"
#include "picture/page/texture_image.h"

static const double default_pixels_per_point = 2.0;

static const fg__color default_tint = {0.845, 0.895, 0.950};

/* Of clusters that no arrows shall stand out from. */
static const fg__color lone_tint = {0.56, 0.68, 0.83};

/* Behind arrows of one colour: pale bands of speed, by eye as in atlases. */
static const char bands_palette[] = "#2f6ea8", dark_arrow[] = "#14203a";
static const double bands_fade = 0.3, most_steps = 6.0, few_steps = 5.0;

/* Checked so that NaN fails too. */
static bool size_usable(double size)
{
  return size >= 0.0 && size <= FG__LARGEST_PAGE;
}

static fg_status check_options(fg_context *context, const fg_picture_options *options)
{
  if (!size_usable(options->width) || !size_usable(options->height))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: %g x %g points, each must lie between 0 and %g",
                    options->width, options->height, FG__LARGEST_PAGE);
  if (!(options->background_fade >= 0.0 && options->background_fade <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a background faded by %g, it must lie between 0 and 1",
                    options->background_fade);
  return fg__surface_options_check(context, options->pixels_per_point, options->font_size,
                                   options->speed_min, options->speed_max);
}

static void describe_axes(fg__page_plan *plan, const fg_field_arrays *field,
                          const double low[2], const double high[2])
{
  const bool geo = field->scale == FG_SCALE_GEO;
  bool shared = strcmp(field->axis_units[0], field->axis_units[1]) == 0;
  double larger = fmax(high[0] - low[0], high[1] - low[1]);
  for (int k = 0; k < 2; ++k) {
    const char *units = field->axis_units[k];
    if (geo ? k == 0 : strcmp(units, "°E") == 0)
      fg__axis_of_degrees(&plan->axis[k], low[k], high[k], FG__TICKS_LONGITUDE);
    else if (geo || strcmp(units, "°N") == 0)
      fg__axis_of_degrees(&plan->axis[k], low[k], high[k], FG__TICKS_LATITUDE);
    else
      fg__axis_of_numbers(&plan->axis[k], low[k], high[k],
                          shared ? larger : high[k] - low[k], field->axis_name[k], units);
  }
}

/* Lengths in kilometres on the ground, where a map has about one scale; elsewhere no key
 * can tell them. */
static void describe_length(fg__page_plan *plan, const fg__plane *plane)
{
  if (plane->kind == FG__PLANE_NONE)
    return;
  const double kilometres = 1e-3 * fg__plane_true_metres(plane);
  const double extent = kilometres * (plane->high[0] - plane->low[0]);
  plan->size_key = plan->size_key && kilometres > 0.0;
  fg__axis_of_numbers(&plan->length, 0.0, extent, extent, "", "km");
  plan->length.factor *= kilometres;
}

/* What all frames show: the parts of the fields' boxes together. */
static void find_shown(fg__figure *out, bool whole)
{
  for (int n = 0; n < out->count; ++n) {
    const fg_field *field = out->given[n].field;
    double low[2], high[2];
    if (whole)
      fg__scene_box(low, high, fg_field_contents(field));
    else
      fg__scene_shown(low, high, field);
    for (int k = 0; k < 2; ++k) {
      out->low[k] = n ? fmin(out->low[k], low[k]) : low[k];
      out->high[k] = n ? fmax(out->high[k], high[k]) : high[k];
    }
  }
}

/* Speeds from 0 to the fastest of all fields, unless they are given. */
static fg_status find_range(double range[2], fg_context *context, const fg__figure *of)
{
  fg_status status = FG_STATUS_OK;
  if (range[1] > range[0])
    return status;
  for (int n = 0; n < of->count && !status; ++n) {
    double own[2];
    status = fg_field_speed_range(own, context, of->given[n].field);
    if (!status)
      range[1] = fmax(range[1], own[1]);
  }
  range[0] = 0.0;
  fg_picture_round_speeds(range);
  return status;
}

/* Pale bands, one or two between round numbers. */
static void make_bands(fg__palette *palette, const double range[2],
                       const fg_picture_options *options)
{
  const fg__tick_axis plain = {.style = FG__TICKS_NUMBER, .factor = 1.0};
  const double width = range[1] - range[0],
               steps = floor(width / fg__ticks_step(&plain, width / most_steps) + 0.5);
  fg__palette_make_pale(
      palette, options->background_fade > 0.0 ? options->background_fade : bands_fade,
      (int)fmax(steps < few_steps ? 2.0 * steps : steps, 2.0));
}

static fg_status plan_speeds(fg__figure *out, fg_context *context,
                             const fg_picture_options *options)
{
  fg__page_plan *plan = &out->plan;
  const char *units = fg_field_contents(out->given[0].field)->velocity_units;
  const bool behind = fg__figure_shows_speeds(out);
  double range[2] = {options->speed_min, options->speed_max};
  fg_status status = behind ? find_range(range, context, out) : FG_STATUS_OK;
  if (status)
    return status;
  const bool has_speeds = fg__speed_range_common(range, out->given, out->count);
  for (int n = 0; n < out->count; ++n) {
    bool beyond[2];
    fg__speeds_beyond(beyond, out->given[n].icons, range);
    for (int k = 0; k < 2; ++k)
      plan->speeds_beyond[k] = plan->speeds_beyond[k] || beyond[k];
    if (behind && out->given[n].background)
      fg__texture_beyond(plan->speeds_beyond,
                         fg_texture_contents(out->given[n].background), range);
  }
  plan->color_key =
      !options->no_keys &&
      (behind || (has_speeds && !out->palette.uniform && !options->no_arrows));
  fg__axis_of_numbers(&plan->speed, range[0], range[1], range[1] - range[0],
                      behind ? "speed" : "mean speed", units);
  fg__caption_label_speeds(&plan->speed, options->label, units);
  if (behind)
    make_bands(&out->palette, range, options);
  return FG_STATUS_OK;
}

static fg_status plan_map(fg__figure *out, fg_context *context)
{
  fg__page_plan *plan = &out->plan;
  const fg_field *field = out->given[0].field;
  fg_status status = fg__plane_create(&out->plane, context, field, out->low, out->high);
  if (!status && out->plane.kind != FG__PLANE_NONE)
    status = fg__graticule_create(&out->graticule, context, &out->plane);
  if (status)
    return status;
  plan->graticule = out->graticule.plane ? &out->graticule : NULL;
  plan->short_key = plan->graticule != NULL;
  plan->outlined = out->plane.whole;
  describe_axes(plan, fg_field_contents(field), out->low, out->high);
  return FG_STATUS_OK;
}

/* Signs, and the key of those that are used. */
static void find_symbols(fg__figure *out, const fg_picture_options *options)
{
  for (int k = 0; k < out->count; ++k) {
    out->panel[k].critical = fg_icons_kept_critical(out->given[k].icons);
    if (!options->no_keys)
      fg__symbols_plan(&out->plan, out->panel[k].critical);
  }
}

/* Captions and keys are of the icons that are seen. */
static fg_status find_icons(fg__figure *out, fg_context *context)
{
  fg_status status = FG_STATUS_OK;
  int given = 0, seen = 0;
  for (int k = 0; k < out->count && !status; ++k) {
    fg_panel *panel = &out->given[k];
    fg_icons **shown = &out->panel[k].shown;
    given += fg_icons_count(panel->icons);
    status = fg__scene_keep_shown(shown, context, fg_field_contents(panel->field),
                                  panel->icons, out->low, out->high, &out->plane.outline);
    if (*shown)
      panel->icons = *shown;
    seen += fg_icons_count(panel->icons);
  }
  if (status || seen > 0 || given == 0)
    return status;
  fg__fail(context, FG_STATUS_ARGUMENT,
           "picture: none of its %d arrow%s lies where it shows the field", given,
           given == 1 ? "" : "s");
  fg__hint(context, "show more of it, or place arrows there");
  return FG_STATUS_ARGUMENT;
}

static fg_status write_texts(fg__figure *out, fg_context *context, bool several,
                             const fg_picture_options *options)
{
  fg__page_plan *plan = &out->plan;
  const char *const wanted[2] = {options->title, options->subtitle};
  fg__caption_panel *told = fg__allocate((size_t)out->count, sizeof *told);
  if (!told)
    return fg__fail_memory(context, "captions", (size_t)out->count * sizeof *told);
  for (int n = 0; n < out->count; ++n) {
    const fg_panel *panel = &out->given[n];
    told[n] =
        (fg__caption_panel){fg_field_contents(panel->field),
                            options->no_arrows ? NULL : panel->icons, panel->scale_time};
    if (panel->density && panel->scale_time == 0.0)
      told[n].scale_time = fg_density_contents(panel->density)->time;
  }
  fg__caption_write_common(plan->title, plan->subtitle, told, out->count, wanted);
  for (int n = 0; n < out->count && several; ++n)
    fg__caption_write_label(out->label[n], told, out->count, n, out->given[n].label);
  free(told);
  return FG_STATUS_OK;
}

static fg_status plan_figure(fg__figure *out, fg_context *context, bool several,
                             const fg_picture_options *options)
{
  fg__page_plan *plan = &out->plan;
  plan->width = options->width;
  plan->height = options->height;
  plan->font_size = options->font_size;
  plan->no_frame = options->no_frame;
  find_shown(out, options->no_frame || options->whole);
  fg_status status = plan_map(out, context);
  find_symbols(out, options);
  if (!status)
    status = find_icons(out, context);
  if (!status)
    status = write_texts(out, context, several, options);
  if (!status)
    status = fg__scene_typical_icon(&out->typical, context, out->given, out->count);
  if (!status)
    status = plan_speeds(out, context, options);
  if (status)
    return status;
  plan->size_key = out->typical.length > 0.0 && !options->no_keys && !options->no_arrows;
  plan->arrow_length = out->typical.length;
  describe_length(plan, &out->plane);
  if (!several)
    return FG_STATUS_OK;
  plan->panels = out->count;
  plan->panel_label = (const char(*)[FG__PAGE_TEXT_BYTES])out->label;
  plan->columns = options->columns > 0 ? options->columns : fg__page_choose_columns(plan);
  if (plan->columns > plan->panels)
    plan->columns = plan->panels;
  return FG_STATUS_OK;
}

/* Panel pages are laid out apart: each is in the figure's panel. */
static fg_status place(fg__figure *out, fg_context *context, cairo_t *ruler)
{
  const size_t panels = (size_t)out->plan.panels;
  fg__page *page = fg__allocate(panels + 1, sizeof *page);
  if (!page)
    return fg__fail_memory(context, "a page's layout", (panels + 1) * sizeof *page);
  fg__page_layout_panels(&out->page, panels ? page : NULL, &out->plan, ruler);
  for (size_t k = 0; k < panels; ++k)
    out->panel[k].page = page[k];
  free(page);
  return FG_STATUS_OK;
}

static fg_status lay_out(fg__figure *out, fg_context *context)
{
  cairo_t *ruler = fg__text_ruler();
  fg_status status = place(out, context, ruler);
  cairo_status_t trouble = cairo_status(ruler);
  cairo_destroy(ruler);
  if (status)
    return status;
  if (trouble == CAIRO_STATUS_NO_MEMORY)
    return fg__fail_memory(context, "a page's layout", sizeof out->page);
  if (trouble)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "picture: no text can be drawn: %s",
                    cairo_status_to_string(trouble));
  if (!(out->page.width <= FG__LARGEST_PAGE && out->page.height <= FG__LARGEST_PAGE))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: the domain's shape needs a page of %g x %g points, at most "
                    "%g are drawn",
                    out->page.width, out->page.height, FG__LARGEST_PAGE);
  return FG_STATUS_OK;
}

/* Where the page has, or would have, the whole domain. */
static fg__page_box domain_box(const fg__figure *figure, const fg__page *page,
                               const fg_field_arrays *field)
{
  double low[2], high[2];
  fg__scene_box(low, high, field);
  return (fg__page_box){page->frame.x0 + page->scale * (low[0] - figure->low[0]),
                        page->frame.y1 - page->scale * (high[1] - figure->low[1]),
                        page->frame.x0 + page->scale * (high[0] - figure->low[0]),
                        page->frame.y1 - page->scale * (low[1] - figure->low[1])};
}

static fg_status choose_colors(fg__style *out, fg_context *context,
                               const fg_picture_options *options)
{
  fg_status status =
      fg__color_choose(&out->mask, context, options->mask_color, fg__default_mask);
  if (!status)
    status = fg__color_choose(&out->tint, context, options->tint_color,
                              options->no_arrows ? lone_tint : default_tint);
  if (!status)
    status =
        fg__color_choose(&out->map_style.land, context, options->land, fg__default_land);
  if (!status)
    status = fg__color_choose(&out->map_style.missing, context, options->mask_color,
                              fg__default_missing);
  out->map_style.transparent = options->transparent;
  return status;
}

/* Fontconfig crashes where memory runs out while it loads fonts, which with cairo took 40
 * MB of address space. So there must be more than that before it begins. */
enum { ROOM_BYTES = 48 << 20 };

static fg_status check_room(fg_context *context)
{
  void *room = fg__allocate(ROOM_BYTES, 1); /* never touched */
  if (!room)
    return fg__fail_memory(context, "a picture", ROOM_BYTES);
  free(room);
  return FG_STATUS_OK;
}

bool fg__figure_shows_speeds(const fg__figure *figure)
{
  const fg_texture_arrays *behind = fg_texture_contents(figure->given[0].background);
  return behind && behind->kind == FG_TEXTURE_SPEED;
}

/* Over speeds arrows have one colour, the options' if it is one. */
static fg_status choose_palettes(fg__figure *out, fg_context *context,
                                 const fg_picture_options *options)
{
  const char *name = options->palette, *arrows = name;
  if (fg__figure_shows_speeds(out)) {
    const bool is_color = name && name[0] == '#';
    arrows = is_color ? name : dark_arrow;
    name = !name || is_color ? bands_palette : name;
  }
  const fg_status status = fg__palette_create(&out->arrows, context, arrows);
  return status ? status : fg__palette_create(&out->palette, context, name);
}

fg__page *fg__figure_page(fg__figure *figure, int k)
{
  return figure->plan.panels ? &figure->panel[k].page : &figure->page;
}

static fg_status prepare(fg__figure *out, fg_context *context, bool several,
                         const fg_picture_options *options)
{
  fg__style style = {.background = NULL};
  fg_status status = check_options(context, options);
  if (!status)
    status = check_room(context);
  if (!status)
    status = choose_palettes(out, context, options);
  if (!status)
    status = choose_colors(&style, context, options);
  out->transparent = options->transparent;
  out->outline_text = options->outline_text;
  out->pixels_per_point = options->pixels_per_point > 0.0 ? options->pixels_per_point
                                                          : default_pixels_per_point;
  if (!status)
    status = plan_figure(out, context, several, options);
  if (!status)
    status = lay_out(out, context);
  for (int k = 0; k < out->count && !status; ++k) {
    style.background_box =
        domain_box(out, fg__figure_page(out, k), fg_field_contents(out->given[k].field));
    style.critical = out->panel[k].critical;
    style.on_speeds = fg__figure_shows_speeds(out);
    memcpy(style.low, out->low, sizeof style.low);
    out->panel[k].style = style;
  }
  return status;
}

fg_status fg__figure_create(fg__figure **out, fg_context *context, const fg_panel *panel,
                            int count, bool several, const fg_picture_options *options)
{
  const size_t panels = (size_t)count;
  fg__figure *figure = *out = fg__allocate(1, sizeof *figure);
  if (!figure)
    return fg__fail_memory(context, "a picture", sizeof *figure);
  figure->count = count;
  figure->given = fg__allocate(panels, sizeof *figure->given);
  figure->panel = fg__allocate(panels, sizeof *figure->panel);
  figure->label = fg__allocate(panels, sizeof *figure->label);
  if (!figure->given || !figure->panel || !figure->label)
    return fg__fail_memory(context, "a picture", panels * sizeof *figure->panel);
  memcpy(figure->given, panel, panels * sizeof *panel);
  return prepare(figure, context, several, options);
}

void fg__figure_destroy(fg__figure *figure)
{
  if (!figure)
    return;
  for (int k = 0; k < figure->count && figure->panel; ++k) {
    cairo_surface_destroy(figure->panel[k].style.background);
    fg__scene_clear(&figure->panel[k].scene);
    fg__map_scene_clear(&figure->panel[k].map);
    fg__map_cover_clear(&figure->panel[k].cover);
    fg_icons_destroy(figure->panel[k].shown);
  }
  fg__polygons_clear(&figure->reference);
  fg__graticule_clear(&figure->graticule);
  fg__plane_clear(&figure->plane);
  free(figure->given);
  free(figure->panel);
  free(figure->label);
  free(figure);
}
