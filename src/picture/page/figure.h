/* A figure: one or more panels that show the same map or box, with a caption and keys for
 * all, and where everything lies on its page. */
#ifndef FG__FIGURE_H
#define FG__FIGURE_H

#include "picture/page/draw.h"

/* What is drawn of a panel. */
typedef struct fg__figure_panel {
  fg__page page; /* of one of several; what lies round its frame */
  fg__style style;
  fg__scene scene;
  fg__map_scene map;
  fg__map_cover cover; /* of a background on a map: what the scene's mask covers */
  fg_icons *shown;     /* NULL: all that were given */
  const fg_critical_points *critical; /* of the icons that were given; NULL: none */
} fg__figure_panel;

typedef struct fg__figure {
  fg_panel *given; /* with the icons that are shown; what it points to is borrowed */
  int count;
  fg__page_plan plan;
  fg__page page;
  fg__figure_panel *panel;
  char (*label)[FG__PAGE_TEXT_BYTES];
  fg__palette palette; /* of the speeds; of a background that shows them, in bands */
  fg__palette arrows;  /* of the arrows' speeds */
  fg__plane plane;     /* of fields on the Earth */
  fg__graticule graticule;
  double low[2], high[2]; /* what the frames show, in the fields' coordinates */
  fg__typical_icon typical;
  fg__polygons reference; /* the arrow of the size key */
  double pixels_per_point;
  bool outline_text, transparent;
} fg__figure;

/* Lays a figure out; nothing is drawn yet. several: panels with labels, even if it is
 * one; else count is 1. ARGUMENT, UNSUPPORTED, MEMORY; end with fg__figure_destroy, also
 * after a failure, where *out may be NULL. */
fg_status fg__figure_create(fg__figure **out, fg_context *context, const fg_panel *panel,
                            int count, bool several, const fg_picture_options *options);
void fg__figure_destroy(fg__figure *figure);

/* The page on which panel k lies, in points of the whole figure. */
fg__page *fg__figure_page(fg__figure *figure, int k);

/* Whether its background is of FG_TEXTURE_SPEED. */
bool fg__figure_shows_speeds(const fg__figure *figure);

#endif
