/* A folder of its own for a test that writes one file; what else is left in it fails the
 * test. */
#ifndef FG__FOLDER_TEST_H
#define FG__FOLDER_TEST_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_test.h"

typedef struct folder {
  fg_context *context;
  char name[64];
  char path[128]; /* of the file written last */
} folder;

static inline int folder_set_up(void **state)
{
  folder *f = calloc(1, sizeof *f);
  if (!f || fg_context_create(&f->context) != FG_STATUS_OK)
    return -1;
  strcpy(f->name, "/tmp/flowgrain-write-XXXXXX");
  if (!mkdtemp(f->name))
    return -1;
  *state = f;
  return 0;
}

static inline int folder_tear_down(void **state)
{
  folder *f = *state;
  if (f->path[0])
    unlink(f->path);
  int left = rmdir(f->name); /* fails when a temporary file was left behind */
  fg_context_destroy(f->context);
  free(f);
  return left;
}

static inline const char *path_of(folder *f, const char *name)
{
  snprintf(f->path, sizeof f->path, "%s/%s", f->name, name);
  return f->path;
}

#endif
