/* Puts a page and its scene on a Cairo surface. */
#ifndef FG__DRAW_H
#define FG__DRAW_H

#include "picture/map/page_map.h"
#include "picture/page/scene.h"
#include "picture/page/symbols.h"
#include "picture/surface/surface.h"

typedef struct fg__style {
  fg__color mask, tint;
  cairo_surface_t *background; /* NULL: none */
  bool on_speeds;              /* it shows speeds, and is pale */
  fg__page_box background_box; /* of the domain, which may be wider than the frame */
  fg__map_style map_style;
  const fg__map_scene *map;           /* NULL: what is drawn lies on no map */
  const fg__map_cover *cover;         /* of a background on a map; NULL: none */
  const fg_critical_points *critical; /* NULL: none */
  double low[2];                      /* of the frame, in the field's coordinates */
} fg__style;

/* A light grey. */
extern const fg__color fg__default_mask;

/* What is masked, with its coast. */
void fg__draw_mask(cairo_t *cairo, const fg__polygons *mask, fg__color color);

/* Adds polygons to the path. */
void fg__draw_path(cairo_t *cairo, const fg__polygons *polygons);

/* Fills the bar of a colour key with the palette; its ends have points of such lengths,
 * the first at the low end. Its outline stays the path. */
void fg__draw_ramp(cairo_t *cairo, const fg__page_box *key, bool upright,
                   const double point[2], const fg__palette *palette);

/* The bar of a page's colour key and its ticks. */
void fg__draw_key(cairo_t *cairo, const fg__page *page, const fg__palette *palette);

/* All texts of a page, above what was drawn before; in SVG as texts unless as shapes. */
void fg__draw_texts(fg__surface_file *surface, const fg__page *page, bool shapes);

/* White under all. */
void fg__draw_white(cairo_t *cairo);

/* What lies inside a page's frame, in points; what went wrong is in the context's status.
 */
void fg__draw_inside(cairo_t *cairo, const fg__page *page, const fg__scene *scene,
                     const fg__style *style);

/* What lies round it but for texts: keys, a map's outline, the frame and its ticks.
 * reference: the arrow of the size key. */
void fg__draw_round(cairo_t *cairo, const fg__page *page, const fg__palette *palette,
                    const fg__style *style, const fg__polygons *reference);

#endif
