/* Parses the value of an option. */
#ifndef OPTION_VALUE_H
#define OPTION_VALUE_H

#include "option/table.h"

/* Prints a usage error of a command; returns false. */
bool usage_error(const cli_command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Sets a value in a command's settings. typed: the option as typed. False after a usage
 * error was printed. */
bool value_set(void *settings, const cli_command *command, const option_entry *option,
               const char *typed, const char *text);

/* Parses a number of bytes, at least 1: "500M", "1.5GB", "2e9". False for other text. */
bool value_read_size(double *out, const char *text);

/* Joins words to "a, b, c", cut at size. */
void list_words(char *text, size_t size, const char *const *words);

#endif
