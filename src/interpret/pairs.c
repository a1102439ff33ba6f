/* The pairs of variables that are components of one vector: terms/vectors.h of those that
 * may be, and vector variables. */
#include "base/memory.h"
#include "interpret/space/space.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/coordinates.h"
#include "terms/text.h"
#include "terms/vectors.h"

#include <stdlib.h>
#include <string.h>

static const char *text_of(const fg__variable *v, const char *attribute)
{
  const fg__attribute *a = fg__attribute_find(v, attribute);
  return a ? a->text : NULL;
}

/* Unlike a column that is called by its number, and named by its place (nameless.c). */
static bool has_own_name(const fg__variable *v)
{
  return strstr(v->name, v->plain_name) != NULL;
}

const char *fg__called(const fg__variable *v)
{
  return has_own_name(v) ? v->name : v->plain_name;
}

fg__term fg__term_of(const fg__variable *v)
{
  double relative;
  const char *comment = text_of(v, "comment");
  const bool flagged =
      fg__attribute_numbers(v, "GRIB_uvRelativeToGrid", &relative, 1) == 1;
  return (fg__term){.name = fg__called(v),
                    .standard_name = text_of(v, "standard_name"),
                    .long_name = text_of(v, "long_name"),
                    .comment = comment ? comment : text_of(v, "description"),
                    .units = text_of(v, "units"),
                    .group = (int)v->location,

                    .file = v->file,
                    .frame = !flagged         ? 0
                             : relative > 0.0 ? -1
                                              : 1};
}

const fg__variable *fg__third_element(const fg__variable *v)
{
  const fg__dataset *data = v->owner;
  return v + 2 < data->variables + data->variable_count && v[2].element == 3 ? v + 2
                                                                             : NULL;
}

typedef struct candidates {
  fg__term *term;
  const fg__variable **variable;
  size_t count;
} candidates;

/* What is known of the last dimension without a name: all of a table's columns lie along
 * one. */
typedef struct known_line {
  int dimension;
  bool has_places;
} known_line;

static bool lies_at_places(const fg__dataset *data, const fg__variable *v,
                           known_line *known)
{
  const int dimension = v->dimension[0];
  if (!data->dimensions[dimension].is_nameless)
    return fg__unstructured_line(data, v);
  if (dimension != known->dimension)
    *known = (known_line){dimension, fg__unstructured_line(data, v)};
  return known->has_places;
}

static bool may_be_component(const fg__dataset *data, const fg__variable *v,
                             known_line *known)
{
  if (data->space.is_there)
    return fg__may_be_in_space(v);
  const char *methods = text_of(v, "cell_methods");
  if (methods && fg__contains_any(methods, "variance|standard_deviation"))
    return false;
  return v->file < data->component_files && fg__is_array(v) && !v->element &&
         (v->rank >= 2 || lies_at_places(data, v, known));
}

static bool have_same_places(const fg__dataset *data, const fg__variable *a,
                             const fg__variable *b)
{
  bool same = a->rank == b->rank;
  for (int k = 0; same && k < a->rank; ++k)
    same = fg__alike_dimension(data, a->dimension[k], b->dimension[k]);
  return same;
}

/* The number of the first candidate with the same dimensions. */
static int place_of(const candidates *all, const fg__dataset *data, const fg__variable *v)
{
  size_t i = 0;
  while (i < all->count && !have_same_places(data, all->variable[i], v))
    ++i;
  return (int)i;
}

static bool list_candidates(candidates *out, const fg__dataset *data)
{
  out->term = fg__allocate(data->variable_count, sizeof *out->term);
  out->variable = fg__allocate(data->variable_count, sizeof *out->variable);
  known_line known = {.dimension = -1};
  if (!out->term || !out->variable)
    return false;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!may_be_component(data, v, &known))
      continue;
    fg__term *term = &out->term[out->count];
    *term = fg__term_of(v);
    term->place = place_of(out, data, v);
    if (data->component_files > 1 && fg__unstructured_elsewhere(data, v))
      term->file = -1;
    out->variable[out->count++] = v;
  }
  return true;
}

typedef struct pair_list {
  fg__pair *entry;
  size_t count, capacity;
} pair_list;

static bool append(pair_list *pairs, const fg__pair *pair)
{
  void *grown = pairs->entry;
  if (!fg__grow(&grown, &pairs->capacity, pairs->count + 1, sizeof *pair))
    return false;
  pairs->entry = grown;
  pairs->entry[pairs->count++] = *pair;
  return true;
}

/* Whether the file has coordinates along two axes of space and none along the third. */
static bool is_plane_across(const fg__dataset *data, int missing)
{
  bool found[3] = {false, false, false};
  for (size_t i = 0; i < data->variable_count; ++i)
    for (int k = 0; k < 3; ++k)
      found[k] = found[k] || fg__column_fits(data->variables[i].plain_name,
                                             (fg__column_use)(FG__COLUMN_X + k)) > 0;
  return found[0] == (missing != 0) && found[1] == (missing != 1) && found[2];
}

static bool add_found(pair_list *pairs, const fg__dataset *data, const candidates *all,
                      bool apart)
{
  fg__vector_rules rules = {.apart = apart, .at_points = true};
  for (size_t i = 0; i < all->count; ++i)
    rules.at_points = rules.at_points && all->variable[i]->rank == 1;
  fg__vector *found;
  size_t count;
  bool memory = fg__vectors_find(&found, &count, all->term, all->count, &rules);
  for (size_t i = 0; i < count && memory; ++i) {
    const fg__vector *v = &found[i];
    fg__pair pair = {.polar = v->polar,
                     .found_by = v->found_by,
                     .rank = v->rank,
                     .is_velocity = v->is_velocity};
    int components = 0, across = -1;
    const bool three =
        v->component[0] >= 0 && v->component[1] >= 0 && v->component[2] >= 0;
    for (int k = 0; k < 2 && rules.at_points && three; ++k)
      if (is_plane_across(data, k))
        across = k;
    if (v->component[1] >= 0 && !has_own_name(all->variable[v->component[1]]))
      pair.found_by = "columns";
    for (int k = 0; k < 3; ++k)
      if (v->component[k] >= 0 && k != across)
        pair.component[components++] = all->variable[v->component[k]];
      else if (v->is_upright || k == across)
        pair.across = 1 + k;
    int position[FG__ROLES];
    fg__section_settle(&pair, data);
    const bool lies_elsewhere =
        data->space.is_there
            ? v->polar.sense != 0
            : v->is_upright && !is_plane_across(data, pair.across - 1) &&
                  fg__section_along(position, data, pair.component[0]) < 0;
    memory = lies_elsewhere || append(pairs, &pair);
  }
  free(found);
  return memory;
}

static bool is_paired(const pair_list *pairs, const fg__variable *v)
{
  for (size_t i = 0; i < pairs->count; ++i)
    for (int k = 0; k < 3; ++k)
      if (pairs->entry[i].component[k] == v)
        return true;
  return false;
}

/* Variables that no vector has by their names, by what their long names say. */
static bool add_titled(pair_list *pairs, const fg__dataset *data, candidates *all,
                       bool apart)
{
  const size_t known = pairs->count;
  size_t kept = 0;
  for (size_t i = 0; i < all->count; ++i) {
    const char *title = all->term[i].long_name;
    if (!title || !title[0] || is_paired(pairs, all->variable[i]))
      continue;
    all->term[kept] = all->term[i];
    all->term[kept].name = title;
    all->term[kept].standard_name = NULL;
    all->variable[kept++] = all->variable[i];
  }
  all->count = kept;
  const bool memory = add_found(pairs, data, all, apart);
  for (size_t i = known; i < pairs->count; ++i) {
    fg__polar own;
    if (pairs->entry[i].polar.sense != 0) {
      const fg__term direction = fg__term_of(pairs->entry[i].component[1]);
      fg__direction_read(&own, &direction);
      pairs->entry[i].polar.sense = own.sense;
    }
    pairs->entry[i].found_by = "long_name";
    pairs->entry[i].rank += FG__BY_LONG_NAMES;
  }
  return memory;
}

/* Whether an array is also there as a whole, so that its components may be something
 * else. */
static bool is_also_whole(const fg__dataset *data, size_t i)
{
  return i > 0 && data->variables[i - 1].element == 0 &&
         strcmp(data->variables[i - 1].name, data->variables[i].name) == 0;
}

/* Vector variables, which decoders list as two or three in a row; `all`: also those that
 * may be something else. */
static bool add_vectors(pair_list *pairs, const fg__dataset *data, bool all)
{
  for (size_t i = 0; i + 1 < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const char *units = text_of(v, "units");
    fg__pair of_space;
    if (v->location && fg__pair_of_vector(&of_space, v) && !append(pairs, &of_space))
      return false;
    if (v->location || v->element != 1 || v->file >= data->component_files ||
        (!all && is_also_whole(data, i)))
      continue;
    fg__unit unit = {.quantity = FG__QUANTITY_SPEED};
    if (units && units[0])
      fg__unit_read(&unit, units);
    const bool velocity = unit.quantity == FG__QUANTITY_SPEED;
    const fg__pair pair = {.component = {v, v + 1, fg__third_element(v)},
                           .found_by = "shape",
                           .rank = is_also_whole(data, i) ? FG__BY_SHAPE
                                   : velocity             ? FG__BY_VELOCITY_NAMES
                                                          : FG__BY_OTHER_NAMES,
                           .is_velocity = velocity};
    if (!append(pairs, &pair))
      return false;
  }
  return true;
}

static int compare_pairs(const void *left, const void *right)
{
  const fg__pair *a = left, *b = right;
  if (a->rank != b->rank)
    return a->rank - b->rank;
  return a->component[0] < b->component[0] ? -1 : a->component[0] > b->component[0];
}

fg_status fg__pairs_find(fg__pair **out, size_t *count, const fg__dataset *data)
{
  candidates all = {0};
  pair_list pairs = {0};
  const bool two_files = data->component_files > 1;
  bool memory = list_candidates(&all, data) && add_found(&pairs, data, &all, two_files);
  if (pairs.count == 0 && two_files) /* the second may have only positions or a mask */
    memory = memory && add_found(&pairs, data, &all, false);
  memory = memory && add_titled(&pairs, data, &all, two_files);
  memory = memory && add_vectors(&pairs, data, pairs.count == 0);
  free(all.term);
  free(all.variable);
  if (!memory) {
    free(pairs.entry);
    return fg__fail_memory(data->context, "pairs of variables", 0);
  }
  if (data->space.is_there)
    fg__drop_repeated(pairs.entry, &pairs.count);
  if (pairs.count > 0)
    qsort(pairs.entry, pairs.count, sizeof *pairs.entry, compare_pairs);
  *out = pairs.entry;
  *count = pairs.count;
  return FG_STATUS_OK;
}
