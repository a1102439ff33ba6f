/* A map's degrees round its frame, and its drawing. */
#ifndef FG__PAGE_MAP_H
#define FG__PAGE_MAP_H

#include "picture/map/map_scene.h"
#include "picture/palette.h"

/* Writes the degrees of the plan's graticule round the frame, and reports the room that
 * takes. None touches another. */
void fg__page_place_graticule(fg__page *page, fg__margins *room,
                              const fg__page_plan *plan, cairo_t *ruler);

/* The colours of a map. */
typedef struct fg__map_style {
  fg__color land;
  fg__color missing;
  bool transparent; /* no white under anything */
  bool on_texture;  /* coasts must stand out from one */
} fg__map_style;

extern const fg__color fg__usual_land, fg__usual_missing;

/* Adds the outline to the clip, where there is one. */
void fg__map_clip(cairo_t *cairo, const fg__map_scene *scene);

/* Land and lakes. within: only inside these loops (winding rule), where data are
 * missing; NULL: everywhere. */
void fg__map_draw_land(cairo_t *cairo, const fg__map_scene *scene,
                       const fg__map_style *style, const fg__polygons *within);

/* Coasts, borders, graticule, and where data are missing. */
void fg__map_draw_lines(cairo_t *cairo, const fg__map_scene *scene,
                        const fg__map_style *style);

/* The outline, and what lies under texts. */
void fg__map_draw_outline(cairo_t *cairo, const fg__map_scene *scene,
                          const fg__map_style *style);

#endif
