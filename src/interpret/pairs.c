/* Finds the pairs of variables that are components of one vector: by CF standard_name,
 * then by name. A pattern of a name has '#' in place of a word or letter that denotes a
 * component: "U_GRD_6_ISBL" is "#_GRD_6_ISBL" with component x. A name can have several
 * patterns. Two variables with the same pattern and different components are a pair. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
  MOST_READINGS = 12,
  MOST_TOKENS = 24,
  KEY_BYTES = FG__NAME_BYTES + 8,
  RANK_STANDARD_VELOCITY = 0,
  RANK_NAMED_VELOCITY = 1,
  RANK_POLAR = 2, /* where the file has no components of a velocity */
  RANK_STANDARD_OTHER = 3,
  RANK_NAMED_OTHER = 4
};

typedef struct pattern {
  size_t variable;
  int component;
  bool standard;
  bool velocity;
  char key[KEY_BYTES];
} pattern;

typedef struct pattern_list {
  pattern *entry;
  size_t count, capacity;
} pattern_list;

typedef struct token {
  size_t start, length;
} token;

static const char *const COMPONENT_WORDS[][2] = {
    {"u", "v"},
    {"x", "y"},
    {"eastward", "northward"},
    {"east", "north"},
    {"zonal", "meridional"},
};

/* Longer words also count inside a name ("windEastward"; "vozocrtx" and "vomecrty" of
 * NEMO). */
static const char *const COMPONENT_PARTS[][2] = {
    {"eastward", "northward"}, {"zonal", "meridional"},
    {"vozo", "vome"},          {"sozo", "some"},
    {"east", "north"},         {"ustr", "vstr"}, /* "sustr" and "svstr" of ROMS */
};

static int split_tokens(const char *name, token out[MOST_TOKENS])
{
  int count = 0;
  for (size_t i = 0; name[i] && count < MOST_TOKENS;) {
    while (name[i] && !isalnum((unsigned char)name[i]))
      ++i;
    const size_t start = i;
    while (isalnum((unsigned char)name[i]))
      ++i;
    if (i > start)
      out[count++] = (token){start, i - start};
  }
  return count;
}

static bool is_word(const char *text, size_t length, const char *word)
{
  return strlen(word) == length && strncasecmp(text, word, length) == 0;
}

/* The component that a token alone denotes, without digits at its ends ("u10", "10v");
 * -1: none. *core becomes the part that denotes it. */
static int component_of_token(const char *name, token t, token *core)
{
  while (t.length > 0 && isdigit((unsigned char)name[t.start])) {
    ++t.start;
    --t.length;
  }
  while (t.length > 0 && isdigit((unsigned char)name[t.start + t.length - 1]))
    --t.length;
  *core = t;
  for (size_t w = 0; w < sizeof COMPONENT_WORDS / sizeof *COMPONENT_WORDS; ++w)
    for (int k = 0; k < 2; ++k)
      if (is_word(name + t.start, t.length, COMPONENT_WORDS[w][k]))
        return k;
  return -1;
}

/* Words in the name of a variable that is derived from a component, but is none. */
static bool spoils(const char *text, size_t length)
{
  static const char *const whole[] = {
      "sd",        "se",     "unc",      "var",      "num",   "nobs",  "lon",
      "lat",       "count",  "rms",      "rmse",     "area",  "angle", "index",
      "longitude", "weight", "latitude", "variance", "status"};
  static const char *const start[] = {"err",    "qc",   "qartod", "flag", "std",
                                      "uncert", "qual", "mask",   "bnds", "bounds"};
  for (size_t i = 0; i < sizeof whole / sizeof *whole; ++i)
    if (is_word(text, length, whole[i]))
      return true;
  for (size_t i = 0; i < sizeof start / sizeof *start; ++i)
    if (length >= strlen(start[i]) && strncasecmp(text, start[i], strlen(start[i])) == 0)
      return true;
  return false;
}

static bool is_spoilt(const char *name, const token *tokens, int count)
{
  for (int i = 0; i < count; ++i) {
    const char *text = name + tokens[i].start;
    const size_t length = tokens[i].length;
    if (spoils(text, length) ||
        (length > 1 && strchr("uvUV", text[0]) && spoils(text + 1, length - 1)))
      return true;
  }
  return false;
}

static bool add_pattern(pattern_list *list, const pattern *r)
{
  void *grown = list->entry;
  if (!fg__grow(&grown, &list->capacity, list->count + 1, sizeof *r))
    return false;
  list->entry = grown;
  list->entry[list->count++] = *r;
  return true;
}

/* Adds a pattern: the name with the given parts replaced by '#', all of one component. */
static bool add_replaced(pattern_list *list, size_t variable, char rule, int component,
                         const char *name, const token *parts, int part_count)
{
  pattern r = {.variable = variable, .component = component};
  size_t at = 0;
  size_t n = 0;
  r.key[n++] = rule;
  for (int p = 0; p < part_count; ++p) {
    while (at < parts[p].start && n < KEY_BYTES - 2)
      r.key[n++] = name[at++];
    r.key[n++] = '#';
    at = parts[p].start + parts[p].length;
  }
  while (name[at] && n < KEY_BYTES - 2)
    r.key[n++] = name[at++];
  return add_pattern(list, &r);
}

static bool add_word_patterns(pattern_list *list, size_t variable, const char *name,
                              const token *tokens, int count)
{
  token found[MOST_TOKENS];
  int component[MOST_TOKENS];
  int n = 0;
  bool agree = true;
  for (int i = 0; i < count; ++i) {
    component[n] = component_of_token(name, tokens[i], &found[n]);
    if (component[n] < 0)
      continue;
    agree = agree && component[n] == component[0];
    ++n;
  }
  bool added = true;
  if (n > 0 && agree)
    added = add_replaced(list, variable, 'w', component[0], name, found, n);
  if (n > 1) {
    added = added && add_replaced(list, variable, 'w', component[0], name, found, 1);
    added = added &&
            add_replaced(list, variable, 'w', component[n - 1], name, &found[n - 1], 1);
  }
  return added;
}

/* Patterns by the first letter ("uwnd", "UGRD", "10uwind") or the last ("windu", "vx") of
 * the first and the last token. */
static bool add_letter_patterns(pattern_list *list, size_t variable, const char *name,
                                const token *tokens, int count)
{
  bool added = true;
  for (int i = 0; i < count && added; i += count > 1 ? count - 1 : 1) {
    token core;
    if (component_of_token(name, tokens[i], &core) >= 0 || core.length < 2)
      continue;
    const char first = (char)tolower((unsigned char)name[core.start]);
    const size_t end = core.start + core.length - 1;
    const char last = (char)tolower((unsigned char)name[end]);
    if (first == 'u' || first == 'v')
      added = add_replaced(list, variable, 'f', first == 'v', name,
                           &(token){core.start, 1}, 1);
    if (last == 'u' || last == 'v')
      added = added &&
              add_replaced(list, variable, 'l', last == 'v', name, &(token){end, 1}, 1);
    if (last == 'x' || last == 'y')
      added = added &&
              add_replaced(list, variable, 'c', last == 'y', name, &(token){end, 1}, 1);
  }
  return added;
}

static bool add_part_patterns(pattern_list *list, size_t variable, const char *name)
{
  for (size_t w = 0; w < sizeof COMPONENT_PARTS / sizeof *COMPONENT_PARTS; ++w)
    for (int k = 0; k < 2; ++k) {
      const char *part = COMPONENT_PARTS[w][k];
      const size_t length = strlen(part);
      for (size_t i = 0; name[i]; ++i) {
        if (strncasecmp(name + i, part, length) != 0)
          continue;
        /* NEMO: "crtx" and "crty" also differ at the end */
        const size_t end = strlen(name) - 1;
        const token parts[] = {{i, length}, {end, 1}};
        const bool nemo = (part[0] == 'v' || part[0] == 's') && part[1] == 'o';
        return add_replaced(list, variable, 'p', k, name, parts,
                            nemo && end >= i + length ? 2 : 1);
      }
    }
  return true;
}

static bool add_name_patterns(pattern_list *list, size_t variable, const char *name)
{
  token tokens[MOST_TOKENS];
  const int count = split_tokens(name, tokens);
  if (count == 0 || is_spoilt(name, tokens, count))
    return true;
  return add_word_patterns(list, variable, name, tokens, count) &&
         add_letter_patterns(list, variable, name, tokens, count) &&
         add_part_patterns(list, variable, name);
}

static bool contains_any(const char *text, const char *const *words, size_t count)
{
  for (size_t i = 0; i < count; ++i)
    if (strstr(text, words[i]))
      return true;
  return false;
}

/* CF standard names: "eastward_wind", "sea_water_x_velocity_at_u_location". */
static bool add_standard_pattern(pattern_list *list, size_t variable, char *name)
{
  static const char *const no_vector[] = {"coordinate", "grid_index", "square_of",
                                          "derivative", "longitude",  "latitude",
                                          "inverse_of", "cell_",      "index_at"};
  static const char *const velocity[] = {"wind", "velocity", "drift"};
  static const char *const other[] = {
      "stress",   "shear", "flux",         "tendency", "transport",   "product",
      "momentum", "force", "acceleration", "gradient", "displacement"};
#define COUNT_OF(array) (sizeof(array) / sizeof *(array))
  const bool is_other = contains_any(name, other, COUNT_OF(other));
  const bool is_velocity = !is_other && contains_any(name, velocity, COUNT_OF(velocity));
  if (strpbrk(name, " \t") || contains_any(name, no_vector, COUNT_OF(no_vector)) ||
      !(is_velocity || is_other))
    return true;
  char *location = strstr(name, "_at_u_location");
  location = location ? location : strstr(name, "_at_v_location");
  if (location)
    *location = '\0';
  token tokens[MOST_TOKENS];
  const int count = split_tokens(name, tokens);
  for (int i = 0; i < count; ++i) {
    token core;
    const int component = component_of_token(name, tokens[i], &core);
    if (component < 0)
      continue;
    if (!add_replaced(list, variable, 's', component, name, &core, 1))
      return false;
    pattern *added = &list->entry[list->count - 1];
    added->standard = true;
    added->velocity = is_velocity;
    return true;
  }
  return true;
}

static bool is_quality_name(const char *standard_name)
{
  static const char *const quality[] = {"status_flag", "quality_flag", "standard_error"};
  return contains_any(standard_name, quality, COUNT_OF(quality));
}

static bool may_be_component(const fg__dataset *data, const fg__variable *v)
{
  return v->file < data->component_files && fg__is_array(v) && !v->element &&
         (v->rank >= 2 || fg__unstructured_line(data, v));
}

static bool list_patterns(pattern_list *list, const fg__dataset *data)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    char text[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
    if (!may_be_component(data, v))
      continue;
    fg__attribute_text(v, "units", text, sizeof text);
    const fg__quantity quantity = fg__units_read(text, label, sizeof label);
    const bool unitless = text[0] == '\0';
    fg__attribute_text(v, "standard_name", text, sizeof text);
    if (quantity >= FG__QUANTITY_LENGTH && !strstr(text, "displacement"))
      continue;
    if (is_quality_name(text))
      continue;
    if (!add_standard_pattern(list, i, text))
      return false;
    const size_t first = list->count;
    if (!add_name_patterns(list, i, v->name))
      return false;
    for (size_t k = first; k < list->count; ++k)
      list->entry[k].velocity = unitless || quantity != FG__QUANTITY_UNKNOWN;
  }
  return true;
}

static int compare_patterns(const void *left, const void *right)
{
  const pattern *a = left, *b = right;
  const int by_key = strcmp(a->key, b->key);
  if (by_key != 0)
    return by_key;
  if (a->component != b->component)
    return a->component - b->component;
  return a->variable < b->variable ? -1 : a->variable > b->variable;
}

static bool same_shape(const fg__variable *a, const fg__variable *b)
{
  return a->rank == b->rank &&
         memcmp(a->dimension, b->dimension, (size_t)a->rank * sizeof *a->dimension) == 0;
}

/* Variables of one standard name at different heights ("u10", "u100") are distinguished
 * by their names. */
static bool names_agree(const pattern_list *list, size_t x, size_t y)
{
  for (size_t a = 0; a < list->count; ++a) {
    if (list->entry[a].variable != x || list->entry[a].standard)
      continue;
    for (size_t b = 0; b < list->count; ++b)
      if (list->entry[b].variable == y && !list->entry[b].standard &&
          list->entry[a].component == 0 && list->entry[b].component == 1 &&
          strcmp(list->entry[a].key, list->entry[b].key) == 0)
        return true;
  }
  return false;
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

static bool add_pair(pair_list *pairs, const fg__dataset *data, const pattern *x,
                     const pattern *y)
{
  const int rank = x->standard
                       ? (x->velocity ? RANK_STANDARD_VELOCITY : RANK_STANDARD_OTHER)
                   : x->velocity && y->velocity ? RANK_NAMED_VELOCITY
                                                : RANK_NAMED_OTHER;
  const fg__pair pair = {
      .component = {&data->variables[x->variable], &data->variables[y->variable]},
      .found_by = x->standard ? "standard_name" : "names",
      .rank = rank,
      .is_velocity = rank <= RANK_NAMED_VELOCITY};
  for (size_t i = 0; i < pairs->count; ++i)
    if (pairs->entry[i].component[0] == pair.component[0] &&
        pairs->entry[i].component[1] == pair.component[1]) {
      if (pair.rank < pairs->entry[i].rank)
        pairs->entry[i] = pair;
      return true;
    }
  return append(pairs, &pair);
}

/* Pairs the patterns first ... end - 1, which are equal. apart: components of two files
 * are in one each. */
static bool pair_group(pair_list *pairs, const fg__dataset *data,
                       const pattern_list *list, size_t first, size_t end, bool apart)
{
  size_t middle = first;
  while (middle < end && list->entry[middle].component == 0)
    ++middle;
  const bool alone = middle - first == 1 && end - middle == 1;
  for (size_t x = first; x < middle; ++x) {
    const fg__variable *u = &data->variables[list->entry[x].variable];
    bool shape_found = false;
    for (size_t y = middle; y < end && !shape_found; ++y)
      shape_found = same_shape(u, &data->variables[list->entry[y].variable]);
    for (size_t y = middle; y < end; ++y) {
      const fg__variable *v = &data->variables[list->entry[y].variable];
      if (apart && u->file == v->file && !fg__unstructured_elsewhere(data, u))
        continue;
      if (shape_found && !same_shape(u, v))
        continue;
      if (list->entry[x].standard && !alone &&
          !names_agree(list, list->entry[x].variable, list->entry[y].variable))
        continue;
      if (!add_pair(pairs, data, &list->entry[x], &list->entry[y]))
        return false;
    }
  }
  return true;
}

static bool pair_groups(pair_list *pairs, const fg__dataset *data,
                        const pattern_list *list, bool apart)
{
  bool memory = true;
  for (size_t first = 0; first < list->count && memory;) {
    size_t end = first + 1;
    while (end < list->count && strcmp(list->entry[end].key, list->entry[first].key) == 0)
      ++end;
    memory = pair_group(pairs, data, list, first, end, apart);
    first = end;
  }
  return memory;
}

/* Vector variables, which file.c lists as two in a row. */
static bool add_vectors(pair_list *pairs, const fg__dataset *data)
{
  for (size_t i = 0; i + 1 < data->variable_count; ++i) {
    char units[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
    if (data->variables[i].element != 1 ||
        data->variables[i].file >= data->component_files)
      continue;
    fg__attribute_text(&data->variables[i], "units", units, sizeof units);
    const bool velocity =
        !units[0] || fg__units_read(units, label, sizeof label) == FG__QUANTITY_SPEED;
    const fg__pair pair = {.component = {&data->variables[i], &data->variables[i + 1]},
                           .found_by = "its last dimension",
                           .rank = velocity ? RANK_NAMED_VELOCITY : RANK_NAMED_OTHER,
                           .is_velocity = velocity};
    if (!append(pairs, &pair))
      return false;
  }
  return true;
}

/* Speeds with their directions. */
static bool add_polar(pair_list *pairs, const fg__dataset *data)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    fg__pair pair = {.found_by = "standard_name", .rank = RANK_POLAR};
    if (may_be_component(data, &data->variables[i]) &&
        fg__find_polar(&pair, data, &data->variables[i]) && !append(pairs, &pair))
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
  pattern_list list = {0};
  pair_list pairs = {0};
  bool memory = list_patterns(&list, data);
  if (list.count > 0)
    qsort(list.entry, list.count, sizeof *list.entry, compare_patterns);
  memory = memory && pair_groups(&pairs, data, &list, data->component_files > 1);
  /* the second may have only positions or a mask */
  if (pairs.count == 0 && data->component_files > 1)
    memory = memory && pair_groups(&pairs, data, &list, false);
  free(list.entry);
  memory = memory && add_vectors(&pairs, data) && add_polar(&pairs, data);
  if (!memory) {
    free(pairs.entry);
    return fg__fail_memory(data->context, "pairs of variables", 0);
  }
  for (fg__pair *p = pairs.entry; p && p < pairs.entry + pairs.count; ++p)
    if (!p->component[0]->element && p->polar.sense == 0)
      p->component[2] = fg__third_component(data, p);
  if (pairs.count > 0)
    qsort(pairs.entry, pairs.count, sizeof *pairs.entry, compare_pairs);
  *out = pairs.entry;
  *count = pairs.count;
  return FG_STATUS_OK;
}
