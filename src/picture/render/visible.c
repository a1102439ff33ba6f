#include "picture/render/visible.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clones.h"
#include "base/memory.h"
#include "base/vector.h"

#define PLACE(column, row)                                                               \
  {                                                                                      \
    ((column) + 0.5) / FG__SAMPLES, ((row) + 0.5) / FG__SAMPLES                          \
  }
const double fg__sample_place[FG__SAMPLES][2] = {
    PLACE(5, 0),   PLACE(9, 1),  PLACE(1, 2),   PLACE(13, 3), PLACE(11, 4), PLACE(3, 5),
    PLACE(15, 6),  PLACE(7, 7),  PLACE(4, 8),   PLACE(12, 9), PLACE(0, 10), PLACE(8, 11),
    PLACE(10, 12), PLACE(6, 13), PLACE(14, 14), PLACE(2, 15)};
#undef PLACE

#define INLINE static inline __attribute__((always_inline))

/* Two surfaces nearer than this, in longest sides of the box, are one met at its edge. */
static const float same_distance = 1e-6F;

/* Three functions, linear in the picture, that are not negative inside a triangle. Those
 * of neighbours are each other's negative to the bit along their common edge: no point
 * there is missed. Depth is `volume` over their sum. */
typedef struct edges {
  double value[3][3]; /* of x, y and 1 */
  double volume;
  bool faces_away;
} edges;

static bool find_edges(const fg__faces *faces, const fg__face *face, edges *out)
{
  const double *at[3];
  for (int k = 0; k < 3; ++k)
    at[k] = faces->corner[face->corner[k]].at;
  for (int k = 0; k < 3; ++k)
    fg__cross(at[(k + 1) % 3], at[(k + 2) % 3], out->value[k]);
  out->volume = fg__dot(at[0], out->value[0]);
  out->faces_away = out->volume > 0.0;
  if (out->volume < 0.0) {
    out->volume = -out->volume;
    for (int k = 0; k < 9; ++k)
      out->value[k / 3][k % 3] = -out->value[k / 3][k % 3];
  }
  return out->volume > 0.0;
}

/* False outside. */
INLINE bool weigh(const edges *e, double x, double y, double weight[3])
{
  for (int k = 0; k < 3; ++k)
    weight[k] = e->value[k][0] * x + (e->value[k][1] * y + e->value[k][2]);
  return weight[0] >= 0.0 && weight[1] >= 0.0 && weight[2] >= 0.0;
}

/* The way from the eye to a depth along the view, through a point of the picture. */
static void way_to(const fg__camera *camera, double x, double y, double depth,
                   double out[3])
{
  fg__add_scaled(camera->forward, (x - camera->x) / camera->factor, camera->right, out);
  fg__add_scaled(out, (camera->y - y) / camera->factor, camera->up, out);
  for (int k = 0; k < 3; ++k)
    out[k] *= depth;
}

static bool is_in_box(const fg__view *view, double x, double y, double depth)
{
  static const double rounding = 1.000001;
  double way[3];
  way_to(&view->about->camera, x, y, depth, way);
  for (int k = 0; k < 3; ++k)
    if (fabs(view->about->camera.eye[k] + way[k]) >
        view->about->view_box.half[k] * rounding)
      return false;
  return true;
}

static fg__face_extent extent_of(const fg__view *view, const fg__faces *faces,
                                 const fg__face *face)
{
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < 3; ++n) {
    const double *at = faces->corner[face->corner[n]].at;
    for (int k = 0; k < 2; ++k) {
      low[k] = fg__least(low[k], at[k] / at[2]);
      high[k] = fg__most(high[k], at[k] / at[2]);
    }
  }
  return (fg__face_extent){fg__rows_between(low[1], high[1], view->about->height),
                           fg__rows_between(low[0], high[0], view->about->width)};
}

/* The rows of a triangle within a band. */
static fg__band_rows rows_in_band(fg__band_rows rows, int band)
{
  int first = band * FG__BAND, last = first + FG__BAND - 1;
  return (fg__band_rows){rows.first > first ? rows.first : first,
                         rows.last < last ? rows.last : last};
}

/* Extents of all triangles, and the bands that they touch; *extents: free them also after
 * a failure. */
static fg_status sort_faces(fg__bands *out, fg__face_extent **extents,
                            fg_context *context, const fg__view *view,
                            const fg__faces *faces)
{
  fg__band_rows *rows = fg__allocate(faces->face_count, sizeof *rows);
  *extents = fg__allocate(faces->face_count, sizeof **extents);
  fg_status status = FG_STATUS_OK;
  if (!rows || !*extents)
    status = fg__fail_memory(context, "a picture", faces->face_count * sizeof **extents);
  for (size_t n = 0; n < faces->face_count && !status; ++n) {
    fg__face_extent e = extent_of(view, faces, &faces->face[n]);
    (*extents)[n] = e;
    rows[n] = e.columns.first <= e.columns.last ? e.rows : e.columns;
  }
  if (!status)
    status = fg__bands_make(out, context, rows, faces->face_count, view->about->height);
  free(rows);
  return status;
}

fg_status fg__view_make(fg__view *out, fg_context *context, const fg__rendering *about,
                        const fg__geometry *geometry)
{
  *out = (fg__view){.about = about, .geometry = geometry};
  fg_status status =
      sort_faces(&out->solid, &out->solid_extent, context, out, &geometry->solid);
  if (!status)
    status = sort_faces(&out->layer, &out->layer_extent, context, out, &geometry->layer);
  return status;
}

void fg__view_clear(fg__view *view)
{
  free(view->solid_extent);
  free(view->layer_extent);
  fg__bands_clear(&view->solid);
  fg__bands_clear(&view->layer);
  *view = (fg__view){.about = NULL};
}

/* A triangle on its way into a band: its rows there, and its columns. */
typedef struct piece {
  int number;
  fg__band_rows rows, columns;
  edges edges;
} piece;

/* chosen: numbers of pixels, or NULL. False when nothing of a triangle is seen in a band,
 * or not in the chosen pixels. */
static bool find_piece(const fg__view *view, bool layer, int number, int band,
                       const int *chosen, piece *out)
{
  const fg__faces *faces = layer ? &view->geometry->layer : &view->geometry->solid;
  const fg__face_extent *at = &(layer ? view->layer_extent : view->solid_extent)[number];
  bool wanted = !chosen;
  out->number = number;
  out->rows = rows_in_band(at->rows, band);
  out->columns = at->columns;
  for (int y = out->rows.first; y <= out->rows.last && !wanted; ++y)
    for (int x = at->columns.first; x <= at->columns.last && !wanted; ++x)
      wanted = chosen[(ptrdiff_t)(y - band * FG__BAND) * view->about->width + x] >= 0;
  return wanted && find_edges(faces, &faces->face[number], &out->edges);
}

/* Notes a triangle at a point of it where it is nearer than what was there; sum: of the
 * edges' functions. */
INLINE void keep_nearer(const fg__view *view, const piece *p, double x, double y,
                        double sum, fg__face_at *out)
{
  float depth = (float)(p->edges.volume / sum);
  if (!(depth < out->depth))
    return;
  if (view->geometry->solid.face[p->number].clipped &&
      !is_in_box(view, x, y, (double)depth))
    return;
  *out = (fg__face_at){depth, p->number};
}

void fg__view_middles(const fg__view *view, int band, fg__face_at *out)
{
  int width = view->about->width, top = band * FG__BAND;
  for (int n = 0; n < FG__BAND * width; ++n)
    out[n] = (fg__face_at){INFINITY, -1};
  for (size_t m = view->solid.first[band]; m < view->solid.first[band + 1]; ++m) {
    piece p;
    double weight[3];
    if (!find_piece(view, false, view->solid.member[m], band, NULL, &p))
      continue;
    for (int y = p.rows.first; y <= p.rows.last; ++y)
      for (int x = p.columns.first; x <= p.columns.last; ++x)
        if (weigh(&p.edges, x + 0.5, y + 0.5, weight))
          keep_nearer(view, &p, x + 0.5, y + 0.5, weight[0] + weight[1] + weight[2],
                      &out[(ptrdiff_t)(y - top) * width + x]);
  }
}

/* Notes a triangle at the samples of a pixel. */
INLINE void keep_samples(const fg__view *view, const piece *p, int x, int y,
                         fg__face_at out[FG__SAMPLES])
{
  double weight[3][FG__SAMPLES];
  for (int k = 0; k < 3; ++k) {
    const double *value = p->edges.value[k];
    double middle = value[0] * (x + 0.5) + (value[1] * (y + 0.5) + value[2]);
    if (middle + 0.5 * (fabs(value[0]) + fabs(value[1])) < 0.0)
      return; /* all of the pixel lies outside */
    for (int s = 0; s < FG__SAMPLES; ++s)
      weight[k][s] = middle + (value[0] * (fg__sample_place[s][0] - 0.5) +
                               value[1] * (fg__sample_place[s][1] - 0.5));
  }
  double inner[FG__SAMPLES], innermost = -1.0; /* negative outside */
  for (int s = 0; s < FG__SAMPLES; ++s) {
    double least = weight[0][s] < weight[1][s] ? weight[0][s] : weight[1][s];
    inner[s] = least < weight[2][s] ? least : weight[2][s];
  }
  for (int s = 0; s < FG__SAMPLES; ++s)
    innermost = inner[s] > innermost ? inner[s] : innermost;
  for (int s = 0; s < FG__SAMPLES && innermost >= 0.0; ++s)
    if (inner[s] >= 0.0)
      keep_nearer(view, p, x + fg__sample_place[s][0], y + fg__sample_place[s][1],
                  weight[0][s] + weight[1][s] + weight[2][s], &out[s]);
}

FG__CLONES void fg__view_samples(const fg__view *view, int band, const int *chosen,
                                 int count, fg__face_at *out)
{
  int width = view->about->width, top = band * FG__BAND;
  for (ptrdiff_t n = 0; n < (ptrdiff_t)count * FG__SAMPLES; ++n)
    out[n] = (fg__face_at){INFINITY, -1};
  for (size_t m = view->solid.first[band]; m < view->solid.first[band + 1]; ++m) {
    piece p;
    if (!find_piece(view, false, view->solid.member[m], band, chosen, &p))
      continue;
    for (int y = p.rows.first; y <= p.rows.last; ++y)
      for (int x = p.columns.first; x <= p.columns.last; ++x) {
        int pixel = chosen[(ptrdiff_t)(y - top) * width + x];
        if (pixel >= 0)
          keep_samples(view, &p, x, y, &out[(ptrdiff_t)pixel * FG__SAMPLES]);
      }
  }
}

/* The mean of three corners' numbers by their weights. */
static void mean_normal(const fg__corner *const corner[3], const double weight[3],
                        double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = weight[0] * (double)corner[0]->normal[k] +
             weight[1] * (double)corner[1]->normal[k] +
             weight[2] * (double)corner[2]->normal[k];
  fg__normalise(out);
}

static void find_corners(const fg__faces *faces, int face, const fg__corner *out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = &faces->corner[faces->face[face].corner[k]];
}

/* The distance from the eye of a point at some depth. */
static double distance_of(const fg__camera *camera, double x, double y, double depth)
{
  double way[3];
  way_to(camera, x, y, depth, way);
  return fg__length(way);
}

static bool add_layer(const fg__view *view, const piece *p, double x, double y, int point,
                      fg__layers *out)
{
  const fg__faces *faces = &view->geometry->layer;
  const fg__corner *corner[3];
  double weight[3], normal[3];
  if (!weigh(&p->edges, x, y, weight))
    return true;
  if (!fg__grow((void **)&out->found, &out->found_capacity, out->count + 1,
                sizeof *out->found) ||
      !fg__grow((void **)&out->point, &out->point_capacity, out->count + 1,
                sizeof *out->point))
    return false;
  double depth = p->edges.volume / (weight[0] + weight[1] + weight[2]);
  find_corners(faces, p->number, corner);
  mean_normal(corner, weight, normal);
  out->found[out->count] =
      (fg__layer){.distance = (float)distance_of(&view->about->camera, x, y, depth),
                  .normal = {(float)normal[0], (float)normal[1], (float)normal[2]},
                  .silhouette = faces->face[p->number].kind == FG__FACE_SILHOUETTE};
  out->point[out->count++] = point;
  return true;
}

/* Leaves out what is met twice, at the edge between two triangles. Returns how many are
 * left. */
static int leave_out_twins(fg__layer *layer, int count)
{
  int kept = 0;
  for (int n = 0; n < count; ++n)
    if (kept == 0 || layer[n].silhouette != layer[kept - 1].silhouette ||
        layer[n].distance - layer[kept - 1].distance > same_distance)
      layer[kept++] = layer[n];
  return kept;
}

/* Puts a point's layers in order. */
static void sort_point(fg__layer *layer, int count)
{
  for (int n = 1; n < count; ++n) {
    const fg__layer one = layer[n];
    int at = n;
    for (; at > 0 && layer[at - 1].distance > one.distance; --at)
      layer[at] = layer[at - 1];
    layer[at] = one;
  }
}

/* Sorts what was found by points, and there by distance. */
static bool sort_layers(fg__layers *l, int points)
{
  size_t needed = (size_t)points + 2;
  if (!fg__grow((void **)&l->first, &l->first_capacity, needed, sizeof *l->first) ||
      !fg__grow((void **)&l->layer, &l->layer_capacity, l->count + 1, sizeof *l->layer))
    return false;
  memset(l->first, 0, needed * sizeof *l->first);
  for (size_t n = 0; n < l->count; ++n)
    ++l->first[l->point[n] + 2];
  for (int p = 0; p < points; ++p)
    l->first[p + 2] += l->first[p + 1];
  for (size_t n = 0; n < l->count;
       ++n) /* first[p + 1] goes from the start of p to its end */
    l->layer[l->first[l->point[n] + 1]++] = l->found[n];
  for (int p = 0, kept = 0; p < points; ++p) {
    int begin = l->first[p], end = l->first[p + 1];
    sort_point(l->layer + begin, end - begin);
    int count = leave_out_twins(l->layer + begin, end - begin);
    memmove(l->layer + kept, l->layer + begin, (size_t)count * sizeof *l->layer);
    l->first[p] = kept;
    kept += count;
    if (p + 1 == points)
      l->first[points] = kept;
  }
  return true;
}

bool fg__view_layers(const fg__view *view, int band, fg__layers *out)
{
  int width = view->about->width, top = band * FG__BAND;
  bool good = true;
  out->count = 0;
  for (size_t m = view->layer.first[band]; m < view->layer.first[band + 1]; ++m) {
    piece p;
    if (!find_piece(view, true, view->layer.member[m], band, NULL, &p))
      continue;
    for (int y = p.rows.first; y <= p.rows.last; ++y)
      for (int x = p.columns.first; x <= p.columns.last && good; ++x)
        good = add_layer(view, &p, x + 0.5, y + 0.5, (y - top) * width + x, out);
  }
  return good && sort_layers(out, FG__BAND * width);
}

bool fg__view_sample_layers(const fg__view *view, int band, const int *chosen, int count,
                            fg__layers *out)
{
  int width = view->about->width, top = band * FG__BAND;
  bool good = true;
  out->count = 0;
  for (size_t m = view->layer.first[band]; m < view->layer.first[band + 1]; ++m) {
    piece p;
    if (!find_piece(view, true, view->layer.member[m], band, chosen, &p))
      continue;
    for (int y = p.rows.first; y <= p.rows.last; ++y)
      for (int x = p.columns.first; x <= p.columns.last; ++x) {
        int pixel = chosen[(ptrdiff_t)(y - top) * width + x];
        for (int s = 0; pixel >= 0 && s < FG__SAMPLES && good; s += FG__SHARING)
          good =
              add_layer(view, &p, x + fg__sample_place[s][0], y + fg__sample_place[s][1],
                        FG__SHARES * pixel + s / FG__SHARING, out);
      }
  }
  return good && sort_layers(out, FG__SHARES * count);
}

void fg__layers_clear(fg__layers *layers)
{
  free(layers->found);
  free(layers->layer);
  free(layers->point);
  free(layers->first);
  *layers = (fg__layers){.found = NULL};
}

void fg__view_seen(const fg__view *view, int face, double x, double y, fg__seen *out)
{
  const fg__faces *faces = &view->geometry->solid;
  const fg__corner *corner[3];
  double weight[3] = {0.0};
  edges e = {.volume = 0.0};
  find_edges(faces, &faces->face[face], &e);
  weigh(&e, x, y, weight);
  double sum = weight[0] + weight[1] + weight[2];
  find_corners(faces, face, corner);
  mean_normal(corner, weight, out->normal);
  out->distance = distance_of(&view->about->camera, x, y, e.volume / sum);
  out->share = 0.0;
  for (int k = 0; k < 3; ++k) {
    out->share += weight[k] * (double)corner[k]->share / sum;
    if (e.faces_away) /* the inside of an arrow that the box cuts open */
      out->normal[k] = -out->normal[k];
  }
}
