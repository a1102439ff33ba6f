#include "view/server.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "program.h"
#include "progress.h"
#include "view/request.h"

/* A browser opens at most six connections to a host; further ones wait. */
enum { CONNECTIONS = 16, HEAD_BYTES = 512, TURN_MILLISECONDS = 100 };

/* A connection is closed after this time without data. */
static const double patience_seconds = 10.0;

typedef struct cli_connection {
  int socket;   /* -1: none */
  double moved; /* clock of the last transfer */
  char request[REQUEST_BYTES + 1];
  size_t got;
  char head[HEAD_BYTES]; /* of the answer; empty before */
  size_t head_size, sent;
  cli_answer body;
} cli_connection;

struct cli_server {
  int socket;
  char token[TOKEN_DIGITS + 1], address[ADDRESS_BYTES];
  cli_connection connection[CONNECTIONS];
};

/* Closed in child processes, and non-blocking. */
static bool set_up(int socket)
{
  return fcntl(socket, F_SETFD, FD_CLOEXEC) == 0 &&
         fcntl(socket, F_SETFL, O_NONBLOCK) == 0;
}

static int make_token(char out[TOKEN_DIGITS + 1])
{
  static const char source[] = "/dev/urandom";
  unsigned char bytes[TOKEN_DIGITS / 2] = {0};
  int file = open(source, O_RDONLY | O_CLOEXEC);
  ssize_t got = file >= 0 ? read(file, bytes, sizeof bytes) : -1;
  int code = got == (ssize_t)sizeof bytes ? EXIT_DONE
                                          : complain_of_file(source, "cannot be read");
  if (file >= 0)
    close(file);
  for (size_t k = 0; !code && k < sizeof bytes; ++k)
    snprintf(out + 2 * k, 3, "%02x", bytes[k]);
  return code;
}

static int listen_here(cli_server *server)
{
  struct sockaddr_in here = {.sin_family = AF_INET,
                             .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  socklen_t size = sizeof here;
  server->socket = socket(AF_INET, SOCK_STREAM, 0);
  if (server->socket < 0 || !set_up(server->socket) ||
      bind(server->socket, (struct sockaddr *)&here, size) != 0 ||
      listen(server->socket, CONNECTIONS) != 0 ||
      getsockname(server->socket, (struct sockaddr *)&here, &size) != 0)
    return complain_of_file("127.0.0.1", "cannot be listened at");
  snprintf(server->address, ADDRESS_BYTES, "http://127.0.0.1:%d/%s/",
           ntohs(here.sin_port), server->token);
  return EXIT_DONE;
}

int server_start(cli_server **out)
{
  cli_server *server = *out = calloc(1, sizeof *server);
  if (!server)
    return complain_of_memory("the server");
  server->socket = -1;
  for (int k = 0; k < CONNECTIONS; ++k)
    server->connection[k].socket = -1;
  int code = make_token(server->token);
  return code ? code : listen_here(server);
}

const char *server_address(const cli_server *server)
{
  return server->address;
}

static void close_connection(cli_connection *connection)
{
  if (connection->socket >= 0)
    close(connection->socket);
  free(connection->body.owned);
  connection->body = (cli_answer){.kind = NULL};
  connection->socket = -1;
}

static void accept_all(cli_server *server)
{
  for (int k = 0; k < CONNECTIONS; ++k) {
    cli_connection *connection = &server->connection[k];
    if (connection->socket >= 0)
      continue;
    connection->socket = accept(server->socket, NULL, NULL);
    if (connection->socket < 0)
      return;
    connection->moved = clock_seconds();
    connection->got = connection->head_size = connection->sent = 0;
    if (!set_up(connection->socket))
      close_connection(connection);
  }
}

static const char *words_of(int status)
{
  switch (status) {
  case 200:
    return "OK";
  case 400:
    return "Bad Request";
  case 403:
    return "Forbidden";
  case 404:
    return "Not Found";
  case 405:
    return "Method Not Allowed";
  default:
    return "Request Header Fields Too Large";
  }
}

/* Content must not be cached, embedded in other pages, or sent as a referrer. */
static void answer(cli_connection *connection, int status)
{
  cli_answer *body = &connection->body;
  if (status != 200) {
    body->kind = "text/plain";
    body->bytes = words_of(status);
    body->size = strlen(body->bytes);
  }
  connection->head_size =
      (size_t)snprintf(connection->head, HEAD_BYTES,
                       "HTTP/1.1 %d %s\r\n"
                       "Content-Type: %s; charset=utf-8\r\n"
                       "Content-Length: %zu\r\n"
                       "%s"
                       "Connection: close\r\n"
                       "Cache-Control: no-store\r\n"
                       "Cross-Origin-Resource-Policy: same-origin\r\n"
                       "Referrer-Policy: no-referrer\r\n"
                       "X-Content-Type-Options: nosniff\r\n"
                       "X-Frame-Options: DENY\r\n\r\n",
                       status, words_of(status), body->kind, body->size,
                       status == 405 ? "Allow: GET\r\n" : "");
}

static void respond(const cli_server *server, cli_connection *connection,
                    give_answer *give, void *data)
{
  char name[REQUEST_NAME_BYTES];
  int status = request_read(name, connection->request, server->token);
  if (status == 200) {
    give(&connection->body, name, data);
    if (!connection->body.kind)
      status = 404;
  }
  answer(connection, status);
}

static bool is_again(ssize_t moved)
{
  return moved < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
}

static void receive(const cli_server *server, cli_connection *connection,
                    give_answer *give, void *data)
{
  const ssize_t got = recv(connection->socket, connection->request + connection->got,
                           REQUEST_BYTES - connection->got, 0);
  if (is_again(got))
    return;
  if (got <= 0) {
    close_connection(connection);
    return;
  }
  connection->moved = clock_seconds();
  connection->got += (size_t)got;
  connection->request[connection->got] = '\0';
  if (request_is_whole(connection->request))
    respond(server, connection, give, data);
  else if (connection->got == REQUEST_BYTES)
    answer(connection, 431);
}

/* Reads the rest of a request; closing with unread data would reset the connection. */
static void drain(cli_connection *connection)
{
  enum { TURNS = 16 };
  shutdown(connection->socket, SHUT_WR);
  for (int k = 0; k < TURNS; ++k)
    if (recv(connection->socket, connection->request, REQUEST_BYTES, 0) <= 0)
      return;
}

static void send_more(cli_connection *connection)
{
  const cli_answer *body = &connection->body;
  const bool in_head = connection->sent < connection->head_size;
  const size_t at = in_head ? connection->sent : connection->sent - connection->head_size;
  const char *bytes = in_head ? connection->head : body->bytes;
  const size_t size = in_head ? connection->head_size : body->size;
  const ssize_t sent = send(connection->socket, bytes + at, size - at, MSG_NOSIGNAL);
  if (is_again(sent))
    return;
  if (sent > 0) {
    connection->moved = clock_seconds();
    connection->sent += (size_t)sent;
  }
  const bool whole = connection->sent == connection->head_size + body->size;
  if (whole)
    drain(connection);
  if (sent < 0 || whole)
    close_connection(connection);
}

static void serve(const cli_server *server, cli_connection *connection, short events,
                  give_answer *give, void *data)
{
  if (events && !connection->head_size)
    receive(server, connection, give, data);
  else if (events)
    send_more(connection);
  else if (clock_seconds() - connection->moved > patience_seconds)
    close_connection(connection);
}

void server_turn(cli_server *server, int file, give_answer *give, void *data)
{
  struct pollfd ready[CONNECTIONS + 2];
  bool has_room = false;
  for (int k = 0; k < CONNECTIONS; ++k) {
    const cli_connection *connection = &server->connection[k];
    ready[k] = (struct pollfd){.fd = connection->socket,
                               .events = connection->head_size ? POLLOUT : POLLIN};
    has_room = has_room || connection->socket < 0;
  }
  ready[CONNECTIONS] =
      (struct pollfd){.fd = has_room ? server->socket : -1, .events = POLLIN};
  ready[CONNECTIONS + 1] = (struct pollfd){.fd = file, .events = POLLIN};
  if (poll(ready, CONNECTIONS + 2, TURN_MILLISECONDS) < 0)
    return; /* interrupted by a signal */
  for (int k = 0; k < CONNECTIONS; ++k)
    if (server->connection[k].socket >= 0)
      serve(server, &server->connection[k], ready[k].revents, give, data);
  if (ready[CONNECTIONS].revents)
    accept_all(server);
}

void server_end(cli_server *server)
{
  if (!server)
    return;
  for (int k = 0; k < CONNECTIONS; ++k)
    close_connection(&server->connection[k]);
  if (server->socket >= 0)
    close(server->socket);
  free(server);
}
