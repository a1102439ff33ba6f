/* Vectors: components of the same level type, member, step type and grid, at all times
 * and levels that both have. */
#include "base/memory.h"
#include "read/grib/grib.h"
#include "terms/vectors.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* "u@hybrid@member3": a name, and what tells its kind from others of that name. */
static bool has_word(const fg__grib_kind *kind, const char *word, size_t length)
{
  char member[FG__GRIB_WORD], grid[FG__GRIB_WORD];
  snprintf(member, sizeof member, "member%ld", kind->member);
  snprintf(grid, sizeof grid, "grid%d", kind->grid_number);
  const char *const words[] = {kind->level_type, kind->step_type, member, grid};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (strlen(words[i]) == length && memcmp(words[i], word, length) == 0)
      return true;
  return false;
}

static bool is_word(const char *word, const char *text, size_t length)
{
  return strlen(word) == length && memcmp(word, text, length) == 0;
}

bool fg__grib_is_named(const fg__grib_kind *kind, const char *name)
{
  size_t length = strcspn(name, "@");
  if (length == 0 ||
      (!is_word(kind->name, name, length) && !is_word(kind->other_name, name, length)))
    return false;
  for (name += length; *name; name += length) {
    ++name; /* the @ */
    length = strcspn(name, "@");
    if (!has_word(kind, name, length))
      return false;
  }
  return true;
}

static bool stand_together(const fg__grib_kind *u, const fg__grib_kind *v)
{
  return u->grid == v->grid && u->member == v->member &&
         strcmp(u->level_type, v->level_type) == 0 &&
         strcmp(u->step_type, v->step_type) == 0;
}

static int compare_dates(const fg__grib_date *a, const fg__grib_date *b)
{
  if (a->time != b->time)
    return a->time < b->time ? -1 : 1;
  return (a->started > b->started) - (a->started < b->started);
}

static int by_place(const void *one, const void *other)
{
  const fg__grib_place *a = one, *b = other;
  const int order = compare_dates(&a->date, &b->date);
  return order ? order : (a->level > b->level) - (a->level < b->level);
}

static int by_level(const void *one, const void *other)
{
  const double a = *(const double *)one, b = *(const double *)other;
  return (a > b) - (a < b);
}

/* All fields of a kind, in order; of those at one place, the first of the file. */
static fg_status list_places(fg__grib_place **out, size_t *count,
                             const fg__grib_file *file, const fg__grib_kind *kind,
                             int component)
{
  size_t n = 0;
  for (size_t i = 0; i < file->fields; ++i)
    n += &file->kind[file->about[file->field[i].about].kind] == kind;
  fg__grib_place *places = *out = fg__allocate(n, sizeof *places);
  if (!places)
    return fg__fail_memory(file->context, "a list of times and levels",
                           n * sizeof *places);
  n = 0;
  for (size_t i = 0; i < file->fields; ++i) {
    const fg__grib_field *field = &file->field[i];
    const fg__grib_about *about = &file->about[field->about];
    if (&file->kind[about->kind] != kind)
      continue;
    places[n].date = (fg__grib_date){field->time, field->started};
    places[n].level = about->level;
    places[n++].component[component] = field;
  }
  qsort(places, n, sizeof *places, by_place);
  *count = 0;
  for (size_t i = 0; i < n; ++i) {
    fg__grib_place *last = *count > 0 ? &places[*count - 1] : NULL;
    if (!last || by_place(last, &places[i]) != 0)
      places[(*count)++] = places[i];
    else if (places[i].component[component] < last->component[component])
      *last = places[i];
  }
  return FG_STATUS_OK;
}

/* Keeps in `u` the places where v is, too. */
static size_t join_places(fg__grib_place *u, size_t us, const fg__grib_place *v,
                          size_t vs)
{
  size_t kept = 0;
  for (size_t i = 0, j = 0; i < us && j < vs;) {
    const int order = by_place(&u[i], &v[j]);
    if (order == 0) {
      u[kept] = u[i];
      u[kept++].component[1] = v[j].component[1];
    }
    i += order <= 0;
    j += order >= 0;
  }
  return kept;
}

static fg_status list_axes(fg__grib_pair *pair, fg_context *context)
{
  pair->time = fg__allocate(pair->places, sizeof *pair->time);
  pair->level = fg__allocate(pair->places, sizeof *pair->level);
  if (!pair->time || !pair->level)
    return fg__fail_memory(context, "times and levels",
                           pair->places * sizeof *pair->time);
  for (size_t i = 0; i < pair->places; ++i) {
    if (i == 0 || compare_dates(&pair->time[pair->times - 1], &pair->place[i].date) != 0)
      pair->time[pair->times++] = pair->place[i].date;
    pair->level[i] = pair->place[i].level;
  }
  qsort(pair->level, pair->places, sizeof *pair->level, by_level);
  for (size_t i = 0; i < pair->places; ++i)
    if (i == 0 || pair->level[i] != pair->level[pair->levels - 1])
      pair->level[pair->levels++] = pair->level[i];
  return FG_STATUS_OK;
}

void fg__grib_pair_clear(fg__grib_pair *pair)
{
  free(pair->place);
  free(pair->time);
  free(pair->level);
}

/* Adds the pair of two kinds that have a time and level in common. */
static fg_status add_pair(fg__grib_pairs *pairs, const fg__grib_file *file,
                          const fg__grib_kind *u, const fg__grib_kind *v,
                          fg__grib_rank rank, const fg__polar *polar)
{
  fg__grib_pair pair = {.kind = {u, v}, .rank = rank};
  fg__grib_place *other = NULL;
  size_t us = 0, vs = 0;
  pair.polar = *polar;
  void *all = pairs->pair;
  fg_status status = list_places(&pair.place, &us, file, u, 0);
  if (status == FG_STATUS_OK)
    status = list_places(&other, &vs, file, v, 1);
  if (status == FG_STATUS_OK)
    pair.places = join_places(pair.place, us, other, vs);
  free(other);
  if (status == FG_STATUS_OK && pair.places > 0) {
    status = list_axes(&pair, file->context);
    if (status == FG_STATUS_OK &&
        !fg__grow(&all, &pairs->capacity, pairs->count + 1, sizeof pair))
      status = fg__fail_memory(file->context, "a list of pairs", sizeof pair);
  }
  if (status != FG_STATUS_OK || pair.places == 0) {
    fg__grib_pair_clear(&pair);
    return status;
  }
  pairs->pair = all;
  pairs->pair[pairs->count++] = pair;
  return FG_STATUS_OK;
}

static void add_word(char *name, const char *word)
{
  const size_t used = strlen(name);
  snprintf(name + used, FG__GRIB_TEXT - used, "@%s", word);
}

/* Names a component so that no other pair's has the same name. */
static void name_component(fg__grib_pair *pair, int k, const fg__grib_pairs *pairs)
{
  const fg__grib_kind *own = pair->kind[k];
  bool level = false, step = false, member = false, grid = false;
  for (size_t i = 0; i < pairs->count; ++i) {
    const fg__grib_kind *other = pairs->pair[i].kind[k];
    if (strcmp(other->name, own->name) != 0)
      continue;
    level = level || strcmp(other->level_type, own->level_type) != 0;
    step = step || strcmp(other->step_type, own->step_type) != 0;
    member = member || other->member != own->member;
    grid = grid || other->grid != own->grid;
  }
  char number[FG__GRIB_WORD];
  snprintf(pair->name[k], sizeof pair->name[k], "%s", own->name);
  if (level)
    add_word(pair->name[k], own->level_type);
  if (step)
    add_word(pair->name[k], own->step_type);
  snprintf(number, sizeof number, "member%ld", own->member);
  if (member)
    add_word(pair->name[k], number);
  snprintf(number, sizeof number, "grid%d", own->grid_number);
  if (grid)
    add_word(pair->name[k], number);
}

static void name_all(fg__grib_pairs *pairs)
{
  for (size_t i = 0; i < pairs->count; ++i)
    for (int k = 0; k < 2; ++k)
      name_component(&pairs->pair[i], k, pairs);
}

/* Titles of the kinds; those that stand together are one group. */
static fg__term *list_terms(const fg__grib_file *file)
{
  fg__term *terms = fg__allocate(file->kinds, sizeof *terms);
  for (size_t i = 0; i < file->kinds && terms; ++i) {
    size_t first = 0;
    while (first < i && !stand_together(&file->kind[first], &file->kind[i]))
      ++first;
    terms[i] = fg__grib_term(&file->kind[i]);
    terms[i].group = (int)first;
  }
  return terms;
}

static fg__grib_rank rank_of(const fg__vector *v)
{
  return v->polar.sense != 0 ? FG__GRIB_POLAR
         : v->is_velocity    ? FG__GRIB_VELOCITY
                             : FG__GRIB_OTHER;
}

fg_status fg__grib_pairs_find(fg__grib_pairs *out, const fg__grib_file *file)
{
  static const fg__vector_rules rules = {0};
  fg__vector *found = NULL;
  size_t count = 0;
  *out = (fg__grib_pairs){0};
  fg__term *terms = list_terms(file);
  fg_status status = terms && fg__vectors_find(&found, &count, terms, file->kinds, &rules)
                         ? FG_STATUS_OK
                         : fg__fail_memory(file->context, "pairs of fields", 0);
  for (int rank = FG__GRIB_VELOCITY; rank <= FG__GRIB_OTHER; ++rank)
    for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i) {
      const fg__vector *v = &found[i];
      if (v->is_upright || (int)rank_of(v) != rank)
        continue;
      const fg__grib_kind *a = &file->kind[v->component[0]],
                          *b = &file->kind[v->component[1]];
      if (v->polar.sense != 0 || strcmp(a->units, b->units) == 0)
        status = add_pair(out, file, a, b, (fg__grib_rank)rank, &v->polar);
    }
  free(found);
  free(terms);
  name_all(out);
  return status;
}

/* Two named fields: a length and its direction, or components of one unit. */
static fg_status add_named(fg__grib_pairs *out, const fg__grib_file *file,
                           const fg__grib_kind *a, const fg__grib_kind *b)
{
  const fg__term one = fg__grib_term(a), other = fg__grib_term(b);
  fg__polar polar;
  const int k = fg__direction_among(&polar, &one, &other);
  if (!stand_together(a, b) || (k < 0 && strcmp(a->units, b->units) != 0))
    return FG_STATUS_OK;
  return add_pair(out, file, k == 0 ? b : a, k == 0 ? a : b,
                  k < 0 ? FG__GRIB_OTHER : FG__GRIB_POLAR, &polar);
}

fg_status fg__grib_pairs_named(fg__grib_pairs *out, const fg__grib_file *file,
                               const char *u, const char *v)
{
  *out = (fg__grib_pairs){0};
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < file->kinds * file->kinds && status == FG_STATUS_OK; ++i) {
    const fg__grib_kind *a = &file->kind[i / file->kinds],
                        *b = &file->kind[i % file->kinds];
    if (a != b && fg__grib_is_named(a, u) && fg__grib_is_named(b, v))
      status = add_named(out, file, a, b);
  }
  name_all(out);
  return status;
}

void fg__grib_pairs_clear(fg__grib_pairs *pairs)
{
  for (size_t i = 0; i < pairs->count; ++i)
    fg__grib_pair_clear(&pairs->pair[i]);
  free(pairs->pair);
  *pairs = (fg__grib_pairs){0};
}
