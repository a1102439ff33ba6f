/* The diffusion reader of the search: the harmonic field that takes on the lines'
 * tangents (docs/method/placement.md), on the raster of the other readers. A trial with
 * one line in place of another is solved in a window around both, from the solution
 * there is: between other lines a change does not go far. */
#ifndef FG__PLACE_DIFFUSION_H
#define FG__PLACE_DIFFUSION_H

#include "place/reader/rows.h"

/* The part of the raster that a trial solves for, with one cell more on each side. */
typedef struct fg__place_window {
  const struct fg__place_diffusion *reader;
  fg__place_box box; /* without those */
  size_t stride[2];  /* of rows and planes */
  size_t origin;     /* of the box's first cell */
  size_t capacity;
  float *room; /* what all below points to */
  float *inverse, *strength, *source[3], *value[3], *last[3], *error;
  fg__place_run *run; /* those with cells of the domain: most of a raster may have none */
  size_t run_count, run_capacity;
} fg__place_window;

typedef struct fg__place_diffusion {
  fg__place_raster raster; /* borrowed */
  float hold;       /* strength of a line as long as a cell, beside 1 of a cell's face */
  float *cells;     /* what all below points to; a value a cell: */
  float *faces;     /* to other cells of the domain; 0 outside */
  float *strength;  /* by which lines hold the field to their tangents */
  float *source[3]; /* the sum of strength times tangent */
  float *value[3];  /* the reader's field */
  float *error;     /* its angle to the flow times weight, degrees */
  fg__place_window window; /* for all cells */
} fg__place_diffusion;

/* A reader of no lines. The raster's arrays must outlive it. MEMORY. */
fg_status fg__place_diffusion_create(fg__place_diffusion *out, fg_context *context,
                                     const fg__place_raster *raster,
                                     const fg__place_domain *domain,
                                     const fg__place_scale *scale);
void fg__place_diffusion_clear(fg__place_diffusion *reader);

/* Adds a line without solving. */
void fg__place_diffusion_add(fg__place_diffusion *reader, const fg__place_line *line);

/* Solves for all cells; `near`: from a solution that single lines have changed since.
 * MEMORY. */
fg_status fg__place_diffusion_solve(fg__place_diffusion *reader, fg_context *context,
                                    bool near);

/* The sum of errors over all cells, degrees. */
double fg__place_diffusion_sum(const fg__place_diffusion *reader);

/* What that sum grows by when line `from` gives way to line `to`; NULL: no line. Trials
 * in windows of their own may be made at the same time. MEMORY.
 */
fg_status fg__place_diffusion_try(double *growth, fg__place_window *window,
                                  const fg__place_diffusion *reader, fg_context *context,
                                  const fg__place_line *from, const fg__place_line *to);

/* Lets the trial come true that a window holds. */
void fg__place_diffusion_keep(fg__place_diffusion *reader, const fg__place_window *window,
                              const fg__place_line *from, const fg__place_line *to);

void fg__place_window_clear(fg__place_window *window);

#endif
