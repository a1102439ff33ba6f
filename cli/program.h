/* What the files of the program share: exit codes and messages. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "flowgrain/flowgrain.h"

/* Exit codes of every command. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* From now on complaints are kept, not printed: on ranks other than 0, for all to agree
 * on (ranks.h). */
void keep_complaints(void);

/* Prints "flowgrain: TEXT" on standard error, or keeps it. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same of a second line, which says what to do about the complaint. */
void advise(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A text of a file without what a terminal would obey: control characters become '?'.
 * Returns `out`; longer texts are cut. */
enum { CLEAN_BYTES = 1024 };
const char *clean_text(char out[CLEAN_BYTES], const char *text);

/* What was last complained of, and advised on it; "" before. */
const char *last_complaint(void);
const char *last_advice(void);

/* Prints a context's message and its hint, after `file` unless the message begins with a
 * file's name of its own; returns the exit code for the failure. */
int complain_of(const fg_context *context, fg_status status, const char *file);

/* The same of a file that is written under the name `partial` first: the message names
 * `file` instead. */
int complain_of_partial(const fg_context *context, fg_status status, const char *partial,
                        const char *file);

/* Prints a file's error from errno, "flowgrain: PATH: No such file ..."; EXIT_FAILED. */
int complain_of_file(const char *path, const char *what);

/* "out of memory for WHAT"; EXIT_FAILED. */
int complain_of_memory(const char *what);

/* Says how many samples of a field are missing because they are infinite, if any are. */
void say_infinite(const char *file, const fg_field *field);

/* Creates a context, or complains. Returns an exit code. */
int create_context(fg_context **out);

/* Joins two texts, or a folder and a name with a slash between. NULL without memory. End
 * with free. */
char *join_texts(const char *first, const char *second);
char *join_path(const char *folder, const char *name);

/* Does what a command line says, argv[0] being the program; returns its exit code. */
int program_perform(int argc, char **argv);

#endif
