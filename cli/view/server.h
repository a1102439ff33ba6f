/* An HTTP server for browsers on this machine, in one thread. */
#ifndef VIEW_SERVER_H
#define VIEW_SERVER_H

#include <stdbool.h>
#include <stddef.h>

/* The content of a name. */
typedef struct cli_answer {
  const char *kind;  /* media type; NULL: no such name */
  const char *bytes; /* `size` bytes, owned by `owned` or static */
  size_t size;
  void *owned; /* to be freed */
} cli_answer;

typedef void give_answer(cli_answer *out, const char *name, void *data);

typedef struct cli_server cli_server;

/* Listens on a port of 127.0.0.1 that the system chooses. Prints errors; returns an exit
 * code. */
int server_start(cli_server **out);

/* Its address, "http://127.0.0.1:PORT/TOKEN/". */
enum { ADDRESS_BYTES = 80 };
const char *server_address(const cli_server *server);

/* Waits for requests, for input on `file` (negative: none), or for a tenth of a second,
 * and answers requests. */
void server_turn(cli_server *server, int file, give_answer *give, void *data);

void server_end(cli_server *server);

#endif
