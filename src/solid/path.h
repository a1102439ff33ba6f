/* Streamlines in 3D inside one cluster, by arc length: icon/streamline.h in space. */
#ifndef FG__PATH_H
#define FG__PATH_H

#include "base/context.h"
#include "cluster/volume.h"

typedef struct fg__path_node {
  double s;           /* arc length from the first node */
  double position[3]; /* input coordinates */
  double tangent[3];  /* unit, along the flow */
  double turning;     /* angles between successive tangents added up, radians */
} fg__path_node;

/* Between two nodes the cubic with these end points and (unit) end tangents. */
typedef struct fg__path {
  fg__path_node *node; /* ascending s, in the direction of the flow */
  int count;
  size_t capacity;
  int start; /* index of the node at the start point */
} fg__path;

typedef struct fg__path_limits {
  double step;    /* longest step: at most a cell of the data */
  double length;  /* longest arc each way */
  double turning; /* greatest turning each way, radians */
} fg__path_limits;

/* Traces the streamline of fg_field_tangent through `start` both ways, to the border of
 * {level > 0} of the window, which is located by bisection; count is 0 where there is
 * none. `out` is all zero or a path to reuse. Bogacki and Shampine's embedded 3(2) pair
 * (1989), as in 2D. MEMORY. */
fg_status fg__path_trace(fg__path *out, fg_context *context, const fg_field *field,
                         const fg__volume *volume, const double start[3],
                         const fg__path_limits *limits);
void fg__path_clear(fg__path *path);

/* Position and unit tangent at arc length s, clamped; `hint`, unless NULL, is the index
 * of a node to start from and is kept up to date. Returns the turning there. */
double fg__path_at(const fg__path *path, double s, int *hint, double position[3],
                   double tangent[3]);
double fg__path_length(const fg__path *path);

/* Points at even steps from one arc length to another, at least 9: pieces are no longer
 * than `spacing`, and share `turning`, that of the part, at 5 degrees each at most.
 * *points is allocated: free it. MEMORY. */
fg_status fg__path_points(double (**points)[3], int *count, fg_context *context,
                          const fg__path *path, double from, double to, double turning,
                          double spacing);

#endif
