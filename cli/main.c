#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "options.h"
#include "ranks.h"

/* A standard stream that the caller closed must not become the number of a file we open:
 * a picture would end up with messages in it. Output then fails, and is reported. */
static void hold_standard_streams(void)
{
  for (int stream = 0; stream <= 2; ++stream)
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      int opened = open("/dev/null", stream == 1 ? O_RDONLY : O_RDWR);
      if (opened > stream)
        close(opened);
    }
}

/* A limit on the size of files is then an error like a full disk, not the end. */
static void take_file_limits_as_errors(void)
{
  signal(SIGXFSZ, SIG_IGN);
}

static int finish(int code)
{
  bool failed = fflush(stdout) != 0 || ferror(stdout);
  if (failed && code == EXIT_DONE)
    return complain_of_file("standard output", "cannot be written");
  return code;
}

static parse_result usage(void)
{
  advise("Try 'flowgrain --help'.");
  return PARSE_WRONG;
}

static parse_result parse(const cli_command **command, cli_settings *settings, int argc,
                          char **argv)
{
  if (argc < 2) {
    complain("a command is missing");
    return usage();
  }
  const char *word = argv[1];
  if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
      strcmp(word, "help") == 0) {
    print_program_help(stdout);
    return PARSE_DONE;
  }
  if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
    printf("flowgrain %s\n", fg_version());
    return PARSE_DONE;
  }
  *command = command_find(word);
  if (!*command) {
    complain("unknown %s '%s'", word[0] == '-' ? "option" : "command", word);
    return usage();
  }
  return options_parse(settings, *command, argc - 1, argv + 1);
}

static int work(int argc, char **argv)
{
  const cli_command *command = NULL;
  cli_settings settings;
  parse_result parsed = parse(&command, &settings, argc, argv);
  int code = ranks_agree(parsed == PARSE_WRONG ? EXIT_USAGE : EXIT_DONE);
  if (code || ranks_any(parsed == PARSE_DONE))
    return code;
  if (!command)
    return EXIT_USAGE;
  if (command->work != command_run && !ranks_leader())
    return EXIT_DONE; /* work for one */
  return command->work(&settings);
}

int main(int argc, char **argv)
{
  hold_standard_streams();
  take_file_limits_as_errors();
  int code = ranks_start();
  return finish(code ? code : work(argc, argv));
}
