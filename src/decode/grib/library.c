/* ecCodes behind a guard. It was made for sound messages: at others it may print or abort
 * the process. (The child process that reads for the program bounds its memory.) */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Beyond the message, for readers that look a few bytes too far. */
enum { BEHIND = 64 };

typedef struct guard {
  jmp_buf back;
  bool active;
  char reason[FG__TEXT_BYTES];
} guard;

static _Thread_local guard here;

/* "ecCodes assertion failed: `x >= 0' in /usr/src/eccodes/src/y.c:12" */
static void leave(const char *message)
{
  if (!here.active)
    abort();
  const char *begin = strchr(message, '`'), *end = begin ? strchr(begin, '\'') : NULL;
  here.active = false;
  if (end)
    snprintf(here.reason, sizeof here.reason, "ecCodes finds that %.*s does not hold",
             end - begin - 1 < FG__GRIB_WORD ? (int)(end - begin - 1) : FG__GRIB_WORD,
             begin + 1);
  else
    snprintf(here.reason, sizeof here.reason, "ecCodes can not go on with it");
  longjmp(here.back, 1);
}

static void say_nothing(const codes_context *context, int level, const char *message)
{
  (void)context;
  (void)level;
  (void)message;
}

static void begin(void)
{
  codes_context_set_logging_proc(codes_context_get_default(), say_nothing);
  codes_set_codes_assertion_failed_proc(leave);
  here.active = true;
}

static void end(void)
{
  here.active = false;
  codes_context_set_logging_proc(codes_context_get_default(), NULL);
  codes_set_codes_assertion_failed_proc(NULL);
}

static bool try_work(unsigned char *message, size_t size,
                     void (*work)(codes_handle *handle, void *data), void *data)
{
  if (setjmp(here.back)) {
    end();
    return false;
  }
  begin();
  codes_handle *handle = codes_handle_new_from_message(NULL, message, size);
  work(handle, data);
  if (handle)
    codes_handle_delete(handle);
  end();
  return true;
}

static void put_number(unsigned char *at, uint64_t number, int bytes)
{
  for (int k = bytes - 1; k >= 0; --k, number >>= 8)
    at[k] = (unsigned char)(number & 255);
}

/* The field's message: where there are others in it, one of its own sections. */
static size_t copy_message(unsigned char *out, const fg__grib_field *field)
{
  if (field->alone) {
    memcpy(out, field->message, field->size);
    return field->size;
  }
  size_t used = 16, size = 0;
  memcpy(out, field->message, used);
  for (int n = 1; n < FG__GRIB_SECTIONS; ++n) {
    const unsigned char *section = fg__grib_section(field, n, &size);
    if (!section)
      continue;
    memcpy(out + used, section, size);
    used += size;
  }
  for (int k = 0; k < 4; ++k)
    out[used++] = '7';
  put_number(out + 8, used, 8);
  return used;
}

fg_status fg__grib_guard(const fg__grib_file *file, const fg__grib_field *field,
                         void (*work)(codes_handle *handle, void *data), void *data)
{
  /* sections that fields share: their sum is less than the message and its last bitmap */
  unsigned char *message = fg__allocate(2 * field->size + BEHIND, 1);
  if (!message)
    return fg__fail_memory(file->context, "a message", 2 * field->size + BEHIND);
  const size_t size = copy_message(message, field);
  const bool done = try_work(message, size, work, data);
  free(message);
  if (done)
    return FG_STATUS_OK;
  return fg__fail(file->context, FG_STATUS_FILE_FORMAT, "%s: message %zu is damaged: %s",
                  file->path, field->number, here.reason);
}

void fg__grib_word(codes_handle *handle, const char *key, char *out, size_t size)
{
  char text[FG__TEXT_BYTES] = "";
  size_t length = sizeof text;
  out[0] = '\0';
  if (codes_get_string(handle, key, text, &length) == CODES_SUCCESS)
    snprintf(out, size, "%.*s", (int)size - 1, text);
}
