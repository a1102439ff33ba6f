/* Words: which titles are a vector's components, and captions. */
#include "read/grib/grib.h"
#include "terms/dates.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Titles of parameters that ecCodes gives none: discipline, category and number of
 * edition 2 (WMO's code table 4.2). */
static const char *const NUMBERED[][2] = {
    {"0.2.2", "u wind"},       {"0.2.3", "v wind"},     {"0.2.23", "u wind gust"},
    {"0.2.24", "v wind gust"}, {"0.2.41", "u wind 41"}, {"0.2.42", "v wind 41"},
    {"10.1.2", "u current"},   {"10.1.3", "v current"}, {"10.2.4", "u ice drift"},
    {"10.2.5", "v ice drift"}, {"10.0.21", "u stokes"}, {"10.0.22", "v stokes"},
};

static size_t word_length(const char *at)
{
  size_t n = 0;
  while (at[n] && !isspace((unsigned char)at[n]))
    ++n;
  return n;
}

static const char *skip_space(const char *at)
{
  while (isspace((unsigned char)*at))
    ++at;
  return at;
}

fg__term fg__grib_term(const fg__grib_kind *kind)
{
  fg__term term = {.name = skip_space(kind->title), .units = kind->units, .file = -1};
  for (size_t i = 0; !*term.name && i < sizeof NUMBERED / sizeof *NUMBERED; ++i)
    if (strcmp(kind->name, NUMBERED[i][0]) == 0)
      term.name = NUMBERED[i][1];
  return term;
}

void fg__grib_title(const fg__grib_pair *pair, char *out, size_t size)
{
  const char *a = skip_space(pair->kind[0]->title), *b = skip_space(pair->kind[1]->title);
  size_t used = 0;
  out[0] = '\0';
  while (*a && *b) {
    const size_t as = word_length(a), bs = word_length(b);
    const bool shared = as == bs && strncasecmp(a, b, as) == 0 &&
                        strncasecmp(a, "component", 9) != 0 &&
                        (used > 0 || (strncasecmp(a, "of", as) != 0 && *a != '('));
    if (shared && used + as + 2 < size)
      used += (size_t)snprintf(out + used, size - used, "%s%.*s", used ? " " : "",
                               (int)as, a);
    a = skip_space(a + as);
    b = skip_space(b + bs);
  }
  if (used == 0)
    snprintf(out, size, "%s, %s", pair->name[0], pair->name[1]);
}

static size_t write_date(int64_t minutes, char *out, size_t size)
{
  const bool known = fg__date_of_seconds(60.0 * (double)minutes, out, size);
  if (!known)
    out[0] = '\0';
  return strlen(out);
}

/* Forecasts for one time that began at different times say when. */
void fg__grib_time_words(const fg__grib_pair *pair, size_t time, char *out, size_t size)
{
  const fg__grib_date *date = &pair->time[time];
  const bool shared = (time > 0 && date[-1].time == date->time) ||
                      (time + 1 < pair->times && date[1].time == date->time);
  size_t used = write_date(date->time, out, size);
  if (!shared || used + 16 > size)
    return;
  used += (size_t)snprintf(out + used, size - used, " from ");
  write_date(date->started, out + used, size - used);
}

typedef struct level_words {
  const char *type, *before, *units; /* the number between them */
} level_words;

static const level_words LEVELS[] = {
    {"isobaricInhPa", "", "hPa"},
    {"isobaricInPa", "", "Pa"},
    {"heightAboveGround", "height ", "m"},
    {"heightAboveSea", "altitude ", "m"},
    {"depthBelowSea", "depth ", "m"},
    {"depthBelowLand", "depth ", "m"},
    {"theta", "", "K"},
    {"hybrid", "model level ", ""},
    {"generalVertical", "level ", ""},
    {"generalVerticalLayer", "layer ", ""},
};

static const level_words *find_level(const fg__grib_pair *pair)
{
  for (size_t i = 0; i < sizeof LEVELS / sizeof *LEVELS; ++i)
    if (strcmp(pair->kind[0]->level_type, LEVELS[i].type) == 0)
      return &LEVELS[i];
  return NULL;
}

const char *fg__grib_level_units(const fg__grib_pair *pair)
{
  const level_words *known = find_level(pair);
  return known ? known->units : "";
}

void fg__grib_level_words(const fg__grib_pair *pair, double level, char *out, size_t size)
{
  const char *type = pair->kind[0]->level_type;
  const level_words *known = find_level(pair);
  if (known)
    snprintf(out, size, "%s%g%s%s", known->before, level, known->units[0] ? " " : "",
             known->units);
  else if (pair->levels > 1)
    snprintf(out, size, "%s %g", type[0] ? type : "level", level);
  else
    snprintf(out, size, "%s", strcmp(type, "unknown") == 0 ? "" : type);
}
