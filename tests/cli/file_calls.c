/* Preloaded into the program by tests: counts its calls that change files, from the first
 * within the folder of the work (MPI has files of its own before), and at one of them
 * lets it be killed or the disk be full.
 *
 * FILE_CALLS_AT   the number of the call, from 1; 0 or none: nothing happens
 * FILE_CALLS_DO   kill, or full: from that call on nothing can be written
 * FILE_CALLS_LOG  file that gets the number of calls when the program ends */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static atomic_long calls;

/* True when the call has to fail, for want of space. */
static int comes(const char *path, int takes_space)
{
  if (!calls && (!path || !strstr(path, ".flowgrain")))
    return 0;
  long number = ++calls;
  const char *at = getenv("FILE_CALLS_AT"), *what = getenv("FILE_CALLS_DO");
  if (!at || !what || atol(at) < 1 || number < atol(at))
    return 0;
  if (strcmp(what, "kill") == 0)
    kill(getpid(), SIGKILL);
  if (!takes_space || strcmp(what, "full") != 0)
    return 0;
  errno = ENOSPC;
  return 1;
}

__attribute__((destructor)) static void log_calls(void)
{
  const char *log = getenv("FILE_CALLS_LOG");
  FILE *stream = log ? fopen(log, "w") : NULL;
  if (!stream)
    return;
  fprintf(stream, "%ld\n", (long)calls);
  fclose(stream);
}

#define CALL(result, name, path, space, parameters, arguments)                           \
  __attribute__((visibility("default"))) result name parameters;                         \
  result name parameters                                                                 \
  {                                                                                      \
    result(*next) parameters;                                                            \
    void *found = dlsym(RTLD_NEXT, #name);                                               \
    memcpy(&next, &found, sizeof next);                                                  \
    return comes(path, space) ? -1 : next arguments;                                     \
  }

CALL(int, rename, to, 0, (const char *from, const char *to), (from, to))
CALL(int, link, to, 1, (const char *from, const char *to), (from, to))
CALL(int, unlink, path, 0, (const char *path), (path))
CALL(int, mkdir, path, 1, (const char *path, mode_t mode), (path, mode))
CALL(int, rmdir, path, 0, (const char *path), (path))
CALL(int, fsync, NULL, 0, (int file), (file))
CALL(ssize_t, pwrite, NULL, 1, (int file, const void *from, size_t count, off_t at),
     (file, from, count, at))
