/* Readers of icons: the field that they reconstruct from the lines round a point, and its
 * error. Two readers follow the nearest line, and the lines by inverse distance; a third
 * one is in diffusion.h (docs/method/placement.md). */
#ifndef FG__PLACE_READERS_H
#define FG__PLACE_READERS_H

#include "place/line.h"

/* The raster on which readers are evaluated, in units of lambda from the domain's low
 * corner. */
typedef struct fg__place_raster {
  int dimension, cells[3];
  size_t count;
  float cell;
  float *direction[3]; /* of the flow, unit; 0 where it has none: no error there */
  float *weight;       /* their sum is the number of icons */
} fg__place_raster;

/* MEMORY. */
fg_status fg__place_raster_create(fg__place_raster *out, fg_context *context,
                                  const fg__place_domain *domain,
                                  const fg__place_scale *scale);
void fg__place_raster_clear(fg__place_raster *raster);

/* Where the middle of a cell lies, input coordinates. */
void fg__place_raster_center(double center[3], const fg__place_raster *raster,
                             const fg__place_scale *scale, const int at[3]);

/* Elements that arrays of cells have more than they need, on the side where they are
 * read in whole vectors (rows.h). */
enum { FG__PLACE_PAD = 16 };

/* Elements between the starts of arrays of at least `count` elements each. Starts that
 * differ by about a multiple of a page make loads wait for stores to other arrays (4 KiB
 * aliasing), so they differ by a seventh of a page more. */
static inline size_t fg__place_array_stride(size_t count)
{
  return count / 1024 * 1024 + 1024 + 144;
}

/* A box of cells. */
typedef struct fg__place_box {
  int low[3], size[3];
} fg__place_box;

static inline size_t fg__place_box_count(const fg__place_box *box)
{
  return (size_t)box->size[0] * (size_t)box->size[1] * (size_t)box->size[2];
}

static inline bool fg__place_boxes_meet(const fg__place_box *a, const fg__place_box *b)
{
  bool meet = true;
  for (int k = 0; k < 3; ++k)
    meet &= a->low[k] < b->low[k] + b->size[k] && b->low[k] < a->low[k] + a->size[k];
  return meet;
}

/* The contribution of some icons to what readers reconstruct in a box of cells. */
enum { FG__PLACE_NEAR = 1 };
#define FG__PLACE_ARRAYS(dimension) (FG__PLACE_NEAR + 2 * (dimension))

typedef struct fg__place_contribution {
  fg__place_box box;
  int dimension;
  size_t capacity; /* cells, FG__PLACE_PAD of them to spare */
  float *room;     /* allocated: `value` with FG__PLACE_PAD more before and behind */
  float *value;    /* FG__PLACE_ARRAYS arrays of `capacity`: square of the distance to the
                      nearest sample; from NEAR on its tangent, then the sum over icons of
                      their nearest tangents weighted by inverse distance */
} fg__place_contribution;

void fg__place_contribution_clear(fg__place_contribution *contribution);

/* Samples of lines, in lambda. */
typedef struct fg__place_points {
  int dimension, count;
  size_t capacity;
  float *position; /* `dimension` arrays of `capacity`, padded to whole vectors with
                      places beyond all reach */
} fg__place_points;

void fg__place_points_clear(fg__place_points *points);

/* Starts over with no points, and room for so many. MEMORY. */
fg_status fg__place_points_start(fg__place_points *points, fg_context *context,
                                 int dimension, int most);
void fg__place_points_add(fg__place_points *points, const fg__place_line *line);

/* For each of a line's samples the square of the distance to the nearest point, lambda;
 * huge without any. */
void fg__place_points_nearest(float square[FG__PLACE_SAMPLES],
                              const fg__place_points *points, const fg__place_line *line);

/* Makes the contribution of no icons to a box. MEMORY. */
fg_status fg__place_contribution_start(fg__place_contribution *contribution,
                                       fg_context *context, int dimension,
                                       const fg__place_box *box, float reach);

/* The cells within a distance, in lambda, of a line's own box; empty for no line. */
fg__place_box fg__place_box_around(const fg__place_raster *raster,
                                   const fg__place_line *line, float distance);

/* The cells that a line can reach; empty for no line. */
fg__place_box fg__place_box_of(const fg__place_raster *raster,
                               const fg__place_scale *scale, const fg__place_line *line);

/* Makes a box hold another one, which may be empty. */
void fg__place_box_widen(fg__place_box *box, const fg__place_box *by);

/* Computes a line's contribution, over the box that it reaches. MEMORY. */
fg_status fg__place_contribution_compute(fg__place_contribution *out, fg_context *context,
                                         const fg__place_raster *raster,
                                         const fg__place_scale *scale,
                                         const fg__place_line *line);

/* Adds one contribution to another, where both have cells. */
void fg__place_contribution_add(fg__place_contribution *to,
                                const fg__place_contribution *from);

/* Weights of the readers' errors in the energy. */
typedef struct fg__place_weights {
  float inverse_error; /* 1 / E0: weight of a degree */
  float far;           /* kappa: weight of the distance to the nearest line */
  float reach;         /* R in lambda */
} fg__place_weights;

/* The weighted errors of the readers in the cells of `box`, who reconstruct from the sum
 * of two contributions (either may be NULL, or cover a part of the box). Returns their
 * sum; `cost`, unless NULL, gets each cell's. */
double fg__place_cost(float *cost, const fg__place_raster *raster,
                      const fg__place_box *box, const fg__place_contribution *one,
                      const fg__place_contribution *other,
                      const fg__place_weights *weights);

#endif
