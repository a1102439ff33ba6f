/* Which files of a results' folder a run made: those that its run.json names. */
#ifndef FOLDER_MADE_H
#define FOLDER_MADE_H

#include "folder/files.h"

/* Finds a file in `folder` that is named like a result and that no run is known to have
 * made. name: "" where there is none. Returns an exit code. */
int made_find_foreign(char name[SCALE_NAME_BYTES], const char *folder);

/* Complains of such a file. Returns EXIT_FAILED. */
int made_complain(const char *folder, const char *name);

/* Refuses a folder where a result would take the place of one of these inputs. Returns an
 * exit code. */
int made_check_inputs(const char *folder, const char *const *inputs, int count);

#endif
