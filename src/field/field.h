/* A field's own representation. */
#ifndef FG__FIELD_H
#define FG__FIELD_H

#include <stdint.h>

#include "base/context.h"

enum { FG__FIELD_CORNERS = 8, FG__FIELD_WORDS = 15 };

/* One axis as the lookup sees it: `cells` intervals between cells + 1 coordinates; on a
 * periodic axis the last interval ends at the first sample's repetition. */
typedef struct fg__axis {
  double *coordinate;
  double *inverse_width;
  int cells;
  int samples;
  double period;
  bool even; /* every sample within a quarter of a cell of the even spacing */
  double inverse_spacing;
} fg__axis;

/* The cell that holds x, or -1 outside the axis, and where in it x lies, in [0, 1]. */
int fg__axis_cell(const fg__axis *axis, double x, double *fraction);

typedef struct fg__field_slab fg__field_slab;

/* A field has all samples of its grid; or it is a part, rows along the last axis; or a
 * window, a box of samples gathered from the parts. Indices are always the whole grid's.
 */
struct fg_field {
  fg_field_arrays contents;
  fg__axis axis[3];
  int first[3], held[3]; /* samples that it has along each axis, from `first` on; on a
                            periodic axis they may go on round its end */
  float *velocity[3];
  unsigned char *valid;        /* NULL: all; in a part or window NaN is missing */
  unsigned char *valid_cell;   /* NULL: all, or a part or window */
  char *word[FG__FIELD_WORDS]; /* owned copies of the texts */
  int words;
  uint64_t missing;     /* samples */
  uint64_t infinite;    /* those that are missing for that */
  double normal_share;  /* of a plane in space: fg_field_normal_share */
  fg__field_slab *slab; /* of a part; else NULL */
  const fg_field *of;   /* of a window: whose axes and words it borrows; else NULL */
};

/* The place of a field's text, n below FG__FIELD_WORDS. */
const char **fg__arrays_word(fg_field_arrays *arrays, int n);

/* Gives another title to a field that is no window. MEMORY. */
fg_status fg__field_set_title(fg_field *field, fg_context *context, const char *title);

static inline bool fg__field_is_whole(const fg_field *field)
{
  return !field->slab && !field->of;
}

/* Whether the field has sample n along axis k, and which of those it has it is. */
static inline int fg__field_place(const fg_field *field, int k, int n)
{
  const int place = n - field->first[k];
  return place < 0 ? place + field->axis[k].samples : place;
}

/* Corners of a cell: 4 in 2D, 8 in 3D. */
static inline int fg__field_corners(const fg_field *field)
{
  return 1 << field->contents.dimension;
}

/* Samples that it has. */
static inline size_t fg__field_held(const fg_field *field)
{
  return (size_t)field->held[0] * (size_t)field->held[1] * (size_t)field->held[2];
}

static inline int fg__field_last_axis(const fg_field *field)
{
  return field->contents.dimension - 1;
}

/* Whether sample i is missing, by the mask or by any of its components. */
bool fg__field_is_missing(const fg_field_arrays *arrays, size_t i);

/* The box round the valid cells of a field that has all its samples, and their area or
 * volume. */
typedef struct fg__field_box {
  double low[3], high[3], measure;
} fg__field_box;

fg__field_box fg__field_box_of(const fg_field *field);

/* Places of the corners of cell (i, j, k), k = 0 in 2D, among the samples that the field
 * has; x fastest. */
void fg__field_corners_of(const fg_field *field, int i, int j, int k,
                          size_t corner[FG__FIELD_CORNERS]);

/* What a grid of points is to find in a window along axis k: the samples that points
 * [first, first + count) of `all` points, `spacing` apart from `origin` on, lie between,
 * and one more on either side. Points beyond the ends of a periodic axis are those they
 * repeat; beyond other ends there are none. */
typedef struct fg__field_points {
  double origin, spacing;
  int first, count, all;
} fg__field_points;

void fg__field_span(int *first_sample, int *samples, const fg_field *field, int k,
                    const fg__field_points *points);

#endif
