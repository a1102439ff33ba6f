/* Texts of a picture before a font is chosen. */
#ifndef FG__PLAIN_TEXT_H
#define FG__PLAIN_TEXT_H

#include <stddef.h>

/* Between these two marks a text is raised and small: an exponent. Fonts often lack the
 * ready-made superscripts. */
#define FG__TEXT_RAISE "\001"
#define FG__TEXT_LOWER "\002"

/* Copies a text from outside: bytes that are no UTF-8 become '?', control characters a
 * space; cut at a whole character when `capacity` is too small. */
void fg__text_clean(char *out, size_t capacity, const char *text);

#endif
