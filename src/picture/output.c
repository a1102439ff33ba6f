#include "picture/output.h"

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

static fg_status fail(fg_context *context, const char *path, int error)
{
  return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: cannot be written: %s", path,
                  strerror(error));
}

fg_status fg__output_open(fg__output *out, fg_context *context, const char *path)
{
  *out = (fg__output){.path = path};
  struct stat about;
  if (stat(path, &about) == 0 && S_ISDIR(about.st_mode))
    return fail(context, path, EISDIR);
  if (stat(path, &about) == 0 && !S_ISREG(about.st_mode)) {
    out->stream = fopen(path, "w"); /* renaming would replace the device itself */
    return out->stream ? FG_STATUS_OK : fail(context, path, errno);
  }
  size_t bytes = strlen(path) + SUFFIX_BYTES;
  out->temporary = fg__allocate(bytes, 1);
  if (!out->temporary)
    return fg__fail_memory(context, "a file's name", bytes);
  int file = -1;
  for (int attempt = 0; attempt < ATTEMPTS && file < 0; ++attempt) {
    snprintf(out->temporary, bytes, "%s.%ld-%d.part", path, (long)getpid(), attempt);
    file = open(out->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST)
      break;
  }
  int error = errno;
  if (file >= 0) {
    out->stream = fdopen(file, "w");
    if (out->stream)
      return FG_STATUS_OK;
    error = errno;
    close(file);
    unlink(out->temporary);
  }
  free(out->temporary);
  out->temporary = NULL;
  return fail(context, path, error);
}

cairo_status_t fg__output_write(void *closure, const unsigned char *bytes,
                                unsigned int count)
{
  fg__output *output = closure;
  if (output->error || fwrite(bytes, 1, count, output->stream) == count)
    return output->error ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
  output->error = errno ? errno : EIO;
  return CAIRO_STATUS_WRITE_ERROR;
}

fg_status fg__output_close(fg__output *output, fg_context *context, fg_status status)
{
  if (!output->stream)
    return status;
  int error = output->error;
  if (fclose(output->stream) != 0 && !error)
    error = errno;
  if (error && !status)
    status = fail(context, output->path, error);
  if (output->temporary && !status && rename(output->temporary, output->path) != 0)
    status = fail(context, output->path, errno);
  if (output->temporary && status)
    unlink(output->temporary);
  free(output->temporary);
  *output = (fg__output){0};
  return status;
}
