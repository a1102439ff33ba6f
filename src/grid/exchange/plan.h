/* What a plan of an exchange consists of (exchange.h). */
#ifndef FG__EXCHANGE_PLAN_H
#define FG__EXCHANGE_PLAN_H

#include "grid/exchange/brick.h"
#include "grid/exchange/exchange.h"

/* Nodes to fill and where they come from, of which one may be another rank's. */
typedef struct fg__exchange_piece {
  fg__brick to, from;
  int rank; /* of the other side */
} fg__exchange_piece;

typedef struct fg__pieces {
  fg__exchange_piece *piece;
  size_t count, capacity;
} fg__pieces;

typedef struct fg__neighbour {
  int rank;
  size_t first, end; /* of pieces, sent or received */
  int64_t count[8];  /* nodes of each colour */
  float *buffer;
} fg__neighbour;

typedef struct fg__neighbours {
  fg__neighbour *neighbour;
  int count;
  void *requests; /* of fg__requests_create */
} fg__neighbours;

struct fg__exchange {
  const fg__ranks *ranks;
  fg__layout layout; /* of the own block */
  fg__pieces copied, sent, received;
  fg__neighbours senders, receivers;
  int most_arrays;
  float *buffers;
  /* of the exchange under way */
  int arrays;
  float *const *array;
  unsigned colours;
};

/* Nodes whose values go to or come from a neighbour. */
int64_t fg__neighbour_nodes(const fg__neighbour *neighbour, unsigned colours);

#endif
