/* A browser's HTTP request: the name it asks for, and whether it is allowed. */
#ifndef VIEW_REQUEST_H
#define VIEW_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

/* 128 random bits as hexadecimal digits. */
enum { TOKEN_DIGITS = 32 };

/* Longest request, with cookies of other servers on this machine: browsers send them to
 * any port. */
enum { REQUEST_BYTES = 16384 };

/* Longest name in a request. */
enum { REQUEST_NAME_BYTES = 64 };

/* Whether the request is complete (ends with an empty line). */
bool request_is_whole(const char *text);

/* HTTP status of a request. 200: `name` is what follows /TOKEN/, without a slash,
 * possibly empty. 400: no valid request. 403: for another host name (DNS rebinding by a
 * page of another site). 404: any other path. 405: a method other than GET. */
int request_read(char name[REQUEST_NAME_BYTES], const char *text, const char *token);

#endif
