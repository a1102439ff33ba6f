/* From a cluster to the line that a brush follows, and how broad the brush may be. */
#ifndef FG__LINE_H
#define FG__LINE_H

#include "brush/canvas.h"
#include "cluster/window.h"

/* Points evenly spaced, in pixels from the upper left corner; at most FG__LINE_POINTS. */
enum { FG__LINE_POINTS = 160 };
typedef struct fg__brush_line {
  int count; /* 0: the cluster makes no stroke */
  double point[FG__LINE_POINTS][2];
  double width;    /* of the brush */
  double color[3]; /* of the image along the line */
} fg__brush_line;

/* How a layer of strokes is to be. */
typedef struct fg__line_rule {
  double widening;  /* of strokes beyond their clusters */
  double tolerance; /* of colours under one stroke, as a distance in RGB */
} fg__line_rule;

/* The spine of a cluster, smoothed, cut where the image's colour leaves that of its
 * middle, with a brush narrowed until it stays within the tolerance. height: of the image
 * in pixels, as windows have y upwards. MEMORY, STOPPED. */
fg_status fg__line_create(fg__brush_line *out, fg_context *context,
                          const fg__window *window, const fg__brush_canvas *image,
                          const fg__line_rule *rule);

/* Mean distance between two canvases' colours along a line, or beside it by a quarter of
 * the brush's width where that is more. */
double fg__line_difference(const fg__brush_line *line, const fg__brush_canvas *one,
                           const fg__brush_canvas *other);

/* Whether under the inner half of the brush some place is not painted yet. */
bool fg__line_is_bare(const fg__brush_line *line, const fg__brush_canvas *painted);

#endif
