/* Child processes with bounds of time and memory. */
#ifndef FG__CHILD_H
#define FG__CHILD_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct fg__child {
  pid_t process; /* 0: none */
  int socket;    /* to the other one; each end sees when the other process is gone */
} fg__child;

/* Starts a process that calls `serve` and then ends. It prints nothing, has the default
 * handlers of signals, and ends with this process. To be called before threads start.
 * False: there can be none. */
bool fg__child_start(fg__child *out, void (*serve)(void *data, int socket), void *data);

/* Ends it. Returns the signal that had ended it before, if any, else SIGKILL. */
int fg__child_end(fg__child *child);

/* While SIGCHLD is ignored, how a child ended cannot be known: sets its default and
 * returns what it was, for sigaction. */
struct sigaction fg__child_heed(void);

/* To be called by the child. From now on it gets SIGXCPU after `seconds` of CPU time, and
 * no more than so many bytes in addition to those it has. */
void fg__child_bound(unsigned seconds, size_t bytes);
void fg__child_unbound(void);

#endif
