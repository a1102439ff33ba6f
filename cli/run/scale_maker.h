/* Makes the files of one scale, icons, densities and pictures, from a snapshot. */
#ifndef RUN_SCALE_MAKER_H
#define RUN_SCALE_MAKER_H

#include "folder/results.h"
#include "run/placing.h"

typedef struct scale_result {
  int wanted[MAX_SCALES]; /* requested numbers of clusters for which this is the scale */
  int wanted_count;
  int clusters, icons, dropped;
  double time, energy, area_fraction;
  bool has_score;
  fg_score score; /* of its icons */
  bool has_features;
  int features[FG_CRITICAL_KINDS]; /* how many of each kind */
} scale_result;

/* What the pictures of all scales share, from the finest scale's icons: the ends of the
 * colour key, and in 3D the viewpoint's azimuth and elevation. */
typedef struct common_look {
  double speeds[2], view[2];
} common_look;

/* What makes the scales, one after the other. */
typedef struct scale_maker {
  const run_settings *settings;
  const fg_field *field;    /* whole */
  const cli_output *output; /* destination of files */
  fg_context *context;
  fg_texture *background; /* of the last picture, or NULL */
  cli_placing placing;
  fg_icons *finer; /* placed icons of the last scale, whose parents come later */
  common_look look;
  double icon_seconds, picture_seconds;
} scale_maker;

/* Makes the files of a scale. `result` has its requested numbers, and receives the
 * rest. */
fg_status scale_make(scale_maker *maker, int index, scale_result *result,
                     scale_snapshot *snapshot);

/* Removes the files of an interrupted scale. */
void scale_remove(const scale_maker *maker, int index);

/* The path of a scale's file; NULL: no memory. To be freed. */
char *scale_path(const scale_maker *maker, int index, const char *end);

void scale_maker_clear(scale_maker *maker);

#endif
