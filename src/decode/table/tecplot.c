/* Tecplot's text files with zones: ordered points and finite elements, packed by points
 * or by variables (Tecplot 360 Data Format Guide, chapter 4). */
#include "decode/table/tecplot.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "file/number_text.h"
#include "terms/text.h"

enum { MOST_ZONES = 4096 };

static fg_status fail(const fg__tecplot *r, const char *what, const char *word)
{
  return fg__fail(r->context, FG_STATUS_FILE_FORMAT, "%s: line %d: %s%.60s", r->path,
                  r->text.line + 1, what, word);
}

/* Skips what parts words, and comments. */
static void skip(fg__table_cursor *t)
{
  while (t->at < t->size) {
    const char c = t->text[t->at];
    if (c == '#')
      while (t->at < t->size && t->text[t->at] != '\n')
        ++t->at;
    else if (c != ' ' && c != '\t' && c != ',' && c != '\r' && c != '\n')
      return;
    else
      t->line += t->text[t->at++] == '\n';
  }
}

/* The next word, a text in quotes or a list in brackets, without these; "" at the end. */
static void next_word(fg__table_cursor *t, char out[FG__TECPLOT_WORD])
{
  size_t n = 0;
  skip(t);
  const char first = t->at < t->size ? t->text[t->at] : ' ';
  const char end = first == '"' ? '"' : first == '(' ? ')' : '\0';
  int depth = first == '(';
  t->at += end != '\0';
  for (; t->at < t->size; ++t->at) {
    const char c = t->text[t->at];
    depth += end == ')' ? (c == '(') - (c == ')') : 0;
    if (end ? c == end && depth == 0 : strchr(" \t,=\r\n", c) != NULL)
      break;
    t->line += c == '\n';
    if (n + 1 < FG__TECPLOT_WORD)
      out[n++] = c;
  }
  out[n] = '\0';
  t->at += end != '\0' && t->at < t->size;
}

/* Whether a = is next, which is passed over. */
static bool take_equals(fg__table_cursor *t)
{
  size_t at = t->at;
  while (at < t->size && strchr(" \t\r\n", t->text[at]))
    ++at;
  if (at == t->size || t->text[at] != '=')
    return false;
  for (; t->at <= at; ++t->at)
    t->line += t->text[t->at] == '\n';
  return true;
}

static bool begins_number(const fg__table_cursor *t)
{
  return t->at < t->size && strchr("+-.0123456789", t->text[t->at]) != NULL;
}

/* The names behind VARIABLES =, up to the next word before a =, ZONE or DATASETAUXDATA;
 * returns how many. */
static int read_variables(fg__table_column *out, int most, fg__table_cursor *text)
{
  for (int count = 0;; ++count) {
    skip(text);
    const fg__table_cursor before = *text;
    const bool quoted = before.at < before.size && before.text[before.at] == '"';
    char name[FG__TECPLOT_WORD];
    next_word(text, name);
    fg__table_cursor behind = *text;
    if (!quoted && (!name[0] || fg__is_same(name, "zone") ||
                    fg__is_same(name, "datasetauxdata") || take_equals(&behind))) {
      *text = before;
      return count;
    }
    if (count < most)
      fg__table_name(&out[count], name, strlen(name));
  }
}

int fg__tecplot_header(fg__table_column *out, int most, fg__table_cursor text)
{
  static const char word[] = "variables";
  for (; text.at + sizeof word <= text.size; ++text.at) {
    fg__table_cursor behind = text;
    behind.at += sizeof word - 1;
    if (fg__is_word(text.text + text.at, sizeof word - 1, word))
      return take_equals(&behind) ? read_variables(out, most, &behind) : -1;
  }
  return -1;
}

static const struct {
  const char *name;
  int corners;
} CELLS[] = {{"triangle", 3}, {"quadrilateral", 4}, {"tetrahedron", 4}, {"brick", 8}};

static fg_status set_cells(const fg__tecplot *r, fg__zone *z, const char *word)
{
  const char *name = fg__starts_with(word, "fe") ? word + 2 : word;
  for (size_t i = 0; i < sizeof CELLS / sizeof *CELLS; ++i)
    if (fg__is_same(name, CELLS[i].name)) {
      z->corners = CELLS[i].corners;
      return FG_STATUS_OK;
    }
  if (fg__is_same(word, "ordered"))
    return FG_STATUS_OK;
  return fg__fail(r->context, FG_STATUS_UNSUPPORTED,
                  "%s: line %d: a Tecplot zone of %.40s; triangles, quadrilaterals, "
                  "tetrahedra, bricks and ordered points can be read",
                  r->path, r->text.line + 1, word);
}

/* The variables of a list ([4-6]=CELLCENTERED, 7=NODAL) that are so. */
static void set_centred(fg__zone *z, const char *list)
{
  const char *end = fg__find_text(list, "cellcentered"), *open = list;
  for (const char *c = list; end && c < end; ++c)
    open = *c == '(' || *c == '[' ? c + 1 : open;
  if (end)
    snprintf(z->centred, sizeof z->centred, "%.*s", (int)(end - open), open);
}

bool fg__zone_is_centred(const fg__zone *z, int variable)
{
  for (const char *at = z->centred; *at;) {
    char *end;
    const long first = strtol(at, &end, 10);
    const long last = end > at && *end == '-' ? strtol(end + 1, &end, 10) : first;
    if (end > at && variable + 1 >= first && variable + 1 <= last)
      return true;
    at = end > at ? end : at + 1;
  }
  return false;
}

static fg_status set_keyword(const fg__tecplot *r, fg__zone *z, const char *key,
                             const char *value)
{
  static const char *const sizes[] = {"i", "j", "k"}, *const unread[] = {
                                                          "VARSHARELIST",
                                                          "connectivitysharezone",
                                                          "passivevarlist", "facenodes"};
  for (int k = 0; k < 3; ++k)
    if (fg__is_same(key, sizes[k]))
      z->size[k] = strtoul(value, NULL, 10);
  for (size_t i = 0; i < sizeof unread / sizeof *unread; ++i)
    if (fg__is_same(key, unread[i]))
      return fg__fail(r->context, FG_STATUS_UNSUPPORTED,
                      "%s: line %d: a Tecplot zone with %s, which cannot be read",
                      r->path, r->text.line + 1, unread[i]);
  if (fg__is_same(key, "n") || fg__is_same(key, "nodes"))
    z->points = strtoul(value, NULL, 10);
  else if (fg__is_same(key, "e") || fg__is_same(key, "elements"))
    z->cells = strtoul(value, NULL, 10);
  else if (fg__is_same(key, "solutiontime"))
    z->time = strtod(value, NULL);
  else if (fg__is_same(key, "varlocation"))
    set_centred(z, value);
  else if (fg__is_same(key, "f") || fg__is_same(key, "datapacking"))
    z->block = fg__find_text(value, "block") != NULL;
  else if (fg__is_same(key, "et") || fg__is_same(key, "zonetype"))
    return set_cells(r, z, value);
  return FG_STATUS_OK;
}

static fg_status read_header(fg__tecplot *r, fg__zone *z)
{
  fg_status status = FG_STATUS_OK;
  *z = (fg__zone){.size = {1, 1, 1}, .time = (double)NAN, .line = r->text.line + 1};
  for (skip(&r->text); status == FG_STATUS_OK && !begins_number(&r->text);
       skip(&r->text)) {
    char key[FG__TECPLOT_WORD], value[FG__TECPLOT_WORD];
    next_word(&r->text, key);
    if (fg__is_same(key, "auxdata"))
      next_word(&r->text, key);
    if (!key[0] || !take_equals(&r->text))
      return fail(r, "is no keyword of a zone: ", key);
    next_word(&r->text, value);
    status = set_keyword(r, z, key, value);
  }
  const double samples = (double)z->size[0] * (double)z->size[1] * (double)z->size[2];
  if (z->corners == 0 && samples <= (double)r->text.size) {
    z->points = z->size[0] * z->size[1] * z->size[2];
    z->cells = z->size[2] == 1 ? (z->size[0] - 1) * (z->size[1] - 1) : 0;
  }
  const size_t most = r->text.size;
  if (status == FG_STATUS_OK && (z->points == 0 || z->points > most || z->cells > most))
    return fail(r, "a zone of more points than the file can hold, or of none", "");
  return status;
}

/* The next number, "1.5", or one of several, "3*1.5". */
static fg_status next_number(fg__tecplot *r, double *out, size_t *times)
{
  char word[FG__TECPLOT_WORD], *number = word;
  if (*times > 0) {
    --*times;
    return FG_STATUS_OK;
  }
  next_word(&r->text, word);
  char *star = strchr(word, '*');
  if (star) {
    *times = strtoul(word, NULL, 10);
    *times -= *times > 0;
    number = star + 1;
  }
  const fg__table_field field = {number, strlen(number)};
  return fg__table_number(out, &field, '.') == FG__TABLE_NO_NUMBER || !number[0]
             ? fail(r, "is no number: ", word)
             : FG_STATUS_OK;
}

static fg_status read_values(fg__tecplot *r, fg__zone *z)
{
  double number = 0.0;
  size_t times = 0;
  fg_status status = fg__check_memory(
      r->context, r->path, (double)(z->points + z->cells) * r->variables, sizeof(double));
  if (status == FG_STATUS_OK)
    status = fg__check_stop(r->context);
  if (status != FG_STATUS_OK)
    return status;
  z->value = fg__allocate((size_t)r->variables, sizeof *z->value);
  if (!z->value)
    return fg__fail_memory(r->context, "a zone", (size_t)r->variables * 8);
  for (int v = 0; v < r->variables; ++v) {
    const size_t count = fg__zone_is_centred(z, v) ? z->cells : z->points;
    if (count == 0 || (fg__zone_is_centred(z, v) && !z->block))
      return fail(r, "a zone with a variable at cells that it has not", "");
    z->value[v] = fg__allocate(count, sizeof **z->value);
    if (!z->value[v])
      return fg__fail_memory(r->context, "a zone", count * sizeof **z->value);
    for (size_t n = 0; n < count && z->block && status == FG_STATUS_OK; ++n) {
      status = next_number(r, &number, &times);
      z->value[v][n] = number;
    }
  }
  for (size_t n = 0; n < z->points && !z->block && status == FG_STATUS_OK; ++n)
    for (int v = 0; v < r->variables && status == FG_STATUS_OK; ++v) {
      status = next_number(r, &number, &times);
      z->value[v][n] = number;
    }
  return status;
}

/* Nodes of cells, which an ordered zone in a plane has between its points. */
static fg_status read_cells(fg__tecplot *r, fg__zone *z)
{
  const int corners = z->corners > 0 ? z->corners : FG__TECPLOT_CORNERS;
  double number = 0.0;
  size_t times = 0;
  fg_status status = FG_STATUS_OK;
  z->node = fg__allocate(z->cells * (size_t)corners, sizeof *z->node);
  if (!z->node)
    return fg__fail_memory(r->context, "cells", z->cells * 16);
  for (size_t n = 0; n < z->cells * (size_t)corners && status == FG_STATUS_OK; ++n) {
    const size_t cell = n / FG__TECPLOT_CORNERS, corner = n % FG__TECPLOT_CORNERS,
                 nx = z->size[0];
    if (z->corners > 0)
      status = next_number(r, &number, &times);
    else
      number = (double)(1 + cell % (nx - 1) + (corner == 1 || corner == 2) +
                        nx * (cell / (nx - 1) + (corner > 1)));
    if (status == FG_STATUS_OK && !(number >= 1.0 && number <= (double)z->points))
      status = fail(r, "a cell with a corner that is no node", "");
    if (status == FG_STATUS_OK)
      z->node[n] = (int)number;
  }
  return status;
}

static fg_status read_zones(fg__tecplot *r)
{
  fg_status status = FG_STATUS_OK;
  char word[FG__TECPLOT_WORD];
  for (next_word(&r->text, word); word[0] && status == FG_STATUS_OK;
       next_word(&r->text, word)) {
    if (fg__is_same(word, "variables") && r->variables == 0) {
      take_equals(&r->text);
      const int count = read_variables(r->column, FG__TECPLOT_VARIABLES, &r->text);
      r->variables = count < FG__TECPLOT_VARIABLES ? count : FG__TECPLOT_VARIABLES;
    } else if (fg__is_same(word, "zone")) {
      void *zones = r->zone;
      if (r->variables < 2 || r->zones == MOST_ZONES || r->text.size > INT_MAX)
        return fail(r, "a zone too many, or one without variables", "");
      if (!fg__grow(&zones, &r->capacity, r->zones + 1, sizeof *r->zone))
        return fg__fail_memory(r->context, "zones", r->zones * sizeof *r->zone);
      r->zone = zones;
      fg__zone *z = &r->zone[r->zones++];
      status = read_header(r, z);
      if (status == FG_STATUS_OK)
        status = read_values(r, z);
      if (status == FG_STATUS_OK)
        status = read_cells(r, z);
    } else if (take_equals(&r->text)) { /* TITLE and the like */
      next_word(&r->text, word);
    }
  }
  return status == FG_STATUS_OK && r->zones == 0 ? fail(r, "has no zone", "") : status;
}

static void clear(fg__tecplot *r)
{
  for (size_t i = 0; i < r->zones; ++i) {
    for (int v = 0; v < r->variables && r->zone[i].value; ++v)
      free(r->zone[i].value[v]);
    free(r->zone[i].value);
    free(r->zone[i].node);
  }
  free(r->zone);
}

/* Whether a line begins with a word. */
static bool begins(const fg__table_line *line, const char *word)
{
  size_t at = 0;
  while (at < line->size && (line->text[at] == ' ' || line->text[at] == '\t'))
    ++at;
  return line->size - at > strlen(word) &&
         fg__is_word(line->text + at, strlen(word), word) &&
         !fg__is_letter(line->text[at + strlen(word)]);
}

bool fg__has_zones(const fg__source *source)
{
  static const char others[] = "block|fepoint|fetri|fequad|febrick|fetet|fepoly|feline|"
                               "solutiontime";
  fg__table_cursor cursor = fg__table_begin(source);
  fg__table_line line;
  bool variables = false, special = false;
  int zones = 0;
  while (!special && fg__table_next(&line, &cursor) && line.size <= FG__TABLE_LINE) {
    char text[FG__TECPLOT_WORD];
    snprintf(text, sizeof text, "%.*s",
             (int)(line.size < FG__TECPLOT_WORD ? line.size : FG__TECPLOT_WORD - 1),
             line.text);
    if (fg__is_digit(text[strspn(text, " \t-+.")]))
      continue;
    variables = variables || begins(&line, "variables");
    zones += begins(&line, "zone");
    special = zones > 1 || (zones > 0 && fg__contains_any(text, others));
  }
  return variables && special;
}

fg_status fg__tecplot_open(fg__dataset *dataset, fg_context *context,
                           const fg__source *source)
{
  fg__tecplot r = {
      .context = context, .path = source->path, .text = fg__table_begin(source)};
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(context, "a locale", 1);
  fg_status status = read_zones(&r);
  fg__number_locale_end(&locale);
  if (status == FG_STATUS_OK)
    status = fg__zones_add(dataset, source, &r);
  clear(&r);
  return status;
}
