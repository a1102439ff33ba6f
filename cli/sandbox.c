#include "sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "alternatives.h"
#include "inputs.h"
#include "interrupt.h"

/* Bound of CPU time, as damaged files can cause an endless loop. Valid files take time in
 * proportion to their bytes, and their arrays are at most a thousand times as large
 * (deflate). The bound is one second, plus one for each 25 kB, but at most ten plus one
 * for each 20 MB, as large files are less compressed. Valid files need a fifth of it, or
 * less. */
enum { SMALL_BYTES_A_SECOND = 25000, BYTES_A_SECOND = 20000000, MOST_SECONDS = 10 };

/* What an HDF5 file holds is listed in less: one second, plus one for each 250 kB. */
enum { LISTED_BYTES_A_SECOND = 250000 };
enum { TIMES_LARGER = 4096 };
static const size_t MOST_BYTES = (size_t)1 << 30;

/* Interval, in milliseconds, at which a pending interrupt is detected. */
enum { LONGEST_WAIT = 100 };

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

static void set_bounds(const child_bounds *bounds)
{
  struct rlimit no_core = {0, 0}, time = {bounds->seconds, bounds->seconds + 1}, space;
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  size_t own = own_bytes();
  if (!bounds->bytes || !own || getrlimit(RLIMIT_AS, &space) != 0)
    return;
  if (space.rlim_cur == RLIM_INFINITY || space.rlim_cur > own + bounds->bytes)
    space.rlim_cur = own + bounds->bytes;
  setrlimit(RLIMIT_AS, &space);
}

/* Restores default signal handlers, except for signals that this process was started to
 * ignore. */
static void reset_signals(void)
{
  const int numbers[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE,
                         SIGILL,  SIGINT, SIGTERM, SIGHUP};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; ++k) {
    struct sigaction before;
    if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
      signal(numbers[k], SIG_DFL);
  }
}

/* Ends the child when this process is killed. */
static void end_with_parent(pid_t parent)
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (getppid() != parent)
    _exit(0);
}

static void send_text(int to, const char *text)
{
  size_t length = strlen(text) + 1; /* less than a pipe's buffer */
  if (write(to, text, length) != (ssize_t)length)
    _exit(0);
}

static void be_child(pid_t parent, int to, void (*work)(void *), void *data,
                     const child_bounds *bounds)
{
  end_with_parent(parent);
  set_bounds(bounds);
  reset_signals();
  silence();
  keep_complaints();
  complain("%s", ""); /* forget earlier complaints of the parent */
  work(data);
  send_text(to, last_complaint());
  send_text(to, last_advice());
  _exit(0);
}

/* Reads the child's messages until it ends or an interrupt arrives. */
static size_t receive(char *out, size_t size, int from, pid_t child)
{
  size_t used = 0;
  while (used < size) {
    struct pollfd wait = {.fd = from, .events = POLLIN};
    int ready = poll(&wait, 1, LONGEST_WAIT);
    if (interrupt_came()) {
      kill(child, SIGKILL);
      break;
    }
    if (ready <= 0)
      continue;
    ssize_t got = read(from, out + used, size - used);
    if (got == 0 || (got < 0 && errno != EINTR))
      break;
    used += got > 0 ? (size_t)got : 0;
  }
  return used;
}

static void take_texts(child_outcome *out, char *text, size_t used)
{
  text[used] = '\0';
  size_t first = strlen(text);
  snprintf(out->complaint, sizeof out->complaint, "%.*s", CHILD_TEXT_BYTES - 1, text);
  if (first + 1 < used)
    snprintf(out->advice, sizeof out->advice, "%.*s", CHILD_TEXT_BYTES - 1,
             text + first + 1);
}

static void await(child_outcome *out, int from, pid_t child)
{
  char text[2 * CHILD_TEXT_BYTES + 1];
  size_t used = receive(text, sizeof text - 1, from, child);
  int how = 0;
  pid_t ended;
  do
    ended = waitpid(child, &how, 0);
  while (ended < 0 && errno == EINTR);
  if (ended == child && WIFSIGNALED(how))
    out->signal = WTERMSIG(how);
  take_texts(out, text, used);
}

void do_in_child(child_outcome *out, void (*work)(void *), void *data,
                 const child_bounds *bounds)
{
  memset(out, 0, sizeof *out);
  int ends[2];
  if (pipe(ends) != 0)
    return; /* no process: the reading itself will fail if the file is damaged */
  /* while SIGCHLD is ignored waitpid cannot return a child's status */
  struct sigaction before, standard = {.sa_handler = SIG_DFL};
  sigemptyset(&standard.sa_mask);
  sigaction(SIGCHLD, &standard, &before);
  fflush(stdout);
  pid_t own = getpid(), child = fork();
  if (child == 0) {
    close(ends[0]);
    be_child(own, ends[1], work, data, bounds);
  }
  close(ends[1]);
  if (child > 0)
    await(out, ends[0], child);
  close(ends[0]);
  sigaction(SIGCHLD, &before, NULL);
}

typedef struct reading {
  const char *input;
  const fg_read_options *options;
  int slab, slabs; /* slabs 0: the inventory; -1: the defaults */
} reading;

/* In place of a number of slabs: only a crash counts as failure. */
enum { DEFAULTS_ALONE = -1, WITHOUT_COMPLAINT = -2 };

static void read_once(void *data)
{
  const reading *r = data;
  fg_context *context;
  fg_field *field;
  fg_inventory *inventory;
  if (create_context(&context))
    return;
  fg_read_options options = r->options ? *r->options : (fg_read_options){0};
  options.map = NULL; /* a map needs none of the bounded libraries */
  fg_read_defaults defaults;
  fg_status status;
  if (r->slabs == DEFAULTS_ALONE) {
    fg_read_defaults_find(&defaults, context, r->input, &options);
    return;
  }
  if (r->slabs == WITHOUT_COMPLAINT) {
    fg_field_read(&field, context, r->input, &options);
    return;
  }
  if (r->options && r->slabs)
    status = fg_field_read_slab(&field, context, r->input, &options, r->slab, r->slabs);
  else if (r->options)
    status = fg_inventory_read_chosen(&inventory, context, r->input, &options);
  else
    status = fg_inventory_read(&inventory, context, r->input);
  if (!status)
    return;
  complain_of(context, status, r->input);
  if (r->slabs)
    advise_alternatives(context, status, r->input, &options);
}

/* A GRIB message begins within so many bytes, behind a heading. */
enum { HEADING_BYTES = 16384 };

/* The library for a file that begins with these bytes, if it may crash on damaged
 * files. */
static const char *library_of(const char *start, size_t size)
{
  static const char hdf5[8] = "\211HDF\r\n\032\n";
  if (size >= sizeof hdf5 && memcmp(start, hdf5, sizeof hdf5) == 0)
    return "HDF5";
  for (size_t at = 0; at + 8 <= size; ++at)
    if (memcmp(start + at, "GRIB", 4) == 0 && (start[at + 7] == 1 || start[at + 7] == 2))
      return "ecCodes";
  return NULL;
}

static void add(const char **library, size_t *size, const char *found, size_t bytes)
{
  if (!found)
    return;
  *library = found;
  *size += bytes;
}

static void add_standard_input(const char **library, size_t *size)
{
  size_t bytes;
  const unsigned char *start = inputs_bytes(&bytes);
  if (start)
    add(library, size,
        library_of((const char *)start, bytes < HEADING_BYTES ? bytes : HEADING_BYTES),
        bytes);
}

/* Adds the size of a file that such a library reads, and sets the library's name. */
static void add_file(const char **library, size_t *size, const char *path)
{
  char start[HEADING_BYTES];
  struct stat about;
  if (input_is_standard(path)) {
    add_standard_input(library, size);
    return;
  }
  if (!path || stat(path, &about) != 0 || !S_ISREG(about.st_mode))
    return;
  int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    return;
  ssize_t got = read(file, start, sizeof start);
  close(file);
  add(library, size, library_of(start, got > 0 ? (size_t)got : 0), (size_t)about.st_size);
}

static child_bounds bounds_for(size_t size, size_t small_bytes_a_second)
{
  const size_t most = (SIZE_MAX / 4 - MOST_BYTES) / TIMES_LARGER;
  const size_t small = 1 + size / small_bytes_a_second;
  const size_t large = MOST_SECONDS + size / BYTES_A_SECOND;
  return (child_bounds){.seconds = (unsigned)(small < large ? small : large),
                        .bytes = MOST_BYTES + TIMES_LARGER * (size < most ? size : most)};
}

static int complain_of_child(const char *input, const char *library,
                             const child_outcome *outcome, const child_bounds *bounds)
{
  if (outcome->complaint[0])
    complain("%s", outcome->complaint);
  else if (outcome->signal == SIGBUS)
    complain("%s: " BECAME_SHORTER, input_name(input));
  else if (outcome->signal == SIGXCPU)
    complain("%s: damaged: reading it takes more than %u s", input_name(input),
             bounds->seconds);
  else
    complain("%s: damaged: the %s library does not survive reading it (signal %d)",
             input_name(input), library, outcome->signal);
  if (outcome->advice[0])
    advise("%s", outcome->advice);
  return EXIT_FAILED;
}

int sandbox_reading(const char *input, const fg_read_options *options)
{
  return sandbox_reading_part(input, options, 0, 1);
}

int sandbox_inventory(const char *input, const fg_read_options *options)
{
  return sandbox_reading_part(input, options, 0, 0);
}

int sandbox_defaults(const char *input, const fg_read_options *options)
{
  return sandbox_reading_part(input, options, 0, DEFAULTS_ALONE);
}

int sandbox_trial(const char *input, const fg_read_options *options)
{
  return sandbox_reading_part(input, options, 0, options ? WITHOUT_COMPLAINT : 1);
}

int sandbox_reading_part(const char *input, const fg_read_options *options, int slab,
                         int slabs)
{
  const char *library = NULL;
  size_t size = 0;
  add_file(&library, &size, input);
  add_file(&library, &size, options ? options->vars_from : NULL);
  add_file(&library, &size, options ? options->mesh_from : NULL);
  if (!library)
    return EXIT_DONE;
  const bool lists = !options || slabs == 0, hdf5 = strcmp(library, "HDF5") == 0;
  reading list = {input, options, 0, 0}, r = {input, options, slab, slabs};
  child_bounds bounds =
      bounds_for(size, hdf5 ? LISTED_BYTES_A_SECOND : SMALL_BYTES_A_SECOND);
  child_outcome outcome = {.signal = 0};
  if (hdf5 && !lists) { /* only its end counts: the reading repeats any complaint */
    do_in_child(&outcome, read_once, &list, &bounds);
    if (!outcome.signal)
      bounds = bounds_for(size, SMALL_BYTES_A_SECOND);
  }
  if (!outcome.signal)
    do_in_child(&outcome, read_once, &r, &bounds);
  if (interrupt_came() || (!outcome.signal && !outcome.complaint[0]))
    return EXIT_DONE; /* the reading itself stops at an interrupt */
  return complain_of_child(input, library, &outcome, &bounds);
}
