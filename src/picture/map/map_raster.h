/* Marks on a raster of what a map's frame shows. */
#ifndef FG__MAP_RASTER_H
#define FG__MAP_RASTER_H

#include "picture/map/plane.h"

/* Nodes along the frame's longer side. */
enum { FG__MAP_RASTER_NODES = 400 };

typedef struct fg__map_raster {
  int size[2];
  double low[2], spacing[2];
  unsigned char *node;    /* marks, bits */
  unsigned char *scratch; /* a number a node, as steps of an algorithm need it */
  int *list;              /* room for all nodes */
  float *level;           /* likewise */
} fg__map_raster;

/* Without marks. False: no memory; clear it in any case. */
bool fg__map_raster_create(fg__map_raster *out, const fg__plane *plane);
void fg__map_raster_clear(fg__map_raster *raster);

size_t fg__map_raster_nodes(const fg__map_raster *raster);
size_t fg__map_raster_at(const fg__map_raster *raster, int i, int j);

/* The eight nodes round one, those beside it first. Returns how many there are. */
int fg__map_raster_round(size_t out[8], const fg__map_raster *raster, size_t n);

/* Marks the nodes that lie in polygons, by the even-odd rule. False: no memory. */
bool fg__map_raster_mark(fg__map_raster *raster, const fg__polygons *polygons,
                         unsigned char what);

/* scratch, 0 or 1, becomes 1 wherever it was within `reach` nodes along either axis. */
void fg__map_raster_dilate(fg__map_raster *raster, int reach);

#endif
