#include "terms/polar.h"

#include "base/angle.h"
#include "terms/coordinates.h"
#include "terms/text.h"
#include "terms/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_BYTES = 128 };

static const double TURN = 360.0 * FG__RADIANS;

/* Words for a speed, and how words for a direction end. */
static const char SPEEDS[] = "speed|spd|vel|velocity|sknt";
static const char *const DIRECTIONS[] = {"direction", "dirn", "dir", "drct"};

static const char *or_empty(const char *text)
{
  return text ? text : "";
}

/* A standard name; "" where it is one of a quality ("wind_speed status_flag"). */
static const char *standard_name(const fg__term *term)
{
  const char *name = or_empty(term->standard_name);
  return strpbrk(name, " \t") ? "" : name;
}

/* The same, or a name that could be one: "wind_from_direction", "wind_speed". */
static const char *name_like_standard(const fg__term *term)
{
  static const char *const ends[] = {"_from_direction", "_to_direction", "_speed"};
  const char *standard = standard_name(term), *name = fg__last_part(term->name);
  const size_t length = strlen(name);
  for (size_t i = 0; i < sizeof ends / sizeof *ends && !standard[0]; ++i)
    if (length > strlen(ends[i]) && strcmp(name + length - strlen(ends[i]), ends[i]) == 0)
      return name;
  return standard;
}

/* Radians in a unit of angles, "degrees", "deg true" or "rad"; 0: it is none. */
static double unit_of(const char *units)
{
  static const char after[] =
      "t|true|from|clockwise|counterclockwise|anticlockwise|counter-clockwise|ccw";
  char word[FG__UNIT_BYTES];
  fg__unit unit;
  const size_t length = strcspn(units, " _."), rest = strspn(units + length, " _.");
  const char *second = units + length + rest;
  snprintf(word, sizeof word, "%.*s", (int)length, units);
  fg__unit_read(&unit, word);
  if (unit.quantity != FG__QUANTITY_DEGREES && unit.quantity != FG__QUANTITY_RADIANS)
    return 0.0;
  return *second && !fg__is_one_of(after, second, strcspn(second, " _")) ? 0.0
                                                                         : unit.factor;
}

/* Where a plain name has a word for a direction, at the end of one of its words; NULL:
 * nowhere. */
static const char *find_direction(const char *plain)
{
  for (size_t i = 0; i < sizeof DIRECTIONS / sizeof *DIRECTIONS; ++i)
    for (const char *at = plain; (at = strstr(at, DIRECTIONS[i])) != NULL; ++at) {
      const char after = at[strlen(DIRECTIONS[i])];
      if (!fg__is_letter(after))
        return at;
    }
  return NULL;
}

/* Whether a term is called as tables call the wind's direction (0) or speed in short,
 * with a height perhaps: "dd", "wd10". */
static bool is_short(const fg__term *term, int k)
{
  static const char *const words[] = {"dd|wd", "ff|ws"};
  return fg__is_one_of(words[k], term->name, strcspn(term->name, "_0123456789"));
}

/* Whether "to" is one of a name's words, as in wind_to_direction. */
static bool has_to(const char *text)
{
  for (const char *at = text; (at = fg__find_text(at, "to")) != NULL; ++at)
    if ((!fg__is_letter(at[2]) && (at == text || !fg__is_letter(at[-1]))) ||
        fg__starts_with(at, "toward"))
      return true;
  return false;
}

/* Whether a text ends with a word. */
static bool ends_with(const char *text, const char *word)
{
  const size_t all = strlen(text), end = strlen(word);
  return all >= end && fg__find_text(text + all - end, word) != NULL;
}

/* The sense by a convention that prose names; 0: none or both. "From" and "toward" alone
 * say where data come from, or which way angles grow. */
static int convention_of(const char *text)
{
  const bool from = fg__contains_any(
      text, "direction from which|from where|from direction|from_direction|(from)|"
            "blows from|blowing from|meteorological convention");
  const bool to = fg__contains_any(
      text, "direction to which|direction toward which|direction towards which|to "
            "where|to direction|(to)|going to|"
            "blows to|blowing to|flows to|flowing to|oceanographic convention|"
            "(oceanographic|downwind");
  return (int)to - (int)from;
}

/* The sense of what moves, by the last word for it before "direction" or, without one,
 * the first behind: wind and waves are known by where they come from, currents and drifts
 * by where they go, and so are stresses and vectors. 0: no such word. */
static int sense_of_mover(const char *text)
{
  static const char *const words[2] = {"wind|wave|swell",
                                       "current|drift|water|stream|transport"};
  const char *direction = fg__find_text(text, "dir");
  int sense = 0;
  if (fg__contains_any(text, "stress|vector"))
    return 1;
  for (const char *at = text; *at && !(sense && direction && at > direction); ++at)
    for (int k = 0; k < 2 && !(sense && !direction); ++k)
      if (fg__starts_with_one_of(words[k], at, strlen(at)))
        sense = k == 0 ? -1 : 1;
  return sense;
}

static int sense_of(const fg__term *term)
{
  const char *standard = standard_name(term), *more = or_empty(term->long_name);
  const char *name = fg__last_part(term->name);
  if (strstr(standard, "from_direction"))
    return -1;
  if (strstr(standard, "to_direction") || strstr(standard, "direction_of_"))
    return 1;
  if (fg__find_text(name, "from") || ends_with(more, " from"))
    return -1;
  if (has_to(name) || ends_with(more, " to") || fg__find_text(more, "toward"))
    return 1;
  const char *const prose[] = {more, or_empty(term->comment)}, *const names[] = {
                                                                   more, standard, name};
  for (int k = 0; k < 2; ++k)
    if (convention_of(prose[k]) != 0)
      return convention_of(prose[k]);
  for (int k = 0; k < 3; ++k)
    if (sense_of_mover(names[k]) != 0)
      return sense_of_mover(names[k]);
  return fg__find_text(name, "drct") || fg__small(name[0]) == 'w' || is_short(term, 0)
             ? -1
             : 1;
}

const char *fg__opposite_sense(const fg__term *direction)
{
  const char *const texts[] = {or_empty(direction->long_name),
                               or_empty(direction->comment)};
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n)
    if (sense_of(direction) * convention_of(texts[n]) < 0)
      return texts[n];
  return NULL;
}

static bool is_from_east(const fg__term *term)
{
  static const char words[] = "from east|from_east|counterclockwise|counter-clockwise|"
                              "anticlockwise|anti-clockwise|ccw|mathematical|"
                              "cartesian convention|0=east|0 = east|x axis|x-axis";
  static const char in_prose[] = "mathematical convention|counterclockwise from|"
                                 "counter-clockwise from|anticlockwise from|"
                                 "anti-clockwise from";
  return fg__contains_any(term->name, words) ||
         fg__contains_any(or_empty(term->long_name), words) ||
         fg__contains_any(or_empty(term->units), words) ||
         fg__contains_any(or_empty(term->comment), in_prose);
}

bool fg__direction_read(fg__polar *out, const fg__term *term)
{
  char plain[NAME_BYTES];
  const char *standard = standard_name(term), *units = or_empty(term->units);
  fg__plain_name(plain, sizeof plain, term->name);
  const bool by_name = find_direction(plain) != NULL;
  *out = (fg__polar){.sense = sense_of(term),
                     .unit = units[0]                       ? unit_of(units)
                             : fg__find_text(plain, "_rad") ? 1.0
                                                            : FG__RADIANS,
                     .from_east = is_from_east(term)};
  if (standard[0])
    return strstr(standard, "direction") != NULL;
  return (by_name || (units[0] && out->unit > 0.0)) &&
         fg__geographic_role(term) == FG__NO_ROLE;
}

/* What moves: "sea_water" of "sea_water_velocity_to_direction", of
 * "direction_of_sea_water_velocity" and of "sea_water_speed"; "": nothing known. */
static void mover_of(char out[NAME_BYTES], const char *standard)
{
  static const char *const ends[] = {"_speed", "_from_direction", "_to_direction"};
  static const char before[] = "direction_of_", after[] = "_velocity";
  const char *start = standard;
  size_t length = 0;
  if (strncmp(start, before, strlen(before)) == 0) {
    start += strlen(before);
    length = strlen(start);
  }
  for (size_t i = 0; i < sizeof ends / sizeof *ends && length == 0; ++i) {
    const size_t all = strlen(start), end = strlen(ends[i]);
    if (all > end && strcmp(start + all - end, ends[i]) == 0)
      length = all - end;
  }
  const size_t cut = strlen(after);
  if (length > cut && strncmp(start + length - cut, after, cut) == 0)
    length -= cut;
  snprintf(out, NAME_BYTES, "%.*s", (int)length, start);
}

/* Whether names have the same digits, as "ws10" and "wd10". */
static bool same_digits(const char *a, const char *b)
{
  for (;; ++a, ++b) {
    a += strcspn(a, "0123456789");
    b += strcspn(b, "0123456789");
    if (*a != *b || !*a)
      return *a == *b;
  }
}

/* The speed of a direction's mover; of several one whose name has the same digits. */
static int speed_by_standard_name(const fg__term *terms, size_t count,
                                  const fg__term *direction)
{
  char mover[NAME_BYTES], other[NAME_BYTES];
  int found = -1;
  mover_of(mover, name_like_standard(direction));
  for (size_t i = 0; mover[0] && i < count; ++i) {
    const char *standard = name_like_standard(&terms[i]);
    mover_of(other, standard);
    if (terms[i].place != direction->place || !strstr(standard, "_speed") ||
        strcmp(mover, other) != 0)
      continue;
    if (same_digits(terms[i].name, direction->name))
      return (int)i;
    found = found < 0 ? (int)i : found;
  }
  return found;
}

/* The length of a plain name without the unit at its end: of "wind_speed_kt". */
static size_t without_unit(const char *name)
{
  const char *last = strrchr(name, '_');
  return last && fg__is_unit_in_name(last + 1) ? (size_t)(last - name) : strlen(name);
}

/* Whether a name is a direction's with a word for a speed in place of its own, which is
 * at `at`, and then `rest`, or a unit where there is no rest. */
static bool is_speed_like(const char *name, const char *direction, const char *at,
                          const char *rest)
{
  const size_t before = (size_t)(at - direction), end = strlen(rest),
               all = end > 0 ? strlen(name) : without_unit(name);
  return all > before + end && strncmp(name, direction, before) == 0 &&
         strncmp(name + all - end, rest, end) == 0 &&
         fg__is_one_of(SPEEDS, name + before, all - before - end);
}

/* Of wind_direction_10m wind_speed_10m, of wind_dir_deg wind_speed. */
static int speed_by_name(const fg__term *terms, size_t count, const fg__term *direction)
{
  char plain[NAME_BYTES], other[NAME_BYTES];
  fg__plain_name(plain, sizeof plain, direction->name);
  const char *at = find_direction(plain);
  for (int part = 0; part < 2 && (at || is_short(direction, 0)); ++part)
    for (size_t i = 0; i < count; ++i) {
      fg__plain_name(other, sizeof other, terms[i].name);
      if (terms[i].place != direction->place || terms[i].group != direction->group)
        continue;
      const char *rest = part || !at ? "" : at + strcspn(at, "_0123456789");
      if (at ? is_speed_like(other, plain, at, rest)
             : is_short(&terms[i], 1) && same_digits(terms[i].name, direction->name))
        return (int)i;
    }
  return -1;
}

int fg__speed_of(fg__polar *out, const fg__term *terms, size_t count, size_t direction)
{
  const fg__term *way = &terms[direction];
  if (!fg__direction_read(out, way) && !is_short(way, 0))
    return -1;
  const int named = standard_name(way)[0] ? -1 : speed_by_name(terms, count, way);
  return named >= 0 ? named : speed_by_standard_name(terms, count, way);
}

int fg__direction_among(fg__polar *out, const fg__term *a, const fg__term *b)
{
  fg__polar of[2];
  const bool way[2] = {
      fg__direction_read(&of[0], a) || (is_short(a, 0) && is_short(b, 1)),
      fg__direction_read(&of[1], b) || (is_short(b, 0) && is_short(a, 1))};
  *out = of[way[1]];
  if (way[0] == way[1])
    *out = (fg__polar){0};
  return way[0] == way[1] ? -1 : way[1];
}

bool fg__names_speed(const char *name)
{
  fg__token tokens[FG__MOST_TOKENS];
  const int count = fg__split_name(tokens, name);
  for (int i = 0; i < count; ++i) {
    const fg__token core = fg__without_digits(name, tokens[i]);
    for (size_t at = 0; at < core.length; ++at)
      if (fg__is_one_of("speed|spd|sknt|gust", name + core.start + at, core.length - at))
        return true;
    if (fg__is_one_of(SPEEDS, name + core.start, core.length))
      return true;
  }
  return false;
}

void fg__polar_turn(double vector[2], const fg__polar *polar)
{
  const double length = vector[0], angle = vector[1] * polar->unit;
  const bool known = length >= 0.0 && fabs(angle) <= 2.0 * TURN;
  const double along = known ? polar->sense * length : (double)NAN;
  vector[0] = along * (polar->from_east ? cos(angle) : sin(angle));
  vector[1] = along * (polar->from_east ? sin(angle) : cos(angle));
}

void fg__angles_add(fg__angles *angles, double angle)
{
  const double rounding = 0.01;
  if (!(fabs(angle) <= 720.0))
    return;
  if (angles->known == 0 || angle < angles->least)
    angles->least = angle;
  if (angles->known == 0 || angle > angles->most)
    angles->most = angle;
  angles->beyond += fabs(angle) > TURN + rounding;
  ++angles->known;
}

/* Radians of which most are beyond a turn, or degrees that just fill a turn of radians.
 */
static bool are_of_other_unit(const fg__angles *a, const fg__polar *polar)
{
  enum { FEWEST = 8 };
  const double rounding = 0.01, begin = a->least < -rounding ? -0.5 * TURN : 0.0;
  if (a->known < FEWEST)
    return false;
  return polar->unit == 1.0
             ? 2 * a->beyond > a->known
             : a->most - a->least > 0.9 * TURN && a->least >= begin - rounding &&
                   a->most <= begin + TURN + rounding;
}

fg_status fg__angles_check(const fg__angles *angles, fg_context *context,
                           const fg__polar *polar, const char *path, const char *name)
{
  const bool radians = polar->unit == 1.0;
  if (!radians && angles->least < -180.0 && angles->most - angles->least > 540.0) {
    fg__fail(
        context, FG_STATUS_ARGUMENT,
        "%s: the direction '%.120s' goes from %g to %g degrees, more than a turn and "
        "a half",
        path, name, angles->least, angles->most);
    fg__hint(context, "--missing VALUE masks a code; two-byte numbers that have grown "
                      "beyond their range need the attribute _Unsigned in the file");
    return FG_STATUS_ARGUMENT;
  }
  if (!are_of_other_unit(angles, polar))
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_ARGUMENT,
           "%s: the direction '%.120s' is in %s, but its numbers, %g to %g, are %s", path,
           name, radians ? "radians" : "degrees", angles->least, angles->most,
           radians ? "degrees" : "radians");
  fg__hint(context, "correct its units in the file");
  return FG_STATUS_ARGUMENT;
}

fg_status fg__polar_turn_all(fg_context *context, float *const vector[2], size_t count,
                             const fg__polar *polar, const char *path, const char *name)
{
  fg__angles angles = {0};
  if (polar->sense == 0)
    return FG_STATUS_OK;
  for (size_t n = 0; n < count; ++n)
    fg__angles_add(&angles, (double)vector[1][n]);
  for (size_t n = 0; n < count; ++n) {
    double one[2] = {(double)vector[0][n], (double)vector[1][n]};
    fg__polar_turn(one, polar);
    vector[0][n] = (float)one[0];
    vector[1][n] = (float)one[1];
  }
  return fg__angles_check(&angles, context, polar, path, name);
}

void fg__direction_rule(char *out, size_t size, const fg__term *term)
{
  const char *standard = standard_name(term);
  snprintf(out, size, "%s %.80s", standard[0] ? "standard_name" : "its name is",
           standard[0] ? standard : fg__last_part(term->name));
}

void fg__polar_words(char *out, size_t size, const fg__polar *polar, const char *rule)
{
  snprintf(out, size, "of a length and its direction %s, in %s %s: %s",
           polar->sense < 0 ? "from where it comes" : "to where it goes",
           polar->unit == 1.0 ? "radians" : "degrees",
           polar->from_east ? "counter-clockwise from east" : "clockwise from north",
           rule);
}
