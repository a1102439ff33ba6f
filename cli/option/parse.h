/* Parses a command line into settings. */
#ifndef OPTION_PARSE_H
#define OPTION_PARSE_H

#include "option/table.h"

/* What parsing a command line came to. */
typedef enum parse_result {
  PARSE_GO,    /* perform the command */
  PARSE_DONE,  /* help or version was printed */
  PARSE_WRONG, /* a usage error was printed */
} parse_result;

/* Parses the arguments after the command's name (argv[0] is that name). */
parse_result options_parse(any_settings *out, const cli_command *command, int argc,
                           char **argv);

#endif
