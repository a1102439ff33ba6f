/* An opened input, and the questions it answers. */
#ifndef FG__INPUT_H
#define FG__INPUT_H

#include "read/format.h"
#include "read/isolate/child.h"

/* A library that may crash on damaged files, in a child process. */
typedef struct fg__isolation {
  const char *library; /* NULL: none */
  size_t bytes;        /* of the files that it reads */
  fg__child child;
  bool is_over; /* it crashed, or was ended by its bound: */
  int signal;
  unsigned seconds;
} fg__isolation;

typedef enum fg__question_kind {
  FG__ASK_VECTOR,
  FG__ASK_ALL_VECTORS,
  FG__ASK_FIELD
} fg__question_kind;

typedef struct fg__question {
  fg__question_kind kind;
  int time, level;     /* of a field */
  fg__slab_index slab; /* likewise */
} fg__question;

/* Of a question's kind. */
typedef struct fg__answer {
  fg_inventory *inventory;
  fg_field *field;
} fg__answer;

struct fg_input {
  const char *name;
  fg_read_options options; /* without time and level, and what is `of_cut` */
  fg__field_region of_cut; /* in the plane of a cut: not of the volume */
  fg_map_options volume_map;
  fg__source source;
  const fg__format *format; /* NULL: an analytic field */
  fg__kept kept;
  fg_inventory *inventory; /* of the chosen vector, once it was asked for */
  fg_inventory *all;       /* of all vectors, likewise */
  fg__isolation isolation;
  fg_status (*answer)(fg__answer *out, fg_context *context, fg_input *input,
                      const fg__question *question); /* in this process */
};

#endif
