#include "place/regions.h"

#include "base/memory.h"
#include "place/placement.h"

#include <math.h>
#include <stdlib.h>

/* Nodes along each axis to a cell of the domain's map, for the picture of regions. */
enum { NODES_A_CELL = 2 };

/* Half the gap between two regions of a picture, in its cells. */
static const double HALF_GAP = 0.7;

/* The owners of points on a grid of their own. */
typedef struct owners {
  int size[3];
  double low[3], spacing[3]; /* of the points, input coordinates */
  float *first, *second; /* squares of the distances to the two nearest icons, lambda */
  int *owner;            /* -1: none within reach */
} owners;

static size_t point_count(const owners *all)
{
  return (size_t)all->size[0] * (size_t)all->size[1] * (size_t)all->size[2];
}

static void clear(owners *all)
{
  free(all->first);
  free(all->second);
  free(all->owner);
}

/* Gives an icon the points in its reach that are nearer to it than to those before. */
static void claim(owners *all, const fg__place_search *search, int index)
{
  const fg__place_line *line = &search->icon[index]->line;
  const fg__place_box *box = &search->icon[index]->contribution.box;
  double lambda = search->scale.lambda;
  int low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  for (int k = 0; k < search->scale.dimension; ++k) {
    double begin = search->scale.origin[k] + box->low[k] * search->scale.cell;
    double end = begin + box->size[k] * search->scale.cell;
    int first = (int)ceil((begin - all->low[k]) / all->spacing[k]);
    int last = (int)floor((end - all->low[k]) / all->spacing[k]);
    low[k] = first > 0 ? first : 0;
    high[k] = last + 1 < all->size[k] ? last + 1 : all->size[k];
  }
  for (int z = low[2]; z < high[2]; ++z)
    for (int y = low[1]; y < high[1]; ++y)
      for (int x = low[0]; x < high[0]; ++x) {
        size_t at =
            ((size_t)z * (size_t)all->size[1] + (size_t)y) * (size_t)all->size[0] +
            (size_t)x;
        const int node[3] = {x, y, z};
        float place[3] = {0}, nearest = HUGE_VALF;
        for (int k = 0; k < search->scale.dimension; ++k)
          place[k] = (float)((all->low[k] + node[k] * all->spacing[k] -
                              search->scale.origin[k]) /
                             lambda);
        for (int n = 0; n < line->count; ++n) {
          float square = 0.0F;
          for (int k = 0; k < search->scale.dimension; ++k) {
            float way = place[k] - line->position[k][n];
            square += way * way;
          }
          nearest = square < nearest ? square : nearest;
        }
        if (nearest < all->first[at]) {
          all->second[at] = all->first[at];
          all->first[at] = nearest;
          all->owner[at] = index;
        } else if (nearest < all->second[at]) {
          all->second[at] = nearest;
        }
      }
}

/* Finds the owners of points at `spacing` from the box's corner on, or when they are
 * `centers` of the cells of a grid that fills the box, with that spacing at most. */
static fg_status find_owners(owners *all, fg_context *context,
                             const fg__place_search *search, double spacing, bool centers)
{
  *all = (owners){.size = {1, 1, 1}, .spacing = {spacing, spacing, spacing}};
  for (int k = 0; k < search->scale.dimension; ++k) {
    double length = search->domain->high[k] - search->domain->low[k];
    all->size[k] = centers ? (int)ceil(length / spacing - 1e-6)
                           : (int)floor(length / spacing + 1e-6) + 1;
    all->size[k] = all->size[k] > 1 ? all->size[k] : 1;
    if (centers)
      all->spacing[k] = length / all->size[k];
    all->low[k] = search->domain->low[k] + (centers ? 0.5 * all->spacing[k] : 0.0);
  }
  size_t count = point_count(all);
  all->first = fg__allocate(count, sizeof *all->first);
  all->second = fg__allocate(count, sizeof *all->second);
  all->owner = fg__allocate(count, sizeof *all->owner);
  if (!all->first || !all->second || !all->owner) {
    clear(all);
    return fg__fail_memory(context, "the regions of icons", count * 12);
  }
  for (size_t n = 0; n < count; ++n) {
    all->first[n] = all->second[n] = HUGE_VALF;
    all->owner[n] = -1;
  }
  for (int n = 0; n < search->count; ++n)
    claim(all, search, n);
  return FG_STATUS_OK;
}

fg_status fg__place_measure_regions(fg__place_region *out, fg_context *context,
                                    const fg__place_search *search)
{
  owners all;
  fg_status status = find_owners(&all, context, search, search->scale.cell, true);
  if (status != FG_STATUS_OK)
    return status;
  double cell = 1.0;
  for (int k = 0; k < search->scale.dimension; ++k)
    cell *= all.spacing[k];
  size_t at = 0;
  for (int z = 0; z < all.size[2]; ++z)
    for (int y = 0; y < all.size[1]; ++y)
      for (int x = 0; x < all.size[0]; ++x, ++at) {
        const int node[3] = {x, y, z};
        double point[3] = {0};
        for (int k = 0; k < search->scale.dimension; ++k)
          point[k] = all.low[k] + node[k] * all.spacing[k];
        double v[3] = {0};
        /* the map's cells at the domain's boundary reach beyond it */
        if (all.owner[at] < 0 || !fg__place_subdomain_at(search->domain, point) ||
            !fg_field_velocity(search->domain->given, point, v))
          continue;
        fg__place_region *region = &out[all.owner[at]];
        const double speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        region->measure += cell;
        if (!fg__place_has_speed(search->domain, speed))
          continue;
        const double counts = cell * fg__place_weight(search->domain, speed);
        region->moving += counts;
        region->speed += counts * speed;
      }
  for (int n = 0; n < search->count; ++n)
    if (out[n].moving > 0.0)
      out[n].speed /= out[n].moving;
  clear(&all);
  return status;
}

/* 1 within a region, falling to 0 half a gap from the next. */
static float level_of(const owners *all, size_t at, double lambda)
{
  if (all->owner[at] < 0)
    return -1.0F;
  double first = sqrt((double)all->first[at]), second = sqrt((double)all->second[at]);
  if (!(second < HUGE_VAL))
    return 1.0F;
  double level = (second - first) * lambda / (2.0 * all->spacing[0]) - HALF_GAP;
  return (float)fmin(fmax(level, -1.0), 1.0);
}

static void fill_active(unsigned char *active, const fg_density_arrays *arrays,
                        const fg__place_domain *domain)
{
  size_t at = 0;
  for (int y = 0; y + 1 < arrays->nodes[1]; ++y)
    for (int x = 0; x + 1 < arrays->nodes[0]; ++x) {
      double center[3] = {arrays->origin[0] + (x + 0.5) * arrays->spacing[0],
                          arrays->origin[1] + (y + 0.5) * arrays->spacing[1], 0.0};
      active[at++] = fg__place_subdomain_at(domain, center) != NULL;
    }
}

fg_status fg_placement_regions(fg_density **out, const fg_placement *placement)
{
  const fg__place_search *search = fg__placement_search(placement);
  fg_context *context = search->context;
  *out = NULL;
  if (search->scale.dimension != 2)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "regions of arrows are shown in 2D only");
  owners all;
  fg_status status =
      find_owners(&all, context, search, search->domain->spacing / NODES_A_CELL, false);
  if (status != FG_STATUS_OK)
    return status;
  size_t nodes = point_count(&all);
  fg_density_arrays arrays = {.dimension = 2, .clusters = search->count};
  for (int k = 0; k < 3; ++k) {
    arrays.nodes[k] = all.size[k];
    arrays.origin[k] = all.low[k];
    arrays.spacing[k] = all.spacing[k];
  }
  unsigned char *active = fg__allocate(nodes, 1);
  if (active) {
    for (size_t n = 0; n < nodes; ++n) /* in place: the squares are not needed after */
      all.second[n] = level_of(&all, n, search->scale.lambda);
    fill_active(active, &arrays, search->domain);
    arrays.u = all.second;
    arrays.active = active;
    status = fg_density_create_from_arrays(out, context, &arrays);
  } else
    status = fg__fail_memory(context, "the regions of icons", nodes);
  free(active);
  clear(&all);
  return status;
}
