#include "rival/cluster/bisect.h"
#include "rival/method.h"

#include "base/memory.h"

#include <stdlib.h>

/* Clusters get their numbers in the order of their first cells. */
static fg_status number_cells(const fg__bisection *bisection, const fg_rival *rival,
                              int *label)
{
  size_t parts = (size_t)bisection->parts;
  int *number = fg__allocate(parts + 1, sizeof *number), given = 0;
  if (!number)
    return fg__fail_memory(rival->context, "clusters", (parts + 1) * sizeof *number);
  for (int n = 0; n < bisection->parts; n++)
    for (int i = 0; i < bisection->part[n].count; i++)
      label[bisection->cell[bisection->part[n].first + i]] = n + 1;
  const fg__domain *domain = &rival->domain;
  for (int i = 0; i < domain->cells[0] * domain->cells[1]; i++) {
    if (label[i] > 0 && !number[label[i]])
      number[label[i]] = ++given;
    label[i] = number[label[i]];
  }
  free(number);
  return FG_STATUS_OK;
}

fg_status fg__rival_top_down(const fg_rival *rival, int count, int *label, int *found,
                             int *left_out)
{
  fg__bisection bisection;
  fg_status status = fg__bisect(&bisection, rival->context, &rival->domain, count);
  if (status != FG_STATUS_OK)
    return status;
  *found = bisection.parts;
  *left_out = 0;
  status = number_cells(&bisection, rival, label);
  fg__bisection_clear(&bisection);
  return status;
}
