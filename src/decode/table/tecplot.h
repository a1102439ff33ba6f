/* Zones of Tecplot's text files: tecplot.c reads them, zones.c makes a dataset of them.
 */
#ifndef FG__TECPLOT_H
#define FG__TECPLOT_H

#include "decode/table/table.h"

enum { FG__TECPLOT_WORD = 256, FG__TECPLOT_CORNERS = 4, FG__TECPLOT_VARIABLES = 256 };

typedef struct fg__zone {
  size_t size[3], points, cells;
  int corners;                    /* of a cell; 0: an ordered zone */
  bool block;                     /* by variables */
  double time;                    /* NaN: none */
  char centred[FG__TECPLOT_WORD]; /* lists of variables from 1, "" or "4-6" */
  int line;
  double **value; /* [variables] of points or of cells */
  int *node;      /* [cells * corners] from 1 */
} fg__zone;

typedef struct fg__tecplot {
  fg_context *context;
  const char *path;
  fg__table_cursor text;
  fg__table_column column[FG__TECPLOT_VARIABLES];
  int variables;
  fg__zone *zone;
  size_t zones, capacity;
} fg__tecplot;

/* Whether a variable has a value at each cell of a zone. */
bool fg__zone_is_centred(const fg__zone *zone, int variable);

/* zones.c. Adds what was read to a dataset. UNSUPPORTED, MEMORY. */
fg_status fg__zones_add(fg__dataset *dataset, const fg__source *source,
                        const fg__tecplot *r);

#endif
