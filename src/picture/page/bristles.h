/* A brush stroke as it is painted: its body and the traces of its bristles. */
#ifndef FG__BRISTLES_H
#define FG__BRISTLES_H

#include "flowgrain/brush.h"

/* Takes a polygon in pixels of the image, with its colour. */
typedef void fg__polygon_sink(void *closure, const double (*point)[2], int count,
                              const double color[3], double opacity);

/* Paints one stroke as polygons, in the order in which they lie on each other. */
void fg__stroke_paint(const fg_stroke *stroke, fg__polygon_sink *sink, void *closure);

#endif
