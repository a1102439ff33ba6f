#include "rehearse.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Reading a file of gigabytes takes less; a loop in a damaged file takes for ever. */
enum { MOST_SECONDS = 60 };

static void silence(void)
{
  int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0)
    return;
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

static void do_in_child(void (*work)(void *), void *data, unsigned seconds)
{
  struct rlimit no_core = {0, 0}, limit = {seconds, seconds + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &limit);
  const int crashes[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
  for (size_t k = 0; k < sizeof crashes / sizeof crashes[0]; ++k)
    signal(crashes[k], SIG_DFL);
  silence();
  work(data);
  _exit(0);
}

int signal_that_ends(void (*work)(void *), void *data, unsigned seconds)
{
  fflush(stdout);
  pid_t child = fork();
  if (child < 0)
    return 0; /* no process to be had: the reading itself will show */
  if (child == 0)
    do_in_child(work, data, seconds);
  int how = 0;
  while (waitpid(child, &how, 0) < 0)
    ; /* interrupted: wait on */
  return WIFSIGNALED(how) ? WTERMSIG(how) : 0;
}

typedef struct reading {
  const char *input;
  const fg_read_options *options;
  int part, parts;
} reading;

static void read_once(void *data)
{
  const reading *r = data;
  fg_context *context;
  fg_field *field;
  fg_inventory *inventory;
  if (fg_context_create(&context))
    return;
  if (r->options)
    fg_field_read_part(&field, context, r->input, r->options, r->part, r->parts);
  else
    fg_inventory_read(&inventory, context, r->input);
}

static bool is_hdf5(const char *path)
{
  static const char magic[8] = "\211HDF\r\n\032\n";
  char start[sizeof magic];
  struct stat about;
  if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
    return false;
  int file = open(path, O_RDONLY);
  if (file < 0)
    return false;
  ssize_t got = read(file, start, sizeof start);
  close(file);
  return got == (ssize_t)sizeof start && memcmp(start, magic, sizeof magic) == 0;
}

int rehearse_reading(const char *input, const fg_read_options *options)
{
  return rehearse_reading_part(input, options, 0, 1);
}

int rehearse_reading_part(const char *input, const fg_read_options *options, int part,
                          int parts)
{
  bool second = options && options->vars_from && is_hdf5(options->vars_from);
  if (!is_hdf5(input) && !second)
    return EXIT_DONE;
  reading r = {input, options, part, parts};
  int number = signal_that_ends(read_once, &r, MOST_SECONDS);
  if (number == 0 || number == SIGINT || number == SIGTERM)
    return EXIT_DONE;
  complain("%s: damaged: the HDF5 library does not survive reading it (signal %d)", input,
           number);
  return EXIT_FAILED;
}
