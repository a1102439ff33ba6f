#include "output.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const report_name = "run.json";

/* Cuts the last part off a path: "a/b" becomes "a", "a" becomes ".", "/" stays. */
static void cut_to_parent(char *path)
{
  size_t length = strlen(path);
  while (length > 1 && path[length - 1] == '/')
    path[--length] = '\0';
  char *slash = strrchr(path, '/');
  if (!slash) {
    if (length)
      memcpy(path, ".", 2);
    return;
  }
  while (slash > path && slash[-1] == '/')
    --slash;
  slash[slash == path ? 1 : 0] = '\0';
}

static int out_of_memory(void)
{
  complain("out of memory for a file's name");
  return EXIT_FAILED;
}

/* The nearest folder at or above `path` that is there. NULL without memory. */
static char *nearest_existing(const char *path)
{
  char *nearest = join_texts(path, "");
  struct stat found;
  while (nearest && stat(nearest, &found) != 0 && errno == ENOENT &&
         strcmp(nearest, ".") != 0 && strcmp(nearest, "/") != 0)
    cut_to_parent(nearest);
  return nearest;
}

int output_check(const char *folder, bool force)
{
  struct stat found;
  char *nearest = nearest_existing(folder);
  if (!nearest)
    return out_of_memory();
  int code = EXIT_DONE;
  if (stat(nearest, &found) != 0)
    code = complain_of_file(nearest, "cannot be used");
  else if (!S_ISDIR(found.st_mode)) {
    complain("%s: is a file, a folder is needed for the results", nearest);
    code = EXIT_FAILED;
  } else if (access(nearest, W_OK | X_OK) != 0)
    code = complain_of_file(nearest, "cannot be written to");
  free(nearest);
  if (code)
    return code;
  char *report = join_path(folder, report_name);
  if (!report)
    return out_of_memory();
  if (!force && stat(report, &found) == 0) {
    complain("%s: holds the results of a run", folder);
    fputs("Choose another folder with -o, or replace its results with --force.\n",
          stderr);
    code = EXIT_FAILED;
  }
  free(report);
  return code;
}

/* Makes a folder and those above it; *topmost becomes the first that was not there. */
static int make_folders(const char *folder, char **topmost)
{
  char *path = join_texts(folder, "");
  if (!path)
    return out_of_memory();
  int code = EXIT_DONE;
  for (char *end = path + 1; !code; ++end) {
    if (*end && *end != '/')
      continue;
    char kept = *end;
    *end = '\0';
    if (mkdir(path, 0777) == 0) {
      if (!*topmost)
        *topmost = join_texts(path, "");
    } else if (errno != EEXIST)
      code = complain_of_file(path, "cannot be made");
    *end = kept;
    if (!kept)
      break;
  }
  free(path);
  return code;
}

int output_open(cli_output *out, const char *folder)
{
  memset(out, 0, sizeof *out);
  out->folder = join_texts(folder, "");
  if (!out->folder)
    return out_of_memory();
  int code = make_folders(folder, &out->made_from);
  if (code)
    return code;
  out->partial = join_path(folder, ".flowgrain-XXXXXX");
  if (!out->partial)
    return out_of_memory();
  if (!mkdtemp(out->partial)) {
    free(out->partial);
    out->partial = NULL;
    return complain_of_file(folder, "cannot be written to");
  }
  return EXIT_DONE;
}

char *output_path(const cli_output *out, const char *name)
{
  return join_path(out->partial, name);
}

static bool digits(const char *text, size_t count)
{
  for (size_t k = 0; k < count; ++k)
    if (text[k] < '0' || text[k] > '9')
      return false;
  return true;
}

/* A name that a run of ours leaves in DIR: nothing else is ever removed there. */
static bool is_ours(const char *name)
{
  static const char *const ends[] = {".geojson", ".svg", ".png", ".pdf", ".vti"};
  if (strcmp(name, report_name) == 0 || strcmp(name, "evolution.csv") == 0)
    return true;
  if (strncmp(name, "scale-", 6) != 0 || !digits(name + 6, 2))
    return false;
  for (size_t k = 0; k < sizeof ends / sizeof ends[0]; ++k)
    if (strcmp(name + 8, ends[k]) == 0)
      return true;
  return false;
}

/* Calls `act` for every one of our files in a folder, run.json not among them. */
static int for_our_files(const char *folder, const cli_output *out,
                         int (*act)(const cli_output *out, const char *name))
{
  DIR *stream = opendir(folder);
  if (!stream)
    return complain_of_file(folder, "cannot be read");
  int code = EXIT_DONE;
  for (struct dirent *entry; !code && (entry = readdir(stream));)
    if (is_ours(entry->d_name) && strcmp(entry->d_name, report_name) != 0)
      code = act(out, entry->d_name);
  closedir(stream);
  return code;
}

static int remove_named(const char *folder, const char *name)
{
  char *path = join_path(folder, name);
  if (!path)
    return out_of_memory();
  int code = EXIT_DONE;
  if (unlink(path) != 0 && errno != ENOENT)
    code = complain_of_file(path, "cannot be replaced");
  free(path);
  return code;
}

static int remove_final(const cli_output *out, const char *name)
{
  return remove_named(out->folder, name);
}

static int remove_partial(const cli_output *out, const char *name)
{
  return remove_named(out->partial, name);
}

static int rename_partial(const cli_output *out, const char *name)
{
  char *from = join_path(out->partial, name);
  char *to = join_path(out->folder, name);
  int code = from && to ? EXIT_DONE : out_of_memory();
  if (!code && rename(from, to) != 0)
    code = complain_of_file(to, "cannot be written");
  free(from);
  free(to);
  return code;
}

int output_commit(cli_output *out)
{
  int code = remove_named(out->folder, report_name);
  if (!code)
    code = for_our_files(out->folder, out, remove_final);
  if (!code)
    code = for_our_files(out->partial, out, rename_partial);
  if (!code)
    code = rename_partial(out, report_name);
  if (code)
    /* a failed run leaves no picture, not even half of its own */
    for_our_files(out->folder, out, remove_final);
  else {
    free(out->made_from);
    out->made_from = NULL;
  }
  return code;
}

void output_close(cli_output *out)
{
  if (out->partial) {
    for_our_files(out->partial, out, remove_partial);
    remove_named(out->partial, report_name);
    rmdir(out->partial);
  }
  if (out->made_from && out->folder) {
    /* rmdir leaves alone what is not empty */
    char *path = join_texts(out->folder, "");
    size_t shortest = strlen(out->made_from);
    while (path && strlen(path) >= shortest && rmdir(path) == 0)
      cut_to_parent(path);
    free(path);
  }
  free(out->folder);
  free(out->partial);
  free(out->made_from);
  memset(out, 0, sizeof *out);
}

char *temporary_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  size_t room = strlen(path) + 40;
  char *text = malloc(room);
  if (text)
    snprintf(text, room, "%.*s.flowgrain-%ld-%s", (int)(name - path), path,
             (long)getpid(), name);
  return text;
}
