/* Where a cluster's window crosses periodic boundaries of the domain, and which of the
 * pieces between them get icons of their own. In 2D and 3D alike. */
#ifndef FG__PIECES_H
#define FG__PIECES_H

#include "cluster/window.h"

/* Nodes of a window along one axis between two neighbouring boundaries of the domain. */
typedef struct fg__stretch {
  int first, last; /* of the window, both included */
  int start;       /* the first on the density's grid, in [0, period] */
} fg__stretch;

/* A piece of a window's nodes, and its share of the cluster: those of all pieces that
 * were found are 1 together. */
typedef struct fg__piece {
  fg__stretch range[3];
  double share;
} fg__piece;

/* Finds the largest piece, and the larger ones of those that hold a quarter of the
 * cluster, or of the mean cluster; in the window's order. Returns how many; 0 when the
 * window crosses no boundary. */
int fg__pieces_find(fg__piece out[FG__WINDOW_PIECES], const fg_density_arrays *density,
                    const fg__labels *labels, const fg__window *window);

/* The least size of a part of a cluster that gets an icon beside that of the largest
 * part, when the cluster and the mean cluster have these sizes. */
double fg__piece_least(double cluster, double mean);

#endif
