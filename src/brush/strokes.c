#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/mix.h"
#include "base/threads.h"
#include "brush/layer.h"

static const double default_anisotropy = 0.15;

/* Strokes of the first and of the last layer are broader than their clusters, so that a
 * few evolutions of one scale, each from noise of its own, leave no canvas bare. */
static const double first_widening = 1.9, last_widening = 1.5;
enum { FIRST_PASSES = 4, PASSES = 3 };

/* A layer alone is that far from the first to the last: strokes as broad as they can be
 * while faces keep their features; by eye. */
static const double lone_share = 0.35;

/* Pixels a side of a touch of colour under the strokes. */
enum { TOUCH = 4 };
/* How far it reaches either way, and how far it may lie beside the block that it covers,
 * in such sides. */
static const double touch_reach = 1.8, touch_shift = 0.25;

/* Distances in RGB: of the image under one stroke of the first and of the last layer, and
 * between image and painting below which a later stroke is left out. */
static const double first_tolerance = 0.4, last_tolerance = 0.09;
static const double least_difference = 0.045;

/* A stroke and where its points begin. */
typedef struct entry {
  fg_stroke stroke;
  size_t first;
} entry;

struct fg_strokes {
  entry *entry;
  size_t count, entry_capacity;
  double (*point)[2];
  size_t points, point_capacity;
  int layers;
};

/* A painting while it is made. */
typedef struct work {
  fg_context *context;
  const fg_image_arrays *image;
  fg_brush_options options;
  int clusters[FG_MOST_BRUSH_SCALES]; /* ascending */
  fg__brush_canvas original;          /* averaged as suits the layer */
  fg__brush_canvas painted;
  fg_strokes *strokes;
} work;

/* Clusters of the layers that a picture gets by itself: broad ones that depend on the
 * composition only, and finer ones, up to four times as many each, until a cluster has
 * about so many pixels; finer strokes would be of a pixel's width, and more of them take
 * longer than a painting should. */
static const double broad_clusters[] = {80.0, 400.0, 1700.0};
enum { BROAD_LAYERS = sizeof broad_clusters / sizeof *broad_clusters };
static const double layer_ratio = 4.0;
static const double least_area = 60.0, most_clusters = 16000.0;

static void choose_layers(work *w)
{
  double pixels = (double)w->image->width * (double)w->image->height;
  double finest = fmin(pixels / least_area, most_clusters);
  double last = broad_clusters[BROAD_LAYERS - 1];
  int finer = (int)fmax(ceil(log(finest / last) / log(layer_ratio)), 1.0);
  /* an image too small for the broad layers has fewer clusters in each */
  double share = fmin(finest / (layer_ratio / 2.0 * last), 1.0);
  w->options.cluster_count = BROAD_LAYERS + finer;
  for (int k = 0; k < BROAD_LAYERS; ++k)
    w->clusters[k] = (int)fmax(share * broad_clusters[k], 2.0 + k);
  last *= share;
  for (int k = 1; k <= finer; ++k)
    w->clusters[BROAD_LAYERS + k - 1] =
        (int)fmax(last * pow(finest / last, (double)k / finer), 1.0 + BROAD_LAYERS + k);
}

static void choose_clusters(work *w)
{
  fg_brush_options *o = &w->options;
  if (o->cluster_count == 0) {
    choose_layers(w);
    return;
  }
  for (int k = 0; k < o->cluster_count; ++k) {
    int at = k;
    for (; at > 0 && w->clusters[at - 1] > o->clusters[k]; --at)
      w->clusters[at] = w->clusters[at - 1];
    w->clusters[at] = o->clusters[k];
  }
}

static fg_status settle(work *w)
{
  fg_brush_options *o = &w->options;
  if (o->anisotropy == 0.0)
    o->anisotropy = default_anisotropy;
  if (!(o->anisotropy > 0.0 && o->anisotropy < 1.0))
    return fg__fail(w->context, FG_STATUS_ARGUMENT, "anisotropy %g is not in (0, 1)",
                    o->anisotropy);
  if (o->seed == 0)
    o->seed = 1;
  if (o->threads == 0)
    o->threads = fg__threads_available();
  if (!o->clusters)
    o->cluster_count = 0;
  if (o->cluster_count < 0 || o->cluster_count > FG_MOST_BRUSH_SCALES)
    return fg__fail(w->context, FG_STATUS_ARGUMENT, "brush: %d scales; 1 to %d are taken",
                    o->cluster_count, FG_MOST_BRUSH_SCALES);
  for (int k = 0; k < o->cluster_count; ++k)
    if (o->clusters[k] < 1)
      return fg__fail(w->context, FG_STATUS_ARGUMENT,
                      "brush: scale %d has %d clusters; at least 1 is needed", k,
                      o->clusters[k]);
  choose_clusters(w);
  return FG_STATUS_OK;
}

static fg_status add_stroke(work *w, const fg__brush_line *line, int layer)
{
  fg_strokes *s = w->strokes;
  if (!fg__grow((void **)&s->entry, &s->entry_capacity, s->count + 1, sizeof *s->entry) ||
      !fg__grow((void **)&s->point, &s->point_capacity, s->points + (size_t)line->count,
                sizeof *s->point))
    return fg__fail_memory(w->context, "strokes", s->count * sizeof *s->entry);
  entry *added = &s->entry[s->count];
  added->first = s->points;
  added->stroke = (fg_stroke){.layer = layer,
                              .point_count = line->count,
                              .width = line->width,
                              .color = {line->color[0], line->color[1], line->color[2]},
                              .seed = fg__mix(w->options.seed ^ fg__mix(s->count))};
  memcpy(s->point + s->points, line->point, (size_t)line->count * sizeof line->point[0]);
  s->points += (size_t)line->count;
  ++s->count;
  /* the ends taper and show what lies under them */
  double spacing =
      hypot(line->point[1][0] - line->point[0][0], line->point[1][1] - line->point[0][1]);
  for (int n = 0; n < line->count; ++n) {
    double begun = n * spacing / line->width;
    double left = (line->count - 1 - n) * spacing / line->width;
    double share = fmin(fmin(begun / 0.5, left / 0.8), 1.0);
    fg__canvas_dab(&w->painted, line->point[n], 0.42 * share * line->width, line->color);
  }
  return FG_STATUS_OK;
}

/* Lines where the painting is bare or differs from the image become strokes. */
static fg_status paint_lines(work *w, const fg__brush_line *lines, int count, int layer)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < count && !status; ++n)
    if (lines[n].count >= 2 &&
        (fg__line_is_bare(&lines[n], &w->painted) ||
         fg__line_difference(&lines[n], &w->original, &w->painted) >= least_difference))
      status = add_stroke(w, &lines[n], layer);
  return status;
}

static fg_status paint_pass(work *w, const fg__structure *structure,
                            const fg__layer_plan *plan, int layer)
{
  int last = w->options.cluster_count - 1, count;
  double share = last > 0 ? (double)layer / last : lone_share;
  fg__line_rule rule = {
      .widening = first_widening + share * (last_widening - first_widening),
      .tolerance = first_tolerance + share * (last_tolerance - first_tolerance)};
  fg_density *density;
  fg__brush_line *lines = NULL;
  fg_status status = fg__layer_density(&density, w->context, w->image, structure, plan);
  if (!status)
    status = fg__layer_lines(&lines, &count, w->context, density, &w->original, &rule,
                             plan->threads);
  if (!status)
    status = paint_lines(w, lines, count, layer);
  free(lines);
  fg_density_destroy(density);
  return status;
}

static fg_status paint_layer(work *w, int layer)
{
  fg__layer_plan plan = {.clusters = w->clusters[layer],
                         .anisotropy = w->options.anisotropy,
                         .threads = w->options.threads};
  double brush = fg__layer_brush(w->image, plan.clusters);
  fg__structure structure = {0};
  fg_status status = fg__canvas_of_image(&w->original, w->context, w->image, 0.2 * brush);
  if (!status)
    status = fg__layer_structure(&structure, w->context, w->image, &plan);
  int passes = layer == 0 ? FIRST_PASSES : PASSES;
  for (int pass = 0; pass < passes && !status; ++pass) {
    plan.seed = fg__mix(w->options.seed + (uint64_t)(64 * layer + pass));
    status = paint_pass(w, &structure, &plan, layer);
  }
  fg__structure_clear(&structure);
  fg__canvas_clear(&w->original);
  return status;
}

static bool block_is_bare(const work *w, int left, int top)
{
  for (int j = top; j < top + TOUCH; ++j)
    for (int i = left; i < left + TOUCH; ++i) {
      size_t n = (size_t)j * (size_t)w->image->width + (size_t)i;
      if (i < w->image->width && j < w->image->height && !w->painted.painted[n] &&
          (!w->image->alpha || w->image->alpha[n] >= 0.5F))
        return true;
    }
  return false;
}

/* The direction of the level sets at a place, y downwards. */
static void along_level_set(double out[2], const work *w, const fg__structure *structure,
                            const double at[2])
{
  double tensor[6];
  const fg_energy_place place = {.position = {at[0], w->image->height - at[1]}};
  fg__structure_tensor(tensor, &place, structure);
  double angle = 0.5 * atan2(2.0 * tensor[1], tensor[0] - tensor[2]);
  out[0] = cos(angle);
  out[1] = -sin(angle);
}

/* A touch along the level set through a block's middle, a little beside it, so that no
 * rows are seen. */
static void place_touch(fg__brush_line *line, const work *w,
                        const fg__structure *structure, int left, int top)
{
  uint64_t hash =
      fg__mix(w->options.seed ^ fg__mix((uint64_t)left << 32 | (uint64_t)top));
  const double beside = touch_shift * TOUCH * ((double)(hash >> 32) / 2147483648.0 - 1.0);
  double at[2] = {left + 0.5 * TOUCH, top + 0.5 * TOUCH}, along[2];
  fg__canvas_color(line->color, &w->original, at);
  along_level_set(along, w, structure, at);
  line->count = 2;
  line->width = 2.0 * TOUCH;
  for (int n = 0; n < 2; ++n) {
    double arc = (n ? touch_reach : -touch_reach) * TOUCH;
    line->point[n][0] = at[0] + arc * along[0] - beside * along[1];
    line->point[n][1] = at[1] + arc * along[1] + beside * along[0];
  }
}

/* Touches of colour, to be painted first, where strokes may leave the canvas bare. */
static fg_status touch_up(work *w)
{
  const fg__layer_plan plan = {.clusters = w->clusters[w->options.cluster_count - 1],
                               .anisotropy = w->options.anisotropy};
  fg__structure structure = {0};
  fg_status status = fg__canvas_of_image(&w->original, w->context, w->image, 0.5 * TOUCH);
  if (!status)
    status = fg__layer_structure(&structure, w->context, w->image, &plan);
  for (int j = 0; j < w->image->height && !status; j += TOUCH)
    for (int i = 0; i < w->image->width && !status; i += TOUCH) {
      if (!block_is_bare(w, i, j))
        continue;
      fg__brush_line line;
      place_touch(&line, w, &structure, i, j);
      status = add_stroke(w, &line, 0);
    }
  fg__structure_clear(&structure);
  fg__canvas_clear(&w->original);
  return status;
}

/* Brings the entries from `count` on to the front, and ties all to their points, which
 * have come to rest. */
static fg_status put_in_order(fg_strokes *s, fg_context *context, size_t count)
{
  entry *ordered = fg__allocate(s->count + 1, sizeof *ordered);
  if (!ordered)
    return fg__fail_memory(context, "strokes", s->count * sizeof *ordered);
  for (size_t n = 0; n < s->count; ++n) {
    entry *e = &ordered[n];
    *e = s->entry[n < s->count - count ? count + n : n - (s->count - count)];
    e->stroke.points = (const double(*)[2])(s->point + e->first);
  }
  free(s->entry);
  s->entry = ordered;
  return FG_STATUS_OK;
}

fg_status fg_strokes_create(fg_strokes **out, fg_context *context, const fg_image *image,
                            const fg_brush_options *options)
{
  if (!out || !image)
    return fg__fail(context, FG_STATUS_ARGUMENT, "strokes: a NULL argument");
  *out = NULL;
  work w = {.context = context, .image = fg_image_contents(image)};
  if (options)
    w.options = *options;
  fg_status status = settle(&w);
  if (status)
    return status;
  w.strokes = fg__allocate(1, sizeof *w.strokes);
  if (!w.strokes)
    return fg__fail_memory(context, "strokes", sizeof *w.strokes);
  w.strokes->layers = w.options.cluster_count;
  status = fg__canvas_blank(&w.painted, context, w.image);
  for (int layer = 0; layer < w.options.cluster_count && !status; ++layer)
    status = paint_layer(&w, layer);
  size_t painted = w.strokes->count;
  if (!status)
    status = touch_up(&w);
  if (!status)
    status = put_in_order(w.strokes, context, painted);
  fg__canvas_clear(&w.painted);
  if (status) {
    fg_strokes_destroy(w.strokes);
    return status;
  }
  *out = w.strokes;
  return FG_STATUS_OK;
}

void fg_strokes_destroy(fg_strokes *strokes)
{
  if (!strokes)
    return;
  free(strokes->entry);
  free(strokes->point);
  free(strokes);
}

int fg_strokes_count(const fg_strokes *strokes)
{
  return (int)strokes->count;
}

const fg_stroke *fg_strokes_at(const fg_strokes *strokes, int index)
{
  return &strokes->entry[index].stroke;
}

int fg_strokes_layers(const fg_strokes *strokes)
{
  return strokes->layers;
}
