#include "interrupt.h"

#include <signal.h>
#include <stdatomic.h>

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
