/* Whether components point east and north or along the lines of their curvilinear grid,
 * as far as names and attributes say (docs/method/model-grids.md). */
#ifndef FG__TERMS_FRAME_H
#define FG__TERMS_FRAME_H

#include <stddef.h>

#include "terms/term.h"

typedef struct fg__frame_evidence {
  bool staggered;  /* components lie on the faces of cells */
  bool angle;      /* the file has the angle of the grid */
  bool of_wrf;     /* attributes are WRF's, and do not say that it was turned */
  bool on_indices; /* fg__counts_cells of both dimensions */
  bool on_plane;   /* axes are a projection's or a rotated pole's */
} fg__frame_evidence;

/* 1: east and north; -1: along the grid; 0: nothing says it. `why` becomes the rule that
 * decides. */
int fg__frame_of_terms(char *why, size_t size, const fg__term *u, const fg__term *v,
                       const fg__frame_evidence *evidence);

/* Whether a component's standard name, or an unambiguous word of its names, says east. */
bool fg__says_east(const fg__term *u);

/* Whether its standard name says east, and its long name "x component" or the like. */
bool fg__frame_is_contradicted(const fg__term *u);

/* Whether a dimension is named after a grid's own directions. */
bool fg__counts_cells(const char *dimension);

/* Names of the angle from east to the grid, [0] alone, or of its cosine and sine; and of
 * masks on cells' centres that are 0 on land. Ended by NULL. */
extern const char *const fg__angle_names[][2];
extern const char *const fg__mask_names[];

#endif
