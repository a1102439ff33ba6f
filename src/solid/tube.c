#include "solid/tube.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/vector.h"
#include "solid/frame.h"

/* Corners of a cross-section: with smooth normals no edge shows in a picture where the
 * head is 100 pixels thick. */
enum { SIDES = 32 };

/* Sections of a head, so that it bends with the line. */
enum { HEAD_SECTIONS = 6 };

/* A head takes at most this share of the line, whatever a file says. */
static const double LONGEST_HEAD = 0.9;

static const double FULL_TURN = 6.283185307179586;

typedef struct section {
  double position[3];
  double radius, slope; /* slope: growth of the radius along the line */
  double value;
} section;

/* An arrow as sections from tail to tip; the two at the head's base share a place. */
typedef struct shape {
  section *section;
  double (*point)[3], (*tangent)[3], (*normal)[3]; /* of each section */
  int count, base; /* base: the last section of the body */
} shape;

static double length_of(const fg_icon *icon)
{
  double length = 0;
  for (int i = 1; i < icon->point_count; i++)
    length += fg__distance(icon->points[i], icon->points[i - 1]);
  return length;
}

/* Adds sections at s[], ascending arc lengths; pieces are walked once. value: at each
 * point, or NULL. */
static void add_sections(shape *out, const fg_icon *icon, const double *value,
                         const double *s, int count, double radius_first,
                         double radius_last)
{
  double passed = 0, slope = (radius_last - radius_first) / (s[count - 1] - s[0]);
  int piece = 0;
  for (int n = 0; n < count; n++) {
    double length = fg__distance(icon->points[piece + 1], icon->points[piece]);
    while (piece + 2 < icon->point_count && passed + length < s[n]) {
      passed += length;
      piece++;
      length = fg__distance(icon->points[piece + 1], icon->points[piece]);
    }
    double t = length > 0 ? fmin(fmax((s[n] - passed) / length, 0), 1) : 0;
    section *add = &out->section[out->count++];
    for (int k = 0; k < 3; k++)
      add->position[k] = icon->points[piece][k] +
                         t * (icon->points[piece + 1][k] - icon->points[piece][k]);
    add->radius = radius_first + slope * (s[n] - s[0]);
    add->slope = slope;
    if (value)
      add->value = value[piece] + t * (value[piece + 1] - value[piece]);
  }
}

/* Frames at all sections: the two at the base have the same. */
static void add_frames(shape *s)
{
  int n = 0;
  for (int i = 0; i < s->count; i++)
    if (i != s->base + 1)
      memcpy(s->point[n++], s->section[i].position, sizeof *s->point);
  fg__frame_along((const double(*)[3])s->point, n, s->tangent, s->normal);
  for (int i = s->count - 1; i > s->base; i--) {
    memcpy(s->tangent[i], s->tangent[i - 1], sizeof *s->tangent);
    memcpy(s->normal[i], s->normal[i - 1], sizeof *s->normal);
  }
}

static fg_status create_shape(shape *out, fg_context *context, const fg_icon *icon,
                              const double *value)
{
  double length = length_of(icon);
  double head = fmin(icon->head_length, LONGEST_HEAD * length), body = length - head;
  double step = length / (icon->point_count - 1);
  int pieces = (int)fmin(fmax(ceil(body / step), 2), 1e6);
  size_t count = (size_t)pieces + 1 + HEAD_SECTIONS + 1;
  *out = (shape){.section = fg__allocate(count, sizeof *out->section),
                 .point = fg__allocate(count, sizeof *out->point),
                 .tangent = fg__allocate(count, sizeof *out->tangent),
                 .normal = fg__allocate(count, sizeof *out->normal),
                 .base = pieces};
  double *s = fg__allocate(count, sizeof *s);
  if (!out->section || !out->point || !out->tangent || !out->normal || !s) {
    free(s);
    return fg__fail_memory(context, "an arrow", count * sizeof *out->section);
  }
  for (int i = 0; i <= pieces; i++)
    s[i] = body * i / pieces;
  add_sections(out, icon, value, s, pieces + 1, icon->tail_width / 2, icon->width / 2);
  for (int i = 0; i <= HEAD_SECTIONS; i++)
    s[i] = body + head * i / HEAD_SECTIONS;
  add_sections(out, icon, value, s, HEAD_SECTIONS + 1, icon->head_width / 2, 0);
  free(s);
  add_frames(out);
  return FG_STATUS_OK;
}

static void clear_shape(shape *s)
{
  free(s->section);
  free(s->point);
  free(s->tangent);
  free(s->normal);
}

/* The direction away from the line at one side of a section. */
static void radial(const shape *s, int n, int side, double shift, double out[3])
{
  double angle = FULL_TURN * (side + shift) / SIDES, other[3];
  fg__cross(s->tangent[n], s->normal[n], other);
  for (int k = 0; k < 3; k++)
    out[k] = cos(angle) * s->normal[n][k] + sin(angle) * other[k];
}

static int add_vertex(fg_surface *out, const double position[3])
{
  memcpy(out->vertex[out->vertex_count], position, sizeof *out->vertex);
  return out->vertex_count++;
}

static int add_corner(fg_surface *out, int vertex, const double normal[3])
{
  double unit[3] = {normal[0], normal[1], normal[2]};
  fg__normalise(unit);
  out->corner[out->corner_count] = vertex;
  for (int k = 0; k < 3; k++)
    out->normal[out->corner_count][k] = (float)unit[k];
  return out->corner_count++;
}

static void add_triangle(fg_surface *out, int a, int b, int c)
{
  int *triangle = out->triangle[out->triangle_count++];
  triangle[0] = a;
  triangle[1] = b;
  triangle[2] = c;
}

/* Vertices of a section; returns the first. */
static int add_ring(fg_surface *out, const shape *s, int n)
{
  int first = out->vertex_count;
  for (int side = 0; side < SIDES; side++) {
    double away[3], position[3];
    radial(s, n, side, 0, away);
    fg__add_scaled(s->section[n].position, s->section[n].radius, away, position);
    add_vertex(out, position);
  }
  return first;
}

/* Corners of a ring with the normals of the tube's side there. */
static int add_side_corners(fg_surface *out, const shape *s, int n, int ring)
{
  int first = out->corner_count;
  for (int side = 0; side < SIDES; side++) {
    double normal[3];
    radial(s, n, side, 0, normal);
    fg__add_scaled(normal, -s->section[n].slope, s->tangent[n], normal);
    add_corner(out, ring + side, normal);
  }
  return first;
}

/* Corners of a ring that faces back along the line. */
static int add_back_corners(fg_surface *out, const shape *s, int n, int ring)
{
  int first = out->corner_count;
  const double back[3] = {-s->tangent[n][0], -s->tangent[n][1], -s->tangent[n][2]};
  for (int side = 0; side < SIDES; side++)
    add_corner(out, ring + side, back);
  return first;
}

/* The band between two rings of corners, the second farther along the line. */
static void add_band(fg_surface *out, int from, int to)
{
  for (int side = 0; side < SIDES; side++) {
    int next = (side + 1) % SIDES;
    add_triangle(out, from + side, from + next, to + next);
    add_triangle(out, from + side, to + next, to + side);
  }
}

static void add_tail(fg_surface *out, const shape *s, int ring)
{
  const double back[3] = {-s->tangent[0][0], -s->tangent[0][1], -s->tangent[0][2]};
  int corners = add_back_corners(out, s, 0, ring);
  int middle = add_corner(out, add_vertex(out, s->section[0].position), back);
  for (int side = 0; side < SIDES; side++)
    add_triangle(out, middle, corners + (side + 1) % SIDES, corners + side);
}

/* The tip has a corner for each side of the cone. */
static void add_tip(fg_surface *out, const shape *s, int corners)
{
  int last = s->count - 1, vertex = add_vertex(out, s->section[last].position);
  for (int side = 0; side < SIDES; side++) {
    double normal[3];
    radial(s, last, side, 0.5, normal);
    fg__add_scaled(normal, -s->section[last].slope, s->tangent[last], normal);
    int tip = add_corner(out, vertex, normal);
    add_triangle(out, corners + side, corners + (side + 1) % SIDES, tip);
  }
}

static void add_solid(fg_surface *out, const shape *s)
{
  int ring = add_ring(out, s, 0);
  add_tail(out, s, ring);
  int corners = add_side_corners(out, s, 0, ring);
  for (int n = 1; n + 1 < s->count; n++) {
    ring = add_ring(out, s, n);
    if (n == s->base + 1) { /* the back of the head, between two rings in one plane */
      int inner = add_back_corners(out, s, s->base, ring - SIDES);
      add_band(out, inner, add_back_corners(out, s, n, ring));
      corners = add_side_corners(out, s, n, ring);
      continue;
    }
    int next = add_side_corners(out, s, n, ring);
    add_band(out, corners, next);
    corners = next;
  }
  add_tip(out, s, corners);
}

static bool is_drawable(const fg_icon *icon)
{
  return icon->width > 0 && icon->tail_width > 0 && icon->head_length > 0 &&
         icon->head_width > icon->width && length_of(icon) > 0;
}

/* With memory for so much, all counts 0. */
static fg_status create(fg_surface **out, fg_context *context, size_t vertices,
                        size_t corners, size_t triangles)
{
  fg_surface *s = fg__allocate(1, sizeof *s);
  *out = s;
  if (s) {
    s->vertex = fg__allocate(vertices, sizeof *s->vertex);
    s->corner = fg__allocate(corners, sizeof *s->corner);
    s->normal = fg__allocate(corners, sizeof *s->normal);
    s->triangle = fg__allocate(triangles, sizeof *s->triangle);
    if (s->vertex && s->corner && s->normal && s->triangle)
      return FG_STATUS_OK;
  }
  fg_surface_destroy(s);
  *out = NULL;
  return fg__fail_memory(context, "a surface",
                         vertices * sizeof *s->vertex + triangles * sizeof *s->triangle);
}

/* Vertices lie as add_solid makes them: a ring, the tail's middle, the other rings, the
 * tip. */
static fg_status value_vertices(float **out, fg_context *context, const shape *s,
                                const fg_surface *solid)
{
  size_t count = (size_t)solid->vertex_count;
  *out = fg__allocate(count, sizeof **out);
  if (!*out)
    return fg__fail_memory(context, "an arrow", count * sizeof **out);
  for (int n = 0; n < solid->vertex_count; ++n) {
    int ring = n <= SIDES ? 0 : (n - 1) / SIDES;
    (*out)[n] = (float)s->section[ring].value;
  }
  return FG_STATUS_OK;
}

static fg_status make(fg_surface **out, float **at_vertex, fg_context *context,
                      const fg_icon *icon, const double *value)
{
  *out = NULL;
  if (!is_drawable(icon))
    return create(out, context, 0, 0, 0);
  shape s;
  fg_status status = create_shape(&s, context, icon, value);
  size_t rings = (size_t)s.count * SIDES;
  if (status == FG_STATUS_OK)
    status = create(out, context, rings + 2, 2 * rings + 1, 2 * rings);
  if (status == FG_STATUS_OK)
    add_solid(*out, &s);
  if (status == FG_STATUS_OK && at_vertex)
    status = value_vertices(at_vertex, context, &s, *out);
  clear_shape(&s);
  if (status != FG_STATUS_OK) {
    fg_surface_destroy(*out);
    *out = NULL;
  }
  return status;
}

static fg_status check(fg_context *context, const void *out, const fg_icon *icon)
{
  if (out && icon && icon->point_count >= 2)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "a solid: %s given",
                  out ? "no icon with points" : "no place for the result");
}

fg_status fg_icon_solid(fg_surface **out, fg_context *context, const fg_icon *icon)
{
  fg_status status = check(context, out, icon);
  return status ? status : make(out, NULL, context, icon, NULL);
}

fg_status fg__solid_with_values(fg_surface **out, float **at_vertex, fg_context *context,
                                const fg_icon *icon, const double *value)
{
  *at_vertex = NULL;
  fg_status status = check(context, out, icon);
  return status ? status : make(out, at_vertex, context, icon, value);
}

void fg_surface_destroy(fg_surface *surface)
{
  if (!surface)
    return;
  free(surface->vertex);
  free(surface->corner);
  free(surface->normal);
  free(surface->triangle);
  free(surface);
}
