/* A progress line on the terminal. Messages of the same content go through a socket to
 * the process that shows the run in a browser (view/child.h). */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cli_progress {
  bool shown;        /* standard error is a terminal, and --quiet is not given */
  int socket;        /* socket for messages; 0: none */
  bool drawn;        /* the line is on the terminal */
  double last_drawn; /* seconds of the monotonic clock */
} cli_progress;

/* A message has either text or a density. It is dropped if the socket is full. */
enum { PROGRESS_WORDS = 80, PROGRESS_NODES = 260 };
typedef struct progress_message {
  double share; /* fraction of the work that `words` name, 0 to 1; negative: unknown */
  char words[PROGRESS_WORDS];
  int nodes[2]; /* of the density, along x and y; 0: the message has text */
  unsigned char u[PROGRESS_NODES * PROGRESS_NODES]; /* x fastest: 0 missing, else u from
                                                       -1 to 1 as 1 to 255 */
} progress_message;

/* Bytes of a message up to the last node of its density. */
size_t progress_message_size(const progress_message *message);

void progress_start(cli_progress *progress, bool quiet, int socket);

/* Prints the line of a stage at once. */
void progress_stage(cli_progress *progress, const char *text);

/* Prints the evolution's state, at most ten times a second. share: fraction done, 0 to 1;
 * clusters 0: unknown yet; seconds_left negative: unknown. */
void progress_evolution(cli_progress *progress, double share, double time, int clusters,
                        double seconds_left);

/* Prints how many scales are drawn, unless all are. */
void progress_drawing(cli_progress *progress, int ready, int count);

/* Sends a density. */
void progress_density(const cli_progress *progress, const progress_message *message);

/* Erases the line, before a message and at the end. */
void progress_wipe(cli_progress *progress);

/* Seconds of the monotonic clock. */
double clock_seconds(void);

#endif
