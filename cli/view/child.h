/* A run in a child process, while this process shows its results. */
#ifndef VIEW_CHILD_H
#define VIEW_CHILD_H

#include <sys/types.h>

#include "option/settings.h"
#include "view/densities.h"

typedef struct cli_child {
  pid_t process;              /* 0: none, or ended */
  int socket;                 /* receives its messages (progress.h); -1: none */
  const char *folder;         /* of the results */
  char *temporary;            /* removed at the end; NULL: the user's own folder */
  bool began;                 /* input is read, the evolution has started */
  double share;               /* of the last text message */
  char doing[PROGRESS_WORDS]; /* text of that message */
  view_densities densities;
  int code; /* its exit code, once it has ended */
} cli_child;

/* Starts the run of `settings`, in their folder or in a temporary one. `close` is called
 * in the child to close what it inherits. Prints errors; returns an exit code. */
int child_start(cli_child *out, const run_settings *settings, void (*close)(void *data),
                void *data);

/* Receives messages and, once it has ended, its exit code. */
void child_receive(cli_child *child);

/* Passes an interrupt on: the run stops and keeps its scales; the second one also stops
 * the drawing. In a temporary folder the run ends at once. */
void child_interrupt(cli_child *child);

/* Ends the child and removes a temporary folder. */
void child_end(cli_child *child);

#endif
