/* Files as bytes in memory. */
#include "decode/source.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static fg_status check_kind(fg_context *context, const char *path,
                            const struct stat *about)
{
  if (S_ISDIR(about->st_mode)) {
    fg_status status =
        fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: is a directory, not a file", path);
    fg__hint(context, "name one file in it");
    return status;
  }
  if (!S_ISREG(about->st_mode))
    return fg__fail(context, FG_STATUS_FILE_ACCESS,
                    "%s: is no regular file (a pipe, socket or device)", path);
  const size_t length = strlen(path);
  if (about->st_size == 0 && length > 5 && strcmp(path + length - 5, ".foam") == 0) {
    fg__fail(context, FG_STATUS_FILE_FORMAT,
             "%s: marks a case of OpenFOAM, and holds nothing itself", path);
    fg__hint(context, "write the case as VTK, by foamToVTK or ParaView");
    return FG_STATUS_FILE_FORMAT;
  }
  if (about->st_size == 0)
    return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is empty (0 bytes)", path);
  if ((uintmax_t)about->st_size > SIZE_MAX)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: %jd bytes cannot be mapped",
                    path, (intmax_t)about->st_size);
  return FG_STATUS_OK;
}

static bool is_given(const fg_context *context, const char *input)
{
  return fg__context_input(context)->bytes && strcmp(input, "-") == 0;
}

const char *fg__input_name(const fg_context *context, const char *input)
{
  return is_given(context, input) ? "standard input" : input;
}

static fg_status open_given(fg__source *out, fg_context *context, const char *name)
{
  const fg_input_options *input = fg__context_input(context);
  *out = (fg__source){.path = name, .bytes = input->bytes, .size = input->size};
  return input->size > 0
             ? FG_STATUS_OK
             : fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is empty (0 bytes)", name);
}

fg_status fg__source_open(fg__source *out, fg_context *context, const char *path)
{
  if (is_given(context, path))
    return open_given(out, context, fg__input_name(context, path));
  *out = (fg__source){.path = path};
  /* O_NONBLOCK: opening a pipe that nobody writes to must not wait */
  const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    return fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: %s", path, strerror(errno));
  struct stat about;
  fg_status status = FG_STATUS_OK;
  if (fstat(file, &about) != 0)
    status = fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: %s", path, strerror(errno));
  else
    status = check_kind(context, path, &about);
  if (status == FG_STATUS_OK) {
    void *bytes = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    if (bytes == MAP_FAILED)
      status = fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: %s", path, strerror(errno));
    else
      *out = (fg__source){
          .path = path, .on_disk = true, .bytes = bytes, .size = (size_t)about.st_size};
  }
  close(file);
  return status;
}

fg_status fg__source_check(fg_context *context, fg_status status, const char *path,
                           size_t size)
{
  struct stat about;
  if (status == FG_STATUS_MEMORY || status == FG_STATUS_STOPPED ||
      stat(path, &about) != 0 || (uintmax_t)about.st_size >= size)
    return status;
  if (status != FG_STATUS_OK)
    fg_context_clear(context);
  return fg__fail(context, FG_STATUS_FILE_ACCESS,
                  "%s: became shorter while it was read (%zu bytes, then %jd)", path,
                  size, (intmax_t)about.st_size);
}

fg_status fg__source_close(fg__source *source, fg_context *context, fg_status status)
{
  if (source->bytes && source->on_disk) {
    munmap((void *)(uintptr_t)source->bytes, source->size);
    status = fg__source_check(context, status, source->path, source->size);
  }
  source->bytes = NULL;
  return status;
}
