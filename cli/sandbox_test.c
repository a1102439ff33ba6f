#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "interrupt.h"
#include "sandbox.h"

static const child_bounds some = {.seconds = 5};

static void end_well(void *data)
{
  int *number = data;
  *number = 7; /* in the child's memory only */
}

static void crash(void *data)
{
  (void)data;
  raise(SIGSEGV);
}

static void give_up(void *data)
{
  (void)data;
  abort();
}

static void loop(void *data)
{
  volatile unsigned long *count = data;
  for (;;)
    ++*count;
}

static void complain_twice(void *data)
{
  complain("first");
  complain("%s", (const char *)data);
  advise("do otherwise");
}

static int signal_that_ends(void (*work)(void *), void *data, unsigned seconds)
{
  child_outcome outcome;
  do_in_child(&outcome, work, data, &(child_bounds){.seconds = seconds});
  return outcome.signal;
}

static void a_child_reports_how_it_ended(void **state)
{
  (void)state;
  int number = 3;
  unsigned long count = 0;
  assert_int_equal(signal_that_ends(end_well, &number, 5), 0);
  assert_int_equal(number, 3);
  assert_int_equal(signal_that_ends(crash, NULL, 5), SIGSEGV);
  assert_int_equal(signal_that_ends(give_up, NULL, 5), SIGABRT);
  assert_int_equal(signal_that_ends(loop, &count, 1), SIGXCPU);
}

static void its_last_complaint_is_kept(void **state)
{
  (void)state;
  char words[] = "second";
  int number = 0;
  child_outcome outcome;
  do_in_child(&outcome, complain_twice, words, &some);
  assert_int_equal(outcome.signal, 0);
  assert_string_equal(outcome.complaint, "second");
  assert_string_equal(outcome.advice, "do otherwise");
  do_in_child(&outcome, end_well, &number, &some);
  assert_string_equal(outcome.complaint, "");
  assert_string_equal(outcome.advice, "");
}

#ifndef __SANITIZE_ADDRESS__
static void take_memory(void *data)
{
  char *bytes = malloc(*(size_t *)data);
  complain(bytes ? "had" : "had not");
  free(bytes);
}

static void its_memory_is_bounded(void **state)
{
  (void)state;
  size_t most = (size_t)1 << 28, wanted[] = {most / 2, 2 * most};
  const child_bounds bounds = {.seconds = 5, .bytes = most};
  child_outcome outcome;
  do_in_child(&outcome, take_memory, &wanted[0], &bounds);
  assert_string_equal(outcome.complaint, "had");
  do_in_child(&outcome, take_memory, &wanted[1], &bounds);
  assert_string_equal(outcome.complaint, "had not");
}

#endif

/* While a parent ignores SIGCHLD, waitpid fails. */
static void the_end_of_an_ignored_child_is_seen(void **state)
{
  (void)state;
  signal(SIGCHLD, SIG_IGN);
  int number = 0;
  assert_int_equal(signal_that_ends(end_well, &number, 5), 0);
  assert_int_equal(signal_that_ends(crash, NULL, 5), SIGSEGV);
  assert_true(signal(SIGCHLD, SIG_DFL) == SIG_IGN);
}

/* Writes its process number, then waits. */
static void stay(void *data)
{
  pid_t own = getpid();
  if (write(*(int *)data, &own, sizeof own) == (ssize_t)sizeof own)
    for (;;)
      pause();
}

static void a_child_ends_with_its_parent(void **state)
{
  (void)state;
  int ends[2];
  assert_int_equal(pipe(ends), 0);
  pid_t parent = fork();
  if (parent == 0) {
    child_outcome outcome;
    close(ends[0]);
    do_in_child(&outcome, stay, &ends[1], &some);
    _exit(0);
  }
  close(ends[1]);
  pid_t child;
  assert_int_equal(read(ends[0], &child, sizeof child), sizeof child);
  kill(parent, SIGKILL);
  waitpid(parent, NULL, 0);
  /* the child has the other end open until it ends */
  char none;
  alarm(20);
  assert_int_equal(read(ends[0], &none, 1), 0);
  alarm(0);
  close(ends[0]);
}

static void an_interrupt_ends_the_wait(void **state)
{
  (void)state;
  int ends[2];
  assert_int_equal(pipe(ends), 0);
  pid_t parent = fork();
  if (parent == 0) {
    fg_context *context;
    child_outcome outcome;
    alarm(20);
    if (fg_context_create(&context))
      _exit(1);
    interrupt_start(context);
    do_in_child(&outcome, stay, &ends[1], &some);
    _exit(interrupt_came() && outcome.signal == SIGKILL ? 7 : 2);
  }
  pid_t child;
  assert_int_equal(read(ends[0], &child, sizeof child), sizeof child);
  kill(parent, SIGTERM);
  int how = 0;
  assert_int_equal(waitpid(parent, &how, 0), parent);
  assert_true(WIFEXITED(how));
  assert_int_equal(WEXITSTATUS(how), 7);
  close(ends[0]);
  close(ends[1]);
}

static void only_hdf5_files_are_probed(void **state)
{
  (void)state;
  fg_read_options options = {0};
  assert_int_equal(sandbox_reading("synth:vortex", &options), EXIT_DONE);
  assert_int_equal(sandbox_reading("/", NULL), EXIT_DONE);
  assert_int_equal(sandbox_reading("no such file", &options), EXIT_DONE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_child_reports_how_it_ended),
      cmocka_unit_test(its_last_complaint_is_kept),
#ifndef __SANITIZE_ADDRESS__ /* the sanitizer ends a process whose allocation fails */
      cmocka_unit_test(its_memory_is_bounded),
#endif
      cmocka_unit_test(the_end_of_an_ignored_child_is_seen),
      cmocka_unit_test(a_child_ends_with_its_parent),
      cmocka_unit_test(an_interrupt_ends_the_wait),
      cmocka_unit_test(only_hdf5_files_are_probed),
  };
  return cmocka_run_group_tests_name("cli/sandbox", tests, NULL, NULL);
}
