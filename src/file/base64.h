/* Base64 (RFC 4648) as VTK's files use it: decoded as it is read, encoded in one go. */
#ifndef FG__BASE64_H
#define FG__BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* Characters being decoded. White space counts for nothing. Padding may stand in the
 * middle: VTK encodes a header and the data after it each by itself. */
typedef struct fg__base64 {
  const unsigned char *text;
  size_t size;
  size_t at;              /* next character */
  unsigned char ready[3]; /* decoded, not yet handed out */
  int ready_count;
} fg__base64;

/* Decodes exactly `count` bytes; false when there are fewer, or a character is wrong. A
 * NULL `out` skips them. */
bool fg__base64_read(fg__base64 *base64, unsigned char *out, size_t count);

/* Nothing but white space is left. */
bool fg__base64_ended(const fg__base64 *base64);

/* At most this many bytes can still be decoded. */
size_t fg__base64_available(const fg__base64 *base64);

/* Characters that `count` bytes become; 0 when that overflows. */
size_t fg__base64_length(size_t count);

/* Encodes into fg__base64_length(count) characters, with no end mark. */
void fg__base64_encode(char *out, const unsigned char *bytes, size_t count);

#endif
