#include "base/context.h"
#include "file/whole_file.h"
#include "picture/caption.h"
#include "picture/palette.h"
#include "write/view/parts.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { MOST_SAMPLES = 300000, MOST = 200, FEWEST = 12, COLORS = 17 };

/* The library's own. */
static const double ANISOTROPY = 0.15, COVERAGE = 0.3;

const char fg__view_mark[] = "@FLOWGRAIN_FIELD@";

typedef struct view_look {
  fg_view_options options; /* with defaults */
  double speeds[2];
  fg__palette palette;
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
} view_look;

static fg_status choose_look(view_look *out, fg_context *context, const fg_field *field,
                             const fg_view_options *options)
{
  fg_view_options *o = &out->options;
  *o = options ? *options : (fg_view_options){.most = 0};
  o->most = o->most ? o->most : MOST;
  o->fewest = o->fewest ? o->fewest : o->most < FEWEST ? o->most : FEWEST;
  o->seed = o->seed ? o->seed : 1;
  o->anisotropy = o->anisotropy > 0.0 ? o->anisotropy : ANISOTROPY;
  o->coverage = o->coverage > 0.0 ? o->coverage : COVERAGE;
  const bool solid = fg_field_contents(field)->dimension == 3;
  if (solid && (o->scale_count < 1 || !o->scales))
    return fg__fail(context, FG_STATUS_ARGUMENT, "page: %d scales of a field in 3D",
                    o->scale_count);
  if (o->fewest < 1 || o->most < o->fewest)
    return fg__fail(context, FG_STATUS_ARGUMENT, "page: from %d to %d arrows", o->most,
                    o->fewest);
  out->speeds[0] = o->speed_min;
  out->speeds[1] = o->speed_max;
  const char *const wanted[2] = {o->title, NULL};
  fg__caption_write(out->title, out->subtitle, fg_field_contents(field), NULL, wanted,
                    0.0);
  fg_status status = fg__palette_create(&out->palette, context, o->palette);
  if (!status && !(out->speeds[1] > out->speeds[0]))
    status = fg_field_speed_range(out->speeds, context, field);
  return status;
}

static void write_palette(FILE *stream, const fg__palette *palette)
{
  fputs("\"palette\":[", stream);
  for (int k = 0; k < COLORS; ++k) {
    const fg__color color = fg__palette_color(palette, k / (COLORS - 1.0));
    const double part[3] = {color.red, color.green, color.blue};
    unsigned rgb = 0;
    for (int i = 0; i < 3; ++i)
      rgb = rgb << 8 | (unsigned)floor(255.0 * fmin(fmax(part[i], 0.0), 1.0) + 0.5);
    fprintf(stream, "%s\"#%06x\"", k ? "," : "", rgb);
  }
  putc(']', stream);
}

static void write_words(FILE *stream, const fg_field_arrays *a, const view_look *look)
{
  const struct {
    const char *name, *text;
  } words[] = {{"version", fg_version()},    {"title", look->title},
               {"subtitle", look->subtitle}, {"units", a->velocity_units},
               {"xName", a->axis_name[0]},   {"yName", a->axis_name[1]},
               {"zName", a->axis_name[2]},   {"xUnits", a->axis_units[0]},
               {"yUnits", a->axis_units[1]}, {"zUnits", a->axis_units[2]},
               {"projection", a->projection}};
  for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
    fprintf(stream, "\"%s\":", words[k].name);
    fg__view_text(stream, words[k].text);
    putc(',', stream);
  }
}

static bool write_samples(FILE *stream, const fg__view_samples *s)
{
  static const char *const axis[] = {"x", "y"}, *const velocity[] = {"u", "v"};
  const size_t count = (size_t)s->size[0] * (size_t)s->size[1];
  bool done = true;
  fprintf(stream, "\"width\":%d,\"height\":%d,\"unit\":%.9g", s->size[0], s->size[1],
          s->unit);
  for (int k = 0; k < 2 && done; ++k) {
    fprintf(stream, ",\"%s\":", axis[k]);
    done = fg__view_bytes(stream, s->axis[k], (size_t)s->size[k] * sizeof(double));
    fprintf(stream, ",\"%s\":", velocity[k]);
    done = done && fg__view_bytes(stream, s->velocity[k], count * sizeof(uint16_t));
  }
  return done;
}

/* Arrows of clusters are made anew by the page. */
static bool has_arrows(const fg_view_options *o)
{
  return o->scale_count > 0 && fg_icons_count(o->scales[0].icons) > 0 &&
         fg_icons_at(o->scales[0].icons, 0)->id > 0;
}

static fg_status write_flat(FILE *stream, fg_context *context, const fg_field *field,
                            const fg_view_options *o)
{
  const fg_field_arrays *a = fg_field_contents(field);
  fg__view_samples samples;
  fg_status status = fg__view_samples_create(&samples, context, field, MOST_SAMPLES);
  if (status)
    return status;
  fprintf(stream,
          ",\"most\":%d,\"fewest\":%d,\"seed\":%" PRIu64 ",\"lengths\":\"%s\","
          "\"kind\":\"%s\",\"anisotropy\":%.9g,\"coverage\":%.9g,"
          "\"axes\":\"%s\",\"period\":[%.17g,%.17g],",
          o->most, o->fewest, o->seed, o->lengths == FG_LENGTHS_FAIR ? "fair" : "free",
          o->kind == FG_RUN_CLUSTERS ? "clusters" : "arrows", o->anisotropy, o->coverage,
          a->scale == FG_SCALE_GEO ? "degrees" : "plain", a->period[0], a->period[1]);
  status = fg__view_map(stream, context, field);
  putc(',', stream);
  if (!status && has_arrows(o)) {
    status = fg__view_arrows(stream, context, o->scales[0].icons);
    putc(',', stream);
  }
  if (!status && !write_samples(stream, &samples))
    status = fg__fail_memory(context, "a page's samples", 4);
  fg__view_samples_clear(&samples);
  return status;
}

static fg_status write_page(FILE *stream, fg_context *context, const fg_field *field,
                            const view_look *look)
{
  const bool solid = fg_field_contents(field)->dimension == 3;
  const char *page = (const char *)(solid ? fg__space_page : fg__view_page);
  const size_t size = solid ? fg__space_page_size : fg__view_page_size;
  const char *mark = strstr(page, fg__view_mark);
  const size_t before = mark ? (size_t)(mark - page) : 0;
  const size_t after = before + strlen(fg__view_mark);
  fwrite(page, 1, before, stream);
  putc('{', stream);
  write_words(stream, fg_field_contents(field), look);
  write_palette(stream, &look->palette);
  fprintf(stream, ",\"speeds\":[%.9g,%.9g]", look->speeds[0], look->speeds[1]);
  fg_status status = solid ? fg__view_space(stream, context, field, &look->options)
                           : write_flat(stream, context, field, &look->options);
  putc('}', stream);
  fwrite(page + after, 1, size - after, stream);
  return status;
}

fg_status fg_view_write(fg_context *context, const char *path, const fg_field *field,
                        const fg_view_options *options)
{
  if (!path || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "page: a NULL argument");
  if (fg_field_is_slab(field, NULL, NULL))
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: a page needs the whole field",
                    path);
  view_look look;
  fg__whole_file file;
  fg_status status = choose_look(&look, context, field, options);
  if (status)
    return status;
  status = fg__whole_file_open(&file, context, path);
  if (!status) {
    status = write_page(file.stream, context, field, &look);
    status = fg__whole_file_close(&file, context, status);
  }
  return status;
}
