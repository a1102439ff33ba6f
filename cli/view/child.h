/* A run in a process of its own, while this one shows what it makes. */
#ifndef VIEW_CHILD_H
#define VIEW_CHILD_H

#include <sys/types.h>

#include "option/settings.h"
#include "view/densities.h"

typedef struct cli_child {
  pid_t process;      /* 0: none, or it has ended */
  int socket;         /* from which its messages are received (progress.h); -1: none */
  const char *folder; /* of the results */
  char *temporary;    /* that folder, where it goes at the end; NULL: the user's own */
  bool began;         /* it has read its input, and evolves */
  double share;       /* of the last message with words */
  char doing[PROGRESS_WORDS]; /* its words */
  view_densities densities;
  int code; /* its exit code, once it has ended */
} cli_child;

/* Starts the run of `settings`, in their folder or a temporary one. `close` is what the
 * child ends first of what it got from this process. Complains; returns an exit code. */
int child_start(cli_child *out, const run_settings *settings, void (*close)(void *data),
                void *data);

/* Receives its messages, and its exit code once it has ended. */
void child_look(cli_child *child);

/* Passes a signal on: the run keeps its scales, a second one ends its drawing, too. With
 * a temporary folder there is nothing to keep. */
void child_interrupt(cli_child *child);

/* Ends it, and removes a temporary folder. */
void child_end(cli_child *child);

#endif
