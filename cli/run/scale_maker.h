/* One scale's icons, densities and pictures, from a snapshot to its files. */
#ifndef RUN_SCALE_MAKER_H
#define RUN_SCALE_MAKER_H

#include "folder/results.h"
#include "run/placing.h"

typedef struct scale_result {
  int wanted[MAX_SCALES]; /* the numbers of clusters that this scale answers */
  int wanted_count;
  int clusters, icons, dropped;
  double time, energy, area_fraction;
  bool has_score;
  fg_score score; /* of its icons: the readers' errors */
} scale_result;

/* What all scales' pictures have in common, found from the finest scale's icons: the ends
 * of the colour key, so that a colour means the same in all of them, and in 3D the
 * viewpoint, azimuth and elevation. */
typedef struct common_look {
  double speeds[2], view[2];
} common_look;

/* What makes the scales, one after the other. */
typedef struct scale_maker {
  const run_settings *settings;
  const fg_field *field;    /* whole */
  const cli_output *output; /* where files go */
  fg_context *context;
  fg_texture *background; /* of the last picture, NULL: none */
  cli_placing placing;
  fg_icons *finer; /* placed icons of the last scale, whose parents come with the next */
  common_look look;
  double icon_seconds, picture_seconds;
} scale_maker;

/* Makes the files of a scale; its numbers wanted are in `result`, which gets the rest. */
fg_status scale_make(scale_maker *maker, int index, scale_result *result,
                     scale_snapshot *snapshot);

/* Removes what there is of a scale that was interrupted. */
void scale_remove(const scale_maker *maker, int index);

/* A file of a scale; NULL: no memory. End with free. */
char *scale_path(const scale_maker *maker, int index, const char *end);

void scale_maker_clear(scale_maker *maker);

#endif
