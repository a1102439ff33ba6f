/* What a map shows besides its arrows, as polygons on the page. */
#ifndef FG__MAP_SCENE_H
#define FG__MAP_SCENE_H

#include "picture/map/graticule.h"
#include "picture/page/page.h"

typedef struct fg__map_scene {
  bool coasts;               /* land and what follows from it is drawn */
  fg__polygons land, lakes;  /* areas, even-odd rule */
  fg__polygons shore, banks; /* lines along coasts and lakes */
  fg__polygons borders;      /* lines */
  fg__polygons missing;      /* areas without data, winding rule */
  bool missing_on_land;      /* they fade land, too, else the sea alone */
  bool missing_lakes;        /* lakes have no data */
  fg__polygons rim;          /* lines where the data end */
  fg__polygons graticule;    /* lines */
  fg__polygons outline;      /* a closed loop; empty where the frame is a box */
  bool contained;          /* land and lines end at the outline, and nothing is missing */
  fg__polygons arrow_rims; /* a loop an arrow: its outline, less finely */
} fg__map_scene;

typedef struct fg__map_layers {
  bool no_coast, borders, no_graticule;
} fg__map_layers;

/* MEMORY. */
fg_status fg__map_scene_create(fg__map_scene *out, fg_context *context,
                               const fg__page *page, const fg__graticule *graticule,
                               const fg_field *field, const fg__map_layers *layers);

/* Takes the arrows' outlines. MEMORY. */
fg_status fg__map_scene_rim(fg__map_scene *scene, fg_context *context,
                            const fg__polygons *arrows);

/* Whether a loop lies inside the frame and the outline: nothing of it would be clipped.
 */
bool fg__map_scene_holds(const fg__map_scene *scene, const fg__page *page,
                         const fg__polygons *loops, size_t loop);

/* Writes degrees inside the map where lines do not end at its rim: where they touch
 * neither each other nor arrows; else those that are needed stand over arrows, others
 * nowhere. */
void fg__map_scene_label(const fg__map_scene *scene, fg__page *page,
                         const fg__graticule *graticule, const fg__polygons *arrows,
                         cairo_t *ruler);
void fg__map_scene_clear(fg__map_scene *scene);

#endif
