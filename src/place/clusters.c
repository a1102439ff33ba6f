/* Which cluster of a density an icon came from. */
#include "place/placement.h"

#include "cluster/raster.h"
#include "icon/icons.h"

#include <math.h>

/* The node nearest to a coordinate along axis k, on the grid. */
static int node_along(const fg_density_arrays *density, int k, double x)
{
  int node = (int)floor((x - density->origin[k]) / density->spacing[k] + 0.5);
  int last = density->nodes[k] - 1;
  return node < 0 ? 0 : node < last ? node : last;
}

/* The label nearest to a node, of those in a box of `reach` nodes round it; 0: none. */
static int nearest_label(const fg_density_arrays *density, const int *label,
                         const int node[3], int reach)
{
  int low[3], high[3], found = 0;
  int64_t least = 0;
  for (int k = 0; k < 3; ++k) {
    low[k] = node[k] > reach ? node[k] - reach : 0;
    high[k] =
        node[k] + reach < density->nodes[k] ? node[k] + reach : density->nodes[k] - 1;
  }
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x) {
        size_t at = ((size_t)z * (size_t)density->nodes[1] + (size_t)y) *
                        (size_t)density->nodes[0] +
                    (size_t)x;
        int64_t dx = x - node[0], dy = y - node[1], dz = z - node[2];
        int64_t square = dx * dx + dy * dy + dz * dz;
        if (label[at] > 0 && (!found || square < least)) {
          least = square;
          found = label[at];
        }
      }
  return found;
}

fg_status fg_placement_find_clusters(fg_context *context, fg_icons *icons,
                                     const fg_density *density)
{
  if (!icons || !density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "placement: no %s given",
                    icons ? "density" : "icons");
  fg__labels labels;
  const fg_density_arrays *arrays = fg_density_contents(density);
  fg_status status = fg__labels_create(&labels, context, density);
  if (status != FG_STATUS_OK)
    return status;
  int most = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    most = arrays->nodes[k] > most ? arrays->nodes[k] : most;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    fg_icon *icon = fg__icons_change(icons, n);
    int node[3] = {0}, found = 0;
    for (int k = 0; k < arrays->dimension; ++k)
      node[k] = node_along(arrays, k, icon->center[k]);
    for (int reach = 1; !found && reach < 2 * most; reach *= 2) {
      found = nearest_label(arrays, labels.label, node, reach);
      if (found) /* a corner of the box is farther than a side of the next */
        found = nearest_label(arrays, labels.label, node, 2 * reach);
    }
    icon->cluster = found;
  }
  fg__icons_set_clusters(icons, labels.count, 0);
  fg__labels_clear(&labels);
  return status;
}
