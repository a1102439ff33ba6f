/* Numbers as text, with a point whatever the user's locale says. */
#ifndef FG__NUMBER_TEXT_H
#define FG__NUMBER_TEXT_H

#include <locale.h>
#include <stdbool.h>
#include <stddef.h>

/* While begun, this thread reads and writes numbers with a point. */
typedef struct fg__number_locale {
  locale_t plain, before;
} fg__number_locale;

bool fg__number_locale_begin(fg__number_locale *locale); /* false: no memory */
void fg__number_locale_end(fg__number_locale *locale);

enum { FG__NUMBER_BYTES = 32 };

/* Writes a decimal that reads back as the same number, of 15 digits or fewer if that will
 * do: 0.03, not 0.029999999999999999. To be called between begin and end. */
void fg__number_write(char text[FG__NUMBER_BYTES], double number);

/* Reads exactly `count` finite numbers parted by white space, and nothing else. */
bool fg__number_read_list(double *out, size_t count, const char *text);

/* Reads exactly `count` whole numbers that fit an int, and nothing else. */
bool fg__number_read_integers(int *out, size_t count, const char *text);

#endif
