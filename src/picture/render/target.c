#include "picture/render/target.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/vector.h"
#include "picture/arrow_speeds.h"
#include "solid/tube.h"

/* Numbers of a vertex besides its place: the normal, and the share of the colours. */
enum { NORMAL, SHARE, ATTRIBUTES };

/* Of geometries in `seen`: arrows have even numbers, the halo round one the next. */
enum { ARROW, HALO, KINDS };

/* Of geometries in `skins`. */
enum { CLUSTERS, SILHOUETTE };

/* As Embree lays out rays that it treats together: N origins' x, ... and what they met.
 */
enum { ORIGIN = 0, DIRECTION = 4, FAR = 8 };
enum { FACE = 0, U = 3, V = 4, TRIANGLE = 5, GEOMETRY = 6 };

/* A head that is made larger to be seen takes no more of its arrow. */
static const double head_share = 0.42;

/* Two surfaces nearer than this, in longest sides of the box, are one met at its edge. */
static const double same_distance = 1e-6;

/* Hits beyond the box do not count: parts of arrows that go on across a period. */
static void only_inside(const struct RTCFilterFunctionNArguments *given)
{
  const float *bound = given->geometryUserPtr;
  const float *ray = (const float *)(const void *)given->ray;
  for (unsigned n = 0; n < given->N; ++n)
    for (unsigned k = 0; k < 3; ++k)
      if (fabsf(ray[(ORIGIN + k) * given->N + n] +
                ray[FAR * given->N + n] * ray[(DIRECTION + k) * given->N + n]) > bound[k])
        given->valid[n] = 0;
}

/* Of a halo only the side that faces away counts: it is behind its arrow and hides what
 * is farther off. */
static void only_back(const struct RTCFilterFunctionNArguments *given)
{
  const float *hit = (const float *)(const void *)given->hit;
  const float *ray = (const float *)(const void *)given->ray;
  for (unsigned n = 0; n < given->N; ++n) {
    float facing = 0.0F;
    for (unsigned k = 0; k < 3; ++k)
      facing += hit[(FACE + k) * given->N + n] * ray[(DIRECTION + k) * given->N + n];
    if (!(facing > 0.0F))
      given->valid[n] = 0;
  }
}

static void only_back_inside(const struct RTCFilterFunctionNArguments *given)
{
  only_back(given);
  only_inside(given);
}

static fg_status fail(const fg__target *t, const char *what)
{
  int error = (int)rtcGetDeviceError(t->device);
  const char *reason = error == (int)RTC_ERROR_OUT_OF_MEMORY ? "out of memory: " : "";
  return fg__fail(t->context, FG_STATUS_MEMORY, "%spicture: Embree: %s (error %d)",
                  reason, what, error);
}

/* Triangles as Embree has them, written by whoever asked for them. */
typedef struct mesh {
  RTCGeometry geometry;
  float *place, *normal, *share; /* of each corner of the surface */
} mesh;

static fg_status create_mesh(mesh *out, const fg__target *t, const fg_surface *surface)
{
  out->geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  size_t corners = (size_t)surface->corner_count;
  size_t faces = (size_t)surface->triangle_count;
  RTCGeometry g = out->geometry;
  rtcSetGeometryVertexAttributeCount(g, ATTRIBUTES);
  out->place = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                       3 * sizeof(float), corners);
  out->normal = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, NORMAL,
                                        RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners);
  out->share = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, SHARE,
                                       RTC_FORMAT_FLOAT, sizeof(float), corners);
  unsigned *index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof *index, faces);
  if (!out->place || !out->normal || !out->share || !index) {
    rtcReleaseGeometry(g);
    return fail(t, "no memory for a surface");
  }
  for (size_t n = 0; n < 3 * faces; ++n)
    index[n] = (unsigned)surface->triangle[n / 3][n % 3];
  return FG_STATUS_OK;
}

/* Writes a corner's place and normal, moved by `shift` on the stage. */
static void write_corner(const mesh *m, const fg__target *t, const fg_surface *surface,
                         int corner, const double shift[3])
{
  const double *vertex = surface->vertex[surface->corner[corner]];
  for (int k = 0; k < 3; ++k) {
    m->place[3 * corner + k] =
        (float)(fg__stage_place(&t->about->stage, k, vertex[k]) + shift[k]);
    m->normal[3 * corner + k] = surface->normal[corner][k];
  }
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

/* Moves the corners of an arrow outwards by the halo's width as it is seen there. */
static fg_status inflate(const mesh *m, const fg__target *t, const fg_surface *solid)
{
  const fg__camera *camera = &t->about->camera;
  double(*normal)[3] = mean_normals(solid);
  if (!normal)
    return fg__fail_memory(t->context, "a halo", (size_t)solid->vertex_count);
  for (int n = 0; n < solid->corner_count; ++n) {
    const double *out = normal[solid->corner[n]];
    float *place = m->place + 3 * (ptrdiff_t)n;
    double to[3];
    for (int k = 0; k < 3; ++k)
      to[k] = (double)place[k] - camera->eye[k];
    double pixel = fg__dot(to, camera->forward) / camera->factor;
    for (int k = 0; k < 3; ++k)
      place[k] += (float)(t->about->halo * pixel * out[k]);
  }
  free(normal);
  return FG_STATUS_OK;
}

/* One of an icon's two geometries. */
static fg_status add_part(fg__target *t, const fg_surface *solid, const float *share,
                          int number, int kind, const double shift[3], bool clipped)
{
  mesh m;
  fg_status status = create_mesh(&m, t, solid);
  if (status)
    return status;
  for (int n = 0; n < solid->corner_count; ++n) {
    write_corner(&m, t, solid, n, shift);
    m.share[n] = share[solid->corner[n]];
  }
  if (kind == HALO)
    status = inflate(&m, t, solid);
  if (clipped) {
    rtcSetGeometryUserData(m.geometry, t->bound);
    rtcSetGeometryOccludedFilterFunction(m.geometry, only_inside);
  }
  if (clipped || kind == HALO)
    rtcSetGeometryIntersectFilterFunction(m.geometry, kind != HALO ? only_inside
                                                      : clipped    ? only_back_inside
                                                                   : only_back);
  rtcCommitGeometry(m.geometry);
  rtcAttachGeometryByID(t->seen, m.geometry, (unsigned)(KINDS * number + kind));
  if (kind == ARROW)
    rtcAttachGeometryByID(t->solids, m.geometry, (unsigned)number);
  rtcReleaseGeometry(m.geometry);
  return status;
}

static void unit(const float given[3], double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = (double)given[k];
  fg__normalise(out);
}

/* What a ray through transparent surfaces has met, the nearest first. */
typedef struct passage {
  struct RTCIntersectContext context; /* first: Embree knows only this */
  const fg__target *target;
  fg__veil *veil;
  int count;
} passage;

/* Notes a surface and goes on, as if it had not been met; of one ray alone. */
static void note(const struct RTCFilterFunctionNArguments *given)
{
  passage *p = (passage *)(void *)given->context;
  const float *hit = (const float *)(const void *)given->hit;
  const unsigned *number = (const unsigned *)(const void *)given->hit;
  given->valid[0] = 0;
  if (p->count == FG__MOST_VEILS)
    return;
  double distance = (double)((const float *)(const void *)given->ray)[FAR];
  int at = p->count++;
  for (; at > 0 && p->veil[at - 1].distance > distance; --at)
    p->veil[at] = p->veil[at - 1];
  fg__veil *veil = &p->veil[at];
  float normal[3];
  rtcInterpolate0(rtcGetGeometry(p->target->skins, number[GEOMETRY]), number[TRIANGLE],
                  hit[U], hit[V], RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, NORMAL, normal, 3);
  unit(normal, veil->normal);
  veil->distance = distance;
  veil->silhouette = number[GEOMETRY] == SILHOUETTE;
}

static fg_status add_skin(fg__target *t, const fg_surface *surface, unsigned kind)
{
  static const double stays[3] = {0.0, 0.0, 0.0};
  if (!surface || surface->triangle_count == 0)
    return FG_STATUS_OK;
  mesh m;
  fg_status status = create_mesh(&m, t, surface);
  if (status)
    return status;
  for (int n = 0; n < surface->corner_count; ++n) {
    write_corner(&m, t, surface, n, stays);
    m.share[n] = 0.0F;
  }
  rtcSetGeometryIntersectFilterFunction(m.geometry, note);
  rtcCommitGeometry(m.geometry);
  rtcAttachGeometryByID(t->skins, m.geometry, kind);
  rtcReleaseGeometry(m.geometry);
  return FG_STATUS_OK;
}

/* How far along an axis copies of a solid reach into the box: from -low to high periods.
 */
static void find_copies(const fg__target *t, const fg_surface *solid, int axis,
                        int copies[2])
{
  const fg__stage *stage = &t->about->stage;
  double low = HUGE_VAL, high = -HUGE_VAL;
  copies[0] = copies[1] = 0;
  for (int n = 0; n < solid->vertex_count; ++n) {
    double at = fg__stage_place(stage, axis, solid->vertex[n][axis]);
    low = fmin(low, at);
    high = fmax(high, at);
  }
  if (!(stage->period[axis] > 0.0) || solid->vertex_count == 0)
    return;
  copies[0] = (int)fmax(ceil((-stage->half[axis] - high) / stage->period[axis]), -3.0);
  copies[1] = (int)fmin(floor((stage->half[axis] - low) / stage->period[axis]), 3.0);
}

/* Arrows and halos of a solid, everywhere in the box; *number goes on. */
static fg_status add_copies(fg__target *t, const fg_surface *solid, const float *share,
                            int *number)
{
  const fg__rendering *about = t->about;
  fg_status status = FG_STATUS_OK;
  int copies[3][2], at[3];
  bool clipped = false;
  for (int k = 0; k < 3; ++k) {
    find_copies(t, solid, k, copies[k]);
    clipped = clipped || copies[k][0] < 0 || copies[k][1] > 0;
  }
  for (at[2] = copies[2][0]; at[2] <= copies[2][1]; ++at[2])
    for (at[1] = copies[1][0]; at[1] <= copies[1][1]; ++at[1])
      for (at[0] = copies[0][0]; at[0] <= copies[0][1] && !status; ++at[0]) {
        double shift[3];
        for (int k = 0; k < 3; ++k)
          shift[k] = at[k] * about->stage.period[k];
        status = add_part(t, solid, share, *number, ARROW, shift, clipped);
        if (!status && about->halo > 0.0)
          status = add_part(t, solid, share, *number, HALO, shift, clipped);
        ++*number;
      }
  return status;
}

/* Thickens an arrow whose head would be too small to tell where it points. */
static fg_icon legible(const fg__target *t, const fg_icon *icon)
{
  const fg__camera *camera = &t->about->camera;
  fg_icon out = *icon;
  double length = 0.0, pixel = fg__length(camera->eye) / camera->factor;
  for (int n = 0; n + 1 < icon->point_count; ++n)
    length += fg__apart(icon->points[n], icon->points[n + 1]);
  double least =
      fmin(t->about->least_head * pixel / t->about->stage.scale, head_share * length);
  double factor = icon->head_length > 0.0 ? fmax(least / icon->head_length, 1.0) : 1.0;
  out.width *= factor;
  out.tail_width *= factor;
  out.head_length *= factor;
  out.head_width *= factor;
  return out;
}

static fg_status add_icon(fg__target *t, const fg_icon *given, int *number)
{
  const fg_icon thick = legible(t, given), *icon = &thick;
  const double *range = t->about->range;
  fg_surface *solid = NULL;
  float *share = NULL;
  double *speed;
  fg_status status = fg__arrow_speeds(&speed, t->context, t->about->field, icon);
  if (status)
    return status;
  for (int n = 0; n < icon->point_count; ++n)
    speed[n] = fmin(fmax((speed[n] - range[0]) / (range[1] - range[0]), 0.0), 1.0);
  status = fg__solid_with_values(&solid, &share, t->context, icon, speed);
  if (!status && solid->triangle_count > 0)
    status = add_copies(t, solid, share, number);
  free(share);
  free(speed);
  fg_surface_destroy(solid);
  return status;
}

/* One thread builds: the tree, and so what rays meet first among equals, is the same
 * however many trace. */
fg_status fg__target_open(fg__target *t, fg_context *context, const fg__rendering *about)
{
  *t = (fg__target){.about = about, .context = context};
  for (int k = 0; k < 3; ++k)
    t->bound[k] = (float)about->stage.half[k] * 1.000001F;
  t->device = rtcNewDevice("threads=1,start_threads=0");
  if (!t->device)
    return fail(t, "no device");
  RTCScene *const scene[] = {&t->seen, &t->solids, &t->skins};
  for (int n = 0; n < 3; ++n) {
    *scene[n] = rtcNewScene(t->device);
    rtcSetSceneFlags(*scene[n], RTC_SCENE_FLAG_ROBUST);
  }
  fg_status status = FG_STATUS_OK;
  int number = 0;
  for (int n = 0; n < fg_icons_count(about->icons) && !status; ++n)
    status = add_icon(t, fg_icons_at(about->icons, n), &number);
  if (!status)
    status = add_skin(t, about->surface, CLUSTERS);
  if (!status)
    status = add_skin(t, about->silhouette, SILHOUETTE);
  for (int n = 0; n < 3; ++n)
    rtcCommitScene(*scene[n]);
  if (!status && rtcGetDeviceError(t->device) != RTC_ERROR_NONE)
    status = fail(t, "the scene cannot be built");
  return status;
}

void fg__target_close(fg__target *t)
{
  RTCScene const scene[] = {t->seen, t->solids, t->skins};
  for (int n = 0; n < 3; ++n)
    if (scene[n])
      rtcReleaseScene(scene[n]);
  if (t->device)
    rtcReleaseDevice(t->device);
}

static struct RTCRayHit ray_from(const double from[3], const double direction[3])
{
  return (struct RTCRayHit){.ray = {.org_x = (float)from[0],
                                    .org_y = (float)from[1],
                                    .org_z = (float)from[2],
                                    .dir_x = (float)direction[0],
                                    .dir_y = (float)direction[1],
                                    .dir_z = (float)direction[2],
                                    .tfar = INFINITY,
                                    .mask = ~0U},
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
}

fg__hit fg__target_hit(const fg__target *t, const double from[3],
                       const double direction[3])
{
  struct RTCIntersectContext context;
  struct RTCRayHit ray = ray_from(from, direction);
  rtcInitIntersectContext(&context);
  rtcIntersect1(t->seen, &context, &ray);
  fg__hit out = {.part = -1, .distance = HUGE_VAL};
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    return out;
  out.part = (int)(ray.hit.geomID / KINDS);
  out.halo = ray.hit.geomID % KINDS == HALO;
  out.distance = (double)ray.ray.tfar;
  if (out.halo)
    return out;
  float normal[3], share;
  RTCGeometry geometry = rtcGetGeometry(t->seen, ray.hit.geomID);
  rtcInterpolate0(geometry, ray.hit.primID, ray.hit.u, ray.hit.v,
                  RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, NORMAL, normal, 3);
  rtcInterpolate0(geometry, ray.hit.primID, ray.hit.u, ray.hit.v,
                  RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, SHARE, &share, 1);
  unit(normal, out.normal);
  out.share = (double)share;
  const double face[3] = {(double)ray.hit.Ng_x, (double)ray.hit.Ng_y,
                          (double)ray.hit.Ng_z};
  if (fg__dot(face, direction) > 0.0) /* the inside of one that the box cuts open */
    for (int k = 0; k < 3; ++k)
      out.normal[k] = -out.normal[k];
  return out;
}

int fg__target_veils(const fg__target *t, const double from[3], const double direction[3],
                     fg__veil out[FG__MOST_VEILS])
{
  passage p = {.target = t, .veil = out};
  struct RTCRayHit ray = ray_from(from, direction);
  rtcInitIntersectContext(&p.context);
  rtcIntersect1(t->skins, &p.context, &ray);
  int kept = 0;
  for (int n = 0; n < p.count; ++n)
    if (kept == 0 || out[n].silhouette != out[kept - 1].silhouette ||
        out[n].distance - out[kept - 1].distance > same_distance)
      out[kept++] = out[n];
  return kept;
}

int fg__target_unhidden(const fg__target *t, const double place[3],
                        const double direction[FG__PACKET][3])
{
  _Alignas(32) int valid[FG__PACKET];
  struct RTCRay8 ray;
  struct RTCIntersectContext context;
  int seen = 0;
  for (int n = 0; n < FG__PACKET; ++n) {
    valid[n] = -1;
    ray.org_x[n] = (float)place[0];
    ray.org_y[n] = (float)place[1];
    ray.org_z[n] = (float)place[2];
    ray.dir_x[n] = (float)direction[n][0];
    ray.dir_y[n] = (float)direction[n][1];
    ray.dir_z[n] = (float)direction[n][2];
    ray.tnear[n] = 0.0F;
    ray.tfar[n] = INFINITY;
    ray.time[n] = 0.0F;
    ray.mask[n] = ~0U;
    ray.flags[n] = 0;
  }
  rtcInitIntersectContext(&context);
  rtcOccluded8(valid, t->solids, &context, &ray);
  for (int n = 0; n < FG__PACKET; ++n)
    seen += !(ray.tfar[n] < 0.0F);
  return seen;
}
