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

/* Polynomials over the bits, modulo that of CRC-32, the coefficient of x^0 in the highest
 * bit; zero bytes behind a register multiply it by x^8 each (as in zlib's
 * crc32_combine). */
static const uint32_t polynomial = 0xedb88320U, one = 0x80000000U, x_to_8 = 0x00800000U;

static uint32_t times(uint32_t a, uint32_t b)
{
  uint32_t product = 0;
  for (; a; a <<= 1) {
    if (a & one)
      product ^= b;
    b = b & 1U ? b >> 1 ^ polynomial : b >> 1;
  }
  return product;
}

static uint32_t factor_of(uint64_t zeros)
{
  uint32_t factor = one;
  for (uint32_t power = x_to_8; zeros; zeros >>= 1, power = times(power, power))
    if (zeros & 1U)
      factor = times(factor, power);
  return factor;
}

fg__checksum_share fg__checksum_share_of(uint64_t size)
{
  return (fg__checksum_share){.size = size, .gap_factor = one};
}

uint32_t fg__checksum_share_sum(const fg__checksum_share *share)
{
  return share->share ^ times(factor_of(share->size - share->end), share->run);
}

void fg__checksum_share_add(fg__checksum_share *share, uint64_t offset, const void *bytes,
                            size_t count)
{
  if (offset < share->end) {
    share->share = fg__checksum_share_sum(share);
    share->run = 0;
    share->end = offset;
  }
  uint64_t gap = offset - share->end;
  if (gap > 0 && gap != share->gap) {
    share->gap = gap;
    share->gap_factor = factor_of(gap);
  }
  if (gap > 0)
    share->run = times(share->gap_factor, share->run);
  share->run = ~fg__checksum(~share->run, bytes, count);
  share->end = offset + count;
}

uint32_t fg__checksum_of_zeros(uint64_t size)
{
  return ~times(factor_of(size), UINT32_MAX);
}
