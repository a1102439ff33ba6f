/* Words: which titles are a vector's components, and captions. */
#include "read/grib/grib.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Words by which titles of components differ. */
static const char *const DIFFERING[][2] = {
    {"u", "v"},
    {"u-component", "v-component"},
    {"u-comp", "v-comp"},
    {"u-comp.", "v-comp."},
    {"u-velocity", "v-velocity"},
    {"u-wind", "v-wind"},
    {"eastward", "northward"},
    {"east-west", "north-south"},
    {"zonal", "meridional"},
    {"x", "y"},
    {"x-component", "y-component"},
};

static const char *const POLAR[][2] = {{"speed", "direction"}};

/* Parameters without a title: discipline, category and number of edition 2. */
static const char *const NUMBERED[][2] = {
    {"0.2.2", "0.2.3"},   {"0.2.23", "0.2.24"}, {"0.2.41", "0.2.42"},
    {"10.1.2", "10.1.3"}, {"10.2.4", "10.2.5"}, {"10.0.21", "10.0.22"},
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

static bool is_word(const char *at, size_t length, const char *word)
{
  return strlen(word) == length && strncasecmp(at, word, length) == 0;
}

typedef const char *const word_pair[2];

static bool differ_by(word_pair *words, size_t count, const char *u, size_t us,
                      const char *v, size_t vs)
{
  for (size_t i = 0; i < count; ++i)
    if (is_word(u, us, words[i][0]) && is_word(v, vs, words[i][1]))
      return true;
  return false;
}

/* Whether titles are alike but for one of the pairs of words. */
static bool match_titles(const fg__grib_kind *u, const fg__grib_kind *v, word_pair *words,
                         size_t count)
{
  const char *a = skip_space(u->title), *b = skip_space(v->title);
  int differing = 0;
  while (*a && *b) {
    const size_t as = word_length(a), bs = word_length(b);
    if (differ_by(words, count, a, as, b, bs))
      ++differing;
    else if (as != bs || strncasecmp(a, b, as) != 0)
      return false;
    a = skip_space(a + as);
    b = skip_space(b + bs);
  }
  return !*a && !*b && differing == 1;
}

bool fg__grib_match(const fg__grib_kind *u, const fg__grib_kind *v)
{
  const bool untitled = !*skip_space(u->title) && !*skip_space(v->title);
  for (size_t i = 0; untitled && i < sizeof NUMBERED / sizeof *NUMBERED; ++i)
    if (strcmp(u->name, NUMBERED[i][0]) == 0 && strcmp(v->name, NUMBERED[i][1]) == 0)
      return true;
  return match_titles(u, v, DIFFERING, sizeof DIFFERING / sizeof *DIFFERING);
}

bool fg__grib_match_polar(const fg__grib_kind *speed, const fg__grib_kind *direction)
{
  return (strstr(speed->title, "wind") || strstr(speed->title, "Wind")) &&
         match_titles(speed, direction, POLAR, sizeof POLAR / sizeof *POLAR);
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

/* "m s**-1" is m/s as other formats' speeds are. */
void fg__grib_units(const char *units, char *out, size_t size)
{
  snprintf(out, size, "%s", strcmp(units, "m s**-1") == 0 ? "m/s" : units);
}

/* The day of the Gregorian calendar that a number of days after 1970-01-01 is. */
static void date_of(int64_t days, int64_t *year, int *month, int *day)
{
  const int64_t shifted = days + 719468;
  const int64_t era = (shifted >= 0 ? shifted : shifted - 146096) / 146097;
  const int64_t of_era = shifted - era * 146097;
  const int64_t years = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const int64_t of_year = of_era - (365 * years + years / 4 - years / 100);
  const int64_t m = (5 * of_year + 2) / 153;
  *day = (int)(of_year - (153 * m + 2) / 5 + 1);
  *month = (int)(m < 10 ? m + 3 : m - 9);
  *year = years + era * 400 + (*month <= 2);
}

static size_t write_date(int64_t minutes, char *out, size_t size)
{
  int64_t rest = minutes % (24 * 60), year;
  int month, day;
  rest += rest < 0 ? 24 * 60 : 0;
  date_of((minutes - rest) / (24 * 60), &year, &month, &day);
  const int used =
      rest == 0 ? snprintf(out, size, "%04lld-%02d-%02d", (long long)year, month, day)
                : snprintf(out, size, "%04lld-%02d-%02d %02d:%02d", (long long)year,
                           month, day, (int)(rest / 60), (int)(rest % 60));
  return used < 0 ? 0 : (size_t)used;
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
