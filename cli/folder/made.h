/* Which result files the program has made: those that its reports name. Reports are
 * run.json in DIR, and those in the work folder: of the run that is being published, and
 * of the one that it replaces. */
#ifndef FOLDER_MADE_H
#define FOLDER_MADE_H

#include "folder/files.h"

/* In the work folder: run.json of the results that are being replaced. */
#define REPLACED_NAME "replaced.json"

/* Finds a file in `folder` with the name of a result that no report names. With `work`
 * NULL only the report in `folder` counts. name: "" where there is none. Returns an exit
 * code. */
int made_find_foreign(char name[SCALE_NAME_BYTES], const char *folder, const char *work);

/* Prints an error about such a file. Returns EXIT_FAILED. */
int made_complain(const char *folder, const char *name);

/* Removes the files that a report names, and temporary files of killed runs. Returns an
 * exit code. */
int made_remove(const char *folder, const char *work);

/* Refuses a folder where a result would replace one of these inputs. Returns an exit
 * code. */
int made_check_inputs(const char *folder, const char *const *inputs, int count);

/* Adds a file that another command writes into a run's folder to its report, if it has
 * the name of a result. Returns an exit code. */
int made_record(const char *path);

/* Replaces `path` by a temporary file (replace_file in file.h) and records it as above.
 * Returns an exit code. */
int publish_file(char *partial, const char *path, int code);

#endif
