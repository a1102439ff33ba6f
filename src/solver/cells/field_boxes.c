#include "solver/cells/field_boxes.h"

#include <stdlib.h>

#include "base/memory.h"

/* A window is kept to this share of a rank's part of the samples, in so many rounds at
 * most: each costs a message to every rank that has some of it. */
static const double window_share = 0.25;
enum { MOST_ROUNDS = 64, NOBODY = -1 };

/* The samples for some layers of cells, from face to face: a law may look half a cell
 * round each centre, at the domain's ends too. */
static fg__region region_of(const fg_field *field, const fg__cells *cells, int rank)
{
  fg__region out = {.nodes = {{0, 0, 0}, {1, 1, 1}}, .rank = rank};
  for (int k = 0; k < cells->dimension; ++k) {
    bool periodic = fg_field_contents(field)->period[k] > 0.0;
    fg__field_points faces = {.origin = cells->origin[k],
                              .spacing = cells->spacing[k],
                              .first = cells->first[k],
                              .count = cells->count[k] + 1,
                              .all = fg__domain_count(cells, k) + !periodic};
    fg__field_span(&out.nodes.first[k], &out.nodes.nodes[k], field, k, &faces);
  }
  return out;
}

/* The blocks of all ranks, which take their windows together. */
typedef struct rounds {
  const fg_field *field;
  int ranks;
  fg__cells *needed; /* [ranks] */
  fg__region *region;
  fg_field **window;
  int count;
} rounds;

static void clear(rounds *r)
{
  free(r->needed);
  free(r->region);
  free(r->window);
}

static fg_status plan(rounds *r, fg_context *context, const fg__tensor_recipe *recipe,
                      const fg__partition *partition)
{
  const size_t ranks = (size_t)partition->ranks->count;
  *r = (rounds){.field = recipe->field,
                .ranks = partition->ranks->count,
                .needed = fg__allocate(ranks, sizeof *r->needed),
                .region = fg__allocate(ranks, sizeof *r->region),
                .window = fg__allocate(ranks, sizeof *r->window)};
  if (!r->needed || !r->region || !r->window)
    return fg__fail_memory(context, "windows of the field", ranks * sizeof *r->needed);
  double most = 0.0, samples = 1.0;
  for (int k = 0; k < recipe->dimension; ++k)
    samples *= fg_field_contents(recipe->field)->size[k];
  for (int rank = 0; rank < r->ranks; ++rank) {
    r->needed[rank] = fg__cells_needed(recipe, &partition->block[rank]);
    fg__region region = region_of(recipe->field, &r->needed[rank], rank);
    double count = (double)fg__box_count(&region.nodes);
    most = count > most ? count : most;
  }
  double wanted = most * r->ranks / (window_share * samples);
  r->count = wanted < MOST_ROUNDS ? 1 + (int)wanted : MOST_ROUNDS;
  return FG_STATUS_OK;
}

/* Layers [*first, *first + *count) of a block's cells are those of a round. */
static bool has_layers(const rounds *r, int rank, int round, int *first, int *count)
{
  const fg__cells *cells = &r->needed[rank];
  fg__slab_rows(first, count, cells->count[cells->dimension - 1], round, r->count);
  return *count > 0;
}

static fg_status go_round(rounds *r, fg_context *context, const fg__tensor_recipe *recipe,
                          const fg__ranks *ranks, fg__wide_tensor *out, int round)
{
  int first, count;
  for (int rank = 0; rank < r->ranks; ++rank) {
    r->region[rank] = (fg__region){.rank = NOBODY};
    if (!has_layers(r, rank, round, &first, &count))
      continue;
    fg__cells layers = r->needed[rank];
    const int last = layers.dimension - 1;
    for (int k = 0; k <= last; ++k)
      layers.domain_count[k] = fg__domain_count(&r->needed[rank], k);
    layers.first[last] += first;
    layers.count[last] = count;
    r->region[rank] = region_of(r->field, &layers, rank);
  }
  fg_status status =
      fg__field_windows(r->window, context, ranks, r->field, r->region, r->ranks);
  if (status)
    return status;
  if (has_layers(r, ranks->rank, round, &first, &count))
    status = fg__wide_tensor_fill(out, context, r->window[ranks->rank], recipe->law,
                                  recipe->anisotropy, first, count);
  fg_field_destroy(r->window[ranks->rank]);
  return fg__ranks_agree(ranks, context, status);
}

fg_status fg__wide_of_block(fg__wide_tensor *out, fg_context *context,
                            const fg__tensor_recipe *recipe,
                            const fg__partition *partition)
{
  *out = (fg__wide_tensor){0};
  if (!recipe->field->slab)
    return FG_STATUS_OK;
  const fg__ranks *ranks = partition->ranks;
  rounds r;
  fg_status status = plan(&r, context, recipe, partition);
  if (!status)
    status = fg__wide_tensor_create(out, context, &r.needed[ranks->rank]);
  status = fg__ranks_agree(ranks, context, status);
  for (int round = 0; round < r.count && !status; ++round)
    status = go_round(&r, context, recipe, ranks, out, round);
  clear(&r);
  if (status)
    fg__wide_tensor_clear(out);
  return status;
}
