/* A field's own representation. */
#ifndef FG__FIELD_H
#define FG__FIELD_H

#include "base/context.h"

enum { FG__FIELD_CORNERS = 8, FG__FIELD_WORDS = 13 };

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

struct fg_field {
  fg_field_arrays contents;
  fg__axis axis[3];
  float *velocity[3];
  unsigned char *valid;        /* NULL: all */
  unsigned char *valid_cell;   /* NULL: all */
  char *word[FG__FIELD_WORDS]; /* owned copies of the texts */
  int words;
};

/* Corners of a cell: 4 in 2D, 8 in 3D. */
static inline int fg__field_corners(const fg_field *field)
{
  return 1 << field->contents.dimension;
}

/* Sample indices of the corners of cell (i, j, k), k = 0 in 2D; x fastest. */
void fg__field_corners_of(const fg_field *field, int i, int j, int k,
                          size_t corner[FG__FIELD_CORNERS]);

#endif
