/* Streamlines inside one cluster, by arc length, in 2D or 3D. */
#ifndef FG__STREAMLINE_H
#define FG__STREAMLINE_H

#include "base/context.h"
#include "cluster/window.h"

/* Between two nodes a streamline is the cubic with these end points and (unit) end
 * tangents. */
typedef struct fg__streamline_node {
  double s;           /* arc length from the first node */
  double position[3]; /* input coordinates; z = 0 in 2D */
  double tangent[3];  /* unit, along the flow */
  double turning;     /* radians, continuous, 0 at the first node: in 2D the angle of the
                         tangent, in 3D angles between successive tangents added up */
} fg__streamline_node;

typedef enum fg__streamline_end {
  FG__STREAMLINE_LEFT = 0, /* at the boundary of the cluster, of a mask or the domain */
  FG__STREAMLINE_SINGULAR, /* the velocity vanishes or its direction jumps */
  FG__STREAMLINE_TURNED,   /* the limit of turning */
  FG__STREAMLINE_LONG      /* the limit of length */
} fg__streamline_end;

typedef struct fg__streamline {
  int dimension;
  fg__streamline_node *node; /* ascending s, in the direction of the flow */
  int count;
  size_t capacity;
  int start;                 /* index of the node at the start point */
  fg__streamline_end end[2]; /* why it ends: upstream, downstream */
} fg__streamline;

typedef struct fg__streamline_limits {
  double step;    /* longest step, input coordinates: at most a cell of the data */
  double length;  /* longest arc each way */
  double turning; /* largest difference in turning between two nodes of one way */
} fg__streamline_limits;

/* Traces the streamline of fg_field_tangent through `start` both ways, to the boundary of
 * {level > 0} of the window, which is located by bisection. A start outside the cluster,
 * or where the velocity vanishes, gives count 0. `out` is all zero or a streamline to
 * reuse. Bogacki and Shampine's embedded 3(2) pair (1989): the field is only continuous
 * (linear along each axis), so a higher order would be lost at each boundary of data
 * cells. MEMORY. */
fg_status fg__streamline_trace(fg__streamline *out, fg_context *context,
                               const fg_field *field, const fg__window *window,
                               const double start[], const fg__streamline_limits *limits);
void fg__streamline_clear(fg__streamline *streamline);

/* Position and unit tangent, which may be NULL, at arc length s, clamped to the line;
 * `hint`, when not NULL, is the index of a segment to start from and is kept up to date.
 * Returns the turning there. */
double fg__streamline_at(const fg__streamline *streamline, double s, int *hint,
                         double position[3], double tangent[3]);

/* Total arc length. */
double fg__streamline_length(const fg__streamline *streamline);

#endif
