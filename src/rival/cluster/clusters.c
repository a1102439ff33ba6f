#include "rival/cluster/clusters.h"

#include "base/memory.h"
#include "icon/icons.h"
#include "icon/measure.h"
#include "rival/arrows.h"
#include "rival/cluster/pieces.h"

#include <math.h>
#include <stdlib.h>

/* Where the arrow through the centre is less than this share of what it should be, as in
 * a vortex core, arrows beside it are tried, at this share of the root of the area. */
static const double SHORT = 0.7;
static const double ASIDE = 0.3;

/* Where a part of a cluster lies. */
typedef struct place {
  double sum[2];    /* of its cells' centres */
  double center[2]; /* the mean, or the cell nearest to it */
  double nearest;   /* of the cells, squared distance to the mean */
} place;

/* A part bent like a bow has its mean outside. */
static void find_places(place *places, const fg__domain *domain,
                        const fg__rival_pieces *pieces)
{
  int raster = domain->cells[0] * domain->cells[1];
  double center[2];
  for (int i = 0; i < raster; i++) {
    fg__domain_center(domain, i, center);
    for (int k = 0; k < 2 && pieces->label[i] > 0; k++)
      places[pieces->label[i] - 1].sum[k] += center[k];
  }
  for (int n = 0; n < pieces->count; n++) {
    place *p = &places[n];
    for (int k = 0; k < 2; k++)
      p->center[k] = p->sum[k] /= pieces->cells[n];
    int cell = fg__domain_cell(domain, p->sum);
    p->nearest = cell >= 0 && pieces->label[cell] == n + 1 ? 0 : HUGE_VAL;
  }
  for (int i = 0; i < raster; i++) {
    if (pieces->label[i] < 1 || places[pieces->label[i] - 1].nearest <= 0)
      continue;
    place *p = &places[pieces->label[i] - 1];
    fg__domain_center(domain, i, center);
    double x = center[0] - p->sum[0], y = center[1] - p->sum[1];
    double distance = x * x + y * y;
    if (distance < p->nearest) {
      p->nearest = distance;
      p->center[0] = center[0];
      p->center[1] = center[1];
    }
  }
}

static double length_of(const fg_icon *icon)
{
  return icon->points ? fg__icon_length(icon) : 0.0;
}

/* The arrow through a part's centre, or a longer one beside it. */
static fg_status make_icon(fg_icon *icon, fg_context *context, const fg__domain *domain,
                           const fg__rival_pieces *pieces, int part,
                           const double center[2], fg__line *line)
{
  static const int side[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  double area = pieces->cells[part] * domain->spacing[0] * domain->spacing[1];
  double wanted = sqrt(area);
  *icon = (fg_icon){.cluster = pieces->cluster[part], .area = area};
  fg_status status = fg__rival_curved(icon, context, domain, center, wanted, line);
  double length = length_of(icon);
  for (int d = 0; d < 4 && status == FG_STATUS_OK && length < SHORT * wanted; d++) {
    double beside[2] = {center[0] + ASIDE * wanted * side[d][0],
                        center[1] + ASIDE * wanted * side[d][1]};
    int cell = fg__domain_cell(domain, beside), turns[2];
    fg__domain_turns(domain, beside, turns);
    if (cell < 0 || turns[0] || turns[1] || pieces->label[cell] != part + 1)
      continue;
    fg_icon other = *icon;
    status = fg__rival_curved(&other, context, domain, beside, wanted, line);
    if (length_of(&other) > length) {
      fg__rival_free_points(icon);
      *icon = other;
      length = length_of(icon);
    } else
      fg__rival_free_points(&other);
  }
  return status;
}

static fg_status draw_parts(fg_icons *icons, fg_context *context,
                            const fg__domain *domain, const fg__rival_pieces *pieces,
                            const place *places, int *drawn)
{
  fg__line line = {0};
  fg_status status = FG_STATUS_OK;
  int last = 0;
  for (int n = 0; n < pieces->count && status == FG_STATUS_OK; n++) {
    fg_icon icon;
    status = make_icon(&icon, context, domain, pieces, n, places[n].center, &line);
    if (status == FG_STATUS_OK && icon.points) {
      status = fg__icons_add(icons, context, &icon);
      *drawn += icon.cluster != last;
      last = icon.cluster;
    }
    fg__rival_free_points(&icon);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(context);
  }
  fg__line_clear(&line);
  return status;
}

fg_status fg__clusters_draw(fg_icons *icons, fg_context *context,
                            const fg__domain *domain, const int *label, int count,
                            int left_out)
{
  fg__rival_pieces pieces;
  int drawn = 0;
  fg_status status = fg__rival_pieces_create(&pieces, context, domain, label, count);
  if (status != FG_STATUS_OK)
    return status;
  place *places = fg__allocate((size_t)pieces.count, sizeof *places);
  if (places) {
    find_places(places, domain, &pieces);
    status = draw_parts(icons, context, domain, &pieces, places, &drawn);
  } else
    status = fg__fail_memory(context, "clusters", (size_t)pieces.count * sizeof *places);
  fg__icons_set_clusters(icons, count + left_out, count + left_out - drawn);
  free(places);
  fg__rival_pieces_clear(&pieces);
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
