#include "folder/files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static size_t digits(const char *text)
{
  return strspn(text, "0123456789");
}

void scale_name(char out[SCALE_NAME_BYTES], int index, const char *end)
{
  snprintf(out, SCALE_NAME_BYTES, "scale-%02d%.15s", index, end);
}

int scale_of(const char *name)
{
  static const char *const ends[] = {".geojson", ".svg", ".png", ".pdf",
                                     ".vti",     ".vtp", ".glb"};
  if (strncmp(name, "scale-", 6) != 0 || digits(name + 6) != 2)
    return -1;
  const char *end = name + 8;
  if (end[0] == '-' && digits(end + 1) > 0) /* a second or later view */
    end += 1 + digits(end + 1);
  for (size_t k = 0; k < sizeof ends / sizeof ends[0]; ++k)
    if (strcmp(end, ends[k]) == 0)
      return atoi(name + 6);
  return -1;
}

bool is_result(const char *name)
{
  return strcmp(name, REPORT_NAME) == 0 || strcmp(name, TABLE_NAME) == 0 ||
         strcmp(name, VIEW_NAME) == 0 || scale_of(name) >= 0;
}

/* Temporary names are NAME.PROCESS-ATTEMPT.part or NAME.part. */
bool is_partial(const char *name)
{
  char stem[64];
  size_t length = strlen(name), end = strlen(".part");
  if (length <= end || length - end >= sizeof stem ||
      strcmp(name + length - end, ".part") != 0)
    return false;
  memcpy(stem, name, length - end);
  stem[length - end] = '\0';
  if (is_result(stem) || strcmp(stem, CHECKPOINT_NAME) == 0)
    return true;
  char *dot = strrchr(stem, '.');
  if (!dot)
    return false;
  size_t process = digits(dot + 1);
  if (!process || dot[1 + process] != '-' || !digits(dot + 2 + process))
    return false;
  *dot = '\0';
  return is_result(stem);
}

int for_names(const char *folder, bool (*wanted)(const char *name),
              int (*act)(const char *folder, const char *name, const void *data),
              const void *data)
{
  DIR *stream = opendir(folder);
  if (!stream)
    return errno == ENOENT ? EXIT_DONE : complain_of_file(folder, "cannot be read");
  int code = EXIT_DONE;
  for (struct dirent *entry; !code && (entry = readdir(stream));)
    if (wanted(entry->d_name))
      code = act(folder, entry->d_name, data);
  closedir(stream);
  return code;
}

int remove_file(const char *folder, const char *name)
{
  char *path = join_path(folder, name);
  if (!path)
    return complain_of_memory("a file's name");
  int code = EXIT_DONE;
  if (unlink(path) != 0 && errno != ENOENT)
    code = complain_of_file(path, "cannot be replaced");
  free(path);
  return code;
}

static bool copy_bytes(int from, int to)
{
  char bytes[65536];
  for (;;) {
    ssize_t got = read(from, bytes, sizeof bytes);
    if (got <= 0)
      return got == 0;
    for (ssize_t done = 0; done < got;) {
      ssize_t put = write(to, bytes + done, (size_t)(got - done));
      if (put < 0)
        return false;
      done += put;
    }
  }
}

static bool copy_file(const char *path, const char *source)
{
  char *part = join_texts(path, ".part");
  int from = open(source, O_RDONLY | O_CLOEXEC);
  int to =
      part && from >= 0 ? open(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
  bool copied = to >= 0 && copy_bytes(from, to);
  int error = errno;
  if (to >= 0 && close(to) != 0 && copied) {
    copied = false;
    error = errno;
  }
  if (copied && rename(part, path) != 0) {
    copied = false;
    error = errno;
  }
  if (to >= 0 && !copied)
    unlink(part);
  if (from >= 0)
    close(from);
  free(part);
  errno = error;
  return copied;
}

int duplicate_file(const char *folder, const char *name, const char *from)
{
  char *source = join_path(from, name), *path = join_path(folder, name);
  int code = EXIT_DONE;
  /* some file systems have no hard links */
  if (!source || !path)
    code = complain_of_memory("a file's name");
  else if (link(source, path) != 0 && (errno == EEXIST || !copy_file(path, source)))
    code = complain_of_file(path, "cannot be written");
  free(source);
  free(path);
  return code;
}

static int synchronise(const char *path)
{
  int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    return complain_of_file(path, "cannot be read");
  bool failed = fsync(file) != 0 && errno != EINVAL && errno != ENOSYS;
  int code = failed ? complain_of_file(path, "cannot be written") : EXIT_DONE;
  close(file);
  return code;
}

int synchronise_file(const char *folder, const char *name)
{
  char *path = join_path(folder, name);
  int code = path ? synchronise(path) : complain_of_memory("a file's name");
  free(path);
  return code;
}

void synchronise_folder(const char *folder)
{
  int file = open(folder, O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return;
  (void)fsync(file); /* not every file system supports it */
  close(file);
}

void cut_to_parent(char *path)
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

/* A symbolic link counts as present even if its target is missing. */
static bool is_absent(const char *path)
{
  struct stat found;
  return lstat(path, &found) != 0 && (errno == ENOENT || errno == ENOTDIR);
}

char *nearest_existing(const char *path)
{
  char *nearest = join_texts(path, "");
  for (size_t length = nearest ? strlen(nearest) : 0;
       length > 1 && nearest[length - 1] == '/';)
    nearest[--length] = '\0';
  while (nearest && is_absent(nearest) && strcmp(nearest, ".") != 0 &&
         strcmp(nearest, "/") != 0)
    cut_to_parent(nearest);
  return nearest;
}

static bool is_of_kind(const char *path, mode_t kind)
{
  struct stat found;
  return lstat(path, &found) == 0 && (found.st_mode & S_IFMT) == kind;
}

bool is_plain_file(const char *path)
{
  return is_of_kind(path, S_IFREG);
}

bool is_plain_folder(const char *path)
{
  return is_of_kind(path, S_IFDIR);
}

static bool is_folder(const struct stat *about)
{
  errno = ENOTDIR;
  return S_ISDIR(about->st_mode);
}

int make_folders(const char *folder, char **topmost)
{
  char *path = join_texts(folder, "");
  if (!path)
    return complain_of_memory("a file's name");
  int code = EXIT_DONE;
  struct stat found;
  for (char *end = path + 1; !code; ++end) {
    if (*end && *end != '/')
      continue;
    char kept = *end;
    *end = '\0';
    if (mkdir(path, 0777) == 0) {
      if (!*topmost)
        *topmost = join_texts(path, "");
    } else if (errno != EEXIST || stat(path, &found) != 0 || !is_folder(&found))
      code = complain_of_file(path, "cannot be made");
    *end = kept;
    if (!kept)
      break;
  }
  free(path);
  return code;
}

void remove_empty_folders(const char *folder, const char *topmost)
{
  /* rmdir fails on a folder that is not empty */
  char *path = join_texts(folder, "");
  size_t shortest = strlen(topmost);
  while (path && strlen(path) >= shortest && rmdir(path) == 0)
    cut_to_parent(path);
  free(path);
}

bool file_is_there(const char *folder, const char *name)
{
  char *path = join_path(folder, name);
  struct stat found;
  bool there = path && stat(path, &found) == 0;
  free(path);
  return there;
}
