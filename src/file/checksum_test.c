/* The checksum of a whole from the shares of its pieces. */
#include <string.h>

#include "base/context_test.h"
#include "file/checksum.h"

enum { BYTES = 9001, RANKS = 3 };

static uint64_t next(uint64_t *seed)
{
  *seed = *seed * 6364136223846793005U + 1442695040888963407U;
  return *seed >> 33;
}

static void fill(unsigned char *bytes, size_t count, uint64_t seed)
{
  for (size_t n = 0; n < count; ++n)
    bytes[n] = (unsigned char)next(&seed);
}

/* The check value of CRC-32/ISO-HDLC. */
static void it_is_crc_32(void **state)
{
  (void)state;
  assert_int_equal(fg__checksum(0, "123456789", 9), 0xcbf43926U);
}

static void zeros(void **state)
{
  (void)state;
  static const unsigned char none[BYTES];
  static const size_t sizes[] = {0, 1, 2, 3, 31, 256, 1023, BYTES};
  for (size_t n = 0; n < sizeof sizes / sizeof *sizes; ++n)
    assert_int_equal(fg__checksum_of_zeros(sizes[n]), fg__checksum(0, none, sizes[n]));
}

/* Cut at random; pieces go to random ranks, each of which takes them in turn from the
 * front and from the back. */
static void pieces_in_any_order(void **state)
{
  (void)state;
  unsigned char bytes[BYTES];
  uint64_t seed = 5;
  for (int turn = 0; turn < 200; ++turn) {
    size_t size = 1 + next(&seed) % BYTES, cut[BYTES], count = 0;
    fill(bytes, size, seed);
    for (size_t at = 0; at < size; at += 1 + next(&seed) % (1U << turn % 12))
      cut[count++] = at;
    fg__checksum_share share[RANKS];
    for (int rank = 0; rank < RANKS; ++rank)
      share[rank] = fg__checksum_share_of(size);
    for (size_t n = 0; n < count; ++n) {
      size_t piece = n % 2 ? count - 1 - n / 2 : n / 2;
      size_t end = piece + 1 < count ? cut[piece + 1] : size;
      fg__checksum_share_add(&share[next(&seed) % RANKS], cut[piece], bytes + cut[piece],
                             end - cut[piece]);
    }
    uint32_t sum = fg__checksum_of_zeros(size);
    for (int rank = 0; rank < RANKS; ++rank)
      sum ^= fg__checksum_share_sum(&share[rank]);
    assert_int_equal(sum, fg__checksum(0, bytes, size));
  }
}

/* Rows of a box in a grid: even gaps within a plane, another one between planes. */
static void rows_of_a_box(void **state)
{
  (void)state;
  enum { NX = 23, NY = 11, NZ = 7 };
  unsigned char bytes[NX * NY * NZ];
  fill(bytes, sizeof bytes, 8);
  uint32_t sum = fg__checksum_of_zeros(sizeof bytes);
  for (int half = 0; half < 2; ++half) {
    fg__checksum_share share = fg__checksum_share_of(sizeof bytes);
    size_t first = half ? 9 : 0, count = half ? NX - 9 : 9;
    for (size_t row = 0; row < (size_t)NY * NZ; ++row)
      fg__checksum_share_add(&share, row * NX + first, bytes + row * NX + first, count);
    sum ^= fg__checksum_share_sum(&share);
  }
  assert_int_equal(sum, fg__checksum(0, bytes, sizeof bytes));
}

/* The polynomial is primitive: 2^32 - 1 zero bytes change nothing. */
static void beyond_four_gigabytes(void **state)
{
  (void)state;
  const uint64_t turn = UINT32_MAX;
  assert_int_equal(fg__checksum_of_zeros(77 + 300 * turn), fg__checksum_of_zeros(77));
  fg__checksum_share near = fg__checksum_share_of(40);
  fg__checksum_share far = fg__checksum_share_of(40 + 5 * turn);
  fg__checksum_share_add(&near, 0, "abc", 3);
  fg__checksum_share_add(&near, 20, "defg", 4);
  fg__checksum_share_add(&far, 0, "abc", 3);
  fg__checksum_share_add(&far, 20 + 2 * turn, "defg", 4);
  assert_int_equal(fg__checksum_share_sum(&near), fg__checksum_share_sum(&far));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_crc_32),          cmocka_unit_test(zeros),
      cmocka_unit_test(pieces_in_any_order),   cmocka_unit_test(rows_of_a_box),
      cmocka_unit_test(beyond_four_gigabytes),
  };
  return cmocka_run_group_tests_name("file/checksum", tests, NULL, NULL);
}
