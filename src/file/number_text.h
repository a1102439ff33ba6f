/* Numbers as text, with a point whatever the user's locale says. */
#ifndef FG__NUMBER_TEXT_H
#define FG__NUMBER_TEXT_H

#include <locale.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/decimal.h"

/* While begun, this thread reads and writes numbers with a point. */
typedef struct fg__number_locale {
  locale_t plain, before;
} fg__number_locale;

bool fg__number_locale_begin(fg__number_locale *locale); /* false: no memory */
void fg__number_locale_end(fg__number_locale *locale);

/* Reads exactly `count` finite numbers parted by white space, and nothing else. */
bool fg__number_read_list(double *out, size_t count, const char *text);

/* Reads exactly `count` whole numbers that fit an int, and nothing else. */
bool fg__number_read_integers(int *out, size_t count, const char *text);

#endif
