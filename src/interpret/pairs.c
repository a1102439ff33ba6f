/* The pairs of variables that are components of one vector: terms/vectors.h of those that
 * may be, and vector variables. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/vectors.h"

#include <stdlib.h>

static const char *text_of(const fg__variable *v, const char *attribute)
{
  const fg__attribute *a = fg__attribute_find(v, attribute);
  return a ? a->text : NULL;
}

fg__term fg__term_of(const fg__variable *v)
{
  return (fg__term){.name = v->name,
                    .standard_name = text_of(v, "standard_name"),
                    .long_name = text_of(v, "long_name"),
                    .units = text_of(v, "units"),
                    .file = v->file};
}

typedef struct candidates {
  fg__term *term;
  const fg__variable **variable;
  size_t count;
} candidates;

static bool may_be_component(const fg__dataset *data, const fg__variable *v)
{
  return v->file < data->component_files && fg__is_array(v) && !v->element &&
         (v->rank >= 2 || fg__unstructured_line(data, v));
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
  if (!out->term || !out->variable)
    return false;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!may_be_component(data, v))
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

static bool add_found(pair_list *pairs, const candidates *all, bool apart)
{
  const fg__vector_rules rules = {.apart = apart};
  fg__vector *found;
  size_t count;
  bool memory = fg__vectors_find(&found, &count, all->term, all->count, &rules);
  for (size_t i = 0; i < count && memory; ++i) {
    const fg__vector *v = &found[i];
    fg__pair pair = {.polar = v->polar,
                     .found_by = v->found_by,
                     .rank = v->rank,
                     .is_velocity = v->is_velocity};
    for (int k = 0; k < 3; ++k)
      pair.component[k] = v->component[k] < 0 ? NULL : all->variable[v->component[k]];
    memory = v->is_upright || append(pairs, &pair);
  }
  free(found);
  return memory;
}

/* Vector variables, which decoders list as two in a row. */
static bool add_vectors(pair_list *pairs, const fg__dataset *data)
{
  for (size_t i = 0; i + 1 < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const char *units = text_of(v, "units");
    if (v->element != 1 || v->file >= data->component_files)
      continue;
    fg__unit unit = {.quantity = FG__QUANTITY_SPEED};
    if (units && units[0])
      fg__unit_read(&unit, units);
    const bool velocity = unit.quantity == FG__QUANTITY_SPEED;
    const fg__pair pair = {.component = {v, v + 1},
                           .found_by = "its last dimension",
                           .rank = velocity ? FG__BY_VELOCITY_NAMES : FG__BY_OTHER_NAMES,
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
  bool memory = list_candidates(&all, data) && add_found(&pairs, &all, two_files);
  if (pairs.count == 0 && two_files) /* the second may have only positions or a mask */
    memory = memory && add_found(&pairs, &all, false);
  memory = memory && add_vectors(&pairs, data);
  free(all.term);
  free(all.variable);
  if (!memory) {
    free(pairs.entry);
    return fg__fail_memory(data->context, "pairs of variables", 0);
  }
  if (pairs.count > 0)
    qsort(pairs.entry, pairs.count, sizeof *pairs.entry, compare_pairs);
  *out = pairs.entry;
  *count = pairs.count;
  return FG_STATUS_OK;
}
