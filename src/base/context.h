/* Statuses, messages and the stop flag, as the library's own files use them. */
#ifndef FG__CONTEXT_H
#define FG__CONTEXT_H

#include "flowgrain/flowgrain.h"

/* Records a failure and returns its status, so that a caller writes
 *     return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: ...", path, ...);
 * Only the first failure is kept. A NULL context keeps nothing. */
fg_status fg__fail(fg_context *context, fg_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Records that `bytes` could not be had for `what`; returns FG_STATUS_MEMORY. */
fg_status fg__fail_memory(fg_context *context, const char *what, size_t bytes);

#if defined(__clang_analyzer__)
/* What the analyzer can not see across files: these return the status they were given. */
#define fg__fail(context, status, ...) (fg__fail(context, status, __VA_ARGS__), status)
#define fg__fail_memory(context, what, bytes)                                            \
  (fg__fail_memory(context, what, bytes), FG_STATUS_MEMORY)
#endif

/* Adds the line that says what to do about the failure just recorded. Later hints are
 * dropped like later failures. */
void fg__hint(fg_context *context, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* What the ranks are that share the context's work (ranks.h); ended with the context.
 * NULL: none. */
void fg__context_share(fg_context *context, void *shared, void (*end)(void *shared));
void *fg__context_shared(const fg_context *context);

/* What fg_context_set_input has set; of a NULL context the defaults. */
const fg_input_options *fg__context_input(const fg_context *context);

/* Refuses a field whose samples, so many of so many bytes, take more memory than the
 * context allows: "NAME: ...". UNSUPPORTED. */
fg_status fg__check_memory(fg_context *context, const char *name, double samples,
                           double bytes);

/* Creates a context for a thread, which stops when `beside` does. MEMORY. */
fg_status fg__context_create_beside(fg_context **out, fg_context *beside);

/* FG_STATUS_STOPPED once fg_context_stop was called, else FG_STATUS_OK. */
fg_status fg__check_stop(fg_context *context);

#endif
