#include "picture/render/shade.h"

#include <math.h>

#include "base/vector.h"

/* Transparent surfaces before an arrow hide it less than what is behind it. */
static const double layer_before_arrow = 0.45;

/* A surface that lies along a side of the box, by its normal, is not cut by it. */
static const double upright = 0.8;

/* Half the width of the box's edges, pixels. */
static const double half_line = 0.6;

static double depth_of(const fg__shading *s, double distance)
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
    double half = about->view_box.half[k] + margin, eye = about->camera.eye[k];
    if (!(fabs(direction[k]) > 0.0)) {
      if (fabs(eye) > half)
        return false;
      continue;
    }
    double one = (-half - eye) / direction[k], other = (half - eye) / direction[k];
    double first = fg__least(one, other), last = fg__most(one, other);
    if (first > out->enter) {
      out->enter = first;
      out->door = k;
    }
    if (last < out->leave) {
      out->leave = last;
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
    if (k != axis && fabs(place[k]) > about->view_box.half[k] - width)
      return true;
  return false;
}

/* What is behind the arrows. */
static fg__light light_ground(const fg__shading *s, fg__shade_at *p)
{
  const fg__rendering *about = s->about;
  stay box;
  double place[3];
  p->seen = FG__SEEN_PAGE;
  if (!about->walls || !cross_box(about, p->direction, 0.0, &box))
    return (fg__light){0};
  p->seen = FG__SEEN_EDGE;
  fg__add_scaled(about->camera.eye, box.enter, p->direction, place);
  if (on_edge(about, box.door, place, box.enter))
    return fg__light_edge(&s->tones, depth_of(s, box.enter));
  fg__add_scaled(about->camera.eye, box.leave, p->direction, place);
  if (on_edge(about, box.exit, place, box.leave))
    return fg__light_edge(&s->tones, depth_of(s, box.leave));
  p->seen = FG__SEEN_WALL + box.exit;
  bool floor = box.exit == 2 && p->direction[2] < 0.0;
  return fg__light_wall(box.exit, floor ? fg__shadow_light(s->shadow, place) : 1.0);
}

static fg__lit lit_of(const fg__shading *s, const double normal[3],
                      const double direction[3], double distance)
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
static fg__light light_halo(const fg__shading *s)
{
  double paper = s->about->transparent && !s->about->walls ? 0.0 : 1.0;
  return (fg__light){paper, paper, paper, paper};
}

/* The share of a pixel that the dot on a head's tip takes. */
static double dot_at(const fg__shading *s, const fg__shade_at *p, int part,
                     double distance)
{
  const fg__tip *tip = &s->view->geometry->tip[part];
  double place[3];
  if (!(tip->reach > 0.0))
    return 0.0;
  fg__add_scaled(s->about->camera.eye, distance, p->direction, place);
  const double pixel = distance / s->about->camera.factor;
  const double inside = tip->slope * (tip->reach - fg__distance(place, tip->at)) / pixel;
  return fmin(fmax(0.5 + inside, 0.0), 1.0);
}

static fg__light light_face(const fg__shading *s, fg__shade_at *p)
{
  const fg__face *face = &s->view->geometry->solid.face[p->nearest->face];
  p->seen = FG__SEEN_ARROW + 2 * face->part + (face->kind == FG__FACE_HALO);
  if (face->kind == FG__FACE_HALO)
    return light_halo(s);
  fg__seen seen;
  fg__view_seen(s->view, p->nearest->face, p->x, p->y, &seen);
  const fg__lit lit = lit_of(s, seen.normal, p->direction, seen.distance);
  fg__light light =
      fg__light_arrow(&s->tones, fg__palette_color(s->about->palette, seen.share), &lit);
  const double dot = dot_at(s, p, face->part, seen.distance);
  light.red += dot * (1.0 - light.red);
  light.green += dot * (1.0 - light.green);
  light.blue += dot * (1.0 - light.blue);
  return light;
}

/* What a transparent surface sends; where the box cuts it, the line of the cut. */
static fg__light light_layer(const fg__shading *s, const fg__layer *layer,
                             const double direction[3])
{
  double normal[3], distance = (double)layer->distance, place[3];
  for (int k = 0; k < 3; ++k)
    normal[k] = (double)layer->normal[k];
  const fg__lit lit = lit_of(s, normal, direction, distance);
  if (!layer->silhouette)
    return fg__light_isosurface(&lit);
  const fg__rendering *about = s->about;
  double width = 2.0 * half_line * distance / about->camera.factor;
  fg__add_scaled(about->camera.eye, distance, direction, place);
  bool cut = false;
  for (int k = 0; k < 3; ++k)
    cut = cut || (!(about->view_box.period[k] > 0.0) && fabs(normal[k]) < upright &&
                  fabs(place[k]) > about->view_box.half[k] - width);
  return fg__light_silhouette(&s->tones, &lit, cut);
}

/* Of the transparent surfaces before what is seen at a point. */
static fg__haze find_haze(const fg__shading *s, const fg__shade_at *p)
{
  bool solid = p->nearest->face >= 0;
  fg__haze out = {.left = 1.0};
  double strength = solid ? layer_before_arrow : 1.0, end = HUGE_VAL;
  if (solid)
    end = (double)p->nearest->depth / fg__dot(p->direction, s->about->camera.forward);
  for (int n = 0; n < p->layers && (double)p->layer[n].distance < end; ++n) {
    fg__light isosurface = light_layer(s, &p->layer[n], p->direction);
    double share = out.left * strength;
    out.light.red += share * isosurface.red;
    out.light.green += share * isosurface.green;
    out.light.blue += share * isosurface.blue;
    out.light.alpha += share * isosurface.alpha;
    out.left *= 1.0 - strength * isosurface.alpha;
  }
  return out;
}

/* How far beyond the box what is seen at a point may lie: an arrow that is not cut there
 * sticks out by its radius. */
static double margin_of(const fg__shading *s, const fg__shade_at *p)
{
  const bool whole = p->nearest->face >= 0 && p->layers == 0 &&
                     !s->view->geometry->solid.face[p->nearest->face].clipped;
  return s->margin + (whole ? s->thickest : 0.0);
}

fg__light fg__shade_point(const fg__shading *s, fg__shade_at *p, fg__haze *haze)
{
  bool solid = p->nearest->face >= 0;
  stay box;
  p->seen = FG__SEEN_PAGE;
  if (!solid && p->layers == 0 &&
      (p->x < s->low[0] || p->x > s->high[0] || p->y < s->low[1] || p->y > s->high[1]))
    return (fg__light){0};
  fg__camera_ray(&s->about->camera, p->x, p->y, p->direction);
  if ((solid || p->layers > 0) &&
      !cross_box(s->about, p->direction, margin_of(s, p), &box))
    return (fg__light){0};
  fg__light behind = solid ? light_face(s, p) : light_ground(s, p);
  if (p->layers == 0)
    return behind;
  if (haze->left < 0.0)
    *haze = find_haze(s, p);
  const fg__light *light = &haze->light;
  double left = haze->left;
  return (fg__light){light->red + left * behind.red, light->green + left * behind.green,
                     light->blue + left * behind.blue,
                     light->alpha + left * behind.alpha};
}

static void find_depths(fg__shading *s)
{
  s->nearest = HUGE_VAL;
  for (int c = 0; c < 8; ++c) {
    double corner[3], at[2];
    for (int k = 0; k < 3; ++k)
      corner[k] = c >> k & 1 ? s->about->view_box.half[k] : -s->about->view_box.half[k];
    fg__camera_project(&s->about->camera, corner, at);
    for (int k = 0; k < 2; ++k) {
      s->low[k] = c > 0 ? fg__least(s->low[k], at[k]) : at[k];
      s->high[k] = c > 0 ? fg__most(s->high[k], at[k]) : at[k];
    }
    double distance = fg__distance(corner, s->about->camera.eye);
    s->nearest = fmin(s->nearest, distance);
    s->farthest = fmax(s->farthest, distance);
  }
  s->margin = 2.0 * s->about->halo * s->farthest / s->about->camera.factor;
  for (int n = 0; n < fg_icons_count(s->about->icons); ++n) {
    const fg_icon *icon = fg_icons_at(s->about->icons, n);
    s->thickest = fmax(s->thickest, s->about->view_box.scale * icon->head_width / 2.0);
  }
}

void fg__shading_make(fg__shading *out, const fg__rendering *about, const fg__view *view,
                      const fg__shadow *shadow)
{
  *out = (fg__shading){.about = about, .view = view, .shadow = shadow};
  fg__tones_make(&out->tones);
  fg__lamp_direction(&about->camera, out->lamp);
  find_depths(out);
}
