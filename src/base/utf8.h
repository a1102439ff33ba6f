/* UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing past U+10FFFF. */
#ifndef FG__UTF8_H
#define FG__UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the character at `text`, which a NUL ends; 0 when it is none. */
size_t fg__utf8_bytes(const unsigned char *text);

/* Whether all of a text is UTF-8. */
bool fg__utf8_is_valid(const char *text);

/* Copies `count` bytes of a text, up to a NUL among them, as UTF-8 into a buffer. A byte
 * that is none of a character counts as Latin-1, which other programs write ° and µ in. A
 * text is cut between two characters where the buffer ends, or where it ends itself
 * within one. Names, units and all other texts of files enter the program so. */
void fg__utf8_take(char *out, size_t size, const char *text, size_t count);

/* The same of a whole text, uncut; NULL for NULL or when there is no memory. End with
 * free. */
char *fg__utf8_copy(const char *text);

#endif
