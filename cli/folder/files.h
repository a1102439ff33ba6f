/* Files of a run in a folder: which names are ours, and what can be done to them. */
#ifndef FOLDER_FILES_H
#define FOLDER_FILES_H

#include "program.h"

/* Names in a run's folders. */
#define REPORT_NAME "run.json"
#define TABLE_NAME "evolution.csv"
#define VIEW_NAME "index.html"
#define CHECKPOINT_NAME "checkpoint"

/* A name that a run leaves in DIR; no other is ever removed or replaced there. */
bool is_result(const char *name);

/* The name of a scale's file with that end: "scale-07.svg". */
enum { SCALE_NAME_BYTES = 40 };
void scale_name(char out[SCALE_NAME_BYTES], int index, const char *end);

/* The scale that a result's name belongs to, "scale-07.svg" 7; -1: to none. */
int scale_of(const char *name);

/* A result, or a checkpoint, that a run was killed in writing. */
bool is_partial(const char *name);

/* Calls `act` for every name in a folder that `wanted` accepts, until one returns other
 * than EXIT_DONE. A folder that is not there has no names. Returns an exit code. */
int for_names(const char *folder, bool (*wanted)(const char *name),
              int (*act)(const char *folder, const char *name, const void *data),
              const void *data);

/* Removes a file; one that is not there is gone already. Returns an exit code. */
int remove_file(const char *folder, const char *name);

/* Makes `folder`/name a file of the same content as `from`/name, which never changes the
 * other afterwards as long as files are replaced as a whole; it must not be there.
 * Returns an exit code. */
int duplicate_file(const char *folder, const char *name, const char *from);

/* Flushes a file, or a folder's names, to the disk, where that is supported. Returns
 * an exit code. */
int synchronise_file(const char *folder, const char *name);
void synchronise_folder(const char *folder);

/* Makes a folder and those above it; *topmost becomes the first that was not there.
 * Returns an exit code. */
int make_folders(const char *folder, char **topmost);

/* What is there of `path`: itself, or the nearest above it, which may be a file. NULL
 * without memory; end with free. */
char *nearest_existing(const char *path);

/* Cuts the last part off a path: "a/b" becomes "a", "a" becomes ".", "/" stays. */
void cut_to_parent(char *path);

/* A regular file, or a folder, of that name itself, not by a symbolic link. */
bool is_plain_file(const char *path);
bool is_plain_folder(const char *path);

/* Removes folders that are empty, from `folder` up to `topmost`. */
void remove_empty_folders(const char *folder, const char *topmost);

bool file_is_there(const char *folder, const char *name);

#endif
