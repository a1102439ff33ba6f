/* Checks combinations of one command's options. */
#ifndef OPTION_CHECK_H
#define OPTION_CHECK_H

#include "option/table.h"

/* False after a usage error was printed. */
bool options_check(const any_settings *settings, const cli_command *command);

#endif
