#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "build_features.h"
#include "vectors.h"

/* getopt_long's value for a long option is this plus its place in option_table, beyond
 * every letter. */
enum { LONG_BASE = 256, MAX_OPTIONS = 64 };

const char *const format_words[FORMAT_KINDS] = {"svg", "png", "pdf"};

const cli_command *command_find(const char *name)
{
  for (size_t k = 0; k < command_count; ++k)
    if (strcmp(command_table[k].name, name) == 0)
      return &command_table[k];
  return NULL;
}

static bool wrong(const cli_command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool wrong(const cli_command *command, const char *format, ...)
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

static bool set_number(cli_settings *out, const cli_command *command,
                       const option_entry *option, const char *text)
{
  double value;
  bool known = parse_number(&value, text);
  if (!known || value < option->least || value > option->most ||
      (option->open_below && value <= option->least) ||
      (option->open_above && value >= option->most))
    return wrong(command, "--%s %s: a number in %c%g, %g%c is needed", option->name, text,
                 option->open_below ? '(' : '[', option->least, option->most,
                 option->open_above ? ')' : ']');
  memcpy((char *)out + option->place, &value, sizeof value);
  return true;
}

static bool set_whole(cli_settings *out, const cli_command *command,
                      const option_entry *option, const char *text)
{
  intmax_t value;
  if (!parse_whole(&value, text) || value < (intmax_t)option->least ||
      value > (intmax_t)option->most)
    return wrong(command, "--%s %s: a whole number from %.0f to %.0f is needed",
                 option->name, text, option->least, option->most);
  int number = (int)value;
  memcpy((char *)out + option->place, &number, sizeof number);
  return true;
}

static bool set_seed(cli_settings *out, const cli_command *command,
                     const option_entry *option, const char *text)
{
  char *end;
  errno = 0;
  uintmax_t value = strtoumax(text, &end, 10);
  if (!isdigit((unsigned char)text[0]) || *end || errno || value < 1 ||
      value > UINT64_MAX)
    return wrong(command, "--%s %s: a whole number from 1 to %" PRIu64 " is needed",
                 option->name, text, UINT64_MAX);
  uint64_t seed = (uint64_t)value;
  memcpy((char *)out + option->place, &seed, sizeof seed);
  return true;
}

/* "a, b, c", as far as there is room. */
static void list_words(char *text, size_t room, const char *const *words)
{
  text[0] = '\0';
  for (size_t k = 0; words[k]; ++k) {
    size_t used = strlen(text);
    snprintf(text + used, room - used, "%s%s", k ? ", " : "", words[k]);
  }
}

static bool set_choice(cli_settings *out, const cli_command *command,
                       const option_entry *option, const char *text)
{
  for (int k = 0; option->words[k]; ++k)
    if (strcmp(option->words[k], text) == 0) {
      memcpy((char *)out + option->place, &k, sizeof k);
      return true;
    }
  char words[128];
  list_words(words, sizeof words, option->words);
  return wrong(command, "--%s %s: not known; the choice is: %s", option->name, text,
               words);
}

/* The next item of a list with commas, copied to `item`; NULL after the last. */
static const char *next_item(char *item, size_t room, const char *list)
{
  size_t length = strcspn(list, ",");
  snprintf(item, room, "%.*s", length < room ? (int)length : (int)room - 1, list);
  return list[length] ? list + length + 1 : NULL;
}

static bool set_counts(cli_settings *out, const cli_command *command,
                       const option_entry *option, const char *text)
{
  int most = command->bit & (COMMAND_DRAW | COMMAND_TEXTURE | COMMAND_SCORE) ? 1
             : command->bit == COMMAND_BRUSH ? (int)FG_MOST_BRUSH_SCALES
                                             : MAX_SCALES;
  int *list = option->place ? out->arrows : out->clusters;
  int *count = option->place ? &out->arrow_count : &out->cluster_count;
  *count = 0;
  for (const char *rest = text; rest;) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    intmax_t value;
    if (!parse_whole(&value, item) || value < (intmax_t)option->least ||
        value > (intmax_t)option->most)
      return wrong(command, "--%s %s: '%s' is no number of %s from %.0f to %.0f",
                   option->name, text, item, option->name, option->least, option->most);
    if (*count == most)
      return wrong(command, "--%s %s: more than %d number%s", option->name, text, most,
                   most == 1 ? "" : "s");
    if (*count && value >= list[*count - 1])
      return wrong(command, "--%s %s: the numbers must descend, and %s follows %d",
                   option->name, text, item, list[*count - 1]);
    list[(*count)++] = (int)value;
  }
  return true;
}

static bool set_formats(cli_settings *out, const cli_command *command,
                        const option_entry *option, const char *text)
{
  out->formats = 0;
  for (const char *rest = text; rest;) {
    char item[32];
    rest = next_item(item, sizeof item, rest);
    int kind = 0;
    while (kind < FORMAT_KINDS && strcmp(item, format_words[kind]) != 0)
      ++kind;
    if (kind == FORMAT_KINDS)
      return wrong(command, "--%s %s: '%s' is not one of svg, png, pdf", option->name,
                   text, item);
    out->formats |= 1U << kind;
  }
  return true;
}

static bool is_color(const char *text)
{
  return text[0] == '#' && strlen(text) == 7 &&
         strspn(text + 1, "0123456789abcdefABCDEF") == 6;
}

static bool set_palette(cli_settings *out, const cli_command *command,
                        const option_entry *option, const char *text)
{
  const char *const *names = fg_picture_palettes();
  bool known = is_color(text);
  for (size_t k = 0; !known && names[k]; ++k)
    known = strcmp(names[k], text) == 0;
  char words[256];
  list_words(words, sizeof words, names);
  if (!known)
    return wrong(command, "--%s %s: not known; the choice is: %s, or #rrggbb",
                 option->name, text, words);
  memcpy((char *)out + option->place, &text, sizeof text);
  return true;
}

static bool set_view(cli_settings *out, const cli_command *command,
                     const option_entry *option, const char *text)
{
  int most = command->bit == COMMAND_RUN ? MAX_VIEWS : 1;
  char azimuth[32], elevation[32];
  double view[2];
  const char *rest = next_item(azimuth, sizeof azimuth, text);
  if (rest)
    rest = next_item(elevation, sizeof elevation, rest);
  else
    elevation[0] = '\0';
  if (rest || !parse_number(&view[0], azimuth) || !parse_number(&view[1], elevation) ||
      !(fabs(view[0]) <= 360.0) || !(fabs(view[1]) <= 90.0))
    return wrong(command,
                 "--%s %s: AZIMUTH,ELEVATION is needed, in degrees, from -360 to 360 and "
                 "from -90 to 90",
                 option->name, text);
  if (out->view_count == most)
    return wrong(command, "--%s %s: more than %d view%s", option->name, text, most,
                 most == 1 ? "" : "s");
  memcpy(out->views[out->view_count++], view, sizeof view);
  return true;
}

enum { TYPED_BYTES = 40 };

/* An option as it was typed, "-o" or "--output"; `code` is what getopt_long made of it.
 */
static const char *typed_name(char out[TYPED_BYTES], const option_entry *option, int code)
{
  if (code >= LONG_BASE)
    snprintf(out, TYPED_BYTES, "--%s", option->name);
  else
    snprintf(out, TYPED_BYTES, "-%c", option->letter);
  return out;
}

static bool set_option(cli_settings *out, const cli_command *command,
                       const option_entry *option, int code, const char *text)
{
  bool yes = true;
  char typed[TYPED_BYTES];
  switch (option->kind) {
  case OPTION_TEXT:
    if (!*text)
      return wrong(command, "%s: its %s is empty", typed_name(typed, option, code),
                   option->argument);
    memcpy((char *)out + option->place, &text, sizeof text);
    return true;
  case OPTION_FLAG:
    memcpy((char *)out + option->place, &yes, sizeof yes);
    return true;
  case OPTION_WHOLE:
    return set_whole(out, command, option, text);
  case OPTION_SEED:
    return set_seed(out, command, option, text);
  case OPTION_NUMBER:
    return set_number(out, command, option, text);
  case OPTION_CHOICE:
    return set_choice(out, command, option, text);
  case OPTION_COUNTS:
    return set_counts(out, command, option, text);
  case OPTION_FORMATS:
    return set_formats(out, command, option, text);
  case OPTION_PALETTE:
    return set_palette(out, command, option, text);
  case OPTION_VIEW:
    return set_view(out, command, option, text);
  case OPTION_HELP:
  case OPTION_VERSION:
    break;
  }
  return true;
}

/* getopt_long's two descriptions of the options that a command knows. */
typedef struct getopt_tables {
  struct option longs[MAX_OPTIONS + 1];
  char shorts[2 * MAX_OPTIONS + 2];
} getopt_tables;

static void fill_tables(getopt_tables *tables, const cli_command *command)
{
  memset(tables, 0, sizeof *tables);
  size_t longs = 0, shorts = 0;
  tables->shorts[shorts++] = ':'; /* a missing argument is reported as ':' */
  for (size_t k = 0; k < option_count && longs < MAX_OPTIONS; ++k) {
    const option_entry *option = &option_table[k];
    if (!(option->commands & command->bit))
      continue;
    tables->longs[longs].name = option->name;
    tables->longs[longs].has_arg = option->argument ? required_argument : no_argument;
    tables->longs[longs++].val = LONG_BASE + (int)k;
    if (option->letter) {
      tables->shorts[shorts++] = option->letter;
      if (option->argument)
        tables->shorts[shorts++] = ':';
    }
  }
}

static const option_entry *find_option(const cli_command *command, int code)
{
  if (code >= LONG_BASE)
    return &option_table[code - LONG_BASE];
  for (size_t k = 0; k < option_count; ++k)
    if ((option_table[k].commands & command->bit) && option_table[k].letter == code)
      return &option_table[k];
  return NULL;
}

int energy_place(const char *word)
{
  for (int k = 0; word && energy_words[k]; ++k)
    if (strcmp(energy_words[k], word) == 0)
      return k;
  return word ? -1 : 0;
}

/* A word that no file is likely to be called is a wrong one. */
static bool check_energy(const cli_settings *said, const cli_command *command)
{
  if (said->anisotropy > 0.0 && energy_place(said->energy) == FG_ENERGY_ISOTROPIC)
    return wrong(command, "--anisotropy %g: not with --energy isotropic, which has none",
                 said->anisotropy);
  if (said->isotropic_below > 0.0 && energy_place(said->energy) != FG_ENERGY_FLOW)
    return wrong(command, "--isotropic-below %g: only with --energy flow",
                 said->isotropic_below);
  if (energy_place(said->energy) >= 0)
    return true;
  char words[128];
  list_words(words, sizeof words, energy_words);
  bool takes_file = command->bit == COMMAND_RUN;
  if (!takes_file || !strpbrk(said->energy, "./"))
    return wrong(command, "--energy %s: not known; the choice is: %s%s", said->energy,
                 words, takes_file ? ", or a file" : "");
  if (said->anisotropy > 0.0)
    return wrong(command, "--anisotropy %g: that is for --energy to say, %s",
                 said->anisotropy, said->energy);
  return true;
}

/* Arrows are counted, or clusters, or found by their error. */
static bool check_placement(const cli_settings *said, const cli_command *command)
{
  if (command->bit != COMMAND_RUN)
    return true;
  if (said->arrow_count && said->cluster_count)
    return wrong(command,
                 "--arrows and --clusters: say one; --clusters draws an arrow in "
                 "each cluster, however many they are");
  if (said->tolerance > 0.0 && (said->arrow_count || said->cluster_count))
    return wrong(command, "--tolerance %g: finds the number of arrows; not with --%s",
                 said->tolerance, said->arrow_count ? "arrows" : "clusters");
  if (said->no_arrows && (said->arrow_count || said->tolerance > 0.0))
    return wrong(command, "--%s and --no-arrows: say one",
                 said->arrow_count ? "arrows" : "tolerance");
  const char *placed = said->start     ? "start"
                       : said->effort  ? "effort"
                       : said->lengths ? "lengths"
                                       : NULL;
  if (placed && !settings_place(said))
    return wrong(command, "--%s: says nothing with --%s: no arrows are placed", placed,
                 said->cluster_count ? "clusters" : "no-arrows");
  if (settings_place(said) && (said->skeletons || said->centers))
    return wrong(command, "--%s: of clusters; say how many with --clusters",
                 said->skeletons ? "skeletons" : "centers");
  return true;
}

static bool check_operands(cli_settings *out, const cli_command *command, int count,
                           char **operands)
{
  if (!command->operand && count)
    return wrong(command, "%s: takes no operand, and '%s' is one", command->name,
                 operands[0]);
  if (command->operand && !count)
    return wrong(command, "%s: %s is missing", command->name, command->operand);
  if (command->more && count == 1)
    return wrong(command, "%s: %s is missing", command->name, command->more);
  if (count > 1 && !command->more)
    return wrong(command, "%s: one %s is expected, and '%s' is one more", command->name,
                 command->operand, operands[1]);
  for (int k = 0; k < count; ++k)
    if (!*operands[k])
      return wrong(command, "%s: %s is empty", command->name,
                   k ? command->more : command->operand);
  if (command->needs_output && !out->output)
    return wrong(command, "%s: -o is missing", command->name);
  if (out->resume && out->force)
    return wrong(command, "--resume goes on with what --force would replace: say one");
  out->operand = count ? operands[0] : NULL;
  out->files = operands + 1;
  out->file_count = count > 1 ? count - 1 : 0;
  return check_placement(out, command) && check_energy(out, command);
}

parse_result options_parse(cli_settings *out, const cli_command *command, int argc,
                           char **argv)
{
  getopt_tables tables;
  fill_tables(&tables, command);
  memset(out, 0, sizeof *out);
  out->scale_index = -1;
  out->position_weight = -1.0;
  out->checkpoint = 60.0;
  opterr = 0;
  optind = 0; /* the C library's way to start afresh */
  for (;;) {
    int code = getopt_long(argc, argv, tables.shorts, tables.longs, NULL);
    if (code == -1)
      break;
    if (code == '?' || code == ':') {
      const option_entry *known = optopt ? find_option(command, optopt) : NULL;
      char typed[TYPED_BYTES];
      if (known && known->argument)
        wrong(command, "%s: its %s is missing", typed_name(typed, known, optopt),
              known->argument);
      else if (known)
        wrong(command, "%s: takes no argument", typed_name(typed, known, optopt));
      else if (optopt)
        wrong(command, "%s: unknown option -%c", command->name, optopt);
      else
        wrong(command, "%s: unknown option %s", command->name, argv[optind - 1]);
      return PARSE_WRONG;
    }
    const option_entry *option = find_option(command, code);
    if (option->kind == OPTION_HELP) {
      print_command_help(stdout, command);
      return PARSE_DONE;
    }
    if (option->kind == OPTION_VERSION) {
      print_version();
      return PARSE_DONE;
    }
    if (!set_option(out, command, option, code, optarg))
      return PARSE_WRONG;
  }
  return check_operands(out, command, argc - optind, argv + optind) ? PARSE_GO
                                                                    : PARSE_WRONG;
}

fg_read_options settings_reading(const cli_settings *settings)
{
  return (fg_read_options){
      .vars = settings->vars,
      .vars_from = settings->vars_from,
      .time = settings->time,
      .level = settings->level,
      .mask = settings->mask,
      .scale = (fg_scale)settings->scale,
  };
}

bool settings_adapt_mesh(const cli_settings *settings)
{
  return strcmp(mesh_words[settings->mesh], "adaptive") == 0 ||
         (strcmp(mesh_words[settings->mesh], "auto") == 0 && settings->gamma == 0.0);
}

fg_evolution_options settings_evolution(const cli_settings *settings)
{
  return (fg_evolution_options){
      .nodes = settings->nodes,
      .scheme = (fg_scheme)settings->scheme,
      .energy = (fg_energy)(energy_place(settings->energy) < 0
                                ? 0
                                : energy_place(settings->energy)),
      .anisotropy = settings->anisotropy,
      .isotropic_below = settings->isotropic_below,
      .coverage = settings->coverage,
      .gamma = settings->gamma,
      .seed = settings->seed,
      .noise = settings->noise,
      .threads = settings->threads,
      .vectors = vectors_wanted(),
  };
}

bool settings_place(const cli_settings *settings)
{
  return settings->cluster_count == 0 && !settings->no_arrows;
}

fg_placement_options settings_placement(const cli_settings *settings)
{
  return (fg_placement_options){.lengths = (fg_lengths)settings->lengths,
                                .effort = (fg_effort)settings->effort};
}

fg_texture_options settings_texture(const cli_settings *settings)
{
  return (fg_texture_options){
      .kind = (fg_texture_kind)settings->kind,
      .longest = settings->longest,
      .length = settings->length,
      .clusters = settings->cluster_count ? settings->clusters[0] : 0,
      .max_time = settings->max_time,
      .seed = settings->seed,
      .threads = settings->threads,
  };
}

fg_picture_options settings_picture(const cli_settings *settings)
{
  return (fg_picture_options){
      .width = settings->width,
      .palette = settings->palette,
      .no_frame = settings->no_frame,
      .transparent = settings->transparent,
      .tint = settings->tint,
      .skeletons = settings->skeletons,
      .centers = settings->centers,
      .no_arrows = settings->no_arrows,
  };
}

fg_solid_options settings_solid(const cli_settings *settings, int view,
                                const double usual[2])
{
  /* pictures in 3D are 1200 pixels wide where those in 2D are 480 points */
  int pixels = (int)lround(2.5 * settings->width);
  fg_solid_options out = {
      .palette = settings->palette,
      .width = pixels,
      .no_frame = settings->no_frame,
      .transparent = settings->transparent,
  };
  const double *from = view < settings->view_count ? settings->views[view] : usual;
  if (from) {
    out.has_view = true;
    out.azimuth = from[0];
    out.elevation = from[1];
  }
  return out;
}
