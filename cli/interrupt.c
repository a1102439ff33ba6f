#include "interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

/* Signal handlers have no argument, hence these variables. */
static _Atomic(fg_context *) stop_first;
static _Atomic(fg_context *) stop_second;
static volatile sig_atomic_t interrupts;
static atomic_bool second_at_once;

static void handle_signal(int number)
{
  (void)number;
  ++interrupts;
  fg_context *first = atomic_load(&stop_first);
  fg_context *second = atomic_load(&stop_second);
  if (first)
    fg_context_stop(first);
  if ((interrupts > 1 || atomic_load(&second_at_once)) && second)
    fg_context_stop(second);
}

void interrupt_start(fg_context *first)
{
  atomic_store(&stop_first, first);
  struct sigaction action = {.sa_handler = handle_signal, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  for (int k = 0; k < 3; ++k) {
    struct sigaction before;
    /* keep signals ignored that nohup or a shell's background job ignores */
    if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(numbers[k], &action, NULL);
  }
}

void interrupt_second(fg_context *second)
{
  atomic_store(&stop_second, second);
}

void interrupt_second_at_once(bool at_once)
{
  atomic_store(&second_at_once, at_once);
}

bool interrupt_came(void)
{
  return interrupts > 0;
}

int interrupt_count(void)
{
  return (int)interrupts;
}

void interrupt_end(void)
{
  atomic_store(&stop_first, NULL);
  atomic_store(&stop_second, NULL);
}

enum { LINE_BYTES = 8192 };

/* Reads a line, without what is beyond the buffer; false: there is none. A handler may
 * call few functions, hence no stream. */
static bool read_line(char line[LINE_BYTES], int file)
{
  size_t used = 0;
  char c = '\0';
  while (read(file, &c, 1) == 1 && c != '\n')
    if (used + 1 < LINE_BYTES)
      line[used++] = c;
  line[used] = '\0';
  return c == '\n';
}

/* Reads a hexadecimal number and moves past it. */
static uintptr_t take_address(const char **text)
{
  static const char digits[] = "0123456789abcdef";
  uintptr_t address = 0;
  for (const char *digit; **text && (digit = strchr(digits, **text)) != NULL; ++*text)
    address = address << 4 | (uintptr_t)(digit - digits);
  return address;
}

/* The file that is mapped at an address: "FIRST-END PERMISSIONS OFFSET DEVICE INODE PATH"
 * in Linux's list. NULL: none. */
static const char *find_mapped(char line[LINE_BYTES], uintptr_t address)
{
  const char *path = NULL;
  const int maps = open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
  if (maps < 0)
    return "a file";
  while (!path && read_line(line, maps)) {
    const char *at = line;
    const uintptr_t first = take_address(&at);
    at += *at == '-';
    if (address >= first && address < take_address(&at))
      path = strchr(at, '/');
  }
  close(maps);
  return path;
}

static void tell(const char *text)
{
  for (size_t left = strlen(text); left > 0;) {
    const ssize_t put = write(STDERR_FILENO, text, left);
    if (put <= 0)
      return;
    text += put;
    left -= (size_t)put;
  }
}

static void handle_lost_bytes(int number, siginfo_t *about, void *state)
{
  char line[LINE_BYTES];
  (void)state;
  const char *file = find_mapped(line, (uintptr_t)about->si_addr);
  if (!file) { /* another fault: the access is made again, and ends the program */
    signal(number, SIG_DFL);
    return;
  }
  tell("flowgrain: ");
  tell(file);
  tell(": " BECAME_SHORTER "\n");
  _exit(EXIT_FAILED);
}

void interrupt_at_lost_bytes(void)
{
  struct sigaction action = {.sa_sigaction = handle_lost_bytes, .sa_flags = SA_SIGINFO};
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, NULL);
}
