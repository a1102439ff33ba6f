/* Each cluster has an owner among the ranks, which gets the patch round it, makes its
 * icon and sends it to rank 0. A process alone owns all of them. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cluster/patches.h"
#include "grid/field_slabs.h"
#include "icon/icons.h"
#include "icon/icons_make.h"
#include "icon/territory.h"

/* Patches that a rank holds at a time have this share of its part of the grid, but for
 * one that is larger. */
static const double patch_share = 0.5;

typedef struct making {
  const fg_field *field;
  const fg_density *density;
  const fg__ranks *ranks;
  const fg__territory *territory;
  bool to_ends;
  fg__labels labels;
  fg__wanted_patch *wanted; /* [labels.count] */
  fg_icon *icon; /* [labels.count * FG__ICON_PIECES] those of this rank; on rank
                    0 at last all */
} making;

static size_t nodes_of(const fg__patch *patch)
{
  return (size_t)patch->nodes[0] * (size_t)patch->nodes[1] * (size_t)patch->nodes[2];
}

/* Each cluster goes to the rank with the fewest nodes to look at so far. */
static fg_status choose_owners(making *s, fg_context *context)
{
  size_t *load = fg__allocate((size_t)s->ranks->count, sizeof *load);
  fg_status status = FG_STATUS_OK;
  if (!load)
    status = fg__fail_memory(context, "the icons", (size_t)s->ranks->count);
  for (int n = 0; n < s->labels.count && load; ++n) {
    fg__wanted_patch *wanted = &s->wanted[n];
    fg__patch_place(&wanted->patch, fg_density_contents(s->density), s->labels.bounds[n],
                    s->labels.closed[n]);
    for (int r = 1; r < s->ranks->count; ++r)
      if (load[r] < load[wanted->rank])
        wanted->rank = r;
    load[wanted->rank] += nodes_of(&wanted->patch);
  }
  free(load);
  return status;
}

/* How many clusters from `first` on are taken together; the same on all ranks. */
static int count_together(const making *s, int first, size_t *load)
{
  const fg_density_arrays *grid = fg_density_contents(s->density);
  int depth = grid->dimension == 3 ? grid->nodes[2] : 1;
  double most = patch_share * grid->nodes[0] * grid->nodes[1] * depth / s->ranks->count;
  if (s->ranks->count == 1) /* its patches are borrowed */
    return s->labels.count - first;
  memset(load, 0, (size_t)s->ranks->count * sizeof *load);
  for (int n = first; n < s->labels.count; ++n) {
    size_t *of_rank = &load[s->wanted[n].rank];
    size_t nodes = nodes_of(&s->wanted[n].patch);
    if (*of_rank > 0 && (double)(*of_rank + nodes) > most)
      return n - first;
    *of_rank += nodes;
  }
  return s->labels.count - first;
}

/* Streamlines look beyond their cluster for a step at most, which is no longer than a
 * cell of the density: less than this many nodes beyond the patch. */
enum { BEYOND_PATCH = 2 };

/* The samples of the field that the icons of a patch need. */
static fg__region samples_of(const making *s, const fg__wanted_patch *wanted)
{
  const fg_density_arrays *grid = fg_density_contents(s->density);
  fg__region out = {.nodes = {{0, 0, 0}, {1, 1, 1}}, .rank = wanted->rank};
  for (int k = 0; k < grid->dimension; ++k) {
    fg__field_points nodes = {.origin = grid->origin[k],
                              .spacing = grid->spacing[k],
                              .first = wanted->patch.first[k] - BEYOND_PATCH,
                              .count = wanted->patch.nodes[k] + 2 * BEYOND_PATCH,
                              .all = grid->nodes[k]};
    fg__field_span(&out.nodes.first[k], &out.nodes.nodes[k], s->field, k, &nodes);
  }
  return out;
}

/* Windows of a field that ranks share for `count` clusters, NULL for a whole one.
 * Collective. */
static fg_status take_windows(fg_field ***out, const making *s, fg_context *context,
                              int first, int count)
{
  *out = NULL;
  if (!s->field->slab)
    return FG_STATUS_OK;
  size_t all = (size_t)count;
  fg__region *region = fg__allocate(all, sizeof *region);
  fg_field **window = fg__allocate(all, sizeof *window);
  fg_status status = FG_STATUS_OK;
  if (!region || !window)
    status = fg__fail_memory(context, "the icons", all * sizeof *region);
  status = fg__ranks_agree(s->ranks, context, status);
  for (int n = 0; n < count && !status; ++n)
    region[n] = samples_of(s, &s->wanted[first + n]);
  if (!status)
    status = fg__field_windows(window, context, s->ranks, s->field, region, count);
  free(region);
  if (status)
    free(window);
  else
    *out = window;
  return status;
}

static fg_icon *icons_of(const making *s, int cluster)
{
  return s->icon + (size_t)(cluster - 1) * FG__ICON_PIECES;
}

/* The icons of this rank among `count` clusters whose patches are there. */
static fg_status make_own(making *s, fg_context *context, fg_field *const *window,
                          int threads, int first, int count)
{
  size_t most = (size_t)count;
  int *cluster = fg__allocate(most, sizeof *cluster);
  fg__patch *patch = fg__allocate(most, sizeof *patch);
  fg_icon *icon = fg__icons_allocate(count);
  fg_field **own_window = fg__allocate(most, sizeof *own_window);
  fg_status status = FG_STATUS_OK;
  fg__icon_source source = {.field = s->field,
                            .field_window = window ? own_window : NULL,
                            .density = fg_density_contents(s->density),
                            .labels = &s->labels,
                            .cluster = cluster,
                            .patch = patch,
                            .territory = s->territory,
                            .to_ends = s->to_ends};
  if (!cluster || !patch || !icon || !own_window) {
    status = fg__fail_memory(context, "the icons", most * sizeof *icon);
    goto cleanup;
  }
  for (int n = first; n < first + count; ++n)
    if (s->wanted[n].rank == s->ranks->rank) {
      cluster[source.count] = n + 1;
      own_window[source.count] = window ? window[n - first] : NULL;
      patch[source.count++] = s->wanted[n].patch;
    }
  status = fg__icons_make(icon, context, &source, threads);
  for (int n = 0; n < source.count; ++n)
    memcpy(icons_of(s, cluster[n]), icon + (size_t)n * FG__ICON_PIECES,
           FG__ICON_PIECES * sizeof *icon);
cleanup:
  free(cluster);
  free(patch);
  free(icon); /* their points are the list's now */
  free(own_window);
  return status;
}

static fg_status make_all(making *s, fg_context *context, int threads)
{
  size_t *load = fg__allocate((size_t)s->ranks->count, sizeof *load);
  fg_status status = FG_STATUS_OK;
  if (!load)
    status = fg__fail_memory(context, "the icons", (size_t)s->ranks->count);
  status = fg__ranks_agree(s->ranks, context, status);
  for (int first = 0, count; first < s->labels.count && !status; first += count) {
    count = count_together(s, first, load);
    status = fg__patches_fill(context, s->density, s->wanted + first, count);
    if (status)
      break;
    fg_field **window;
    status = take_windows(&window, s, context, first, count);
    if (!status)
      status = make_own(s, context, window, threads, first, count);
    fg__field_windows_destroy(window, count);
    for (int n = first; n < first + count; ++n)
      fg__patch_clear(&s->wanted[n].patch);
    status = fg__ranks_agree(s->ranks, context, status);
  }
  free(load);
  return status;
}

/* Bytes that come from the ranks: an icon, its points and lines, the next icon. */
typedef struct letters {
  unsigned char *bytes;
  size_t count, capacity;
  bool lost; /* there was no memory for some */
} letters;

static void take(void *closure, const unsigned char *bytes, size_t count)
{
  letters *l = closure;
  l->lost = l->lost || !fg__grow((void **)&l->bytes, &l->capacity, l->count + count, 1);
  if (l->lost)
    return;
  memcpy(l->bytes + l->count, bytes, count);
  l->count += count;
}

static void take_line(letters *l, const double (*line)[3], int count)
{
  if (count > 0)
    take(l, (const unsigned char *)line, (size_t)count * sizeof *line);
}

/* False when there is no memory. */
static bool read_line(const double (**line)[3], int count, const letters *l, size_t *at)
{
  size_t bytes = (size_t)count * sizeof **line;
  *line = NULL;
  if (count < 1)
    return true;
  double(*points)[3] = fg__allocate(bytes, 1);
  if (!points)
    return false;
  memcpy(points, l->bytes + *at, bytes);
  *at += bytes;
  *line = (const double(*)[3])points;
  return true;
}

static void read_letters(making *s, const letters *l, fg_status *status,
                         fg_context *context)
{
  for (size_t at = 0; at < l->count;) {
    fg_icon icon;
    memcpy(&icon, l->bytes + at, sizeof icon);
    at += sizeof icon;
    icon.spine = icon.streamline = NULL;
    bool room = read_line(&icon.points, icon.point_count, l, &at) &&
                read_line(&icon.spine, icon.spine_count, l, &at) &&
                read_line(&icon.streamline, icon.streamline_count, l, &at);
    fg_icon *place = icons_of(s, icon.cluster); /* after its cluster's others */
    while (place->points)
      ++place;
    *place = icon;
    if (!room) {
      *status = fg__fail_memory(context, "an icon", l->count);
      return;
    }
  }
}

/* Rank 0 gets the icons of all. */
static fg_status bring_together(making *s, fg_context *context)
{
  letters own = {0}, all = {0};
  bool sends = s->ranks->rank > 0;
  for (int n = 0; n < s->labels.count * FG__ICON_PIECES && sends; ++n)
    if (s->icon[n].points) {
      take(&own, (const unsigned char *)&s->icon[n], sizeof s->icon[n]);
      take_line(&own, s->icon[n].points, s->icon[n].point_count);
      take_line(&own, s->icon[n].spine, s->icon[n].spine_count);
      take_line(&own, s->icon[n].streamline, s->icon[n].streamline_count);
    }
  fg__ranks_pass(s->ranks, own.bytes, own.count, take, &all);
  fg_status status = FG_STATUS_OK;
  if (own.lost || all.lost)
    status = fg__fail_memory(context, "the icons", own.count + all.count);
  else
    read_letters(s, &all, &status, context);
  free(own.bytes);
  free(all.bytes);
  return fg__ranks_agree(s->ranks, context, status);
}

static fg_status allocate(making *s, fg_context *context)
{
  size_t count = (size_t)s->labels.count;
  s->wanted = fg__allocate(count, sizeof *s->wanted);
  s->icon = fg__icons_allocate(s->labels.count);
  if (s->wanted && s->icon)
    return choose_owners(s, context);
  return fg__fail_memory(context, "the icons", count * sizeof *s->icon);
}

static fg_status create(fg_icons **out, fg_context *context, const fg_field *field,
                        const fg_density *density, const fg_icon_options *options,
                        const fg__territory *territory)
{
  making s = {.field = field,
              .density = density,
              .territory = territory,
              .to_ends = options->extent != FG_EXTENT_BEST,
              .ranks = fg__density_block_of(density)->partition.ranks};
  fg_status status = fg__field_check_shared(context, s.ranks, field);
  if (!status)
    status = fg__labels_create(&s.labels, context, density);
  if (status)
    return status;
  status = fg__ranks_agree(s.ranks, context, allocate(&s, context));
  if (!status)
    status = make_all(&s, context, options->threads);
  if (!status)
    status = bring_together(&s, context);
  if (!status && s.ranks->rank == 0)
    status = fg__icons_collect(out, context, s.icon, s.labels.count);
  if (status == FG_STATUS_OK && *out)
    status = fg__icons_set_projection(*out, context, fg__icons_plane_of(field));
  status = fg__ranks_agree(s.ranks, context, status);
  if (status) {
    fg_icons_destroy(*out);
    *out = NULL;
  }
  fg__icons_free(s.icon, s.labels.count);
  free(s.wanted);
  fg__labels_clear(&s.labels);
  return status;
}

/* Adds the icons of a cluster; `of`: of each label in the list its cluster, or NULL. */
static fg_status add_icons(bool *added, fg_icons *to, fg_context *context,
                           const fg_icons *from, const int *of, int cluster)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg_icons_count(from) && !status; ++n) {
    fg_icon icon = *fg_icons_at(from, n);
    icon.cluster = of ? of[icon.cluster] : icon.cluster;
    if (icon.cluster != cluster)
      continue;
    status = fg__icons_add(to, context, &icon);
    *added = true;
  }
  return status;
}

/* Icons of territories, and of clusters whose territories have none. */
static fg_status create_wide(fg_icons **out, fg_context *context, const fg_field *field,
                             const fg_density *density, const fg_icon_options *options)
{
  fg_icons *own = NULL, *wide = NULL;
  fg_density *territories = NULL;
  fg__territory of = {.density = density};
  fg_status status = fg__territories_create(&territories, &of, context, density);
  if (!status)
    status = create(&own, context, field, density, options, NULL);
  if (!status)
    status = create(&wide, context, field, territories, options, &of);
  if (!status)
    status = fg__icons_create_empty(out, context);
  int drawn = 0;
  const int clusters = own ? fg_icons_clusters(own) : 0;
  for (int n = 1; n <= clusters && !status; ++n) {
    bool added = false;
    status = add_icons(&added, *out, context, wide, of.cluster, n);
    if (!status && !added)
      status = add_icons(&added, *out, context, own, NULL, n);
    drawn += added;
  }
  if (!status) {
    fg__icons_set_clusters(*out, clusters, clusters - drawn);
    status = fg__icons_set_projection(*out, context, fg__icons_plane_of(field));
  }
  if (status) {
    fg_icons_destroy(*out);
    *out = NULL;
  }
  fg_icons_destroy(own);
  fg_icons_destroy(wide);
  fg_density_destroy(territories);
  free(of.cluster);
  return status;
}

fg_status fg_icons_create(fg_icons **out, fg_context *context, const fg_field *field,
                          const fg_density *density, const fg_icon_options *options)
{
  if (!out || !field || !density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "icons: no %s given",
                    !out     ? "place for the result"
                    : !field ? "field"
                             : "density");
  *out = NULL;
  int dimension = fg_density_contents(density)->dimension;
  if (fg_field_contents(field)->dimension != dimension)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "icons: a density in %d dimensions of a field in %d", dimension,
                    fg_field_contents(field)->dimension);
  if (fg_field_is_slab(field, NULL, NULL) && !fg_density_is_distributed(density))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "icons: a field that ranks share, of a density that they do not");
  fg__counters *counters = fg__density_block_of(density)->partition.ranks->counters;
  fg_phase before = fg__phase_continue(counters, FG_PHASE_SNAPSHOTS);
  const fg_icon_options o = options ? *options : (fg_icon_options){.threads = 1};
  fg_status status = o.extent == FG_EXTENT_TERRITORY
                         ? create_wide(out, context, field, density, &o)
                         : create(out, context, field, density, &o, NULL);
  fg__phase_return(counters, before);
  return status;
}
