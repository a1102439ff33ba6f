/* Checks the numbers and sizes of packed values that ecCodes does not check: it would
 * write an image of JPEG 2000 beyond its buffer, read groups beyond the message, and
 * divide by the size of CCSDS' blocks. */
#include "decode/grib/grib.h"

#include <string.h>

/* The samples along one side: of the reference grid's, every `step`th from `first` on
 * (ISO/IEC 15444-1, equation B-2). */
static uint64_t samples_along(uint64_t end, uint64_t first, uint64_t step)
{
  return (end + step - 1) / step - (first + step - 1) / step;
}

/* The marker of the image's size follows that of its beginning (ISO/IEC 15444-1, A.5.1).
 */
bool fg__grib_jpeg_has(const unsigned char *jpeg, size_t size, uint64_t count)
{
  static const unsigned char begin[4] = {0xff, 0x4f, 0xff, 0x51};
  enum { HEADER = 45 }; /* with the one component's depth and steps */
  if (size < HEADER || memcmp(jpeg, begin, sizeof begin) != 0)
    return false;
  uint64_t end[2], first[2], samples = 1;
  for (int k = 0; k < 2; ++k) {
    end[k] = fg__grib_number(jpeg + 8 + 4 * k, 4);
    first[k] = fg__grib_number(jpeg + 16 + 4 * k, 4);
    const uint64_t step = jpeg[43 + k];
    if (step == 0 || first[k] >= end[k])
      return false;
    samples *= samples_along(end[k], first[k], step);
  }
  return fg__grib_number(jpeg + 40, 2) == 1 && samples == count;
}

/* Octets 20, 23 and 24 to 25 of template 5.42; the ranges are those of CCSDS 121.0-B. */
bool fg__grib_ccsds_is_sound(const unsigned char *packing, size_t size)
{
  if (size < 25)
    return false;
  const uint64_t bits = packing[19], block = packing[22];
  const uint64_t interval = fg__grib_number(packing + 23, 2);
  return bits <= 32 && (block == 8 || block == 16 || block == 32 || block == 64) &&
         interval >= 1 && interval <= 4096;
}

/* Numbers of a fixed count of bits, one after the other, from a whole byte on. */
typedef struct bit_list {
  const unsigned char *bytes;
  unsigned bits;
} bit_list;

static uint64_t list_at(const bit_list *list, uint64_t n)
{
  uint64_t number = 0;
  for (uint64_t bit = n * list->bits; bit < (n + 1) * list->bits; ++bit)
    number = number << 1 | (list->bytes[bit / 8] >> (7 - bit % 8) & 1);
  return number;
}

/* Templates 5.2 and 5.3 of WMO's Manual on Codes: of each group its reference, then its
 * width, then its length, then all values. */
bool fg__grib_groups_fit(const unsigned char *packing, size_t packing_size,
                         const unsigned char *data, size_t size, uint64_t count)
{
  const bool differences = fg__grib_number(packing + 9, 2) == 3;
  enum { MOST_BITS = 32 };
  if (packing_size < (differences ? 49 : 47))
    return false;
  const uint64_t groups = fg__grib_number(packing + 31, 4);
  if (groups == 0) /* all values are the reference */
    return true;
  const uint64_t least_width = packing[35],
                 least_length = fg__grib_number(packing + 37, 4);
  const uint64_t step = packing[41], last = fg__grib_number(packing + 42, 4);
  bit_list list[3] = {{data, packing[19]}, {data, packing[36]}, {data, packing[46]}};
  uint64_t used = differences ? (packing[47] + 1u) * packing[48] : 0;
  for (int k = 0; k < 3; ++k) {
    if (list[k].bits > MOST_BITS || used > size)
      return false;
    list[k].bytes = data + used;
    used += (groups * list[k].bits + 7) / 8;
  }
  if (used > size || groups > count)
    return false;
  uint64_t values = 0, bits = 0;
  for (uint64_t n = 0; n < groups; ++n) {
    const uint64_t width = least_width + list_at(&list[1], n);
    const uint64_t length =
        n + 1 == groups ? last : least_length + step * list_at(&list[2], n);
    if (width > MOST_BITS || length > count - values)
      return false;
    values += length;
    bits += width * length;
  }
  return values == count && (bits + 7) / 8 <= size - used;
}
