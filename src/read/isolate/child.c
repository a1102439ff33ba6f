#include "read/isolate/child.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

static void silence(void)
{
  int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0)
    return;
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

/* Bytes of this process's address space; 0: unknown. */
static size_t own_bytes(void)
{
  unsigned long pages = 0;
  FILE *stream = fopen("/proc/self/statm", "r");
  if (!stream)
    return 0;
  int got = fscanf(stream, "%lu", &pages);
  fclose(stream);
  return got == 1 ? pages * (size_t)sysconf(_SC_PAGESIZE) : 0;
}

/* The child's own limits, which bounds only lower. */
static struct rlimit own_time, own_space;

static void lower(int resource, const struct rlimit *own, rlim_t most)
{
  struct rlimit both = *own;
  if (most < both.rlim_cur)
    both.rlim_cur = most;
  setrlimit(resource, &both);
}

void fg__child_bound(unsigned seconds, size_t bytes)
{
  const size_t own = own_bytes();
  const double used = (double)clock() / CLOCKS_PER_SEC;
  lower(RLIMIT_CPU, &own_time, (rlim_t)(used + 0.5) + seconds);
  if (own)
    lower(RLIMIT_AS, &own_space, own + bytes);
}

void fg__child_unbound(void)
{
  lower(RLIMIT_CPU, &own_time, RLIM_INFINITY);
  lower(RLIMIT_AS, &own_space, RLIM_INFINITY);
}

/* Restores default signal handlers, except for signals that this process was started to
 * ignore; that of the bound is never ignored. */
static void reset_signals(void)
{
  const int numbers[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE,
                         SIGILL,  SIGINT, SIGTERM, SIGHUP};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; ++k) {
    struct sigaction before;
    if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
      signal(numbers[k], SIG_DFL);
  }
  signal(SIGXCPU, SIG_DFL);
}

/* Ends the child when its parent is killed. */
static void end_with_parent(pid_t parent)
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (getppid() != parent)
    _exit(0);
}

bool fg__child_start(fg__child *out, void (*serve)(void *data, int socket), void *data)
{
  int ends[2];
  *out = (fg__child){.socket = -1};
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
    return false;
  const pid_t own = getpid(), child = fork();
  if (child == 0) {
    const struct rlimit no_core = {0, 0};
    close(ends[0]);
    end_with_parent(own);
    setrlimit(RLIMIT_CORE, &no_core);
    getrlimit(RLIMIT_CPU, &own_time);
    getrlimit(RLIMIT_AS, &own_space);
    reset_signals();
    silence();
    serve(data, ends[1]);
    _exit(0);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return false;
  }
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  *out = (fg__child){child, ends[0]};
  return true;
}

int fg__child_end(fg__child *child)
{
  int how = 0;
  pid_t ended;
  close(child->socket);
  kill(child->process, SIGKILL);
  do
    ended = waitpid(child->process, &how, 0);
  while (ended < 0 && errno == EINTR);
  *child = (fg__child){.socket = -1};
  return ended > 0 && WIFSIGNALED(how) ? WTERMSIG(how) : 0;
}

struct sigaction fg__child_heed(void)
{
  struct sigaction before, standard = {.sa_handler = SIG_DFL};
  sigemptyset(&standard.sa_mask);
  sigaction(SIGCHLD, &standard, &before);
  return before;
}
