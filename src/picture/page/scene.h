/* What a picture shows inside its frame, as polygons on the page. */
#ifndef FG__SCENE_H
#define FG__SCENE_H

#include "flowgrain/picture.h"
#include "picture/contour.h"
#include "picture/page/page.h"
#include "picture/palette.h"

typedef struct fg__scene {
  fg__polygons mask;   /* masked places */
  fg__polygons tint;   /* clusters */
  fg__polygons arrows; /* a loop each */
  fg__color *arrow_color;
  fg__polygons spines;  /* an open line each */
  fg__polygons centers; /* a point each */
} fg__scene;

/* The field's box in its coordinates, x then y. */
void fg__scene_box(double low[2], double high[2], const fg_field_arrays *field);

/* The part of that box that a framed picture shows: where a field is valid, with a
 * margin, when that is much smaller. A side with a period is shown whole. */
void fg__scene_shown(double low[2], double high[2], const fg_field *field);

/* Icons that the frame shows: copies of those whose head and half of whose line lie in it
 * and in the outline, which is empty where the frame is a box; NULL where that is all. A
 * score is of all and not kept. MEMORY. */
fg_status fg__scene_keep_shown(fg_icons **out, fg_context *context,
                               const fg_field_arrays *field, const fg_icons *icons,
                               const double low[2], const double high[2],
                               const fg__polygons *outline);

/* The median length, and an icon whose width is the median in units of its length; 0 and
 * NULL without icons. */
typedef struct fg__typical_icon {
  double length;
  const fg_icon *shape; /* borrowed */
} fg__typical_icon;

/* Of all panels' icons together. MEMORY. */
fg_status fg__scene_typical_icon(fg__typical_icon *out, fg_context *context,
                                 const fg_panel *panel, int panels);

/* The arrow of a page's size key, in the shape of a typical one; nothing where there is
 * no such key. MEMORY. */
fg_status fg__scene_reference(fg__polygons *out, fg_context *context,
                              const fg__page *page, const fg__typical_icon *typical);

/* The outlines of what is masked, smoothed, on the page: of it the frame, whose lower
 * left corner is `low` in the field's coordinates, and the scale are read. outline: of a
 * map, beyond which nothing counts as missing; NULL or empty: none. MEMORY. */
fg_status fg__scene_mask(fg__polygons *out, fg_context *context, const fg__page *page,
                         const fg_field *field, const double low[2],
                         const fg__polygons *outline);

/* Makes the polygons, but for the mask, spines and centres. low, high: what
 * the frame shows, in the field's coordinates. density: NULL for no tint; icons: NULL for
 * no arrows. range: speeds at the palette's ends. MEMORY. */
fg_status fg__scene_create(fg__scene *out, fg_context *context, const fg__page *page,
                           const fg_field *field, const double low[2],
                           const double high[2], const fg_density_arrays *density,
                           const fg_icons *icons, const fg__palette *palette,
                           const double range[2]);
/* Adds the centres of the icons that have a spine, and when `spines` the spines. MEMORY.
 */
fg_status fg__scene_add_skeletons(fg__scene *scene, fg_context *context,
                                  const fg__page *page, const fg_field_arrays *field,
                                  const double low[2], const double high[2],
                                  const fg_icons *icons, bool spines);
void fg__scene_clear(fg__scene *scene);

#endif
