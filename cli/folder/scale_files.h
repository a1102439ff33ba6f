/* Files of a run's scales. */
#ifndef FOLDER_SCALE_FILES_H
#define FOLDER_SCALE_FILES_H

#include "option/settings.h"

/* Whether icons are solids (3D); scales then have a density file. */
bool scales_are_solid(const fg_field *field);
bool scales_have_density(const run_settings *settings, const fg_field *field);

/* Lists the endings of a scale's files after "scale-NN", in the order of run.json.
 * Returns their number. */
enum { SCALE_FILES = FORMAT_KINDS * MAX_VIEWS + 4, SCALE_END_BYTES = 16 };
int scale_file_ends(char ends[SCALE_FILES][SCALE_END_BYTES], const run_settings *settings,
                    const fg_field *field);

#endif
