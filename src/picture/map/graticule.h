/* Meridians and parallels, and where their degrees are written. */
#ifndef FG__GRATICULE_H
#define FG__GRATICULE_H

#include "picture/map/plane.h"
#include "picture/ticks.h"

enum { FG__MAP_LABELS = 16 * FG__TICK_LIMIT };

typedef struct fg__map_label {
  char text[FG__TICK_BYTES];
  double at[2];  /* where its line ends, or a place on the line; field's coordinates */
  double out[2]; /* from there to the label, y upwards, of length 1; inside: unused */
  int line;      /* labels of the same line have the same number */
  bool needed;   /* inside: it stands over arrows rather than nowhere */
} fg__map_label;

typedef struct fg__graticule {
  fg__polygons line;                    /* open lines, field's coordinates */
  fg__map_label label[FG__MAP_LABELS];  /* the most needed first, one a line is enough */
  fg__map_label inside[FG__MAP_LABELS]; /* for lines that end nowhere at the rim: places
                                           to choose from, the best first; round a pole
                                           those of a place are a row along a meridian */
  int labels, insides;
  const fg__plane *plane; /* borrowed */
} fg__graticule;

/* MEMORY. */
fg_status fg__graticule_create(fg__graticule *out, fg_context *context,
                               const fg__plane *plane);
void fg__graticule_clear(fg__graticule *graticule);

#endif
