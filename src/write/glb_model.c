#include "write/glb_model.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/arrow_speeds.h"
#include "picture/caption.h"
#include "picture/palette.h"

/* What arrows are coloured by. */
typedef struct coloring {
  const fg_field *field;
  fg__palette palette;
  double range[2];
} coloring;

/* sRGB to linear light (IEC 61966-2-1). */
static double linear(double level)
{
  return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

static void set_color(double out[3], fg__color color)
{
  out[0] = linear(color.red);
  out[1] = linear(color.green);
  out[2] = linear(color.blue);
}

/* NULL when there is no memory. */
static fg__glb_part *begin_part(fg__glb_model *m, const char *name, int mode,
                                fg__color color)
{
  if (!fg__grow((void **)&m->part, &m->part_capacity, m->parts + 1, sizeof *m->part))
    return NULL;
  fg__glb_part *out = &m->part[m->parts++];
  *out = (fg__glb_part){.name = name,
                        .mode = mode,
                        .opacity = 1.0,
                        .first = m->places,
                        .first_normal = m->normals,
                        .first_color = m->colors,
                        .first_index = m->indices,
                        .low = {FLT_MAX, FLT_MAX, FLT_MAX},
                        .high = {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
  set_color(out->color, color);
  return out;
}

static int accessors_of(const fg__glb_part *p)
{
  return p->mode == FG__GLB_TRIANGLES ? 3 + p->colored : 2;
}

static void end_part(fg__glb_model *m)
{
  fg__glb_part *ended = &m->part[m->parts - 1];
  if (ended->index_count == 0)
    m->parts--;
  else if (m->parts > 1)
    ended->accessor = ended[-1].accessor + accessors_of(&ended[-1]);
}

/* Both are false when there is no memory. */
static bool add_place(fg__glb_model *m, fg__glb_part *to, const double position[3])
{
  if (!fg__grow((void **)&m->place, &m->place_capacity, m->places + 1, sizeof *m->place))
    return false;
  float *place = m->place[m->places++];
  for (int k = 0; k < 3; ++k) {
    place[k] = (float)(position[k] - m->center[k]);
    to->low[k] = fminf(to->low[k], place[k]);
    to->high[k] = fmaxf(to->high[k], place[k]);
  }
  to->count++;
  return true;
}

static bool add_index(fg__glb_model *m, fg__glb_part *to, size_t index)
{
  if (!fg__grow((void **)&m->index, &m->index_capacity, m->indices + 1, sizeof *m->index))
    return false;
  m->index[m->indices++] = (uint32_t)index;
  to->index_count++;
  return true;
}

static bool add_surface(fg__glb_model *m, fg__glb_part *to, const fg_surface *s)
{
  bool room = fg__grow((void **)&m->normal, &m->normal_capacity,
                       m->normals + (size_t)s->corner_count, sizeof *m->normal);
  for (int n = 0; n < s->corner_count && room; ++n) {
    memcpy(m->normal[m->normals++], s->normal[n], sizeof *m->normal);
    room = add_place(m, to, s->vertex[s->corner[n]]);
  }
  for (int n = 0; n < s->triangle_count && room; ++n)
    for (int k = 0; k < 3 && room; ++k)
      room = add_index(m, to, (size_t)s->triangle[n][k]);
  return room;
}

static double share_of(const coloring *by, double speed)
{
  return (speed - by->range[0]) / (by->range[1] - by->range[0]);
}

/* speed: of each vertex of the surface. */
static bool add_colors(fg__glb_model *m, fg__glb_part *to, const fg_surface *s,
                       const float *speed, const coloring *by)
{
  if (!fg__grow((void **)&m->color, &m->color_capacity,
                m->colors + (size_t)s->corner_count, sizeof *m->color))
    return false;
  for (int n = 0; n < s->corner_count; ++n) {
    const double share = share_of(by, (double)speed[s->corner[n]]);
    double color[3];
    set_color(color, fg__palette_color(&by->palette, share));
    for (int k = 0; k < 3; ++k)
      m->color[m->colors][k] = (float)color[k];
    m->colors++;
  }
  set_color(to->color, (fg__color){1.0, 1.0, 1.0});
  to->colored = true;
  return true;
}

static bool add_line(fg__glb_model *m, fg__glb_part *to, const double (*line)[3],
                     int count)
{
  bool room = true;
  for (int n = 0; n < count && line && room; ++n) {
    room = add_place(m, to, line[n]);
    if (n > 0)
      room = room && add_index(m, to, to->count - 2) && add_index(m, to, to->count - 1);
  }
  return room;
}

typedef enum line_kind { SPINES, STREAMLINES, CENTERS, LINE_KINDS } line_kind;

static bool add_lines(fg__glb_model *m, const fg_icons *icons, line_kind kind)
{
  static const char *const names[] = {"spines", "streamlines", "centres"};
  static const fg__color colors[] = {
      {0.45, 0.45, 0.45}, {0.62, 0.62, 0.62}, {0.2, 0.2, 0.2}};
  fg__glb_part *to = begin_part(
      m, names[kind], kind == CENTERS ? FG__GLB_POINTS : FG__GLB_LINES, colors[kind]);
  bool room = to != NULL;
  for (int n = 0; n < fg_icons_count(icons) && room; ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    if (kind == SPINES)
      room = add_line(m, to, icon->spine, icon->spine_count);
    else if (kind == STREAMLINES)
      room = add_line(m, to, icon->streamline, icon->streamline_count);
    else
      room = add_place(m, to, icon->center) && add_index(m, to, to->count - 1);
  }
  if (room)
    end_part(m);
  return room;
}

/* Numbers of single precision are finest near 0: that is the middle of the icons. */
static void find_center(fg__glb_model *m, const fg_icons *icons)
{
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < fg_icons_count(icons); ++n)
    for (int k = 0; k < 3; ++k) {
      low[k] = fmin(low[k], fg_icons_at(icons, n)->center[k]);
      high[k] = fmax(high[k], fg_icons_at(icons, n)->center[k]);
    }
  for (int k = 0; k < 3; ++k)
    m->center[k] = high[k] >= low[k] ? (low[k] + high[k]) / 2.0 : 0.0;
}

/* Its vertices have colours where they differ. */
static fg_status add_arrow(fg__glb_model *m, fg_context *context, const fg_icon *icon,
                           const coloring *by)
{
  fg_surface *solid;
  float *speed;
  fg_status status = fg__arrow_solid(&solid, &speed, context, by->field, icon);
  if (status)
    return status;
  fg__glb_part *to =
      begin_part(m, NULL, FG__GLB_TRIANGLES, fg__palette_color(&by->palette, 0.0));
  bool room = to && add_surface(m, to, solid);
  if (room && speed && !by->palette.uniform)
    room = add_colors(m, to, solid, speed, by);
  free(speed);
  fg_surface_destroy(solid);
  if (!room)
    return fg__fail_memory(context, "icons to write", m->places * sizeof *m->place);
  to->icon = icon;
  end_part(m);
  return FG_STATUS_OK;
}

static fg_status add_arrows(fg__glb_model *m, fg_context *context, const fg_field *field,
                            const fg_icons *icons, const fg_solid_options *options)
{
  coloring by = {.field = field, .range = {options->speed_min, options->speed_max}};
  fg_status status = fg__palette_create(&by.palette, context, options->palette);
  if (!status && !(by.range[1] > by.range[0]))
    status = fg_solid_speed_range(by.range, context, field, icons);
  fg__speed_range(by.range, icons);
  for (int n = 0; n < fg_icons_count(icons) && !status; ++n)
    status = add_arrow(m, context, fg_icons_at(icons, n), &by);
  return status;
}

/* All clusters' surfaces in one mesh, in the colour that they have in pictures. */
static fg_status add_clusters(fg__glb_model *m, fg_context *context,
                              const fg_surface *surface)
{
  static const fg__color color = {0.36, 0.52, 0.72};
  fg__glb_part *to = begin_part(m, "clusters", FG__GLB_TRIANGLES, color);
  if (!to || !add_surface(m, to, surface))
    return fg__fail_memory(context, "clusters to write", m->places * sizeof *m->place);
  to->opacity = 0.25;
  end_part(m);
  return FG_STATUS_OK;
}

size_t fg__glb_bytes(const fg__glb_model *m)
{
  return (m->places + m->normals + m->colors) * sizeof *m->place + m->indices * 4;
}

fg_status fg__glb_collect(fg__glb_model *m, fg_context *context, const fg_field *field,
                          const fg_icons *icons, const fg_solid_options *options)
{
  find_center(m, icons);
  bool room = true;
  for (int kind = 0; kind < LINE_KINDS && room; ++kind)
    room = add_lines(m, icons, (line_kind)kind);
  if (!room)
    return fg__fail_memory(context, "icons to write", m->places * sizeof *m->place);
  fg_status status = add_arrows(m, context, field, icons, options);
  if (!status && options->surface)
    status = add_clusters(m, context, options->surface);
  /* chunks have 32 bits for their length */
  const size_t bytes = fg__glb_bytes(m);
  if (!status && bytes > UINT32_MAX / 2)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "glTF: %zu bytes of geometry, more than a file can hold", bytes);
  return status;
}

void fg__glb_clear(fg__glb_model *m)
{
  free(m->place);
  free(m->normal);
  free(m->color);
  free(m->index);
  free(m->part);
}
