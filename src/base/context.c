#include "base/context.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* for the analyzer these are also macros */
#undef fg__fail
#undef fg__fail_memory

enum { MESSAGE_BYTES = 2048 };

struct fg_context {
  char message[MESSAGE_BYTES];
  char hint[MESSAGE_BYTES];
  bool hint_open; /* the last failure is the one recorded, and has no hint yet */
  atomic_int stop;
  atomic_int *stop_beside; /* of another context, or NULL */
  fg_input_options input;
  void *shared; /* see fg__context_share */
  void (*end_sharing)(void *shared);
};

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *fg_version(void)
{
  return TEXT(FG_VERSION_MAJOR) "." TEXT(FG_VERSION_MINOR) "." TEXT(FG_VERSION_PATCH);
}

const char *fg_status_name(fg_status status)
{
  switch (status) {
  case FG_STATUS_OK:
    return "done";
  case FG_STATUS_MEMORY:
    return "out of memory";
  case FG_STATUS_ARGUMENT:
    return "impossible request";
  case FG_STATUS_FILE_ACCESS:
    return "file not accessible";
  case FG_STATUS_FILE_FORMAT:
    return "malformed file";
  case FG_STATUS_UNSUPPORTED:
    return "not supported";
  case FG_STATUS_NO_CONVERGENCE:
    return "no convergence";
  case FG_STATUS_STOPPED:
    return "stopped";
  case FG_STATUS_MPI:
    return "message passing failed";
  }
  return "unknown status";
}

fg_status fg_context_create(fg_context **out)
{
  if (!out)
    return FG_STATUS_ARGUMENT;
  *out = calloc(1, sizeof **out);
  return *out ? FG_STATUS_OK : FG_STATUS_MEMORY;
}

fg_status fg__context_create_beside(fg_context **out, fg_context *beside)
{
  fg_status status = fg_context_create(out);
  if (status != FG_STATUS_OK)
    return fg__fail_memory(beside, "a context", sizeof **out);
  if (beside)
    (*out)->stop_beside = beside->stop_beside ? beside->stop_beside : &beside->stop;
  return FG_STATUS_OK;
}

void fg_context_destroy(fg_context *context)
{
  if (context && context->end_sharing)
    context->end_sharing(context->shared);
  free(context);
}

void fg__context_share(fg_context *context, void *shared, void (*end)(void *shared))
{
  context->shared = shared;
  context->end_sharing = end;
}

void *fg__context_shared(const fg_context *context)
{
  return context ? context->shared : NULL;
}

void fg_context_set_input(fg_context *context, const fg_input_options *options)
{
  if (context)
    context->input = options ? *options : (fg_input_options){0};
}

const fg_input_options *fg__context_input(const fg_context *context)
{
  static const fg_input_options none = {0};
  return context ? &context->input : &none;
}

fg_status fg__check_memory(fg_context *context, const char *name, double samples,
                           double bytes)
{
  const double most = fg__context_input(context)->most_memory;
  if (!(most > 0.0) || samples * bytes <= most)
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_UNSUPPORTED,
           "%s: a field of %.0f samples takes %.4g MB; %.4g MB may be used", name,
           samples, samples * bytes / 1e6, most / 1e6);
  fg__hint(context, "--max-memory SIZE allows more");
  return FG_STATUS_UNSUPPORTED;
}

const char *fg_context_message(const fg_context *context)
{
  return context ? context->message : "";
}

const char *fg_context_hint(const fg_context *context)
{
  return context ? context->hint : "";
}

void fg_context_clear(fg_context *context)
{
  if (!context)
    return;
  context->message[0] = '\0';
  context->hint[0] = '\0';
  context->hint_open = false;
}

void fg_context_stop(fg_context *context)
{
  if (context)
    atomic_store(&context->stop, 1);
}

/* File names and attribute texts come from outside: a line end or a control character in
 * them must not break the promise of one line. */
static void keep_one_line(char *text)
{
  for (char *c = text; *c; ++c)
    if ((unsigned char)*c < 0x20 || *c == 0x7f)
      *c = '?';
}

fg_status fg__fail(fg_context *context, fg_status status, const char *format, ...)
{
  if (!context)
    return status;
  context->hint_open = !context->message[0]; /* not for what is dropped */
  if (!context->hint_open)
    return status;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(context->message, sizeof context->message, format, arguments);
  va_end(arguments);
  keep_one_line(context->message);
  return status;
}

fg_status fg__fail_memory(fg_context *context, const char *what, size_t bytes)
{
  return fg__fail(context, FG_STATUS_MEMORY, "out of memory: %zu bytes for %s", bytes,
                  what);
}

void fg__hint(fg_context *context, const char *format, ...)
{
  if (!context || !context->hint_open)
    return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(context->hint, sizeof context->hint, format, arguments);
  va_end(arguments);
  keep_one_line(context->hint);
  context->hint_open = false;
}

fg_status fg__check_stop(fg_context *context)
{
  if (context && (atomic_load(&context->stop) ||
                  (context->stop_beside && atomic_load(context->stop_beside))))
    return fg__fail(context, FG_STATUS_STOPPED, "stopped on request");
  return FG_STATUS_OK;
}
