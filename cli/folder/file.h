/* A file that a command writes, outside a run's folder. */
#ifndef FOLDER_FILE_H
#define FOLDER_FILE_H

#include "program.h"

/* Whether a name ends so, in small letters or large. */
bool ends_with(const char *text, const char *end);

/* Complains of a picture whose name has not the end of a known format, or that can not be
 * put where it shall be; an exit code. */
int check_picture_name(const char *path, const char *command);

/* Refuses a file to be written whose folder is not there or can not be written to, and
 * one that is a folder: before the work, not after it. Returns an exit code. */
int check_place_of_file(const char *path);

/* Refuses to write to a file that one of the command's inputs is (some may be NULL, or no
 * files). Returns an exit code. */
int check_is_no_input(const char *path, const char *const *inputs, int count);

/* A name beside `path`, with the same end, to write it under until it is whole. NULL,
 * after a complaint, without memory. */
char *temporary_name(const char *path);

/* Ends such a name: gives its file the name `path`, or removes it when it could not be
 * written, as a `code` other than EXIT_DONE says. Returns an exit code. */
int replace_file(char *partial, const char *path, int code);

/* Writes a text and a newline to a file, by replace_file. Returns an exit code. */
int write_text_file(const char *path, const char *text);

#endif
