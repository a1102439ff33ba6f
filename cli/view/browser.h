/* Opens an address in a browser. */
#ifndef VIEW_BROWSER_H
#define VIEW_BROWSER_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts $BROWSER, else xdg-open. Returns its process; -1: none. */
pid_t browser_start(const char *address);

/* Whether that process has failed; *process becomes -1 once it has ended. */
bool browser_failed(pid_t *process);

#endif
