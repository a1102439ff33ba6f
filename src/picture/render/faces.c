#include "picture/render/faces.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/vector.h"
#include "picture/arrow_speeds.h"
#include "solid/tube.h"

/* A head that is made larger to be seen takes no more of its arrow. */
static const double head_share = 0.42;

/* The radius of the dot on a head that points at the viewer, in the head's. */
static const double dot_share = 0.36;

/* Light comes from directions whose slope against the vertical is less: triangles that
 * face down more steeply never cast a shadow of their own. */
static const double steepest_light = 0.02;

/* Shadows are soft: for them points of a line are left out as long as the rest deviates
 * from them by less, and pieces are no longer, pixels. */
static const double most_deviation = 0.15, longest_piece = 12.0;

/* Copies of an arrow in each direction of a period. */
static const double most_copies = 3.0;

typedef struct maker {
  fg__geometry *out;
  fg_context *context;
  const fg__rendering *about;
} maker;

/* A surface on its way into the picture. */
typedef struct surface_use {
  const fg_surface *surface;
  const float *share;  /* of its vertices; NULL: 0 */
  const fg_icon *icon; /* whose solid it is; of arrows and their shadows */
  double shift[3];     /* in the view box */
  int part;
  bool clipped;
} surface_use;

static void place_of(const maker *m, const surface_use *use, int corner, double out[3])
{
  const double *vertex = use->surface->vertex[use->surface->corner[corner]];
  for (int k = 0; k < 3; ++k)
    out[k] = fg__view_box_place(&m->about->view_box, k, vertex[k]) + use->shift[k];
}

static void project(const fg__camera *camera, const double place[3], double out[3])
{
  double to[3];
  fg__subtract(place, camera->eye, to);
  out[2] = fg__dot(to, camera->forward);
  out[0] = camera->x * out[2] + camera->factor * fg__dot(to, camera->right);
  out[1] = camera->y * out[2] - camera->factor * fg__dot(to, camera->up);
}

/* Negative where a triangle faces the viewer. */
static double orientation(const fg__corner *a, const fg__corner *b, const fg__corner *c)
{
  double normal[3];
  fg__cross(b->at, c->at, normal);
  return fg__dot(a->at, normal);
}

/* What is not, as a part of a far arrow, lies beyond the box. */
static bool is_before_eye(const fg__corner *a, const fg__corner *b, const fg__corner *c)
{
  return a->at[2] > 0.0 && b->at[2] > 0.0 && c->at[2] > 0.0;
}

/* Of an arrow only the side towards the viewer is seen, unless the box cuts it open; of a
 * halo only the other one, which is behind its arrow. */
static bool is_seen(fg__face_kind kind, bool clipped, double orientation)
{
  if (kind == FG__FACE_ARROW && !clipped)
    return orientation < 0.0;
  if (kind == FG__FACE_HALO)
    return orientation > 0.0;
  return orientation < 0.0 || orientation > 0.0;
}

/* For each vertex the sum of its corners' normals: there is no gap at creases. */
static double (*mean_normals(const fg_surface *solid))[3]
{
  double(*out)[3] = fg__allocate((size_t)solid->vertex_count, sizeof *out);
  for (int n = 0; out && n < solid->corner_count; ++n)
    for (int k = 0; k < 3; ++k)
      out[solid->corner[n]][k] += (double)solid->normal[n][k];
  for (int n = 0; out && n < solid->vertex_count; ++n)
    fg__normalise(out[n]);
  return out;
}

static bool make_room(fg__faces *faces, const fg_surface *surface)
{
  size_t corners = faces->corner_count + (size_t)surface->corner_count;
  size_t count = faces->face_count + (size_t)surface->triangle_count;
  return corners <= INT_MAX && count <= INT_MAX &&
         fg__grow((void **)&faces->corner, &faces->corner_capacity, corners,
                  sizeof *faces->corner) &&
         fg__grow((void **)&faces->face, &faces->face_capacity, count,
                  sizeof *faces->face);
}

/* Writes a surface's corners, moved along `outwards` of their vertices by the halo's
 * width as it is seen there; NULL: not moved. */
static void add_corners(const maker *m, fg__faces *faces, const surface_use *use,
                        const double (*outwards)[3])
{
  const fg__camera *camera = &m->about->camera;
  const fg_surface *surface = use->surface;
  for (int n = 0; n < surface->corner_count; ++n) {
    fg__corner *corner = &faces->corner[faces->corner_count + (size_t)n];
    double place[3];
    place_of(m, use, n, place);
    project(camera, place, corner->at);
    if (outwards) {
      double width = m->about->halo * corner->at[2] / camera->factor;
      fg__add_scaled(place, width, outwards[surface->corner[n]], place);
      project(camera, place, corner->at);
    }
    for (int k = 0; k < 3; ++k)
      corner->normal[k] = surface->normal[n][k];
    corner->share = use->share ? use->share[surface->corner[n]] : 0.0F;
  }
}

static fg_status add_faces(const maker *m, fg__faces *faces, const surface_use *use,
                           fg__face_kind kind, const double (*outwards)[3])
{
  const fg_surface *surface = use->surface;
  if (!make_room(faces, surface))
    return fg__fail_memory(m->context, "a surface", (size_t)surface->triangle_count);
  add_corners(m, faces, use, outwards);
  const fg__corner *corner = faces->corner + faces->corner_count;
  for (int n = 0; n < surface->triangle_count; ++n) {
    const int *at = surface->triangle[n];
    const fg__corner *a = &corner[at[0]], *b = &corner[at[1]], *c = &corner[at[2]];
    if (!is_before_eye(a, b, c) || !is_seen(kind, use->clipped, orientation(a, b, c)))
      continue;
    fg__face *face = &faces->face[faces->face_count++];
    *face = (fg__face){.part = use->part, .kind = kind, .clipped = use->clipped};
    for (int k = 0; k < 3; ++k)
      face->corner[k] = (int)faces->corner_count + at[k];
  }
  faces->corner_count += (size_t)surface->corner_count;
  return FG_STATUS_OK;
}

static fg_status add_halo(const maker *m, const surface_use *use)
{
  double(*outwards)[3] = mean_normals(use->surface);
  if (!outwards)
    return fg__fail_memory(m->context, "a halo", (size_t)use->surface->vertex_count);
  fg_status status =
      add_faces(m, &m->out->solid, use, FG__FACE_HALO, (const double(*)[3])outwards);
  free(outwards);
  return status;
}

static bool casts_shadows(const fg__caster *caster)
{
  double one[3], other[3], normal[3];
  fg__subtract(caster->at[1], caster->at[0], one);
  fg__subtract(caster->at[2], caster->at[0], other);
  fg__cross(one, other, normal);
  return caster->clipped || normal[2] > -steepest_light * fg__length(normal);
}

static fg_status add_casters(const maker *m, const surface_use *use)
{
  fg__geometry *out = m->out;
  const fg_surface *surface = use->surface;
  size_t needed = out->caster_count + (size_t)surface->triangle_count;
  if (needed > INT_MAX || !fg__grow((void **)&out->caster, &out->caster_capacity, needed,
                                    sizeof *out->caster))
    return fg__fail_memory(m->context, "shadows", needed * sizeof *out->caster);
  for (int n = 0; n < surface->triangle_count; ++n) {
    fg__caster *caster = &out->caster[out->caster_count];
    for (int k = 0; k < 3; ++k)
      place_of(m, use, surface->triangle[n][k], caster->at[k]);
    caster->clipped = use->clipped;
    out->caster_count += casts_shadows(caster);
  }
  return FG_STATUS_OK;
}

/* Whether an icon's line lies in the box along an axis. */
static bool is_within(const fg__view_box *view_box, const fg_icon *icon, int axis)
{
  for (int n = 0; n < icon->point_count; ++n)
    if (fabs(fg__view_box_place(view_box, axis, icon->points[n][axis])) >
        view_box->half[axis])
      return false;
  return true;
}

/* How far along an axis copies of a solid reach into the box: from -low to high periods.
 * One whose line lies in the box is whole: of its radius alone a copy would show a chip.
 */
static void find_copies(const maker *m, const surface_use *use, int axis, int copies[2])
{
  const fg__view_box *view_box = &m->about->view_box;
  const fg_surface *solid = use->surface;
  double low = HUGE_VAL, high = -HUGE_VAL;
  copies[0] = copies[1] = 0;
  if (!(view_box->period[axis] > 0.0) || is_within(view_box, use->icon, axis))
    return;
  for (int n = 0; n < solid->vertex_count; ++n) {
    double at = fg__view_box_place(view_box, axis, solid->vertex[n][axis]);
    low = fmin(low, at);
    high = fmax(high, at);
  }
  if (solid->vertex_count == 0)
    return;
  copies[0] = (int)fmax(ceil((-view_box->half[axis] - high) / view_box->period[axis]),
                        -most_copies);
  copies[1] = (int)fmin(floor((view_box->half[axis] - low) / view_box->period[axis]),
                        most_copies);
}

/* Where a head begins on its line, in points. */
static int head_base(const fg_icon *icon)
{
  double passed = 0.0;
  int base = icon->point_count - 1;
  for (; base > 0 && passed < icon->head_length; --base)
    passed += fg__distance(icon->points[base], icon->points[base - 1]);
  return base;
}

/* The dot on a head whose tip is seen within the outline of its base: nothing else tells
 * that it points at the viewer. It ends before that outline. */
static fg__tip find_tip(const maker *m, const surface_use *use)
{
  const fg_icon *icon = use->icon;
  const double *tip = icon->points[icon->point_count - 1];
  const double radius = icon->head_width / 2.0;
  double axis[3], to_viewer[3];
  fg__tip out = {.reach = 0.0};
  for (int k = 0; k < 3; ++k)
    out.at[k] = fg__view_box_place(&m->about->view_box, k, tip[k]) + use->shift[k];
  fg__subtract(tip, icon->points[head_base(icon)], axis);
  fg__subtract(m->about->camera.eye, out.at, to_viewer);
  fg__normalise(axis);
  fg__normalise(to_viewer);
  const double along = fg__dot(axis, to_viewer);
  const double across = sqrt(fmax(1.0 - along * along, 0.0));
  if (!(along > 0.0) || !(radius > 0.0))
    return out;
  const double side = hypot(icon->head_length, radius);
  const double room = 1.0 - icon->head_length * across / (radius * along);
  out.reach = fmin(fmax(room, 0.0), dot_share) * side * m->about->view_box.scale;
  out.slope = radius / side;
  return out;
}

static fg_status add_arrow(const maker *m, const surface_use *use)
{
  if (!fg__grow((void **)&m->out->tip, &m->out->tip_capacity, (size_t)use->part + 1,
                sizeof *m->out->tip))
    return fg__fail_memory(m->context, "arrows", (size_t)use->part * sizeof *m->out->tip);
  m->out->tip[use->part] = find_tip(m, use);
  fg_status status = add_faces(m, &m->out->solid, use, FG__FACE_ARROW, NULL);
  if (!status && m->about->halo > 0.0)
    status = add_halo(m, use);
  return status ? status : fg__check_stop(m->context);
}

/* Arrows and halos of a solid, everywhere in the box; *number goes on. Where `number` is
 * NULL its shadows instead. */
static fg_status add_copies(const maker *m, const fg_icon *icon, const fg_surface *solid,
                            const float *share, int *number)
{
  fg_status status = FG_STATUS_OK;
  surface_use use = {.icon = icon, .surface = solid, .share = share};
  int copies[3][2], at[3];
  for (int k = 0; k < 3; ++k) {
    find_copies(m, &use, k, copies[k]);
    use.clipped = use.clipped || copies[k][0] < 0 || copies[k][1] > 0;
  }
  for (at[2] = copies[2][0]; at[2] <= copies[2][1]; ++at[2])
    for (at[1] = copies[1][0]; at[1] <= copies[1][1]; ++at[1])
      for (at[0] = copies[0][0]; at[0] <= copies[0][1] && !status; ++at[0]) {
        for (int k = 0; k < 3; ++k)
          use.shift[k] = at[k] * m->about->view_box.period[k];
        if (number)
          use.part = (*number)++;
        status = number ? add_arrow(m, &use) : add_casters(m, &use);
      }
  return status;
}

/* Thickens an arrow whose head would be too small to tell where it points. */
static fg_icon legible(const fg__rendering *about, const fg_icon *icon)
{
  const fg__camera *camera = &about->camera;
  fg_icon out = *icon;
  double length = 0.0, pixel = fg__length(camera->eye) / camera->factor;
  for (int n = 0; n + 1 < icon->point_count; ++n)
    length += fg__distance(icon->points[n], icon->points[n + 1]);
  double least =
      fmin(about->least_head * pixel / about->view_box.scale, head_share * length);
  double factor = icon->head_length > 0.0 ? fmax(least / icon->head_length, 1.0) : 1.0;
  out.width *= factor;
  out.tail_width *= factor;
  out.head_length *= factor;
  out.head_width *= factor;
  return out;
}

/* Whether the points between two of a line lie near the straight piece between these. */
static bool is_straight(const fg_icon *icon, int from, int to, double pixel)
{
  double along[3];
  fg__subtract(icon->points[to], icon->points[from], along);
  double length = fg__length(along);
  if (!(length > 0.0) || length > longest_piece * pixel)
    return false;
  for (int n = from + 1; n < to; ++n) {
    double way[3], across[3];
    fg__subtract(icon->points[n], icon->points[from], way);
    fg__add_scaled(way, -fg__dot(way, along) / (length * length), along, across);
    if (!(fg__length(across) < most_deviation * pixel))
      return false;
  }
  return true;
}

/* Copies the points of a line that shadows need. Returns how many. */
static int thin_line(const fg_icon *icon, double pixel, double (*points)[3])
{
  int kept = 0, last = icon->point_count - 1;
  for (int from = 0, to; from <= last; from = to) {
    for (int k = 0; k < 3; ++k)
      points[kept][k] = icon->points[from][k];
    ++kept;
    for (to = from + 1; to < last && is_straight(icon, from, to + 1, pixel); ++to)
      continue;
  }
  return kept;
}

/* What casts an arrow's shadows. */
static fg_status add_shadow(const maker *m, const fg_icon *icon)
{
  const fg__camera *camera = &m->about->camera;
  double(*points)[3] = fg__allocate((size_t)icon->point_count, sizeof *points);
  if (!points)
    return fg__fail_memory(m->context, "a shadow", (size_t)icon->point_count);
  double pixel = fg__length(camera->eye) / camera->factor / m->about->view_box.scale;
  fg_icon thin = *icon;
  thin.point_count = thin_line(icon, pixel, points);
  thin.points = (const double(*)[3])points;
  fg_surface *solid = NULL;
  fg_status status = fg_icon_solid(&solid, m->context, &thin);
  if (!status)
    status = add_copies(m, icon, solid, NULL, NULL);
  free(points);
  fg_surface_destroy(solid);
  return status;
}

static fg_status add_icon(const maker *m, const fg_icon *given, int *number)
{
  fg_icon icon = legible(m->about, given);
  const double *range = m->about->range;
  fg_surface *solid = NULL;
  float *at_vertex = NULL;
  double *share;
  fg_status status = fg__arrow_speeds(&share, m->context, m->about->field, &icon);
  if (status)
    return status;
  for (int n = 0; n < icon.point_count; ++n)
    share[n] = fmin(fmax((share[n] - range[0]) / (range[1] - range[0]), 0.0), 1.0);
  status = fg__solid_with_values(&solid, &at_vertex, m->context, &icon, share);
  if (!status)
    status = add_copies(m, &icon, solid, at_vertex, number);
  if (!status && m->about->walls && solid->triangle_count > 0)
    status = add_shadow(m, &icon);
  free(at_vertex);
  free(share);
  fg_surface_destroy(solid);
  return status;
}

static fg_status add_veil(const maker *m, const fg_surface *surface, fg__face_kind kind)
{
  const surface_use use = {.surface = surface};
  if (!surface || surface->triangle_count == 0)
    return FG_STATUS_OK;
  return add_faces(m, &m->out->layer, &use, kind, NULL);
}

fg_status fg__geometry_make(fg__geometry *out, fg_context *context,
                            const fg__rendering *about)
{
  const maker m = {.out = out, .context = context, .about = about};
  fg_status status = FG_STATUS_OK;
  int number = 0;
  *out = (fg__geometry){.caster = NULL};
  for (int n = 0; n < fg_icons_count(about->icons) && !status; ++n)
    status = add_icon(&m, fg_icons_at(about->icons, n), &number);
  if (!status)
    status = add_veil(&m, about->surface, FG__FACE_CLUSTERS);
  if (!status)
    status = add_veil(&m, about->silhouette, FG__FACE_SILHOUETTE);
  return status;
}

void fg__geometry_clear(fg__geometry *geometry)
{
  free(geometry->solid.corner);
  free(geometry->solid.face);
  free(geometry->layer.corner);
  free(geometry->layer.face);
  free(geometry->tip);
  free(geometry->caster);
  *geometry = (fg__geometry){.caster = NULL};
}
