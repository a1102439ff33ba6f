/* What ranks need of a library that sends messages. Only ranks.c calls it, and only where
 * there are several ranks; mpi.c is the one implementation. Counts are of elements. All
 * but send, receive and the requests are collective. */
#ifndef FG__TRANSPORT_H
#define FG__TRANSPORT_H

#include <stddef.h>
#include <stdint.h>

#include "grid/ranks.h"

struct fg__transport {
  /* reductions over all ranks, in place: sums modulo 2^64, exclusive or, greatest */
  void (*add)(void *group, uint64_t *sum, int count);
  void (*combine)(void *group, uint32_t *word, int count);
  void (*greatest)(void *group, double *value, int count);
  void (*greatest_word)(void *group, uint64_t *word, int count);
  /* the pair {order, value} of the least order */
  void (*first)(void *group, int pair[2]);
  void (*broadcast)(void *group, void *bytes, int count, int from);
  /* blocking; send returns when the receiver has begun to take it */
  void (*send)(void *group, const void *bytes, int count, int to);
  int (*receive)(void *group, void *bytes, int most, int from);
  /* one message each way, of `count` floats; -1: to or from nobody */
  void (*swap)(void *group, int tag, int count, const float *sent, int to,
               float *received, int from);
  /* all ranks' pieces on every rank */
  void (*gather)(void *group, const float *sent, int sent_count, float *received,
                 const int counts[], const int offsets[]);
  /* a piece from each rank to each, of elements of `size` bytes */
  void (*deal)(void *group, size_t size, const void *sent, const int sent_counts[],
               const int sent_offsets[], void *received, const int counts[],
               const int offsets[]);
  /* non-blocking messages of floats: request n of an array whose elements have
   * request_size bytes; a message of 0 floats is none */
  size_t request_size;
  void (*begin_send)(void *group, void *requests, int n, const float *sent, int count,
                     int to);
  void (*begin_receive)(void *group, void *requests, int n, float *received, int count,
                        int from);
  void (*wait)(void *requests, int count);
  void (*end)(void *group); /* frees it, and the ranks that it is of */
};

#endif
