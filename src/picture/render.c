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

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/team.h"
#include "picture/light.h"
#include "picture/target.h"
#include "solid/vector.h"

/* Rays through a pixel in rows and columns: edges have 16 shades between. Each looks for
 * the lamp and the sky once, and where that leaves grain, in half shadows, so often. */
enum { GRID = 4, SAMPLES = GRID * GRID, LAMP_FINER = 4, SKY_FINER = 8 };

/* What hides the sky is no farther than this, in longest sides of the box. */
static const float sky_reach = 0.16F;

/* Rays leave a surface from this far off it, likewise: some float steps at the distance
 * of the eye. */
static const float off_surface = 2e-5F;

/* Half the width of a line on a wall, pixels. */
static const double half_line = 0.6;

/* Transparent surfaces that a ray looks through; what is behind is hardly seen. */
enum { MOST_SKINS = 24 };

/* Pixels a side of the tiles that the image is made of. */
enum { TILE = 8 };

bool fg_solid_can_draw(void)
{
  return true;
}

typedef struct shop {
  const fg__rendering *about;
  fg_context *context;
  fg__target target;
  fg__bases lamp;
  double nearest, farthest; /* distances of the box's corners from the eye */
  uint32_t *image;
  int stride;
  atomic_int next_row;
  atomic_bool stopped;
} shop;

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

/* Transparent surfaces in front of something. */
typedef struct veil {
  fg__light light; /* what they send themselves */
  double left;     /* what they let through */
} veil;

/* A pixel, how many rays each of its samples sends to the lamp and to the sky, and how
 * many of all these met nothing. */
typedef struct pixel {
  uint64_t order; /* on the curve, see fg__light_order */
  int x, y;
  int lamp_rays, sky_rays, lamp_seen, sky_seen;
  bool again;  /* it has been drawn before, and `front` is known */
  veil *front; /* [SAMPLES] where surfaces are shown */
} pixel;

/* Sends rays from a point to the lamp and the sky; `face` is the surface's own normal.
 * What faces away from the lamp hides it itself, but walls let all light in. */
static void find_light(const shop *s, fg__lit *lit, const double place[3],
                       const double face[3], bool wall, pixel *p, int sample)
{
  double from[3], to[3], number[2];
  int lamp = 0, sky = 0;
  fg__packet rays = {.count = 0};
  uint64_t at = p->order * SAMPLES + (unsigned)sample;
  fg__bases round;
  fg__bases_of(&round, face);
  fg__along(place, (double)off_surface, face, from);
  memcpy(lit->lamp, s->lamp.axis, sizeof lit->lamp);
  for (int n = 0; n < p->lamp_rays; ++n) {
    fg__light_numbers(at * (unsigned)p->lamp_rays + (unsigned)n, 1, number);
    fg__lamp_sample(&s->lamp, number, to);
    if (fg__dot(to, face) > 0.0)
      lamp += fg__packet_add(&rays, &s->target, from, to, 4.0F);
    else
      lamp += wall;
  }
  lamp += fg__packet_flush(&rays, &s->target);
  for (int n = 0; n < p->sky_rays; ++n) {
    fg__light_numbers(at * (unsigned)p->sky_rays + (unsigned)n, 2, number);
    fg__sky_sample(&round, number, to);
    sky += fg__packet_add(&rays, &s->target, from, to, sky_reach);
  }
  sky += fg__packet_flush(&rays, &s->target);
  lit->lamp_seen = (double)lamp / p->lamp_rays;
  lit->sky_seen = (double)sky / p->sky_rays;
  p->lamp_seen += lamp;
  p->sky_seen += sky;
}

static double depth_of(const shop *s, double distance)
{
  double share = (distance - s->nearest) / (s->farthest - s->nearest);
  return fmin(fmax(share, 0.0), 1.0);
}

static fg__light light_hit(const shop *s, const struct RTCRayHit *hit,
                           const double direction[3], pixel *p, int sample)
{
  float smooth[3];
  fg__lit lit;
  double face[3] = {(double)hit->hit.Ng_x, (double)hit->hit.Ng_y, (double)hit->hit.Ng_z};
  rtcInterpolate0(rtcGetGeometry(s->target.scene, hit->hit.geomID), hit->hit.primID,
                  hit->hit.u, hit->hit.v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, smooth, 3);
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
  find_light(s, &lit, place, face, false, p, sample);
  return fg__light_arrow(s->target.color[hit->hit.geomID], &lit);
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

static fg__light light_wall(const shop *s, const double direction[3], pixel *p,
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
  find_light(s, &lit, place, face, true, p, sample);
  return fg__light_wall(axis, line_at(about, axis, place, distance), &lit);
}

/* What is seen of transparent surfaces up to a distance, and the share of light that
 * comes through them. */
static veil look_through(const shop *s, const double direction[3], float reach)
{
  fg__light out = {0};
  double left = 1.0, from = 0.0;
  for (int n = 0; n < MOST_SKINS && left > 0.01; ++n) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRayHit hit = {.ray = ray_from(s->about->camera.eye, direction, reach),
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    hit.ray.tnear = (float)from;
    rtcIntersect1(s->target.skins, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
      break;
    float smooth[3];
    fg__lit lit;
    rtcInterpolate0(rtcGetGeometry(s->target.skins, hit.hit.geomID), hit.hit.primID,
                    hit.hit.u, hit.hit.v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, smooth, 3);
    for (int k = 0; k < 3; ++k) {
      lit.normal[k] = (double)smooth[k];
      lit.to_viewer[k] = -direction[k];
      lit.lamp[k] = s->lamp.axis[k];
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
  return (veil){out, left};
}

static fg__light behind_veil(const veil *front, fg__light behind)
{
  const fg__light *light = &front->light;
  return (fg__light){
      light->red + front->left * behind.red, light->green + front->left * behind.green,
      light->blue + front->left * behind.blue, light->alpha + front->left * behind.alpha};
}

static fg__light trace_sample(const shop *s, pixel *p, int sample)
{
  const fg__camera *camera = &s->about->camera;
  double number[2], direction[3];
  fg__light_numbers(p->order * SAMPLES + (unsigned)sample, 0, number);
  fg__camera_ray(camera, p->x + (sample % GRID + number[0]) / GRID,
                 p->y + (sample / GRID + number[1]) / GRID, direction);
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  struct RTCRayHit hit = {.ray = ray_from(camera->eye, direction, INFINITY),
                          .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
  rtcIntersect1(s->target.scene, &context, &hit);
  fg__light behind = hit.hit.geomID != RTC_INVALID_GEOMETRY_ID
                         ? light_hit(s, &hit, direction, p, sample)
                         : light_wall(s, direction, p, sample);
  if (!s->about->surface)
    return behind;
  if (!p->again)
    p->front[sample] = look_through(s, direction, hit.ray.tfar);
  return behind_veil(&p->front[sample], behind);
}

/* Light that needs more rays. */
typedef struct unevenness {
  bool lamp, sky;
} unevenness;

/* Draws a pixel; what its rays did not all find alike is uneven. */
static unevenness trace_pixel(const shop *s, int x, int y, const unevenness *finer,
                              veil *front)
{
  pixel p = {.order = fg__light_order(x, y),
             .x = x,
             .y = y,
             .lamp_rays = finer->lamp ? LAMP_FINER : 1,
             .sky_rays = finer->sky ? SKY_FINER : 1,
             .again = finer->lamp || finer->sky,
             .front = front};
  fg__light sum = {0};
  for (int sample = 0; sample < SAMPLES; ++sample) {
    fg__light light = trace_sample(s, &p, sample);
    sum.red += light.red / SAMPLES;
    sum.green += light.green / SAMPLES;
    sum.blue += light.blue / SAMPLES;
    sum.alpha += light.alpha / SAMPLES;
  }
  s->image[(ptrdiff_t)y * s->stride + x] = fg__light_pixel(sum, s->about->transparent);
  bool half_lamp = p.lamp_seen > 0 && p.lamp_seen < SAMPLES * p.lamp_rays;
  bool half_sky = p.sky_seen > 0 && p.sky_seen < SAMPLES * p.sky_rays;
  return (unevenness){half_lamp, half_sky};
}

/* Draws a tile, and those pixels once more where light is uneven, also that of a
 * neighbour in the tile. */
static void trace_tile(const shop *s, int x, int y)
{
  const unevenness usual = {false, false};
  unevenness at[TILE + 2][TILE + 2] = {{{false, false}}};
  veil front[TILE][TILE][SAMPLES]; /* written when first drawn */
  int wide = s->about->width - x, high = s->about->height - y;
  wide = wide < TILE ? wide : TILE;
  high = high < TILE ? high : TILE;
  for (int j = 0; j < high; ++j)
    for (int i = 0; i < wide; ++i)
      at[j + 1][i + 1] = trace_pixel(s, x + i, y + j, &usual, front[j][i]);
  for (int j = 0; j < high; ++j)
    for (int i = 0; i < wide; ++i) {
      unevenness near = usual;
      for (int n = 0; n < 9; ++n) {
        near.lamp = near.lamp || at[j + n / 3][i + n % 3].lamp;
        near.sky = near.sky || at[j + n / 3][i + n % 3].sky;
      }
      if (near.lamp || near.sky)
        trace_pixel(s, x + i, y + j, &near, front[j][i]);
    }
}

static void work(void *argument, const fg__share *share)
{
  shop *s = argument;
  int height = s->about->height;
  for (;;) {
    int first = atomic_fetch_add(&s->next_row, TILE);
    if (first >= height || atomic_load(&s->stopped))
      return;
    for (int x = 0; x < s->about->width; x += TILE)
      trace_tile(s, x, first);
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
  double lamp[3];
  fg__lamp_direction(&rendering->camera, lamp);
  fg__bases_of(&s.lamp, lamp);
  find_depths(&s);
  fg_status status = fg__target_open(&s.target, context, rendering);
  if (!status)
    status = fg__team_create(&team, context, rendering->threads);
  if (!status) {
    fg__team_run(team, work, &s);
    status = fg__check_stop(context);
  }
  fg__team_destroy(team);
  fg__target_close(&s.target);
  return status;
}

#endif
