/* Values between two processes of one program: the same calls send and receive. */
#ifndef FG__WIRE_H
#define FG__WIRE_H

#include "base/context.h"

typedef struct fg__wire {
  int socket;
  bool sends;
  fg_context *context; /* NULL, or one whose stop ends the waiting for bytes */
  fg_status status;    /* after a failure calls do nothing: FILE_ACCESS (the other process
                          is gone), STOPPED, MEMORY */
  void **owned;        /* what was received, until it is cleared */
  size_t count, capacity;
} fg__wire;

void fg__wire_bytes(fg__wire *wire, void *bytes, size_t size);

/* A text, or NULL; the wire owns one that is received. */
void fg__wire_text(fg__wire *wire, const char **text);
void fg__wire_clear(fg__wire *wire);

/* An inventory; one that is received is made, or is NULL after a failure. */
void fg__wire_inventory(fg__wire *wire, fg_inventory **inventory);

/* A field that is no window, likewise. One that is sent keeps no samples. */
void fg__wire_field(fg__wire *wire, fg_field **field);

#endif
