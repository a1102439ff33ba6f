#include "report/json.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"

enum { CHARACTER_BYTES = 3 }; /* of U+EF80 to U+EFFF: 0xEE 0xBE 0x80 to 0xEE 0xBF 0xBF */

static bool is_byte(const unsigned char *text)
{
  return text[0] == 0xee && (text[1] & 0xfe) == 0xbe && (text[2] & 0xc0) == 0x80;
}

/* Bytes of the character at `text` that JSON has as it is; 0: its first byte is written
 * as a character. */
static size_t plain_bytes(const unsigned char *text)
{
  return is_byte(text) ? 0 : character_bytes(text);
}

char *json_print(const cJSON *value)
{
  char *text = cJSON_Print(value);
  const size_t size = text ? strlen(text) + 1 : 0;
  unsigned char *out = text ? cJSON_malloc(CHARACTER_BYTES * size) : NULL;
  size_t used = 0, bytes;
  for (const unsigned char *at = (unsigned char *)text; out && *at; used += bytes) {
    bytes = plain_bytes(at);
    memcpy(out + used, at, bytes);
    at += bytes;
    if (bytes > 0)
      continue;
    out[used] = 0xee;
    out[used + 1] = (unsigned char)(0xbc | *at >> 6);
    out[used + 2] = (unsigned char)(0x80 | (*at++ & 0x3f));
    bytes = CHARACTER_BYTES;
  }
  if (out)
    out[used] = '\0';
  cJSON_free(text);
  return (char *)out;
}

cJSON *json_parse(const char *text)
{
  unsigned char *bytes = text ? malloc(strlen(text) + 1) : NULL;
  size_t used = 0;
  if (!bytes)
    return NULL;
  for (const unsigned char *at = (const unsigned char *)text; *at; ++used)
    if (is_byte(at)) {
      bytes[used] = (unsigned char)(at[1] << 6 | (at[2] & 0x3f));
      at += CHARACTER_BYTES;
    } else {
      bytes[used] = *at++;
    }
  bytes[used] = '\0';
  cJSON *value = cJSON_Parse((char *)bytes);
  free(bytes);
  return value;
}

void json_add_text(cJSON *object, const char *name, const char *text)
{
  if (text)
    cJSON_AddStringToObject(object, name, text);
  else
    cJSON_AddNullToObject(object, name);
}

void json_add_numbers(cJSON *object, const char *name, const double *numbers, int count)
{
  cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(numbers, count));
}

void json_add_words(cJSON *object, const char *name, const char *const *words, int count)
{
  cJSON *array = cJSON_AddArrayToObject(object, name);
  for (int k = 0; k < count; ++k)
    cJSON_AddItemToArray(array, cJSON_CreateString(words[k]));
}
