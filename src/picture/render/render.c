#include "picture/render/render.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/team.h"
#include "base/vector.h"
#include "picture/render/light.h"
#include "picture/render/target.h"

/* Rays through a pixel where the picture is uneven, in rows and columns: edges have 16
 * shades between. Elsewhere one through the middle will do. */
enum { GRID = 4, SAMPLES = GRID * GRID };

/* A pixel is uneven when a level of a neighbour, of 255, differs by more. */
enum { TOLERANCE = 4 };

/* In smaller pictures arrows are as thin as pixels: all are drawn finely. */
enum { SMALL_PICTURE = 400 * 400 };

/* Rows of pixels that a thread takes at a time. */
enum { ROWS = 4 };

/* Samples in turn, a row of a pixel, that take floor light and transparent surfaces from
 * the first of them: both vary little within a pixel, and are what takes most time. The
 * first ones of the rows lie in different columns. */
enum { SHARED = GRID };
static const int first_column[GRID] = {1, 3, 0, 2};

/* Transparent surfaces before an arrow hide it less than what is behind it. */
static const double veil_before_arrow = 0.45;

/* A surface that lies along a side of the box, by its normal, is not cut by it. */
static const double upright = 0.8;

/* Rays start from this far off the floor, in longest sides of the box. */
static const double off_floor = 2e-5;

/* Half the width of the box's edges, pixels. */
static const double half_line = 0.6;

typedef struct shop {
  const fg__rendering *about;
  fg_context *context;
  fg__target target;
  double lamp[3];
  double nearest, farthest; /* distances of the box's corners from the eye */
  double margin;            /* round the box, within which halos are looked for */
  uint32_t *image, *coarse; /* coarse: drawn with one ray a pixel */
  int stride;
  atomic_int next_row, next_fine_row;
  atomic_bool stopped;
} shop;

/* What samples of a pixel share. */
typedef struct glance {
  uint64_t number; /* of all rays: for what they scatter */
  bool has_floor, has_veils;
  double floor; /* the share of the light overhead that comes there */
  int veils;
  fg__veil veil[FG__MOST_VEILS];
} glance;

static double depth_of(const shop *s, double distance)
{
  double share = (distance - s->nearest) / (s->farthest - s->nearest);
  return fmin(fmax(share, 0.0), 1.0);
}

/* Where a ray is in the box. */
typedef struct stay {
  double enter, leave; /* distances */
  int door, exit;      /* the axes across which the sides there lie */
} stay;

/* Of a box that is larger by a margin; false when the ray misses it. */
static bool cross_box(const fg__rendering *about, const double direction[3],
                      double margin, stay *out)
{
  *out = (stay){.leave = HUGE_VAL};
  for (int k = 0; k < 3; ++k) {
    double half = about->stage.half[k] + margin, eye = about->camera.eye[k];
    if (!(fabs(direction[k]) > 0.0)) {
      if (fabs(eye) > half)
        return false;
      continue;
    }
    double one = (-half - eye) / direction[k], other = (half - eye) / direction[k];
    if (fmin(one, other) > out->enter) {
      out->enter = fmin(one, other);
      out->door = k;
    }
    if (fmax(one, other) < out->leave) {
      out->leave = fmax(one, other);
      out->exit = k;
    }
  }
  return out->enter < out->leave;
}

/* Whether a point of the side across `axis` lies on an edge of the box. */
static bool on_edge(const fg__rendering *about, int axis, const double place[3],
                    double distance)
{
  double width = 2.0 * half_line * distance / about->camera.factor;
  for (int k = 0; k < 3; ++k)
    if (k != axis && fabs(place[k]) > about->stage.half[k] - width)
      return true;
  return false;
}

/* The share of the light overhead that comes to a point of the floor. */
static double light_floor(const shop *s, const double place[3], glance *shared)
{
  if (shared->has_floor)
    return shared->floor;
  double to[FG__PACKET][3];
  const double from[3] = {place[0], place[1], place[2] + off_floor};
  for (unsigned n = 0; n < FG__PACKET; ++n) {
    double at[2];
    fg__light_numbers(shared->number * FG__PACKET + n, 1, at);
    fg__overhead_sample(at, to[n]);
  }
  int seen = fg__target_unhidden(&s->target, from, (const double(*)[3])to);
  shared->has_floor = true;
  return shared->floor = (double)seen / FG__PACKET;
}

/* What is behind the arrows. */
static fg__light light_ground(const shop *s, const double direction[3], glance *shared)
{
  const fg__rendering *about = s->about;
  stay box;
  double place[3];
  if (!about->walls || !cross_box(about, direction, 0.0, &box))
    return (fg__light){0};
  fg__along(about->camera.eye, box.enter, direction, place);
  if (on_edge(about, box.door, place, box.enter))
    return fg__light_edge(depth_of(s, box.enter));
  fg__along(about->camera.eye, box.leave, direction, place);
  if (on_edge(about, box.exit, place, box.leave))
    return fg__light_edge(depth_of(s, box.leave));
  bool floor = box.exit == 2 && direction[2] < 0.0;
  return fg__light_wall(box.exit, floor ? light_floor(s, place, shared) : 1.0);
}

static fg__lit lit_of(const shop *s, const double normal[3], const double direction[3],
                      double distance)
{
  fg__lit lit = {.depth = depth_of(s, distance)};
  for (int k = 0; k < 3; ++k) {
    lit.normal[k] = normal[k];
    lit.to_viewer[k] = -direction[k];
    lit.lamp[k] = s->lamp[k];
  }
  return lit;
}

/* White, as the page, or nothing where there is no page. */
static fg__light light_halo(const shop *s)
{
  double paper = s->about->transparent && !s->about->walls ? 0.0 : 1.0;
  return (fg__light){paper, paper, paper, paper};
}

static fg__light light_hit(const shop *s, const fg__hit *hit, const double direction[3])
{
  if (hit->halo)
    return light_halo(s);
  const fg__lit lit = lit_of(s, hit->normal, direction, hit->distance);
  return fg__light_arrow(fg__palette_color(s->about->palette, hit->share), &lit);
}

/* What a transparent surface sends; where the box cuts it, the line of the cut. */
static fg__light light_veil(const shop *s, const fg__veil *veil,
                            const double direction[3])
{
  const fg__lit lit = lit_of(s, veil->normal, direction, veil->distance);
  if (!veil->silhouette)
    return fg__light_skin(&lit);
  const fg__rendering *about = s->about;
  double place[3], width = 2.0 * half_line * veil->distance / about->camera.factor;
  fg__along(about->camera.eye, veil->distance, direction, place);
  bool cut = false;
  for (int k = 0; k < 3; ++k)
    cut = cut || (!(about->stage.period[k] > 0.0) && fabs(veil->normal[k]) < upright &&
                  fabs(place[k]) > about->stage.half[k] - width);
  return fg__light_silhouette(&lit, cut);
}

/* Transparent surfaces up to what a ray meets, before what is seen there. */
static fg__light look_through(const shop *s, const double direction[3],
                              const fg__hit *hit, const fg__light *behind, glance *shared)
{
  fg__light out = {0};
  double left = 1.0, strength = hit->part >= 0 ? veil_before_arrow : 1.0;
  if (!shared->has_veils)
    shared->veils =
        fg__target_veils(&s->target, s->about->camera.eye, direction, shared->veil);
  shared->has_veils = true;
  for (int n = 0; n < shared->veils && shared->veil[n].distance < hit->distance; ++n) {
    fg__light skin = light_veil(s, &shared->veil[n], direction);
    double share = left * strength;
    out.red += share * skin.red;
    out.green += share * skin.green;
    out.blue += share * skin.blue;
    out.alpha += share * skin.alpha;
    left *= 1.0 - strength * skin.alpha;
  }
  return (fg__light){out.red + left * behind->red, out.green + left * behind->green,
                     out.blue + left * behind->blue, out.alpha + left * behind->alpha};
}

/* Of a ray through a place in the picture. */
static fg__light trace(const shop *s, double x, double y, glance *shared)
{
  const fg__rendering *about = s->about;
  double direction[3];
  stay box;
  fg__camera_ray(&about->camera, x, y, direction);
  if (!cross_box(about, direction, s->margin, &box))
    return (fg__light){0};
  fg__hit hit = fg__target_hit(&s->target, about->camera.eye, direction);
  fg__light light =
      hit.part >= 0 ? light_hit(s, &hit, direction) : light_ground(s, direction, shared);
  if (!about->surface && !about->silhouette)
    return light;
  return look_through(s, direction, &hit, &light, shared);
}

static uint32_t trace_finely(const shop *s, int x, int y)
{
  fg__light sum = {0};
  uint64_t order = fg__light_order(x, y);
  glance shared;
  shared.number = order * (SAMPLES / SHARED);
  for (int sample = 0; sample < SAMPLES; ++sample) {
    double number[2];
    int row = sample / GRID, column = (sample + first_column[row]) % GRID;
    if (sample % SHARED == 0) {
      shared.has_floor = shared.has_veils = false;
      shared.number += sample > 0;
    }
    fg__light_numbers(order * SAMPLES + (unsigned)sample, 0, number);
    fg__light light =
        trace(s, x + (column + number[0]) / GRID, y + (row + number[1]) / GRID, &shared);
    sum.red += light.red / SAMPLES;
    sum.green += light.green / SAMPLES;
    sum.blue += light.blue / SAMPLES;
    sum.alpha += light.alpha / SAMPLES;
  }
  return fg__light_pixel(sum, s->about->transparent);
}

static bool differ(uint32_t one, uint32_t other)
{
  for (int shift = 0; shift < 32; shift += 8)
    if (abs((int)(one >> shift & 255U) - (int)(other >> shift & 255U)) > TOLERANCE)
      return true;
  return false;
}

/* Whether a pixel of the coarse image differs from one beside it. */
static bool is_uneven(const shop *s, int x, int y)
{
  int wide = s->about->width, high = s->about->height;
  uint32_t own = s->coarse[(ptrdiff_t)y * wide + x];
  for (int n = 0; n < 9; ++n) {
    int i = x + n % 3 - 1, j = y + n / 3 - 1;
    if (i >= 0 && i < wide && j >= 0 && j < high &&
        differ(own, s->coarse[(ptrdiff_t)j * wide + i]))
      return true;
  }
  return false;
}

/* Gives rows out until there are none or the work is stopped; `draw` makes one. */
static void share_rows(shop *s, const fg__share *share, atomic_int *next,
                       void (*draw)(const shop *s, int y))
{
  for (;;) {
    int first = atomic_fetch_add(next, ROWS), high = s->about->height;
    if (first >= high || atomic_load(&s->stopped))
      return;
    for (int y = first; y < first + ROWS && y < high; ++y)
      draw(s, y);
    if (share->member == 0 && fg__check_stop(s->context))
      atomic_store(&s->stopped, true);
  }
}

static void draw_coarse_row(const shop *s, int y)
{
  for (int x = 0; x < s->about->width; ++x) {
    glance alone; /* its veils are written when there are any */
    alone.number = fg__light_order(x, y);
    alone.has_floor = alone.has_veils = false;
    s->coarse[(ptrdiff_t)y * s->about->width + x] =
        fg__light_pixel(trace(s, x + 0.5, y + 0.5, &alone), s->about->transparent);
  }
}

static void draw_row(const shop *s, int y)
{
  bool small = s->about->width * s->about->height < SMALL_PICTURE;
  for (int x = 0; x < s->about->width; ++x)
    s->image[(ptrdiff_t)y * s->stride + x] =
        small || is_uneven(s, x, y) ? trace_finely(s, x, y)
                                    : s->coarse[(ptrdiff_t)y * s->about->width + x];
}

static void work_coarsely(void *argument, const fg__share *share)
{
  shop *s = argument;
  share_rows(s, share, &s->next_row, draw_coarse_row);
}

static void work_finely(void *argument, const fg__share *share)
{
  shop *s = argument;
  share_rows(s, share, &s->next_fine_row, draw_row);
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
  s->margin = 2.0 * s->about->halo * s->farthest / s->about->camera.factor;
}

fg_status fg__render(fg_context *context, const fg__rendering *rendering, uint32_t *image,
                     int stride)
{
  shop s = {.about = rendering, .context = context, .image = image, .stride = stride};
  fg__team *team = NULL;
  size_t pixels = (size_t)rendering->width * (size_t)rendering->height;
  fg__lamp_direction(&rendering->camera, s.lamp);
  find_depths(&s);
  fg_status status = fg__target_open(&s.target, context, rendering);
  s.coarse = fg__allocate(pixels, sizeof *s.coarse);
  if (!status && !s.coarse)
    status = fg__fail_memory(context, "a picture", pixels * sizeof *s.coarse);
  if (!status)
    status = fg__team_create(&team, context, rendering->threads);
  if (!status) {
    fg__team_run(team, work_coarsely, &s);
    fg__team_run(team, work_finely, &s);
    status = fg__check_stop(context);
  }
  fg__team_destroy(team);
  fg__target_close(&s.target);
  free(s.coarse);
  return status;
}
