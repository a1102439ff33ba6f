/* The files of a run's scale. */
#ifndef RUN_SCALE_FILES_H
#define RUN_SCALE_FILES_H

#include "option/settings.h"

/* Whether icons are solids, in 3D, and whether scales have a file of the density. */
bool scales_are_solid(const fg_field *field);
bool scales_have_density(const run_settings *settings, const fg_field *field);

/* The files of a scale: what follows "scale-NN" in each name, in the order in which
 * run.json lists them. Returns their number. */
enum { SCALE_FILES = FORMAT_KINDS * MAX_VIEWS + 4, SCALE_END_BYTES = 16 };
int scale_file_ends(char ends[SCALE_FILES][SCALE_END_BYTES], const run_settings *settings,
                    const fg_field *field);

#endif
