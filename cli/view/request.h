/* A request of a browser: the name of what it wants, and whether it is allowed. */
#ifndef VIEW_REQUEST_H
#define VIEW_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

/* Of 128 random bits, in hexadecimal digits. */
enum { TOKEN_DIGITS = 32 };

/* Longest request. Cookies of other servers on this machine come along: browsers do not
 * tell ports apart. */
enum { REQUEST_BYTES = 16384 };

/* Longest name in a request. */
enum { REQUEST_NAME_BYTES = 64 };

/* Whether the empty line that ends a request is there. */
bool request_is_whole(const char *text);

/* Status of the answer: 200 with the name behind /TOKEN/, which has no slash and may be
 * empty; 400 for what is no request; 403 where it is made to another host: a page of
 * another site whose name was made to lead here (DNS rebinding) names that; 404 for any
 * other place; 405 for another method than GET. */
int request_read(char name[REQUEST_NAME_BYTES], const char *text, const char *token);

#endif
