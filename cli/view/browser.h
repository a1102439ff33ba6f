/* The browser that an address is opened in. */
#ifndef VIEW_BROWSER_H
#define VIEW_BROWSER_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts $BROWSER, else xdg-open, with the address. Returns its process; -1: none. */
pid_t browser_start(const char *address);

/* Whether that has ended without opening anything; *process becomes -1 with its end. */
bool browser_failed(pid_t *process);

#endif
