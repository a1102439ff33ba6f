/* A server of HTTP for browsers on this machine, in one thread. */
#ifndef VIEW_SERVER_H
#define VIEW_SERVER_H

#include <stdbool.h>
#include <stddef.h>

/* What a name stands for. */
typedef struct cli_answer {
  const char *kind;  /* media type; NULL: there is nothing of that name */
  const char *bytes; /* `size` of them; owned by `owned`, or they stay */
  size_t size;
  void *owned; /* ended with free */
} cli_answer;

typedef void give_answer(cli_answer *out, const char *name, void *data);

typedef struct cli_server cli_server;

/* Begins to listen at a port of 127.0.0.1 that the system chooses. Complains; returns an
 * exit code. */
int server_start(cli_server **out);

/* Where it is, "http://127.0.0.1:PORT/TOKEN/". */
enum { ADDRESS_BYTES = 80 };
const char *server_address(const cli_server *server);

/* Waits until there is something to do for it, on `file` (negative: none), or a tenth of
 * a second has passed, and does it. */
void server_turn(cli_server *server, int file, give_answer *give, void *data);

void server_end(cli_server *server);

#endif
