#include "file/utf8.h"

size_t fg__utf8_bytes(const unsigned char *text)
{
  unsigned char first = text[0];
  if (first < 0x80)
    return 1;
  size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4)
    return 0;
  for (size_t k = 1; k < bytes; ++k)
    if ((text[k] & 0xC0) != 0x80)
      return 0;
  if ((first == 0xE0 && text[1] < 0xA0) || (first == 0xED && text[1] > 0x9F) ||
      (first == 0xF0 && text[1] < 0x90) || (first == 0xF4 && text[1] > 0x8F))
    return 0;
  return bytes;
}

bool fg__utf8_is_valid(const char *text)
{
  const unsigned char *at = (const unsigned char *)text;
  size_t bytes = 1;
  while (*at && bytes > 0) {
    bytes = fg__utf8_bytes(at);
    at += bytes;
  }
  return bytes > 0;
}
