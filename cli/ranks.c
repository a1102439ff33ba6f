#include "ranks.h"

#include <stdio.h>

#include "inputs.h"
#include "launch.h"
#include "program.h"

static int rank, count = 1;
static fg_context *context;

int ranks_start(void)
{
  int code = launch_start();
  if (!code)
    code = create_context(&context);
  if (!code)
    code = ranks_share(context);
  if (code)
    return code;
  fg_ranks(context, &rank, &count);
  if (rank > 0)
    keep_complaints(true);
  if (rank > 0 && !freopen("/dev/null", "w", stdout))
    return complain_of_file("/dev/null", "cannot be written");
  return EXIT_DONE;
}

void ranks_end(void)
{
  fg_context_destroy(context);
  context = NULL;
  launch_end();
}

int ranks_share(fg_context *shared)
{
  fg_status status = launch_share(shared);
  if (!status)
    return EXIT_DONE;
  complain("%s", fg_context_message(shared));
  return EXIT_FAILED;
}

bool ranks_leader(void)
{
  return rank == 0;
}

int ranks_number(void)
{
  return rank;
}

int ranks_count(void)
{
  return count;
}

/* Statuses that fg_ranks_agree distinguishes from success, a stop and misuse. */
static fg_status status_of(int code)
{
  switch (code) {
  case EXIT_DONE:
    return FG_STATUS_OK;
  case EXIT_INTERRUPTED:
    return FG_STATUS_STOPPED;
  case EXIT_USAGE:
    return FG_STATUS_ARGUMENT;
  default:
    return FG_STATUS_FILE_ACCESS;
  }
}

static int code_of(fg_status status)
{
  switch (status) {
  case FG_STATUS_OK:
    return EXIT_DONE;
  case FG_STATUS_STOPPED:
    return EXIT_INTERRUPTED;
  case FG_STATUS_ARGUMENT:
    return EXIT_USAGE;
  default:
    return EXIT_FAILED;
  }
}

int ranks_agree(int code)
{
  if (count == 1)
    return code;
  fg_status status =
      fg_ranks_agree(context, status_of(code), last_complaint(), last_advice());
  const char *message = fg_context_message(context);
  if (status && !code && ranks_leader() && *message) {
    complain("%s", message);
    if (*fg_context_hint(context))
      advise("%s", fg_context_hint(context));
  }
  fg_context_clear(context);
  return code_of(status);
}

bool ranks_any(bool one)
{
  if (count == 1)
    return one;
  fg_status status =
      fg_ranks_agree(context, one ? FG_STATUS_STOPPED : FG_STATUS_OK, "", NULL);
  fg_context_clear(context);
  return status != FG_STATUS_OK;
}
