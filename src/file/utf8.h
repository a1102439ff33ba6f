/* UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing past U+10FFFF. */
#ifndef FG__UTF8_H
#define FG__UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the character at `text`, which a NUL ends; 0 when it is none. */
size_t fg__utf8_bytes(const unsigned char *text);

/* Whether all of a text is UTF-8. */
bool fg__utf8_is_valid(const char *text);

#endif
