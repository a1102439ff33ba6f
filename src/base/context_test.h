/* What all unit tests include, and tests whose state is a context. */
#ifndef FG__CONTEXT_TEST_H
#define FG__CONTEXT_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "flowgrain/flowgrain.h"

static inline int context_set_up(void **state)
{
  return fg_context_create((fg_context **)state) != FG_STATUS_OK;
}

static inline int context_tear_down(void **state)
{
  fg_context_destroy(*state);
  return 0;
}

#endif
