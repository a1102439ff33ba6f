#include "file/whole_file.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Names tried before giving up, in case a killed run with the same number left its own.
 */
enum { ATTEMPTS = 100, SUFFIX_BYTES = 48 };

static fg_status fail(fg_context *context, const char *path)
{
  return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: cannot be written: %s", path,
                  strerror(errno));
}

/* Creates a new empty file beside `path`; its permissions are those of any new file. */
static fg_status create_beside(char **name, int *file, fg_context *context,
                               const char *path)
{
  size_t bytes = strlen(path) + SUFFIX_BYTES;
  *name = fg__allocate(bytes, 1);
  if (!*name)
    return fg__fail_memory(context, "a file's name", bytes);
  *file = -1;
  for (int attempt = 0; attempt < ATTEMPTS && *file < 0; ++attempt) {
    snprintf(*name, bytes, "%s.%ld-%d.part", path, (long)getpid(), attempt);
    *file = open(*name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (*file < 0 && errno != EEXIST)
      break;
  }
  if (*file >= 0)
    return FG_STATUS_OK;
  fg_status status = fail(context, path);
  free(*name);
  *name = NULL;
  return status;
}

fg_status fg__whole_file_open(fg__whole_file *out, fg_context *context, const char *path)
{
  *out = (fg__whole_file){.path = path};
  struct stat about;
  if (stat(path, &about) == 0 && !S_ISREG(about.st_mode)) {
    out->stream = fopen(path, "w"); /* renaming would replace the device itself */
    return out->stream ? FG_STATUS_OK : fail(context, path);
  }
  int file;
  fg_status status = create_beside(&out->temporary, &file, context, path);
  if (status != FG_STATUS_OK)
    return status;
  out->stream = fdopen(file, "w");
  if (out->stream)
    return FG_STATUS_OK;
  status = fail(context, path);
  close(file);
  unlink(out->temporary);
  free(out->temporary);
  out->temporary = NULL;
  return status;
}

fg_status fg__whole_file_close(fg__whole_file *file, fg_context *context,
                               fg_status status)
{
  if (!file->stream)
    return status;
  bool failed = file->error || ferror(file->stream) != 0;
  int first_error = file->error ? file->error : errno;
  if (fclose(file->stream) != 0 && !failed) {
    failed = true;
    first_error = errno;
  }
  if (failed && status == FG_STATUS_OK) {
    errno = first_error;
    status = fail(context, file->path);
  }
  if (file->temporary)
    status = fg__whole_file_rename(file->temporary, context, file->path, status);
  *file = (fg__whole_file){0};
  return status;
}

fg_status fg__whole_file_name(char **temporary, fg_context *context, const char *path)
{
  int file;
  fg_status status = create_beside(temporary, &file, context, path);
  if (status == FG_STATUS_OK)
    close(file);
  return status;
}

fg_status fg__whole_file_rename(char *temporary, fg_context *context, const char *path,
                                fg_status status)
{
  if (status == FG_STATUS_OK && rename(temporary, path) != 0)
    status = fail(context, path);
  if (status != FG_STATUS_OK)
    unlink(temporary);
  free(temporary);
  return status;
}
