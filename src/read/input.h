/* An opened input, and the questions it answers. */
#ifndef FG__INPUT_H
#define FG__INPUT_H

#include "read/format.h"

struct fg_input {
  const char *name;
  fg_read_options options; /* without time and level */
  fg__source source;
  const fg__format *format; /* NULL: an analytic field */
  fg__kept kept;
  fg_inventory *inventory; /* of the chosen vector, once it was asked for */
};

typedef enum fg__question_kind {
  FG__ASK_DEFAULTS,
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
  fg_read_defaults defaults;
  fg_inventory *inventory;
  fg_field *field;
} fg__answer;

/* Answers a question in this process. */
fg_status fg__input_answer(fg__answer *out, fg_context *context, fg_input *input,
                           const fg__question *question);

#endif
