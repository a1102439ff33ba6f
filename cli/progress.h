/* A line on the terminal that says how far a run is. The same is sent as messages through
 * a socket to a process that shows it elsewhere (view/child.h). */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cli_progress {
  bool shown;        /* standard error is a terminal and not quiet */
  int socket;        /* through which messages are sent; 0: none */
  bool drawn;        /* the line is there now */
  double last_drawn; /* seconds of the monotonic clock */
} cli_progress;

/* A message: words, or a density. One that finds the socket full is dropped. */
enum { PROGRESS_WORDS = 80, PROGRESS_NODES = 260 };
typedef struct progress_message {
  double share; /* of the work that `words` name, 0 to 1; negative: not known */
  char words[PROGRESS_WORDS];
  int nodes[2]; /* of the density, along x and y; 0: there are words */
  unsigned char u[PROGRESS_NODES * PROGRESS_NODES]; /* x fastest: 0 missing, else u from
                                                       -1 to 1 as 1 to 255 */
} progress_message;

/* Bytes of a message up to the last node of its density. */
size_t progress_message_size(const progress_message *message);

void progress_start(cli_progress *progress, bool quiet, int socket);

/* Shows a stage's line at once. */
void progress_stage(cli_progress *progress, const char *text);

/* Shows the evolution's state, at most ten times a second. share: of the way, 0 to 1;
 * clusters 0: not known yet; seconds_left negative: not known. */
void progress_evolution(cli_progress *progress, double share, double time, int clusters,
                        double seconds_left);

/* Shows how many of the scales are drawn; nothing when all are. */
void progress_drawing(cli_progress *progress, int ready, int count);

/* Sends a density. */
void progress_density(const cli_progress *progress, const progress_message *message);

/* Wipes the line, before a message and at the end. */
void progress_wipe(cli_progress *progress);

/* Seconds of the monotonic clock. */
double clock_seconds(void);

#endif
