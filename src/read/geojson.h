/* Icons of a file of GeoJSON. */
#ifndef FG__GEOJSON_H
#define FG__GEOJSON_H

#include "flowgrain/flowgrain.h"
#include "read/format.h"

typedef struct fg__icon_list {
  fg_icon *icon; /* owned, as the points of each are */
  size_t count, capacity;
  int clusters, dropped, next_id;
  char *projection; /* of the plane that the points are of, owned; NULL: not told */
  bool scored;      /* the file tells the error of its icons: */
  fg_score score;
} fg__icon_list;

/* Reads a FeatureCollection of lines. Clear it also after a failure. FILE_FORMAT,
 * UNSUPPORTED (too large), MEMORY. */
fg_status fg__icon_list_read(fg__icon_list *out, fg_context *context,
                             const fg__source *source);
void fg__icon_list_clear(fg__icon_list *list);

#endif
