/* Checksums of bytes. */
#ifndef FG__CHECKSUM_H
#define FG__CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* CRC-32 (ISO 3309, as in gzip and PNG) of bytes that follow others whose checksum is
 * `before`, 0 for none. Every change of up to 32 bits in a row shows. */
uint32_t fg__checksum(uint32_t before, const void *bytes, size_t size);

/* The same checksum of a whole whose pieces come in any order, or are with several ranks.
 * CRC-32 is linear: the checksum of the whole is the exclusive or of that of as many zero
 * bytes and of every piece's share, which depends on its bytes and on how many follow. */
typedef struct fg__checksum_share {
  uint64_t size;  /* of the whole */
  uint64_t end;   /* of the last piece */
  uint32_t run;   /* register behind the last piece, of those in ascending order */
  uint32_t share; /* of the runs before */
} fg__checksum_share;

/* No piece yet of `size` bytes. */
fg__checksum_share fg__checksum_share_of(uint64_t size);

/* Adds the piece that begins at `offset`. Least work when pieces ascend. */
void fg__checksum_share_add(fg__checksum_share *share, uint64_t offset, const void *bytes,
                            size_t count);

/* The share of all pieces so far. */
uint32_t fg__checksum_share_sum(const fg__checksum_share *share);

/* The checksum of `size` bytes that are 0. */
uint32_t fg__checksum_of_zeros(uint64_t size);

#endif
