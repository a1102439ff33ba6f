/* Missing values that a file does not declare. */
#ifndef FG__MISSING_VALUES_H
#define FG__MISSING_VALUES_H

#include "dataset/dataset.h"

/* Samples as a file has them, before they are interpolated or turned. */
typedef struct fg__raw_samples {
  const char *path;
  const char *name[3];
  float *component[3]; /* NaN: missing */
  int components;
  size_t count;
  const unsigned char *valid; /* 0: masked; NULL: none is */
} fg__raw_samples;

/* Reads fg_read_options.missing into a dataset: numbers with commas between, or "none";
 * NULL leaves it as it is. ARGUMENT. */
fg_status fg__missing_read(fg__missing_numbers *out, fg_context *context,
                           const char *missing);

/* Whether any of the samples is as large as numbers that stand for missing data are: of
 * rows of a field all rows then decide. */
bool fg__missing_is_suspect(const fg__raw_samples *samples);

/* Makes samples NaN that are one of the given numbers; then refuses a component where one
 * number recurs that lies apart from all others, as -9999 or 1e20, unless none is
 * missing: the message has its name, its share and the option that decides. FILE_FORMAT.
 */
fg_status fg__missing_settle(fg_context *context, const fg__raw_samples *samples,
                             const fg__missing_numbers *given);

#endif
