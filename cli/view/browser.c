#include "view/browser.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* Starts a session, so that an interrupt from the terminal does not end the user's
 * browser, and detaches standard output, which carries only the address. */
static _Noreturn void become_browser(const char *address)
{
  const char *wanted = getenv("BROWSER");
  setsid();
  dup2(STDERR_FILENO, STDOUT_FILENO);
  signal(SIGXFSZ, SIG_DFL);
  if (wanted && *wanted) /* a command with arguments */
    execlp("sh", "sh", "-c", "exec $BROWSER \"$1\"", "sh", address, (char *)NULL);
  else
    execlp("xdg-open", "xdg-open", address, (char *)NULL);
  _exit(127);
}

pid_t browser_start(const char *address)
{
  pid_t process = fork();
  if (process == 0)
    become_browser(address);
  return process;
}

bool browser_failed(pid_t *process)
{
  int how;
  if (*process <= 0 || waitpid(*process, &how, WNOHANG) != *process)
    return false;
  *process = -1;
  return !WIFEXITED(how) || WEXITSTATUS(how) != 0;
}
