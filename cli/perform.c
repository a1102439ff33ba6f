/* Parses the command line and calls the command. */
#include <stdio.h>
#include <string.h>

#include "build_features.h"
#include "command/command.h"
#include "inputs.h"
#include "option/parse.h"
#include "ranks.h"
#include "vectors.h"

static parse_result usage(void)
{
  advise("Try 'flowgrain --help'.");
  return PARSE_WRONG;
}

static parse_result unknown(const char *word)
{
  for (size_t k = 0; k < command_count; ++k)
    if (fg_word_is_near(word, command_table[k].name)) {
      complain("unknown command '%s'; is '%s' meant?", word, command_table[k].name);
      return usage();
    }
  complain("unknown %s '%s'", word[0] == '-' ? "option" : "command", word);
  return usage();
}

static parse_result help(const char *word)
{
  const cli_command *command = word ? command_find(word) : NULL;
  if (word && !command)
    return unknown(word);
  if (command)
    print_command_help(stdout, command);
  else
    print_program_help(stdout);
  return PARSE_DONE;
}

static parse_result parse(const cli_command **command, any_settings *settings, int argc,
                          char **argv)
{
  if (argc < 2) {
    complain("a command is missing");
    return usage();
  }
  const char *word = argv[1];
  if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
    print_program_help(stdout);
    return PARSE_DONE;
  }
  if (strcmp(word, "help") == 0 && argc > 3) {
    complain("help: one COMMAND is expected, and '%s' is one more", argv[3]);
    return usage();
  }
  if (strcmp(word, "help") == 0)
    return help(argc > 2 ? argv[2] : NULL);
  if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
    print_version();
    return PARSE_DONE;
  }
  *command = command_find(word);
  if (!*command)
    return unknown(word);
  return options_parse(settings, *command, argc - 1, argv + 1);
}

/* Prepares standard input for commands that read fields. `view` does it itself, as its
 * operand may be a folder. */
static int prepare_inputs(const any_settings *settings, const cli_command *command)
{
  if (!(command->bit & INPUTS) || command->bit == COMMAND_VIEW)
    return EXIT_DONE;
  const char *const place = (const char *)settings;
  const char *input = settings->draw.input;
  if (command->bit != COMMAND_DRAW)
    memcpy(&input, place + command->operand_place, sizeof input);
  input_settings given;
  memcpy(&given, place + command->group[GROUP_INPUTS], sizeof given);
  return inputs_prepare(&given, &input, 1, ranks_count());
}

int program_perform(int argc, char **argv)
{
  const cli_command *command = NULL;
  any_settings settings;
  parse_result parsed = parse(&command, &settings, argc, argv);
  int code = ranks_agree(parsed == PARSE_WRONG ? EXIT_USAGE : EXIT_DONE);
  if (code || ranks_any(parsed == PARSE_DONE))
    return code;
  if (!command)
    return EXIT_USAGE;
  code = ranks_agree(vectors_check());
  if (code)
    return code;
  if (command->work != command_run && !ranks_leader())
    return EXIT_DONE; /* a single rank does this command's work */
  code = prepare_inputs(&settings, command);
  if (command->work == command_run)
    code = ranks_agree(code);
  if (code)
    return code;
  return command->work(&settings);
}
