/* Missing values that a file does not declare. */
#ifndef FG__MISSING_VALUES_H
#define FG__MISSING_VALUES_H

#include "interpret/interpret.h"

/* Samples as a file has them, before they are interpolated or turned. */
typedef struct fg__raw_samples {
  const char *path;
  const char *name[3];
  float *component[3]; /* NaN: missing */
  int components;
  size_t count;
  const unsigned char *valid; /* 0: masked; NULL: none is */
  bool is_polar;              /* the first is a length, the second its direction */
} fg__raw_samples;

/* Samples of a vector that are there whole, or in part. */
fg__raw_samples fg__raw_samples_of(const fg__dataset *data, const fg__pair *pair,
                                   int components, float *const *component, size_t count);

/* Refuses a variable of which all samples are missing. FILE_FORMAT. */
fg_status fg__check_any(const fg__variable *v, const fg__missing_counts *missing,
                        size_t samples);

/* Reads fg_read_options.missing into a dataset: numbers with commas between, or "none";
 * NULL leaves it as it is. ARGUMENT. */
fg_status fg__missing_read(fg__missing_numbers *out, fg_context *context,
                           const char *missing);

/* Makes samples NaN that are one of the given numbers. */
void fg__missing_mask(const fg__raw_samples *samples, const fg__missing_numbers *given);

/* The greatest or least number of a component, how often it occurs, how often in all
 * components together, and the next one. */
typedef struct fg__extreme {
  float value, next;
  size_t count, together;
} fg__extreme;

/* The ends of each component's values, in all parts of a field that were looked at. */
typedef struct fg__extremes {
  fg__extreme low[3], high[3];
  size_t count; /* of samples that have all components; 0: begin */
} fg__extremes;

void fg__extremes_add(fg__extremes *extremes, const fg__raw_samples *samples);

/* Whether values may stand for missing data: only then a look at all parts could find
 * one. */
bool fg__extremes_are_suspect(const fg__extremes *extremes, int components);

/* Refuses a component where one number recurs that lies apart from all others, as -9999
 * or 1e20, unless none is missing: the message has its name, its share and the option
 * that decides. Of `samples` path and names count. ARGUMENT. */
fg_status fg__missing_decide(fg_context *context, const fg__extremes *extremes,
                             const fg__raw_samples *samples,
                             const fg__missing_numbers *given);

/* All of this for samples that are there whole. */
fg_status fg__missing_settle(fg_context *context, const fg__raw_samples *samples,
                             const fg__missing_numbers *given);

#endif
