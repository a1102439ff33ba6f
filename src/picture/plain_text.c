#include "picture/plain_text.h"

#include <string.h>

#include "base/utf8.h"

void fg__text_clean(char *out, size_t capacity, const char *text)
{
  const unsigned char *in = (const unsigned char *)text;
  size_t used = 0;
  while (*in) {
    size_t bytes = fg__utf8_bytes(in);
    size_t wanted = bytes ? bytes : 1;
    if (used + wanted >= capacity)
      break;
    if (bytes == 0)
      out[used] = '?';
    else if (bytes == 1 && (*in < 0x20 || *in == 0x7F))
      out[used] = ' ';
    else
      memcpy(out + used, in, bytes);
    used += wanted;
    in += wanted;
  }
  out[used] = '\0';
}
