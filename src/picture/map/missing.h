/* Where a field on a map has no data, as far as land does not explain it. */
#ifndef FG__MISSING_H
#define FG__MISSING_H

#include "picture/map/plane.h"

typedef struct fg__missing {
  fg__polygons area; /* closed loops, winding rule; field's coordinates */
  bool on_land;      /* some of it is land that other data of the field cover */
  bool lakes;        /* lakes have no data either, though the sea has */
  fg__polygons rim;  /* open lines where the data end: none along coasts and the frame */
} fg__missing;

/* Of a field that is there on the sea alone, the sea without data; of others all places
 * without. What lies within about a sixtieth of the frame from data, as strips that grids
 * leave along coasts, and small parts do not count. land, lakes: as fg__land_trace gives
 * areas. Of a field of the sea areas go on under land a little. MEMORY. */
fg_status fg__missing_find(fg__missing *out, fg_context *context, const fg__plane *plane,
                           const fg_field *field, const fg__polygons *land,
                           const fg__polygons *lakes);
void fg__missing_clear(fg__missing *missing);

#endif
