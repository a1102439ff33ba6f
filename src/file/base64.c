#include "file/base64.h"

#include <stdint.h>
#include <string.h>

static const char ALPHABET[] =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

enum { PADDING = -1, WRONG = -2 };

static bool is_space(unsigned char c)
{
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

static int value_of(unsigned char c)
{
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  if (c == '+')
    return 62;
  if (c == '/')
    return 63;
  return c == '=' ? PADDING : WRONG;
}

/* Decodes the next four characters into 1 to 3 bytes. */
static bool read_group(fg__base64 *base64)
{
  uint32_t bits = 0;
  int characters = 0, padding = 0;
  while (characters < 4) {
    if (base64->at == base64->size)
      return false;
    unsigned char c = base64->text[base64->at++];
    if (is_space(c))
      continue;
    int value = value_of(c);
    if (value == WRONG || (value != PADDING && padding > 0))
      return false;
    if (value == PADDING) {
      ++padding;
      value = 0;
    }
    bits = bits << 6 | (uint32_t)value;
    ++characters;
  }
  if (padding > 2)
    return false;
  base64->ready_count = 3 - padding;
  for (int i = 0; i < base64->ready_count; ++i)
    base64->ready[i] = (unsigned char)(bits >> (16 - 8 * i));
  return true;
}

bool fg__base64_read(fg__base64 *base64, unsigned char *out, size_t count)
{
  while (count > 0) {
    if (base64->ready_count == 0 && !read_group(base64))
      return false;
    size_t take =
        (size_t)base64->ready_count < count ? (size_t)base64->ready_count : count;
    if (out) {
      memcpy(out, base64->ready, take);
      out += take;
    }
    base64->ready_count -= (int)take;
    memmove(base64->ready, base64->ready + take, (size_t)base64->ready_count);
    count -= take;
  }
  return true;
}

bool fg__base64_ended(const fg__base64 *base64)
{
  if (base64->ready_count != 0)
    return false;
  for (size_t i = base64->at; i < base64->size; ++i)
    if (!is_space(base64->text[i]))
      return false;
  return true;
}

size_t fg__base64_available(const fg__base64 *base64)
{
  return (base64->size - base64->at) / 4 * 3 + (size_t)base64->ready_count;
}

size_t fg__base64_length(size_t count)
{
  if (count > SIZE_MAX / 4 * 3 - 2)
    return 0;
  return (count + 2) / 3 * 4;
}

void fg__base64_encode(char *out, const unsigned char *bytes, size_t count)
{
  for (size_t i = 0; i < count; i += 3) {
    size_t have = count - i < 3 ? count - i : 3;
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < have ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k)
      *out++ = k <= have ? ALPHABET[bits >> (18 - 6 * k) & 63u] : '=';
  }
}
