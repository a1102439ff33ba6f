/* Which files of a results' folder the program has made: those that its reports name. A
 * report is run.json in DIR, and those in the folder of the work, of the run that is
 * being published and of the one that it replaces. */
#ifndef FOLDER_MADE_H
#define FOLDER_MADE_H

#include "folder/files.h"

/* In the folder of the work: run.json of the results that are being replaced. */
#define REPLACED_NAME "replaced.json"

/* Finds a file in `folder` that is named like a result and that no report names, with
 * `work` NULL that of `folder` alone. name: "" where there is none. Returns an exit
 * code. */
int made_find_foreign(char name[SCALE_NAME_BYTES], const char *folder, const char *work);

/* Complains of such a file. Returns EXIT_FAILED. */
int made_complain(const char *folder, const char *name);

/* Removes what a report names, and files that a run was killed in writing. Returns an
 * exit code. */
int made_remove(const char *folder, const char *work);

/* Refuses a folder where a result would take the place of one of these inputs. Returns an
 * exit code. */
int made_check_inputs(const char *folder, const char *const *inputs, int count);

/* Lets the report of a run's folder name a file that another command writes into it under
 * the name of a result; any other file needs no naming. Returns an exit code. */
int made_record(const char *path);

/* Replaces `path` by a written file (replace_file in file.h), recorded as above. Returns
 * an exit code. */
int publish_file(char *partial, const char *path, int code);

#endif
