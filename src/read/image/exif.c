#include "read/image/exif.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { ENTRY_SIZE = 12, ORIENTATION = 0x0112, TYPE_SHORT = 3 };

/* Bytes with an order of their own. */
typedef struct tiff {
  const unsigned char *bytes;
  size_t size;
  bool big_endian;
} tiff;

/* Of `width` bytes, which must be there. */
static uint32_t number_at(const tiff *t, size_t at, size_t width)
{
  uint32_t value = 0;
  for (size_t k = 0; k < width; ++k)
    value = value << 8 | t->bytes[at + (t->big_endian ? k : width - 1 - k)];
  return value;
}

int fg__exif_orientation(const unsigned char *bytes, size_t size)
{
  if (size < 8 || (memcmp(bytes, "MM\0*", 4) != 0 && memcmp(bytes, "II*\0", 4) != 0))
    return 1;
  tiff t = {bytes, size, bytes[0] == 'M'};
  size_t at = number_at(&t, 4, 4);
  if (at > size - 2)
    return 1;
  uint32_t entries = number_at(&t, at, 2);
  at += 2;
  for (uint32_t n = 0; n < entries && size - at >= ENTRY_SIZE; ++n, at += ENTRY_SIZE) {
    if (number_at(&t, at, 2) != ORIENTATION)
      continue;
    uint32_t value = number_at(&t, at + 8, 2);
    bool known = number_at(&t, at + 2, 2) == TYPE_SHORT && value >= 1 && value <= 8;
    return known ? (int)value : 1;
  }
  return 1;
}
