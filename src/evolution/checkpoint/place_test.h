/* For tests of ranks together that write a checkpoint: its file, the same on all. */
#ifndef FG__CHECKPOINT_PLACE_TEST_H
#define FG__CHECKPOINT_PLACE_TEST_H

#include <unistd.h>

#include "grid/together_test.h"

static char path[96];

static int name_checkpoint(void **state)
{
  (void)state;
  name_folder(path, sizeof path); /* a file in place of the folder */
  return 0;
}

static int remove_checkpoint(void **state)
{
  (void)state;
  if (us.ranks->rank != 0)
    return 0;
  char previous[128];
  snprintf(previous, sizeof previous, "%s.previous", path);
  unlink(previous);
  return unlink(path);
}

#endif
