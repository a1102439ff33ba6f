/* Slabs of a field: this process has some of its samples. */
#ifndef FG__SLAB_H
#define FG__SLAB_H

#include "field/field.h"

/* Counts of one slab, whose sums are those of the field. */
typedef struct fg__slab_counts {
  uint64_t samples, missing; /* of the slab's own rows */
  uint64_t infinite;         /* of those that are missing */
  uint64_t cells, valid_cells, moving_cells;
  uint64_t by_reason[3][3]; /* missing samples of each component as its file has them:
                               fill values, out of range, not a number */
  uint64_t fingerprint;     /* of its own samples */
} fg__slab_counts;

struct fg__field_slab {
  int number, count;
  int own; /* rows along the last axis that no other slab counts, from first on */
  fg__slab_counts counts;
  bool has_reasons;
  char *input;  /* what it was read from; NULL: from arrays */
  uint64_t key; /* of what all slabs have to have in common */
  bool joined;
  uint64_t fingerprint; /* joined: of the whole field */
  unsigned char *valid; /* joined, rank 0, 2D, some missing: a bit a sample, rows begin
                           with a byte; else NULL */
};

/* Rows [*first, *first + *own) of `rows` are those of a slab. */
void fg__slab_rows(int *first, int *own, int rows, int number, int count);

/* Rows that a reader is to give to a slab: its own, and the next one where there is one
 * (round a periodic axis, the first). */
int fg__slab_rows_held(int rows, int first, int own, bool periodic);

/* fg_field_create with samples that are taken over instead of copied: arrays->velocity[k]
 * is taken[k], which becomes NULL once it is the field's. */
fg_status fg__field_take(fg_field **out, fg_context *context,
                         const fg_field_arrays *arrays, float *taken[3]);

/* Copies a slab's rows into a field, or takes them over likewise (taken may be NULL):
 * arrays as for fg_field_create, but for the samples, which are those of its rows
 * (fg__slab_rows_held). Checks that concern all samples are left to the join. A slab of
 * one or of more than there are rows is refused. ARGUMENT, UNSUPPORTED, MEMORY. */
fg_status fg__field_create_slab(fg_field **out, fg_context *context,
                                const fg_field_arrays *arrays, float *taken[3],
                                int number, int count);

/* Fails when, in all slabs together or in a whole field, every sample is missing, no cell
 * has all its corners, or nothing moves. ARGUMENT. */
fg_status fg__field_check_counts(fg_context *context, const fg__slab_counts *counts);

/* Fails for a plane whose vectors are all normal to it, by sums of the squares of their
 * normal components and of all. `axis`: names of the plane's axes. ARGUMENT. */
fg_status fg__field_check_plane(fg_context *context, double normal, double all,
                                const char *const axis[2]);

/* A window of a field, whose axes and words it borrows: it must go first. `velocity`,
 * [held[0] * held[1] * held[2]] floats a component, x fastest, is taken over, even after
 * a failure. MEMORY. */
fg_status fg__field_create_window(fg_field **out, fg_context *context, const fg_field *of,
                                  const int first[3], const int held[3],
                                  float *const velocity[3]);

#endif
