/* The scores of icons as a picture of a field. */
#include "base/memory.h"
#include "score/measures.h"

#include <math.h>
#include <stdlib.h>

typedef struct scoring {
  const fg_score_options *options;
  fg__threads *threads;
  fg__domain_raster raster;
  fg__samples samples;
  fg__nearest nearest;
  fg__harmonic harmonic;
  int count; /* nominal */
} scoring;

static fg_status check(fg_context *context, const fg_field *field, const fg_icons *icons,
                       const fg_score_options *options)
{
  if (!field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: no field or no icons");
  if (options->lengths != FG_SCORE_ARROWS && options->lengths != FG_SCORE_FREE)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: no class of lengths is %d",
                    (int)options->lengths);
  if (options->count < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: a picture of %d icons",
                    options->count);
  if (!(options->ink >= 0.0) || isinf(options->ink))
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: ink of at most %g",
                    options->ink);
  if (options->threads < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: %d threads", options->threads);
  return FG_STATUS_OK;
}

static void leave_out_rest(fg_score *out)
{
  out->advection = out->critical_f1 = (double)NAN;
  out->void_mean = out->void_max = (double)NAN;
  out->clutter = out->tangency = out->outside = (double)NAN;
}

static fg_status take_samples(scoring *s, fg_score *out, fg_context *context,
                              const fg_icons *icons)
{
  const double share = s->raster.measure / s->count;
  const double lambda = s->raster.dimension == 3 ? cbrt(share) : sqrt(share);
  const double ink = s->options->ink,
               all = ink > 0.0 ? ink * s->count * lambda : HUGE_VAL;
  const bool free_lengths = s->options->lengths == FG_SCORE_FREE;
  fg_status status = fg__samples_create(&s->samples, context, &s->raster, icons,
                                        free_lengths ? HUGE_VAL : lambda, all);
  out->icons = s->samples.icons;
  out->count_length = lambda;
  out->ink = s->samples.length / (s->count * lambda);
  out->shortest = s->samples.shortest / lambda;
  out->longest = s->samples.longest / lambda;
  return status;
}

static fg_status read_nearest(scoring *s, fg_score *out, fg_context *context)
{
  fg_status status = fg__nearest_create(&s->nearest, context, &s->raster, &s->samples,
                                        out->count_length, s->threads);
  if (status == FG_STATUS_OK)
    status = fg__reader_error(&out->nearest, context, &s->raster, s->nearest.angle);
  if (status == FG_STATUS_OK)
    status = fg__reader_error(&out->inverse_distance, context, &s->raster,
                              s->nearest.weighted_angle);
  if (s->options->readers_only)
    fg__nearest_clear(&s->nearest);
  return status;
}

static fg_status read_diffusion(scoring *s, fg_score *out, fg_context *context)
{
  fg_status status =
      fg__harmonic_create(&s->harmonic, context, &s->raster, &s->samples, 0.0);
  if (status != FG_STATUS_OK)
    return status;
  float *angle = fg__allocate(s->raster.cells, sizeof *angle);
  if (!angle)
    return fg__fail_memory(context, "angles", s->raster.cells * sizeof *angle);
  fg__harmonic_angles(angle, &s->raster, &s->harmonic);
  status = fg__reader_error(&out->diffusion, context, &s->raster, angle);
  free(angle);
  return status;
}

static fg_status measure_rest(scoring *s, fg_score *out, fg_context *context)
{
  const fg__domain_raster *raster = &s->raster;
  const fg__samples *samples = &s->samples;
  const double lambda = out->count_length;
  const size_t all = samples->count + samples->outside;
  fg_status status = fg__check_stop(context);
  if (status == FG_STATUS_OK && raster->dimension == 2)
    status = fg__score_critical(&out->critical_f1, context, raster, &s->harmonic, lambda,
                                s->threads);
  if (status == FG_STATUS_OK)
    status = fg__score_clutter(&out->clutter, context, raster, samples, lambda);
  if (status != FG_STATUS_OK)
    return status;
  out->advection = fg__score_advection(raster, &s->harmonic, s->threads);
  out->tangency = fg__score_tangency(raster, samples);
  out->outside = all ? (double)samples->outside / (double)all : 0.0;
  fg__score_voids(&out->void_mean, &out->void_max, raster, s->nearest.distance, lambda);
  return fg__check_stop(context);
}

static fg_status score(scoring *s, fg_score *out, fg_context *context,
                       const fg_field *field, const fg_icons *icons)
{
  fg_status status = fg__domain_raster_create(&s->raster, context, field, s->threads);
  if (status == FG_STATUS_OK)
    status = take_samples(s, out, context, icons);
  if (status == FG_STATUS_OK)
    status = read_nearest(s, out, context);
  if (status == FG_STATUS_OK)
    status = read_diffusion(s, out, context);
  out->mean =
      (out->diffusion.mean + out->nearest.mean + out->inverse_distance.mean) / 3.0;
  out->percentile_95 = (out->diffusion.percentile_95 + out->nearest.percentile_95 +
                        out->inverse_distance.percentile_95) /
                       3.0;
  leave_out_rest(out);
  if (status == FG_STATUS_OK && !s->options->readers_only)
    status = measure_rest(s, out, context);
  return status;
}

fg_status fg_icons_score(fg_score *out, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_score_options *options)
{
  static const fg_score_options usual = {0};
  options = options ? options : &usual;
  if (!out)
    return fg__fail(context, FG_STATUS_ARGUMENT, "score: nowhere to put it");
  *out = (fg_score){0};
  fg_status status = check(context, field, icons, options);
  if (status != FG_STATUS_OK)
    return status;
  const int icon_count = fg_icons_count(icons);
  scoring s = {.options = options,
               .count = options->count   ? options->count
                        : icon_count > 0 ? icon_count
                                         : 1};
  status = fg__threads_create(
      &s.threads, context, options->threads ? options->threads : fg__threads_available());
  if (status == FG_STATUS_OK)
    status = score(&s, out, context, field, icons);
  fg__harmonic_clear(&s.harmonic);
  fg__nearest_clear(&s.nearest);
  fg__samples_clear(&s.samples);
  fg__domain_raster_clear(&s.raster);
  fg__threads_destroy(s.threads);
  if (status != FG_STATUS_OK)
    *out = (fg_score){0};
  return status;
}
