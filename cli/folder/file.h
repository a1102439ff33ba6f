/* Files that commands write outside a run's folder. */
#ifndef FOLDER_FILE_H
#define FOLDER_FILE_H

#include "program.h"

/* Whether a name has this ending, in lower or upper case. */
bool ends_with(const char *text, const char *end);

/* Refuses a picture's name without the ending of a known format, or in a place that
 * cannot be written. Returns an exit code. */
int check_picture_name(const char *path, const char *command);

/* Refuses a path whose folder is missing or not writable, or that is a folder itself,
 * before the work begins. Returns an exit code. */
int check_place_of_file(const char *path);

/* Refuses an output path that is one of the inputs (NULL inputs, and other names than of
 * files, are allowed). Returns an exit code. */
int check_is_no_input(const char *path, const char *const *inputs, int count);

/* A temporary name beside `path`, with the same ending. NULL, after an error was printed,
 * without memory. */
char *temporary_name(const char *path);

/* Renames a temporary file to `path`, or removes it where `code` is not EXIT_DONE. Frees
 * the temporary name. Returns an exit code. */
int replace_file(char *partial, const char *path, int code);

/* Writes a text and a newline to a file by replace_file. Returns an exit code. */
int write_text_file(const char *path, const char *text);

#endif
