/* Gives each file of a folder to a fuzz target, one test case a file, in TAP. A target
 * stops where a promise is broken, a sanitizer where memory is misused: the cases that
 * are then missing count as failed. Files named seed-... must be read, files named
 * fault-... must be refused. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct input {
  uint8_t *bytes; /* in a block of their own length: a sanitizer sees what lies beyond */
  size_t size;
} input;

static int is_input(const struct dirent *entry)
{
  return entry->d_name[0] != '.';
}

static input read_input(const char *folder, const char *name)
{
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "rb");
  input in = {0};
  if (!file || fseek(file, 0, SEEK_END))
    exit(2);
  const long size = ftell(file);
  rewind(file);
  in.size = size > 0 ? (size_t)size : 0;
  in.bytes = malloc(in.size ? in.size : 1);
  if (!in.bytes || fread(in.bytes, 1, in.size, file) != in.size)
    exit(2);
  fclose(file);
  return in;
}

static bool is_well(const char *folder, const char *name)
{
  const input in = read_input(folder, name);
  LLVMFuzzerTestOneInput(in.bytes, in.size);
  free(in.bytes);
  if (strncmp(name, "seed-", 5) == 0)
    return fg__fuzz_was_read;
  return strncmp(name, "fault-", 6) == 0 && !fg__fuzz_was_read;
}

int main(int count, char **argument)
{
  struct dirent **entry = NULL;
  const int files = count == 2 ? scandir(argument[1], &entry, is_input, alphasort) : -1;
  if (files < 1) {
    fprintf(stderr, "usage: %s FOLDER, with one file at least\n", argument[0]);
    return 2;
  }
  int failed = 0;
  printf("1..%d\n", files);
  for (int i = 0; i < files; ++i) {
    const bool well = is_well(argument[1], entry[i]->d_name);
    printf("%s %d - %s\n", well ? "ok" : "not ok", i + 1, entry[i]->d_name);
    fflush(stdout);
    failed += !well;
    free(entry[i]);
  }
  free(entry);
  return failed > 0;
}
