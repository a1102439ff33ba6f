#include "grid/box.h"

fg__box fg__box_halved(const fg__box *fine)
{
  fg__box even;
  for (int k = 0; k < 3; ++k) {
    int end = fine->first[k] + fine->nodes[k];
    even.first[k] = (fine->first[k] + 1) / 2;
    even.nodes[k] = (end + 1) / 2 - even.first[k];
  }
  return even;
}

fg__box fg__box_intersection(const fg__box *a, const fg__box *b)
{
  fg__box out;
  for (int k = 0; k < 3; ++k) {
    int a_end = a->first[k] + a->nodes[k], b_end = b->first[k] + b->nodes[k];
    out.first[k] = a->first[k] > b->first[k] ? a->first[k] : b->first[k];
    out.nodes[k] = (a_end < b_end ? a_end : b_end) - out.first[k];
  }
  return out;
}
