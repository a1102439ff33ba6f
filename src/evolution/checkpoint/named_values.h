/* The numbers of a struct as lines of a text, exact and back again. */
#ifndef FG__NAMED_VALUES_H
#define FG__NAMED_VALUES_H

#include <stdint.h>
#include <stdio.h>

#include "base/context.h"

typedef enum fg__value_kind {
  FG__VALUE_REAL,    /* double: the 16 hexadecimal digits of its bits */
  FG__VALUE_INTEGER, /* int, in decimals */
  FG__VALUE_INT64,   /* int64_t, in decimals */
  FG__VALUE_COUNT,   /* uint64_t, in decimals */
  FG__VALUE_FLAG,    /* bool: 0 or 1 */
  FG__VALUE_BITS     /* uint64_t that means nothing to people, 16 hexadecimal digits */
} fg__value_kind;

typedef struct fg__named_value {
  const char *name;
  fg__value_kind kind;
  size_t place; /* offset in the struct */
} fg__named_value;

enum { FG__VALUE_TEXT_BYTES = 32 };

/* Prints a line "NAME VALUE" for each of the struct's values. */
void fg__values_print(FILE *stream, const fg__named_value *values, size_t count,
                      const void *from);

/* Reads the values from such lines of a text, which may hold others. `path` is where the
 * text comes from. FILE_FORMAT (a line is not there, or no such value). */
fg_status fg__values_scan(const char *text, const char *path, fg_context *context,
                          const fg__named_value *values, size_t count, void *to);

/* The first value by which two structs differ in any bit; NULL: none. */
const fg__named_value *fg__values_difference(const fg__named_value *values, size_t count,
                                             const void *one, const void *other);

/* A value for people to read: doubles in as many decimals as tell them apart. */
void fg__value_describe(char text[FG__VALUE_TEXT_BYTES], const fg__named_value *value,
                        const void *from);

/* What follows "NAME " in its line, NULL when there is no such line; `length` bytes to
 * the line's end. Lines count as far as the first empty one. */
const char *fg__value_find(const char *text, const char *name, size_t *length);

#endif
