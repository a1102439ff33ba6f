#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "interrupt.h"
#include "program.h"
#include "ranks.h"

/* Opens /dev/null for standard streams that the caller closed. Otherwise a file that the
 * program opens would get their number, and messages would be written into it. Output to
 * the replaced stream fails, and is reported. */
static void hold_standard_streams(void)
{
  for (int stream = 0; stream <= 2; ++stream)
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      int opened = open("/dev/null", stream == 1 ? O_RDONLY : O_RDWR);
      if (opened > stream)
        close(opened);
    }
}

/* Ignores SIGXFSZ: writing beyond a file-size limit then is an error, like a full
 * disk. */
static void take_file_limits_as_errors(void)
{
  signal(SIGXFSZ, SIG_IGN);
}

static int finish(int code)
{
  bool failed = fflush(stdout) != 0 || ferror(stdout);
  if (failed && code == EXIT_DONE)
    return complain_of_file("standard output", "cannot be written");
  return code;
}

int main(int argc, char **argv)
{
  hold_standard_streams();
  take_file_limits_as_errors();
  interrupt_at_lost_bytes();
  int code = ranks_start();
  code = finish(code ? code : program_perform(argc, argv));
  ranks_end();
  return code;
}
