#include "file/checksum.h"

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

/* The register behind `zeros` more bytes that are 0. */
static uint32_t behind_zeros(uint32_t reg, uint64_t zeros)
{
  for (; zeros > MOST_AT_ONCE; zeros -= MOST_AT_ONCE)
    reg = (uint32_t)crc32_combine(reg, 0, MOST_AT_ONCE);
  return (uint32_t)crc32_combine(reg, 0, (z_off_t)zeros);
}

fg__checksum_share fg__checksum_share_of(uint64_t size)
{
  return (fg__checksum_share){.size = size};
}

uint32_t fg__checksum_share_sum(const fg__checksum_share *share)
{
  return share->share ^ behind_zeros(share->run, share->size - share->end);
}

void fg__checksum_share_add(fg__checksum_share *share, uint64_t offset, const void *bytes,
                            size_t count)
{
  if (offset < share->end) {
    share->share = fg__checksum_share_sum(share);
    share->run = 0;
    share->end = offset;
  }
  if (offset > share->end)
    share->run = behind_zeros(share->run, offset - share->end);
  share->run = ~fg__checksum(~share->run, bytes, count);
  share->end = offset + count;
}

uint32_t fg__checksum_of_zeros(uint64_t size)
{
  return ~behind_zeros(UINT32_MAX, size);
}
