#include "base/utf8.h"

#include <string.h>

#include "base/memory.h"

enum { LONGEST_CHARACTER = 4 };

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

/* fg__utf8_bytes of a text that ends after `left` bytes. */
static size_t bytes_at(const char *text, size_t left)
{
  unsigned char next[LONGEST_CHARACTER + 1] = {0};
  memcpy(next, text, left < LONGEST_CHARACTER ? left : LONGEST_CHARACTER);
  return fg__utf8_bytes(next);
}

/* Whether the `left` bytes at the end of a text are the beginning of a character. */
static bool is_cut(const char *text, size_t left)
{
  const unsigned char first = (unsigned char)text[0];
  bool cut = left < (first >= 0xF0 ? 4U : first >= 0xE0 ? 3U : first >= 0xC2 ? 2U : 0U);
  for (size_t k = 1; k < left && cut; ++k)
    cut = ((unsigned char)text[k] & 0xC0) == 0x80;
  return cut;
}

void fg__utf8_take(char *out, size_t size, const char *text, size_t count)
{
  const char *end = memchr(text, '\0', count);
  const size_t length = end ? (size_t)(end - text) : count;
  size_t used = 0;
  bool has_characters = false; /* beyond ASCII */
  for (size_t at = 0, bytes; at < length; at += bytes) {
    const unsigned char byte = (unsigned char)text[at];
    bytes = bytes_at(text + at, length - at);
    const bool is_latin = bytes == 0;
    /* after ASCII alone a last byte is one of Latin-1: "m/s at 5\xB0" */
    if (is_latin && has_characters && is_cut(text + at, length - at))
      break;
    has_characters = has_characters || bytes > 1;
    bytes += is_latin;
    if (used + bytes + is_latin >= size)
      break;
    memcpy(out + used, text + at, bytes);
    if (is_latin) {
      out[used++] = (char)(0xC0 | byte >> 6);
      out[used] = (char)(0x80 | (byte & 0x3F));
    }
    used += bytes;
  }
  out[used] = '\0';
}

char *fg__utf8_copy(const char *text)
{
  const size_t length = text ? strlen(text) : 0;
  char *copy = text ? fg__allocate(2 * length + 1, 1) : NULL;
  if (copy)
    fg__utf8_take(copy, 2 * length + 1, text, length);
  return copy;
}
