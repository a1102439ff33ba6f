#include "option/value.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool usage_error(const cli_command *command, const char *format, ...)
{
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  complain("%s", text);
  advise("Try 'flowgrain %s --help'.", command->name);
  return false;
}

static bool parse_number(double *out, const char *text)
{
  char *end;
  errno = 0;
  *out = strtod(text, &end);
  return end != text && !*end && !isspace((unsigned char)text[0]) && isfinite(*out);
}

static bool parse_whole(intmax_t *out, const char *text)
{
  char *end;
  errno = 0;
  *out = strtoimax(text, &end, 10);
  return end != text && !*end && !isspace((unsigned char)text[0]) && !errno;
}

static bool set_number(void *out, const cli_command *command, const option_entry *option,
                       const char *text)
{
  double value;
  bool known = parse_number(&value, text);
  if (!known || value < option->least || value > option->most ||
      (option->open_below && value <= option->least) ||
      (option->open_above && value >= option->most))
    return usage_error(command, "--%s %s: a number in %c%g, %g%c is needed", option->name,
                       text, option->open_below ? '(' : '[', option->least, option->most,
                       option->open_above ? ')' : ']');
  memcpy(out, &value, sizeof value);
  return true;
}

static bool set_whole(void *out, const cli_command *command, const option_entry *option,
                      const char *text)
{
  intmax_t value;
  if (!parse_whole(&value, text) || value < (intmax_t)option->least ||
      value > (intmax_t)option->most)
    return usage_error(command, "--%s %s: a whole number from %.0f to %.0f is needed",
                       option->name, text, option->least, option->most);
  int number = (int)value;
  memcpy(out, &number, sizeof number);
  return true;
}

static bool set_seed(void *out, const cli_command *command, const option_entry *option,
                     const char *text)
{
  char *end;
  errno = 0;
  uintmax_t value = strtoumax(text, &end, 10);
  if (!isdigit((unsigned char)text[0]) || *end || errno || value < 1 ||
      value > UINT64_MAX)
    return usage_error(command, "--%s %s: a whole number from 1 to %" PRIu64 " is needed",
                       option->name, text, UINT64_MAX);
  uint64_t seed = (uint64_t)value;
  memcpy(out, &seed, sizeof seed);
  return true;
}

void list_words(char *text, size_t size, const char *const *words)
{
  text[0] = '\0';
  for (size_t k = 0; words[k]; ++k) {
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", k ? ", " : "", words[k]);
  }
}

static bool set_choice(void *out, const cli_command *command, const option_entry *option,
                       const char *text)
{
  for (int k = 0; option->words[k]; ++k)
    if (strcmp(option->words[k], text) == 0) {
      memcpy(out, &k, sizeof k);
      return true;
    }
  char words[128];
  list_words(words, sizeof words, option->words);
  return usage_error(command, "--%s %s: not known; the choice is: %s", option->name, text,
                     words);
}

/* Copies the next item of a comma-separated list to `item`; NULL after the last. */
static const char *next_item(char *item, size_t size, const char *list)
{
  size_t length = strcspn(list, ",");
  snprintf(item, size, "%.*s", length < size ? (int)length : (int)size - 1, list);
  return list[length] ? list + length + 1 : NULL;
}

static bool set_numbers(void *out, const cli_command *command, const option_entry *option,
                        const char *text)
{
  number_list numbers = {.count = 0};
  for (const char *rest = text; rest;) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    intmax_t value;
    if (!parse_whole(&value, item) || value < (intmax_t)option->least ||
        value > (intmax_t)option->most)
      return usage_error(command, "--%s %s: '%s' is no number of %s from %.0f to %.0f",
                         option->name, text, item, option->name, option->least,
                         option->most);
    if (numbers.count == (int)command->most_numbers)
      return usage_error(command, "--%s %s: more than %d number%s", option->name, text,
                         numbers.count, numbers.count == 1 ? "" : "s");
    if (numbers.count && value >= numbers.number[numbers.count - 1])
      return usage_error(command, "--%s %s: the numbers must descend, and %s follows %d",
                         option->name, text, item, numbers.number[numbers.count - 1]);
    numbers.number[numbers.count++] = (int)value;
  }
  memcpy(out, &numbers, sizeof numbers);
  return true;
}

static bool set_times(void *out, const cli_command *command, const option_entry *option,
                      const char *text)
{
  time_list times = {.count = 0};
  for (const char *rest = text; rest;) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    double value, last = times.count ? times.time[times.count - 1] : 0.0;
    if (!parse_number(&value, item) || !(value > 0.0))
      return usage_error(command, "--%s %s: '%s' is no time above 0", option->name, text,
                         item);
    if (times.count == MAX_SCALES)
      return usage_error(command, "--%s %s: more than %d times", option->name, text,
                         MAX_SCALES);
    if (value <= last)
      return usage_error(command, "--%s %s: the times must ascend, and %s follows %g",
                         option->name, text, item, last);
    times.time[times.count++] = value;
  }
  memcpy(out, &times, sizeof times);
  return true;
}

static bool set_formats(void *out, const cli_command *command, const option_entry *option,
                        const char *text)
{
  unsigned formats = 0;
  for (const char *rest = text; rest;) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    int kind = 0;
    while (kind < FORMAT_KINDS && strcmp(item, format_words[kind]) != 0)
      ++kind;
    if (kind == FORMAT_KINDS)
      return usage_error(command, "--%s %s: '%s' is not one of svg, png, pdf",
                         option->name, text, item);
    formats |= 1U << kind;
  }
  memcpy(out, &formats, sizeof formats);
  return true;
}

static bool is_color(const char *text)
{
  return text[0] == '#' && strlen(text) == 7 &&
         strspn(text + 1, "0123456789abcdefABCDEF") == 6;
}

static bool set_color(void *out, const cli_command *command, const option_entry *option,
                      const char *text)
{
  if (!is_color(text))
    return usage_error(command, "--%s %s: a colour as #rrggbb is needed", option->name,
                       text);
  memcpy(out, &text, sizeof text);
  return true;
}

/* Only the syntax can be checked before the input is known. */
static bool set_places(void *out, const cli_command *command, const option_entry *option,
                       const char *text)
{
  fg_selection found;
  if (fg_selection_find(&found, NULL, option->name, text, NULL, 0))
    return usage_error(command, "--%s %s: no index, value, date, range or `all`",
                       option->name, text);
  const bool several = found.several;
  fg_selection_clear(&found);
  if (several && command->bit != COMMAND_RUN)
    return usage_error(command, "--%s %s: %s takes one %s", option->name, text,
                       command->name, option->name);
  memcpy(out, &text, sizeof text);
  return true;
}

/* Parses points, or a length with a unit. */
static bool set_length(void *out, const cli_command *command, const option_entry *option,
                       const char *text)
{
  static const struct {
    const char *name;
    double points;
  } units[] = {
      {"", 1.0}, {"pt", 1.0}, {"mm", 72.0 / 25.4}, {"cm", 72.0 / 2.54}, {"in", 72.0}};
  enum { UNITS = sizeof units / sizeof *units };
  char *end;
  const double number = strtod(text, &end);
  size_t k = 0;
  while (k < UNITS && strcmp(end, units[k].name) != 0)
    ++k;
  const double points = k < UNITS ? units[k].points * number : -1.0;
  const bool known = end != text && k < UNITS && !isspace((unsigned char)text[0]);
  if (!known || !(points >= option->least && points <= option->most))
    return usage_error(command,
                       "--%s %s: a length from %g to %g points is needed, as 252, 89mm, "
                       "8.9cm or 3.5in",
                       option->name, text, option->least, option->most);
  memcpy(out, &points, sizeof points);
  return true;
}

/* Parses comma-separated numbers; returns how many, -1 for anything else or more than
 * `most`. */
static int parse_numbers(double *out, int most, const char *text)
{
  int count = 0;
  for (const char *rest = text; rest; ++count) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    if (count == most || !parse_number(&out[count], item))
      return -1;
  }
  return count;
}

static bool set_range(void *out, const cli_command *command, const option_entry *option,
                      const char *text)
{
  double ends[2];
  if (parse_numbers(ends, 2, text) != 2 || ends[0] < option->least ||
      ends[1] > option->most || !(ends[1] > ends[0]))
    return usage_error(command,
                       "--%s %s: two ascending numbers are needed, from %g to %g",
                       option->name, text, option->least, option->most);
  memcpy(out, ends, sizeof ends);
  return true;
}

static bool set_palette(void *out, const cli_command *command, const option_entry *option,
                        const char *text)
{
  const char *const *names = fg_picture_palettes();
  bool known = is_color(text);
  for (size_t k = 0; !known && names[k]; ++k)
    known = strcmp(names[k], text) == 0;
  char words[256];
  list_words(words, sizeof words, names);
  if (!known)
    return usage_error(command, "--%s %s: not known; the choice is: %s, or #rrggbb",
                       option->name, text, words);
  memcpy(out, &text, sizeof text);
  return true;
}

static bool set_view(picture_settings *out, const cli_command *command,
                     const option_entry *option, const char *text)
{
  int most = command->bit == COMMAND_RUN ? MAX_VIEWS : 1;
  double view[2];
  if (parse_numbers(view, 2, text) != 2 || !(fabs(view[0]) <= 360.0) ||
      !(fabs(view[1]) <= 90.0))
    return usage_error(
        command,
        "--%s %s: AZIMUTH,ELEVATION is needed, in degrees, from -360 to 360 and "
        "from -90 to 90",
        option->name, text);
  if (out->view_count == most)
    return usage_error(command, "--%s %s: more than %d view%s", option->name, text, most,
                       most == 1 ? "" : "s");
  memcpy(out->views[out->view_count++], view, sizeof view);
  return true;
}

static bool set_center(fg_map_options *out, const cli_command *command,
                       const option_entry *option, const char *text)
{
  double center[2] = {0.0, 0.0};
  const int count = parse_numbers(center, 2, text);
  if (count < 1 || !(fabs(center[0]) <= 360.0) || !(fabs(center[1]) <= 90.0))
    return usage_error(command,
                       "--%s %s: LON or LON,LAT is needed, in degrees, from -360 to 360 "
                       "and from -90 to 90",
                       option->name, text);
  out->has_center = true;
  out->has_center_latitude = count == 2;
  memcpy(out->center, center, sizeof center);
  return true;
}

/* Whether the numbers bound a part of the globe. */
static bool is_on_globe(const double region[4])
{
  return fabs(region[0]) <= 360.0 && fabs(region[1]) <= 540.0 &&
         region[1] - region[0] <= 360.0 && fabs(region[1] - region[0]) > 0.0 &&
         fabs(region[2]) <= 90.0 && fabs(region[3]) <= 90.0 && region[2] < region[3];
}

/* Of a drawing all fields are on the globe; whether one that is read is, is seen then. */
static bool set_region(fg_map_options *out, const cli_command *command,
                       const option_entry *option, const char *text)
{
  enum { BOUNDS = 6 };
  double region[BOUNDS] = {0.0};
  const int count = parse_numbers(region, BOUNDS, text);
  const bool globe = count == 4 && is_on_globe(region);
  bool ascends = count == 4 || count == BOUNDS;
  for (int k = 0; k < count; k += 2)
    ascends = ascends && region[k] < region[k + 1];
  if (!globe && (!ascends || command->bit == COMMAND_DRAW))
    return usage_error(command,
                       "--%s %s: WEST,EAST,SOUTH,NORTH is needed, in degrees, 360 of "
                       "longitude at most, west apart from east, and south below north%s",
                       option->name, text,
                       command->bit == COMMAND_DRAW
                           ? ""
                           : "; or bounds along other axes, X0,X1,Y0,Y1 or "
                             "X0,X1,Y0,Y1,Z0,Z1, each ascending");
  out->has_region = true;
  out->region_is_box = count == BOUNDS;
  memcpy(out->region, region, sizeof region);
  return true;
}

bool value_set(void *settings, const cli_command *command, const option_entry *option,
               const char *typed, const char *text)
{
  const bool yes = true;
  const char *before;
  void *out = (char *)settings + option_place(command, option);
  switch (option->kind) {
  case OPTION_TEXT:
    if (!*text)
      return usage_error(command, "%s: its %s is empty", typed, option->argument);
    memcpy(&before, out, sizeof before);
    if (option->once && before)
      return usage_error(command, "%s is given twice: name all in one, as %s,%s", typed,
                         before, text);
    memcpy(out, &text, sizeof text);
    return true;
  case OPTION_WORDS:
    memcpy(out, &text, sizeof text);
    return true;
  case OPTION_PLACES:
    return set_places(out, command, option, text);
  case OPTION_FLAG:
    memcpy(out, &yes, sizeof yes);
    return true;
  case OPTION_WHOLE:
    return set_whole(out, command, option, text);
  case OPTION_SEED:
    return set_seed(out, command, option, text);
  case OPTION_NUMBER:
    return set_number(out, command, option, text);
  case OPTION_CHOICE:
    return set_choice(out, command, option, text);
  case OPTION_NUMBERS:
    return set_numbers(out, command, option, text);
  case OPTION_TIMES:
    return set_times(out, command, option, text);
  case OPTION_FORMATS:
    return set_formats(out, command, option, text);
  case OPTION_PALETTE:
    return set_palette(out, command, option, text);
  case OPTION_CENTER:
    return set_center(out, command, option, text);
  case OPTION_REGION:
    return set_region(out, command, option, text);
  case OPTION_COLOR:
    return set_color(out, command, option, text);
  case OPTION_LENGTH:
    return set_length(out, command, option, text);
  case OPTION_RANGE:
    return set_range(out, command, option, text);
  case OPTION_VIEW:
    return set_view(out, command, option, text);
  case OPTION_HELP:
  case OPTION_VERSION:
    break;
  }
  return true;
}

bool value_read_size(double *out, const char *text)
{
  static const char letters[] = "KMGT";
  char *end = NULL;
  *out = strtod(text, &end);
  if (end == text || !isfinite(*out))
    return false;
  const char *letter = *end ? strchr(letters, *end) : NULL;
  if (letter && *end) {
    *out *= pow(1024.0, (double)(letter - letters + 1));
    ++end;
  }
  if (*end == 'B')
    ++end;
  return *end == '\0' && *out >= 1.0 && *out < 9e18;
}
