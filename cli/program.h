/* Exit codes and messages, for all files of the program. To "complain" is to print an
 * error or a warning; to "advise" is to print a second line, what to do about it. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "flowgrain/flowgrain.h"

/* Exit codes of every command. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* Stores complaints instead of printing them: on ranks other than 0 (ranks.h). */
void keep_complaints(bool keep);

/* Prints the last complaint and its advice. */
void repeat_complaint(void);

/* Prints "flowgrain: TEXT" on standard error, or stores it. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints the second line, or stores it. */
void advise(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Tells that a picture has no colour key, and the width in points from which on it has
 * one; nothing for a width of 0. */
void tell_key_width(const char *picture, double width);

/* Bytes of the UTF-8 character (RFC 3629) at `text`; 0: there is none. */
size_t character_bytes(const unsigned char *text);

/* Copies a text from a file without terminal escapes: control characters become '?'.
 * Returns `out`; longer texts are cut. */
enum { CLEAN_BYTES = 1024 };
const char *clean_text(char out[CLEAN_BYTES], const char *text);

/* The last complaint and its advice; "" before. */
const char *last_complaint(void);
const char *last_advice(void);

/* Whether an input is standard input, and the name of an input in messages. */
bool input_is_standard(const char *input);
const char *input_name(const char *input);

/* Prints a context's message and hint, after `file` unless the message begins with
 * another file's name; returns the exit code of the failure. */
int complain_of(const fg_context *context, fg_status status, const char *file);

/* The same for a file that is first written under the name `partial`; the message names
 * `file` instead. */
int complain_of_partial(const fg_context *context, fg_status status, const char *partial,
                        const char *file);

/* Prints the error of errno for a file, "flowgrain: PATH: No such file ..."; returns
 * EXIT_FAILED. */
int complain_of_file(const char *path, const char *what);

/* Prints "out of memory for WHAT"; returns EXIT_FAILED. */
int complain_of_memory(const char *what);

/* Prints what is unsure of how a field was read, and how many of its samples are missing
 * because they are infinite. */
void report_doubts(const char *file, const fg_field *field);

/* Concatenates two texts, or a folder and a name with a slash between. NULL without
 * memory. To be freed. */
char *join_texts(const char *first, const char *second);
char *join_path(const char *folder, const char *name);

/* What is wrong with a file of which mapped bytes are no longer there: after its name. */
#define BECAME_SHORTER "became shorter while it was read, or its disk failed"

/* Performs a command line, where argv[0] is the program; returns its exit code. */
int program_perform(int argc, char **argv);

#endif
