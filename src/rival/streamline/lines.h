/* Long streamlines that keep their distance, in 2D or 3D, whatever finds their seeds. */
#ifndef FG__RIVAL_LINES_H
#define FG__RIVAL_LINES_H

#include "rival/line.h"
#include "rival/near.h"

/* Shorter lines, in separations, are left out. */
#define FG__LINES_SHORTEST 1.0

/* The part of the streamline through a seed between two arc lengths from there. */
typedef struct fg__lines_part {
  double seed[3];
  double from, to; /* from <= 0 <= to */
} fg__lines_part;

typedef struct fg__lines {
  double separation; /* of a seed from all lines before it, input coordinates */
  bool round;        /* lines go on past periodic boundaries */
  fg__lines_part *part;
  size_t capacity;
  int count;
} fg__lines;

void fg__lines_clear(fg__lines *lines);

/* The streamline that a line is part of, as far as `reach` either way from the seed and
 * one step more. MEMORY. */
fg_status fg__lines_trace(fg__line *out, fg_context *context, const fg__domain *domain,
                          const fg__lines *lines, const double seed[], double reach);

/* Points of a line at even arc lengths from its seed. */
typedef struct fg__lines_points {
  double (*position)[3], (*tangent)[3];
  size_t position_capacity, tangent_capacity;
  int count, seed; /* the seed's place among them */
  double step;
} fg__lines_points;

/* Lines that are being placed. */
typedef struct fg__placing {
  fg__lines *lines;
  fg_context *context;
  const fg__domain *domain;
  double test;             /* lines keep so far from each other, and from themselves */
  fg__near near;           /* points of the lines so far */
  fg__line line;           /* the line that was tried last, */
  fg__lines_points points; /* and its points, of which */
  int first, last;         /* these are kept */
} fg__placing;

/* Begins with no line. `test` is a share of the separation, at most 1; `round` as in
 * fg__lines. MEMORY. */
fg_status fg__placing_start(fg__placing *out, fg_context *context,
                            const fg__domain *domain, fg__lines *lines, double separation,
                            double test, bool round);
void fg__placing_end(fg__placing *placing);

/* Adds the line through a seed, unless a line passes nearer to it than the separation:
 * both ways as far as it keeps its distance. *kept: it was added; shorter ones are not.
 * MEMORY, STOPPED. */
fg_status fg__placing_try(fg__placing *placing, const double seed[], bool *kept);

/* Draws every line as an arrow, cut where it crosses a periodic boundary: its longest
 * piece and those no shorter than a line may be. MEMORY. */
fg_status fg__lines_draw(fg_icons *icons, fg_context *context, const fg__domain *domain,
                         const fg__lines *lines);

#endif
