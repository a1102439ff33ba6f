#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "rehearse.h"

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

static void only_hdf5_files_are_rehearsed(void **state)
{
  (void)state;
  fg_read_options options = {0};
  assert_int_equal(rehearse_reading("synth:vortex", &options), EXIT_DONE);
  assert_int_equal(rehearse_reading("/", NULL), EXIT_DONE);
  assert_int_equal(rehearse_reading("no such file", &options), EXIT_DONE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_child_reports_how_it_ended),
      cmocka_unit_test(only_hdf5_files_are_rehearsed),
  };
  return cmocka_run_group_tests_name("cli/rehearse", tests, NULL, NULL);
}
