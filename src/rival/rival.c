/* The methods by name: a new one is a file and a line in the list. */
#include "base/memory.h"
#include "icon/icons.h"
#include "rival/cluster/clusters.h"
#include "rival/method.h"

#include <stdlib.h>

/* Defaults of the discrete clustering: docs/method/rival-discrete.md measures others. */
static const double DEFAULT_POSITION_WEIGHT = 0.95;
static const double DEFAULT_ELONGATION = 2;
static const double LARGEST_ELONGATION = 1e6;

/* In fair-share lengths: longer than any box. */
static const double LARGEST_LENGTH = 1000;

/* In 3D a raster of 1025 nodes a side still has fewer cells than an int can count. */
enum {
  DEFAULT_NODES = 257,
  DEFAULT_NODES_IN_SPACE = 49,
  FEWEST_NODES = 3,
  MOST_NODES = 16385,
  MOST_NODES_IN_SPACE = 1025
};

/* A method draws by itself, or it divides the domain and its clusters are drawn. */
typedef struct method_entry {
  const char *name;
  bool flat;                             /* only in 2D */
  fg_status (*prepare)(fg_rival *rival); /* NULL: nothing to do before */
  fg_status (*draw)(fg_icons *icons, const fg_rival *rival, int count);
  fg_status (*divide)(const fg_rival *rival, int count, int *label, int *found,
                      int *left_out);
} method_entry;

static const method_entry methods[] = {
    [FG_RIVAL_HEDGEHOG] = {.name = "hedgehog", .draw = fg__rival_hedgehog},
    [FG_RIVAL_GRID_CURVED] = {.name = "grid-curved", .draw = fg__rival_grid_curved},
    [FG_RIVAL_DISCRETE] = {.name = "discrete",
                           .flat = true,
                           .prepare = fg__rival_discrete_prepare,
                           .divide = fg__rival_discrete},
    [FG_RIVAL_TOP_DOWN] = {.name = "top-down",
                           .flat = true,
                           .divide = fg__rival_top_down},
    [FG_RIVAL_STREAMLINES] = {.name = "streamlines", .draw = fg__rival_streamlines},
    [FG_RIVAL_VORONOI] = {.name = "voronoi", .draw = fg__rival_voronoi},
    [FG_RIVAL_K_MEANS] = {.name = "k-means", .draw = fg__rival_k_means},
    [FG_RIVAL_FARTHEST] = {.name = "farthest", .draw = fg__rival_farthest},
    [FG_RIVAL_RANDOM] = {.name = "random", .draw = fg__rival_random},
};

enum { METHODS = sizeof methods / sizeof *methods };

const char *fg_rival_name(fg_rival_method method)
{
  return (int)method >= 0 && (int)method < METHODS ? methods[method].name : NULL;
}

static fg_status settle(fg_rival_options *settled, fg_context *context,
                        const fg_rival_options *options, int dimension)
{
  int most = dimension == 2 ? MOST_NODES : MOST_NODES_IN_SPACE;
  if (options)
    *settled = *options;
  if ((int)settled->method < 0 || (int)settled->method >= METHODS)
    return fg__fail(context, FG_STATUS_ARGUMENT, "rival: no method %d",
                    (int)settled->method);
  if (dimension == 3 && methods[settled->method].flat)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "rival: the field has 3 dimensions, and the method %s is made for 2",
                    methods[settled->method].name);
  if (settled->nodes == 0)
    settled->nodes = dimension == 2 ? DEFAULT_NODES : DEFAULT_NODES_IN_SPACE;
  if (settled->nodes < FEWEST_NODES || settled->nodes > most)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: a raster of %d nodes, from %d to %d are taken",
                    settled->nodes, FEWEST_NODES, most);
  if (!(settled->length >= 0 && settled->length <= LARGEST_LENGTH))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: a length of %g fair shares, it must lie in [0, %g]",
                    settled->length, LARGEST_LENGTH);
  if (settled->direction_only)
    settled->position_weight = 0;
  else if (!(settled->position_weight != 0))
    settled->position_weight = DEFAULT_POSITION_WEIGHT;
  if (!(settled->elongation != 0))
    settled->elongation = DEFAULT_ELONGATION;
  if (!(settled->position_weight >= 0 && settled->position_weight <= 1))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: a weight of position of %g, it must lie in [0, 1]",
                    settled->position_weight);
  if (!(settled->elongation >= 1 && settled->elongation <= LARGEST_ELONGATION))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: an elongation of %g, it must lie in [1, %g]",
                    settled->elongation, LARGEST_ELONGATION);
  return FG_STATUS_OK;
}

fg_status fg_rival_create(fg_rival **out, fg_context *context, const fg_field *field,
                          const fg_rival_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "rival: no %s given",
                    out ? "field" : "place for the result");
  *out = NULL;
  if (fg_field_is_slab(field, NULL, NULL))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: of a part of a field that ranks share; the whole is needed");
  fg_rival *rival = fg__allocate(1, sizeof *rival);
  if (!rival)
    return fg__fail_memory(context, "a rival", sizeof *rival);
  rival->context = context;
  fg_status status =
      settle(&rival->options, context, options, fg_field_contents(field)->dimension);
  if (status == FG_STATUS_OK)
    status = fg__domain_create(&rival->domain, context, field, rival->options.nodes);
  if (status == FG_STATUS_OK && rival->domain.valid_count == 0)
    status =
        fg__fail(context, FG_STATUS_ARGUMENT,
                 "rival: no cell of a raster of %d x %d x %d has a velocity",
                 rival->domain.cells[0], rival->domain.cells[1], rival->domain.cells[2]);
  if (status == FG_STATUS_OK && methods[rival->options.method].prepare)
    status = methods[rival->options.method].prepare(rival);
  if (status != FG_STATUS_OK) {
    fg_rival_destroy(rival);
    return status;
  }
  *out = rival;
  return FG_STATUS_OK;
}

void fg_rival_destroy(fg_rival *rival)
{
  if (!rival)
    return;
  fg__merge_tree_clear(&rival->tree);
  fg__domain_clear(&rival->domain);
  free(rival);
}

/* Labels of a division into clusters; *label is allocated. */
static fg_status divide(int **label, int *found, int *left_out, const fg_rival *rival,
                        int count)
{
  const fg__domain *domain = &rival->domain;
  size_t cells = (size_t)domain->cells[0] * (size_t)domain->cells[1];
  *label = fg__allocate(cells, sizeof **label);
  if (!*label)
    return fg__fail_memory(rival->context, "clusters", cells * sizeof **label);
  return methods[rival->options.method].divide(rival, count, *label, found, left_out);
}

static fg_status draw_clusters(fg_icons *icons, const fg_rival *rival, int count)
{
  int *label = NULL, found = 0, left_out = 0;
  fg_status status = divide(&label, &found, &left_out, rival, count);
  if (status == FG_STATUS_OK)
    status =
        fg__clusters_draw(icons, rival->context, &rival->domain, label, found, left_out);
  free(label);
  return status;
}

static fg_status check_count(fg_rival *rival, int count)
{
  if (count >= 1)
    return FG_STATUS_OK;
  return fg__fail(rival->context, FG_STATUS_ARGUMENT,
                  "rival: %d icons were asked for, at least 1 is needed", count);
}

fg_status fg_rival_icons(fg_icons **out, fg_rival *rival, int count)
{
  if (!out || !rival)
    return fg__fail(rival ? rival->context : NULL, FG_STATUS_ARGUMENT,
                    "rival: a NULL argument");
  *out = NULL;
  fg_icons *icons = NULL;
  fg_status status = check_count(rival, count);
  if (status == FG_STATUS_OK)
    status = fg__icons_create_empty(&icons, rival->context);
  if (status == FG_STATUS_OK)
    status = fg__icons_set_projection(icons, rival->context,
                                      fg__icons_plane_of(rival->domain.field));
  if (status == FG_STATUS_OK && methods[rival->options.method].draw)
    status = methods[rival->options.method].draw(icons, rival, count);
  else if (status == FG_STATUS_OK)
    status = draw_clusters(icons, rival, count);
  if (status != FG_STATUS_OK) {
    fg_icons_destroy(icons);
    return status;
  }
  *out = icons;
  return FG_STATUS_OK;
}

bool fg_rival_divides(fg_rival_method method)
{
  return fg_rival_name(method) && methods[method].divide;
}

fg_status fg_rival_clusters(fg_density **out, fg_rival *rival, int count)
{
  if (!out || !rival)
    return fg__fail(rival ? rival->context : NULL, FG_STATUS_ARGUMENT,
                    "rival: a NULL argument");
  *out = NULL;
  fg_status status = check_count(rival, count);
  if (status != FG_STATUS_OK)
    return status;
  if (!fg_rival_divides(rival->options.method))
    return fg__fail(rival->context, FG_STATUS_UNSUPPORTED,
                    "rival: the method %s has no clusters",
                    fg_rival_name(rival->options.method));
  int *label = NULL, found = 0, left_out = 0;
  status = divide(&label, &found, &left_out, rival, count);
  if (status == FG_STATUS_OK)
    status = fg__clusters_density(out, rival->context, &rival->domain, label, found);
  free(label);
  return status;
}
