#include "rival/method.h"

fg_status fg__rival_discrete(const fg_rival *rival, int count, int *label, int *found,
                             int *left_out)
{
  return fg__merge_tree_cut(&rival->tree, rival->context, count, label, found, left_out);
}

fg_status fg__rival_discrete_prepare(fg_rival *rival)
{
  fg__merge_weights weights = {.position = rival->options.position_weight,
                               .elongation = rival->options.elongation};
  return fg__merge_tree_create(&rival->tree, rival->context, &rival->domain, &weights);
}
