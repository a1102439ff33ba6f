/* A streamline of the domain by arc length, in 2D or 3D. */
#ifndef FG__RIVAL_LINE_H
#define FG__RIVAL_LINE_H

#include "icon/streamline.h"
#include "rival/domain.h"

typedef struct fg__line {
  fg__streamline traced;
  int count;       /* nodes; below 2 there is no line */
  double start;    /* arc length of the start point; 0 at the upstream end */
  bool goes_on[2]; /* upstream, downstream: the limit of length alone has ended it */
} fg__line;

typedef struct fg__line_limits {
  double length;  /* longest arc each way */
  double turning; /* greatest turning each way, radians; in 3D of angles added up */
} fg__line_limits;

/* Traces the streamline through `start` both ways inside the room. `out` is all zero or a
 * line to use again. MEMORY. */
fg_status fg__line_trace(fg__line *out, fg_context *context, const fg__domain *domain,
                         const fg__extent *room, const double start[],
                         const fg__line_limits *limits);
void fg__line_clear(fg__line *line);

double fg__line_length(const fg__line *line);

/* Position and unit tangent at arc length s, clamped to the line; z = 0 in 2D; `hint` as
 * fg__streamline_at. */
void fg__line_at(const fg__line *line, double s, int *hint, double position[3],
                 double tangent[3]);

/* How far the line turns between two arc lengths, radians. */
double fg__line_turning(const fg__line *line, double from, double to);

/* Points of a part, to be drawn with straight pieces no longer than `spacing`. *points is
 * allocated: free it; NULL where the part is too short. MEMORY. */
fg_status fg__line_points(double (**points)[3], int *count, fg_context *context,
                          const fg__line *line, double from, double to, double spacing);

#endif
