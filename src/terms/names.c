#include "terms/names.h"

#include "base/memory.h"
#include "terms/coordinates.h"
#include "terms/text.h"
#include "terms/units.h"

#include <stdlib.h>
#include <string.h>

/* Where words may stand for components. */
typedef enum place {
  NOWHERE = 0,
  BY_VECTOR, /* where the rest of the name is a vector's: "vel_e" */
  ANYWHERE
} place;

typedef struct component_words {
  const char *word[3];
  place alone;         /* between other characters, "wind_u" */
  place first, last;   /* a letter of a longer word, "uwnd", "velX" */
  const char *vectors; /* letters that are a vector's by themselves; NULL: "u|v" */
  bool inside;         /* part of a longer word: "windEastward" */
  bool standard;       /* also in CF standard names */
  bool has_tail;       /* names also differ in the last letter */
} component_words;

static const component_words WORDS[] = {
    {{"u", "v", "w"}, ANYWHERE, ANYWHERE, ANYWHERE, .standard = true},
    {{"x", "y", "z"}, ANYWHERE, BY_VECTOR, ANYWHERE, .standard = true},
    {{"eastward", "northward", "upward"}, ANYWHERE, .inside = true, .standard = true},
    {{"east", "north", "up"}, ANYWHERE, .inside = true, .standard = true},
    {{"zonal", "meridional", "vertical"}, ANYWHERE, .inside = true, .standard = true},
    {{"east-west", "north-south", NULL}, .inside = true},
    {{"vozo", "vome", "vove"}, .inside = true, .has_tail = true}, /* NEMO: vozocrtx */
    {{"sozo", "some", NULL}, .inside = true, .has_tail = true},
    {{"ustr", "vstr", "wstr"}, .inside = true}, /* ROMS: sustr and svstr, stresses */
    {{"e", "n", "u"}, BY_VECTOR, BY_VECTOR, BY_VECTOR, .vectors = "u|v|d"},
    {{"i", "j", "k"}, .alone = BY_VECTOR, .last = BY_VECTOR},
    {{"0", "1", "2"}, .alone = BY_VECTOR, .last = BY_VECTOR},
};
enum { WORD_ROWS = sizeof WORDS / sizeof *WORDS, INDICES = WORD_ROWS - 1 };

/* Names that go before longer ones at the same points. */
static const char *const PLAIN[][2] = {{"u", "v"},        {"vx", "vy"}, {"ux", "uy"},
                                       {"east", "north"}, {"ve", "vn"}, {"e", "n"}};

/* How names of vectors begin. */
static const char VECTORS[] = "vel|wind|wnd|curr|flow|drift|disp|vec|force|momentum|flux|"
                              "stress|tau|grad|accel|slip|motion|transport|stokes";

/* Vectors that are no velocities. */
static const char OTHERS[] =
    "stress|ustr|vstr|tau|flux|shear|tendency|transport|product|momentum|force|"
    "acceleration|gradient|displacement";

/* Words of what is derived from a component, but is none; and how others begin. */
static const char SPOILING[] =
    "sd|se|unc|var|num|nobs|lon|lat|count|rms|rmse|area|angle|index|longitude|weight|"
    "latitude|variance|status|qal|pos|position|coord|coordinate|coordinates|points";
static const char SPOILING_STARTS[] =
    "err|qc|qartod|flag|std|uncert|qual|mask|bnds|bounds";

/* In standard names. */
static const char NO_VECTORS[] = "coordinate|grid_index|square_of|derivative|longitude|"
                                 "latitude|inverse_of|cell_|index_at";
static const char NO_VALUES[] = "status_flag|quality_flag|standard_error";
static const char VELOCITIES[] = "wind|velocity|drift";

static const char *or_empty(const char *text)
{
  return text ? text : "";
}

static bool spoils(const char *text, size_t length)
{
  return fg__is_one_of(SPOILING, text, length) ||
         fg__starts_with_one_of(SPOILING_STARTS, text, length);
}

/* Whether another term has the name but for a word at its beginning or end: u beside
 * u_sigma, which is its error; else u_sigma is on a model's levels. */
static bool has_another_without(const fg__term *terms, size_t count, const char *name,
                                fg__token word)
{
  const char *rest = word.start > 0 ? name : name + word.length + 1;
  const size_t length = word.start > 0 ? word.start - 1 : strlen(name) - word.length - 1;
  for (size_t i = 0; i < count && strlen(name) > word.length; ++i)
    if (fg__is_word(rest, length, terms[i].name))
      return true;
  return false;
}

static bool is_spoilt(const fg__term *terms, size_t count, const char *name,
                      const fg__token *tokens, int n)
{
  for (int i = 0; i < n; ++i) {
    const char *text = name + tokens[i].start;
    const size_t length = tokens[i].length;
    const bool letter = length > 1 && fg__is_one_of("u|v|x|y", text, 1);
    if (spoils(text, length) || (letter && spoils(text + 1, length - 1)))
      return true;
    if (fg__is_word(text, length, "sigma") &&
        has_another_without(terms, count, name, tokens[i]))
      return true;
  }
  return false;
}

static bool add(fg__patterns *list, const fg__pattern *pattern)
{
  void *grown = list->entry;
  if (!fg__grow(&grown, &list->capacity, list->count + 1, sizeof *pattern))
    return false;
  list->entry = grown;
  list->entry[list->count++] = *pattern;
  return true;
}

/* A pattern of one hole. */
static bool add_hole(fg__patterns *list, const fg__pattern *whole, int component,
                     fg__token at, int words)
{
  fg__pattern p = *whole;
  p.component = component;
  p.holes = 1;
  p.hole[0] = (fg__hole){at.start, at.length, words};
  return add(list, &p);
}

/* Whether the name is a vector's without what denotes the component, or an index in
 * brackets. */
static bool is_by_vector(const fg__pattern *whole, const fg__token *tokens, int count,
                         fg__token hole, int row)
{
  const char *letters = WORDS[row].vectors ? WORDS[row].vectors : "u|v";
  const char before = hole.start > 0 ? whole->text[hole.start - 1] : '\0';
  const size_t end = hole.start + hole.length;
  for (int i = 0; i < count; ++i) {
    fg__token t = tokens[i];
    if (t.start <= hole.start && t.start + t.length >= end)
      t = (fg__token){t.start == hole.start ? end : t.start, t.length - hole.length};
    if (fg__is_one_of(letters, whole->text + t.start, t.length))
      return true;
    for (size_t at = t.start; at < t.start + t.length; ++at)
      if (fg__starts_with_one_of(VECTORS, whole->text + at, t.start + t.length - at))
        return true;
  }
  return before == ':' || before == '[' || fg__plainness(whole->text, NULL) >= 0;
}

static bool may_stand(place where, const fg__pattern *whole, const fg__token *tokens,
                      int count, fg__token hole, int row)
{
  return where == ANYWHERE ||
         (where == BY_VECTOR && is_by_vector(whole, tokens, count, hole, row));
}

/* The component that a word denotes in a row of words; -1: none. An index may be any
 * digit. */
static int component_of(int row, const char *text, size_t length)
{
  if (row == INDICES)
    return length == 1 && fg__is_digit(*text) ? *text - '0' : -1;
  for (int k = 0; k < 3; ++k)
    if (WORDS[row].word[k] && fg__is_word(text, length, WORDS[row].word[k]))
      return k;
  return -1;
}

/* The part of a token that words of a row may be: without digits, but for an index. */
static fg__token core_of(const char *text, fg__token token, int row)
{
  return row == INDICES ? token : fg__without_digits(text, token);
}

/* Adds the pattern whose holes are all tokens that denote a component, if they denote the
 * same: u_eastward. */
static bool add_all_words(fg__patterns *list, const fg__pattern *whole,
                          const fg__token *tokens, int count)
{
  fg__pattern p = *whole;
  p.component = -1;
  for (int i = 0; i < count; ++i)
    for (int row = 0; row < WORD_ROWS; ++row) {
      const fg__token core = core_of(p.text, tokens[i], row);
      const int k = WORDS[row].alone == ANYWHERE
                        ? component_of(row, p.text + core.start, core.length)
                        : -1;
      if (k < 0)
        continue;
      if ((p.holes > 0 && k != p.component) || p.holes == FG__MOST_HOLES)
        return true;
      p.component = k;
      p.hole[p.holes++] = (fg__hole){core.start, core.length, row};
    }
  return p.holes < 2 || add(list, &p);
}

static bool add_word(fg__patterns *list, const fg__pattern *whole,
                     const fg__token *tokens, int count, int which, bool *is_word)
{
  *is_word = false;
  for (int row = 0; row < WORD_ROWS; ++row) {
    const fg__token core = core_of(whole->text, tokens[which], row);
    const int k = component_of(row, whole->text + core.start, core.length);
    if (k < 0)
      continue;
    *is_word = *is_word || row != INDICES;
    if (may_stand(WORDS[row].alone, whole, tokens, count, core, row) &&
        !add_hole(list, whole, k, core, row))
      return false;
  }
  return true;
}

/* Whether a letter of a token may denote a component: an index is its only digit, and
 * other letters are of no token that is a word of components itself. */
static bool may_denote(const char *text, fg__token token, int row, bool is_word)
{
  const fg__token core = fg__without_digits(text, token);
  return row == INDICES ? core.length + 1 == token.length && core.start == token.start
                        : core.length > 1 && !is_word;
}

/* Patterns by the first letter of a token ("uwnd", "10uwind") or its last ("windu", "vx",
 * "U0"). */
static bool add_letters(fg__patterns *list, const fg__pattern *whole,
                        const fg__token *tokens, int count, int which, bool is_word)
{
  for (int row = 0; row < WORD_ROWS; ++row) {
    const fg__token core = core_of(whole->text, tokens[which], row);
    for (int last = 0; last < 2; ++last) {
      if (!may_denote(whole->text, tokens[which], row, is_word))
        continue;
      const fg__token letter = {core.start + (last ? core.length - 1 : 0), 1};
      const int k = component_of(row, whole->text + letter.start, 1);
      const place where = last ? WORDS[row].last : WORDS[row].first;
      if (k >= 0 && may_stand(where, whole, tokens, count, letter, row) &&
          !add_hole(list, whole, k, letter, row))
        return false;
    }
  }
  return true;
}

static bool add_parts(fg__patterns *list, const fg__pattern *whole)
{
  for (int row = 0; row < WORD_ROWS; ++row)
    for (int k = 0; k < 3 && WORDS[row].inside; ++k) {
      const char *word = WORDS[row].word[k];
      const char *at = word && strlen(word) > 3 ? fg__find_text(whole->text, word) : NULL;
      if (!at)
        continue;
      fg__pattern p = *whole;
      p.component = k;
      p.hole[p.holes++] = (fg__hole){(size_t)(at - p.text), strlen(word), row};
      const size_t end = p.hole[0].start + p.hole[0].length;
      if (WORDS[row].has_tail && end < p.length)
        p.hole[p.holes++] = (fg__hole){p.length - 1, 1, row};
      if (!add(list, &p))
        return false;
    }
  return true;
}

/* The token that is an index in brackets or behind a colon, and nothing else of its name
 * is a component; -1: none. */
static int find_bracketed(const char *name, const fg__token *tokens, int count)
{
  for (int i = 0; i < count; ++i) {
    const char *token = name + tokens[i].start;
    if (tokens[i].start > 0 && tokens[i].length == 1 && strchr(":[", token[-1]) &&
        (fg__is_digit(*token) || fg__is_one_of("i|j|k", token, 1)))
      return i;
  }
  return -1;
}

static bool add_name(fg__patterns *list, const fg__pattern *whole, const fg__term *terms,
                     size_t terms_count)
{
  fg__token tokens[FG__MOST_TOKENS];
  const int count = fg__split_name(tokens, whole->text);
  bool is_word, added = true;
  if (is_spoilt(terms, terms_count, whole->text, tokens, count) ||
      fg__names_coordinate(whole->text) ||
      fg__names_coordinate(fg__last_part(whole->text)))
    return true;
  const int index = find_bracketed(whole->text, tokens, count);
  if (index >= 0)
    return add_word(list, whole, tokens, count, index, &is_word);
  for (int i = 0; i < count && added; ++i) {
    added = add_word(list, whole, tokens, count, i, &is_word);
    added = added && add_letters(list, whole, tokens, count, i, is_word);
  }
  return added && add_all_words(list, whole, tokens, count) && add_parts(list, whole);
}

/* CF standard names: "eastward_wind", "sea_water_x_velocity_at_u_location". The first
 * word that denotes a component counts. */
static bool add_standard(fg__patterns *list, size_t term, const char *name)
{
  const bool other = fg__contains_any(name, OTHERS);
  if (strpbrk(name, " \t") || fg__contains_any(name, NO_VECTORS) ||
      !(other || fg__contains_any(name, VELOCITIES)))
    return true;
  const char *location = strstr(name, "_at_u_location");
  location = location ? location : strstr(name, "_at_v_location");
  const fg__pattern whole = {.term = term,
                             .text = name,
                             .length =
                                 location ? (size_t)(location - name) : strlen(name),
                             .standard = true,
                             .velocity = !other};
  fg__token tokens[FG__MOST_TOKENS];
  const int count = fg__split_name(tokens, name);
  for (int i = 0; i < count && tokens[i].start < whole.length; ++i)
    for (int row = 0; row < WORD_ROWS; ++row) {
      const fg__token core = fg__without_digits(name, tokens[i]);
      const int k = component_of(row, name + core.start, core.length);
      if (WORDS[row].standard && (k == 0 || k == 1))
        return add_hole(list, &whole, k, core, row);
    }
  return true;
}

bool fg__patterns_add(fg__patterns *list, const fg__term *terms, size_t count,
                      size_t which, bool at_points)
{
  const fg__term *term = &terms[which];
  const char *standard = or_empty(term->standard_name), *units = or_empty(term->units);
  fg__unit unit;
  fg__unit_read(&unit, units);
  const bool length = unit.quantity == FG__QUANTITY_LENGTH;
  if ((length && !at_points && !strstr(standard, "displacement")) ||
      (unit.quantity > FG__QUANTITY_LENGTH && unit.quantity != FG__QUANTITY_PRESSURE) ||
      fg__contains_any(standard, NO_VALUES))
    return true;
  const bool is_speed =
      unit.quantity == FG__QUANTITY_SPEED || unit.quantity == FG__QUANTITY_ANGULAR_SPEED;
  const fg__pattern whole = {
      .term = which,
      .text = term->name,
      .length = strlen(term->name),
      .velocity = is_speed || (!units[0] && !fg__contains_any(term->name, OTHERS))};
  return add_standard(list, which, standard) && add_name(list, &whole, terms, count);
}

/* The letter at `*at` of a name with holes, which is advanced; -1 at the end. A hole is
 * one letter below all others, its row's; `exactly`: and whether it begins with a
 * capital. */
static int next_letter(const fg__pattern *p, size_t *at, bool exactly)
{
  const char c = *at < p->length ? p->text[*at] : '\0', small = fg__small(c);
  for (int h = 0; h < p->holes; ++h)
    if (p->hole[h].start == *at) {
      *at += p->hole[h].length;
      return 1 + p->hole[h].words + (exactly && c != small ? WORD_ROWS : 0);
    }
  if (*at >= p->length)
    return -1;
  ++*at;
  return 2 * WORD_ROWS + 1 + (unsigned char)(exactly ? c : small);
}

static int compare_texts(const fg__pattern *a, const fg__pattern *b, bool exactly)
{
  size_t i = 0, j = 0;
  for (;;) {
    const int one = next_letter(a, &i, exactly), other = next_letter(b, &j, exactly);
    if (one != other || one < 0)
      return one - other;
  }
}

bool fg__is_same_pattern(const fg__pattern *a, const fg__pattern *b, bool exactly)
{
  return a->standard == b->standard && compare_texts(a, b, exactly) == 0;
}

int fg__compare_patterns(const void *left, const void *right)
{
  const fg__pattern *a = left, *b = right;
  if (a->standard != b->standard)
    return a->standard ? 1 : -1;
  const int by_text = compare_texts(a, b, false);
  if (by_text != 0)
    return by_text;
  if (a->component != b->component)
    return a->component - b->component;
  return a->term < b->term ? -1 : a->term > b->term;
}

bool fg__is_index(const fg__pattern *pattern)
{
  return pattern->hole[0].words == INDICES;
}

int fg__plainness(const char *first, const char *second)
{
  for (int i = 0; i < (int)(sizeof PLAIN / sizeof *PLAIN); ++i)
    if (second ? fg__is_same(first, PLAIN[i][0]) && fg__is_same(second, PLAIN[i][1])
               : fg__is_same(first, PLAIN[i][0]) || fg__is_same(first, PLAIN[i][1]))
      return i;
  return -1;
}

bool fg__is_upward_velocity(const char *standard_name)
{
  return strncmp(standard_name, "upward_", 7) == 0 && strstr(standard_name, "velocity");
}

bool fg__is_vertical(const fg__term *term)
{
  static const char names[] = "w|wz|uz|vz|wa|wo|wap|omega|omg|dzdt|dpdt|vvel|wvel|velz|"
                              "velw|wwnd|wwind|wcomp|wcomponent|vovecrtz";
  const char *standard = or_empty(term->standard_name);
  fg__token tokens[FG__MOST_TOKENS];
  const int count = fg__split_name(tokens, term->name);
  if (standard[0])
    return fg__is_upward_velocity(standard) ||
           strstr(standard, "tendency_of_air_pressure") ||
           strstr(standard, "expressed_as_tendency_of_pressure");
  for (int n = 0; n < count && n < FG__MOST_TOKENS; ++n) {
    const fg__token core = fg__without_digits(term->name, tokens[n]);
    if (fg__is_one_of(names, term->name + core.start, core.length))
      return true;
  }
  return fg__contains_any(term->name, "vertical|upward") ||
         fg__contains_any(or_empty(term->long_name), "vertical|upward|omega");
}

int fg__component_in_words(const char *words)
{
  bool found[2] = {false, false};
  for (int row = 0; row < WORD_ROWS; ++row)
    for (int k = 0; k < 2 && WORDS[row].inside && WORDS[row].standard; ++k)
      found[k] = found[k] || fg__find_text(words, WORDS[row].word[k]) != NULL;
  return found[0] == found[1] ? -1 : found[1];
}

bool fg__is_positive_backwards(const char *words)
{
  return fg__contains_any(words, "positive west|positive south|positive to the west|"
                                 "positive to the south|positive from ");
}

bool fg__counts_backwards(const char *words)
{
  return fg__is_positive_backwards(words) ||
         (fg__contains_any(words, "westward|southward") &&
          fg__component_in_words(words) < 0);
}

int fg__counts_downward(const char *words)
{
  return (fg__find_text(words, "downward") != NULL) -
         (fg__find_text(words, "upward") != NULL);
}

bool fg__component_of_name(int *out, const char *name)
{
  const fg__term term = {.name = name, .file = -1};
  fg__patterns list = {0};
  const bool memory = fg__patterns_add(&list, &term, 1, 0, true);
  bool found[2] = {false, false};
  for (size_t i = 0; i < list.count; ++i)
    if (list.entry[i].component < 2)
      found[list.entry[i].component] = true;
  *out = found[0] == found[1] ? -1 : found[1];
  free(list.entry);
  return memory;
}
