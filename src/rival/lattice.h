/* A grid of points with a wanted number of them in the domain. */
#ifndef FG__RIVAL_LATTICE_H
#define FG__RIVAL_LATTICE_H

#include "rival/domain.h"

typedef struct fg__lattice {
  int size[3]; /* columns, rows and layers (1 in 2D); each point is the middle of its
                  share of the box */
  double spacing[3];
  int inside; /* points where the flow has a direction */
} fg__lattice;

/* Finds the columns, rows and layers with spacings within a quarter of each other (in 3D
 * two fifths) that come nearest to the number; of two as near the fewer. Where none such
 * has any point in the domain, the finest tried. STOPPED. */
fg_status fg__lattice_choose(fg__lattice *out, fg_context *context,
                             const fg__domain *domain, int count);

/* Point number `index`, x fastest. */
void fg__lattice_point(const fg__lattice *lattice, const fg__domain *domain, int index,
                       double point[]);

int fg__lattice_count(const fg__lattice *lattice);

/* Shortest of the spacings. */
double fg__lattice_spacing(const fg__lattice *lattice, const fg__domain *domain);

#endif
