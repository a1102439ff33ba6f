#include "picture/target.h"

#ifdef FG__EMBREE

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* Hits beyond the box do not count: parts of arrows that go on across a period. */
static void only_inside(const struct RTCFilterFunctionNArguments *given)
{
  const float *bound = given->geometryUserPtr;
  /* as Embree lays out rays that it treats together: N origins' x, ... */
  enum { ORIGIN = 0, DIRECTION = 4, FAR = 8 };
  const float *ray = (const float *)(const void *)given->ray;
  for (unsigned n = 0; n < given->N; ++n)
    for (unsigned k = 0; k < 3; ++k)
      if (fabsf(ray[(ORIGIN + k) * given->N + n] +
                ray[FAR * given->N + n] * ray[(DIRECTION + k) * given->N + n]) > bound[k])
        given->valid[n] = 0;
}

static fg_status fail(const fg__target *t, const char *what)
{
  int error = (int)rtcGetDeviceError(t->device);
  const char *reason = error == (int)RTC_ERROR_OUT_OF_MEMORY ? "out of memory: " : "";
  return fg__fail(t->context, FG_STATUS_MEMORY, "%spicture: Embree: %s (error %d)",
                  reason, what, error);
}

/* Adds a copy of a solid, moved by `shift`. */
static fg_status add_solid(fg__target *t, const fg_surface *solid, fg__color color,
                           const double shift[3], bool clipped)
{
  if (solid->triangle_count == 0)
    return FG_STATUS_OK;
  const fg__stage *stage = &t->about->stage;
  RTCGeometry geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  size_t corners = (size_t)solid->corner_count, faces = (size_t)solid->triangle_count;
  rtcSetGeometryVertexAttributeCount(geometry, 1);
  float *place = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                         RTC_FORMAT_FLOAT3, 3 * sizeof *place, corners);
  float *normal = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0,
                                          RTC_FORMAT_FLOAT3, 3 * sizeof *normal, corners);
  unsigned *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                            RTC_FORMAT_UINT3, 3 * sizeof *index, faces);
  if (!place || !normal || !index) {
    rtcReleaseGeometry(geometry);
    return fail(t, "no memory for a surface");
  }
  for (size_t n = 0; n < corners; ++n)
    for (int k = 0; k < 3; ++k) {
      place[3 * n + (size_t)k] =
          (float)(fg__stage_place(stage, k, solid->vertex[solid->corner[n]][k]) +
                  shift[k]);
      normal[3 * n + (size_t)k] = solid->normal[n][k];
    }
  for (size_t n = 0; n < 3 * faces; ++n)
    index[n] = (unsigned)solid->triangle[n / 3][n % 3];
  if (clipped) {
    rtcSetGeometryUserData(geometry, t->bound);
    rtcSetGeometryIntersectFilterFunction(geometry, only_inside);
    rtcSetGeometryOccludedFilterFunction(geometry, only_inside);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(t->scene, geometry, (unsigned)t->geometries);
  rtcReleaseGeometry(geometry);
  t->color[t->geometries++] = color;
  return FG_STATUS_OK;
}

/* The clusters' surfaces, in a scene of their own: they hide nothing. */
static fg_status add_skin(fg__target *t)
{
  const fg_surface *surface = t->about->surface;
  const fg__color unused = {0.0, 0.0, 0.0};
  const double stays[3] = {0.0, 0.0, 0.0};
  RTCScene solids = t->scene;
  int geometries = t->geometries;
  fg__color *color = t->color, only;
  t->skins = t->scene = rtcNewScene(t->device);
  t->geometries = 0;
  t->color = &only;
  rtcSetSceneFlags(t->skins, RTC_SCENE_FLAG_ROBUST);
  fg_status status = surface ? add_solid(t, surface, unused, stays, false) : FG_STATUS_OK;
  rtcCommitScene(t->skins);
  t->scene = solids;
  t->geometries = geometries;
  t->color = color;
  return status;
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

static fg_status add_icon(fg__target *t, const fg_icon *icon, size_t *capacity)
{
  const fg__rendering *about = t->about;
  fg_surface *solid;
  fg_status status = fg_icon_solid(&solid, t->context, icon);
  if (status)
    return status;
  double share = (icon->speed - about->range[0]) / (about->range[1] - about->range[0]);
  fg__color color = fg__palette_color(about->palette, share);
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
        if (!fg__grow((void **)&t->color, capacity, (size_t)t->geometries + 1,
                      sizeof *t->color))
          status = fg__fail_memory(t->context, "a picture", sizeof *t->color);
        else
          status = add_solid(t, solid, color, shift, clipped);
      }
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
  t->scene = rtcNewScene(t->device);
  rtcSetSceneFlags(t->scene, RTC_SCENE_FLAG_ROBUST);
  fg_status status = FG_STATUS_OK;
  size_t capacity = 0;
  for (int n = 0; n < fg_icons_count(t->about->icons) && !status; ++n)
    status = add_icon(t, fg_icons_at(t->about->icons, n), &capacity);
  rtcCommitScene(t->scene);
  if (!status)
    status = add_skin(t);
  if (!status && rtcGetDeviceError(t->device) != RTC_ERROR_NONE)
    status = fail(t, "the scene cannot be built");
  return status;
}

void fg__target_close(fg__target *t)
{
  if (t->scene)
    rtcReleaseScene(t->scene);
  if (t->skins)
    rtcReleaseScene(t->skins);
  if (t->device)
    rtcReleaseDevice(t->device);
  free(t->color);
}

int fg__packet_flush(fg__packet *p, const fg__target *target)
{
  int seen = 0;
  struct RTCIntersectContext context;
  if (p->count == 0)
    return 0;
  for (int n = 0; n < FG__PACKET; ++n)
    p->valid[n] = n < p->count ? -1 : 0;
  rtcInitIntersectContext(&context);
  rtcOccluded8(p->valid, target->scene, &context, &p->ray);
  for (int n = 0; n < p->count; ++n)
    seen += !(p->ray.tfar[n] < 0.0F);
  p->count = 0;
  return seen;
}

int fg__packet_add(fg__packet *p, const fg__target *target, const double place[3],
                   const double direction[3], float reach)
{
  int n = p->count++;
  p->ray.org_x[n] = (float)place[0];
  p->ray.org_y[n] = (float)place[1];
  p->ray.org_z[n] = (float)place[2];
  p->ray.dir_x[n] = (float)direction[0];
  p->ray.dir_y[n] = (float)direction[1];
  p->ray.dir_z[n] = (float)direction[2];
  p->ray.tnear[n] = 0.0F;
  p->ray.tfar[n] = reach;
  p->ray.time[n] = 0.0F;
  p->ray.mask[n] = ~0U;
  p->ray.flags[n] = 0;
  return p->count == FG__PACKET ? fg__packet_flush(p, target) : 0;
}

#endif
