/* Files in a run's folder: which names belong to a run, and operations on them. */
#ifndef FOLDER_FILES_H
#define FOLDER_FILES_H

#include "program.h"

/* Names in a run's folders. */
#define REPORT_NAME "run.json"
#define TABLE_NAME "evolution.csv"
#define VIEW_NAME "index.html"
#define CHECKPOINT_NAME "checkpoint"

/* Whether a run writes a file of this name into DIR; others are never removed or
 * replaced. */
bool is_result(const char *name);

/* A scale's file name with that ending: "scale-07.svg". */
enum { SCALE_NAME_BYTES = 40 };
void scale_name(char out[SCALE_NAME_BYTES], int index, const char *end);

/* The scale of a result's name, 7 for "scale-07.svg"; -1: none. */
int scale_of(const char *name);

/* A temporary file of a result or a checkpoint, left by a killed run. */
bool is_partial(const char *name);

/* Calls `act` for every name in a folder that `wanted` accepts, until it returns other
 * than EXIT_DONE. A missing folder has no names. Returns an exit code. */
int for_names(const char *folder, bool (*wanted)(const char *name),
              int (*act)(const char *folder, const char *name, const void *data),
              const void *data);

/* Removes a file, if it is there. Returns an exit code. */
int remove_file(const char *folder, const char *name);

/* Makes `folder`/name a hard link to `from`/name, or a copy. It must not exist yet.
 * Neither changes with the other as long as files are replaced as a whole. Returns an
 * exit code. */
int duplicate_file(const char *folder, const char *name, const char *from);

/* Flushes a file, or a folder's names, to the disk, where that is supported. Returns
 * an exit code. */
int synchronise_file(const char *folder, const char *name);
void synchronise_folder(const char *folder);

/* Makes a folder and its parents; *topmost becomes the first one that was missing.
 * Returns an exit code. */
int make_folders(const char *folder, char **topmost);

/* `path` itself if it exists, else its nearest existing parent, which may be a file. NULL
 * without memory; to be freed. */
char *nearest_existing(const char *path);

/* Removes the last component: "a/b" becomes "a", "a" becomes ".", "/" stays. */
void cut_to_parent(char *path);

/* Whether the name is a regular file, or a folder, and not a symbolic link. */
bool is_plain_file(const char *path);
bool is_plain_folder(const char *path);

/* Removes empty folders from `folder` up to `topmost`. */
void remove_empty_folders(const char *folder, const char *topmost);

bool file_is_there(const char *folder, const char *name);

#endif
