/* Checksums of bytes. */
#ifndef FG__CHECKSUM_H
#define FG__CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* CRC-32 (ISO 3309, as in gzip and PNG) of bytes that follow others whose checksum is
 * `before`, 0 for none. Every change of up to 32 bits in a row shows. */
uint32_t fg__checksum(uint32_t before, const void *bytes, size_t size);

#endif
