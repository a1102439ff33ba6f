/* A map's degrees round its frame, and its drawing. */
#ifndef FG__PAGE_MAP_H
#define FG__PAGE_MAP_H

#include "picture/map/map_scene.h"
#include "picture/palette.h"

/* Writes the degrees of the plan's graticule round the frame, at the sides that the parts
 * name, and reports the room that takes. None touches another. Those round a disc belong
 * to no side. */
void fg__page_place_graticule(fg__page *page, fg__margins *room,
                              const fg__page_plan *plan, const fg__page_parts *parts,
                              cairo_t *ruler);

/* The colours of a map. */
typedef struct fg__map_style {
  fg__color land;
  fg__color missing;
  bool transparent; /* no white under anything */
  bool on_texture;  /* coasts must stand out from one */
} fg__map_style;

extern const fg__color fg__default_land, fg__default_missing;

/* Adds the outline to the clip, where there is one. */
void fg__map_clip(cairo_t *cairo, const fg__map_scene *scene);

/* What on a texture shows that data are missing (winding rule). */
typedef struct fg__map_cover {
  fg__polygons exact;  /* land is drawn inside of these loops, */
  fg__polygons smooth; /* and of these, which cover the texture, too */
} fg__map_cover;

/* Makes smooth loops of the exact ones, as smooth as is seen in a box. MEMORY. */
fg_status fg__map_cover_smooth(fg__map_cover *cover, fg_context *context,
                               const double low[2], const double high[2]);
void fg__map_cover_clear(fg__map_cover *cover);

/* Land and lakes: everywhere, but on a texture (cover) of data that are there on land,
 * too, only where they are missing. */
void fg__map_draw_land(cairo_t *cairo, const fg__map_scene *scene,
                       const fg__map_style *style, const fg__map_cover *cover);

/* Coasts, borders, graticule, and where data are missing. */
void fg__map_draw_lines(cairo_t *cairo, const fg__map_scene *scene,
                        const fg__map_style *style);

/* The outline where it is in an image of such a size, and the image's edge where that is
 * in the outline. */
void fg__map_draw_outline_in(cairo_t *cairo, const fg__map_scene *scene, double width,
                             double height);

void fg__map_draw_outline(cairo_t *cairo, const fg__map_scene *scene);

#endif
