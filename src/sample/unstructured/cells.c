/* Cells between the vectors of a mesh. Those of faces lie between the centres of the
 * faces round each node: the dual mesh, on which what is linear is interpolated exactly
 * (docs/design/unstructured.md). */
#include "base/angle.h"
#include "base/memory.h"
#include "base/vector.h"
#include "sample/unstructured/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct mesh_work {
  fg_context *context;
  const fg__mesh_topology *faces;
  bool on_sphere;
  double *node, *centre; /* [3 * ...] in space; in a plane z is 0 */
  int *start;            /* [nodes + 1]: */
  int *corner;           /* places in faces->node that are the node, and */
  int *face;             /* the faces that these are corners of */
  int *point_of;         /* [nodes]: the point at a node of the rim, or -1 */
  fg__sphere_cells *out;
  size_t capacity;
  bool exhausted;
} mesh_work;

/* A face at a node: the nodes before and after that one round it, and the direction from
 * the node into it. */
typedef struct spoke {
  int face, before, after;
  double angle;
} spoke;

static void place_in_space(double out[3], double x, double y, bool on_sphere)
{
  if (on_sphere)
    fg__sphere_unit_vector(out, x, y);
  else
    memcpy(out, (const double[3]){x, y, 0.0}, 3 * sizeof *out);
}

/* Unit vectors east and north there; in a plane x and y. */
static void frame_at(double east[3], double north[3], const double at[3], bool on_sphere)
{
  const double across = hypot(at[0], at[1]);
  const bool turned = on_sphere && across > 0.0;
  const double c = turned ? at[0] / across : 1.0, s = turned ? at[1] / across : 0.0;
  const double up = on_sphere ? at[2] : 0.0;
  east[0] = -s;
  east[1] = c;
  east[2] = 0.0;
  north[0] = -up * c;
  north[1] = -up * s;
  north[2] = across;
  if (!on_sphere) {
    memcpy(east, (const double[3]){1.0, 0.0, 0.0}, 3 * sizeof *east);
    memcpy(north, (const double[3]){0.0, 1.0, 0.0}, 3 * sizeof *north);
  }
}

static bool is_there(double x, double y, bool on_sphere)
{
  return isfinite(x) && isfinite(y) && (!on_sphere || fabs(y) <= 90.0 + 1e-6);
}

static void add_cell(mesh_work *w, int a, int b, int c, int d)
{
  void *all = w->out->corner;
  /* four numbers a cell */
  if (!fg__grow(&all, &w->capacity, w->out->count + 1, 4 * sizeof *w->out->corner)) {
    w->exhausted = true;
    return;
  }
  w->out->corner = all;
  int *corner = w->out->corner + 4 * w->out->count++;
  corner[0] = a;
  corner[1] = b;
  corner[2] = c;
  corner[3] = d;
}

/* Triangles and quads as they are, polygons as triangles that meet in the first corner.
 */
static void add_polygon(mesh_work *w, const int *corner, int count)
{
  if (count == 4) {
    add_cell(w, corner[0], corner[1], corner[2], corner[3]);
    return;
  }
  for (int k = 1; k + 1 < count; ++k)
    add_cell(w, corner[0], corner[k], corner[k + 1], -1);
}

void fg__fill_poles(const fg__mesh_topology *faces, size_t poles,
                    float *const velocity[2])
{
  const size_t first = faces->nodes - poles;
  double sum[3] = {0.0};
  size_t count = 0, before = 0;
  for (size_t f = 0; f < faces->count && poles > 0; ++f) {
    const int *corner = faces->node + faces->first[f];
    const int last = faces->first[f + 1] - faces->first[f] - 1;
    if (last < 2 || (size_t)corner[last] < first)
      continue;
    const size_t pole = (size_t)corner[last], from = (size_t)corner[0];
    if (pole != before) {
      memset(sum, 0, sizeof sum);
      count = 0;
    }
    before = pole;
    const double east = (double)velocity[0][from], north = (double)velocity[1][from];
    fg__sphere_frame at = fg__sphere_frame_at(faces->at[0][from], faces->at[1][from]);
    for (int k = 0; k < 3 && isfinite(east) && isfinite(north); ++k)
      sum[k] += east * at.east[k] + north * at.north[k];
    count += isfinite(east) && isfinite(north);
    at = fg__sphere_frame_at(faces->at[0][pole], faces->at[1][pole]);
    velocity[0][pole] = count > 0 ? (float)(fg__dot(sum, at.east) / (double)count) : NAN;
    velocity[1][pole] = count > 0 ? (float)(fg__dot(sum, at.north) / (double)count) : NAN;
  }
}

fg_status fg__cells_of_nodes(fg__sphere_cells *out, fg_context *context,
                             fg__mesh_topology *faces, float *velocity[2])
{
  mesh_work w = {.context = context, .faces = faces, .out = out};
  *out = (fg__sphere_cells){.points = faces->nodes,
                            .longitude = faces->at[0],
                            .latitude = faces->at[1],
                            .east = velocity[0],
                            .north = velocity[1]};
  for (int k = 0; k < 2; ++k) {
    faces->at[k] = NULL;
    velocity[k] = NULL;
  }
  for (size_t f = 0; f < faces->count && !w.exhausted; ++f) {
    const int *corner = faces->node + faces->first[f];
    const int count = faces->first[f + 1] - faces->first[f];
    bool whole = count >= 3;
    for (int k = 0; k < count && whole; ++k)
      whole = isfinite(out->east[corner[k]]) && isfinite(out->north[corner[k]]);
    if (whole)
      add_polygon(&w, corner, count);
  }
  return w.exhausted ? fg__fail_memory(context, "cells", 0) : FG_STATUS_OK;
}

/* The middle of a face's corners, where its centre is not known. */
static void find_middle(double out[3], const mesh_work *w, size_t f)
{
  const fg__mesh_topology *faces = w->faces;
  const int count = faces->first[f + 1] - faces->first[f];
  out[0] = out[1] = out[2] = 0.0;
  for (int k = faces->first[f]; k < faces->first[f + 1]; ++k)
    for (int c = 0; c < 3; ++c)
      out[c] += w->node[3 * (size_t)faces->node[k] + (size_t)c] / count;
  const double length = w->on_sphere ? fg__length(out) : 1.0;
  for (int c = 0; c < 3; ++c)
    out[c] /= length;
}

static void place_centre(mesh_work *w, size_t f)
{
  const fg__mesh_topology *faces = w->faces;
  double *centre = w->centre + 3 * f, *x = &w->out->longitude[f],
         *y = &w->out->latitude[f];
  if (faces->centre[0] &&
      is_there(faces->centre[0][f], faces->centre[1][f], w->on_sphere)) {
    *x = faces->centre[0][f];
    *y = faces->centre[1][f];
    place_in_space(centre, *x, *y, w->on_sphere);
    return;
  }
  find_middle(centre, w, f);
  *x = w->on_sphere ? atan2(centre[1], centre[0]) / FG__RADIANS : centre[0];
  *y = w->on_sphere ? atan2(centre[2], hypot(centre[0], centre[1])) / FG__RADIANS
                    : centre[1];
}

/* Faces that count have a value and three corners or more whose places are known. */
static bool counts(const mesh_work *w, size_t f)
{
  const fg__mesh_topology *faces = w->faces;
  bool out = faces->first[f + 1] - faces->first[f] >= 3 && isfinite(w->out->east[f]) &&
             isfinite(w->out->north[f]) && isfinite(w->centre[3 * f]);
  for (int k = faces->first[f]; k < faces->first[f + 1] && out; ++k)
    out = isfinite(w->node[3 * (size_t)faces->node[k]]);
  return out;
}

/* The faces round each node. */
static void sort_corners(mesh_work *w)
{
  const fg__mesh_topology *faces = w->faces;
  for (int pass = 0; pass < 2; ++pass) {
    for (size_t f = 0; f < faces->count; ++f) {
      if (!counts(w, f))
        continue;
      for (int k = faces->first[f]; k < faces->first[f + 1]; ++k) {
        int *start = &w->start[faces->node[k]];
        if (pass == 0) {
          ++*start;
          continue;
        }
        --*start;
        w->corner[*start] = k;
        w->face[*start] = (int)f;
      }
    }
    for (size_t n = 0; n < faces->nodes && pass == 0; ++n)
      w->start[n + 1] +=
          w->start[n]; /* the ends, from which the second pass counts down */
  }
}

static int by_angle(const void *a, const void *b)
{
  const spoke *p = a, *q = b;
  return (p->angle > q->angle) - (p->angle < q->angle);
}

static double angle_of(const mesh_work *w, const spoke *s, int node, const double east[3],
                       const double north[3])
{
  const double *at = w->node + 3 * (size_t)node;
  const int side[2] = {s->before, s->after};
  double x = 0.0, y = 0.0;
  for (int k = 0; k < 2; ++k) {
    const double *other = w->node + 3 * (size_t)side[k];
    const double way[3] = {other[0] - at[0], other[1] - at[1], other[2] - at[2]};
    const double length = fg__length(way);
    x += fg__dot(way, east) / length;
    y += fg__dot(way, north) / length;
  }
  return atan2(y, x);
}

/* The faces round a node in the order of their directions. */
static int find_spokes(spoke *out, const mesh_work *w, int node, const double east[3],
                       const double north[3])
{
  const int first = w->start[node], count = w->start[node + 1] - first;
  for (int i = 0; i < count; ++i) {
    const int f = w->face[first + i], k = w->corner[first + i];
    const int begin = w->faces->first[f], end = w->faces->first[f + 1];
    out[i] = (spoke){.face = f,
                     .before = w->faces->node[k > begin ? k - 1 : end - 1],
                     .after = w->faces->node[k + 1 < end ? k + 1 : begin]};
    out[i].angle = angle_of(w, &out[i], node, east, north);
  }
  qsort(out, (size_t)count, sizeof *out, by_angle);
  return count;
}

static bool has_side(const spoke *s, int node)
{
  return s->before == node || s->after == node;
}

static bool is_beside(const spoke *a, const spoke *b)
{
  return has_side(b, a->before) || has_side(b, a->after);
}

/* Whether faces go all round a node. */
static bool is_closed(const spoke *s, int count)
{
  if (count < 3)
    return count == 2 && has_side(&s[1], s[0].before) && has_side(&s[1], s[0].after);
  for (int i = 0; i < count; ++i)
    if (!is_beside(&s[i], &s[(i + 1) % count]))
      return false;
  return true;
}

/* Whether the centres round a node are a convex polygon, seen from above. */
static bool is_convex(const mesh_work *w, const spoke *s, int count, int node,
                      const double east[3], const double north[3])
{
  const double *at = w->node + 3 * (size_t)node;
  for (int i = 0; i < count; ++i) {
    double x[3], y[3];
    for (int k = 0; k < 3; ++k) {
      const double *c = w->centre + 3 * (size_t)s[(i + k) % count].face;
      const double way[3] = {c[0] - at[0], c[1] - at[1], c[2] - at[2]};
      x[k] = fg__dot(way, east);
      y[k] = fg__dot(way, north);
    }
    if (!((x[1] - x[0]) * (y[2] - y[1]) - (y[1] - y[0]) * (x[2] - x[1]) > 0.0))
      return false;
  }
  return true;
}

/* The point at a node: the mean of the faces round it. */
static int point_at(mesh_work *w, int node)
{
  if (w->point_of[node] >= 0)
    return w->point_of[node];
  fg__sphere_cells *out = w->out;
  const size_t point = out->points++;
  const int first = w->start[node], count = w->start[node + 1] - first;
  double sum[3] = {0.0, 0.0, 0.0}, east[3], north[3];
  for (int i = first; i < first + count; ++i) {
    const size_t f = (size_t)w->face[i];
    frame_at(east, north, w->centre + 3 * f, w->on_sphere);
    for (int c = 0; c < 3; ++c)
      sum[c] +=
          ((double)out->east[f] * east[c] + (double)out->north[f] * north[c]) / count;
  }
  const double *at = w->node + 3 * (size_t)node;
  frame_at(east, north, at, w->on_sphere);
  out->longitude[point] = w->faces->at[0][node];
  out->latitude[point] = w->faces->at[1][node];
  out->east[point] = (float)fg__dot(sum, east);
  out->north[point] = (float)fg__dot(sum, north);
  return w->point_of[node] = (int)point;
}

/* Between the node and each two faces that meet there, and each side that no second face
 * has. */
static void add_rim(mesh_work *w, const spoke *s, int count, int node)
{
  const int point = point_at(w, node);
  for (int i = 0; i < count; ++i) {
    const spoke *next = &s[(i + 1) % count], *last = &s[(i + count - 1) % count];
    if (count > 1 && (count > 2 || i == 0) && is_beside(&s[i], next))
      add_cell(w, point, s[i].face, next->face, -1);
    if (count == 1 || (!has_side(next, s[i].after) && !has_side(last, s[i].after)))
      add_cell(w, point, point_at(w, s[i].after), s[i].face, -1);
  }
}

/* Four triangles round a node are of a mesh that varies, whose raster is finer where all
 * cells are triangles. */
static bool is_quad(const fg__mesh_topology *faces, int f)
{
  return faces->first[f + 1] - faces->first[f] == 4;
}

static void add_round(mesh_work *w, spoke *s, int node)
{
  double east[3], north[3];
  frame_at(east, north, w->node + 3 * (size_t)node, w->on_sphere);
  const int count = find_spokes(s, w, node, east, north);
  if (!is_closed(s, count) || (count > 2 && !is_convex(w, s, count, node, east, north))) {
    add_rim(w, s, count, node);
    return;
  }
  if (count == 4 && is_quad(w->faces, s[0].face)) {
    add_cell(w, s[0].face, s[1].face, s[2].face, s[3].face);
    return;
  }
  for (int i = 1; i + 1 < count; ++i)
    add_cell(w, s[0].face, s[i].face, s[i + 1].face, -1);
}

static fg_status add_cells(mesh_work *w)
{
  int most = 0;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < w->faces->nodes; ++n)
    most = w->start[n + 1] - w->start[n] > most ? w->start[n + 1] - w->start[n] : most;
  spoke *s = fg__allocate((size_t)most + 1, sizeof *s);
  w->exhausted = !s;
  for (size_t n = 0; n < w->faces->nodes && !w->exhausted && status == FG_STATUS_OK;
       ++n) {
    if (w->start[n + 1] > w->start[n])
      add_round(w, s, (int)n);
    if (n % 65536 == 0)
      status = fg__check_stop(w->context);
  }
  free(s);
  return w->exhausted ? fg__fail_memory(w->context, "cells", 0) : status;
}

/* Room for the points: the faces, and the nodes that may be at a rim. */
static fg_status allocate(mesh_work *w, float *velocity[2])
{
  const fg__mesh_topology *faces = w->faces;
  const size_t most = faces->count + faces->nodes;
  const size_t corners = (size_t)faces->first[faces->count];
  w->node = fg__allocate(faces->nodes, 3 * sizeof *w->node);
  w->centre = fg__allocate(faces->count, 3 * sizeof *w->centre);
  w->start = fg__allocate(faces->nodes + 1, sizeof *w->start);
  w->corner = fg__allocate(corners + 1, sizeof *w->corner);
  w->face = fg__allocate(corners + 1, sizeof *w->face);
  w->point_of = fg__allocate(faces->nodes, sizeof *w->point_of);
  *w->out = (fg__sphere_cells){.points = faces->count,
                               .longitude = fg__allocate(most, sizeof(double)),
                               .latitude = fg__allocate(most, sizeof(double)),
                               .east = fg__allocate(most, sizeof(float)),
                               .north = fg__allocate(most, sizeof(float))};
  if (!w->node || !w->centre || !w->start || !w->corner || !w->face || !w->point_of ||
      !w->out->longitude || !w->out->latitude || !w->out->east || !w->out->north)
    return fg__fail_memory(w->context, "a mesh", most * 100);
  memcpy(w->out->east, velocity[0], faces->count * sizeof(float));
  memcpy(w->out->north, velocity[1], faces->count * sizeof(float));
  return FG_STATUS_OK;
}

fg_status fg__cells_of_faces(fg__sphere_cells *out, fg_context *context,
                             fg__mesh_topology *faces, float *velocity[2], bool on_sphere)
{
  mesh_work w = {.context = context, .faces = faces, .on_sphere = on_sphere, .out = out};
  fg_status status = allocate(&w, velocity);
  if (status == FG_STATUS_OK) {
    for (size_t n = 0; n < faces->nodes; ++n) {
      const double x = faces->at[0][n], y = faces->at[1][n];
      place_in_space(w.node + 3 * n, is_there(x, y, on_sphere) ? x : (double)NAN, y,
                     on_sphere);
      w.point_of[n] = -1;
    }
    for (size_t f = 0; f < faces->count; ++f)
      place_centre(&w, f);
    sort_corners(&w);
    status = add_cells(&w);
  }
  free(w.node);
  free(w.centre);
  free(w.start);
  free(w.corner);
  free(w.face);
  free(w.point_of);
  return status;
}
