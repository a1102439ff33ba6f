#include "base/checksum.h"

#include <zlib.h>

/* zlib counts bytes in unsigned ints. */
enum { MOST_AT_ONCE = 1 << 30 };

uint32_t fg__checksum(uint32_t before, const void *bytes, size_t size)
{
  const unsigned char *at = bytes;
  unsigned long sum = before;
  while (size > 0) {
    size_t count = size < MOST_AT_ONCE ? size : MOST_AT_ONCE;
    sum = crc32(sum, at, (uInt)count);
    at += count;
    size -= count;
  }
  return (uint32_t)sum;
}
