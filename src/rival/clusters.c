#include "rival/clusters.h"

#include "base/memory.h"
#include "icon/icons.h"
#include "icon/measure.h"
#include "rival/arrows.h"

#include <math.h>
#include <stdlib.h>

/* Where the arrow through the centre is less than this share of what it should be, as in
 * a vortex core, arrows beside it are tried, at this share of the root of the area. */
static const double SHORT = 0.7;
static const double ASIDE = 0.3;

/* One cluster's sums. */
typedef struct cluster {
  int cells, first;
  double way[2];    /* sum of the ways from the first cell's centre */
  double center[2]; /* the mean, or the cell nearest to it */
  double nearest;   /* of the cells, squared distance to the mean */
} cluster;

static void way_between(const fg__domain *domain, const double from[2],
                        const double to[2], double way[2])
{
  for (int k = 0; k < 2; k++)
    way[k] = to[k] - from[k];
  fg__domain_shortest(domain, way);
}

static void find_means(cluster *clusters, const fg__domain *domain, const int *label,
                       int count)
{
  int raster = domain->cells[0] * domain->cells[1];
  for (int i = 0; i < raster; i++) {
    if (label[i] < 1)
      continue;
    cluster *c = &clusters[label[i] - 1];
    if (c->cells++ == 0)
      c->first = i;
    double from[2], to[2], way[2];
    fg__domain_center(domain, c->first, from);
    fg__domain_center(domain, i, to);
    way_between(domain, from, to, way);
    for (int k = 0; k < 2; k++)
      c->way[k] += way[k];
  }
  for (int n = 0; n < count; n++) {
    cluster *c = &clusters[n];
    fg__domain_center(domain, c->first, c->center);
    for (int k = 0; k < 2; k++)
      c->center[k] += c->way[k] / c->cells;
    c->nearest = HUGE_VAL;
  }
}

/* A cluster bent like a bow has its mean outside. */
static fg_status find_centers(cluster *clusters, fg_context *context,
                              const fg__domain *domain, const int *label, int count)
{
  double(*mean)[2] = fg__allocate((size_t)count, sizeof *mean);
  if (!mean)
    return fg__fail_memory(context, "the clusters' centres",
                           (size_t)count * sizeof *mean);
  for (int n = 0; n < count; n++) {
    for (int k = 0; k < 2; k++)
      mean[n][k] = clusters[n].center[k];
    int cell = fg__domain_cell(domain, mean[n]);
    if (cell >= 0 && label[cell] == n + 1)
      clusters[n].nearest = 0;
  }
  for (int i = 0; i < domain->cells[0] * domain->cells[1]; i++) {
    if (label[i] < 1 || clusters[label[i] - 1].nearest <= 0)
      continue;
    cluster *c = &clusters[label[i] - 1];
    double center[2], way[2];
    fg__domain_center(domain, i, center);
    way_between(domain, mean[label[i] - 1], center, way);
    double distance = way[0] * way[0] + way[1] * way[1];
    if (distance < c->nearest) {
      c->nearest = distance;
      for (int k = 0; k < 2; k++)
        c->center[k] = center[k];
    }
  }
  free(mean);
  return FG_STATUS_OK;
}

static void free_points(fg_icon *icon)
{
  free((void *)(uintptr_t)icon->points);
  icon->points = NULL;
}

static double length_of(const fg_icon *icon)
{
  return icon->points ? fg__icon_length(icon) : 0.0;
}

/* The arrow through the centre, or a longer one beside it. */
static fg_status make_icon(fg_icon *icon, fg_context *context, const fg__domain *domain,
                           const int *label, const cluster *c, fg__streamline *line)
{
  static const int side[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  int number = icon->cluster;
  double area = c->cells * domain->spacing[0] * domain->spacing[1], wanted = sqrt(area);
  icon->area = area;
  fg_status status = fg__rival_curved(icon, context, domain, c->center, wanted, line);
  double length = length_of(icon);
  for (int d = 0; d < 4 && status == FG_STATUS_OK && length < SHORT * wanted; d++) {
    double beside[2] = {c->center[0] + ASIDE * wanted * side[d][0],
                        c->center[1] + ASIDE * wanted * side[d][1]};
    int cell = fg__domain_cell(domain, beside);
    if (cell < 0 || label[cell] != number)
      continue;
    fg_icon other = *icon;
    status = fg__rival_curved(&other, context, domain, beside, wanted, line);
    if (length_of(&other) > length) {
      free_points(icon);
      *icon = other;
      length = length_of(icon);
    } else
      free_points(&other);
  }
  return status;
}

fg_status fg__clusters_draw(fg_icons *icons, fg_context *context,
                            const fg__domain *domain, const int *label, int count,
                            int left_out)
{
  cluster *clusters = fg__allocate((size_t)count, sizeof *clusters);
  if (!clusters)
    return fg__fail_memory(context, "clusters", (size_t)count * sizeof *clusters);
  fg__streamline line = {0};
  int dropped = left_out;
  find_means(clusters, domain, label, count);
  fg_status status = find_centers(clusters, context, domain, label, count);
  for (int n = 0; n < count && status == FG_STATUS_OK; n++) {
    fg_icon icon = {.cluster = n + 1};
    status = make_icon(&icon, context, domain, label, &clusters[n], &line);
    if (status == FG_STATUS_OK && icon.points)
      status = fg__icons_add(icons, context, &icon);
    dropped += !icon.points;
    free_points(&icon);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(context);
  }
  fg__icons_set_clusters(icons, count + left_out, dropped);
  fg__streamline_clear(&line);
  free(clusters);
  return status;
}

/* The label of a cell, round the periods; 0 outside. */
static int label_at(const fg__domain *domain, const int *label, int x, int y)
{
  int at[2] = {x, y};
  for (int k = 0; k < 2; k++) {
    int n = domain->cells[k];
    if (domain->period[k] > 0)
      at[k] = (at[k] + n) % n;
    if (at[k] < 0 || at[k] >= n)
      return 0;
  }
  return label[at[1] * domain->cells[0] + at[0]];
}

/* Whether the cells that a node touches are all of one cluster. Nodes lie on the sides of
 * cells (even ones) and at their centres: two a cell. */
static bool is_within(const fg__domain *domain, const int *label, const int node[2])
{
  int low[2], high[2], number = 0;
  for (int k = 0; k < 2; k++) {
    low[k] = (node[k] - 1 + node[k] % 2) / 2 - (node[k] == 0);
    high[k] = node[k] / 2;
    if (domain->period[k] > 0)
      continue;
    low[k] = low[k] < 0 ? 0 : low[k];
    high[k] = high[k] < domain->cells[k] ? high[k] : domain->cells[k] - 1;
  }
  for (int y = low[1]; y <= high[1]; y++)
    for (int x = low[0]; x <= high[0]; x++) {
      int here = label_at(domain, label, x, y);
      if (here < 1 || (number > 0 && here != number))
        return false;
      number = here;
    }
  return true;
}

fg_status fg__clusters_density(fg_density **out, fg_context *context,
                               const fg__domain *domain, const int *label, int count)
{
  fg_density_arrays arrays = {.dimension = 2, .nodes = {1, 1, 1}, .clusters = count};
  size_t nodes = 1;
  for (int k = 0; k < 2; k++) {
    arrays.periodic[k] = domain->period[k] > 0;
    arrays.nodes[k] = 2 * domain->cells[k] + (arrays.periodic[k] ? 0 : 1);
    arrays.spacing[k] = domain->spacing[k] / 2;
    arrays.origin[k] = domain->origin[k];
    nodes *= (size_t)arrays.nodes[k];
  }
  float *u = fg__allocate(nodes, sizeof *u);
  if (!u)
    return fg__fail_memory(context, "the clusters' density", nodes * sizeof *u);
  size_t at = 0;
  for (int y = 0; y < arrays.nodes[1]; y++)
    for (int x = 0; x < arrays.nodes[0]; x++) {
      const int node[2] = {x, y};
      u[at++] = is_within(domain, label, node) ? 1 : -1;
    }
  arrays.u = u;
  fg_status status = fg_density_create_from_arrays(out, context, &arrays);
  free(u);
  return status;
}
