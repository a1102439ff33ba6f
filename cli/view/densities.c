#include "view/densities.h"

#include <stdlib.h>
#include <string.h>

enum { HEAD_BYTES = 4 };

void densities_add(view_densities *densities, const progress_message *message)
{
  if (densities->count == MOST_DENSITIES)
    return;
  const size_t nodes = (size_t)message->nodes[0] * (size_t)message->nodes[1];
  unsigned char *bytes = malloc(HEAD_BYTES + nodes);
  if (!bytes)
    return;
  for (int k = 0; k < 2; ++k) {
    bytes[2 * k] = (unsigned char)(message->nodes[k] & 255);
    bytes[2 * k + 1] = (unsigned char)(message->nodes[k] >> 8);
  }
  memcpy(bytes + HEAD_BYTES, message->u, nodes);
  densities->bytes[densities->count] = bytes;
  densities->size[densities->count++] = HEAD_BYTES + nodes;
}

void densities_clear(view_densities *densities)
{
  for (int k = 0; k < densities->count; ++k)
    free(densities->bytes[k]);
  densities->count = 0;
}
