/* Which times or levels a text selects: by index, value, date, range, words, or all. */
#include "base/context.h"
#include "base/decimal.h"
#include "base/memory.h"
#include "terms/dates.h"
#include "terms/text.h"
#include "terms/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Values that differ by less than this share of theirs are the same: files round them to
 * 24 bits. */
static const double same_share = 1e-6;

enum { ITEM_BYTES = 256, UNIT_BYTES = 32, MOST_INDEX_DIGITS = 9 };

typedef enum item_kind {
  ITEM_NONE,
  ITEM_INDEX,
  ITEM_VALUE,
  ITEM_DATE,
  ITEM_WORDS
} item_kind;

/* One end of a range, or an item by itself. */
typedef struct item {
  item_kind kind;
  int index;
  double value;
  char unit[UNIT_BYTES]; /* "": the file's */
  fg__period period;     /* of a date */
  char text[ITEM_BYTES]; /* as typed */
} item;

/* The times or levels that there are. */
typedef struct value_axis {
  fg_context *context;
  const char *what; /* "time", "level" */
  const fg_axis_value *values;
  int count;
} value_axis;

/* A number with a unit, a point or an exponent. */
static bool read_value(item *out, const char *text)
{
  const char *end;
  if (!strchr("+-.0123456789", text[0]))
    return false;
  out->value = fg__number_read(text, &end);
  if (end == text || !isfinite(out->value))
    return false;
  const bool pointed = strcspn(text, ".eE") < (size_t)(end - text);
  const char *unit = end + strspn(end, " ");
  if (!*unit)
    return pointed;
  if (!isalpha((unsigned char)*unit) || strlen(unit) >= UNIT_BYTES ||
      strpbrk(unit, ":/-"))
    return false;
  snprintf(out->unit, sizeof out->unit, "%s", unit);
  return true;
}

static bool read_index(item *out, const char *text)
{
  const size_t digits = strspn(text, "0123456789");
  if (digits == 0 || text[digits] || digits > MOST_INDEX_DIGITS)
    return false;
  out->index = atoi(text);
  return true;
}

/* Text that is no number, date or range. */
static bool are_words(const char *text)
{
  return (isalpha((unsigned char)text[0]) || strchr(text, '_')) && !strpbrk(text, ":/");
}

static bool read_item(item *out, const char *text)
{
  *out = (item){.kind = ITEM_NONE};
  snprintf(out->text, sizeof out->text, "%s", text);
  if (!*text)
    return true;
  if (read_index(out, text))
    out->kind = ITEM_INDEX;
  else if (fg__period_read(&out->period, text))
    out->kind = ITEM_DATE;
  else if (read_value(out, text))
    out->kind = ITEM_VALUE;
  else if (are_words(text))
    out->kind = ITEM_WORDS;
  return out->kind != ITEM_NONE;
}

static bool has_four_digits(const item *w)
{
  return w->kind == ITEM_INDEX && strlen(w->text) == 4;
}

/* Whether two ends make a range; a year may stand beside a date. */
static bool are_alike(const item *a, const item *b)
{
  return !a->kind || !b->kind || a->kind == b->kind ||
         (has_four_digits(a) && b->kind == ITEM_DATE) ||
         (has_four_digits(b) && a->kind == ITEM_DATE);
}

/* Parts "A:B" or "A/B" where both ends can be read and are of one kind; a colon may also
 * be a time of day's. */
static bool read_range(item ends[2], const char *text)
{
  char first[ITEM_BYTES];
  for (const char *at = text; (at = strpbrk(at, ":/")); ++at) {
    snprintf(first, sizeof first, "%.*s", (int)(at - text), text);
    if (read_item(&ends[0], first) && read_item(&ends[1], at + 1) &&
        (ends[0].kind || ends[1].kind) && ends[0].kind != ITEM_WORDS &&
        ends[1].kind != ITEM_WORDS && are_alike(&ends[0], &ends[1]))
      return true;
  }
  return false;
}

/* "0 is 1982-01-16, 11 is 1982-12-16", for messages. */
static const char *describe_values(char *out, size_t room, const value_axis *axis)
{
  const int last = axis->count - 1;
  if (!axis->values)
    snprintf(out, room, "they have no values, only the indices 0 to %d", last);
  else if (last == 0)
    snprintf(out, room, "the only one is %s", axis->values[0].words);
  else
    snprintf(out, room, "0 is %s, %d is %s", axis->values[0].words, last,
             axis->values[last].words);
  return out;
}

static fg_status fail_absent(const value_axis *axis, const char *text, const char *why)
{
  char held[2 * ITEM_BYTES];
  return fg__fail(axis->context, FG_STATUS_UNSUPPORTED, "no %s %s: %s%s", axis->what,
                  text, why, describe_values(held, sizeof held, axis));
}

static fg_status fail_index(const value_axis *axis, const item *w)
{
  char held[2 * ITEM_BYTES];
  fg__fail(axis->context, FG_STATUS_UNSUPPORTED, "%s %d asked for, and there %s %d: %s",
           axis->what, w->index, axis->count == 1 ? "is" : "are", axis->count,
           describe_values(held, sizeof held, axis));
  fg__hint(axis->context,
           "a whole number is an index, from 0; a value has its unit or a "
           "point: %s",
           strcmp(axis->what, "time") == 0 ? "1982-07-16, 2.5" : "850hPa, 850.");
  return FG_STATUS_UNSUPPORTED;
}

/* Value number n in the item's unit, or of a date its seconds; NaN: it has no such value.
 */
static double place_of(const value_axis *axis, const item *w, int n)
{
  fg__period period;
  if (!axis->values)
    return (double)NAN;
  if (w->kind == ITEM_DATE)
    return fg__period_read_start(&period, axis->values[n].words) ? period.seconds
                                                                 : (double)NAN;
  const double factor = fg__unit_factor(w->unit, axis->values[n].units);
  return factor > 0.0 ? axis->values[n].value / factor : (double)NAN;
}

static double own_place(const item *w)
{
  return w->kind == ITEM_DATE ? w->period.seconds : w->value;
}

static double slack_of(const item *w)
{
  return w->kind == ITEM_DATE ? 0.0 : same_share * fabs(w->value);
}

/* Whether value number n is what the item names. */
static bool is_named(const value_axis *axis, const item *w, int n)
{
  fg__period period;
  if (w->kind == ITEM_DATE)
    return axis->values && fg__period_read_start(&period, axis->values[n].words) &&
           period.key >= w->period.key && period.key < w->period.end_key;
  return fabs(place_of(axis, w, n) - own_place(w)) <= slack_of(w);
}

/* The distance of the first or last value, `end`, to the one next to it. */
static double end_spacing(const value_axis *axis, const item *w, double end)
{
  double spacing = HUGE_VAL;
  for (int n = 0; n < axis->count; ++n) {
    const double d = fabs(place_of(axis, w, n) - end);
    if (d > 0.0 && d < spacing)
      spacing = d;
  }
  return isfinite(spacing) ? spacing : 0.0;
}

static fg_status find_nearest(int *index, const value_axis *axis, const item *w)
{
  double least = HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
  const double wanted = own_place(w);
  for (int n = 0; n < axis->count; ++n) {
    const double place = place_of(axis, w, n);
    if (!isfinite(place))
      continue;
    low = fmin(low, place);
    high = fmax(high, place);
    if (fabs(place - wanted) < least) {
      least = fabs(place - wanted);
      *index = n;
    }
  }
  if (!isfinite(least))
    return fail_absent(axis, w->text,
                       w->kind == ITEM_DATE ? "none of them is a date; "
                       : w->unit[0]         ? "none of them is in such a unit; "
                                            : "");
  const double beyond = wanted < low ? low - wanted : wanted > high ? wanted - high : 0.0;
  if (beyond > 0.0 && beyond > end_spacing(axis, w, wanted < low ? low : high))
    return fail_absent(axis, w->text, "");
  return FG_STATUS_OK;
}

/* Spaces and underscores are alike, and small letters and large. */
static int plain_letter(char letter)
{
  return letter == '_' ? ' ' : tolower((unsigned char)letter);
}

/* Whether the text `one` contains `other`. */
static bool has_words(const char *one, const char *other)
{
  const size_t length = strlen(other), all = strlen(one);
  for (size_t at = 0; at + length <= all; ++at) {
    size_t k = 0;
    while (k < length && plain_letter(one[at + k]) == plain_letter(other[k]))
      ++k;
    if (k == length)
      return true;
  }
  return false;
}

/* Chooses the values whose words are the item's text; without any, the only one whose
 * words contain it. */
static bool choose_words(bool *chosen, const value_axis *axis, const item *w)
{
  bool found = false;
  int with_part = 0, index = 0;
  for (int n = 0; n < axis->count && axis->values; ++n) {
    if (!has_words(axis->values[n].words, w->text))
      continue;
    if (strlen(axis->values[n].words) == strlen(w->text))
      found = chosen[n] = true;
    ++with_part;
    index = n;
  }
  if (!found && w->kind == ITEM_WORDS && with_part == 1)
    found = chosen[index] = true;
  return found;
}

/* Where a whole number beyond the last index is a value ("850" of pressures in hPa); -1:
 * nowhere. */
static int index_of_value(const value_axis *axis, int number)
{
  const item w = {.kind = ITEM_VALUE, .value = number};
  for (int n = 0; n < axis->count; ++n)
    if (is_named(axis, &w, n))
      return n;
  return -1;
}

/* Of dates a whole number of four digits is a year where it is beyond the last index or
 * the other end of its range is a year or a date. */
static void take_as_years(item *w, int count, const value_axis *axis)
{
  fg__period ignored;
  bool years = false;
  if (!axis->values || axis->count < 1 ||
      !fg__period_read_start(&ignored, axis->values[0].words))
    return;
  for (int k = 0; k < count; ++k)
    years = years || w[k].kind == ITEM_DATE ||
            (has_four_digits(&w[k]) && w[k].index >= axis->count);
  for (int k = 0; k < count && years; ++k)
    if (has_four_digits(&w[k])) {
      w[k].kind = ITEM_DATE;
      w[k].period = fg__period_of_year(w[k].index);
    }
}

static fg_status choose_one(bool *chosen, bool *nearest, const value_axis *axis,
                            const item *w)
{
  if (w->kind == ITEM_INDEX) {
    const int n = w->index < axis->count ? w->index : index_of_value(axis, w->index);
    if (n < 0)
      return fail_index(axis, w);
    chosen[n] = true;
    return FG_STATUS_OK;
  }
  if (choose_words(chosen, axis, w))
    return FG_STATUS_OK;
  if (w->kind == ITEM_WORDS)
    return fail_absent(axis, w->text, "");
  for (int n = 0; n < axis->count; ++n)
    if (is_named(axis, w, n)) {
      chosen[n] = true;
      return FG_STATUS_OK;
    }
  int index = 0;
  fg_status status = find_nearest(&index, axis, w);
  if (status)
    return status;
  chosen[index] = *nearest = true;
  return FG_STATUS_OK;
}

static bool in_index_range(const item ends[2], int n)
{
  return (!ends[0].kind || n >= ends[0].index) && (!ends[1].kind || n <= ends[1].index);
}

static bool in_date_range(const value_axis *axis, const item ends[2], int n)
{
  fg__period period;
  return axis->values && fg__period_read_start(&period, axis->values[n].words) &&
         (!ends[0].kind || period.key >= ends[0].period.key) &&
         (!ends[1].kind || period.key < ends[1].period.end_key);
}

/* Levels of pressure descend: the ends may stand in either order. */
static bool in_value_range(const value_axis *axis, const item ends[2], int n)
{
  double side[2] = {-HUGE_VAL, HUGE_VAL};
  for (int k = 0; k < 2; ++k)
    if (ends[k].kind)
      side[k] = place_of(axis, &ends[k], n) - ends[k].value;
  if (isnan(side[0]) || isnan(side[1]))
    return false;
  if (!ends[0].kind || !ends[1].kind) {
    const int k = ends[0].kind ? 0 : 1;
    return k == 0 ? side[0] >= -slack_of(&ends[0]) : side[1] <= slack_of(&ends[1]);
  }
  for (int k = 0; k < 2; ++k)
    if (fabs(side[k]) <= slack_of(&ends[k]))
      return true;
  return (side[0] > 0.0) != (side[1] > 0.0);
}

static fg_status choose_range(bool *chosen, const value_axis *axis, const item ends[2],
                              const char *text)
{
  const item_kind kind = ends[0].kind ? ends[0].kind : ends[1].kind;
  for (int k = 0; k < 2 && kind == ITEM_INDEX; ++k)
    if (ends[k].kind && ends[k].index >= axis->count)
      return fail_index(axis, &ends[k]);
  bool found = false;
  for (int n = 0; n < axis->count; ++n) {
    const bool within = kind == ITEM_INDEX  ? in_index_range(ends, n)
                        : kind == ITEM_DATE ? in_date_range(axis, ends, n)
                                            : in_value_range(axis, ends, n);
    chosen[n] = chosen[n] || within;
    found = found || within;
  }
  return found ? FG_STATUS_OK : fail_absent(axis, text, "");
}

static fg_status fail_spelling(const value_axis *axis, const char *text)
{
  return fg__fail(axis->context, FG_STATUS_ARGUMENT,
                  "'%s' is no index, value, date, range or `all`", text);
}

static bool is_descending(const item ends[2])
{
  if (!ends[0].kind || !ends[1].kind)
    return false;
  return ends[0].kind == ITEM_INDEX  ? ends[0].index > ends[1].index
         : ends[0].kind == ITEM_DATE ? ends[0].period.key >= ends[1].period.end_key
                                     : false;
}

static fg_status choose_item(fg_selection *out, bool *chosen, const value_axis *axis,
                             const char *text)
{
  item one, ends[2];
  if (fg__is_same(text, "all")) {
    out->several = true;
    for (int n = 0; n < axis->count; ++n)
      chosen[n] = true;
    return FG_STATUS_OK;
  }
  if (*text && read_item(&one, text)) {
    take_as_years(&one, 1, axis);
    return axis->count ? choose_one(chosen, &out->nearest, axis, &one) : FG_STATUS_OK;
  }
  if (!read_range(ends, text))
    return fail_spelling(axis, text);
  take_as_years(ends, 2, axis);
  if (axis->count && ends[0].kind && ends[1].kind && ends[0].kind != ends[1].kind)
    return fail_spelling(axis, text);
  if (is_descending(ends))
    return fg__fail(axis->context, FG_STATUS_ARGUMENT, "'%s' ends before it begins",
                    text);
  out->several = true;
  return axis->count ? choose_range(chosen, axis, ends, text) : FG_STATUS_OK;
}

static fg_status collect(fg_selection *out, const value_axis *axis, const bool *chosen)
{
  for (int n = 0; n < axis->count; ++n)
    out->count += chosen[n];
  out->index = fg__allocate((size_t)out->count, sizeof *out->index);
  if (!out->index)
    return fg__fail_memory(axis->context, "a selection",
                           (size_t)out->count * sizeof *out->index);
  int *next = out->index;
  for (int n = 0; n < axis->count; ++n)
    if (chosen[n])
      *next++ = n;
  return FG_STATUS_OK;
}

fg_status fg_selection_find(fg_selection *out, fg_context *context, const char *what,
                            const char *text, const fg_axis_value *values, int count)
{
  if (!out || !what || !text || count < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "selection: a NULL argument, or %d values", count);
  *out = (fg_selection){.index = NULL};
  const value_axis axis = {context, what, values, count};
  bool *chosen = fg__allocate((size_t)count, sizeof *chosen);
  if (!chosen)
    return fg__fail_memory(context, "a selection", (size_t)count * sizeof *chosen);
  fg_status status = FG_STATUS_OK;
  out->several = strchr(text, ',') != NULL;
  for (const char *rest = text; rest && !status;) {
    char one[ITEM_BYTES];
    const size_t length = strcspn(rest, ",");
    snprintf(one, sizeof one, "%.*s", (int)(length < ITEM_BYTES ? length : 0), rest);
    status = choose_item(out, chosen, &axis, one);
    rest = rest[length] ? rest + length + 1 : NULL;
  }
  if (!status)
    status = collect(out, &axis, chosen);
  free(chosen);
  return status;
}

void fg_selection_clear(fg_selection *selection)
{
  if (!selection)
    return;
  free(selection->index);
  *selection = (fg_selection){.index = NULL};
}
