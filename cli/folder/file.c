#include "folder/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "build_features.h"
#include "folder/files.h"

bool ends_with(const char *text, const char *end)
{
  size_t length = strlen(text), tail = strlen(end);
  return length > tail && strcasecmp(text + length - tail, end) == 0;
}

int check_picture_name(const char *path, const char *command)
{
  if (ends_with(path, ".svg") || ends_with(path, ".pdf") || ends_with(path, ".png")) {
    int code = require_feature(path, FG_FEATURE_PICTURES);
    return code ? code : check_place_of_file(path);
  }
  complain("-o %s: the name's end must be .svg, .pdf or .png", path);
  advise("Try 'flowgrain %s --help'.", command);
  return EXIT_USAGE;
}

static bool is_same_file(const char *path, const struct stat *about)
{
  struct stat found;
  return path && stat(path, &found) == 0 && found.st_dev == about->st_dev &&
         found.st_ino == about->st_ino;
}

int check_is_no_input(const char *path, const char *const *inputs, int count)
{
  struct stat found;
  if (stat(path, &found) != 0)
    return EXIT_DONE;
  for (int k = 0; k < count; ++k)
    if (is_same_file(inputs[k], &found)) {
      complain("%s: is an input, and would be overwritten", path);
      advise("Choose another name with -o.");
      return EXIT_FAILED;
    }
  return EXIT_DONE;
}

int check_place_of_file(const char *path)
{
  struct stat found;
  if (stat(path, &found) == 0 && !S_ISREG(found.st_mode)) {
    errno = EISDIR;
    return S_ISDIR(found.st_mode) ? complain_of_file(path, "cannot be written")
                                  : EXIT_DONE; /* a device */
  }
  char *folder = join_texts(path, "");
  if (!folder)
    return complain_of_memory("a file's name");
  cut_to_parent(folder);
  int code = EXIT_DONE;
  if (access(folder, W_OK | X_OK) != 0) {
    bool missing = errno == ENOENT;
    code = complain_of_file(path, "cannot be written");
    if (missing)
      advise("Make the folder %s first.", folder);
  }
  free(folder);
  return code;
}

char *temporary_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  size_t size = strlen(path) + 40;
  char *text = malloc(size);
  if (text)
    snprintf(text, size, "%.*s.flowgrain-%ld-%s", (int)(name - path), path,
             (long)getpid(), name);
  else
    complain("out of memory for a file's name");
  return text;
}

int replace_file(char *partial, const char *path, int code)
{
  if (!code && rename(partial, path) != 0)
    code = complain_of_file(path, "cannot be written");
  if (code && partial)
    unlink(partial);
  free(partial);
  return code;
}

int write_text_file(const char *path, const char *text)
{
  char *partial = temporary_name(path);
  if (!partial)
    return EXIT_FAILED;
  FILE *stream = fopen(partial, "w");
  bool written = stream && fputs(text, stream) >= 0 && fputc('\n', stream) != EOF;
  written = stream && fclose(stream) == 0 && written;
  return replace_file(partial, path,
                      written ? EXIT_DONE : complain_of_file(path, "cannot be written"));
}
