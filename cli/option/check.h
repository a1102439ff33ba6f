/* Options of one command that do not go together. */
#ifndef OPTION_CHECK_H
#define OPTION_CHECK_H

#include "option/table.h"

/* False: a usage error was printed. */
bool options_check(const any_settings *settings, const cli_command *command);

#endif
