#include "terms/vectors.h"

#include "base/memory.h"
#include "terms/names.h"
#include "terms/text.h"
#include "terms/units.h"

#include <stdlib.h>
#include <string.h>

typedef struct search {
  const fg__term *term;
  size_t terms;
  const fg__vector_rules *rules;
  fg__patterns patterns;
  fg__vector *vector;
  size_t count, capacity;
} search;

static const char *or_empty(const char *text)
{
  return text ? text : "";
}

static bool append(search *s, const fg__vector *vector)
{
  void *grown = s->vector;
  if (!fg__grow(&grown, &s->capacity, s->count + 1, sizeof *vector))
    return false;
  s->vector = grown;
  s->vector[s->count++] = *vector;
  return true;
}

/* Adds a vector, or its better rank or third component where it is there. */
static bool add(search *s, const fg__vector *vector)
{
  for (size_t i = 0; i < s->count; ++i) {
    fg__vector *known = &s->vector[i];
    if (memcmp(known->component, vector->component, 2 * sizeof(int)) != 0 ||
        known->is_upright != vector->is_upright)
      continue;
    const int third =
        known->component[2] >= 0 ? known->component[2] : vector->component[2];
    if (vector->rank < known->rank)
      *known = *vector;
    known->component[2] = third;
    return true;
  }
  return append(s, vector);
}

/* Variables of one standard name at different heights ("u10", "u100") are distinguished
 * by their names. */
static bool names_agree(const search *s, size_t x, size_t y)
{
  const fg__pattern *all = s->patterns.entry;
  for (size_t a = 0; a < s->patterns.count; ++a) {
    if (all[a].term != x || all[a].standard || all[a].component != 0)
      continue;
    for (size_t b = 0; b < s->patterns.count; ++b)
      if (all[b].term == y && all[b].component == 1 &&
          fg__is_same_pattern(&all[a], &all[b], false))
        return true;
  }
  return false;
}

/* How well two patterns fit; below 0: not at all. Components at the same points go before
 * those on a staggered grid, names in the same case before others. */
static int fit(const search *s, const fg__pattern *x, const fg__pattern *y)
{
  const fg__term *u = &s->term[x->term], *v = &s->term[y->term];
  if (u->group != v->group || (s->rules->apart && u->file == v->file && u->file >= 0))
    return -1;
  return 2 * (u->place == v->place) + fg__is_same_pattern(x, y, true);
}

static bool have_same_units(const fg__term *a, const fg__term *b)
{
  fg__unit one, other;
  fg__unit_read(&one, or_empty(a->units));
  fg__unit_read(&other, or_empty(b->units));
  return strcmp(one.label, other.label) == 0;
}

static bool is_third(const search *s, const fg__term *w, size_t x, size_t y)
{
  const fg__term *u = &s->term[x];
  return w != u && w != &s->term[y] && w->group == u->group && w->place == u->place &&
         have_same_units(u, w);
}

/* The third component among patterns first ... end - 1 of the pair's; -1: none. */
static int find_third(const search *s, const fg__pattern *x, const fg__pattern *y,
                      size_t first, size_t end)
{
  const fg__pattern *best = NULL;
  for (size_t i = first; i < end; ++i) {
    const fg__pattern *z = &s->patterns.entry[i];
    if (z->component == 2 && is_third(s, &s->term[z->term], x->term, y->term) &&
        (!best ||
         (fg__is_same_pattern(x, z, true) && !fg__is_same_pattern(x, best, true))))
      best = z;
  }
  return best ? (int)best->term : -1;
}

/* The only velocity upwards, by its standard name, at the pair's points; -1: none. */
static int find_upward(const search *s, const fg__vector *pair)
{
  int found = -1, count = 0;
  for (size_t i = 0; i < s->terms; ++i)
    if (fg__is_upward_velocity(or_empty(s->term[i].standard_name)) &&
        is_third(s, &s->term[i], (size_t)pair->component[0],
                 (size_t)pair->component[1])) {
      found = (int)i;
      ++count;
    }
  return count == 1 ? found : -1;
}

static bool add_pair(search *s, const fg__pattern *x, const fg__pattern *y, int third)
{
  const bool velocity = x->velocity && y->velocity;
  const fg__vector v = {.component = {(int)x->term, (int)y->term, third},
                        .found_by = x->standard ? "standard_name" : "names",
                        .rank = x->standard ? (x->velocity ? FG__BY_STANDARD_VELOCITY
                                                           : FG__BY_STANDARD_OTHER)
                                : velocity  ? FG__BY_VELOCITY_NAMES
                                            : FG__BY_OTHER_NAMES,
                        .is_indexed = fg__is_index(x),
                        .is_velocity = x->standard ? x->velocity : velocity};
  return add(s, &v);
}

/* Patterns of one name in the order of their components: each has its own range. */
typedef struct name_group {
  size_t start[4];
} name_group;

static size_t count_of(const name_group *g, int component)
{
  return g->start[component + 1] - g->start[component];
}

/* Pairs components a and b of a name: each of a with those of b that fit best. */
static bool pair_components(search *s, const name_group *g, int a, int b)
{
  const fg__pattern *all = s->patterns.entry;
  const bool alone = count_of(g, a) == 1 && count_of(g, b) == 1, upright = b == 2;
  for (size_t x = g->start[a]; x < g->start[a + 1]; ++x) {
    int best = 0;
    for (size_t y = g->start[b]; y < g->start[b + 1]; ++y)
      best = fit(s, &all[x], &all[y]) > best ? fit(s, &all[x], &all[y]) : best;
    for (size_t y = g->start[b]; y < g->start[b + 1]; ++y) {
      if (fit(s, &all[x], &all[y]) != best)
        continue;
      if (all[x].standard && !alone && !names_agree(s, all[x].term, all[y].term))
        continue;
      const fg__vector pair = {.component = {a == 0 ? (int)all[x].term : -1,
                                             a == 1 ? (int)all[x].term : -1,
                                             (int)all[y].term},
                               .is_upright = true,
                               .found_by = "names",
                               .rank = FG__BY_UPRIGHT_NAMES};
      if (upright ? !add(s, &pair)
                  : !add_pair(s, &all[x], &all[y],
                              find_third(s, &all[x], &all[y], g->start[2], g->start[3])))
        return false;
    }
  }
  return true;
}

/* Pairs the patterns first ... end - 1, which are equal but for the component. */
static bool pair_group(search *s, size_t first, size_t end)
{
  const fg__pattern *all = s->patterns.entry;
  name_group g = {{first, first, first, first}};
  for (int k = 1; k <= 3; ++k) {
    g.start[k] = g.start[k - 1];
    while (g.start[k] < end && all[g.start[k]].component < k)
      ++g.start[k];
  }
  if (g.start[3] < end) /* an index beyond 2 */
    return true;
  if (count_of(&g, 0) > 0 && count_of(&g, 1) > 0)
    return pair_components(s, &g, 0, 1);
  if (all[first].standard || fg__is_index(&all[first]) || count_of(&g, 2) == 0)
    return true;
  return pair_components(s, &g, count_of(&g, 0) > 0 ? 0 : 1, 2);
}

static bool pair_names(search *s)
{
  fg__patterns *p = &s->patterns;
  for (size_t i = 0; i < s->terms; ++i)
    if (!fg__patterns_add(p, s->term, s->terms, i, s->rules->at_points))
      return false;
  if (p->count > 0)
    qsort(p->entry, p->count, sizeof *p->entry, fg__compare_patterns);
  bool memory = true;
  for (size_t first = 0, end; first < p->count && memory; first = end) {
    end = first + 1;
    while (end < p->count && fg__is_same_pattern(&p->entry[first], &p->entry[end], false))
      ++end;
    memory = pair_group(s, first, end);
  }
  return memory;
}

static bool pair_directions(search *s)
{
  for (size_t i = 0; i < s->terms; ++i) {
    fg__vector v = {.component = {-1, (int)i, -1}, .rank = FG__BY_SPEED_AND_DIRECTION};
    v.component[0] = fg__speed_of(&v.polar, s->term, s->terms, i);
    v.found_by =
        or_empty(s->term[i].standard_name)[0] ? "standard_name" : "speed and direction";
    if (v.component[0] >= 0 && !append(s, &v))
      return false;
  }
  return true;
}

/* Leaves out those of indices whose components are another vector's: of u_0, u_1, v_0 and
 * v_1, which are vectors of two levels. */
static void drop_indices(search *s)
{
  size_t kept = 0;
  for (size_t i = 0; i < s->count; ++i) {
    bool taken = false;
    for (size_t k = 0; s->vector[i].is_indexed && k < s->count; ++k)
      for (int a = 0; a < 2 && !s->vector[k].is_indexed; ++a)
        for (int b = 0; b < 2; ++b)
          taken = taken || s->vector[k].component[a] == s->vector[i].component[b];
    if (!taken)
      s->vector[kept++] = s->vector[i];
  }
  s->count = kept;
}

/* Where "u" and "v" stand beside "u_filtered" and "v_filtered", they are meant. */
static void prefer_plain(search *s)
{
  for (size_t i = 0; i < s->count; ++i) {
    fg__vector *v = &s->vector[i];
    const int *c = v->component;
    if (v->rank != FG__BY_VELOCITY_NAMES && v->rank != FG__BY_OTHER_NAMES)
      continue;
    const int plain = fg__plainness(s->term[c[0]].name, s->term[c[1]].name);
    for (size_t k = 0; k < s->count && v->rank % 2 == 0; ++k) {
      const int *d = s->vector[k].component;
      if (k == i || s->vector[k].rank / 2 != v->rank / 2)
        continue;
      const int other = fg__plainness(s->term[d[0]].name, s->term[d[1]].name);
      const bool together = s->term[c[0]].place == s->term[d[0]].place &&
                            s->term[c[1]].place == s->term[d[1]].place;
      v->rank += together && other >= 0 && (plain < 0 || other < plain);
    }
  }
}

static int compare_vectors(const void *left, const void *right)
{
  const fg__vector *a = left, *b = right;
  if (a->rank != b->rank)
    return a->rank - b->rank;
  const int by_first = a->component[0] - b->component[0];
  return by_first != 0 ? by_first : a->component[1] - b->component[1];
}

bool fg__vectors_find(fg__vector **out, size_t *count, const fg__term *terms,
                      size_t term_count, const fg__vector_rules *rules)
{
  search s = {.term = terms, .terms = term_count, .rules = rules};
  const bool memory = pair_names(&s) && pair_directions(&s);
  free(s.patterns.entry);
  if (!memory) {
    free(s.vector);
    s = (search){0};
  }
  for (size_t i = 0; i < s.count; ++i)
    if (s.vector[i].component[2] < 0 && s.vector[i].polar.sense == 0)
      s.vector[i].component[2] = find_upward(&s, &s.vector[i]);
  drop_indices(&s);
  prefer_plain(&s);
  if (s.count > 0)
    qsort(s.vector, s.count, sizeof *s.vector, compare_vectors);
  *out = s.vector;
  *count = s.count;
  return memory;
}
