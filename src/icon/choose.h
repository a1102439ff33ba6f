/* Which streamline stands for a cluster, in 2D or 3D. */
#ifndef FG__CHOOSE_H
#define FG__CHOOSE_H

#include "icon/arrow.h"
#include "skeleton/spine.h"

/* What choices work with, to be kept from cluster to cluster; all zero at first. */
typedef struct fg__chooser {
  const struct fg__territory *territory; /* whose windows it gets; NULL: clusters' */
  bool to_ends; /* arrows of thin clusters go to the ends of their lines */
  fg__streamline best, tried;
  fg__arc_samples samples;
  double (*point)[3]; /* of the cluster, evenly distributed */
  size_t point_capacity;
  int point_count;
  unsigned char *passed; /* 2D: nodes near which a line was tried */
  size_t passed_capacity;
} fg__chooser;

/* Tries streamlines through the spine's middle, through other points of it and through
 * points beside it, fits an arrow to each, and keeps in chooser->best the one whose arrow
 * lies nearest to all of the cluster: the smallest mean square distance, which a
 * long arrow through the middle has. No arrow fits: arrow->width is 0. MEMORY. */
fg_status fg__choose_arrow(fg__arrow *arrow, fg__chooser *chooser, fg_context *context,
                           const fg_field *field, const fg__interior *interior,
                           const fg__spine *spine);
void fg__chooser_clear(fg__chooser *chooser);

/* How long an arrow becomes that shall reach to the ends of its line: in a territory, or
 * where the chooser says so and the cluster is thin, by the distance from the spine's
 * middle to its boundary; 0: an arrow that is seen best is enough. */
double fg__stretched_length(const fg__chooser *chooser, const fg__interior *interior,
                            const fg__spine *spine);

/* Lengthens an arrow to the ends of its line, to that length and the largest turning at
 * most and with a margin before each end, and slims a fat one. */
void fg__arrow_stretch(fg__arrow *arrow, const fg__streamline *line, double longest,
                       double margin);

/* A choice under way. */
typedef struct fg__choice {
  fg__chooser *chooser;
  fg_context *context;
  const fg_field *field;
  const fg__interior *interior;
  fg__streamline_limits limits;
  double radius;    /* distance from the spine's middle to the boundary */
  double stretched; /* fg__stretched_length */
  double reach;     /* square of the distance that an arrow stands for */
  int passed_reach; /* in nodes */
  fg__arrow arrow;  /* best so far */
  double cost;
} fg__choice;

/* Tries the streamline through a point. MEMORY. */
fg_status fg__choice_try(fg__choice *choice, const double start[3]);

/* Whether a line in 2D has passed near a point, or the point lies outside the window. */
bool fg__choice_has_passed(const fg__choice *choice, const double point[2]);

/* starts.c: where streamlines begin. Tries them all. MEMORY. */
fg_status fg__choice_try_starts(fg__choice *choice, const fg__spine *spine);

#endif
