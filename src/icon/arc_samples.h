/* A streamline at even steps of arc length, with the clearance of an arrow on it. */
#ifndef FG__ARC_SAMPLES_H
#define FG__ARC_SAMPLES_H

#include "icon/streamline.h"

typedef struct fg__arc_sample {
  double s; /* arc length */
  double position[3], tangent[3];
  double turning;   /* angle turned since the first sample, radians */
  double clearance; /* 2D: free way to the nearer side, less the margin; 3D: radius of the
                       free ball; negative: none */
  double bend;     /* angle turned within a width to either side (fg__arc_samples_bend) */
  double bend_sum; /* of squared bends before this sample */
  double share;    /* of the way from the tail's width to the full one that fits here */
  int earliest;    /* no arrow ending here begins before this one */
} fg__arc_sample;

/* All zero at first; can be used again and again. */
typedef struct fg__arc_samples {
  fg__arc_sample *sample;
  size_t capacity;
  int count;
  double step;        /* arc length between two of them */
  double bend_window; /* arc length over which bends are taken */
} fg__arc_samples;

/* The inside of a cluster, where an arrow may lie. */
typedef struct fg__interior {
  const fg__window *window;
  const double *distance; /* the window's distance map */
  double spacing;         /* of the density: the yardstick of readability */
  double margin;          /* between the outline and the window's zero set, in 2D */
  const struct fg__territory *territory; /* which it is one of; NULL: it is a cluster */
} fg__interior;

/* In 2D the distance map is of first order near corners: that many spacings of it are not
 * relied on. */
#define FG__DISTANCE_ERROR 0.75

/* The distance map at a point, linear along each axis; that of the nearest point outside
 * the window. */
double fg__interior_distance(const fg__interior *interior, const double position[]);

/* Whether a point in 2D lies inside, margin not counted. */
bool fg__interior_has(const fg__interior *interior, double x, double y);

/* Places so many samples and one more all along a line; clearance stays unset. MEMORY. */
fg_status fg__arc_samples_place(fg__arc_samples *samples, fg_context *context,
                                const fg__streamline *line, int intervals);

/* The same in 2D in a number that suits an arrow, and looks to both sides of each, at
 * most `reach` far. MEMORY. */
fg_status fg__arc_samples_place_flat(fg__arc_samples *samples, fg_context *context,
                                     const fg__streamline *line,
                                     const fg__interior *interior, double reach);

/* Sets bend and bend_sum for arrows of a width. */
void fg__arc_samples_bend(fg__arc_samples *samples, double width);

void fg__arc_samples_clear(fg__arc_samples *samples);

#endif
