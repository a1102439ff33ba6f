/* Texts of captions: the vector's title, its time and its level. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/dates.h"
#include "terms/text.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WORDS = 24, WORD_BYTES = 48 };

typedef struct word_list {
  char word[MOST_WORDS][WORD_BYTES];
  int count;
} word_list;

/* Words of a text without bracketed parts; underscores separate words. */
static void split_words(word_list *list, const char *text)
{
  int depth = 0;
  size_t n = 0;
  list->count = 0;
  for (const char *c = text;; ++c) {
    const bool bracket = strchr("([{", *c) && *c;
    const bool parts = *c == '\0' || *c == '_' || isspace((unsigned char)*c) || bracket;
    if (parts && n > 0 && list->count < MOST_WORDS) {
      list->word[list->count++][n] = '\0';
      n = 0;
    }
    if (*c == '\0')
      return;
    depth += bracket;
    if (!parts && depth == 0 && n < WORD_BYTES - 1 && list->count < MOST_WORDS)
      list->word[list->count][n++] = *c;
    depth -= depth > 0 && strchr(")]}", *c);
  }
}

static bool has_word(const word_list *list, const char *word)
{
  for (int i = 0; i < list->count; ++i)
    if (fg__is_same(list->word[i], word))
      return true;
  return false;
}

/* Leaves out the direction in "x-velocity", "u-momentum". */
static void cut_directions(word_list *list)
{
  static const char known[] = "velocity|wind|current|stress|momentum";
  for (int i = 0; i < list->count; ++i) {
    char *word = list->word[i];
    if (!word[0] || !strchr("uvxyUVXY", word[0]) || word[1] != '-')
      continue;
    if (fg__is_one_of(known, word + 2, strlen(word + 2)))
      memmove(word, word + 2, strlen(word + 2) + 1);
  }
}

static bool is_filler(const char *word)
{
  return fg__is_one_of("component|components|comp.|of|the|along|-|,|in|at|to|direction",
                       word, strlen(word));
}

/* Words that say nothing of the vector by themselves. */
static bool is_empty(const char *word)
{
  return !isalpha((unsigned char)word[0]) || !word[1] || is_filler(word) ||
         fg__is_same(word, "momentum");
}

/* "Ocean current along" is "Ocean current", as is "Ocean current:". */
static void cut_fillers_at_end(char *text)
{
  for (char *last; (last = strrchr(text, ' ')) && is_filler(last + 1);)
    *last = '\0';
  for (size_t n = strlen(text); n > 0 && strchr(":,;-", text[n - 1]); --n)
    text[n - 1] = '\0';
}

static bool is_shouted(const char *word)
{
  size_t n = 0;
  for (; word[n]; ++n)
    if (!isupper((unsigned char)word[n]))
      return false;
  return n > 3;
}

/* Joins the words that both components share: "Zonal 10 metre wind" and "Meridional 10
 * metre wind" have "10 metre wind". */
static bool join_shared(const char *of_u, const char *of_v, char *out, size_t size)
{
  word_list u;
  word_list v;
  split_words(&u, of_u);
  split_words(&v, of_v);
  cut_directions(&u);
  cut_directions(&v);
  size_t n = 0;
  bool telling = false;
  out[0] = '\0';
  for (int i = 0; i < u.count; ++i) {
    char *word = u.word[i];
    if (!has_word(&v, word) || (is_filler(word) && n == 0) ||
        fg__starts_with(word, "component"))
      continue;
    if (is_shouted(word))
      for (char *c = word; *c; ++c)
        *c = (char)tolower((unsigned char)*c);
    telling = telling || !is_empty(word);
    const int written = snprintf(out + n, size - n, "%s%s", n > 0 ? " " : "", word);
    if (written < 0 || (size_t)written >= size - n)
      break;
    n += (size_t)written;
  }
  cut_fillers_at_end(out);
  return telling;
}

/* What a standard name tells of the grid. */
static void cut_grid(char *standard_name)
{
  if (strncmp(standard_name, "grid_", 5) == 0)
    memmove(standard_name, standard_name + 5, strlen(standard_name + 5) + 1);
  char *at = strstr(standard_name, "_at_u_location");
  at = at ? at : strstr(standard_name, "_at_v_location");
  if (at)
    *at = '\0';
}

void fg__vector_title(const fg__pair *pair, int components, char *out, size_t size)
{
  static const char *const attribute[] = {"long_name", "description", "standard_name"};
  for (int a = 0; a < 3; ++a) {
    char of_u[FG__TEXT_BYTES];
    char of_v[FG__TEXT_BYTES];
    fg__attribute_text(pair->component[0], attribute[a], of_u, sizeof of_u);
    fg__attribute_text(pair->component[1], attribute[a], of_v, sizeof of_v);
    cut_grid(of_u);
    cut_grid(of_v);
    if (join_shared(of_u, of_v, out, size))
      return;
  }
  if (fg__attribute_text(fg__group_of(pair->component[0]), "title", out, size) ||
      fg__has_no_titles(pair->component[0]))
    return;
  if (components == 3)
    snprintf(out, size, "%.80s, %.80s, %.80s", pair->component[0]->plain_name,
             pair->component[1]->plain_name, pair->component[2]->plain_name);
  else
    snprintf(out, size, "%.120s, %.120s", pair->component[0]->plain_name,
             pair->component[1]->plain_name);
}

static const char *kind_of_height(const fg__variable *coordinate)
{
  static const char *const known[] = {"depth", "altitude", "height"};
  char name[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "standard_name", name, sizeof name);
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strstr(name, known[i]) || strstr(coordinate->plain_name, known[i]))
      return known[i];
  return coordinate->plain_name;
}

/* Whether units say no more than that values are numbers of levels or layers. */
static bool are_none(const char *units)
{
  return fg__is_one_of("|1|level|levels|layer|layers", units, strlen(units));
}

/* What a number stands for, where it is a flag (CF conventions, section 3.5). */
static bool write_flag(const fg__variable *coordinate, double value, char *out,
                       size_t size)
{
  enum { MOST_FLAGS = 16 };
  double flag[MOST_FLAGS];
  char meanings[FG__TEXT_BYTES], *rest = NULL;
  const int count = fg__attribute_numbers(coordinate, "flag_values", flag, MOST_FLAGS);
  fg__attribute_text(coordinate, "flag_meanings", meanings, sizeof meanings);
  char *word = strtok_r(meanings, " ", &rest);
  for (int n = 0; n < count && word; ++n, word = strtok_r(NULL, " ", &rest))
    if (flag[n] == value) {
      snprintf(out, size, "%s", word);
      return true;
    }
  return false;
}

bool fg__write_date(char *out, size_t size, const fg__variable *times, double value)
{
  char units[FG__TEXT_BYTES], calendar[FG__TEXT_BYTES];
  fg__attribute_text(times, "units", units, sizeof units);
  fg__attribute_text(times, "calendar", calendar, sizeof calendar);
  return fg__date_of_number(value, units, calendar, out, size);
}

/* Writes a coordinate's value as text, pressures of the air in hPa. */
static void write_words(const fg__variable *coordinate, double value, char *out,
                        size_t size)
{
  char units[FG__TEXT_BYTES];
  char label[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "units", units, sizeof units);
  const fg__quantity quantity = fg__units_read(units, label, sizeof label);
  if (!fg__is_number(coordinate) && fg__date_of_seconds(value, out, size))
    return; /* a column of dates */
  if (write_flag(coordinate, value, out, size) ||
      (quantity == FG__QUANTITY_DATE && fg__write_date(out, size, coordinate, value)) ||
      fg__duration(value, units, out, size))
    return;
  if (quantity == FG__QUANTITY_PRESSURE && strcmp(label, "Pa") == 0 &&
      fabs(value) >= 100.0) {
    value /= 100.0;
    snprintf(label, sizeof label, "hPa");
  }
  char number[32]; /* all digits of a whole one, as of 19820716 */
  snprintf(number, sizeof number,
           fabs(value) < 1e15 && value == floor(value) ? "%.0f" : "%g", value);
  if (quantity == FG__QUANTITY_PRESSURE)
    snprintf(out, size, "%s %s", number, label);
  else if (quantity == FG__QUANTITY_LENGTH)
    snprintf(out, size, "%s %s %s", kind_of_height(coordinate), number, label);
  else if (fg__starts_with(units, "month"))
    snprintf(out, size, "month %s", number);
  else if (are_none(units))
    snprintf(out, size, "%s %s", coordinate->plain_name, number);
  else
    snprintf(out, size, "%s %s %s", coordinate->plain_name, number, units);
}

/* When the forecasts began whose times these are; NULL: the file does not say. */
static const fg__variable *starts_of(const fg__variable *times)
{
  char name[FG__TEXT_BYTES];
  const fg__dataset *data = times->owner;
  for (size_t i = 0; i < data->variable_count && times->rank == 1; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v != times && v->rank == 1 && v->dimension[0] == times->dimension[0] &&
        fg__attribute_text(v, "standard_name", name, sizeof name) &&
        strcmp(name, "forecast_reference_time") == 0)
      return v;
  }
  return NULL;
}

/* Adds to the words of a time when its forecast began. */
static void add_start(const fg__variable *starts, size_t index, char *words, size_t size)
{
  double value;
  const size_t used = strlen(words);
  if (used + 7 > size || fg__variable_fetch_one(starts, &index, &value) != FG_STATUS_OK)
    return;
  snprintf(words + used, size - used, " from ");
  write_words(starts, value, words + used + 6, size - used - 6);
}

/* Whether a sample beside one has its value: forecasts of one time. */
static bool is_shared(const fg__variable *times, size_t index, double value)
{
  const size_t count = times->owner->dimensions[times->dimension[0]].length;
  double other;
  for (int after = 0; after < 2; ++after) {
    const size_t beside = after ? index + 1 : index - 1;
    if ((after ? beside < count : index > 0) &&
        fg__variable_fetch_one(times, &beside, &other) == FG_STATUS_OK && other == value)
      return true;
  }
  return false;
}

fg_status fg__index_words(const fg__variable *coordinate, const char *name, size_t index,
                          char *out, size_t size)
{
  const bool of_texts = coordinate && !fg__is_number(coordinate);
  if (of_texts) {
    const fg_status status = fg__date_text(out, size, coordinate, index);
    if (status != FG_STATUS_OK || out[0])
      return status;
  }
  if (!coordinate || of_texts) {
    snprintf(out, size, "%.200s %zu", name, index);
    return FG_STATUS_OK;
  }
  double value = 0.0;
  const fg_status status = fg__variable_fetch_one(coordinate, &index, &value);
  if (status != FG_STATUS_OK)
    return status;
  write_words(coordinate, value, out, size);
  const fg__variable *starts = starts_of(coordinate);
  if (starts && is_shared(coordinate, index, value))
    add_start(starts, index, out, size);
  return FG_STATUS_OK;
}

/* One century of hourly values. */
enum { MOST_VALUES = 1000000 };

/* Writes the texts of all values one after the other, behind their units. */
static bool write_texts(char **text, size_t *starts, const fg__variable *coordinate,
                        const double *number, size_t count)
{
  char units[FG__TEXT_BYTES] = "", words[FG__TEXT_BYTES];
  size_t used = 0, capacity = 0;
  const fg__variable *starts_along = starts_of(coordinate);
  if (fg__is_number(coordinate))
    fg__attribute_text(coordinate, "units", units, sizeof units);
  fg__units_read(units, words, sizeof words);
  for (size_t n = 0; n <= count; ++n) {
    const size_t length = strlen(words) + 1;
    if (!fg__grow((void **)text, &capacity, used + length, 1))
      return false;
    memcpy(*text + used, words, length);
    starts[n] = used;
    used += length;
    if (n == count)
      continue;
    write_words(coordinate, number[n], words, sizeof words);
    if (starts_along && ((n > 0 && number[n - 1] == number[n]) ||
                         (n + 1 < count && number[n + 1] == number[n])))
      add_start(starts_along, n, words, sizeof words);
  }
  return true;
}

/* `number` and `starts` have room for all numbers and for the offsets of their texts;
 * `rows`: the numbers, or NULL. */
static fg_status read_axis_values(fg_axis_value *out, char **text, double *number,
                                  size_t *starts, const fg__variable *coordinate,
                                  size_t count, const double *rows)
{
  fg_context *context = coordinate->owner->context;
  const size_t start = 0;
  const fg_status status =
      rows ? FG_STATUS_OK : fg__variable_fetch(coordinate, &start, &count, number);
  if (status != FG_STATUS_OK)
    return status;
  if (rows)
    memcpy(number, rows, count * sizeof *number);
  if (!write_texts(text, starts, coordinate, number, count))
    return fg__fail_memory(context, "an axis' values", count * sizeof *out);
  for (size_t n = 0; n < count; ++n)
    out[n] = (fg_axis_value){number[n], *text, *text + starts[n + 1]};
  return FG_STATUS_OK;
}

static fg_status axis_values(fg_axis_value **out, char **text, const fg__dataset *data,
                             const fg__variable *coordinate, size_t count,
                             const double *rows)
{
  fg_status status = FG_STATUS_OK;
  double *number = fg__allocate(count, sizeof *number);
  size_t *starts = fg__allocate(count + 1, sizeof *starts);
  *out = fg__allocate(count, sizeof **out);
  if (number && starts && *out)
    status = read_axis_values(*out, text, number, starts, coordinate, count, rows);
  else
    status = fg__fail_memory(data->context, "an axis' values", count * sizeof **out);
  if (status != FG_STATUS_OK) {
    free(*out);
    *out = NULL;
  }
  free(starts);
  free(number);
  return status;
}

fg_status fg__grid_axis_values(fg_axis_value **out, char **text, const fg__dataset *data,
                               const fg__variable *coordinate, size_t count)
{
  *out = NULL;
  *text = NULL;
  if (!coordinate || count < 1 || count > MOST_VALUES)
    return FG_STATUS_OK;
  if (!fg__is_number(coordinate))
    return fg__date_values(out, text, coordinate, count);
  if (coordinate->rank > 1)
    return FG_STATUS_OK;
  return axis_values(out, text, data, coordinate, count, NULL);
}

/* The times or levels of a table's rows; NULL: its rows are of one. */
static const fg__row_axis *rows_of(const fg__grid *grid, bool of_time)
{
  const fg__unstructured *mesh = grid->unstructured;
  const fg__row_axis *rows = !mesh     ? NULL
                             : of_time ? &mesh->rows_time
                                       : &mesh->rows_level;
  return rows && rows->value ? rows : NULL;
}

fg_status fg__index_values(fg_axis_value **out, char **text, const fg__dataset *data,
                           const fg__grid *grid, bool of_time)
{
  const fg__row_axis *rows = rows_of(grid, of_time);
  *out = NULL;
  *text = NULL;
  if (!rows)
    return fg__grid_axis_values(out, text, data,
                                of_time ? grid->time_variable : grid->level_variable,
                                of_time ? grid->times : grid->levels);
  return rows->count > MOST_VALUES
             ? FG_STATUS_OK
             : axis_values(out, text, data, rows->variable, rows->count, rows->value);
}

/* The words of the time or level that options choose; "": there is none. */
static fg_status chosen_words(char *out, size_t size, const fg__grid *grid,
                              const fg_read_options *options, bool of_time)
{
  const fg__row_axis *rows = rows_of(grid, of_time);
  const fg__variable *v = of_time ? grid->time_variable : grid->level_variable;
  const size_t index = (size_t)(of_time ? options->time : options->level);
  if (rows && index < rows->count)
    write_words(rows->variable, rows->value[index], out, size);
  else if (!rows && ((of_time ? grid->time : grid->level) >= 0 || v))
    return fg__index_words(v, of_time ? grid->time_name : grid->level_name, index, out,
                           size);
  return FG_STATUS_OK;
}

void fg__velocity_units(char *out, size_t size, const fg__pair *pair)
{
  char text[FG__TEXT_BYTES];
  const bool known = fg__attribute_text(pair->component[0], "units", text, sizeof text);
  if (!known && pair->polar.sense == 0)
    fg__attribute_text(pair->component[1], "units", text, sizeof text);
  if (!text[0])
    snprintf(text, sizeof text, "%s", fg__units_of_name(pair->component[0]->plain_name));
  fg__units_read(text, out, size);
}

fg_status fg__vector_words_find(fg__vector_words *out, const fg__dataset *data,
                                const fg__pair *pair, const fg__grid *grid,
                                const fg_read_options *options)
{
  *out = (fg__vector_words){{0}, {0}, {0}, {0}};
  fg_status status = chosen_words(out->time, sizeof out->time, grid, options, true);
  if (grid->dimension == 2 && status == FG_STATUS_OK)
    status = chosen_words(out->level, sizeof out->level, grid, options, false);
  if (status == FG_STATUS_OK)
    status =
        fg__chosen_words(data, pair->component[0], true, out->time, sizeof out->time);
  if (status == FG_STATUS_OK)
    status =
        fg__chosen_words(data, pair->component[0], false, out->level, sizeof out->level);
  if (status != FG_STATUS_OK)
    return status;
  if (grid->section[0]) {
    const size_t used = strlen(out->level);
    snprintf(out->level + used, sizeof out->level - used, "%s%s", used > 0 ? ", " : "",
             grid->section);
  }
  fg__vector_title(pair, grid->dimension, out->title, sizeof out->title);
  fg__velocity_units(out->units, sizeof out->units, pair);
  return status;
}

fg_field_arrays fg__vector_texts(const fg__vector_words *words, const fg__pair *pair,
                                 const fg__grid *grid)
{
  fg_field_arrays out = {.velocity_units = words->units,
                         .title = words->title,
                         .time = words->time[0] ? words->time : NULL,
                         .level = words->level[0] ? words->level : NULL,
                         .doubts = grid->doubts[0] ? grid->doubts : NULL};
  for (int k = 0; k < grid->dimension; ++k)
    out.velocity_name[k] = fg__component_name(pair, k);
  return out;
}
