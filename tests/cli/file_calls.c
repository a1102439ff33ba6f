/* Preloaded into the program by tests: counts its calls that change files, from the first
 * within the folder of the work (MPI has files of its own before), and at one of them
 * lets it be killed, get a signal or the disk be full.
 *
 * FILE_CALLS_AT is the number of the call, from 1; with 0 or none nothing happens. Or it
 * is a name: the first call on a path with that name in it.
 *
 * FILE_CALLS_DO is kill, a signal (INT, TERM, HUP), which is sent once, or full: from
 * that call on nothing can be written.
 *
 * FILE_CALLS_LOG is a file that gets the number of calls when the program ends, and
 * FILE_CALLS_FORKS one that gets the number of child processes.
 *
 * FILE_CALLS_SHORTEN, "NAME BYTES": a file with that name in its path is cut to these
 * bytes as soon as it is mapped into memory. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static atomic_long calls, forks;

static void find_path(char name[4096], int file)
{
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  ssize_t length = readlink(link, name, 4095);
  name[length > 0 ? length : 0] = '\0';
}

static int is_of_the_run(const char *path, int file)
{
  char name[4096];
  if (!path)
    find_path(name, file);
  return strstr(path ? path : name, ".flowgrain") != NULL;
}

static int is_due(long number, const char *path)
{
  static atomic_int named;
  const char *at = getenv("FILE_CALLS_AT");
  if (!at || !*at)
    return 0;
  if (strspn(at, "0123456789") == strlen(at))
    return atol(at) > 0 && number >= atol(at);
  if (path && strstr(path, at))
    named = 1;
  return named;
}

static void send_once(int signal_number)
{
  static atomic_flag sent = ATOMIC_FLAG_INIT;
  if (!atomic_flag_test_and_set(&sent))
    kill(getpid(), signal_number);
}

/* True when the call, with a path or a file, has to fail, for want of space. */
static int comes(const char *path, int file, int takes_space)
{
  static const struct {
    const char *name;
    int number;
  } signals[] = {{"kill", SIGKILL}, {"INT", SIGINT}, {"TERM", SIGTERM}, {"HUP", SIGHUP}};
  if (!calls && !is_of_the_run(path, file))
    return 0;
  const char *what = getenv("FILE_CALLS_DO");
  if (!is_due(++calls, path) || !what)
    return 0;
  for (size_t k = 0; k < sizeof signals / sizeof *signals; ++k)
    if (strcmp(what, signals[k].name) == 0)
      send_once(signals[k].number);
  if (!takes_space || strcmp(what, "full") != 0)
    return 0;
  errno = ENOSPC;
  return 1;
}

static void write_log(const char *name, long count)
{
  const char *log = getenv(name);
  FILE *stream = log ? fopen(log, "w") : NULL;
  if (!stream)
    return;
  fprintf(stream, "%ld\n", count);
  fclose(stream);
}

__attribute__((destructor)) static void log_calls(void)
{
  write_log("FILE_CALLS_LOG", calls);
  write_log("FILE_CALLS_FORKS", forks);
}

/* Sets a function's pointer to what the program would have called. */
static void find(void *next, const char *name)
{
  void *found = dlsym(RTLD_NEXT, name);
  memcpy(next, &found, sizeof found);
}

pid_t fork(void)
{
  pid_t (*next)(void);
  find(&next, "fork");
  ++forks;
  return next();
}

static void shorten(int file)
{
  char path[4096], name[256];
  long bytes;
  const char *what = getenv("FILE_CALLS_SHORTEN");
  if (!what || file < 0 || sscanf(what, "%255s %ld", name, &bytes) != 2)
    return;
  find_path(path, file);
  if (strstr(path, name) && truncate(path, bytes) != 0)
    abort();
}

void *mmap(void *at, size_t size, int protection, int flags, int file, off_t offset)
{
  void *(*next)(void *, size_t, int, int, int, off_t);
  find(&next, "mmap");
  void *made = next(at, size, protection, flags, file, offset);
  shorten(file);
  return made;
}

int rename(const char *from, const char *to)
{
  int (*next)(const char *, const char *);
  find(&next, "rename");
  return comes(to, -1, 0) ? -1 : next(from, to);
}

int link(const char *from, const char *to)
{
  int (*next)(const char *, const char *);
  find(&next, "link");
  return comes(to, -1, 1) ? -1 : next(from, to);
}

int unlink(const char *path)
{
  int (*next)(const char *);
  find(&next, "unlink");
  return comes(path, -1, 0) ? -1 : next(path);
}

int mkdir(const char *path, mode_t mode)
{
  int (*next)(const char *, mode_t);
  find(&next, "mkdir");
  return comes(path, -1, 1) ? -1 : next(path, mode);
}

int rmdir(const char *path)
{
  int (*next)(const char *);
  find(&next, "rmdir");
  return comes(path, -1, 0) ? -1 : next(path);
}

int fsync(int file)
{
  int (*next)(int);
  find(&next, "fsync");
  return comes(NULL, file, 0) ? -1 : next(file);
}

ssize_t pwrite(int file, const void *from, size_t count, off_t at)
{
  ssize_t (*next)(int, const void *, size_t, off_t);
  find(&next, "pwrite");
  return comes(NULL, file, 1) ? -1 : next(file, from, count, at);
}
