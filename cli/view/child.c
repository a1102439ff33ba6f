#include "view/child.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command/command.h"
#include "folder/files.h"
#include "folder/results.h"

static int make_temporary(cli_child *child)
{
  const char *place = getenv("TMPDIR");
  char *path = join_path(place && *place ? place : "/tmp", "flowgrain-view-XXXXXX");
  if (!path)
    return complain_of_memory("a file's name");
  if (!mkdtemp(path)) {
    int code = complain_of_file(path, "cannot be made");
    advise("-o DIR names a folder to run in.");
    free(path);
    return code;
  }
  child->folder = child->temporary = path;
  return EXIT_DONE;
}

/* Suppresses the run's summary, as its file names are useless in a temporary folder. */
static void silence_summary(void)
{
  int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0)
    dup2(nothing, STDOUT_FILENO);
}

/* Runs in a process group of its own, so that only the parent gets an interrupt from the
 * terminal and passes it on; ends with the parent. */
static _Noreturn void run(const cli_child *child, run_settings *settings, pid_t parent)
{
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  int code = getppid() == parent ? EXIT_DONE : EXIT_FAILED;
  if (child->temporary)
    silence_summary();
  if (!code)
    code = command_run(settings);
  if (fflush(stdout) != 0 && !code)
    code = complain_of_file("standard output", "cannot be written");
  exit(code);
}

int child_start(cli_child *out, const run_settings *given, void (*close_all)(void *data),
                void *data)
{
  run_settings settings = *given;
  int ends[2];
  *out = (cli_child){.socket = -1, .folder = given->output};
  int code = given->output ? EXIT_DONE : make_temporary(out);
  if (code)
    return code;
  if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0)
    return complain_of_file("the run", "cannot be started");
  settings.output = out->folder;
  settings.progress_socket = ends[1];
  fflush(NULL); /* or both processes would write buffered output */
  const pid_t parent = getpid();
  out->process = fork();
  if (out->process == 0) {
    close_all(data);
    close(ends[0]);
    run(out, &settings, parent);
  }
  if (out->process < 0) {
    out->process = 0;
    code = complain_of_file("the run", "cannot be started");
  }
  close(ends[1]);
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  out->socket = ends[0];
  return code;
}

static bool is_whole(const progress_message *message, ssize_t size)
{
  for (int k = 0; k < 2; ++k)
    if (size < (ssize_t)offsetof(progress_message, u) || message->nodes[k] < 0 ||
        message->nodes[k] > PROGRESS_NODES)
      return false;
  return (size_t)size == progress_message_size(message);
}

static void take(cli_child *child, const progress_message *message)
{
  if (message->nodes[0]) {
    densities_add(&child->densities, message);
    return;
  }
  child->began = child->began || message->share >= 0.0;
  child->share = message->share;
  memcpy(child->doing, message->words, sizeof child->doing);
}

/* Receives all pending messages. */
static void listen_to(cli_child *child)
{
  progress_message message;
  while (child->socket >= 0) {
    const ssize_t got = recv(child->socket, &message, sizeof message, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR))
      return;
    if (!is_whole(&message, got)) { /* the socket was closed */
      close(child->socket);
      child->socket = -1;
      return;
    }
    take(child, &message);
  }
}

static void learn_of_end(cli_child *child, int how)
{
  child->process = 0;
  if (WIFEXITED(how)) {
    child->code = WEXITSTATUS(how);
    return;
  }
  complain("the run was ended by signal %d", WTERMSIG(how));
  child->code = EXIT_FAILED;
}

void child_receive(cli_child *child)
{
  int how;
  if (!child->process)
    return;
  listen_to(child);
  if (waitpid(child->process, &how, WNOHANG) == child->process)
    learn_of_end(child, how);
}

void child_interrupt(cli_child *child)
{
  if (child->process)
    kill(child->process, child->temporary ? SIGKILL : SIGINT);
}

static bool is_any_file(const char *name)
{
  return strcmp(name, ".") != 0 && strcmp(name, "..") != 0 &&
         strcmp(name, WORK_NAME) != 0;
}

static int remove_one(const char *folder, const char *name, const void *data)
{
  (void)data;
  return remove_file(folder, name);
}

/* Removes the temporary folder, in which all files are this process's. */
static void remove_temporary(cli_child *child)
{
  char *work = join_path(child->temporary, WORK_NAME);
  if (work) {
    for_names(work, is_any_file, remove_one, NULL);
    rmdir(work);
  }
  for_names(child->temporary, is_any_file, remove_one, NULL);
  if (rmdir(child->temporary) != 0)
    complain_of_file(child->temporary, "cannot be removed");
  free(work);
  free(child->temporary);
  child->temporary = NULL;
}

void child_end(cli_child *child)
{
  int how;
  if (child->process) {
    kill(child->process, child->temporary ? SIGKILL : SIGTERM);
    while (waitpid(child->process, &how, 0) < 0 && errno == EINTR)
      ;
    child->process = 0;
  }
  if (child->socket >= 0)
    close(child->socket);
  child->socket = -1;
  densities_clear(&child->densities);
  if (child->temporary)
    remove_temporary(child);
}
