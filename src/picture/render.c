#include "picture/render.h"

#ifndef FG__EMBREE

bool fg_solid_can_draw(void)
{
  return false;
}

fg_status fg__render(fg_context *context, const fg__rendering *rendering, uint32_t *image,
                     int stride)
{
  (void)rendering;
  (void)image;
  (void)stride;
  return fg__fail(context, FG_STATUS_UNSUPPORTED,
                  "picture: this flowgrain was built without Embree, which draws in 3D");
}

#else

#include <embree3/rtcore.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "picture/light.h"
#include "solid/vector.h"

/* Rays through a pixel in rows and columns: edges have 16 shades between. Each looks for
 * the lamp once and for the sky SKY_RAYS times. */
enum { GRID = 4, SAMPLES = GRID * GRID, SKY_RAYS = 2 };

/* What hides the sky is no farther than this, in longest sides of the box. */
static const float sky_reach = 0.16F;

/* Rays leave a surface from this far off it, likewise: some float steps at the distance
 * of the eye. */
static const float off_surface = 2e-5F;

/* Half the width of a line on a wall, pixels. */
static const double half_line = 0.6;

/* Transparent surfaces that a ray looks through; what is behind is hardly seen. */
enum { MOST_SKINS = 24 };

/* Rows of the image that a thread takes at a time. */
enum { ROWS = 8 };

bool fg_solid_can_draw(void)
{
  return true;
}

typedef struct shop {
  const fg__rendering *about;
  fg_context *context;
  RTCDevice device;
  RTCScene scene, skins; /* what hides, and what lets light through */
  fg__color *color;      /* [geometries] */
  int geometries;
  double lamp[3];
  float bound[3];           /* of the box; beyond it nothing is seen */
  double nearest, farthest; /* distances of the box's corners from the eye */
  uint32_t *image;
  int stride;
  atomic_int next_row;
  atomic_bool stopped;
} shop;

/* Hits beyond the box do not count: parts of arrows that go on across a period. */
static void only_inside(const struct RTCFilterFunctionNArguments *given)
{
  const float *bound = given->geometryUserPtr;
  const struct RTCRay *ray = (const struct RTCRay *)(const void *)given->ray;
  const float place[3] = {ray->org_x + ray->tfar * ray->dir_x,
                          ray->org_y + ray->tfar * ray->dir_y,
                          ray->org_z + ray->tfar * ray->dir_z};
  for (int k = 0; k < 3; ++k)
    if (fabsf(place[k]) > bound[k])
      given->valid[0] = 0;
}

static fg_status fail(const shop *s, const char *what)
{
  return fg__fail(s->context, FG_STATUS_MEMORY, "picture: Embree: %s (error %d)", what,
                  (int)rtcGetDeviceError(s->device));
}

/* Adds a copy of a solid, moved by `shift`. */
static fg_status add_solid(shop *s, const fg_surface *solid, fg__color color,
                           const double shift[3], bool clipped)
{
  if (solid->triangle_count == 0)
    return FG_STATUS_OK;
  const fg__stage *stage = &s->about->stage;
  RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE);
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
    return fail(s, "no memory for a surface");
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
    rtcSetGeometryUserData(geometry, s->bound);
    rtcSetGeometryIntersectFilterFunction(geometry, only_inside);
    rtcSetGeometryOccludedFilterFunction(geometry, only_inside);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(s->scene, geometry, (unsigned)s->geometries);
  rtcReleaseGeometry(geometry);
  s->color[s->geometries++] = color;
  return FG_STATUS_OK;
}

/* The clusters' surfaces, in a scene of their own: they hide nothing. */
static fg_status add_skin(shop *s)
{
  const fg_surface *surface = s->about->surface;
  const fg__color unused = {0.0, 0.0, 0.0};
  const double stays[3] = {0.0, 0.0, 0.0};
  RTCScene solids = s->scene;
  int geometries = s->geometries;
  fg__color *color = s->color, only;
  s->skins = s->scene = rtcNewScene(s->device);
  s->geometries = 0;
  s->color = &only;
  rtcSetSceneFlags(s->skins, RTC_SCENE_FLAG_ROBUST);
  fg_status status = surface ? add_solid(s, surface, unused, stays, false) : FG_STATUS_OK;
  rtcCommitScene(s->skins);
  s->scene = solids;
  s->geometries = geometries;
  s->color = color;
  return status;
}

/* How far along an axis copies of a solid reach into the box: from -low to high periods.
 */
static void find_copies(const shop *s, const fg_surface *solid, int axis, int copies[2])
{
  const fg__stage *stage = &s->about->stage;
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

static fg_status add_icon(shop *s, const fg_icon *icon, size_t *capacity)
{
  const fg__rendering *about = s->about;
  fg_surface *solid;
  fg_status status = fg_icon_solid(&solid, s->context, icon);
  if (status)
    return status;
  double share = (icon->speed - about->range[0]) / (about->range[1] - about->range[0]);
  fg__color color = fg__palette_color(about->palette, share);
  int copies[3][2], at[3];
  bool clipped = false;
  for (int k = 0; k < 3; ++k) {
    find_copies(s, solid, k, copies[k]);
    clipped = clipped || copies[k][0] < 0 || copies[k][1] > 0;
  }
  for (at[2] = copies[2][0]; at[2] <= copies[2][1]; ++at[2])
    for (at[1] = copies[1][0]; at[1] <= copies[1][1]; ++at[1])
      for (at[0] = copies[0][0]; at[0] <= copies[0][1] && !status; ++at[0]) {
        double shift[3];
        for (int k = 0; k < 3; ++k)
          shift[k] = at[k] * about->stage.period[k];
        if (!fg__grow((void **)&s->color, capacity, (size_t)s->geometries + 1,
                      sizeof *s->color))
          status = fg__fail_memory(s->context, "a picture", sizeof *s->color);
        else
          status = add_solid(s, solid, color, shift, clipped);
      }
  fg_surface_destroy(solid);
  return status;
}

/* One thread builds: the tree, and so what rays meet first among equals, is the same
 * however many trace. */
static fg_status open_shop(shop *s)
{
  s->device = rtcNewDevice("threads=1,start_threads=0");
  if (!s->device)
    return fail(s, "no device");
  s->scene = rtcNewScene(s->device);
  rtcSetSceneFlags(s->scene, RTC_SCENE_FLAG_ROBUST);
  fg_status status = FG_STATUS_OK;
  size_t capacity = 0;
  for (int n = 0; n < fg_icons_count(s->about->icons) && !status; ++n)
    status = add_icon(s, fg_icons_at(s->about->icons, n), &capacity);
  rtcCommitScene(s->scene);
  if (!status)
    status = add_skin(s);
  if (!status && rtcGetDeviceError(s->device) != RTC_ERROR_NONE)
    status = fail(s, "the scene cannot be built");
  return status;
}

static void close_shop(shop *s)
{
  if (s->scene)
    rtcReleaseScene(s->scene);
  if (s->skins)
    rtcReleaseScene(s->skins);
  if (s->device)
    rtcReleaseDevice(s->device);
  free(s->color);
}

static struct RTCRay ray_from(const double place[3], const double direction[3],
                              float reach)
{
  return (struct RTCRay){.org_x = (float)place[0],
                         .org_y = (float)place[1],
                         .org_z = (float)place[2],
                         .dir_x = (float)direction[0],
                         .dir_y = (float)direction[1],
                         .dir_z = (float)direction[2],
                         .tfar = reach,
                         .mask = ~0U};
}

static bool is_hidden(const shop *s, const double place[3], const double direction[3],
                      float reach)
{
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  struct RTCRay ray = ray_from(place, direction, reach);
  rtcOccluded1(s->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

/* Sends rays from a point to the lamp and the sky; `face` is the surface's own normal.
 * What faces away from the lamp hides it itself, but walls let all light in. */
static void find_light(const shop *s, fg__lit *lit, const double place[3],
                       const double face[3], bool wall, int x, int y, int sample)
{
  double from[3], to[3], number[2];
  fg__along(place, (double)off_surface, face, from);
  memcpy(lit->lamp, s->lamp, sizeof lit->lamp);
  fg__light_numbers(x, y, sample, 1, number);
  fg__lamp_sample(s->lamp, number, to);
  bool faces = fg__dot(to, face) > 0.0;
  lit->lamp_seen = faces ? !is_hidden(s, from, to, 4.0F) : wall;
  int seen = 0;
  for (int n = 0; n < SKY_RAYS; ++n) {
    fg__light_numbers(x, y, SKY_RAYS * sample + n, 2, number);
    fg__sky_sample(face, number, to);
    seen += !is_hidden(s, from, to, sky_reach);
  }
  lit->sky_seen = (double)seen / SKY_RAYS;
}

static double depth_of(const shop *s, double distance)
{
  double share = (distance - s->nearest) / (s->farthest - s->nearest);
  return fmin(fmax(share, 0.0), 1.0);
}

static fg__light light_hit(const shop *s, const struct RTCRayHit *hit,
                           const double direction[3], int x, int y, int sample)
{
  float smooth[3];
  fg__lit lit;
  double face[3] = {(double)hit->hit.Ng_x, (double)hit->hit.Ng_y, (double)hit->hit.Ng_z};
  rtcInterpolate0(rtcGetGeometry(s->scene, hit->hit.geomID), hit->hit.primID, hit->hit.u,
                  hit->hit.v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, smooth, 3);
  double place[3], distance = (double)hit->ray.tfar;
  fg__along(s->about->camera.eye, distance, direction, place);
  fg__normalise(face);
  for (int k = 0; k < 3; ++k) {
    lit.normal[k] = (double)smooth[k];
    lit.to_viewer[k] = -direction[k];
  }
  fg__normalise(lit.normal);
  if (fg__dot(face, direction) > 0.0) /* the inside of one that the box cuts open */
    for (int k = 0; k < 3; ++k) {
      face[k] = -face[k];
      lit.normal[k] = -lit.normal[k];
    }
  lit.depth = depth_of(s, distance);
  find_light(s, &lit, place, face, false, x, y, sample);
  return fg__light_arrow(s->color[hit->hit.geomID], &lit);
}

/* Where a ray leaves the box; false when it misses it. */
static bool leave_box(const fg__rendering *about, const double direction[3], int *axis,
                      double *distance)
{
  double enter = 0.0, leave = HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    double half = about->stage.half[k], eye = about->camera.eye[k];
    if (!(fabs(direction[k]) > 0.0)) {
      if (fabs(eye) > half)
        return false;
      continue;
    }
    double one = (-half - eye) / direction[k], other = (half - eye) / direction[k];
    enter = fmax(enter, fmin(one, other));
    if (fmax(one, other) < leave) {
      leave = fmax(one, other);
      *axis = k;
    }
  }
  *distance = leave;
  return enter < leave;
}

/* How much of a line covers a point of the wall across `axis`. */
static double line_at(const fg__rendering *about, int axis, const double place[3],
                      double distance)
{
  double width = half_line * distance / about->camera.factor, cover = 0.0;
  for (int k = 0; k < 3; ++k) {
    if (k == axis)
      continue;
    if (fabs(place[k]) > about->stage.half[k] - 2.0 * width)
      return 1.0;
    for (int n = 0; n < about->lines[k]; ++n)
      if (fabs(place[k] - about->line[k][n]) < width)
        cover = 0.42;
  }
  return cover;
}

static fg__light light_wall(const shop *s, const double direction[3], int x, int y,
                            int sample)
{
  const fg__rendering *about = s->about;
  int axis = 0;
  double distance, place[3], face[3] = {0.0, 0.0, 0.0};
  if (!about->walls || !leave_box(about, direction, &axis, &distance))
    return (fg__light){0};
  fg__along(about->camera.eye, distance, direction, place);
  face[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
  fg__lit lit = {.depth = depth_of(s, distance)};
  find_light(s, &lit, place, face, true, x, y, sample);
  return fg__light_wall(axis, line_at(about, axis, place, distance), &lit);
}

/* What is seen of transparent surfaces up to a distance, and through them. */
static fg__light look_through(const shop *s, const double direction[3], float reach,
                              fg__light behind)
{
  fg__light out = {0};
  double left = 1.0, from = 0.0;
  for (int n = 0; n < MOST_SKINS && left > 0.01; ++n) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRayHit hit = {.ray = ray_from(s->about->camera.eye, direction, reach),
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    hit.ray.tnear = (float)from;
    rtcIntersect1(s->skins, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
      break;
    float smooth[3];
    fg__lit lit;
    rtcInterpolate0(rtcGetGeometry(s->skins, hit.hit.geomID), hit.hit.primID, hit.hit.u,
                    hit.hit.v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, smooth, 3);
    for (int k = 0; k < 3; ++k) {
      lit.normal[k] = (double)smooth[k];
      lit.to_viewer[k] = -direction[k];
      lit.lamp[k] = s->lamp[k];
    }
    fg__normalise(lit.normal);
    fg__light skin = fg__light_skin(&lit);
    out.red += left * skin.red;
    out.green += left * skin.green;
    out.blue += left * skin.blue;
    out.alpha += left * skin.alpha;
    left *= 1.0 - skin.alpha;
    from = (double)hit.ray.tfar + (double)off_surface;
  }
  out.red += left * behind.red;
  out.green += left * behind.green;
  out.blue += left * behind.blue;
  out.alpha += left * behind.alpha;
  return out;
}

static fg__light trace_sample(const shop *s, int x, int y, int sample)
{
  const fg__camera *camera = &s->about->camera;
  double number[2], direction[3];
  fg__light_numbers(x, y, sample, 0, number);
  fg__camera_ray(camera, x + (sample % GRID + number[0]) / GRID,
                 y + (sample / GRID + number[1]) / GRID, direction);
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  struct RTCRayHit hit = {.ray = ray_from(camera->eye, direction, INFINITY),
                          .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
  rtcIntersect1(s->scene, &context, &hit);
  fg__light behind = hit.hit.geomID != RTC_INVALID_GEOMETRY_ID
                         ? light_hit(s, &hit, direction, x, y, sample)
                         : light_wall(s, direction, x, y, sample);
  return s->about->surface ? look_through(s, direction, hit.ray.tfar, behind) : behind;
}

static void trace_row(const shop *s, int y)
{
  for (int x = 0; x < s->about->width; ++x) {
    fg__light sum = {0};
    for (int sample = 0; sample < SAMPLES; ++sample) {
      fg__light light = trace_sample(s, x, y, sample);
      sum.red += light.red / SAMPLES;
      sum.green += light.green / SAMPLES;
      sum.blue += light.blue / SAMPLES;
      sum.alpha += light.alpha / SAMPLES;
    }
    s->image[(ptrdiff_t)y * s->stride + x] = fg__light_pixel(sum, s->about->transparent);
  }
}

static void work(void *argument, const fg__share *share)
{
  shop *s = argument;
  int height = s->about->height;
  for (;;) {
    int first = atomic_fetch_add(&s->next_row, ROWS);
    if (first >= height || atomic_load(&s->stopped))
      return;
    for (int y = first; y < first + ROWS && y < height; ++y)
      trace_row(s, y);
    if (share->member == 0 && fg__check_stop(s->context))
      atomic_store(&s->stopped, true);
  }
}

static void find_depths(shop *s)
{
  s->nearest = HUGE_VAL;
  for (int c = 0; c < 8; ++c) {
    double corner[3];
    for (int k = 0; k < 3; ++k)
      corner[k] = c >> k & 1 ? s->about->stage.half[k] : -s->about->stage.half[k];
    double distance = fg__apart(corner, s->about->camera.eye);
    s->nearest = fmin(s->nearest, distance);
    s->farthest = fmax(s->farthest, distance);
  }
}

fg_status fg__render(fg_context *context, const fg__rendering *rendering, uint32_t *image,
                     int stride)
{
  shop s = {.about = rendering, .context = context, .image = image, .stride = stride};
  fg__team *team = NULL;
  for (int k = 0; k < 3; ++k)
    s.bound[k] = (float)rendering->stage.half[k] * 1.000001F;
  fg__lamp_direction(&rendering->camera, s.lamp);
  find_depths(&s);
  fg_status status = open_shop(&s);
  if (!status)
    status = fg__team_create(&team, context, rendering->threads);
  if (!status) {
    fg__team_run(team, work, &s);
    status = fg__check_stop(context);
  }
  fg__team_destroy(team);
  close_shop(&s);
  return status;
}

#endif
