#include "option/parse.h"

#include <getopt.h>
#include <math.h>
#include <string.h>

#include "build_features.h"
#include "option/check.h"
#include "option/value.h"

/* getopt_long's value for a long option is this plus its index (option_at), larger than
 * any letter. */
enum { LONG_BASE = 256, MAX_OPTIONS = 128 };

enum { TYPED_BYTES = 40 };

/* An option as typed, "-o" or "--output"; `code` is getopt_long's value. */
static const char *typed_name(char out[TYPED_BYTES], const option_entry *option, int code)
{
  if (code >= LONG_BASE)
    snprintf(out, TYPED_BYTES, "--%s", option->name);
  else
    snprintf(out, TYPED_BYTES, "-%c", option->letter);
  return out;
}

/* The short and long options of a command for getopt_long. */
typedef struct getopt_tables {
  struct option longs[MAX_OPTIONS + 1];
  char shorts[2 * MAX_OPTIONS + 2];
} getopt_tables;

static void fill_tables(getopt_tables *tables, const cli_command *command)
{
  memset(tables, 0, sizeof *tables);
  size_t longs = 0, shorts = 0;
  tables->shorts[shorts++] = ':'; /* ':' reports a missing argument */
  const option_entry *option;
  for (size_t k = 0; (option = option_at(k)) && longs < MAX_OPTIONS; ++k) {
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
    return option_at((size_t)(code - LONG_BASE));
  const option_entry *option;
  for (size_t k = 0; (option = option_at(k)); ++k)
    if ((option->commands & command->bit) && option->letter == code)
      break;
  return option;
}

enum { NAME_BYTES = 64, LIST_BYTES = 256 };

/* Lists long options with this prefix, separated by commas; returns their number. */
static int list_begun(char out[LIST_BYTES], const cli_command *command, const char *name)
{
  const option_entry *option;
  int count = 0;
  size_t used = 0;
  out[0] = '\0';
  for (size_t k = 0; (option = option_at(k)); ++k)
    if ((option->commands & command->bit) &&
        strncmp(option->name, name, strlen(name)) == 0 && used < LIST_BYTES)
      used += (size_t)snprintf(out + used, LIST_BYTES - used, "%s--%s",
                               count++ ? ", " : "", option->name);
  return count;
}

/* Prints an error for a long option that is ambiguous or unknown. */
static void complain_of_unknown(const cli_command *command, const char *typed)
{
  char name[NAME_BYTES], begun[LIST_BYTES];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(typed, "=") - 2, typed + 2);
  if (list_begun(begun, command, name) > 1) {
    usage_error(command, "%s: --%s may be %s", command->name, name, begun);
    return;
  }
  const option_entry *option;
  for (size_t k = 0; (option = option_at(k)); ++k)
    if ((option->commands & command->bit) && fg_word_is_near(name, option->name)) {
      usage_error(command, "%s: unknown option %s; is --%s meant?", command->name, typed,
                  option->name);
      return;
    }
  usage_error(command, "%s: unknown option %s", command->name, typed);
}

static const void *at(const any_settings *settings, size_t place)
{
  return (const char *)settings + place;
}

static bool check_operands(any_settings *out, const cli_command *command, int count,
                           char **operands)
{
  if (!command->operand && count)
    return usage_error(command, "%s: takes no operand, and '%s' is one", command->name,
                       operands[0]);
  if (command->operand && !count)
    return usage_error(command, "%s: %s is missing", command->name, command->operand);
  if (command->needs_more && count == 1)
    return usage_error(command, "%s: %s is missing", command->name, command->more);
  if (count > 1 && !command->more)
    return usage_error(command, "%s: one %s is expected, and '%s' is one more",
                       command->name, command->operand, operands[1]);
  for (int k = 0; k < count; ++k)
    if (!*operands[k])
      return usage_error(command, "%s: %s is empty", command->name,
                         k ? command->more : command->operand);
  const char *const *output = at(out, command->output_place);
  if (command->output_place && !*output)
    return usage_error(command, "%s: -o is missing", command->name);
  if (count)
    memcpy((char *)out + command->operand_place, operands, sizeof *operands);
  const operand_list more = {operands + 1, count - 1};
  if (command->more)
    memcpy((char *)out + command->more_place, &more, sizeof more);
  return options_check(out, command);
}

/* A map has two samples for each node of the mesh, which follows from the number of
 * arrows: 18 sqrt(2 N) nodes on a globe. */
static void set_samples(run_settings *run)
{
  enum { DEFAULT_SAMPLES = 768, MOST = 8192 };
  const double arrows = run->arrows.count ? run->arrows.number[0] : 0.0;
  const double nodes = fmax(run->evolution.nodes, 18.0 * sqrt(2.1 * arrows));
  if (2.0 * nodes > DEFAULT_SAMPLES)
    run->reading.map.samples = (int)fmin(2.0 * nodes, MOST);
}

/* Sets the options of reading that follow from others. */
static void set_map(any_settings *out, const cli_command *command)
{
  if (command->bit & RUNS) {
    set_samples(&out->run);
    out->run.reading.map.threads = out->run.work.threads;
  } else if (command->bit == COMMAND_TEXTURE) {
    out->texture.reading.map.threads = out->texture.work.threads;
  }
}

static void set_defaults(any_settings *out, const cli_command *command)
{
  memset(out, 0, sizeof *out);
  if (command->bit == COMMAND_DRAW)
    out->draw.scale_index = -1;
  else if (command->bit == COMMAND_RIVAL)
    out->rival.position_weight = -1.0;
  else if (command->bit & RUNS)
    out->run.checkpoint = 60.0;
}

parse_result options_parse(any_settings *out, const cli_command *command, int argc,
                           char **argv)
{
  getopt_tables tables;
  fill_tables(&tables, command);
  set_defaults(out, command);
  opterr = 0;
  optind = 0; /* restarts getopt */
  for (;;) {
    int code = getopt_long(argc, argv, tables.shorts, tables.longs, NULL);
    if (code == -1)
      break;
    if (code == '?' || code == ':') {
      const option_entry *known = optopt ? find_option(command, optopt) : NULL;
      char typed[TYPED_BYTES];
      if (known && known->argument)
        usage_error(command, "%s: its %s is missing", typed_name(typed, known, optopt),
                    known->argument);
      else if (known)
        usage_error(command, "%s: takes no argument", typed_name(typed, known, optopt));
      else if (optopt)
        usage_error(command, "%s: unknown option -%c", command->name, optopt);
      else
        complain_of_unknown(command, argv[optind - 1]);
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
    char typed[TYPED_BYTES];
    if (!value_set(out, command, option, typed_name(typed, option, code), optarg))
      return PARSE_WRONG;
    if (command->bit == COMMAND_VIEW && !out->view.first_option &&
        !option_is_documented(command, option))
      out->view.first_option = option->name;
  }
  set_map(out, command);
  return check_operands(out, command, argc - optind, argv + optind) ? PARSE_GO
                                                                    : PARSE_WRONG;
}
