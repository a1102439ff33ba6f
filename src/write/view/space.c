/* What the page of a run in 3D holds. */
#include "base/context.h"
#include "base/memory.h"
#include "base/vector.h"
#include "picture/arrow_speeds.h"
#include "picture/camera.h"
#include "picture/caption.h"
#include "picture/silhouette.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>

/* Nodes of the raster that the cut plane samples. */
enum { MOST_NODES = 48 * 48 * 48 };

/* Cells along the longest side in which vertices of surfaces become one: those of
 * clusters of so many scales, of some 25,000 vertices each, then take a megabyte of the
 * page. */
enum { CLUSTER_CELLS = 48, CLUSTER_SCALES = 4, OUTLINE_CELLS = 80 };

enum { SPEED_STEPS = 4095 };

typedef struct space_page {
  FILE *stream;
  fg_context *context;
  const fg_field *field;
  const fg_view_options *options;
  fg__view_box box;
} space_page;

static const char *const axis_words[] = {"x", "y", "z"};

static fg_status fail(const space_page *page, size_t bytes)
{
  return fg__fail_memory(page->context, "a page in 3D", bytes);
}

static void put_triple(FILE *stream, const char *name, const double triple[3])
{
  fprintf(stream, ",\"%s\":[%.9g,%.9g,%.9g]", name, triple[0], triple[1], triple[2]);
}

/* Nodes along each axis at most so far apart, no more than the data have. Returns whether
 * closer ones would be more. */
static bool count_nodes(int nodes[3], const space_page *page, double apart)
{
  const fg_field_arrays *a = fg_field_contents(page->field);
  bool more = false;
  for (int k = 0; k < 3; ++k) {
    const int most = a->size[k] + (a->period[k] > 0.0);
    const double cells = ceil((page->box.high[k] - page->box.low[k]) / apart);
    nodes[k] = (int)fmin(cells + 1.0, most);
    more = more || nodes[k] < most;
  }
  return more;
}

/* The closest raster that is small enough. */
static void lay_raster(int nodes[3], const space_page *page)
{
  double apart = 1.0 / page->box.scale;
  int closer[3];
  bool more = count_nodes(nodes, page, apart);
  while (more) {
    apart *= 0.98;
    more = count_nodes(closer, page, apart);
    if ((double)closer[0] * closer[1] * closer[2] > MOST_NODES)
      return;
    for (int k = 0; k < 3; ++k)
      nodes[k] = closer[k];
  }
}

/* Halves of the velocity's components over `unit`; NaN where there is none. */
static void sample(int32_t *half[3], const int nodes[3], const space_page *page,
                   double unit)
{
  const fg_field_arrays *a = fg_field_contents(page->field);
  size_t n = 0;
  int at[3];
  for (at[2] = 0; at[2] < nodes[2]; ++at[2])
    for (at[1] = 0; at[1] < nodes[1]; ++at[1])
      for (at[0] = 0; at[0] < nodes[0]; ++at[0], ++n) {
        double place[3], velocity[3];
        for (int k = 0; k < 3; ++k) {
          const double share = at[k] / (nodes[k] - 1.0);
          place[k] = page->box.low[k] + share * (page->box.high[k] - page->box.low[k]);
          if (!(a->period[k] >
                0.0)) /* the last node is the data's, in spite of rounding */
            place[k] = fmin(place[k], page->box.high[k]);
        }
        const bool is_there = fg_field_velocity(page->field, place, velocity);
        for (int k = 0; k < 3; ++k)
          half[k][n] = fg__view_half(is_there ? (float)(velocity[k] / unit) : nanf(""));
      }
}

static fg_status write_samples(const space_page *page)
{
  int nodes[3];
  lay_raster(nodes, page);
  const size_t count = (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
  int32_t *all = fg__allocate(3 * count, sizeof *all);
  bool done = all != NULL;
  if (done) {
    int32_t *half[3] = {all, all + count, all + 2 * count};
    const double unit = fg__view_fastest(page->field);
    sample(half, nodes, page, unit);
    fprintf(page->stream, ",\"field\":{\"nodes\":[%d,%d,%d],\"unit\":%.9g", nodes[0],
            nodes[1], nodes[2], unit);
    for (int k = 0; k < 3 && done; ++k) {
      fprintf(page->stream, ",\"%s\":", axis_words[k]);
      done = fg__view_packed(page->stream, half[k], count);
    }
    putc('}', page->stream);
  }
  free(all);
  return done ? FG_STATUS_OK : fail(page, 3 * count * sizeof *all);
}

/* Speeds at all points of the icons' lines. */
static fg_status find_speeds(int32_t *step, const space_page *page, const fg_icons *icons,
                             double fastest)
{
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double *speed;
    fg_status status = fg__arrow_speeds(&speed, page->context, page->field, icon);
    for (int i = 0; i < icon->point_count && !status; ++i)
      *step++ = fg__view_step(speed[i] / fastest, SPEED_STEPS);
    free(speed);
    if (status)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status write_speeds(const space_page *page, const fg_icons *icons)
{
  const double fastest = sqrt(3.0) * fg__view_fastest(page->field);
  size_t count = 0;
  for (int n = 0; n < fg_icons_count(icons); ++n)
    count += (size_t)fg_icons_at(icons, n)->point_count;
  int32_t *steps = fg__allocate(count + 1, sizeof *steps);
  fg_status status = steps ? find_speeds(steps, page, icons, fastest)
                           : fail(page, count * sizeof *steps);
  fprintf(page->stream, ",\"fastest\":%.9g,\"speeds\":", fastest);
  if (!status && !fg__view_packed(page->stream, steps, count))
    status = fail(page, count * sizeof *steps);
  free(steps);
  return status;
}

static fg_status write_paths(const space_page *page, const fg_icons *icons)
{
  putc(',', page->stream);
  fg_status status = fg__view_paths(page->stream, page->context, icons, 3);
  return status ? status : write_speeds(page, icons);
}

/* The cluster at a place: the label of the nearest node; 0: none. */
static int cluster_at(const fg_density *density, const double place[3])
{
  const fg_density_arrays *a = fg_density_contents(density);
  const int *label = fg_density_labels(density);
  size_t node = 0;
  for (int k = 2; k >= 0; --k) {
    int at = (int)floor((place[k] - a->origin[k]) / a->spacing[k] + 0.5);
    if (a->periodic[k])
      at = (at % a->nodes[k] + a->nodes[k]) % a->nodes[k];
    at = at < 0 ? 0 : at >= a->nodes[k] ? a->nodes[k] - 1 : at;
    node = node * (size_t)a->nodes[k] + (size_t)at;
  }
  return label && label[node] > 0 ? label[node] : 0;
}

/* Icons of clusters have no id. In the page they are numbered through all scales. */
static int id_of(const fg_icon *icon, int n, int before)
{
  return icon->id ? icon->id : before + n + 1;
}

/* How far a place is from an icon's line. */
static double distance_to(const fg_icon *icon, const double place[3])
{
  double least = HUGE_VAL;
  for (int i = 0; i < icon->point_count; ++i)
    least = fmin(least, fg__distance(icon->points[i], place));
  return least;
}

/* Of the icons of the next scale that of the cluster at a place, else the nearest one;
 * -1: there is none. */
static int successor_of(const fg_icon *icon, const fg_view_scale *next)
{
  const int cluster = next->density ? cluster_at(next->density, icon->center) : 0;
  int nearest = -1;
  double least = HUGE_VAL;
  for (int n = 0; n < fg_icons_count(next->icons); ++n) {
    const fg_icon *other = fg_icons_at(next->icons, n);
    if (cluster && other->cluster == cluster)
      return n;
    const double far = distance_to(other, icon->center);
    if (far < least) {
      least = far;
      nearest = n;
    }
  }
  return nearest;
}

/* The icon of the next scale that this one goes into; 0: there is none. `before`: icons
 * of this scale and those before it. */
static int parent_of(const fg_icon *icon, const fg_view_scale *next, int before)
{
  if (icon->id || !next)
    return icon->parent;
  const int n = successor_of(icon, next);
  return n < 0 ? 0 : id_of(fg_icons_at(next->icons, n), n, before);
}

static void write_icon(FILE *stream, const fg_icon *icon, int id, int parent)
{
  fprintf(stream,
          "{\"id\":%d,\"parent\":%d,\"points\":%d,\"width\":%.6g,\"tailWidth\":%.6g,"
          "\"headLength\":%.6g,\"headWidth\":%.6g,\"volume\":%.6g,\"speed\":%.6g}",
          id, parent, icon->point_count, icon->width, icon->tail_width, icon->head_length,
          icon->head_width, icon->area, icon->speed);
}

static fg_status write_clusters(const space_page *page, const fg_density *density)
{
  const double share = fmin(1.0, (double)CLUSTER_SCALES / page->options->scale_count);
  fg_surface *surface = NULL;
  fg_status status =
      density ? fg_density_surface(&surface, page->context, density) : FG_STATUS_OK;
  fputs(",\"clusters\":", page->stream);
  if (!status)
    status = fg__view_surface(page->stream, page->context, surface, page->box.low,
                              page->box.high, (int)(CLUSTER_CELLS * sqrt(share)));
  fg_surface_destroy(surface);
  return status;
}

static fg_status write_scale(const space_page *page, int index, int before)
{
  const fg_view_scale *scale = &page->options->scales[index];
  const fg_view_scale *next = index + 1 < page->options->scale_count ? scale + 1 : NULL;
  const int count = fg_icons_count(scale->icons);
  const char *const wanted[2] = {NULL, NULL};
  char title[FG__CAPTION_BYTES], caption[FG__CAPTION_BYTES];
  fg__caption_write(title, caption, fg_field_contents(page->field), scale->icons, wanted,
                    0.0);
  fputs("{\"caption\":", page->stream);
  fg__view_text(page->stream, caption);
  fputs(",\"icons\":[", page->stream);
  for (int n = 0; n < count; ++n) {
    const fg_icon *icon = fg_icons_at(scale->icons, n);
    fputs(n ? ",\n" : "", page->stream);
    write_icon(page->stream, icon, id_of(icon, n, before),
               parent_of(icon, next, before + count));
  }
  putc(']', page->stream);
  fg_status status = write_paths(page, scale->icons);
  if (!status)
    status = write_clusters(page, scale->density);
  putc('}', page->stream);
  return status;
}

static fg_status write_outline(const space_page *page)
{
  fg_surface *surface = NULL;
  fg_status status = fg__silhouette_create(&surface, page->context, page->field);
  fputs(",\"outline\":", page->stream);
  if (!status)
    status = fg__view_surface(page->stream, page->context, surface, page->box.low,
                              page->box.high, OUTLINE_CELLS);
  fg_surface_destroy(surface);
  return status;
}

fg_status fg__view_space(FILE *stream, fg_context *context, const fg_field *field,
                         const fg_view_options *options)
{
  space_page page = {stream, context, field, options, {.scale = 1.0}};
  fg__view_box_of(&page.box, fg_field_contents(field));
  put_triple(stream, "low", page.box.low);
  put_triple(stream, "high", page.box.high);
  put_triple(stream, "period", fg_field_contents(field)->period);
  fprintf(stream, ",\"view\":[%.6g,%.6g]", options->azimuth, options->elevation);
  fg_status status = write_outline(&page);
  if (!status)
    status = write_samples(&page);
  fputs(",\"scales\":[", stream);
  for (int k = 0, before = 0; k < options->scale_count && !status; ++k) {
    fputs(k ? ",\n" : "", stream);
    status = write_scale(&page, k, before);
    before += fg_icons_count(options->scales[k].icons);
  }
  putc(']', stream);
  return status;
}
