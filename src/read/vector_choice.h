/* What a call reads of datasets: files that are open, and a vector chosen in them. */
#ifndef FG__VECTOR_CHOICE_H
#define FG__VECTOR_CHOICE_H

#include "interpret/interpret.h"
#include "read/format.h"

typedef struct fg__vector_choice {
  fg__dataset data;
  fg__pair pair;
  fg__grid grid;
  bool is_kept;                  /* for later calls */
  int time;                      /* for which it was chosen */
  char doubts[FG__REASON_BYTES]; /* of the grid, before samples are read */
} fg__vector_choice;

/* Opens the source and chooses the vector, or takes what is kept of an earlier call. *out
 * is NULL after a failure. */
fg_status fg__vector_choice_enter(fg__vector_choice **out, fg_context *context,
                                  const fg__format *format, const fg__source *source,
                                  const fg_read_options *options);

/* Closes what is not kept. Returns the status, that of the call, or that of a further
 * file which has become shorter. `choice` may be NULL. */
fg_status fg__vector_choice_leave(fg__vector_choice *choice, fg_status status);

#endif
